//! Derivative of the bias of a body that flies alone with respect to its velocity.
//!
//! With the angular velocity `w` and the offset `s` of the centre of mass from the joint, both in world orientation, the
//! centre accelerates by `w × (w × s)`, and the body resists with the force `f = m w × (w × s)` and the torque
//! `s × f + w × I w`, where `I` is the inertia about the centre. None of it depends on the linear velocity. A change `δ`
//! of `w` changes `w × (w × s)` by `-P δ` with `P = s wᵀ - (w·s) 1 + [w × s]×`, and `w × I w` by `([w]× I - [I w]×) δ`.
//! `w = R ω` with the orientation `R` and the angular velocity `ω` of the joint, in the body.

use super::inputs::DerivativeInputs;
use crate::math::{
    Mat3, Vec3, column, cross, cross_matrix, dot, mul_mat, mul_mat_t_mat, mul_mat_vec, row, sub,
};
use crate::model::Model;

/// `d qfrc_bias / d qvel` of a free joint, by its rotational columns; the others are zero.
#[derive(Clone, Copy, Debug)]
pub struct FreeBodySlope {
    /// Slope of the acceleration of the centre of mass that the bias holds against, negated and without the mass: world
    /// by body.
    pub pull: Mat3,
    /// Slope of the torque about the joint, in the body.
    pub torque: Mat3,
}

impl FreeBodySlope {
    /// The slope for body `b`, which has nothing but a free joint and all the mass of its tree.
    pub fn of(m: &Model, inputs: &DerivativeInputs, b: usize) -> Self {
        let (rotation, mass) = (&inputs.kin.xmat[b], m.body_mass[b]);
        let first = m.body_dofadr[b] as usize + 3;
        let omega: Vec3 = std::array::from_fn(|k| inputs.state.qvel[first + k]);
        let w = mul_mat_vec(rotation, omega);
        let s = sub(inputs.kin.xipos[b], inputs.kin.xpos[b]);
        let pull = centre_slope(w, s);
        let inertia = central_inertia(&inputs.kin.ximat[b], m.body_inertia[b]);
        let (lever, turned) = (cross_columns(s, &pull), cross_columns(w, &inertia));
        let spin = cross_matrix(mul_mat_vec(&inertia, w));
        let torque = std::array::from_fn(|e| -mass * lever[e] + turned[e] - spin[e]);
        FreeBodySlope {
            pull: mul_mat(&pull, rotation),
            torque: mul_mat(&mul_mat_t_mat(rotation, &torque), rotation),
        }
    }

    /// Adds `h` times the slope to the dense matrix of a joint of a body of this mass.
    pub fn add_to(&self, system: &mut [[f64; 6]; 6], h: f64, mass: f64) {
        let weight = -h * mass;
        for e in 0..9 {
            let (r, c) = (e / 3, 3 + e % 3);
            system[r][c] += weight * self.pull[e];
            system[3 + r][c] += h * self.torque[e];
        }
    }
}

/// `P`, by how much `w × (w × s)` falls with `w`.
fn centre_slope(w: Vec3, s: Vec3) -> Mat3 {
    let (carried, along) = (cross_matrix(cross(w, s)), dot(w, s));
    std::array::from_fn(|e| {
        let (r, c) = (e / 3, e % 3);
        s[r] * w[c] + if r == c { -along } else { carried[e] }
    })
}

/// `[a]× m`.
fn cross_columns(a: Vec3, m: &Mat3) -> Mat3 {
    let columns: [Vec3; 3] = std::array::from_fn(|c| cross(a, column(m, c)));
    std::array::from_fn(|e| columns[e % 3][e / 3])
}

/// Inertia about the centre of mass in world orientation, from principal moments and their axes.
fn central_inertia(axes: &Mat3, moments: Vec3) -> Mat3 {
    std::array::from_fn(|e| {
        let (upper, lower) = (row(axes, (e / 3).min(e % 3)), row(axes, (e / 3).max(e % 3)));
        let weighted: Vec3 = std::array::from_fn(|k| upper[k] * moments[k]);
        dot(weighted, lower)
    })
}
