//! Elements of a model by name and by number.

use super::element::Element;
use super::ids::{
    ActuatorId, BodyId, CameraId, EqualityId, ExcludeId, GeomId, HfieldId, JointId, KeyId, LightId,
    MaterialId, MeshId, NumericId, PairId, SensorId, SiteId, SkinId, TendonId, TextId, TextureId, TupleId,
    within,
};
use super::model::ModelView;
use crate::model::Model;

/// What finds elements of one kind in a model: a name an id, an id a view.
pub trait Key<'m, I> {
    /// What is found.
    type Found;
    /// Finds it.
    ///
    /// # Panics
    /// In debug builds: the id belongs to another model.
    #[track_caller]
    fn find_in(self, m: &'m Model) -> Self::Found;
}

impl<'m, I: Element> Key<'m, I> for &str {
    type Found = Option<I>;

    fn find_in(self, m: &'m Model) -> Option<I> {
        Some(I::of(m, m.id_of(I::KIND, self)?))
    }
}

impl<'m, I: Element> Key<'m, I> for &String {
    type Found = Option<I>;

    fn find_in(self, m: &'m Model) -> Option<I> {
        self.as_str().find_in(m)
    }
}

impl<'m, I: Element> Key<'m, I> for I {
    type Found = ModelView<'m, I>;

    #[track_caller]
    fn find_in(self, m: &'m Model) -> ModelView<'m, I> {
        ModelView::new(m, self)
    }
}

macro_rules! finders {
    ($($id:ident $one:ident $many:ident $names:ident,)*) => {$(
        impl Model {
            #[doc = concat!("By name an `Option<", stringify!($id), ">`, by id a [`ModelView`].")]
            ///
            /// # Panics
            /// In debug builds: the id belongs to another model.
            #[track_caller]
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

finders! {
    BodyId body bodies body_names,
    JointId joint joints joint_names,
    GeomId geom geoms geom_names,
    SiteId site sites site_names,
    CameraId camera cameras camera_names,
    LightId light lights light_names,
    MeshId mesh meshes mesh_names,
    SkinId skin skins skin_names,
    HfieldId hfield hfields hfield_names,
    TextureId texture textures texture_names,
    MaterialId material materials material_names,
    PairId pair pairs pair_names,
    ExcludeId exclude excludes exclude_names,
    EqualityId equality equalities equality_names,
    TendonId tendon tendons tendon_names,
    ActuatorId actuator actuators actuator_names,
    SensorId sensor sensors sensor_names,
    NumericId numeric numerics numeric_names,
    TextId text texts text_names,
    TupleId tuple tuples tuple_names,
    KeyId key keys key_names,
}

/// Every element of one kind.
fn all<I: Element>(m: &Model) -> impl ExactSizeIterator<Item = I> + Clone + '_ {
    within(m, 0, I::count(m))
}

fn named<I: Element>(m: &Model) -> impl Iterator<Item = (I, &str)> + '_ {
    let all = all::<I>(m).map(|id| (id, m.name_of(I::KIND, id.index())));
    all.filter(|(_, name)| !name.is_empty())
}
