//! Settings of a model that is attached against those of the model that takes it.

use super::reading;
use crate::diagnostic::{Diagnostics, Loc, Sources};
use crate::read::Authored;
use crate::spec::Spec;

/// Settles the options, visual settings and sizes in which `child` differs from `parent`, as `compiler.conflict` of the
/// parent says; what is not at its default counts as given. Returns the differences, for a warning.
///
/// # Errors
/// The settings conflict, and `compiler.conflict` makes that an error; nothing is changed then.
pub fn settle(parent: &mut Spec, child: &Spec) -> Result<Vec<String>, Diagnostics> {
    let before = parent.clone();
    let settled = reading(before, Sources::default(), |reader| {
        reader.settle(child, &Authored::default(), Loc::NONE);
        reader.expansion.diagnostics.warnings().map(|found| found.message.clone()).collect()
    });
    let (differences, spec) = settled?;
    *parent = spec;
    Ok(differences)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::spec::Conflict;

    #[test]
    fn the_smaller_time_step_is_taken_where_settings_are_merged() {
        let (mut parent, mut child) = (Spec::default(), Spec::default());
        (parent.option.timestep, child.option.timestep) = (0.005, 0.001);
        parent.compiler.conflict = Conflict::Merge;
        assert_eq!(settle(&mut parent, &child).unwrap().len(), 1);
        assert_eq!(parent.option.timestep, 0.001);
        parent.compiler.conflict = Conflict::Error;
        parent.option.timestep = 0.005;
        assert!(settle(&mut parent, &child).is_err());
        assert_eq!(parent.option.timestep, 0.005);
    }
}
