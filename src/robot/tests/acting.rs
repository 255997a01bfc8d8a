//! Actions: modes, limits, and what is refused.

use physics::{Data, Model, forward, step};
use robohive_robot::{ActionMode, Compat, Config, Options, Part, QUIRKS, Quirk, Robot, RobotError, Space};
use std::str::FromStr;

/// A ball joint before two hinges with a servo and a motor, and a sensor of three values before theirs.
const ARM: &str = "<mujoco><option gravity='0 0 0'/><worldbody>
    <body><joint name='ball' type='ball'/><geom size='.1' mass='1'/><site name='s'/>
      <body pos='1 0 0'><joint name='shoulder' axis='0 1 0'/><geom size='.1' mass='1'/>
        <body pos='1 0 0'><joint name='elbow' axis='0 1 0'/><geom size='.1' mass='1'/></body></body></body>
    </worldbody>
    <actuator><position name='servo' joint='shoulder' kp='50' kv='2' ctrlrange='-3 3'/>
      <motor name='motor' joint='elbow' gear='4' ctrlrange='-2 2'/>
      <motor name='free' joint='elbow'/><motor name='spare' joint='elbow' ctrlrange='0 2'/></actuator>
    <sensor><gyro name='gyro' site='s'/><jointpos name='q1' joint='shoulder'/><jointpos name='q2' joint='elbow'/>
      <jointvel name='v2' joint='elbow'/></sensor></mujoco>";

const CONFIG: &str = "
    [[device]]
    name = 'arm'
    sensor = [{ name = 'q1', range = [-1, 1], hdr_id = 10, scale = -1, offset = 0.5 },
              { name = 'q2', range = [-1, 1], hdr_id = 11, scale = 2 }]
    actuator = [{ name = 'motor', pos_range = [-1, 1], vel_range = [-2, 4], hdr_id = 1, scale = 2, offset = 1 },
                { name = 'servo', pos_range = [-1, 2], vel_range = [-1, 1], hdr_id = -1 }]";

fn arm() -> (Model, Data) {
    let model = robohive_mjcf::load_str(ARM).unwrap().model;
    let mut data = Data::new(&model);
    // The ball joint has 4 positions and 3 degrees of freedom.
    data.state.qpos[4..].copy_from_slice(&[0.3, -0.2]);
    data.state.qvel[3..].copy_from_slice(&[0.5, -0.5]);
    forward(&model, &mut data).unwrap();
    (model, data)
}

fn config() -> Config {
    Config::from_toml(CONFIG, "arm.toml").unwrap()
}

fn robot(model: &Model, options: Options) -> Robot {
    Robot::new(model, Some(&config()), options).unwrap()
}

fn controls(options: Options, action: [f64; 4]) -> Vec<f64> {
    let (model, data) = arm();
    robot(&model, options).control(&model, &data, &action, 0.1).unwrap().to_vec()
}

#[test]
fn positions_are_limited_in_rate_and_range() {
    // The servo is at 0.3, may move by 0.1; the motor's joint is at -0.2, may move by -0.2 and 0.4.
    assert_eq!(controls(Options::default(), [1.0, 1.0, 0.0, 0.0])[..2], [0.4, 0.2]);
    assert_eq!(controls(Options::default(), [-1.0, -1.0, 0.0, 0.0])[..2], [0.3 - 0.1, -0.4]);
    let exact = Options::default().with_normalized(false);
    assert_eq!(controls(exact, [0.25, -0.25, 0.0, 0.0])[..2], [0.25, -0.25]);
}

#[test]
fn velocities_move_the_command_from_where_the_joint_is() {
    let options = Options::default().with_mode(ActionMode::Velocity);
    // Half of the range from -2 to 4 above its middle: 2.5.
    assert_eq!(controls(options.clone(), [0.5, 0.5, 0.0, 0.0])[..2], [0.3 + 0.05, -0.2 + 0.25]);
    let exact = options.with_normalized(false);
    assert_eq!(controls(exact, [0.5, 100.0, 0.0, 0.0])[..2], [0.35, 1.0]);
}

