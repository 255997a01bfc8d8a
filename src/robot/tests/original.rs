//! What RoboHive 0.7's own robot made of the same actions and sensors, as validation/reference/robot.py recorded it: the
//! numbers are equal to the last bit under `Compat::RoboHive07`.

use physics::{Data, Model};
use random::Generator;
use robohive_robot::{
    ActionMode, ActuatorConfig, Compat, Config, DeviceConfig, HardwareId, Options, Robot, SensorConfig,
};
use std::collections::BTreeMap;
use std::fmt::Write;

const RECORDED: &str = include_str!("original.txt");

/// One environment of the original.
#[derive(Default)]
struct Case {
    name: String,
    mode: ActionMode,
    duration: f64,
    positions: usize,
    sensordata: usize,
    limits: Vec<[f64; 2]>,
    /// Joint that each listed actuator moves.
    actuators: Vec<(usize, ActuatorConfig)>,
    sensors: Vec<SensorConfig>,
    /// Named vectors, two of each.
    vectors: BTreeMap<String, Vec<Vec<f64>>>,
}

fn cases() -> Vec<Case> {
    let mut cases: Vec<Case> = Vec::new();
    for line in RECORDED.lines() {
        let (key, rest) = line.split_once(' ').unwrap();
        let words: Vec<_> = rest.split(' ').collect();
        if key == "case" {
            let [name, mode, duration, positions, _, sensordata] = words[..] else { panic!("{line}") };
            cases.push(Case {
                name: name.to_owned(),
                mode: mode.parse().unwrap(),
                duration: duration.parse().unwrap(),
                positions: positions.parse().unwrap(),
                sensordata: sensordata.parse().unwrap(),
                ..Case::default()
            });
            continue;
        }
        let case = cases.last_mut().unwrap();
        let numbers: Vec<f64> = words.iter().map(|word| word.parse().unwrap()).collect();
        match (key, &numbers[..]) {
            ("limits", &[low, high]) => case.limits.push([low, high]),
            ("actuator", &[control, joint, low, high, slowest, fastest]) => {
                case.actuators.push((joint as usize, actuator(control, [low, high], [slowest, fastest])));
            }
            ("sensor", &[id, low, high, noise]) => case.sensors.push(sensor(id, [low, high], noise)),
            _ => case.vectors.entry(key.to_owned()).or_default().push(numbers),
        }
    }
    cases
}

fn actuator(control: f64, position_range: [f64; 2], velocity_range: [f64; 2]) -> ActuatorConfig {
    ActuatorConfig {
        name: format!("a{control}"),
        position_range,
        velocity_range,
        effort_range: None,
        mode: None,
        hardware: HardwareId::Number(0),
        scale: 1.0,
        offset: 0.0,
    }
}

fn sensor(id: f64, range: [f64; 2], noise: f64) -> SensorConfig {
    SensorConfig {
        name: format!("s{id}"),
        range,
        noise,
        hardware: HardwareId::Number(0),
        scale: 1.0,
        offset: 0.0,
    }
}

impl Case {
    fn config(&self) -> Option<Config> {
        (!self.actuators.is_empty()).then(|| Config {
            devices: vec![DeviceConfig {
                name: "robot".to_owned(),
                sensors: self.sensors.clone(),
                actuators: self.actuators.iter().map(|(_, row)| row.clone()).collect(),
                ..DeviceConfig::default()
            }],
        })
    }

    /// A model with the same numbers of positions, actuators and sensors: hinges all along.
    fn model(&self) -> Model {
        let (mut bodies, mut actuators, mut sensors) = (String::new(), String::new(), String::new());
        for joint in 0..self.positions {
            write!(bodies, "<body><joint name='j{joint}' axis='0 1 0'/><geom size='.1'/></body>").unwrap();
        }
        for (control, [low, high]) in self.limits.iter().enumerate() {
            let named = format!("a{control}");
            let listed = self.actuators.iter().find(|(_, row)| row.name == named);
            let joint = listed.map_or(0, |(joint, _)| *joint);
            write!(actuators, "<motor name='{named}' joint='j{joint}' ctrlrange='{low} {high}'/>").unwrap();
        }
        for id in 0..self.sensordata {
            write!(sensors, "<jointpos name='s{id}' joint='j{}'/>", id % self.positions).unwrap();
        }
        let text = format!(
            "<mujoco><worldbody>{bodies}</worldbody><actuator>{actuators}</actuator><sensor>{sensors}</sensor></mujoco>"
        );
        robohive_mjcf::load_str(&text).unwrap().model
    }

