//! What a model says of one element.

use super::element::Element;
use super::ids::{
    ActuatorId, BodyId, CameraId, EqualityId, GeomId, JointId, KeyId, LightId, MaterialId, NumericId,
    SensorId, SiteId, TendonId, TextId, within,
};
use crate::math::{Quat, Vec3};
use crate::model::{EqType, GeomType, JointType, Model, ObjType, SensorType};

/// What a model says of one element, see [`crate::elements`].
#[derive(Clone, Copy, Debug)]
pub struct ModelView<'m, I> {
    m: &'m Model,
    id: I,
}

impl<'m, I: Element> ModelView<'m, I> {
    #[track_caller]
    pub(super) fn new(m: &'m Model, id: I) -> Self {
        id.check_model(m);
        ModelView { m, id }
    }

    /// Its id.
    pub fn id(self) -> I {
        self.id
    }

    /// Its name, empty when it has none.
    pub fn name(self) -> &'m str {
        self.m.name_of(I::KIND, self.id.index())
    }

    fn i(self) -> usize {
        self.id.index()
    }
}

/// The element that a stored reference leads to; -1 is none.
fn reference<I: Element>(m: &Model, index: i32) -> Option<I> {
    I::at(m, usize::try_from(index).ok()?)
}

impl<'m> ModelView<'m, BodyId> {
    /// The body it hangs on; `None` for the world.
    pub fn parent(self) -> Option<BodyId> {
        if self.i() == 0 { None } else { reference(self.m, self.m.body_parentid[self.i()]) }
    }

    /// Bodies that hang on it.
    pub fn children(self) -> impl Iterator<Item = BodyId> + 'm {
        let all = within::<BodyId>(self.m, 0, self.m.nbody);
        all.filter(move |&body| ModelView::new(self.m, body).parent() == Some(self.id))
    }

    /// Mass \[kg\].
    pub fn mass(self) -> f64 {
        self.m.body_mass[self.i()]
    }

    /// Mass of the body and all that hangs on it \[kg\].
    pub fn subtree_mass(self) -> f64 {
        self.m.body_subtreemass[self.i()]
    }

    /// Principal moments of inertia \[kg m²\].
    pub fn inertia(self) -> Vec3 {
        self.m.body_inertia[self.i()]
    }

    /// Position in the frame of the parent at `qpos0` \[m\].
    pub fn pos(self) -> Vec3 {
        self.m.body_pos[self.i()]
    }

    /// Orientation in the frame of the parent at `qpos0`.
    pub fn quat(self) -> Quat {
        self.m.body_quat[self.i()]
    }

    /// Joints that move it.
    pub fn joints(self) -> impl ExactSizeIterator<Item = JointId> + 'm {
        within(self.m, self.m.body_jntadr[self.i()].max(0) as usize, self.m.body_jntnum[self.i()] as usize)
    }

    /// Geoms fixed to it.
    pub fn geoms(self) -> impl ExactSizeIterator<Item = GeomId> + 'm {
        within(self.m, self.m.body_geomadr[self.i()].max(0) as usize, self.m.body_geomnum[self.i()] as usize)
    }

    /// Its pose is an input of the simulation.
    pub fn is_mocap(self) -> bool {
        self.id.mocap.is_some()
    }
}

impl ModelView<'_, JointId> {
    /// Kind of joint; `None` for a code that no kind has.
    pub fn kind(self) -> Option<JointType> {
        JointType::from_code(self.m.jnt_type[self.i()])
    }

    /// Body that it moves.
    pub fn body(self) -> BodyId {
        BodyId::of(self.m, self.m.jnt_bodyid[self.i()] as usize)
    }

    /// Limits, where they are enforced \[m, rad\].
    pub fn range(self) -> Option<[f64; 2]> {
        self.m.jnt_limited[self.i()].then(|| self.m.jnt_range[self.i()])
    }

    /// Axis in the frame of the body, of unit length.
    pub fn axis(self) -> Vec3 {
        self.m.jnt_axis[self.i()]
    }

    /// Anchor in the frame of the body \[m\].
    pub fn pos(self) -> Vec3 {
        self.m.jnt_pos[self.i()]
    }

    /// Where its positions stand in `qpos`.
    pub fn qpos_range(self) -> std::ops::Range<usize> {
        self.id.qpos.range()
    }

    /// Where its degrees of freedom stand in `qvel`, forces and columns of Jacobians.
    pub fn dof_range(self) -> std::ops::Range<usize> {
        self.id.dof.range()
    }
}

