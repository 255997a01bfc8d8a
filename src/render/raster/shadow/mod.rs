//! Shadows: which fragments a lamp reaches.
//!
//! MuJoCo draws a depth map of `shadowsize` texels a side from every lamp and looks each fragment up in its nearest texel. Here
//! only the texels that fragments ask for exist (`texels`), and casters are compared with those. The answers are those of the
//! whole map. Pictures of one state ask together, so that every caster is projected once for all of them.
//!
//! Depth here is u = 0 at the near plane and 1 at the far one, so that what is near keeps its bits.

mod cast;
mod maps;
mod rule;
mod texels;

pub use cast::{Casting, Shadows};
pub use maps::{Maps, ShadowSettings, maps};
pub use rule::CasterRule;
pub use texels::Question;