#[test]
fn actuators_that_the_config_does_not_list_are_normalised_by_their_own_range() {
    // One without range takes the action; RoboHive passes every one on.
    assert_eq!(controls(Options::default(), [0.0, 0.0, 0.7, 0.5])[2..], [0.7, 1.5]);
    let options = Options::default().with_normalized(false);
    assert_eq!(controls(options, [0.0, 0.0, 0.7, 0.5])[2..], [0.7, 0.5]);
    let options = Options::default().with_compat(Compat::RoboHive07);
    assert_eq!(controls(options, [0.0, 0.0, 0.7, 0.5])[2..], [0.7, 0.5]);
}

#[test]
fn without_a_config_every_actuator_is_normalised_by_its_own_range() {
    let (model, data) = arm();
    let control = |compat| {
        let mut robot = Robot::new(&model, None, Options::default().with_compat(compat)).unwrap();
        robot.control(&model, &data, &[0.5, -0.5, 0.7, 0.5], 0.1).unwrap().to_vec()
    };
    assert_eq!(control(Compat::Fixed), [1.5, -1.0, 0.7, 1.5]);
    assert_eq!(control(Compat::RoboHive07), [1.5, -1.0, 0.0, 1.5]);
}

#[test]
fn the_original_mistakes_the_address_of_joints_behind_a_ball() {
    // It reads the shoulder's position, 0.3, where the elbow's degree of freedom, 4, points.
    let options = Options::default().with_compat(Compat::RoboHive07);
    assert_eq!(controls(options, [0.0, 1.0, 0.0, 0.0])[1], 0.3 + 0.4);
    let (model, mut data) = arm();
    let mut rng = random::Generator::pcg64(0_u64);
    data.sensor.sensordata.copy_from_slice(&[0.1, 0.2, 0.3, 0.4, 0.5, 0.6]);
    let mut sense = |compat| {
        let mut robot = robot(&model, Options::default().with_compat(compat));
        robot.sense(&model, &data, &mut rng).values.clone()
    };
    assert_eq!(sense(Compat::Fixed), [0.4, 0.5]);
    assert_eq!(sense(Compat::RoboHive07), [0.2, 0.3]);
}

#[test]
fn torques_are_what_the_joints_get() {
    let (model, mut data) = arm();
    let text = CONFIG.replace("vel_range = [-1, 1]", "vel_range = [-1, 1], effort_range = [-6, 10]");
    let config = Config::from_toml(&text, "arm.toml").unwrap();
    let options = Options::default().with_mode(ActionMode::Torque);
    let mut robot = Robot::new(&model, Some(&config), options).unwrap();
    // Half above the middle of the servo's range of -6 to 10; the motor's range is its control range times its gear.
    let controls = robot.control(&model, &data, &[0.5, -0.25, 0.0, -1.0], 0.1).unwrap();
    data.state.ctrl.copy_from_slice(controls);
    forward(&model, &mut data).unwrap();
    let torque = &data.actuation.qfrc_actuator[3..];
    assert!((torque[0] - 6.0).abs() < 1e-12 && (torque[1] + 2.0).abs() < 1e-12, "{torque:?}");

    // A motor's torque holds while the joint moves.
    for _ in 0..20 {
        step(&model, &mut data).unwrap();
    }
    assert!(data.state.qvel[4].abs() > 0.05);
    forward(&model, &mut data).unwrap();
    assert!((data.actuation.qfrc_actuator[4] + 2.0).abs() < 1e-12);

    let (model, data) = arm();
    let mut action = [0.5, -0.25, 0.0, 0.0];
    robot.unnormalize(&model, &mut action).unwrap();
    assert_eq!(action[..2], [6.0, -2.0]);
    robot.normalize(&model, &mut action).unwrap();
    assert_eq!(action[..2], [0.5, -0.25]);
    let exact = Options::default().with_mode(ActionMode::Torque).with_normalized(false);
    let mut robot = Robot::new(&model, Some(&config), exact).unwrap();
    let limited = robot.control(&model, &data, &[1e3, -1e3, 0.0, 0.0], 0.1).unwrap();
    // (10 + 50 · 0.3 + 2 · 0.5) / 50 and -8 / 4.
    assert!((limited[0] - 0.52).abs() < 1e-12 && limited[1] == -2.0, "{limited:?}");
}

