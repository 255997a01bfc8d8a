//! Readings: range, noise, delay, jitter, history, and the way back into a state.

use physics::{Data, Model, forward, step};
use random::Generator;
use robohive_robot::{Compat, Config, Noise, Options, Robot};

const ARM: &str = "<mujoco><option gravity='0 0 0' timestep='0.01'/><worldbody>
    <body><joint name='slide' type='slide' axis='1 0 0'/><geom size='.1' mass='1'/>
      <body><joint name='hinge' axis='0 1 0'/><geom size='.1' mass='1'/></body></body></worldbody>
    <actuator><general name='m' joint='slide' dyntype='filter' dynprm='1'/></actuator>
    <sensor><jointpos name='x' joint='slide'/><jointvel name='v' joint='slide'/><jointpos name='q' joint='hinge'/></sensor>
    </mujoco>";

const CONFIG: &str = "
    [[device]]
    name = 'arm'
    sensor = [{ name = 'x', range = [-1, 1], noise = 0.1 }, { name = 'v', range = [-2, 2], noise = 0 }]
    [[device]]
    name = 'watched'
    sensor = [{ name = 'q', range = [0, 0.5], noise = 0.01 }]";

fn model() -> Model {
    robohive_mjcf::load_str(ARM).unwrap().model
}

fn robot(model: &Model, options: Options) -> Robot {
    Robot::new(model, Some(&Config::from_toml(CONFIG, "arm.toml").unwrap()), options).unwrap()
}

/// A state after a forward pass.
fn at(model: &Model, time: f64, qpos: [f64; 2], qvel: [f64; 2]) -> Data {
    let mut data = Data::new(model);
    data.state.time = time;
    data.state.qpos.copy_from_slice(&qpos);
    data.state.qvel.copy_from_slice(&qvel);
    forward(model, &mut data).unwrap();
    data
}

#[test]
fn readings_are_clipped_and_stamped() {
    let model = model();
    let mut robot = robot(&model, Options::default());
    let mut rng = Generator::pcg64(1_u64);
    let before = rng.clone();
    let readings = robot.sense(&model, &at(&model, 3.5, [0.25, 0.75], [-7.0, 0.0]), &mut rng).clone();
    assert_eq!(readings.values, [0.25, -2.0, 0.5]);
    assert_eq!((readings.time, &readings.stamps[..]), (3.5, &[3.5, 3.5][..]));
    assert_eq!(rng, before, "nothing is drawn without noise");
    assert_eq!(robot.values_of("watched", &readings), Some(&[0.5][..]));
    assert_eq!(robot.values_of("camera", &readings), None);
    assert_eq!(robot.sensors().collect::<Vec<_>>(), ["x", "v", "q"]);
    assert_eq!(robot.devices().collect::<Vec<_>>(), ["arm", "watched"]);
}

#[test]
fn uniform_noise_draws_once_a_sensor_after_clipping() {
    let model = model();
    let mut robot = robot(&model, Options::default().with_noise_scale(2.0));
    let data = at(&model, 0.0, [5.0, 0.25], [0.0, 0.0]);
    let (mut rng, mut same) = (Generator::pcg64(7_u64), Generator::pcg64(7_u64));
    for _ in 0..100 {
        let values = robot.sense(&model, &data, &mut rng).values.clone();
        let draws: [f64; 3] = std::array::from_fn(|_| same.uniform(-1.0, 1.0).unwrap());
        assert_eq!(values, [1.0 + 0.2 * draws[0], 0.0 * draws[1], 0.25 + 0.02 * draws[2]]);
    }
    assert_eq!(rng, same);
}

#[test]
fn gaussian_noise_has_the_standard_deviation_of_the_config() {
    let model = model();
    let options = Options::default().with_noise_scale(1.0).with_noise(Noise::Gaussian);
    let mut robot = robot(&model, options);
    let data = at(&model, 0.0, [0.5, 0.25], [0.0, 0.0]);
    let mut rng = Generator::pcg64(7_u64);
    let draws: Vec<f64> = (0..4000).map(|_| robot.sense(&model, &data, &mut rng).values[0] - 0.5).collect();
    let mean = draws.iter().sum::<f64>() / 4000.0;
    let deviation = (draws.iter().map(|x| x * x).sum::<f64>() / 4000.0).sqrt();
    // Five standard errors of either.
    assert!(mean.abs() < 5.0 * 0.1 / 4000_f64.sqrt(), "{mean}");
    assert!((deviation - 0.1).abs() < 5.0 * 0.1 / 8000_f64.sqrt(), "{deviation}");
    assert!(draws.iter().any(|x| x.abs() > 0.2), "beyond any uniform draw of that scale");
}

