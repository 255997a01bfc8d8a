//! A hand that pulls or turns a body: a critically damped spring between a point of the body and where the pointer wants it
//! (documentation: programming, `mjvPerturb`).

use crate::camera::{PARALLEL, Plane};
use physics::math::{
    MINVAL, Quat, Vec3, add, add_scaled, cross, dot, linear, mul_mat_vec, normalize, quat_conj,
    quat_from_axis_angle, quat_mul, quat_normalize, quat_rotate, quat_to_velocity, rotational, scale, sub,
};
use physics::model::JointType;
use physics::position::jacobian::Jacobian;
use physics::{Data, Model, inertia};
use render::View;
use render::scene::{Pull, Selection};
use std::f64::consts::{FRAC_PI_2, TAU};

/// What a drag does with a body.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Grip {
    /// Pulls the selected point.
    Pull,
    /// Turns the body.
    Turn,
}

/// A hand on a body.
#[derive(Clone, Debug)]
pub struct Hand {
    pub(crate) grip: Grip,
    /// Body and point that are held.
    body: usize,
    point: Vec3,
    /// Mass that the point seems to have \[kg\].
    pub(crate) mass: f64,
    /// Metres in the world for a drag over the height of the view.
    pub(crate) reach: f64,
    /// Where the point, and the frame of the body's inertia, are wanted, world frame.
    pub(crate) target: Vec3,
    pub(crate) origin: Vec3,
    pub(crate) orientation: Quat,
}

impl Hand {
    /// Takes hold of `body` at `point`, in its frame \[m\], as seen from `view`. Poses and inertia must have been evaluated.
    ///
    /// `None` for the world, which cannot be held.
    pub fn grab(
        model: &Model,
        data: &Data,
        view: &View,
        grip: Grip,
        body: usize,
        point: Vec3,
    ) -> Option<Self> {
        if !(1..model.nbody).contains(&body) {
            return None;
        }
        let target = held(data, body, point);
        let depth = dot(sub(target, view.eye), view.forward);
        let height = view.frustum.top - view.frustum.bottom;
        let reach = if view.frustum.orthographic {
            PARALLEL * height * depth
        } else {
            height / view.frustum.near * depth
        };
        Some(Hand {
            grip,
            body,
            point,
            mass: apparent_mass(model, data, body, target),
            reach,
            target,
            origin: data.kin.xipos[body],
            orientation: inertial(model, data, body),
        })
    }

    /// The body that is held.
    pub fn body(&self) -> usize {
        self.body
    }

    /// Moves the hand by a drag, in heights of the view.
    pub fn drag(&mut self, model: &Model, data: &Data, view: &View, plane: Plane, drag: [f64; 2]) {
        match self.grip {
            Grip::Pull => {
                let shift = scale(plane.displacement(drag, view.forward), self.reach);
                self.target = add(self.target, shift);
                self.origin = add(self.origin, shift);
            }
            Grip::Turn => {
                let (axis, turn) = normalize(plane.axis(drag, view.forward));
                let wanted = quat_mul(quat_from_axis_angle(axis, TAU * turn), self.orientation);
                self.orientation =
                    within_quarter_turn(inertial(model, data, self.body), quat_normalize(wanted));
            }
        }
    }

    /// Force and torque on the body's centre of mass \[N, N m\] that draw it to where it is wanted, world frame; poses and
    /// velocities must have been evaluated.
    pub fn wrench(&self, model: &Model, data: &Data) -> [Vec3; 2] {
        let (kin, body) = (&data.kin, self.body);
        let root = model.body_rootid[body] as usize;
        let spin = rotational(&data.vel.cvel[body]);
        let from_tree = sub(kin.xipos[body], data.com.subtree_com[root]);
        let velocity = add(linear(&data.vel.cvel[body]), cross(spin, from_tree));
        let invweight = model.body_invweight0[body][1];
        let inertia = if invweight == 0.0 { 1.0 } else { 1.0 / invweight.max(MINVAL) };
        let stiffness = f64::from(model.vis.map.stiffness);
        let turning = f64::from(model.vis.map.stiffnessrot);
        match self.grip {
            Grip::Pull => {
                let point = held(data, body, self.point);
                let (away, arm) = (sub(point, self.target), sub(point, kin.xipos[body]));
                let moving = add(cross(spin, arm), velocity);
                let pull = scale(away, -stiffness * self.mass);
                let force = add_scaled(pull, moving, -stiffness.sqrt() * self.mass);
                let along = normalize(away).0;
                let brake = -turning.sqrt() * inertia * dot(along, spin);
                [force, add_scaled(cross(arm, force), along, brake)]
            }
            Grip::Turn => {
                let missing = quat_mul(self.orientation, quat_conj(inertial(model, data, body)));
                let spring = quat_to_velocity(missing, 1.0 / (turning * inertia));
                [[0.0; 3], add_scaled(spring, spin, -turning.sqrt() * inertia)]
            }
        }
    }