#[test]
fn effort_limits_bound_positions_too() {
    let text = CONFIG.replace("vel_range = [-1, 1]", "vel_range = [-9, 9], effort_range = [-1, 2]");
    let config = Config::from_toml(&text, "arm.toml").unwrap();
    let (model, mut data) = arm();
    let mut robot = Robot::new(&model, Some(&config), Options::default()).unwrap();
    for (action, torque) in [(1.0, 2.0), (-1.0, -1.0)] {
        let controls = robot.control(&model, &data, &[action, 0.0, 0.0, 0.0], 0.1).unwrap().to_vec();
        data.state.ctrl.copy_from_slice(&controls);
        forward(&model, &mut data).unwrap();
        assert!((data.actuation.qfrc_actuator[3] - torque).abs() < 1e-12, "{controls:?}");
    }
    // Within the limits nothing changes: 0.3 is held with 1 N m against the velocity.
    let inside = robot.control(&model, &data, &[-0.4 / 3.0, 0.0, 0.0, 0.0], 0.1).unwrap()[0];
    assert!((inside - 0.3).abs() < 1e-15);
}

#[test]
fn modes_that_lack_something_are_refused() {
    let (model, _) = arm();
    for mode in [ActionMode::Velocity, ActionMode::Torque] {
        let error = Robot::new(&model, None, Options::default().with_mode(mode)).err().unwrap().to_string();
        assert!(error.starts_with(&format!("actions in mode '{mode}': a robot without config")), "{error}");
    }
    let torque = Options::default().with_mode(ActionMode::Torque);
    let error = Robot::new(&model, Some(&config()), torque.clone()).err().unwrap().to_string();
    assert_eq!(
        error,
        "actions in mode 'torque': actuator 'servo' has no limits of torque; its config can have an `effort_range`"
    );
    let muscle = ARM.replace(
        "<motor name='motor' joint='elbow' gear='4' ctrlrange='-2 2'/>",
        "<muscle name='motor' joint='elbow' lengthrange='0 1'/>",
    );
    let model = robohive_mjcf::load_str(&muscle).unwrap().model;
    let error = Robot::new(&model, Some(&config()), torque).err().unwrap().to_string();
    assert!(
        error.ends_with("actuator 'motor' does not follow from its control: it has activation dynamics"),
        "{error}"
    );
}

#[test]
fn actions_that_are_none_are_refused() {
    let (model, data) = arm();
    let mut robot = robot(&model, Options::default());
    let mut refused = |action: &[f64], duration| robot.control(&model, &data, action, duration).unwrap_err();
    assert_eq!(refused(&[0.0; 3], 0.1), RobotError::Length { what: "an action", given: 3, expected: 4 });
    assert_eq!(
        refused(&[0.0, f64::NAN, 0.0, 0.0], 0.1).to_string(),
        "action 1, of actuator 'motor', is NaN; it must be finite"
    );
    assert!(matches!(refused(&[0.0, 0.0, f64::INFINITY, 0.0], 0.1), RobotError::BadAction { index: 2, .. }));
    for duration in [0.0, -0.1, f64::NAN, f64::INFINITY] {
        assert!(matches!(refused(&[0.0; 4], duration), RobotError::BadDuration(_)));
    }
    assert_eq!(robot.last_control(), [0.0; 4]);
    assert_eq!(robot.action_len(), 4);
    let wrong = RobotError::Length { what: "an action", given: 1, expected: 4 };
    assert_eq!(robot.normalize(&model, &mut [0.0]), Err(wrong.clone()));
    assert_eq!(robot.unnormalize(&model, &mut [0.0]), Err(wrong));
}

