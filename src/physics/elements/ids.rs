//! The table of ids: one row for each kind of named element.

use super::{Element, Key, Span};
use crate::model::array::Place;
use crate::model::{Arrays, JointType, Model, ObjType, counts};

macro_rules! ids {
    ($($(#[$doc:meta])* $id:ident $kind:ident $count:ident $one:ident $many:ident $names:ident
        { $($field:ident : $t:ty = |$m:ident, $i:ident| $value:expr,)* })*) => {$(
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
        pub struct $id {
            index: u32,
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
            fn of(m: &Arrays, index: usize) -> Self {
                $id {
                    index: index as u32,
                    $($field: { let ($m, $i) = (m, index); $value },)*
                }
            }

            fn index(self) -> usize {
                self.index as usize
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

        impl Model {
            #[doc = concat!("By name an `Option<", stringify!($id), ">`, by id a [`ModelView`](crate::elements::ModelView).")]
            pub fn $one<'m, K: Key<'m, $id>>(&'m self, key: K) -> K::Found {
                key.find_in(self)
            }

            #[doc = concat!("Every [`", stringify!($id), "`], in the order of the arrays.")]
            pub fn $many(&self) -> impl ExactSizeIterator<Item = $id> + Clone + '_ {
                all(self)
            }

            #[doc = concat!("Every [`", stringify!($id), "`] that has a name, with the name.")]
            pub fn $names(&self) -> impl Iterator<Item = ($id, &str)> + '_ {
                named(self)
            }
        }
    )*};
}

ids! {
    /// A body; the world is the first.
    BodyId Body nbody body bodies body_names {
        mocap: Option<u32> = |m, i| u32::try_from(m.body_mocapid[i]).ok(),
    }
    /// A joint.
    JointId Joint njnt joint joints joint_names {
        qpos: Span = |m, i| Span::new(m.jnt_qposadr[i], width(m, i)[0]),
        dof: Span = |m, i| Span::new(m.jnt_dofadr[i], width(m, i)[1]),
    }
    /// A geom.
    GeomId Geom ngeom geom geoms geom_names {}
    /// A site.
    SiteId Site nsite site sites site_names {}
    /// A camera.
    CameraId Camera ncam camera cameras camera_names {}
    /// A light.
    LightId Light nlight light lights light_names {}
    /// A mesh.
    MeshId Mesh nmesh mesh meshes mesh_names {}
    /// A skin.
    SkinId Skin nskin skin skins skin_names {}
    /// A height field.
    HfieldId Hfield nhfield hfield hfields hfield_names {}
    /// A texture.
    TextureId Texture ntex texture textures texture_names {}
    /// A material.
    MaterialId Material nmat material materials material_names {}
    /// A pair of geoms with contact parameters of its own.
    PairId Pair npair pair pairs pair_names {}
    /// A pair of bodies that never collide.
    ExcludeId Exclude nexclude exclude excludes exclude_names {}
    /// An equality constraint.
    EqualityId Equality neq equality equalities equality_names {}
    /// A tendon.
    TendonId Tendon ntendon tendon tendons tendon_names {}
    /// An actuator.
    ActuatorId Actuator nactuator actuator actuators actuator_names {
        ctrl: Span = |m, i| Span::new(m.actuator_ctrladr[i], m.actuator_ctrlnum[i]),
        act: Span = |m, i| Span::new(m.actuator_actadr[i], m.actuator_actnum[i]),
        out: Span = |m, i| Span::new(m.actuator_outadr[i], m.actuator_outnum[i]),
    }
    /// A sensor.
    SensorId Sensor nsensor sensor sensors sensor_names {
        data: Span = |m, i| Span::new(m.sensor_adr[i], m.sensor_dim[i]),
    }
    /// A custom field of numbers.
    NumericId Numeric nnumeric numeric numerics numeric_names {}
    /// A custom field of text.
    TextId Text ntext text texts text_names {}
    /// A custom tuple of elements.
    TupleId Tuple ntuple tuple tuples tuple_names {}
    /// A keyframe.
    KeyId Key nkey key keys key_names {}
}

/// Positions and degrees of freedom of joint `i`.
fn width(m: &Arrays, i: usize) -> [i32; 2] {
    match JointType::from_code(m.jnt_type[i]) {
        Some(JointType::Free) => [7, 6],
        Some(JointType::Ball) => [4, 3],
        Some(JointType::Slide | JointType::Hinge) | None => [1, 1],
    }
}

/// Every element of one kind.
pub(super) fn all<I: Element>(m: &Arrays) -> impl ExactSizeIterator<Item = I> + Clone + '_ {
    within(m, 0, I::count(m))
}

/// `count` elements of one kind from `first` on.
pub(super) fn within<I: Element>(
    m: &Arrays,
    first: usize,
    count: usize,
) -> impl ExactSizeIterator<Item = I> + Clone + '_ {
    (first..first + count).map(|index| I::of(m, index))
}

fn named<I: Element>(m: &Arrays) -> impl Iterator<Item = (I, &str)> + '_ {
    let all = all::<I>(m).map(|id| (id, m.name_of(I::KIND, id.index())));
    all.filter(|(_, name)| !name.is_empty())
}

/// A geom of a model that has more than `index`.
pub(super) const fn geom_at(index: usize) -> GeomId {
    GeomId { index: index as u32 }
}