    /// Puts a body where it is wanted, without physics: mocap bodies always; where `paused`, also a floating body, or the
    /// floating root of its tree. Returns whether the state has changed.
    pub fn place(&self, model: &Model, data: &mut Data, paused: bool) -> bool {
        let body = self.body;
        let turn = quat_conj(model.body_iquat[body]);
        let to_frame = (scale(quat_rotate(turn, model.body_ipos[body]), -1.0), turn);
        let wanted = compose((self.origin, self.orientation), to_frame);
        let root = model.body_rootid[body] as usize;
        if let Ok(mocap) = usize::try_from(model.body_mocapid[body]) {
            (data.state.mocap_pos[mocap], data.state.mocap_quat[mocap]) = wanted;
            return true;
        }
        if !paused {
            return false;
        }
        if let Some(place) = floating(model, body) {
            set_pose(&mut data.state.qpos, place, wanted);
            return true;
        }
        let Some(place) = floating(model, root) else { return false };
        let rooted = pose(&data.state.qpos, place);
        let back = quat_conj(data.kin.xquat[body]);
        let body_to_world = (scale(quat_rotate(back, data.kin.xpos[body]), -1.0), back);
        set_pose(&mut data.state.qpos, place, compose(wanted, compose(body_to_world, rooted)));
        true
    }

    /// What a scene shows of it.
    pub fn selection(&self) -> Selection {
        let pull = Pull { translation: self.grip == Grip::Pull, rotation: self.grip == Grip::Turn };
        Selection {
            body: self.body,
            point: self.point,
            pull,
            second_pull: Pull::default(),
            target: self.target,
            orientation: self.orientation,
        }
    }
}

/// A point of a body, world frame.
fn held(data: &Data, body: usize, point: Vec3) -> Vec3 {
    add(mul_mat_vec(&data.kin.xmat[body], point), data.kin.xpos[body])
}

/// Orientation of the frame of a body's inertia.
fn inertial(model: &Model, data: &Data, body: usize) -> Quat {
    quat_mul(data.kin.xquat[body], model.body_iquat[body])
}

/// The mass that a force at a point meets, averaged over its directions: 3 / tr(J M⁻¹ Jᵀ), or 1 where nothing moves.
fn apparent_mass(model: &Model, data: &Data, body: usize, point: Vec3) -> f64 {
    let mut jacobian = Jacobian::default();
    jacobian.point(model, &data.com, body, point);
    let mut mobility = 0.0;
    for row in jacobian.pos.chunks_exact(model.nv.max(1)) {
        let mut moved = row.to_vec();
        inertia::solve(model, &data.inertia, &mut moved);
        mobility += row.iter().zip(&moved).map(|(j, x)| j * x).sum::<f64>();
    }
    if mobility == 0.0 { 1.0 } else { 3.0 / mobility.max(MINVAL) }
}

/// `wanted`, or the orientation a quarter turn from `now` on the way there.
fn within_quarter_turn(now: Quat, wanted: Quat) -> Quat {
    let (axis, angle) = normalize(quat_to_velocity(quat_mul(quat_conj(now), wanted), 1.0));
    if angle <= FRAC_PI_2 { wanted } else { quat_mul(now, quat_from_axis_angle(axis, FRAC_PI_2)) }
}

/// Where in `qpos` the pose of a body stands that a free joint alone moves.
fn floating(model: &Model, body: usize) -> Option<usize> {
    let joint = usize::try_from(model.body_jntadr[body]).ok()?;
    let free = model.jnt_type[joint] == JointType::Free.code();
    (free && model.body_jntnum[body] == 1).then(|| model.jnt_qposadr[joint] as usize)
}

/// One frame in another.
type Pose = (Vec3, Quat);

/// A frame inside of another one.
fn compose((pos, quat): Pose, (inner_pos, inner_quat): Pose) -> Pose {
    (add(pos, quat_rotate(quat, inner_pos)), quat_mul(quat, inner_quat))
}

fn pose(qpos: &[f64], at: usize) -> Pose {
    (std::array::from_fn(|i| qpos[at + i]), std::array::from_fn(|i| qpos[at + 3 + i]))
}

fn set_pose(qpos: &mut [f64], at: usize, (pos, quat): Pose) {
    qpos[at..at + 3].copy_from_slice(&pos);
    qpos[at + 3..at + 7].copy_from_slice(&quat);
}