#[test]
fn equal_seeds_give_equal_readings() {
    let model = model();
    let options = Options::default().with_noise_scale(1.0).with_delay_steps(1).with_jitter_steps(2);
    let run = |seed: u64| {
        let (mut robot, mut rng) = (robot(&model, options.clone()), Generator::pcg64(seed));
        let mut data = at(&model, 0.0, [0.0, 0.25], [1.0, 0.0]);
        robot.reset(&model, &data, &mut rng).unwrap();
        let mut seen = Vec::new();
        for _ in 0..50 {
            step(&model, &mut data).unwrap();
            seen.push(robot.sense(&model, &data, &mut rng).clone());
        }
        seen
    };
    assert_eq!(run(3), run(3));
    assert_ne!(run(3), run(4));
}

/// Times of readings over control periods of `skip` steps at 1 m/s, with every step tracked or not.
fn times(options: Options, skip: usize, tracked: bool) -> Vec<f64> {
    let model = model();
    let (mut robot, mut rng) = (robot(&model, options), Generator::pcg64(5_u64));
    let mut data = at(&model, 0.0, [0.0, 0.25], [0.5, 0.0]);
    robot.reset(&model, &data, &mut rng).unwrap();
    let mut times = Vec::new();
    for _ in 0..20 {
        for _ in 0..skip {
            step(&model, &mut data).unwrap();
            forward(&model, &mut data).unwrap();
            if tracked {
                robot.track(&data);
            }
        }
        let readings = robot.sense(&model, &data, &mut rng);
        assert!(
            (readings.values[0] - 0.5 * readings.time).abs() < 1e-12,
            "values of the time that is stated"
        );
        assert_eq!(readings.stamps, [readings.time; 2]);
        times.push((data.time() - readings.time) / 0.01);
    }
    times
}

/// Nearest whole number, which `x` is but for rounding.
fn whole(x: f64) -> usize {
    assert!((x - x.round()).abs() < 1e-9, "{x}");
    x.round() as usize
}

#[test]
fn delayed_readings_have_the_age_that_was_asked_for() {
    let delayed = |delay_steps| Options::default().with_delay_steps(delay_steps);
    for delay in [0, 1, 3, 7] {
        let ages: Vec<_> = times(delayed(delay), 4, true).into_iter().map(whole).collect();
        let expected: Vec<_> = (1..=20).map(|period| (4 * period).min(delay)).collect();
        assert_eq!(ages, expected, "delay {delay}");
    }
    // Untracked readings are taken at control periods, at least as old as asked for.
    let ages: Vec<_> = times(delayed(3), 4, false).into_iter().map(whole).collect();
    assert_eq!(ages, [4; 20]);
    assert!(!robot(&model(), Options::default()).tracks_steps());
    assert!(robot(&model(), delayed(1)).tracks_steps());
}

#[test]
fn jitter_varies_the_age_and_never_turns_back_time() {
    let options = Options::default().with_delay_steps(2).with_jitter_steps(6);
    let ages: Vec<_> = times(options, 4, true).into_iter().map(whole).collect();
    assert!(ages[2..].iter().all(|age| (2..=8).contains(age)), "{ages:?}");
    assert!(ages[2..].iter().any(|age| *age != ages[2]), "{ages:?}");
    let measured: Vec<_> = ages.iter().enumerate().map(|(period, age)| 4 * (period + 1) - age).collect();
    assert!(measured.is_sorted(), "{measured:?}");
}

