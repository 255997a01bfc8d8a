//! Logs made with known parameters and noise give these parameters back, with the spread that the noise gives them.

#[path = "../robots/mod.rs"]
#[allow(dead_code)]
mod robots;

use physics::Data;
use robohive_identify::{
    IdentifyError, Log, Options, Prior, Quantity, Readings, fragment, identify, patched, report,
};
use robots::{ARM, NOISE, Robot};

/// Values within a number of deviations, and a share of the truth.
fn near(robot: &Robot, found: &robohive_identify::Found, deviations: f64, share: f64) {
    let all = found.parameters.iter().zip(&found.values).zip(&found.deviations).zip(robot.truth(found));
    for (((p, value), deviation), truth) in all {
        let (error, name) = ((value - truth).abs(), &p.name);
        assert!(error <= deviations * deviation, "{name}: {value} ± {deviation}, not {truth}");
        assert!(error <= share * truth.abs(), "{name}: {value}, not {truth}");
    }
}

/// Of 21 values with a normal error, one beyond 3.5 deviations is met in one log of a hundred; the log is one of the others.
#[test]
fn an_arm_is_found_with_the_deviations_that_its_noise_gives() {
    let robot = Robot::new(ARM);
    let (log, model) = (robot.log(2.0, 0, 1), robot.disturbed());
    let parameters = Quantity::choose("damping,armature,frictionloss", &model).unwrap();
    let found = identify(&model, &[log], &parameters, &Options::default()).unwrap();
    assert!(found.unknown.is_empty(), "{:?}", found.unknown);
    near(&robot, &found, 3.5, 0.05);
    for (name, noise) in found.columns.iter().zip(&found.noise) {
        let added = NOISE[usize::from(name.starts_with("vel"))];
        assert!((noise / added - 1.0).abs() < 0.1, "{name}: {noise}");
    }
    assert!(found.correlation.iter().all(|c| c.abs() < 0.15), "{:?}", found.correlation);
}

#[test]
fn a_delay_is_found() {
    let robot = Robot::new(ARM);
    let log = robot.log(1.5, 6, 2);
    let parameters = Quantity::choose("delay", &robot.model).unwrap();
    let found = identify(&robot.model, &[log], &parameters, &Options::default()).unwrap();
    assert!((found.values[0] - 0.012).abs() < 3.0 * found.deviations[0], "{:?}", found.values);
    assert!(found.deviations[0] < 1e-4, "{:?}", found.deviations);
}

/// A pendulum does not tell its mass from its damping alone, and one that nobody reads tells nothing.
#[test]
fn what_a_log_cannot_tell_is_named() {
    let text = r#"<mujoco><worldbody>
      <body name="a"><joint name="swing" axis="0 1 0" damping="0.1"/><geom size="0.05" pos="0 0 -0.3" mass="1"/></body>
      <body name="b" pos="1 0 0"><joint name="idle" axis="0 0 1" damping="0.1"/><geom size="0.05" mass="1"/></body>
    </worldbody><sensor><jointpos name="pos" joint="swing"/></sensor></mujoco>"#;
    let robot = Robot::new(text);
    let mut start = Data::new(&robot.model);
    start.state.qpos[0] = 1.0;
    let log = || robot.log_from(&start, robot.rows(&start, 3.0, 0, 3));
    let parameters = Quantity::choose("damping,a.mass", &robot.model).unwrap();
    let found = identify(&robot.model, &[log()], &parameters, &Options::default()).unwrap();
    let names =
        |d: &robohive_identify::Direction| d.parts.iter().map(|(name, _)| name.clone()).collect::<Vec<_>>();
    let named: Vec<_> = found.unknown.iter().map(names).collect();
    assert!(named.contains(&vec!["idle.damping".to_owned()]), "{named:?}");
    assert!(named.contains(&vec!["swing.damping".to_owned(), "a.mass".to_owned()]), "{named:?}");
    assert!(found.deviations.iter().all(|d| d.is_infinite()), "{:?}", found.deviations);
    let known: Vec<_> = parameters
        .into_iter()
        .map(|p| match p.quantity {
            Quantity::Mass => p.known(Prior { mean: 1.0, deviation: 0.01 }).unwrap(),
            _ => p,
        })
        .collect();
    let found = identify(&robot.model, &[log()], &known, &Options::default()).unwrap();
    assert!((found.values[0] - 0.1).abs() < 0.003, "{:?}", found.values);
    assert!(found.deviations[2].is_finite());
}

#[test]
fn any_number_of_threads_finds_the_same_bits() {
    let robot = Robot::new(robots::LEG);
    let (model, parameters) = (robot.disturbed(), Quantity::choose("damping", &robot.disturbed()).unwrap());
    let fit = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        let log = robot.log(0.5, 0, 8);
        pool.install(|| identify(&model, &[log], &parameters, &Options::default()).unwrap())
    };
    let (one, three) = (fit(1), fit(3));
    assert_eq!(one.values, three.values);
    assert_eq!(one.covariance, three.covariance);
}

#[test]
fn bounds_hold() {
    let robot = Robot::new(ARM);
    let (log, model) = (robot.log(1.0, 0, 4), robot.disturbed());
    let parameters = Quantity::choose("joint0.damping", &model).unwrap();
    // The true value is 1.2.
    let low = [parameters[0].clone().within(0.1, 0.7).unwrap()];
    let found = identify(&model, &[log], &low, &Options::default()).unwrap();
    assert_eq!(found.values, [0.7]);
    assert!(parameters[0].clone().within(2.0, 1.0).is_err());
}

