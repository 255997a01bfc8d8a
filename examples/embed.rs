//! The engine inside another program: a two-link arm described in text, held up by its own controller.

use robohive::mjcf::load_str;
use robohive::physics::{Data, step};

const ARM: &str = r#"
<mujoco model="arm">
  <option timestep="0.002" integrator="implicitfast"/>
  <default>
    <joint type="hinge" axis="0 1 0" damping="0.05"/>
    <geom type="capsule" size="0.03" density="800"/>
  </default>
  <worldbody>
    <body name="upper">
      <joint name="shoulder"/>
      <geom fromto="0 0 0 0.4 0 0"/>
      <body name="lower" pos="0.4 0 0">
        <joint name="elbow" limited="true" range="0 150"/>
        <geom fromto="0 0 0 0.3 0 0"/>
        <site name="tip" pos="0.3 0 0"/>
      </body>
    </body>
  </worldbody>
  <actuator>
    <motor joint="shoulder"/>
    <motor joint="elbow"/>
  </actuator>
  <sensor>
    <framepos objtype="site" objname="tip"/>
  </sensor>
</mujoco>"#;

const TARGET: [f64; 2] = [-0.9, 1.4];
const STIFFNESS: f64 = 40.0;
const DAMPING: f64 = 4.0;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let model = load_str(ARM)?.model;
    let mut data = Data::new(&model);
    for second in 0..=3 {
        let [x, _, z] = [0, 1, 2].map(|i| data.sensor.sensordata[i]);
        println!("{second} s: joints {:+.4?} rad, tip at x {x:+.4} m, z {z:+.4} m", data.state.qpos);
        for _ in 0..500 {
            // Gravity and Coriolis forces are known from the last step; a spring and a damper do the rest.
            for joint in 0..2 {
                let error = TARGET[joint] - data.state.qpos[joint];
                data.state.ctrl[joint] =
                    data.vel.qfrc_bias[joint] + STIFFNESS * error - DAMPING * data.state.qvel[joint];
            }
            step(&model, &mut data)?;
        }
    }
    let error = (0..2).map(|j| (data.state.qpos[j] - TARGET[j]).abs()).fold(0.0, f64::max);
    if error < 1e-3 { Ok(()) } else { Err(format!("the arm is {error} rad from its target").into()) }
}