#[test]
fn configs_of_another_robot_are_refused_by_name() {
    let (model, _) = arm();
    let refused = |text: &str| {
        let config = Config::from_toml(text, "arm.toml").unwrap();
        Robot::new(&model, Some(&config), Options::default()).err().unwrap().to_string()
    };
    assert_eq!(
        refused(&CONFIG.replace("'q2'", "'p2'")),
        "device 'arm': the model has no sensor 'p2'; did you mean 'q2'?"
    );
    assert_eq!(
        refused(&CONFIG.replace("'servo'", "'servos'").replace("'motor'", "'panda0_joint1'")),
        "device 'arm': the model has no actuator 'panda0_joint1' (2 of the config's 4 names are not in the model)"
    );
    let foreign =
        CONFIG.replace("'q", "'fr_arm_jp").replace("'servo'", "'x9'").replace("'motor'", "'panda0_joint1'");
    assert_eq!(
        refused(&foreign),
        "device 'arm': the model has no sensor 'fr_arm_jp1' (4 of the config's 4 names are not in the model: a config \
         of another robot?)"
    );
    assert_eq!(
        refused(&CONFIG.replace("'q2'", "'gyro'")),
        "device 'arm': sensor 'gyro' is of kind gyro; a robot reads jointpos, jointvel, and components of framepos and \
         framequat of a body with a free joint, as name[0]"
    );
    let tendon = ARM.replace("joint='elbow' gear='4'", "site='s' gear='4 0 0 0 0 0'");
    let model = robohive_mjcf::load_str(&tendon).unwrap().model;
    assert_eq!(
        Robot::new(&model, Some(&config()), Options::default()).err().unwrap().to_string(),
        "device 'arm': actuator 'motor' pulls on something of kind site; a robot commands actuators of joints"
    );
}

#[test]
fn reset_poses_are_clipped_to_what_the_devices_can_have() {
    let (model, _) = arm();
    let passive = CONFIG.to_owned()
        + "\n[[device]]\nname = 'watched'\nsensor = [{ name = 'v2', range = [-0.25, 0.25] }, { name = 'q2', range = [-0.5, 0.5] }]";
    let config = Config::from_toml(&passive, "arm.toml").unwrap();
    let clip = |compat| {
        let robot = Robot::new(&model, Some(&config), Options::default().with_compat(compat)).unwrap();
        let (mut qpos, mut qvel) = ([9.0; 6], [9.0; 5]);
        robot.clip_reset(&mut qpos, &mut qvel);
        (qpos, qvel)
    };
    // Of the arm, the actuators' ranges count; of what is only watched, the sensors'.
    assert_eq!(clip(Compat::Fixed), ([9.0, 9.0, 9.0, 9.0, 2.0, 0.5], [9.0, 9.0, 9.0, 9.0, 0.25]));
    assert_eq!(clip(Compat::RoboHive07), ([9.0, 9.0, 9.0, 2.0, 1.0, 0.5], [9.0, 9.0, 9.0, 9.0, 0.25]));
    let robot = Robot::new(&model, None, Options::default()).unwrap();
    let (mut qpos, mut qvel) = ([9.0; 6], [9.0; 5]);
    robot.clip_reset(&mut qpos, &mut qvel);
    assert_eq!((qpos, qvel), ([9.0; 6], [9.0; 5]));
}