#[test]
fn simulations_begin_anew_in_recorded_states_and_missing_readings_are_left_out() {
    let robot = Robot::new(ARM);
    let mut rows = robot.rows(&Data::new(&robot.model), 1.0, 0, 5);
    for at in [17, 401] {
        rows.readings[at] = f64::NAN;
    }
    let count = rows.times.len();
    let mut archive = std::io::Cursor::new(Vec::new());
    let mut writer = dataset::NpzWriter::new(&mut archive);
    let [qpos, qvel] = rows.states;
    for (name, values) in [
        ("time", rows.times),
        ("ctrl", rows.ctrl),
        ("qpos", qpos),
        ("qvel", qvel),
        ("sensordata", rows.readings),
    ] {
        let shape = if name == "time" { vec![count] } else { vec![count, values.len() / count] };
        writer.add(name, &dataset::Array::f64(shape, values)).unwrap();
    }
    writer.finish().unwrap();
    let archive = dataset::NpzReader::read(archive).unwrap();
    let model = robot.disturbed();
    let log = Log::of_archive("arm.npz", &archive, &model).unwrap();
    let parameters = Quantity::choose("damping,armature,frictionloss", &model).unwrap();
    let found = identify(&model, &[log], &parameters, &Options::default().with_window(0.25)).unwrap();
    near(&robot, &found, 3.5, 0.05);
    assert_eq!(found.curves[0].times.len(), count + 3);
}

#[test]
fn a_fit_is_written_into_the_description_and_reported() {
    let robot = Robot::new(ARM);
    let (log, model) = (robot.log(1.0, 0, 6), robot.disturbed());
    let parameters = Quantity::choose("damping,servo2.gain,link3.mass,delay", &model).unwrap();
    let found = identify(&model, &[log], &parameters, &Options::default().with_iterations(15)).unwrap();
    let mut spec = robot.spec();
    patched(&mut spec, &model, &found).unwrap();
    let again = mjcf::load_str(spec.to_xml().unwrap()).unwrap().model;
    for (p, value) in found.parameters.iter().zip(&found.values) {
        let read = match p.quantity {
            Quantity::Damping => again.dof_damping[p.element],
            Quantity::Gain => again.actuator_gainprm[p.element][0],
            Quantity::Mass => again.body_mass[p.element],
            _ => continue,
        };
        assert!((read - value).abs() <= 1e-12 * value.abs(), "{}: {read} {value}", p.name);
    }
    assert_eq!(again.actuator_biasprm[2][1], -again.actuator_gainprm[2][0]);
    let piece = fragment(&model, &found).unwrap();
    for part in [
        "<joint name=\"joint0\" damping=\"",
        "<general name=\"servo2\"",
        "<body name=\"link3\"><inertial mass=\"",
    ] {
        assert!(piece.contains(part), "{piece}");
    }
    let page = report("arm", &found);
    assert!(page.contains("link3.mass"));
    assert_eq!(page.matches("<svg").count(), 3 + found.columns.len());
}

/// Either sign of a quaternion is the same rotation.
#[test]
fn quaternions_are_compared_whatever_their_sign() {
    let robot = Robot::new(
        r#"<mujoco><worldbody><body name="a"><joint name="swing" axis="0 1 0" damping="0.1"/>
        <geom size="0.05" pos="0 0 -0.3" mass="1"/></body></worldbody>
        <sensor><framequat name="turn" objtype="body" objname="a"/></sensor></mujoco>"#,
    );
    let mut start = Data::new(&robot.model);
    start.state.qpos[0] = 1.0;
    let made = robot.rows(&start, 1.0, 0, 7);
    let turned = made.states[0].iter().enumerate().flat_map(|(row, q)| {
        let sign = if row % 3 == 0 { -1.0 } else { 1.0 };
        [sign * (q / 2.0).cos(), 0.0, sign * (q / 2.0).sin(), 0.0]
    });
    let log = robot.log_from(&start, robots::Rows { readings: turned.collect(), ..made });
    let model = robot.disturbed();
    let parameters = Quantity::choose("damping", &model).unwrap();
    let found = identify(&model, &[log], &parameters, &Options::default()).unwrap();
    assert!((found.values[0] - 0.1).abs() < 1e-6, "{:?}", found.values);
    assert!(found.noise.iter().all(|noise| *noise < 1e-6), "{:?}", found.noise);
}

#[test]
fn mistakes_are_named_with_the_way_out() {
    let robot = Robot::new(ARM);
    let said = |error: IdentifyError| error.to_string();
    for (words, part) in [
        ("dampin", "there are damping, frictionloss"),
        ("joint9.damping", "did you mean 'joint"),
        ("", "nothing is to be fitted"),
        ("servo1.mass", "no body 'servo1'"),
    ] {
        let text = said(Quantity::choose(words, &robot.model).unwrap_err());
        assert!(text.contains(part), "{text}");
    }
    let (start, nu, width) = (Data::new(&robot.model), robot.model.nu, robot.model.nsensordata);
    let log = |times: Vec<f64>, ctrl: usize, values: usize| {
        let readings = Readings::sensors(&robot.model, vec![0.0; values]);
        Log::of_arrays("log", times, &start, vec![0.0; ctrl], readings, &robot.model)
    };
    for (made, part) in [
        (log(vec![0.0, 0.1, 0.1], 3 * nu, 3 * width), "log, time: is 0.1 in row 2"),
        (log(vec![0.0, 0.1], nu, 2 * width), "log, ctrl: 7 numbers; 2 rows of 7"),
        (log(vec![0.0, 0.1], 2 * nu, width), "log, readings"),
        (log(vec![0.0], nu, width), "two are needed"),
    ] {
        let text = said(made.unwrap_err());
        assert!(text.contains(part), "{text}");
    }
    let text = said(log(vec![0.0, 0.1], 2 * nu, 2 * width).unwrap().only("torque*").unwrap_err());
    assert!(text.contains("torque*") && text.contains("pos0"), "{text}");
}
