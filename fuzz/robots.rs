//! Robots: configs in both forms, and robots made of them that act and sense.

use super::bytes::Bytes;
use mjcf::Loader;
use physics::{Data, Model, forward, step};
use random::Generator;
use robot::{ActionMode, Compat, Config, Noise, Options, Robot};
use std::sync::OnceLock;

/// A model with joints, actuators and sensors of several kinds, whose names are short so that inputs hit them.
const ARM: &str = "<mujoco><compiler angle='radian'/><worldbody>
    <body><joint name='a' axis='0 1 0' range='-1 1' limited='true'/><geom size='.1' pos='.3 0 0'/>
        <body pos='.6 0 0'><joint name='b' axis='0 1 0' damping='1'/><geom size='.1' pos='.3 0 0'/>
            <body pos='.6 0 0'><joint name='c' type='slide' axis='1 0 0'/><geom size='.1'/><site name='s'/></body></body></body>
    <body pos='0 1 0'><joint name='q' type='ball'/><geom size='.1' pos='.3 0 0'/></body></worldbody>
    <tendon><fixed name='t'><joint joint='a' coef='1'/><joint joint='b' coef='-2'/></fixed></tendon>
    <actuator><position name='a' joint='a' kp='50' kv='5' ctrlrange='-1 1'/><motor name='b' joint='b' gear='3'/>
        <velocity name='c' joint='c' kv='2'/><muscle name='m' joint='a'/><motor name='q' joint='q'/><motor name='t' tendon='t'/>
        <general name='g' joint='c' dyntype='filter' dynprm='.1' gainprm='2' biastype='affine' biasprm='0 -1 -1'/></actuator>
    <sensor><jointpos name='a' joint='a'/><jointvel name='b' joint='b'/><jointpos name='c' joint='c'/>
        <ballquat name='q' joint='q'/><framepos name='s' objtype='site' objname='s'/><touch name='t' site='s'/></sensor>
</mujoco>";

fn arm() -> &'static Model {
    static MODEL: OnceLock<Model> = OnceLock::new();
    MODEL.get_or_init(|| Loader::default().load_str(ARM).expect("the arm is sound").model)
}

/// Two bytes of choices, then the text of a config: RoboHive's literal or TOML. What is read comes back from TOML; the
/// robot made of it acts and senses.
pub fn robot(data: &[u8]) {
    let [form, way, text @ ..] = data else { return };
    let Ok(text) = std::str::from_utf8(text) else { return };
    let read = if form & 1 == 0 { Config::from_literal } else { Config::from_toml };
    let Ok(config) = read(text, "r") else { return };
    let written = config.to_toml();
    let again = Config::from_toml(&written, "r").unwrap_or_else(|error| panic!("{error}\n{written}"));
    assert_eq!(again.to_toml(), written);
    if let Ok(robot) = Robot::new(arm(), Some(&config), options(*form, *way)) {
        act(robot);
    }
}

fn options(form: u8, way: u8) -> Options {
    let modes = [ActionMode::Position, ActionMode::Velocity, ActionMode::Torque];
    Options::default()
        .with_mode(*Bytes(&[form >> 1]).one_of(&modes))
        .with_compat(if way & 1 == 0 { Compat::Fixed } else { Compat::RoboHive07 })
        .with_normalized(way & 2 == 0)
        .with_noise_scale(f64::from(way >> 2 & 3))
        .with_noise(if way & 16 == 0 { Noise::Uniform } else { Noise::Gaussian })
        .with_delay_steps(usize::from(way >> 5 & 1) * 3)
        .with_jitter_steps(usize::from(way >> 6 & 1) * 2)
}

/// Three periods of control; what it reads and commands is as long as it says.
fn act(mut robot: Robot) {
    let (model, mut data) = (arm(), Data::new(arm()));
    let mut rng = Generator::pcg64(1_u64);
    assert!(forward(model, &mut data).is_ok());
    let readings = robot.reset(model, &data, &mut rng).expect("simulated devices do not fail").values.len();
    for k in 0..3 {
        let action: Vec<f64> =
            (0..robot.action_len()).map(|place| [0.5, -1.0, 3.0][(k + place) % 3]).collect();
        let Ok(control) = robot.control(model, &data, &action, 0.02) else { return };
        data.state.ctrl.copy_from_slice(control);
        if step(model, &mut data).is_err() {
            return;
        }
        robot.track(&data);
        assert_eq!(robot.sense(model, &data, &mut rng).values.len(), readings);
    }
}
