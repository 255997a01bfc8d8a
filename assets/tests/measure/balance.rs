//! A body that stands on its muscles: springs at the joints say which torques are wanted, and least squares which muscles give them.

use super::coupled::motion;
use super::muscles::arms_in;
use physics::math::sub;
use physics::{Data, Model, forward, step};

/// A joint that is held: its name, the spring \[N m/rad\], and by how much its torque may be off \[N m\].
pub type Spring = (&'static str, f64, f64);

/// Time from one excitation to the next, as steps of 1 ms.
const STEPS: usize = 10;
/// Damping \[s\] of all springs, in terms of their stiffness.
const DAMPING: f64 = 0.06;
/// How much an activation may cost, in terms of the torques that are off.
const EFFORT: f64 = 0.03;
/// Of the ankles: what leaning by a metre, and moving at a metre a second, is answered with, in terms of the weight.
const LEAN: [f64; 2] = [1.4, 0.45];

/// Activations between 0 and 1 that come nearest to `wanted`: rows of `share` are those of the muscles, one number for each torque.
fn activate(share: &[Vec<f64>], wanted: &[f64], act: &mut [f64]) {
    let mut off = wanted.to_vec();
    for (row, act) in share.iter().zip(&*act) {
        off.iter_mut().zip(row).for_each(|(off, share)| *off -= share * act);
    }
    for _ in 0..30 {
        for (row, act) in share.iter().zip(&mut *act) {
            let slope =
                row.iter().zip(&off).map(|(share, off)| share * off).sum::<f64>() - EFFORT * EFFORT * *act;
            let bend = row.iter().map(|share| share * share).sum::<f64>() + EFFORT * EFFORT;
            let next = (*act + slope / bend).clamp(0.0, 1.0);
            off.iter_mut().zip(row).for_each(|(off, share)| *off -= share * (next - *act));
            *act = next;
        }
    }
}

/// Pulls of all muscles \[N\] if all had this activation.
fn pulls(m: &Model, d: &Data, act: f64) -> Vec<f64> {
    let mut all = d.clone();
    all.state.act.fill(act);
    forward(m, &mut all).unwrap();
    all.actuation.actuator_force.iter().map(|force| -force).collect()
}

/// How far the centre of mass is before the middle of both soles \[m\]; legs look against y.
fn lean(m: &Model, d: &Data) -> f64 {
    let feet = ["sole_r", "sole_l"].map(|sole| d.site(m.site(sole).unwrap()).xpos()[1]);
    0.5 * (feet[0] + feet[1]) - d.body(m.body("root").unwrap()).subtree_com()[1]
}

/// Stands in the model's first keyframe for some time \[s\]. Springs hold the joints of both sides where they are at first, and ankles
/// answer how far the body leans. Returns how far the root moved at most, and the largest activation.
pub fn stand(m: &Model, springs: &[Spring], seconds: f64) -> (f64, f64) {
    let mut d = Data::new(m);
    d.state.qpos.copy_from_slice(&m.key_qpos[..m.nq]);
    forward(m, &mut d).unwrap();
    let joint = |(name, stiff, off): &Spring, side| {
        (m.joint(&*format!("{name}_{side}")).unwrap().index(), *stiff, *off)
    };
    let joints: Vec<_> =
        ["r", "l"].iter().flat_map(|side| springs.iter().map(move |spring| joint(spring, side))).collect();
    let ankles = ["ankle_angle_r", "ankle_angle_l"].map(|name| m.joint(name).unwrap().index());
    let (start, upright) = (d.state.qpos.to_vec(), lean(m, &d));
    let weight = m.body_mass.iter().sum::<f64>() * -m.opt.gravity[2];
    let (mut act, mut before, mut worst) = (vec![0.0; m.nu], upright, (0.0_f64, 0.0_f64));
    for _ in 0..(seconds / (STEPS as f64 * m.opt.timestep)).round() as usize {
        let (rest, full) = (pulls(m, &d, 0.0), pulls(m, &d, 1.0));
        let ahead = lean(m, &d);
        let speed = (ahead - before) / (STEPS as f64 * m.opt.timestep);
        before = ahead;
        let (mut share, mut wanted) = (vec![vec![]; m.nu], vec![]);
        for (joint, stiff, off) in &joints {
            let (place, dof) = (m.jnt_qposadr[*joint] as usize, m.jnt_dofadr[*joint] as usize);
            let mut arms = vec![0.0; m.nu];
            for (dof, moved) in motion(m, &d.state.qpos, *joint) {
                arms.iter_mut().zip(arms_in(m, &d, dof)).for_each(|(sum, arm)| *sum += moved * arm);
            }
            let mut torque = stiff * (start[place] - d.state.qpos[place] - DAMPING * d.state.qvel[dof]);
            if ankles.contains(joint) {
                torque -= 0.5 * weight * (LEAN[0] * (ahead - upright) + LEAN[1] * speed);
            }
            for (muscle, row) in share.iter_mut().enumerate() {
                row.push(arms[muscle] * (full[muscle] - rest[muscle]) / off);
                torque -= arms[muscle] * rest[muscle];
            }
            wanted.push(torque / off);
        }
        activate(&share, &wanted, &mut act);
        d.state.ctrl.copy_from_slice(&act);
        for _ in 0..STEPS {
            step(m, &mut d).unwrap();
        }
        let moved = sub([0, 1, 2].map(|k| d.state.qpos[k]), [0, 1, 2].map(|k| start[k]));
        worst.0 = moved.iter().fold(worst.0, |worst, off| worst.max(off.abs()));
        worst.1 = act.iter().fold(worst.1, |worst, act| worst.max(*act));
    }
    worst
}
