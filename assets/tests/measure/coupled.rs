//! Joints that follow others by equalities, as a kneecap follows its knee.

use super::muscles::{arms_in, flexed};
use physics::Model;
use physics::model::EqType;

/// An equality of two joints: which follows, which leads, and the polynomial between them.
fn followers(m: &Model) -> impl Iterator<Item = (usize, usize, &[f64])> {
    let joints = |eq: &usize| m.eq_type[*eq] == EqType::Joint as i32;
    (0..m.neq)
        .filter(joints)
        .map(|eq| (m.eq_obj1id[eq] as usize, m.eq_obj2id[eq] as usize, &m.eq_data[eq][..5]))
}

/// The pose in which these joints have these angles, and others what follows from them; the rest is as at the model's start.
pub fn pose(m: &Model, angles: &[(&str, f64)]) -> Vec<f64> {
    let mut pose = m.qpos0.to_vec();
    for (name, angle) in angles {
        pose[m.jnt_qposadr[m.joint(*name).unwrap().index()] as usize] = *angle;
    }
    for (follower, leader, factors) in followers(m) {
        let lead = pose[m.jnt_qposadr[leader] as usize];
        pose[m.jnt_qposadr[follower] as usize] =
            factors.iter().rev().fold(0.0, |sum, factor| sum * lead + factor);
    }
    pose
}

/// How far each degree of freedom moves with a joint that others follow.
pub fn motion(m: &Model, pose: &[f64], joint: usize) -> Vec<(usize, f64)> {
    let lead = pose[m.jnt_qposadr[joint] as usize];
    let slope = |factors: &[f64]| {
        (1..factors.len()).rev().fold(0.0, |sum, power| sum * lead + power as f64 * factors[power])
    };
    let moved = followers(m).filter(|(_, leader, _)| *leader == joint);
    let moved = moved.map(|(follower, _, factors)| (m.jnt_dofadr[follower] as usize, slope(factors)));
    std::iter::once((m.jnt_dofadr[joint] as usize, 1.0)).chain(moved).collect()
}

/// Moment arms of all actuators about a joint \[m\], with what follows it.
pub fn arms_about(m: &Model, pose: &[f64], joint: &str) -> Vec<f64> {
    let d = flexed(m, pose, &vec![0.0; m.na]);
    let mut sum = vec![0.0; m.nu];
    for (dof, share) in motion(m, pose, m.joint(joint).unwrap().index()) {
        let row = arms_in(m, &d, dof);
        sum.iter_mut().zip(row).for_each(|(sum, arm)| *sum += share * arm);
    }
    sum
}

/// The torque of all actuators about a joint \[N m\], given those of all degrees of freedom.
pub fn torque_about(m: &Model, pose: &[f64], joint: &str, torques: &[f64]) -> f64 {
    motion(m, pose, m.joint(joint).unwrap().index()).iter().map(|(dof, share)| share * torques[*dof]).sum()
}
