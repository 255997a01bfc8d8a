//! Which list holds the elements of a space of names.

/// Matches a space: what bodies hold goes to the macro after `bodies`, with the name of the list there; what is also called by
/// its file to the one after `assets`; all other lists of the description to the one after `lists`. Further arms say what bodies,
/// frames, classes and keyframes are.
macro_rules! by_space {
    ($space:expr, bodies $body:ident, assets $asset:ident, lists $list:ident, { $($further:tt)* }) => {
        match $space {
            Space::Joint => $body!(joints),
            Space::Geom => $body!(geoms),
            Space::Site => $body!(sites),
            Space::Camera => $body!(cameras),
            Space::Light => $body!(lights),
            Space::Mesh => $asset!(meshes),
            Space::Skin => $asset!(skins),
            Space::Hfield => $asset!(hfields),
            Space::Texture => $asset!(textures),
            Space::Material => $list!(materials),
            Space::Pair => $list!(pairs),
            Space::Exclude => $list!(excludes),
            Space::Flex => $list!(flexes),
            Space::Equality => $list!(equalities),
            Space::Tendon => $list!(tendons),
            Space::Actuator => $list!(actuators),
            Space::Sensor => $list!(sensors),
            Space::Numeric => $list!(numerics),
            Space::Text => $list!(texts),
            Space::Tuple => $list!(tuples),
            Space::Plugin => $list!(plugins),
            $($further)*
        }
    };
}
pub(super) use by_space;
