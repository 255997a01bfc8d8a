//! Momentum and energy of chains on which nothing acts.

use super::law::{Bound, Law, LawError, compile};
use super::order::{FLYING, HINGES, moving, run};
use crate::tolerance::{ENERGY, ENERGY_IN_SPACE, MOMENTUM, SPIN};
use physics::math::{Vec3, norm, sub};
use physics::model::{Disable, Enable, Integrator};
use physics::on_demand::momentum::subtree_momentum;
use physics::{Data, Model};

const INTEGRATORS: [Integrator; 4] =
    [Integrator::Euler, Integrator::Implicit, Integrator::Implicitfast, Integrator::Rk4];

/// Steps over which momentum is kept.
const STEPS: usize = 1000;

/// One body of three different moments of inertia.
const BODY: &str = r#"<mujoco><worldbody><body><freejoint/>
  <geom type="box" size="0.1 0.2 0.3" mass="2"/></body></worldbody></mujoco>"#;

/// Linear momentum and angular momentum about the centre of mass.
fn momentum_of(m: &Model, d: &mut Data) -> Result<[Vec3; 2], LawError> {
    physics::forward(m, d)?;
    let mut sensors = d.sensor.clone();
    subtree_momentum(m, &d.state, &d.kin, &d.com, &d.vel, &mut sensors);
    Ok([sensors.subtree_linvel[1].map(|v| v * m.body_subtreemass[1]), sensors.subtree_angmom[1]])
}

/// Change of momentum from `start` in `STEPS` steps of length `h`, relative: linear and angular.
fn change(m: &mut Model, mut d: Data, h: f64) -> Result<[f64; 2], LawError> {
    let before = momentum_of(m, &mut d)?;
    run(m, &mut d, h, STEPS)?;
    let after = momentum_of(m, &mut d)?;
    Ok([0, 1].map(|k| norm(sub(after[k], before[k])) / norm(before[k])))
}

fn weightless(text: &str, integrator: Integrator) -> Result<Model, LawError> {
    let mut m = compile(text)?;
    m.options_mut().disableflags |= Disable::CONTACT | Disable::GRAVITY;
    m.options_mut().integrator = integrator;
    Ok(m)
}

/// Momentum in free flight.
pub(super) fn momentum() -> Result<Vec<Law>, LawError> {
    let mut laws = Vec::new();
    for integrator in INTEGRATORS {
        let mut m = weightless(BODY, integrator)?;
        let mut d = Data::new(&m);
        // The middle axis and a tumbling spin are not kept by a finite step; a spin about the largest moment is.
        d.state.qvel.copy_from_slice(&[1.0, 0.5, -2.0, 5.0, 0.0, 0.0]);
        let change = change(&mut m, d, 0.005)?;
        let on = format!("free body spinning about a principal axis, {integrator:?}, 1000 steps of 5 ms");
        for (kind, change) in ["linear", "angular"].into_iter().zip(change) {
            laws.push(Law::new(&format!("{kind} momentum is kept"), &on, change, Bound::Within(&SPIN)));
        }
    }
    let mut m = weightless(FLYING, Integrator::Rk4)?;
    let d = moving(&m);
    let change = change(&mut m, d, 1e-5)?;
    for (kind, change) in ["linear", "angular"].into_iter().zip(change) {
        let on = "tumbling chain of four bodies, Rk4, 1000 steps of 10 µs";
        laws.push(Law::new(&format!("{kind} momentum is kept"), on, change, Bound::Within(&MOMENTUM)));
    }
    Ok(laws)
}

/// Energy of chains without dampers under gravity.
pub(super) fn energy() -> Result<Vec<Law>, LawError> {
    let mut laws = Vec::new();
    for (text, name, tolerance) in
        [(HINGES, "hinges and slides", &ENERGY), (FLYING, "free and ball joints", &ENERGY_IN_SPACE)]
    {
        let mut m = compile(text)?;
        m.options_mut().disableflags |= Disable::CONTACT | Disable::DAMPER;
        m.options_mut().enableflags |= Enable::ENERGY;
        m.options_mut().viscosity = 0.0;
        m.options_mut().integrator = Integrator::Rk4;
        let mut d = moving(&m);
        let total = |d: &Data| d.energy[0] + d.energy[1];
        physics::forward(&m, &mut d)?;
        let (start, kinetic) = (total(&d), d.energy[1]);
        run(&mut m, &mut d, 1e-3, STEPS)?;
        physics::forward(&m, &mut d)?;
        let exchanged = (d.energy[1] - kinetic).abs();
        let on = format!("{name}, RK4, 1000 steps of 1 ms; relative to the kinetic energy gained");
        let drift = (total(&d) - start).abs() / exchanged;
        laws.push(Law::new("energy is kept", on, drift, Bound::Within(tolerance)));
    }
    Ok(laws)
}
