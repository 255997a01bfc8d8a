//! What a model keeps of what follows from its arrays, made when first needed: hulls laid out for climbing, the factor of
//! bending by vertices, tables of names. Not part of files or comparisons.

pub(crate) mod bending_factor;
pub(crate) mod climb;
pub(crate) mod names;
pub(crate) mod origin;

use crate::arrays::Statistic;
use bending_factor::BendingFactor;
use climb::Slopes;
use names::NameIndex;
use std::sync::{Arc, OnceLock};

/// What is derived from the arrays when first needed. Clones share it; whoever writes what a cache depends on drops it.
#[derive(Clone, Debug, Default)]
pub(crate) struct Caches {
    /// Hulls in the layout that collision climbs.
    pub slopes: Arc<OnceLock<Slopes>>,
    /// The constant factor of inertia and bending, by vertices.
    pub bending: Arc<OnceLock<BendingFactor>>,
    /// Ids by name.
    pub names: Arc<NameIndex>,
    /// Structure that ids are checked against; edits keep it.
    #[cfg(debug_assertions)]
    pub origin: Arc<OnceLock<origin::Origin>>,
    /// Statistics that follow from the arrays, where the model's own may be given.
    pub statistic: Arc<OnceLock<Statistic>>,
}

impl Caches {
    /// Drops all that an edit of the structure may make stale; ids stay valid.
    pub fn drop_derived(&mut self) {
        *self = Caches {
            #[cfg(debug_assertions)]
            origin: Arc::clone(&self.origin),
            ..Caches::default()
        };
    }
}
