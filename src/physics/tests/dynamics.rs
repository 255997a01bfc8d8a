//! Laws of motion on a machine built here: what holds whatever the numbers are.

mod machine;

use machine::{ANCHORED, FLYING, chain, moving};
use robohive_physics::math::{norm, sub};
use robohive_physics::model::{Enable, Integrator, JointType};
use robohive_physics::on_demand::momentum::subtree_momentum;
use robohive_physics::position::jacobian::{Jacobian, angular_momentum_matrix, subtree_com_jacobian};
use robohive_physics::{
    Data, Model, StepError, forward, inertia, integration::integrate, step, velocity::bias,
};

#[test]
fn inverse_dynamics_and_inertia_are_one_law() {
    let m = chain(&FLYING);
    let mut d = moving(&m);
    forward(&m, &mut d).unwrap();
    let mut force = vec![0.0; m.nv];
    bias::rne(&m, &d.state, &d.com, &d.vel, Some(&d.acc.qacc), &mut Default::default(), &mut force);
    assert!(d.vel.qfrc_bias.iter().all(|f| f.abs() > 1e-3));
    for (dof, f) in force.iter().enumerate() {
        assert!(f.abs() < 1e-10, "free motion needs force {f} at {dof}");
    }
    let mut unit = vec![0.0; m.nv];
    let mut column = vec![0.0; m.nv];
    let dense = inertia::full_inertia(&m, &d.inertia.M);
    for dof in 0..m.nv {
        unit.fill(0.0);
        unit[dof] = 1.0;
        bias::rne(&m, &d.state, &d.com, &d.vel, Some(&unit), &mut Default::default(), &mut column);
        for i in 0..m.nv {
            assert!((column[i] - d.vel.qfrc_bias[i] - dense[i * m.nv + dof]).abs() < 1e-11);
        }
        inertia::mul_inertia_matrix(&m, &d.inertia.M, &unit, &mut column);
        inertia::solve(&m, &d.inertia, &mut column);
        assert!(column.iter().zip(&unit).all(|(x, y)| (x - y).abs() < 1e-11));
    }
}

#[test]
fn jacobians_are_derivatives_of_poses() {
    let m = chain(&FLYING);
    let mut d = moving(&m);
    forward(&m, &mut d).unwrap();
    let (mut jac, mut rate, mut next) = (Jacobian::default(), Jacobian::default(), Jacobian::default());
    let last = m.nbody - 1;
    jac.body_com(&m, &d.kin, &d.com, last);
    rate.point_rate(&m, &d.com, &d.vel, last, d.kin.xipos[last]);
    let h = 1e-6;
    for dof in 0..m.nv {
        let reach = |s: f64| {
            let mut moved = d.clone();
            let mut unit = vec![0.0; m.nv];
            unit[dof] = s * h;
            integrate::integrate_pos(&m, &mut moved.state.qpos, &unit, 1.0);
            forward(&m, &mut moved).unwrap();
            moved.kin.xipos[last]
        };
        let slope = sub(reach(1.0), reach(-1.0)).map(|x| x / (2.0 * h));
        for k in 0..3 {
            assert!((slope[k] - jac.pos[k * m.nv + dof]).abs() < 1e-8, "column {dof}");
        }
    }
    let mut later = d.clone();
    integrate::integrate_pos(&m, &mut later.state.qpos, &d.state.qvel, h);
    forward(&m, &mut later).unwrap();
    next.body_com(&m, &later.kin, &later.com, last);
    let moved = |j: &Jacobian, k: usize| -> f64 {
        (0..m.nv).map(|dof| j.pos[k * m.nv + dof] * d.state.qvel[dof]).sum()
    };
    for k in 0..3 {
        let slope = (moved(&next, k) - moved(&jac, k)) / h;
        assert!(slope.abs() > 1e-2 && (slope - moved(&rate, k)).abs() < 1e-4);
    }
}