    fn robot(&self, model: &Model, compat: Compat, normalized: bool) -> Robot {
        let options = Options::default()
            .with_mode(self.mode)
            .with_normalized(normalized)
            .with_noise_scale(2.0)
            .with_compat(compat);
        Robot::new(model, self.config().as_ref(), options).unwrap()
    }

    fn vector(&self, key: &str, row: usize) -> &[f64] {
        &self.vectors[key][row]
    }
}

#[test]
fn seven_environments_of_both_kinds_are_recorded() {
    let cases = cases();
    assert_eq!(cases.len(), 7);
    assert_eq!(cases.iter().filter(|case| case.config().is_none()).count(), 1);
    assert_eq!(cases.iter().filter(|case| case.mode == ActionMode::Velocity).count(), 1);
    assert!(cases.iter().any(|case| (1..case.limits.len()).contains(&case.actuators.len())));
}

#[test]
fn controls_are_the_originals() {
    for case in cases() {
        let model = case.model();
        let mut data = Data::new(&model);
        for (normalized, key) in [(true, "control"), (false, "raw")] {
            let mut robot = case.robot(&model, Compat::RoboHive07, normalized);
            for row in 0..2 {
                data.state.qpos.copy_from_slice(case.vector("qpos", row));
                let controls = robot.control(&model, &data, case.vector("action", row), case.duration);
                assert_eq!(controls.unwrap(), case.vector(key, row), "{} {key}", case.name);
                assert_eq!(robot.last_control(), case.vector(key, row));
            }
        }
    }
}

#[test]
fn fixed_controls_differ_only_where_the_original_does_not_normalise() {
    for case in cases() {
        let model = case.model();
        let mut data = Data::new(&model);
        let mut robot = case.robot(&model, Compat::Fixed, true);
        data.state.qpos.copy_from_slice(case.vector("qpos", 0));
        let action = case.vector("action", 0);
        let controls = robot.control(&model, &data, action, case.duration).unwrap();
        let listed: Vec<_> = case.actuators.iter().map(|(_, row)| row.name[1..].parse().unwrap()).collect();
        for (k, &control) in controls.iter().enumerate() {
            if case.config().is_none() || listed.contains(&k) {
                assert_eq!(control, case.vector("control", 0)[k]);
            } else {
                let [low, high] = case.limits[k];
                assert_eq!(control, (high + low) / 2.0 + action[k] * (high - low) / 2.0);
                assert_eq!(case.vector("control", 0)[k], action[k]);
            }
        }
    }
}

#[test]
fn normalisation_is_the_originals() {
    for case in cases() {
        let model = case.model();
        let robot = case.robot(&model, Compat::RoboHive07, true);
        let fixed = case.robot(&model, Compat::Fixed, true);
        for row in 0..2 {
            let mut controls = case.vector("action", row).to_vec();
            robot.unnormalize(&model, &mut controls).unwrap();
            assert_eq!(controls, case.vector("unnormalized", row), "{}", case.name);
            controls.iter_mut().for_each(|control| *control *= 0.9);
            robot.normalize(&model, &mut controls).unwrap();
            assert_eq!(controls, case.vector("normalized", row), "{}", case.name);

            let mut back = case.vector("action", row).to_vec();
            fixed.unnormalize(&model, &mut back).unwrap();
            fixed.normalize(&model, &mut back).unwrap();
            for (k, (back, action)) in back.iter().zip(case.vector("action", row)).enumerate() {
                let clipped = case.actuators.iter().any(|(_, actuator)| actuator.name == format!("a{k}"));
                let expected = if clipped { action.clamp(-1.0, 1.0) } else { *action };
                assert!((back - expected).abs() < 1e-12, "{} {k}: {back} for {expected}", case.name);
            }
        }
    }
}

#[test]
fn readings_and_their_noise_are_the_originals() {
    let mut compared = 0;
    for case in cases().into_iter().filter(|case| case.config().is_some()) {
        let model = case.model();
        let mut data = Data::new(&model);
        let mut robot = case.robot(&model, Compat::RoboHive07, true);
        for row in 0..2 {
            data.sensor.sensordata.copy_from_slice(case.vector("sensordata", row));
            let mut rng = Generator::pcg64(11_u64);
            let readings = robot.sense(&model, &data, &mut rng);
            assert_eq!(readings.values, case.vector("readings", row), "{}", case.name);
            compared += readings.values.len();
        }
    }
    assert!(compared > 100, "only {compared} readings");
}
