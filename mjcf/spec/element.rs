//! How elements are declared, and the values that several of them have.

/// Declares elements with their defaults; every element also has a `name` and a `loc`.
macro_rules! elements {
    ($($(#[$meta:meta])* $name:ident { $($(#[$doc:meta])* $field:ident : $t:ty = $default:expr,)* })*) => {$(
        $(#[$meta])*
        #[derive(Clone, Debug, PartialEq)]
        pub struct $name {
            /// Name of the element, empty when it has none.
            pub name: String,
            /// Where the element stands in the sources.
            pub loc: crate::diagnostic::Loc,
            $($(#[$doc])* pub $field: $t,)*
        }

        impl Default for $name {
            fn default() -> Self {
                Self { name: String::new(), loc: crate::diagnostic::Loc::NONE, $($field: $default,)* }
            }
        }

        crate::spec::field::fields!($name: name $($field)*);
    )*};
}
pub(super) use elements;

/// Constraint time constant and damping ratio when the file is silent.
pub const SOLREF: [f64; 2] = [0.02, 1.0];
/// Constraint impedance when the file is silent.
pub const SOLIMP: [f64; 5] = [0.9, 0.95, 0.001, 0.5, 2.0];

/// Three-valued switch: `auto` follows from the presence of a range when `compiler.autolimits` is on.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum Limited {
    /// Not limited.
    False,
    /// Limited.
    True,
    /// Limited if there is a range.
    #[default]
    Auto,
}
