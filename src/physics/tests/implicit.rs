//! Laws of the integrators that are implicit in velocity, of inverse dynamics, and of the derivatives they rest on.

mod machine;

use machine::{ANCHORED, FLYING, chain, moving};
use robohive_physics::derivative::{BiasSlope, DerivativeInputs, smooth_force_slope};
use robohive_physics::model::{Enable, Integrator, JointType};
use robohive_physics::pipeline::transition::transition;
use robohive_physics::{Data, Model, forward, integration::integrate, inverse, step};

/// The chain with polynomial dampers on all but its root, in a thick fluid with wind when `wet`.
fn damped(joints: &[JointType], wet: bool) -> Model {
    let mut m = chain(joints);
    let root = if joints[0] == JointType::Free { 6 } else { 0 };
    let arrays = m.unchecked_mut();
    for dof in root..arrays.nv {
        arrays.dof_damping[dof] = 0.05;
        arrays.dof_dampingpoly[dof] = [0.04, 0.01 * dof as f64];
    }
    if wet {
        (m.options_mut().density, m.options_mut().viscosity, m.options_mut().wind) =
            (80.0, 0.4, [0.3, -0.2, 0.1]);
    }
    m
}

fn smooth_force(m: &Model, d: &mut Data) -> Vec<f64> {
    forward(m, d).unwrap();
    d.passive.qfrc_passive.iter().zip(&d.vel.qfrc_bias).map(|(p, b)| p - b).collect()
}

#[test]
fn derivative_is_the_slope_of_smooth_forces() {
    let m = damped(&FLYING, true);
    let mut d = moving(&m);
    forward(&m, &mut d).unwrap();
    let mut slope = vec![0.0; m.nD];
    let inputs = DerivativeInputs::from(&d);
    smooth_force_slope(&m, &inputs, BiasSlope::Included, &mut Default::default(), &mut slope);
    let h = 1e-6;
    let scale = slope.iter().fold(0.0, |s: f64, x| s.max(x.abs()));
    assert!(slope.iter().filter(|x| x.abs() > 1e-3).count() > m.nD / 2);
    for j in 0..m.nv {
        let mut nudged = d.clone();
        nudged.state.qvel[j] += h;
        let plus = smooth_force(&m, &mut nudged);
        nudged.state.qvel[j] -= 2.0 * h;
        let minus = smooth_force(&m, &mut nudged);
        for i in 0..m.nv {
            let difference = (plus[i] - minus[i]) / (2.0 * h);
            let error = (slope[i * m.nv + j] - difference).abs();
            assert!(error < 1e-8 * scale, "d force[{i}] / d qvel[{j}]: {} {difference}", slope[i * m.nv + j]);
        }
    }
}

#[test]
fn implicit_steps_solve_their_equation() {
    // At the end of the step the linearised forces balance: M a = f + h D a, with qvel' = qvel + h a.
    let mut m = damped(&FLYING, true);
    (m.options_mut().integrator, m.options_mut().timestep) = (Integrator::Implicit, 0.01);
    let mut d = moving(&m);
    let before = d.state.qvel.clone();
    step(&m, &mut d).unwrap();
    let a: Vec<f64> = d.state.qvel.iter().zip(&before).map(|(v, v0)| (v - v0) / m.opt.timestep).collect();
    let mut inertial = vec![0.0; m.nv];
    robohive_physics::inertia::mul_inertia_matrix(&m, &d.inertia.M, &a, &mut inertial);
    for i in 0..m.nv {
        let slope: f64 = (0..m.nv).map(|j| d.implicit.qDeriv[i * m.nv + j] * a[j]).sum();
        let rest = inertial[i] - d.acc.qfrc_smooth[i] - m.opt.timestep * slope;
        assert!(d.acc.qfrc_smooth[i].abs() > 1e-3 && rest.abs() < 1e-12, "row {i}: {rest}");
    }
}

#[test]
fn inverse_undoes_forward() {
    let m = damped(&FLYING, true);
    let mut d = moving(&m);
    d.state.qfrc_applied.iter_mut().enumerate().for_each(|(i, f)| *f = 0.3 - 0.1 * i as f64);
    forward(&m, &mut d).unwrap();
    let qacc = d.acc.qacc.clone();
    inverse(&m, &mut d).unwrap();
    for (found, applied) in d.implicit.qfrc_inverse.iter().zip(&d.state.qfrc_applied) {
        assert!((found - applied).abs() < 1e-11, "{found} {applied}");
    }
    assert_eq!(qacc, d.acc.qacc);
}

