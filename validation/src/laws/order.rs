//! Order of convergence of the integrators: how the error at a fixed time falls with the time step.

use super::law::{Bound, Law, LawError, compile};
use physics::model::{Disable, Integrator};
use physics::{Data, Model, integration::integrate};

/// Compared time steps \[s\]; the second is half the first.
const STEPS: [f64; 2] = [4e-3, 2e-3];
/// Time step of the solution taken as exact \[s\].
const EXACT: f64 = 1.25e-4;
/// Simulated time \[s\].
const TIME: f64 = 0.2;
/// Deviation of a measured order, which the next term of the error makes.
const GIVE: f64 = 0.15;

/// A damped chain of hinges and slides, all axes askew.
pub(super) const HINGES: &str = r#"<mujoco><option viscosity="0.4"/><worldbody>
  <body quat="0.9 0.3 0.2 0.1"><joint type="hinge" axis="0 0.6 0.8" damping="0.05"/>
    <geom type="box" size="0.1 0.06 0.04" pos="0.1 0.02 0.03" mass="1" euler="10 20 30"/>
    <body pos="0.3 0.05 -0.1"><joint type="slide" axis="0.6 0 0.8" damping="0.05" pos="-0.05 0 0"/>
      <geom type="ellipsoid" size="0.08 0.05 0.03" pos="0.1 0.04 0.03" mass="0.5" euler="40 20 30"/>
      <body pos="0.3 0.1 -0.1"><joint type="hinge" axis="0 0.6 0.8" damping="0.05" pos="-0.05 0.01 0.02"/>
        <geom type="box" size="0.06 0.05 0.04" pos="0.1 0.06 0.03" mass="0.4"/>
        <body pos="0.3 0.1 0.1"><joint type="hinge" axis="1 0 0" damping="0.05"/>
          <geom type="capsule" size="0.03 0.08" pos="0 0.08 0.03" mass="0.3" euler="70 0 30"/>
  </body></body></body></body></worldbody></mujoco>"#;

/// A flying chain with rotations in space.
pub(super) const FLYING: &str = r#"<mujoco><worldbody>
  <body quat="0.9 0.3 0.2 0.1"><freejoint/>
    <geom type="box" size="0.1 0.06 0.04" mass="1" euler="10 20 30"/>
    <body pos="0.3 0.05 -0.1"><joint type="ball" pos="-0.05 0 0"/>
      <geom type="ellipsoid" size="0.08 0.05 0.03" pos="0.1 0.04 0.03" mass="0.5" euler="40 20 30"/>
      <body pos="0.3 0.1 -0.1"><joint type="hinge" axis="0 0.6 0.8" pos="-0.05 0.01 0.02"/>
        <geom type="box" size="0.06 0.05 0.04" pos="0.1 0.06 0.03" mass="0.4"/>
        <body pos="0.3 0.1 0.1"><joint type="slide" axis="0.6 0 0.8"/>
          <geom type="capsule" size="0.03 0.08" pos="0 0.08 0.03" mass="0.3" euler="70 0 30"/>
  </body></body></body></body></worldbody></mujoco>"#;

/// The chain in motion, away from `qpos0`, without contacts.
pub(super) fn moving(m: &Model) -> Data {
    let mut d = Data::new(m);
    let turn: Vec<f64> = (0..m.nv).map(|i| 0.3 + 0.1 * i as f64 - 0.015 * (i * i) as f64).collect();
    integrate::integrate_pos(m, &mut d.state.qpos, &turn, 1.0);
    d.state.qvel.iter_mut().enumerate().for_each(|(i, v)| *v = 1.0 - 0.25 * i as f64);
    d
}

/// Takes `steps` steps of length `h`.
pub(super) fn run(m: &mut Model, d: &mut Data, h: f64, steps: usize) -> Result<(), LawError> {
    m.options_mut().timestep = h;
    for _ in 0..steps {
        physics::step(m, d)?;
    }
    Ok(())
}

fn arrive(m: &mut Model, h: f64) -> Result<Vec<f64>, LawError> {
    let mut d = moving(m);
    run(m, &mut d, h, (TIME / h).round() as usize)?;
    Ok(d.state.qpos)
}

/// Measured order of the model's integrator; the exact solution is its own at a much smaller step.
fn order(m: &mut Model, exact: &[f64]) -> Result<f64, LawError> {
    let mut error = [0.0_f64; 2];
    for (error, h) in error.iter_mut().zip(STEPS) {
        let found = arrive(m, h)?;
        *error = found.iter().zip(exact).fold(0.0, |e, (a, b)| e.max((a - b).abs()));
    }
    Ok((error[0] / error[1]).log2())
}

/// The order of every integrator on both chains.
pub(super) fn orders() -> Result<Vec<Law>, LawError> {
    let mut laws = Vec::new();
    let variants = [
        ("Euler, implicit in damping", Integrator::Euler, Disable::NONE, [1.0, 1.0]),
        ("Euler, `eulerdamp` off", Integrator::Euler, Disable::EULERDAMP, [1.0, 1.0]),
        ("implicit", Integrator::Implicit, Disable::NONE, [1.0, 1.0]),
        ("implicitfast", Integrator::Implicitfast, Disable::NONE, [1.0, 1.0]),
        // Stages average angular velocities of frames that differ: second order for rotations in space.
        ("RK4", Integrator::Rk4, Disable::NONE, [4.0, 2.0]),
    ];
    for (system, text) in [HINGES, FLYING].into_iter().enumerate() {
        let mut m = compile(text)?;
        m.options_mut().disableflags |= Disable::CONTACT;
        m.options_mut().integrator = Integrator::Rk4;
        let exact = arrive(&mut m, EXACT)?;
        for (name, integrator, flag, expected) in variants {
            let mut m = m.clone();
            m.options_mut().integrator = integrator;
            m.options_mut().disableflags |= flag;
            let on = format!("{name}; {}", ["hinges and slides", "free and ball joints"][system]);
            let bound = Bound::Near(expected[system], GIVE);
            laws.push(Law::new("order of convergence", on, order(&mut m, &exact)?, bound));
        }
    }
    Ok(laws)
}
