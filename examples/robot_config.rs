//! A robot by its config: ranges, limits of velocity, noise and delay between a policy and the joints.

use robohive::robot::{Config, Options};
use robohive::{Data, Generator, Robot, forward, load_str, step};

const ARM: &str = "
<mujoco>
  <worldbody>
    <body><joint name='elbow' axis='0 1 0' damping='1'/><geom size='.05' pos='.3 0 0'/></body>
  </worldbody>
  <actuator><position name='servo' joint='elbow' kp='50' kv='5'/></actuator>
  <sensor><jointpos name='angle' joint='elbow'/></sensor>
</mujoco>";

const CONFIG: &str = "
[[device]]
name = 'arm'
sensor = [{ name = 'angle', range = [-1.5, 1.5], noise = 0.01 }]
actuator = [{ name = 'servo', pos_range = [-1.5, 1.5], vel_range = [-2, 2] }]";

/// Control period \[s\].
const PERIOD: f64 = 0.1;

/// Moves the robot within its limits.
pub fn main() -> Result<(), Box<dyn std::error::Error>> {
    let model = load_str(ARM)?.model;
    let config = Config::from_toml(CONFIG, "arm.toml")?;
    let mut robot = Robot::new(&model, Some(&config), Options::default().with_noise_scale(1.0))?;
    let (mut draws, mut data) = (Generator::pcg64(1_u64), Data::new(&model));
    forward(&model, &mut data)?;
    robot.reset(&model, &data, &mut draws)?;

    // Actions are fractions of the range. The first asks for 1.5 rad, and gets what 2 rad/s allow.
    let mut sent = Vec::new();
    for _ in 0..10 {
        let controls = robot.control(&model, &data, &[1.0], PERIOD)?;
        sent.push(controls[0]);
        data.state.ctrl.copy_from_slice(controls);
        let steps = (PERIOD / model.opt.timestep).round() as usize;
        (0..steps).try_for_each(|_| step(&model, &mut data))?;
        forward(&model, &mut data)?;
        let (angle, read) = (data.state.qpos[0], robot.sense(&model, &data, &mut draws).values[0]);
        assert!(read != angle && (read - angle).abs() < 0.06, "{read} shows {angle}");
    }
    assert!((sent[0] - 0.2).abs() < 1e-12, "{sent:?}");
    assert!(sent.is_sorted() && sent[9] <= 1.5, "{sent:?}");

    // What a config gets wrong is named with its place.
    let wrong = Config::from_toml("[[device]]\nname = 'arm'\nsenser = []", "arm.toml");
    let error = wrong.err().ok_or("an unknown key")?.to_string();
    assert!(error.contains("arm.toml") && error.contains("senser"), "{error}");
    Ok(())
}
