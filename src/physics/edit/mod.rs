//! Changing the numbers of a compiled model: the closure writes, the model checks and derives.

mod consequences;
mod error;
mod follow;
mod written;

pub use error::EditError;

use crate::model::{Arrays, Draft, Instances, Model, Options, Statistic, Visual};
use crate::table::Slice;
use consequences::{Consequences, check, computed_statistic, drop_caches};
use written::Written;

impl Model {
    /// Changes numbers of the model, then recomputes what follows from those that changed: masses of subtrees, inverse
    /// weights, lengths, statistics and offsets at `qpos0` (as [`set_const`](crate::set_const) does); and the bounds by
    /// which collision skips geoms (`geom_rbound`, `geom_aabb`, the hierarchies of bodies, `body_margin`, `body_contype`,
    /// `body_conaffinity`), from type, size, pose, margin and contact types of the geoms. Statistics that the file or the
    /// edit gives are kept.
    ///
    /// What is no function of the compiled arrays stays as it is: `body_mass` and `body_inertia`, which an edit of shapes
    /// sets itself where it wants to ([`shape`](crate::geometry::shape) computes them), length ranges of actuators (see
    /// [`set_length_ranges`](crate::set_length_ranges)), the fluid coefficients `geom_fluid`, and what the compiler filled in
    /// where the text gave nothing: relative poses of welds, damping from damping ratios, lengths of tendon springs.
    ///
    /// Only arrays that are written stop being shared with clones of the model. The cost follows from what is written:
    /// colours, friction, gains or forces cost the check of those numbers, poses of sites and static bodies one pass of
    /// positions, masses and poses of moving bodies all constants; structure (types, references) a check of the model.
    ///
    /// # Errors
    /// The edit changed a size, set a number to NaN, broke a reference, or asks for what the compiled structure cannot
    /// represent; then the model is unchanged.
    pub fn edit(&mut self, change: impl FnOnce(&mut Draft<'_>)) -> Result<(), EditError> {
        let mut session = Session::begin(self);
        let written = session.write(change)?;
        check(session.model, written)?;
        let plugins = session.plugins()?;
        Consequences::of(&session.model.arrays, written).derive(session.model)?;
        if let Some(plugins) = plugins {
            session.model.plugins = plugins;
        }
        session.accept();
        Ok(())
    }

    /// A copy of the model with the changes of [`Model::edit`].
    ///
    /// # Errors
    /// As [`Model::edit`].
    pub fn edited(&self, change: impl FnOnce(&mut Draft<'_>)) -> Result<Model, EditError> {
        let mut edited = self.clone();
        edited.edit(change)?;
        Ok(edited)
    }

    /// The statistics that follow from the arrays, whatever [`Arrays::stat`] says, which a file may give and [`Model::overwrite`]
    /// leaves as it was. Computed once for numbers that do not change.
    ///
    /// # Errors
    /// The compiled structure cannot represent the numbers.
    pub fn computed_statistic(&self) -> Result<Statistic, EditError> {
        computed_statistic(self)
    }

    /// Writes numbers and derives nothing from them, as programs do that write into MuJoCo's `mjModel`: bounds, frames
    /// that coincide (`site_sameframe`), inverse weights and lengths keep the values they had, however wrong they now are.
    ///
    /// Takes time in proportion to the arrays that are written, and no memory once the model has written each of them.
    ///
    /// # Errors
    /// Those of [`Model::edit`]; the model is then unchanged.
    pub fn overwrite(&mut self, change: impl FnOnce(&mut Draft<'_>)) -> Result<(), EditError> {
        let mut session = Session::begin(self);
        let written = session.write(change)?;
        check(session.model, written)?;
        drop_caches(&mut session.model.caches, written);
        session.accept();
        Ok(())
    }
}

/// Settings before an edit.
struct Settings {
    opt: Options,
    vis: Visual,
    stat: Statistic,
}

/// An edit under way, taken back unless it is accepted.
struct Session<'m> {
    model: &'m mut Model,
    before: Settings,
    accepted: bool,
}

impl<'m> Session<'m> {
    fn begin(model: &'m mut Model) -> Self {
        let Arrays { opt, vis, stat, .. } = &model.arrays;
        let before = Settings { opt: opt.clone(), vis: vis.clone(), stat: stat.clone() };
        Session { model, before, accepted: false }
    }

    /// Lets `change` write, and checks sizes and numbers.
    fn write(&mut self, change: impl FnOnce(&mut Draft<'_>)) -> Result<Written, EditError> {
        let arrays = &mut self.model.arrays;
        let mut draft = arrays.draft();
        change(&mut draft);
        let sizes = draft.sizes();
        if let Some((field, expected, found)) = arrays.different_size(&sizes) {
            return Err(EditError::Size { field, expected, found });
        }
        check_numbers(arrays)?;
        Ok(Written::of(arrays))
    }

    /// The instances of plugins that follow from what was written; `None` for a model without any.
    fn plugins(&self) -> Result<Option<Instances>, EditError> {
        if self.model.nplugin == 0 {
            return Ok(None);
        }
        let registry = self.model.registry();
        Instances::new(self.model, registry).map(Some).map_err(EditError::Plugin)
    }

    fn accept(mut self) {
        self.model.arrays.settle();
        self.accepted = true;
    }
}

impl Drop for Session<'_> {
    fn drop(&mut self) {
        if !self.accepted {
            let arrays = &mut self.model.arrays;
            arrays.revert();
            std::mem::swap(&mut arrays.opt, &mut self.before.opt);
            std::mem::swap(&mut arrays.vis, &mut self.before.vis);
            std::mem::swap(&mut arrays.stat, &mut self.before.stat);
        }
    }
}

/// No NaN where there was none.
fn check_numbers(arrays: &Arrays) -> Result<(), EditError> {
    let mut result = Ok(());
    arrays.visit_written(&mut |field, before, now| {
        if result.is_ok()
            && let Some(index) = new_nan(before, now)
        {
            result = Err(EditError::NotANumber { field, index });
        }
    });
    result
}

/// First place of a NaN that is none in `before`.
fn new_nan(before: Slice<'_>, now: Slice<'_>) -> Option<usize> {
    match (before, now) {
        (Slice::F64(old), Slice::F64(new)) => {
            old.iter().zip(new).position(|(x, y)| y.is_nan() && !x.is_nan())
        }
        (Slice::F32(old), Slice::F32(new)) => {
            old.iter().zip(new).position(|(x, y)| y.is_nan() && !x.is_nan())
        }
        _ => None,
    }
}
