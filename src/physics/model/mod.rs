//! The compiled model: arrays, options, and the enumerations their integers stand for.
//!
//! ```
//! let model = robohive_mjcf::load_str(
//!     "<mujoco><worldbody><geom name='floor' type='plane' size='1 1 1'/><body name='ball' pos='0 0 2'><freejoint/><geom name='ball' size='.1' mass='1'/></body></worldbody></mujoco>",
//! )?
//! .model;
//! assert_eq!((model.nq, model.nv, model.nbody), (7, 6, 2));
//! let ball = model.body("ball").ok_or("no ball")?;
//! assert_eq!(model.body_mass[ball.index()], model.body(ball).mass());
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

pub mod binary;
mod declare;
mod edit;
mod fields;
mod flags;
mod names;
mod options;
mod reader;
mod types;

pub use edit::EditError;
pub use fields::Arrays;
pub use flags::{Disable, Enable};
pub use options::*;
pub use types::*;

use crate::collision::climb::Slopes;
use names::NameIndex;
use std::ops::Deref;
use std::sync::OnceLock;

/// A compiled model: constant while a simulation runs, shared by any number of [`Data`](crate::Data).
///
/// All its numbers are read through [`Arrays`], to which a model dereferences: `m.nq`, `m.body_mass`. They are changed
/// with [`Model::edit`], options also with [`Model::options_mut`].
#[derive(Clone, Debug, Default)]
pub struct Model {
    arrays: Arrays,
    caches: Caches,
}

/// What is derived from the arrays when first needed. Whoever gets the arrays to write empties the caches.
#[derive(Clone, Debug, Default)]
struct Caches {
    /// Hulls in the layout that collision climbs.
    slopes: OnceLock<Slopes>,
    /// Ids by name.
    names: NameIndex,
}

impl Deref for Model {
    type Target = Arrays;

    fn deref(&self) -> &Arrays {
        &self.arrays
    }
}

impl Model {
    /// A model of arrays that nobody has checked: for the compiler, which makes consistent ones, and for tests of
    /// single stages. Functions of this crate panic where arrays contradict each other.
    #[doc(hidden)]
    pub fn unchecked(arrays: Arrays) -> Self {
        Model { arrays, caches: Caches::default() }
    }

    /// The arrays to write, without the checks and the derived quantities of an edit, as for [`Model::unchecked`].
    #[doc(hidden)]
    pub fn unchecked_mut(&mut self) -> &mut Arrays {
        self.caches = Caches::default();
        &mut self.arrays
    }

    /// The options, to change. Nothing in the model is derived from them.
    pub fn options_mut(&mut self) -> &mut Options {
        &mut self.arrays.opt
    }

    /// Hulls in the layout that collision climbs.
    pub(crate) fn slopes(&self) -> &Slopes {
        self.caches.slopes.get_or_init(|| Slopes::new(&self.arrays))
    }
}
