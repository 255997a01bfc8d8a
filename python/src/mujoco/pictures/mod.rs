//! Pictures of simulations, and scenes as MuJoCo's programs have them.
//!
//! | file | what |
//! |---|---|
//! | `look.rs` | what a picture shows, and the effects that it is drawn with |
//! | `items.rs` | the items of a scene, in both directions |
//! | `painter.rs` | a scene, and what draws it |

mod items;
mod look;
pub mod painter;

pub use items::Guest;
pub use look::Free;