#[test]
fn discrete_inverse_undoes_a_step() {
    for integrator in [Integrator::Euler, Integrator::Implicit, Integrator::Implicitfast] {
        let mut m = damped(&FLYING, true);
        m.options_mut().enableflags = Enable::INVDISCRETE;
        (m.options_mut().integrator, m.options_mut().timestep) = (integrator, 0.01);
        let start = moving(&m);
        let mut d = start.clone();
        d.state.qfrc_applied.fill(0.25);
        step(&m, &mut d).unwrap();
        let moved = d.state.clone();
        d.state.clone_from(&start.state);
        for (a, (v, v0)) in d.acc.qacc.iter_mut().zip(moved.qvel.iter().zip(&start.state.qvel)) {
            *a = (v - v0) / m.opt.timestep;
        }
        inverse(&m, &mut d).unwrap();
        for force in &d.implicit.qfrc_inverse {
            assert!((force - 0.25).abs() < 1e-10, "{integrator:?}: {force}");
        }
    }
    let mut m = chain(&ANCHORED);
    m.options_mut().enableflags = Enable::INVDISCRETE;
    m.options_mut().integrator = Integrator::Rk4;
    assert!(inverse(&m, &mut moving(&m)).is_err());
}

#[test]
fn free_flight_keeps_momentum() {
    for integrator in [Integrator::Euler, Integrator::Implicit, Integrator::Implicitfast, Integrator::Rk4] {
        let mut m = chain(&[JointType::Free]);
        m.unchecked_mut().body_ipos[1] = [0.0; 3];
        m.options_mut().gravity = [0.2, 0.0, -9.0];
        (m.options_mut().integrator, m.options_mut().timestep) = (integrator, 0.005);
        let mut d = Data::new(&m);
        d.state.qvel.copy_from_slice(&[1.0, 0.5, 4.0, 3.0, -5.0, 2.0]);
        (0..200).for_each(|_| step(&m, &mut d).unwrap());
        for (k, start) in [1.0, 0.5, 4.0].into_iter().enumerate() {
            let expected = start + m.opt.gravity[k] * d.state.time;
            assert!(
                (d.state.qvel[k] - expected).abs() < 1e-12,
                "{integrator:?} axis {k}: {}",
                d.state.qvel[k]
            );
        }
        assert!((d.state.qvel[3] - 3.0).abs() > 1e-3, "the spin must precess");
    }
}

#[test]
fn transition_predicts_a_nudged_step() {
    let mut m = damped(&FLYING, true);
    (m.options_mut().integrator, m.options_mut().timestep) = (Integrator::Implicit, 0.01);
    let mut d = moving(&m);
    let matrices = transition(&m, &mut d, 1e-6, true).unwrap();
    assert_eq!(d.state.qpos, moving(&m).state.qpos);
    assert_eq!(d.state.qvel, moving(&m).state.qvel);
    let n = 2 * m.nv;
    let nudge: Vec<f64> = (0..n).map(|i| 1e-4 * ((i % 3) as f64 - 1.0)).collect();
    let mut nudged = d.clone();
    integrate::integrate_pos(&m, &mut nudged.state.qpos, &nudge[..m.nv], 1.0);
    nudged.state.qvel.iter_mut().zip(&nudge[m.nv..]).for_each(|(v, dv)| *v += dv);
    step(&m, &mut d).unwrap();
    step(&m, &mut nudged).unwrap();
    let mut change = vec![0.0; m.nv];
    integrate::differentiate_pos(&m, &d.state.qpos, &nudged.state.qpos, 1.0, &mut change);
    change.extend(nudged.state.qvel.iter().zip(&d.state.qvel).map(|(a, b)| a - b));
    for (i, change) in change.iter().enumerate() {
        let predicted: f64 = (0..n).map(|j| matrices.a[i * n + j] * nudge[j]).sum();
        assert!((change - predicted).abs() < 2e-7, "row {i}: {change} {predicted}");
    }
    m.options_mut().integrator = Integrator::Rk4;
    assert!(transition(&m, &mut d, 1e-6, true).is_err());
}
