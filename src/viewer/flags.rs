//! What can be shown or hidden, with MuJoCo's names and keys.

use render::scene::{Effects, Show};

/// A switch of `T`.
#[derive(Clone, Copy, Debug)]
pub struct Flag<T> {
    /// Its name in MuJoCo's viewer.
    pub name: &'static str,
    /// The key that turns it, if there is one.
    pub key: Option<&'static str>,
    field: fn(&mut T) -> &mut bool,
}

impl<T: Copy> Flag<T> {
    /// Whether it is on.
    pub fn get(&self, mut all: T) -> bool {
        *(self.field)(&mut all)
    }

    /// The switch itself.
    pub fn of<'a>(&self, all: &'a mut T) -> &'a mut bool {
        (self.field)(all)
    }
}

/// Rows of a table of switches: name, key, field.
macro_rules! flags {
    ($type:ty: $($name:literal $key:expr => $field:ident,)*) => {
        [$(Flag::<$type> { name: $name, key: $key, field: |all| &mut all.$field }),*]
    };
}

/// Kinds of elements and decorations.
pub const SHOW: [Flag<Show>; 30] = flags! { Show:
    "Convex hull" Some("H") => convex_hulls,
    "Texture" Some("X") => textures,
    "Joint" Some("J") => joints,
    "Camera" Some("Q") => cameras,
    "Actuator" Some("U") => actuators,
    "Activation" Some("Comma") => activations,
    "Light" Some("Z") => lights,
    "Tendon" Some("V") => tendons,
    "Range finder" Some("Y") => rangefinders,
    "Equality" Some("E") => constraints,
    "Inertia" Some("I") => inertias,
    "Scale inertia" Some("Quote") => scaled_inertias,
    "Applied force" Some("B") => applied_forces,
    "Perturbation" Some("O") => perturbation,
    "Contact point" Some("C") => contact_points,
    "Island" Some("N") => islands,
    "Contact force" Some("F") => contact_forces,
    "Contact split" Some("P") => split_forces,
    "Transparent" Some("T") => transparent,
    "Auto connect" Some("A") => connections,
    "Centre of mass" Some("M") => centers_of_mass,
    "Selected point" None => selected_point,
    "Static body" Some("D") => static_bodies,
    "Skin" Some("Semicolon") => skins,
    "Flex vertices" None => flex_vertices,
    "Flex edges" None => flex_edges,
    "Flex faces" None => flex_faces,
    "Flex skin" None => flex_skins,
    "Body tree" Some("Backtick") => body_trees,
    "Mesh tree" Some("Backslash") => mesh_trees,
};

/// Effects of the picture.
pub const EFFECTS: [Flag<Effects>; 8] = flags! { Effects:
    "Shadow" Some("S") => shadows,
    "Wireframe" Some("W") => wireframe,
    "Reflection" Some("R") => reflections,
    "Additive" Some("L") => additive,
    "Skybox" Some("K") => sky,
    "Fog" Some("G") => fog,
    "Haze" Some("Slash") => haze,
    "Cull face" None => culling,
};
