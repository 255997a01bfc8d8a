//! Poses and the ways MJCF writes an orientation (XML reference, "Frame orientations").

use crate::spec::{Spec, UNIT, minimal_rotation, resolve};
use crate::vector::{EPS, apply, compose, matrix, normalize, rotate, sub};
use physics::math::{Quat, Vec3};
use physics::model::SameFrame;

/// Frames that differ by less coincide.
const SAME: f64 = 1e-6;
/// Position and orientation in a parent frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Pose {
    pub pos: Vec3,
    pub quat: Quat,
}

impl Pose {
    pub(super) const IDENTITY: Pose = Pose { pos: [0.0; 3], quat: UNIT };

    /// The pose of `child`, given in this frame, in the frame of `self`'s parent.
    pub(super) fn then(&self, child: &Pose) -> Pose {
        let turned = apply(&matrix(self.quat), child.pos);
        Pose { pos: add(self.pos, turned), quat: compose(self.quat, child.quat) }
    }

    /// The parent's pose in this frame.
    pub(super) fn inverse(&self) -> Pose {
        let quat = [self.quat[0], -self.quat[1], -self.quat[2], -self.quat[3]];
        let pos = apply(&matrix(quat), self.pos);
        Pose { pos: [-pos[0], -pos[1], -pos[2]], quat }
    }

    /// Position of a point given in this frame.
    pub(super) fn point(&self, p: Vec3) -> Vec3 {
        self.then(&Pose { pos: p, quat: UNIT }).pos
    }
}

pub(super) fn add(a: Vec3, b: Vec3) -> Vec3 {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

/// Pose of every frame of the model in its body.
pub(super) fn frame_poses(spec: &Spec) -> Vec<Result<Pose, String>> {
    let mut poses: Vec<Result<Pose, String>> = Vec::with_capacity(spec.frames.len());
    for frame in &spec.frames {
        let own = resolve(frame.quat, frame.alt, spec.compiler_at(frame.loc))
            .map(|quat| Pose { pos: frame.pos, quat })
            .map(|own| match frame.parent.and_then(|p| poses.get(p)) {
                Some(Ok(parent)) => parent.then(&own),
                _ => own,
            });
        poses.push(own.map(|mut pose| {
            normalize(&mut pose.quat);
            pose
        }));
    }
    poses
}

/// Centre, orientation and half length of the segment from `a` to `b`; its z axis points from `b` to `a`.
pub(super) fn segment(fromto: [f64; 6]) -> Result<(Pose, f64), String> {
    let (a, b) = ([fromto[0], fromto[1], fromto[2]], [fromto[3], fromto[4], fromto[5]]);
    let mut direction = sub(a, b);
    let half = normalize(&mut direction) / 2.0;
    if half < EPS {
        return Err("the points of fromto coincide".into());
    }
    let pos = [(a[0] + b[0]) / 2.0, (a[1] + b[1]) / 2.0, (a[2] + b[2]) / 2.0];
    Ok((Pose { pos, quat: minimal_rotation(direction) }, half))
}

/// Direction `v` given in a frame of orientation `quat`.
pub(super) fn direction(quat: Quat, v: Vec3) -> Vec3 {
    rotate(v, quat)
}

pub(super) fn same_position(a: Vec3, b: Vec3) -> bool {
    (0..3).all(|k| (a[k] - b[k]).abs() < SAME)
}

/// True when two quaternions, or one and the negative of the other, coincide.
pub(super) fn same_orientation(a: Quat, b: Quat) -> bool {
    (0..4).all(|k| (a[k] - b[k]).abs() < SAME) || (0..4).all(|k| (a[k] + b[k]).abs() < SAME)
}

/// How a pose coincides with its parent's pose.
pub(super) fn same_frame(pose: Pose) -> SameFrame {
    match (same_position(pose.pos, [0.0; 3]), same_orientation(pose.quat, UNIT)) {
        (true, true) => SameFrame::Body,
        (false, true) => SameFrame::Bodyrot,
        _ => SameFrame::None,
    }
}

/// How the frame of something in a body coincides with the body's or its inertial frame.
pub(super) fn same_frame_in_body(pose: Pose, inertial: Pose) -> SameFrame {
    let same = same_frame(pose);
    if same != SameFrame::None {
        return same;
    }
    match (same_position(pose.pos, inertial.pos), same_orientation(pose.quat, inertial.quat)) {
        (true, true) => SameFrame::Inertia,
        (false, true) => SameFrame::Inertiarot,
        _ => SameFrame::None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn close(a: Quat, b: Quat) -> bool {
        (0..4).all(|k| (a[k] - b[k]).abs() < 1e-14)
    }

    #[test]
    fn pose_composed_with_its_inverse_is_the_identity() {
        let mut quat = [0.3, -0.2, 0.7, 0.4];
        normalize(&mut quat);
        let pose = Pose { pos: [1.0, -2.0, 0.5], quat };
        let id = pose.then(&pose.inverse());
        assert!(close(id.quat, UNIT) && same_position(id.pos, [0.0; 3]));
    }
}
