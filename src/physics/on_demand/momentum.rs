//! Velocity and angular momentum of subtrees about their centres of mass, which sensors `subtreelinvel` and
//! `subtreeangmom` read.

use crate::math::{Vec3, add, cross, linear, mul_mat_t_vec, mul_mat_vec, rotational, scale, sub};
use crate::model::Model;
use crate::model::bounds::MINVAL;
use crate::position::frame::Frame;
use crate::sleep::{Awake, over};
use crate::stages::{Com, Kinematics, Sensors, State, Velocity};

/// Computes the velocity of the centre of mass and the angular momentum about it, of every subtree. Trees that sleep
/// keep their values, and add nothing to what they hang on.
pub fn subtree_momentum(
    m: &Model,
    state: &State,
    kin: &Kinematics,
    com: &Com,
    vel: &Velocity,
    out: &mut Sensors,
) {
    let awake = Awake::of(m, state).bodies(m);
    let body_velocity =
        |b: usize| Frame { body: b, pos: kin.xipos[b], mat: kin.ximat[b] }.velocity(m, com, &vel.cvel);
    over!(awake, |bodies| for b in bodies {
        let v = body_velocity(b);
        out.subtree_linvel[b] = scale(linear(&v), m.body_mass[b]);
        let spin = mul_mat_t_vec(&kin.ximat[b], rotational(&v));
        let momentum: Vec3 = std::array::from_fn(|k| spin[k] * m.body_inertia[b][k]);
        out.subtree_angmom[b] = mul_mat_vec(&kin.ximat[b], momentum);
    });
    over!(awake, |bodies| for b in bodies.rev() {
        let momentum = out.subtree_linvel[b];
        if b > 0 {
            let parent = m.body_parentid[b] as usize;
            out.subtree_linvel[parent] = add(out.subtree_linvel[parent], momentum);
        }
        out.subtree_linvel[b] = scale(momentum, 1.0 / m.body_subtreemass[b].max(MINVAL));
    });
    over!(awake, |bodies| for b in bodies.skip(1).rev() {
        let parent = m.body_parentid[b] as usize;
        let orbital = |arm: Vec3, relative: Vec3, mass: f64| cross(arm, scale(relative, mass));
        let own = orbital(
            sub(kin.xipos[b], com.subtree_com[b]),
            sub(linear(&body_velocity(b)), out.subtree_linvel[b]),
            m.body_mass[b],
        );
        out.subtree_angmom[b] = add(out.subtree_angmom[b], own);
        let about_parent = orbital(
            sub(com.subtree_com[b], com.subtree_com[parent]),
            sub(out.subtree_linvel[b], out.subtree_linvel[parent]),
            m.body_subtreemass[b],
        );
        out.subtree_angmom[parent] =
            add(add(out.subtree_angmom[parent], out.subtree_angmom[b]), about_parent);
    });
}