#[test]
fn vectors_go_to_the_hardware_and_back() {
    let (model, _) = arm();
    let fixed = robot(&model, Options::default());
    let (simulation, hardware) = (Space::Simulation, Space::Hardware);
    let commands = [0.125, 0.25, 0.5, 0.75];
    let sent = fixed.remap(&commands, Part::Actuator, simulation, hardware).unwrap();
    assert_eq!(sent, [1.5, 0.125]);
    assert_eq!(fixed.remap(&sent, Part::Actuator, hardware, simulation).unwrap(), [0.125, 0.25, 0.0, 0.0]);
    let read = fixed.remap(&[0.25, 0.5], Part::Sensor, hardware, simulation).unwrap();
    assert_eq!(read, [0.0, 0.0, 0.0, 0.25, 1.0, 0.0]);
    assert_eq!(fixed.remap(&read, Part::Sensor, simulation, hardware).unwrap(), [0.25, 0.5]);

    // The original: the motor's number is 1, the servo's is -1, the last of the vector.
    let original = robot(&model, Options::default().with_compat(Compat::RoboHive07));
    let sent = original.remap(&commands, Part::Actuator, simulation, hardware).unwrap();
    assert_eq!(sent, [0.125, 1.5, 0.5, 0.125]);
    assert_eq!(
        original.remap(&[0.0; 6], Part::Sensor, simulation, hardware).unwrap_err().to_string(),
        "the hdr_id of 'q1' is no place in a vector of 6 numbers"
    );
    let error = fixed.remap(&commands, Part::Actuator, hardware, simulation).unwrap_err();
    assert_eq!(error.to_string(), "4 numbers where a vector of this space has 2");
    assert_eq!(fixed.remap(&commands, Part::Actuator, hardware, hardware), Err(RobotError::SameSpace));
}

#[test]
fn single_precision_rounds_controls() {
    let options = Options::default().with_single_precision(true);
    let rounded = controls(options, [0.1, 0.1, 0.7, 0.1]);
    let exact = controls(Options::default(), [0.1, 0.1, 0.7, 0.1]);
    assert_ne!(rounded, exact);
    assert!(rounded.iter().zip(&exact).all(|(r, e)| *r == f64::from(*e as f32)));
}

#[test]
fn names_of_modes_and_compatibilities_are_read_and_written() {
    for mode in [ActionMode::Position, ActionMode::Velocity, ActionMode::Torque] {
        assert_eq!(ActionMode::from_str(&mode.to_string()), Ok(mode));
    }
    for compat in [Compat::Fixed, Compat::RoboHive07] {
        assert_eq!(Compat::from_str(&compat.to_string()), Ok(compat));
    }
    assert_eq!(Compat::from_str("robohive-0.7"), Ok(Compat::RoboHive07));
    assert_eq!(
        Compat::from_str("0.7").unwrap_err().to_string(),
        "no compatibility '0.7'; there are 'fixed' and 'robohive-0.7'"
    );
    assert_eq!(
        ActionMode::from_str("force").unwrap_err().to_string(),
        "no action mode 'force'; there are 'pos', 'vel' and 'torque'"
    );
}

#[test]
fn quirks_have_names_of_their_own_and_say_both_sides() {
    let names: std::collections::BTreeSet<_> = QUIRKS.iter().map(|quirk| quirk.name).collect();
    assert_eq!(names.len(), QUIRKS.len());
    assert!(QUIRKS.iter().all(|quirk| !quirk.original.is_empty() && !quirk.fixed.is_empty()));
    let table = Quirk::table(QUIRKS);
    assert_eq!(table.lines().count(), QUIRKS.len() + 2);
    assert!(table.lines().all(|row| row.matches('|').count() == 5), "{table}");
    assert!(QUIRKS.iter().any(|quirk| quirk.reproduced) && QUIRKS.iter().any(|quirk| !quirk.reproduced));
}

#[test]
fn options_that_make_no_sense_are_refused() {
    let (model, _) = arm();
    for (options, name) in [
        (Options::default().with_noise_scale(-1.0), "noise_scale"),
        (Options::default().with_noise_scale(f64::NAN), "noise_scale"),
        (Options::default().with_history(0), "history"),
        (Options::default().with_history(usize::MAX), "history"),
        (Options::default().with_delay_steps(usize::MAX).with_jitter_steps(1), "delay_steps"),
        (Options::default().with_jitter_steps(1 << 20), "jitter_steps"),
    ] {
        let error = Robot::new(&model, None, options).err().unwrap();
        assert!(matches!(&error, RobotError::Option { name: found, .. } if *found == name), "{error}");
    }
}