impl ModelView<'_, GeomId> {
    /// Shape; `None` for a code that no shape has.
    pub fn shape(self) -> Option<GeomType> {
        GeomType::from_code(self.m.geom_type[self.i()])
    }

    /// Body that it is fixed to.
    pub fn body(self) -> BodyId {
        BodyId::of(self.m, self.m.geom_bodyid[self.i()] as usize)
    }

    /// Sizes by shape, half extents and radii \[m\].
    pub fn size(self) -> Vec3 {
        self.m.geom_size[self.i()]
    }

    /// Sliding, torsional and rolling friction.
    pub fn friction(self) -> Vec3 {
        self.m.geom_friction[self.i()]
    }

    /// Material it is drawn with.
    pub fn material(self) -> Option<MaterialId> {
        reference(self.m, self.m.geom_matid[self.i()])
    }
}

impl ModelView<'_, SiteId> {
    /// Body that it is fixed to.
    pub fn body(self) -> BodyId {
        BodyId::of(self.m, self.m.site_bodyid[self.i()] as usize)
    }

    /// Position in the frame of the body \[m\].
    pub fn pos(self) -> Vec3 {
        self.m.site_pos[self.i()]
    }
}

impl ModelView<'_, CameraId> {
    /// Body that it is fixed to.
    pub fn body(self) -> BodyId {
        BodyId::of(self.m, self.m.cam_bodyid[self.i()] as usize)
    }

    /// Vertical field of view \[deg\], or vertical extent of an orthographic camera \[m\].
    pub fn fovy(self) -> f64 {
        self.m.cam_fovy[self.i()]
    }

    /// Width and height \[pixel\].
    pub fn resolution(self) -> [i32; 2] {
        self.m.cam_resolution[self.i()]
    }
}

impl ModelView<'_, LightId> {
    /// Body that it is fixed to.
    pub fn body(self) -> BodyId {
        BodyId::of(self.m, self.m.light_bodyid[self.i()] as usize)
    }
}

impl ModelView<'_, TendonId> {
    /// Limits of its length, where they are enforced \[m\].
    pub fn range(self) -> Option<[f64; 2]> {
        self.m.tendon_limited[self.i()].then(|| self.m.tendon_range[self.i()])
    }
}

impl ModelView<'_, EqualityId> {
    /// Kind of constraint; `None` for a code that no kind has.
    pub fn kind(self) -> Option<EqType> {
        EqType::from_code(self.m.eq_type[self.i()])
    }
}

impl<'m> ModelView<'m, ActuatorId> {
    /// Limits of its controls; `None` for one that is not limited.
    pub fn ctrl_ranges(self) -> impl ExactSizeIterator<Item = Option<[f64; 2]>> + 'm {
        self.id
            .ctrl
            .range()
            .map(move |k| self.m.actuator_ctrllimited[k].then(|| self.m.actuator_ctrlrange[k]))
    }

    /// Limits of its force, where they are enforced \[N, N m\].
    pub fn force_range(self) -> Option<[f64; 2]> {
        self.m.actuator_forcelimited[self.i()].then(|| self.m.actuator_forcerange[self.i()])
    }

    /// Where its controls stand in `ctrl`.
    pub fn ctrl_range(self) -> std::ops::Range<usize> {
        self.id.ctrl.range()
    }
}

impl ModelView<'_, SensorId> {
    /// Kind of sensor; `None` for a code that no kind has.
    pub fn kind(self) -> Option<SensorType> {
        SensorType::from_code(self.m.sensor_type[self.i()])
    }

    /// Number of its readings.
    pub fn dim(self) -> usize {
        self.id.data.range().len()
    }

    /// Kind and index of the element that it measures.
    pub fn object(self) -> Option<(ObjType, usize)> {
        let kind = ObjType::from_code(self.m.sensor_objtype[self.i()])?;
        Some((kind, usize::try_from(self.m.sensor_objid[self.i()]).ok()?))
    }

    /// Where its readings stand in `sensordata`.
    pub fn data_range(self) -> std::ops::Range<usize> {
        self.id.data.range()
    }
}

impl<'m> ModelView<'m, NumericId> {
    /// Its numbers.
    pub fn data(self) -> &'m [f64] {
        let start = self.m.numeric_adr[self.i()] as usize;
        &self.m.numeric_data[start..start + self.m.numeric_size[self.i()] as usize]
    }
}

impl<'m> ModelView<'m, TextId> {
    /// Its text, up to the first byte that is not UTF-8.
    pub fn data(self) -> &'m str {
        let start = self.m.text_adr[self.i()] as usize;
        let bytes = &self.m.text_data[start..start + self.m.text_size[self.i()] as usize];
        let bytes = bytes.strip_suffix(&[0]).unwrap_or(bytes);
        bytes.utf8_chunks().next().map_or("", |chunk| chunk.valid())
    }
}

impl ModelView<'_, KeyId> {
    /// Time that the keyframe sets \[s\].
    pub fn time(self) -> f64 {
        self.m.key_time[self.i()]
    }
}
