//! The compiled model: arrays, options, and the enumerations their integers stand for.
//!
//! ```
//! let model = robohive_mjcf::load_str(
//!     "<mujoco><worldbody><geom name='floor' type='plane' size='1 1 1'/><body name='ball' pos='0 0 2'><freejoint/><geom name='ball' size='.1' mass='1'/></body></worldbody></mujoco>",
//! )?
//! .model;
//! assert_eq!((model.nq, model.nv, model.nbody), (7, 6, 2));
//! let ball = model.body("ball").ok_or("no ball")?;
//! assert_eq!(model.body_mass[ball], model.body(ball).mass());
//!
//! let mut wide = model.clone();
//! let geom = wide.geom("ball").ok_or("no geom")?;
//! wide.edit(|m| m.geom_size[geom][0] = 0.2)?;
//! assert_eq!((wide.geom_rbound[geom], model.geom_rbound[geom]), (0.2, 0.1));
//! wide.overwrite(|m| m.geom_size[geom][0] = 0.3)?;
//! assert_eq!(wide.geom_rbound[geom], 0.2, "nothing is derived");
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

pub mod array;
pub mod binary;
mod consequences;
mod declare;
mod edit;
mod fields;
mod flags;
mod flex_rows;
mod follow;
mod names;
mod options;
mod reader;
mod skin_rows;
mod suggestion;
mod types;
mod written;

pub use edit::EditError;
pub use fields::{Arrays, Columns, Draft, Rows, counts};
pub use flags::{Disable, Enable};
pub use options::*;
pub use suggestion::Suggestions;
pub use types::*;

use crate::collision::climb::Slopes;
use crate::flex::metric::bending_factor::BendingFactor;
use crate::plugin::{Instances, PluginError, Registry};
use names::NameIndex;
use std::ops::Deref;
use std::sync::{Arc, OnceLock};

/// A compiled model: constant while a simulation runs, shared by any number of [`Data`](crate::Data).
///
/// All its numbers are read through [`Arrays`], to which a model dereferences: `m.nq`, `m.body_mass`. They are changed
/// with [`Model::edit`] and [`Model::overwrite`], options also with [`Model::options_mut`]. Clones share every array and
/// cache; an array becomes a model's own when it is first written.
#[derive(Clone, Debug, Default)]
pub struct Model {
    arrays: Arrays,
    caches: Caches,
    plugins: Instances,
}

/// What is derived from the arrays when first needed. Clones share it; whoever writes what a cache depends on drops it.
#[derive(Clone, Debug, Default)]
struct Caches {
    /// Hulls in the layout that collision climbs.
    slopes: Arc<OnceLock<Slopes>>,
    /// The constant factor of inertia and bending, by vertices.
    bending: Arc<OnceLock<BendingFactor>>,
    /// Ids by name.
    names: Arc<NameIndex>,
    /// Statistics that follow from the arrays, where those of the model may be given.
    statistic: Arc<OnceLock<Statistic>>,
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
        Model { arrays, ..Model::default() }
    }

    /// The arrays to write, without the checks and the derived quantities of an edit, as for [`Model::unchecked`].
    #[doc(hidden)]
    pub fn unchecked_mut(&mut self) -> &mut Arrays {
        self.caches = Caches::default();
        &mut self.arrays
    }

    /// The arrays to write what is derived from others; caches stay.
    pub(crate) fn derived_mut(&mut self) -> &mut Arrays {
        &mut self.arrays
    }

    /// The options, to change. Nothing in the model is derived from them.
    pub fn options_mut(&mut self) -> &mut Options {
        &mut self.arrays.opt
    }

    /// Makes the instances of the plugins in `registry` that the arrays name, in place of those before.
    ///
    /// # Errors
    /// The first instance that cannot be made; those before stay.
    #[doc(hidden)]
    pub fn start_plugins(&mut self, registry: &Registry) -> Result<(), PluginError> {
        self.plugins = Instances::new(self, registry)?;
        Ok(())
    }

    /// The plugins that [`Arrays::plugin`] counts.
    pub fn registry(&self) -> &Registry {
        self.plugins.registry()
    }

    /// The plugins at work.
    pub(crate) fn plugins(&self) -> &Instances {
        &self.plugins
    }

    /// Hulls in the layout that collision climbs.
    pub(crate) fn slopes(&self) -> &Slopes {
        self.caches.slopes.get_or_init(|| Slopes::new(&self.arrays))
    }

    /// The constant factor of inertia and bending, by vertices.
    pub(crate) fn bending_factor(&self) -> &BendingFactor {
        self.caches.bending.get_or_init(|| BendingFactor::new(&self.arrays))
    }

    /// Drops what was made of the factor before it changed.
    pub(crate) fn forget_bending_factor(&mut self) {
        self.caches.bending = Arc::default();
    }
}