#[test]
fn a_reset_forgets_what_was_measured_before() {
    let model = model();
    let (mut robot, mut rng) =
        (robot(&model, Options::default().with_delay_steps(5)), Generator::pcg64(5_u64));
    let mut data = at(&model, 0.0, [0.0, 0.25], [0.5, 0.0]);
    for _ in 0..20 {
        robot.sense(&model, &data, &mut rng);
        step(&model, &mut data).unwrap();
    }
    let start = at(&model, 0.0, [0.75, 0.25], [0.0, 0.0]);
    assert_eq!(robot.reset(&model, &start, &mut rng).unwrap().values[0], 0.75);
    assert!((0..5).all(|age| robot.past(age).unwrap().values[0] == 0.75));
    // A clock that went back does the same.
    robot.sense(&model, &at(&model, 1.0, [0.5, 0.25], [0.0, 0.0]), &mut rng);
    let readings = robot.sense(&model, &at(&model, 0.5, [0.125, 0.25], [0.0, 0.0]), &mut rng);
    assert_eq!((readings.time, readings.values[0]), (0.5, 0.125));
}

#[test]
fn the_history_holds_the_last_readings() {
    let model = model();
    let (mut robot, mut rng) = (robot(&model, Options::default().with_history(3)), Generator::pcg64(5_u64));
    for k in 0..5 {
        robot.sense(&model, &at(&model, f64::from(k), [0.125 * f64::from(k), 0.25], [0.0, 0.0]), &mut rng);
    }
    let past: Vec<_> =
        (0..3).map(|age| (robot.past(age).unwrap().time, robot.past(age).unwrap().values[0])).collect();
    assert_eq!(past, [(4.0, 0.5), (3.0, 0.375), (2.0, 0.25)]);
    assert_eq!(robot.past(3), None);
    assert_eq!(robot.readings(), robot.past(0).unwrap());
}

#[test]
fn a_reset_draws_noise_for_each_reading_of_the_history() {
    let model = model();
    let mut robot = robot(&model, Options::default().with_noise_scale(1.0));
    let (mut rng, mut same) = (Generator::pcg64(9_u64), Generator::pcg64(9_u64));
    robot.reset(&model, &at(&model, 0.0, [0.0, 0.25], [0.0, 0.0]), &mut rng).unwrap();
    // RoboHive's order: five readings of three sensors.
    for age in (0..5).rev() {
        let draws: [f64; 3] = std::array::from_fn(|_| same.uniform(-1.0, 1.0).unwrap());
        assert_eq!(robot.past(age).unwrap().values[0], 0.1 * draws[0]);
    }
    assert_eq!(rng, same);
}

#[test]
fn readings_are_written_where_they_belong() {
    let model = model();
    let mut robot = robot(&model, Options::default().with_compat(Compat::RoboHive07));
    let truth = at(&model, 1.5, [0.25, 0.75], [-7.0, 3.0]);
    robot.sense(&model, &truth, &mut Generator::pcg64(1_u64));
    let mut observed = at(&model, 0.0, [9.0, 9.0], [9.0, 9.0]);
    assert!(robot.write_readings(&mut observed));
    assert_eq!(observed.state.qpos, [0.25, 0.5]);
    assert_eq!(observed.state.qvel, [-2.0, 9.0]);
    assert_eq!(observed.time(), 1.5);
    assert!(!robot.write_readings(&mut observed), "the second time nothing differs");
}

#[test]
fn without_a_config_the_whole_state_is_read() {
    let model = model();
    let mut robot = Robot::new(&model, None, Options::default().with_noise_scale(1.0)).unwrap();
    let mut truth = at(&model, 1.5, [5.0, 0.75], [-7.0, 3.0]);
    truth.state.act[0] = 0.5;
    let mut rng = Generator::pcg64(1_u64);
    let before = rng.clone();
    let readings = robot.reset(&model, &truth, &mut rng).unwrap();
    assert_eq!((readings.time, &readings.values[..]), (1.5, &[5.0, 0.75, -7.0, 3.0, 0.5][..]));
    assert_eq!(rng, before, "exact readings draw nothing");
    assert_eq!(robot.devices().collect::<Vec<_>>(), ["default_robot"]);
    let mut observed = Data::new(&model);
    assert!(robot.write_readings(&mut observed));
    assert_eq!((&observed.state.qpos, &observed.state.qvel), (&truth.state.qpos, &truth.state.qvel));
    assert_eq!(observed.state.act, [0.5]);
    assert!(!robot.write_readings(&mut truth));
}
