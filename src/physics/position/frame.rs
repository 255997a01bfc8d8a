//! Frames attached to bodies: position, orientation, velocity and acceleration of bodies, geoms, sites and cameras.

use crate::math::{
    Mat3, Quat, Spatial, Vec3, add, cross, linear, mul_mat_t_vec, quat_mul, rotational, spatial, sub,
};
use crate::model::{Model, ObjType};
use crate::position::chain::com_offset;
use crate::stages::{Com, Kinematics};

/// A frame that moves with a body.
#[derive(Clone, Copy, Debug)]
pub struct Frame {
    /// Body that carries the frame.
    pub body: usize,
    /// Origin, world.
    pub pos: Vec3,
    /// Orientation, world.
    pub mat: Mat3,
}

/// Frame of element `id` of kind `kind`; `None` for kinds that have none. `Body` means the inertial frame,
/// `Xbody` the regular one.
pub fn frame(m: &Model, kin: &Kinematics, kind: ObjType, id: usize) -> Option<Frame> {
    Some(match kind {
        ObjType::Body => Frame { body: id, pos: kin.xipos[id], mat: kin.ximat[id] },
        ObjType::Xbody => Frame { body: id, pos: kin.xpos[id], mat: kin.xmat[id] },
        ObjType::Geom => geom_frame(m, kin, id),
        ObjType::Site => {
            Frame { body: m.site_bodyid[id] as usize, pos: kin.site_xpos[id], mat: kin.site_xmat[id] }
        }
        ObjType::Camera => {
            Frame { body: m.cam_bodyid[id] as usize, pos: kin.cam_xpos[id], mat: kin.cam_xmat[id] }
        }
        _ => return None,
    })
}

/// Frame of geom `id`.
pub fn geom_frame(m: &Model, kin: &Kinematics, id: usize) -> Frame {
    Frame { body: m.geom_bodyid[id] as usize, pos: kin.geom_xpos[id], mat: kin.geom_xmat[id] }
}

/// Global orientation of element `id`, composed from the body's without passing through a matrix.
pub fn quat(m: &Model, kin: &Kinematics, kind: ObjType, id: usize) -> Option<Quat> {
    let on_body = |body: i32, local: Quat| quat_mul(kin.xquat[body as usize], local);
    Some(match kind {
        ObjType::Xbody => kin.xquat[id],
        ObjType::Body => quat_mul(kin.xquat[id], m.body_iquat[id]),
        ObjType::Geom => on_body(m.geom_bodyid[id], m.geom_quat[id]),
        ObjType::Site => on_body(m.site_bodyid[id], m.site_quat[id]),
        ObjType::Camera => on_body(m.cam_bodyid[id], m.cam_quat[id]),
        _ => return None,
    })
}

impl Frame {
    /// Velocity of the frame in world orientation; zero on bodies without degrees of freedom.
    #[inline]
    pub fn velocity(&self, m: &Model, com: &Com, cvel: &[Spatial]) -> Spatial {
        if m.body_dofnum[m.body_weldid[self.body] as usize] == 0 {
            return [0.0; 6];
        }
        self.moved(m, com, &cvel[self.body])
    }

    /// Acceleration of the frame in world orientation, as an observer moving along would differentiate; zero on
    /// bodies without degrees of freedom.
    pub fn acceleration(&self, m: &Model, com: &Com, cvel: &[Spatial], cacc: &[Spatial]) -> Spatial {
        if m.body_dofnum[m.body_weldid[self.body] as usize] == 0 {
            return [0.0; 6];
        }
        observed(&self.moved(m, com, &cvel[self.body]), &self.moved(m, com, &cacc[self.body]))
    }

    /// The same in the orientation of the frame.
    pub fn local_acceleration(&self, m: &Model, com: &Com, cvel: &[Spatial], cacc: &[Spatial]) -> Spatial {
        if m.body_dofnum[m.body_weldid[self.body] as usize] == 0 {
            return [0.0; 6];
        }
        let local = |motion: &Spatial| self.local(&self.moved(m, com, motion));
        observed(&local(&cvel[self.body]), &local(&cacc[self.body]))
    }

    /// A com-based motion of the body, seen at the origin of the frame.
    #[inline]
    fn moved(&self, m: &Model, com: &Com, motion: &Spatial) -> Spatial {
        let offset = com_offset(m, com, self.body, self.pos);
        spatial(rotational(motion), sub(linear(motion), cross(offset, rotational(motion))))
    }

    /// `v`, given in world orientation, in the orientation of the frame.
    pub fn local(&self, v: &Spatial) -> Spatial {
        spatial(mul_mat_t_vec(&self.mat, rotational(v)), mul_mat_t_vec(&self.mat, linear(v)))
    }
}

/// Acceleration of a point that moves along, from spatial velocity and acceleration: `w × v` is added.
fn observed(v: &Spatial, a: &Spatial) -> Spatial {
    spatial(rotational(a), add(linear(a), cross(rotational(v), linear(v))))
}
