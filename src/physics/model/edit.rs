//! Changing the numbers of a compiled model: the closure writes, the model checks and derives.

use super::{Arrays, Model, Statistic};
use crate::consistency::{Inconsistent, check_consistency};
use crate::constants::set_const::{SetConstError, set_const};
use crate::pipeline::error::NotSimulated;
use crate::pipeline::validity::check_model;
use crate::table::Slice;
use std::fmt;

/// Why an edit was refused. The model is as it was before.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum EditError {
    /// A size was changed, or an array was made longer or shorter.
    Size {
        /// Name of the size or array.
        field: &'static str,
        /// Value of the size, or number of scalars in the array, before.
        expected: usize,
        /// The same after the edit.
        found: usize,
    },
    /// A number was replaced by NaN.
    NotANumber {
        /// Name of the array.
        field: &'static str,
        /// Place in it, rows flattened.
        index: usize,
    },
    /// A reference leads to no element, or arrays contradict each other.
    Inconsistent(Inconsistent),
    /// The compiled structure cannot represent the new numbers.
    Structure(SetConstError),
    /// The model now asks for a feature that is not simulated.
    NotSimulated(NotSimulated),
}

impl fmt::Display for EditError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            EditError::Size { field, expected, found } => write!(
                f,
                "an edit cannot change sizes: {field} has {found} instead of {expected}; compile another model \
                 for another number of elements"
            ),
            EditError::NotANumber { field, index } => write!(f, "the edit set {field}[{index}] to NaN"),
            EditError::Inconsistent(what) => write!(f, "the edit contradicts the rest of the model: {what}"),
            EditError::Structure(what) => write!(f, "{what}; compile another model"),
            EditError::NotSimulated(what) => write!(f, "{what}"),
        }
    }
}

impl std::error::Error for EditError {}

impl Model {
    /// Changes numbers of the model, then recomputes all that follows from them (masses of subtrees, inverse weights,
    /// lengths at `qpos0`, statistics: [`set_const`]) and drops caches. Statistics that the file or the edit gives are
    /// kept. Length ranges of actuators stay as they are, see
    /// [`set_length_ranges`](crate::constants::length_range::set_length_ranges). So do the bounds by which collision
    /// skips geoms (`geom_rbound`, `geom_aabb`, `bvh_aabb`, `body_margin`, `body_contype`, `body_conaffinity`): an
    /// edit that makes geoms larger, moves them in their body, or changes what they touch sets them too.
    ///
    /// The cost is that of a copy of the model and of one position stage; options alone are cheaper to change with
    /// [`Model::options_mut`].
    ///
    /// # Errors
    /// The edit changed a size, set a number to NaN, broke a reference, or asks for what the compiled structure cannot
    /// represent; then the model is unchanged.
    pub fn edit(&mut self, change: impl FnOnce(&mut Arrays)) -> Result<(), EditError> {
        *self = self.edited(change)?;
        Ok(())
    }

    /// A copy of the model with the changes of [`Model::edit`].
    ///
    /// # Errors
    /// As [`Model::edit`].
    pub fn edited(&self, change: impl FnOnce(&mut Arrays)) -> Result<Model, EditError> {
        let mut arrays = Arrays::clone(self);
        change(&mut arrays);
        check_sizes(self, &arrays)?;
        check_numbers(self, &arrays)?;
        check_consistency(&arrays).map_err(EditError::Inconsistent)?;
        let given = arrays.stat.clone();
        let mut edited = Model::unchecked(arrays);
        set_const(&mut edited).map_err(EditError::Structure)?;
        if edited.stat != given {
            let mut plain = self.clone();
            set_const(&mut plain).map_err(EditError::Structure)?;
            keep_given(&given, &plain.stat, &mut edited.arrays.stat);
        }
        check_model(&edited).map_err(EditError::NotSimulated)?;
        Ok(edited)
    }
}

/// Sizes are the old ones, and every array fills its shape.
fn check_sizes(old: &Arrays, new: &Arrays) -> Result<(), EditError> {
    let mut sizes = Vec::new();
    old.visit_sizes(&mut |_, n| sizes.push(n));
    let mut sizes = sizes.into_iter();
    let mut result = Ok(());
    let mut expect = |field, expected: usize, found| {
        if expected != found && result.is_ok() {
            result = Err(EditError::Size { field, expected, found });
        }
    };
    new.visit_sizes(&mut |field, n| expect(field, sizes.next().unwrap_or(0), n));
    new.visit(&mut |field, shape, values| expect(field, shape.iter().product(), values.len()));
    result
}

/// No NaN where there was none.
fn check_numbers(old: &Arrays, new: &Arrays) -> Result<(), EditError> {
    let mut nans = Vec::new();
    new.visit(&mut |field, _, values| {
        if let Some(index) = first_nan(values) {
            nans.push((field, index));
        }
    });
    if nans.is_empty() {
        return Ok(());
    }
    let mut before = Vec::new();
    old.visit(&mut |field, _, values| before.extend(first_nan(values).map(|index| (field, index))));
    match nans.into_iter().find(|nan| !before.contains(nan)) {
        Some((field, index)) => Err(EditError::NotANumber { field, index }),
        None => Ok(()),
    }
}

fn first_nan(values: Slice<'_>) -> Option<usize> {
    match values {
        Slice::F64(x) => x.iter().position(|x| x.is_nan()),
        Slice::F32(x) => x.iter().position(|x| x.is_nan()),
        _ => None,
    }
}

/// Statistics that are not those computed from the unedited model were given, and win over the computed ones.
fn keep_given(given: &Statistic, plain: &Statistic, stat: &mut Statistic) {
    let pick = |given: f64, plain: f64, computed: f64| if given == plain { computed } else { given };
    stat.meaninertia = pick(given.meaninertia, plain.meaninertia, stat.meaninertia);
    stat.meanmass = pick(given.meanmass, plain.meanmass, stat.meanmass);
    stat.meansize = pick(given.meansize, plain.meansize, stat.meansize);
    stat.extent = pick(given.extent, plain.extent, stat.extent);
    if given.center != plain.center {
        stat.center = given.center;
    }
}
