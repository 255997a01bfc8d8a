//! Elements by name, and all of a kind.

use physics::model::ObjType;

use crate::diagnostic::Diagnostics;
use crate::schema::Space;
use crate::spec::*;

/// What messages call a kind of element.
pub(super) fn word(kind: ObjType) -> &'static str {
    Space::of(kind).map_or("element", Space::word)
}

/// There is no element of this name; the nearest is suggested.
pub(super) fn missing<'a>(kind: ObjType, name: &str, names: impl Iterator<Item = &'a str>) -> Diagnostics {
    let near = Diagnostics::default().nearest(name, names);
    let hint = near.map_or(String::new(), |near| format!("; did you mean '{near}'?"));
    Diagnostics::of_error(format!("there is no {} '{name}'{hint}", word(kind)))
}

/// The body called `name` in `body` and below.
pub(super) fn body_in<'b>(body: &'b mut Body, name: &str) -> Option<&'b mut Body> {
    if body.name == name {
        return Some(body);
    }
    body.bodies.iter_mut().find_map(|child| body_in(child, name))
}

fn preorder<'b>(body: &'b Body, all: &mut Vec<&'b Body>) {
    all.push(body);
    body.bodies.iter().for_each(|child| preorder(child, all));
}

impl Spec {
    /// All bodies in the order of their ids, the world first.
    pub fn bodies(&self) -> impl Iterator<Item = &Body> {
        let mut all = Vec::new();
        preorder(&self.world, &mut all);
        all.into_iter()
    }

    /// The body called `name`; the world is called `world`.
    pub fn body(&self, name: &str) -> Option<&Body> {
        self.bodies().find(|body| body.name == name)
    }

    /// The body called `name`, to be changed.
    ///
    /// # Errors
    /// There is none; the nearest name is suggested.
    pub fn body_mut(&mut self, name: &str) -> Result<&mut Body, Diagnostics> {
        if self.body(name).is_none() {
            return Err(missing(ObjType::Body, name, self.bodies().map(|body| body.name.as_str())));
        }
        body_in(&mut self.world, name).ok_or_else(|| missing(ObjType::Body, name, std::iter::empty()))
    }
}

/// Elements of bodies.
macro_rules! in_bodies {
    ($($kind:ident $one:ident $one_mut:ident $all:ident $below:ident $type:ident)*) => {
        $(
        fn $below<'b>(body: &'b mut Body, name: &str) -> Option<&'b mut $type> {
            if let Some(index) = body.$all.iter().position(|x| x.name == name) {
                return body.$all.get_mut(index);
            }
            body.bodies.iter_mut().find_map(|child| $below(child, name))
        }

        impl Spec {
            #[doc = concat!("All ", stringify!($all), " in the order of their ids.")]
            pub fn $all(&self) -> impl Iterator<Item = &$type> {
                self.bodies().flat_map(|body| &body.$all)
            }

            #[doc = concat!("The ", stringify!($one), " called `name`.")]
            pub fn $one(&self, name: &str) -> Option<&$type> {
                self.$all().find(|x| x.name == name && !name.is_empty())
            }

            #[doc = concat!("The ", stringify!($one), " called `name`, to be changed.")]
            ///
            /// # Errors
            /// There is none; the nearest name is suggested.
            pub fn $one_mut(&mut self, name: &str) -> Result<&mut $type, Diagnostics> {
                if self.$one(name).is_none() {
                    return Err(missing(ObjType::$kind, name, self.$all().map(|x| x.name.as_str())));
                }
                $below(&mut self.world, name)
                    .ok_or_else(|| missing(ObjType::$kind, name, std::iter::empty()))
            }
        })*
    };
}

in_bodies! {
    Joint joint joint_mut joints joint_in Joint
    Geom geom geom_mut geoms geom_in Geom
    Site site site_mut sites site_in Site
    Camera camera camera_mut cameras camera_in Camera
    Light light light_mut lights light_in Light
}

/// Elements in lists of the model; assets without a name are called by their file.
macro_rules! in_lists {
    ($($kind:ident $one:ident $one_mut:ident $all:ident $type:ident |$x:ident| $name:expr;)*) => {
        impl Spec {
            $(
            #[doc = concat!("The ", stringify!($one), " called `name`.")]
            pub fn $one(&self, name: &str) -> Option<&$type> {
                self.$all.iter().find(|$x| $name == name && !name.is_empty())
            }

            #[doc = concat!("The ", stringify!($one), " called `name`, to be changed.")]
            ///
            /// # Errors
            /// There is none; the nearest name is suggested.
            pub fn $one_mut(&mut self, name: &str) -> Result<&mut $type, Diagnostics> {
                match self.$all.iter().position(|$x| $name == name && !name.is_empty()) {
                    Some(index) => Ok(&mut self.$all[index]),
                    None => Err(missing(ObjType::$kind, name, self.$all.iter().map(|x| x.name.as_str()))),
                }
            }
            )*
        }
    };
}

in_lists! {
    Mesh mesh mesh_mut meshes Mesh |x| asset_name(&x.name, &x.path);
    Skin skin skin_mut skins Skin |x| asset_name(&x.name, &x.path);
    Hfield hfield hfield_mut hfields Hfield |x| asset_name(&x.name, &x.path);
    Texture texture texture_mut textures Texture |x| asset_name(&x.name, &x.path);
    Material material material_mut materials Material |x| x.name;
    Pair pair pair_mut pairs Pair |x| x.name;
    Exclude exclude exclude_mut excludes Exclude |x| x.name;
    Flex flex flex_mut flexes Flex |x| x.name;
    Equality equality equality_mut equalities Equality |x| x.name;
    Tendon tendon tendon_mut tendons Tendon |x| x.name;
    Actuator actuator actuator_mut actuators Actuator |x| x.name;
    Sensor sensor sensor_mut sensors Sensor |x| x.name;
    Numeric numeric numeric_mut numerics Numeric |x| x.name;
    Text text text_mut texts Text |x| x.name;
    Tuple tuple tuple_mut tuples Tuple |x| x.name;
    Key key key_mut keys Key |x| x.name;
    Plugin plugin plugin_mut plugins PluginInstance |x| x.name;
}
