//! The table of ids: one row for each kind of named element.

use super::element::{Element, Span};
use crate::caches::origin::Origin;
use crate::model::array::Place;
use crate::model::{Arrays, JointType, Model, ObjType, counts};

macro_rules! ids {
    ($($(#[$doc:meta])* $id:ident $kind:ident $count:ident
        { $($field:ident : $t:ty = |$m:ident, $i:ident| $value:expr,)* })*) => {$(
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
        pub struct $id {
            index: u32,
            pub(super) origin: Origin,
            $(pub(super) $field: $t,)*
        }

        impl $id {
            /// Place in the arrays of this kind of element.
            pub const fn index(self) -> usize {
                self.index as usize
            }
        }

        impl Element for $id {
            const KIND: ObjType = ObjType::$kind;

            fn count(m: &Arrays) -> usize {
                m.$count
            }

            #[allow(unused_variables)]
            fn of(m: &Model, index: usize) -> Self {
                $id {
                    index: index as u32,
                    origin: m.origin(),
                    $($field: { let ($m, $i) = (m, index); $value },)*
                }
            }

            fn index(self) -> usize {
                self.index as usize
            }

            #[track_caller]
            fn check_model(self, m: &Model) {
                self.origin.check(m.origin());
            }
        }

        impl<R> Place<R, counts::$count> for $id {
            type Output = R;

            fn of(self, rows: &[R]) -> &R {
                &rows[self.index()]
            }

            fn of_mut(self, rows: &mut [R]) -> &mut R {
                &mut rows[self.index()]
            }
        }
    )*};
}

ids! {
    /// A body; the world is the first.
    BodyId Body nbody {
        mocap: Option<u32> = |m, i| u32::try_from(m.body_mocapid[i]).ok(),
    }
    /// A joint.
    JointId Joint njnt {
        qpos: Span = |m, i| Span::new(m.jnt_qposadr[i], width(m, i)[0]),
        dof: Span = |m, i| Span::new(m.jnt_dofadr[i], width(m, i)[1]),
    }
    /// A geom.
    GeomId Geom ngeom {}
    /// A site.
    SiteId Site nsite {}
    /// A camera.
    CameraId Camera ncam {}
    /// A light.
    LightId Light nlight {}
    /// A mesh.
    MeshId Mesh nmesh {}
    /// A skin.
    SkinId Skin nskin {}
    /// A height field.
    HfieldId Hfield nhfield {}
    /// A texture.
    TextureId Texture ntex {}
    /// A material.
    MaterialId Material nmat {}
    /// A pair of geoms with contact parameters of its own.
    PairId Pair npair {}
    /// A pair of bodies that never collide.
    ExcludeId Exclude nexclude {}
    /// An equality constraint.
    EqualityId Equality neq {}
    /// A tendon.
    TendonId Tendon ntendon {}
    /// An actuator.
    ActuatorId Actuator nactuator {
        ctrl: Span = |m, i| Span::new(m.actuator_ctrladr[i], m.actuator_ctrlnum[i]),
        act: Span = |m, i| Span::new(m.actuator_actadr[i], m.actuator_actnum[i]),
        out: Span = |m, i| Span::new(m.actuator_outadr[i], m.actuator_outnum[i]),
    }
    /// A sensor.
    SensorId Sensor nsensor {
        data: Span = |m, i| Span::new(m.sensor_adr[i], m.sensor_dim[i]),
    }
    /// A custom field of numbers.
    NumericId Numeric nnumeric {}
    /// A custom field of text.
    TextId Text ntext {}
    /// A custom tuple of elements.
    TupleId Tuple ntuple {}
    /// A keyframe.
    KeyId Key nkey {}
}

/// Positions and degrees of freedom of joint `i`.
fn width(m: &Arrays, i: usize) -> [i32; 2] {
    match JointType::from_code(m.jnt_type[i]) {
        Some(JointType::Free) => [7, 6],
        Some(JointType::Ball) => [4, 3],
        Some(JointType::Slide | JointType::Hinge) | None => [1, 1],
    }
}

/// `count` elements of one kind from `first` on.
pub(super) fn within<I: Element>(
    m: &Model,
    first: usize,
    count: usize,
) -> impl ExactSizeIterator<Item = I> + Clone + '_ {
    (first..first + count).map(|index| I::of(m, index))
}

/// A geom of the model of `origin`, which has more than `index`.
pub(super) const fn geom_at(origin: Origin, index: usize) -> GeomId {
    GeomId { index: index as u32, origin }
}
