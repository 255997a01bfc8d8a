//! What a simulation says of one element, and what may be written.

use super::element::Element;
use super::ids::{
    ActuatorId, BodyId, CameraId, EqualityId, GeomId, JointId, LightId, SensorId, SiteId, TendonId,
};
use crate::data::Data;
use crate::math::{Mat3, Quat, Vec3};

/// What a simulation says of one element, see [`crate::elements`]. Derived quantities were computed by the last
/// [`forward`](crate::forward), or at the beginning of the last [`step`](crate::step).
#[derive(Clone, Copy, Debug)]
pub struct DataView<'d, I> {
    d: &'d Data,
    id: I,
}

/// State and inputs of one element, to write. Derived quantities follow with the next [`forward`](crate::forward) or
/// [`step`](crate::step).
#[derive(Debug)]
pub struct DataViewMut<'d, I> {
    d: &'d mut Data,
    id: I,
}

macro_rules! views {
    ($($id:ident $one:ident $($one_mut:ident)?;)*) => {
        impl Data {$(
            #[doc = concat!("What the simulation says of one [`", stringify!($id), "`].")]
            ///
            /// # Panics
            /// In debug builds: the id belongs to another model.
            #[track_caller]
            pub fn $one(&self, id: $id) -> DataView<'_, $id> {
                id.origin.check(self.origin);
                DataView { d: self, id }
            }

            $(
                #[doc = concat!("State and inputs of one [`", stringify!($id), "`], to write.")]
                ///
                /// # Panics
                /// In debug builds: the id belongs to another model.
                #[track_caller]
                pub fn $one_mut(&mut self, id: $id) -> DataViewMut<'_, $id> {
                    id.origin.check(self.origin);
                    DataViewMut { d: self, id }
                }
            )?
        )*}
    };
}

views! {
    BodyId body body_mut;
    JointId joint joint_mut;
    GeomId geom;
    SiteId site;
    CameraId camera;
    LightId light;
    TendonId tendon;
    ActuatorId actuator actuator_mut;
    SensorId sensor;
    EqualityId equality equality_mut;
}

impl<I: Element> DataView<'_, I> {
    fn i(self) -> usize {
        self.id.index()
    }
}

impl<'d> DataView<'d, BodyId> {
    /// Position of the body frame, world frame \[m\].
    pub fn xpos(self) -> &'d Vec3 {
        &self.d.kin.xpos[self.i()]
    }

    /// Orientation of the body frame.
    pub fn xquat(self) -> &'d Quat {
        &self.d.kin.xquat[self.i()]
    }

    /// Orientation of the body frame as a matrix, row-major.
    pub fn xmat(self) -> &'d Mat3 {
        &self.d.kin.xmat[self.i()]
    }

    /// Centre of mass, world frame \[m\].
    pub fn xipos(self) -> &'d Vec3 {
        &self.d.kin.xipos[self.i()]
    }

    /// Orientation of the principal axes of inertia as a matrix, row-major.
    pub fn ximat(self) -> &'d Mat3 {
        &self.d.kin.ximat[self.i()]
    }

    /// Centre of mass of the body and all that hangs on it, world frame \[m\].
    pub fn subtree_com(self) -> &'d Vec3 {
        &self.d.com.subtree_com[self.i()]
    }

    /// User wrench at the centre of mass, world frame, force first \[N, N m\].
    pub fn xfrc_applied(self) -> &'d [f64; 6] {
        &self.d.state.xfrc_applied[self.i()]
    }
}

/// The input pose of a mocap body, to write.
#[derive(Debug)]
pub struct MocapPose<'d> {
    /// Position, world frame \[m\].
    pub pos: &'d mut Vec3,
    /// Orientation; the simulation normalises it.
    pub quat: &'d mut Quat,
}