/// Energy gained or lost in 0.2 s.
fn drift(m: &Model, integrator: Integrator, h: f64) -> f64 {
    let mut m = m.clone();
    m.options_mut().enableflags = Enable::ENERGY;
    (m.options_mut().integrator, m.options_mut().timestep) = (integrator, h);
    let mut d = moving(&m);
    forward(&m, &mut d).unwrap();
    let start = d.energy;
    while d.state.time < 0.2 - 0.5 * h {
        step(&m, &mut d).unwrap();
    }
    forward(&m, &mut d).unwrap();
    assert!((d.energy[1] - start[1]).abs() > 0.1, "kinetic energy alone must change");
    (d.energy[0] + d.energy[1] - start[0] - start[1]).abs()
}

#[test]
fn energy_drifts_with_the_order_of_the_integrator() {
    let order = |m: &Model, integrator| (drift(m, integrator, 8e-3) / drift(m, integrator, 4e-3)).log2();
    let m = chain(&ANCHORED);
    let (rk4, euler) = (order(&m, Integrator::Rk4), order(&m, Integrator::Euler));
    assert!((rk4 - 4.0).abs() < 0.6, "Runge-Kutta of order {rk4}");
    assert!((euler - 1.0).abs() < 0.2, "Euler of order {euler}");
    // Stages average angular velocities of frames that differ, which leaves second order for rotations in space.
    let rk4 = order(&chain(&FLYING), Integrator::Rk4);
    assert!((rk4 - 2.0).abs() < 0.2, "Runge-Kutta of order {rk4} with quaternions");
}

#[test]
fn momentum_matrices_give_the_momentum_of_every_subtree() {
    let m = chain(&FLYING);
    let mut d = moving(&m);
    forward(&m, &mut d).unwrap();
    let mut sensors = d.sensor.clone();
    subtree_momentum(&m, &d.state, &d.kin, &d.com, &d.vel, &mut sensors);
    let (mut linear, mut angular) = (Vec::new(), Vec::new());
    for b in 1..m.nbody {
        subtree_com_jacobian(&m, &d.kin, &d.com, b, &mut linear);
        angular_momentum_matrix(&m, &d.kin, &d.com, b, &mut angular);
        for (matrix, expected) in
            [(&linear, sensors.subtree_linvel[b]), (&angular, sensors.subtree_angmom[b])]
        {
            let product = |i: usize| (0..m.nv).map(|k| matrix[i * m.nv + k] * d.state.qvel[k]).sum::<f64>();
            let error = sub(std::array::from_fn(product), expected);
            assert!(norm(expected) > 1e-3 && norm(error) < 1e-13, "body {b}: {expected:?} {error:?}");
        }
    }
}

#[test]
fn spin_of_a_free_body_changes_energy_as_upstream() {
    let kinetic = |integrator: Integrator| {
        let mut m = chain(&[JointType::Free]);
        m.options_mut().gravity = [0.0; 3];
        m.options_mut().enableflags = Enable::ENERGY;
        (m.options_mut().integrator, m.options_mut().timestep) = (integrator, 0.01);
        let mut d = Data::new(&m);
        d.state.qvel.copy_from_slice(&[1.0, 0.0, -1.0, 8.0, 12.0, -9.0]);
        forward(&m, &mut d).unwrap();
        let start = d.energy[1];
        for _ in 0..100 {
            step(&m, &mut d).unwrap();
        }
        d.energy[1] / start
    };
    // The same body in MuJoCo 3.12.0.
    for (integrator, ratio) in
        [(Integrator::Implicitfast, 1.0347456283024405), (Integrator::Euler, 1.0377694235907788)]
    {
        assert!((kinetic(integrator) - ratio).abs() < 1e-12, "{integrator:?} {}", kinetic(integrator));
    }
}

#[test]
fn bad_states_are_errors_and_stay() {
    let m = chain(&FLYING);
    let mut d = moving(&m);
    d.state.qvel[7] = f64::NAN;
    let before = d.state.qpos.clone();
    match step(&m, &mut d) {
        Err(StepError::BadQvel(bad)) => {
            assert_eq!((bad.index, bad.element.as_str(), bad.time), (7, "joint 2", 0.0));
        }
        other => panic!("{other:?}"),
    }
    assert_eq!(d.state.qpos, before);
}
