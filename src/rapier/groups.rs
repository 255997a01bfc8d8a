//! Groups of welded bodies, each of which is one rigid body of rapier.

use crate::convert::{array, pose, rotation, vector};
use physics::Model;
use physics::math::diagonalize;
use physics::model::JointType;
use rapier3d_f64::math::{Matrix, Pose, Rotation, Vector};
use rapier3d_f64::prelude::MassProperties;

/// What moves a group of welded bodies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Motion {
    /// A free joint without joints below it: a single rigid body.
    Alone,
    /// A free joint, and other joints below it: the root of a multibody.
    Floating,
    /// Joints: a link of a multibody.
    Jointed,
    /// The program.
    Mocap,
}

/// Bodies that are welded together and move.
#[derive(Clone, Debug)]
pub(crate) struct Group {
    /// The topmost body.
    pub body: usize,
    /// Parent group; `None` for the world.
    pub parent: Option<usize>,
    pub motion: Motion,
    /// Centre of mass in the frame of `body`.
    pub com: Vector,
    /// Origin of rapier's rigid body in the frame of `body`. Rapier takes the velocity of a floating root for
    /// that of its origin in one place and of its centre of mass in another, so there the two must coincide.
    pub origin: Vector,
    /// Axes of rapier's rigid body in the frame of `body`: the principal ones of inertia.
    pub axes: Rotation,
    pub mass: MassProperties,
}

/// Groups of a model, parents first, and where each body is.
#[derive(Clone, Debug)]
pub(crate) struct Groups {
    pub all: Vec<Group>,
    /// Group of each body; `None` for bodies fixed to the world.
    pub of_body: Vec<Option<usize>>,
    /// Pose of each body in the frame of the topmost one of its group, or of the world.
    pub within: Vec<Pose>,
}

impl Groups {
    pub fn new(m: &Model) -> Self {
        let mut groups =
            Groups { all: Vec::new(), of_body: vec![None; m.nbody], within: vec![Pose::IDENTITY; m.nbody] };
        for b in 1..m.nbody {
            let parent = m.body_parentid[b] as usize;
            if m.body_weldid[b] as usize == b {
                groups.of_body[b] = Some(groups.all.len());
                groups.all.push(Group::of(m, b, groups.of_body[parent]));
            } else {
                groups.of_body[b] = groups.of_body[parent];
                groups.within[b] = groups.within[parent] * pose(m.body_pos[b], m.body_quat[b]);
            }
        }
        for k in 0..groups.all.len() {
            if groups.all[k].motion == Motion::Floating && !groups.all.iter().any(|g| g.parent == Some(k)) {
                groups.all[k].motion = Motion::Alone;
            }
        }
        groups.weigh(m);
        groups
    }

    /// Composite inertia of each group.
    fn weigh(&mut self, m: &Model) {
        let mut mass = vec![0.0; self.all.len()];
        let mut moment = vec![Vector::ZERO; self.all.len()];
        let com_of = |b: usize| self.within[b] * vector(m.body_ipos[b]);
        for b in 1..m.nbody {
            if let Some(k) = self.of_body[b] {
                mass[k] += m.body_mass[b];
                moment[k] += m.body_mass[b] * com_of(b);
            }
        }
        let mut inertia = vec![Matrix::ZERO; self.all.len()];
        let com: Vec<_> =
            (0..mass.len()).map(|k| if mass[k] > 0.0 { moment[k] / mass[k] } else { moment[k] }).collect();
        for b in 1..m.nbody {
            if let Some(k) = self.of_body[b] {
                let axes = Matrix::from_quat(self.within[b].rotation * rotation(m.body_iquat[b]));
                let own = axes * Matrix::from_diagonal(vector(m.body_inertia[b])) * axes.transpose();
                let r = com_of(b) - com[k];
                let [x, y, z] = array(r);
                let outer = Matrix::from_cols(r * x, r * y, r * z);
                inertia[k] += own + m.body_mass[b] * (Matrix::IDENTITY * r.length_squared() - outer);
            }
        }
        for (k, group) in self.all.iter_mut().enumerate() {
            group.com = com[k];
            group.origin =
                if matches!(group.motion, Motion::Alone | Motion::Floating) { com[k] } else { Vector::ZERO };
            let (moments, axes) = principal(inertia[k]);
            group.axes = axes;
            group.mass = MassProperties::new(axes.inverse() * (com[k] - group.origin), mass[k], moments);
        }
    }

    /// Pose of a body in the frame of rapier's rigid body, or of the world.
    pub fn in_rigid_body(&self, b: usize) -> Pose {
        let frame = self.of_body[b].map_or(Pose::IDENTITY, |k| self.all[k].frame());
        frame.inverse() * self.within[b]
    }
}

impl Group {
    fn of(m: &Model, body: usize, parent: Option<usize>) -> Self {
        let free = |j: usize| JointType::from_code(m.jnt_type[j]) == Some(JointType::Free);
        let motion = match joints(m, body) {
            joints if joints.is_empty() => Motion::Mocap,
            joints if free(joints.start) => Motion::Floating,
            _ => Motion::Jointed,
        };
        let mass = MassProperties::default();
        Group {
            body,
            parent,
            motion,
            com: Vector::ZERO,
            origin: Vector::ZERO,
            axes: Rotation::IDENTITY,
            mass,
        }
    }

    /// Pose of rapier's rigid body in the frame of the body.
    pub fn frame(&self) -> Pose {
        Pose::from_parts(self.origin, self.axes)
    }
}

/// Principal moments of inertia in ascending order, and their axes. When parry adds colliders to a body, even massless ones, it
/// diagonalises the summed inertia again: with seven digits, and wrongly for small bodies (`DEFECTS.md`). A body whose axes are the
/// principal ones, with its moments in ascending order, the order in which parry returns them, is not changed by that.
fn principal(inertia: Matrix) -> (Vector, Rotation) {
    let mut moments = inertia.to_cols_array();
    let size = (moments[0] + moments[4] + moments[8]).max(f64::MIN_POSITIVE);
    moments.iter_mut().for_each(|entry| *entry /= size);
    let mut columns = [0.0; 9];
    diagonalize(&mut moments, &mut columns, 3, 1e-16);
    let mut order = [0, 1, 2];
    order.sort_by(|&a, &b| moments[4 * a].total_cmp(&moments[4 * b]));
    let axis = |k: usize| Vector::new(columns[order[k]], columns[3 + order[k]], columns[6 + order[k]]);
    // Eigenvectors may mirror.
    let axes = Matrix::from_cols(axis(0), axis(1), axis(0).cross(axis(1)));
    let sorted = order.map(|k| moments[4 * k] * size);
    (vector(sorted), Rotation::from_mat3(&axes).normalize())
}

/// Joints of a body.
pub(crate) fn joints(m: &Model, body: usize) -> std::ops::Range<usize> {
    match usize::try_from(m.body_jntadr[body]) {
        Ok(first) => first..first + m.body_jntnum[body] as usize,
        Err(_) => 0..0,
    }
}