impl<'d> DataViewMut<'d, BodyId> {
    /// User wrench at the centre of mass, world frame, force first \[N, N m\]. It stays until it is changed.
    pub fn set_xfrc_applied(&mut self, wrench: [f64; 6]) {
        self.d.state.xfrc_applied[self.id.index()] = wrench;
    }

    /// The input pose; `None` for a body that is not a mocap body.
    pub fn mocap(self) -> Option<MocapPose<'d>> {
        let k = self.id.mocap? as usize;
        Some(MocapPose { pos: &mut self.d.state.mocap_pos[k], quat: &mut self.d.state.mocap_quat[k] })
    }
}

impl<'d> DataView<'d, JointId> {
    fn dofs(self, array: &'d [f64]) -> &'d [f64] {
        &array[self.id.dof.range()]
    }

    /// Positions: 1 of a hinge or slide \[rad, m\], a quaternion of a ball, position and quaternion of a free joint.
    pub fn qpos(self) -> &'d [f64] {
        &self.d.state.qpos[self.id.qpos.range()]
    }

    /// Velocities: 1 of a hinge or slide, 3 of a ball, linear and angular of a free joint \[rad/s, m/s\].
    pub fn qvel(self) -> &'d [f64] {
        self.dofs(&self.d.state.qvel)
    }

    /// Accelerations \[rad/s², m/s²\].
    pub fn qacc(self) -> &'d [f64] {
        self.dofs(&self.d.acc.qacc)
    }

    /// User forces \[N m, N\].
    pub fn qfrc_applied(self) -> &'d [f64] {
        self.dofs(&self.d.state.qfrc_applied)
    }

    /// Forces of actuators \[N m, N\].
    pub fn qfrc_actuator(self) -> &'d [f64] {
        self.dofs(&self.d.actuation.qfrc_actuator)
    }

    /// Coriolis, centrifugal and gravity forces \[N m, N\].
    pub fn qfrc_bias(self) -> &'d [f64] {
        self.dofs(&self.d.vel.qfrc_bias)
    }

    /// Forces of springs, dampers, fluid and gravity compensation \[N m, N\].
    pub fn qfrc_passive(self) -> &'d [f64] {
        self.dofs(&self.d.passive.qfrc_passive)
    }

    /// Forces of constraints \[N m, N\].
    pub fn qfrc_constraint(self) -> &'d [f64] {
        self.dofs(&self.d.acc.qfrc_constraint)
    }

    /// Anchor, world frame \[m\].
    pub fn xanchor(self) -> &'d Vec3 {
        &self.d.kin.xanchor[self.i()]
    }

    /// Axis, world frame.
    pub fn xaxis(self) -> &'d Vec3 {
        &self.d.kin.xaxis[self.i()]
    }
}

impl DataViewMut<'_, JointId> {
    /// Positions, as many as [`DataView::qpos`] has.
    pub fn qpos_mut(&mut self) -> &mut [f64] {
        &mut self.d.state.qpos[self.id.qpos.range()]
    }

    /// Velocities, as many as [`DataView::qvel`] has.
    pub fn qvel_mut(&mut self) -> &mut [f64] {
        &mut self.d.state.qvel[self.id.dof.range()]
    }

    /// User forces, as many as there are velocities \[N m, N\]. They stay until they are changed.
    pub fn qfrc_applied_mut(&mut self) -> &mut [f64] {
        &mut self.d.state.qfrc_applied[self.id.dof.range()]
    }

    /// Sets the positions.
    ///
    /// # Panics
    /// The number of values differs from [`DataView::qpos`].
    pub fn set_qpos(&mut self, values: impl AsRef<[f64]>) {
        self.qpos_mut().copy_from_slice(values.as_ref());
    }

    /// Sets the velocities.
    ///
    /// # Panics
    /// There are more or fewer values than [`DataView::qvel`] has.
    pub fn set_qvel(&mut self, values: impl AsRef<[f64]>) {
        self.qvel_mut().copy_from_slice(values.as_ref());
    }

    /// Sets the user forces \[N m, N\].
    ///
    /// # Panics
    /// There are more or fewer values than [`DataView::qvel`] has.
    pub fn set_qfrc_applied(&mut self, values: impl AsRef<[f64]>) {
        self.qfrc_applied_mut().copy_from_slice(values.as_ref());
    }
}

/// Poses of what is fixed to bodies.
macro_rules! poses {
    ($($id:ident $pos:ident $mat:ident;)*) => {$(
        impl<'d> DataView<'d, $id> {
            /// Position, world frame \[m\].
            pub fn xpos(self) -> &'d Vec3 {
                &self.d.kin.$pos[self.i()]
            }

            /// Orientation as a matrix, row-major.
            pub fn xmat(self) -> &'d Mat3 {
                &self.d.kin.$mat[self.i()]
            }
        }
    )*};
}

poses! {
    GeomId geom_xpos geom_xmat;
    SiteId site_xpos site_xmat;
    CameraId cam_xpos cam_xmat;
}

impl<'d> DataView<'d, LightId> {
    /// Position, world frame \[m\].
    pub fn xpos(self) -> &'d Vec3 {
        &self.d.kin.light_xpos[self.i()]
    }

    /// Direction, world frame.
    pub fn xdir(self) -> &'d Vec3 {
        &self.d.kin.light_xdir[self.i()]
    }
}

impl DataView<'_, TendonId> {
    /// Length [m; rad for fixed tendons of hinges].
    pub fn length(self) -> f64 {
        self.d.ten.ten_length[self.i()]
    }

    /// Velocity [m/s; rad/s for fixed tendons of hinges].
    pub fn velocity(self) -> f64 {
        self.d.vel.ten_velocity[self.i()]
    }
}

impl<'d> DataView<'d, ActuatorId> {
    /// Controls, 1 for most actuators.
    pub fn ctrl(self) -> &'d [f64] {
        &self.d.state.ctrl[self.id.ctrl.range()]
    }

    /// Activations, empty for an actuator without dynamics.
    pub fn act(self) -> &'d [f64] {
        &self.d.state.act[self.id.act.range()]
    }

    /// Forces, 1 for most actuators \[N, N m\].
    pub fn force(self) -> &'d [f64] {
        &self.d.actuation.actuator_force[self.id.out.range()]
    }

    /// Lengths, as many as forces \[m, rad\].
    pub fn length(self) -> &'d [f64] {
        &self.d.trn.actuator_length[self.id.out.range()]
    }

    /// Velocities, as many as forces \[m/s, rad/s\].
    pub fn velocity(self) -> &'d [f64] {
        &self.d.vel.actuator_velocity[self.id.out.range()]
    }
}

impl DataViewMut<'_, ActuatorId> {
    /// Sets the control; of an actuator with several, each of them.
    pub fn set_ctrl(&mut self, value: f64) {
        self.ctrl_mut().fill(value);
    }

    /// Controls, 1 for most actuators.
    pub fn ctrl_mut(&mut self) -> &mut [f64] {
        &mut self.d.state.ctrl[self.id.ctrl.range()]
    }

    /// Activations, empty for an actuator without dynamics.
    pub fn act_mut(&mut self) -> &mut [f64] {
        &mut self.d.state.act[self.id.act.range()]
    }
}

impl<'d> DataView<'d, SensorId> {
    /// Its readings.
    pub fn data(self) -> &'d [f64] {
        &self.d.sensor.sensordata[self.id.data.range()]
    }
}

impl DataView<'_, EqualityId> {
    /// The constraint is on.
    pub fn active(self) -> bool {
        self.d.state.eq_active[self.i()]
    }
}

impl DataViewMut<'_, EqualityId> {
    /// Switches the constraint.
    pub fn set_active(&mut self, active: bool) {
        self.d.state.eq_active[self.id.index()] = active;
    }
}
