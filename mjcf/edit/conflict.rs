//! Conflicts between the settings of an attached model and the settings of the model that takes it.

use super::reading;
use crate::diagnostic::{Diagnostics, Loc, Sources};
use crate::read::Authored;
use crate::spec::Spec;

/// Settles the options, visual settings and sizes in which `child` differs from `parent`, as `compiler.conflict` of the
/// parent says. A setting counts as given where `authored`, of the parent and of the child, says so; where neither does, when it
/// is not at its default. Returns the differences, for a warning.
///
/// # Errors
/// The settings conflict, and `compiler.conflict` makes that an error; nothing is changed then.
pub fn settle(parent: &mut Spec, child: &Spec, authored: [&Authored; 2]) -> Result<Vec<String>, Diagnostics> {
    let before = parent.clone();
    let settled = reading(before, Sources::default(), |reader| {
        reader.authored.clone_from(authored[0]);
        reader.settle(child, authored[1], Loc::NONE);
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
        let nothing = Authored::default();
        assert_eq!(settle(&mut parent, &child, [&nothing; 2]).unwrap().len(), 1);
        assert_eq!(parent.option.timestep, 0.001);
        parent.compiler.conflict = Conflict::Error;
        parent.option.timestep = 0.005;
        assert!(settle(&mut parent, &child, [&nothing; 2]).is_err());
        assert_eq!(parent.option.timestep, 0.005);
    }

    #[test]
    fn what_the_text_gives_is_not_taken_for_a_default() {
        let given =
            Authored { values: [("option".to_owned(), "timestep".to_owned())].into(), ..Authored::default() };
        let (mut parent, mut child) = (Spec::default(), Spec::default());
        parent.compiler.conflict = Conflict::Merge;
        child.option.timestep = 0.005;
        let nothing = Authored::default();
        // A default that is not given gives way, one that is given stands as the least.
        assert_eq!(settle(&mut parent, &child, [&given, &given]).unwrap().len(), 1);
        assert_eq!(parent.option.timestep, 0.002);
        settle(&mut parent, &child, [&given, &nothing]).unwrap();
        assert_eq!(parent.option.timestep, 0.002);
        settle(&mut parent, &child, [&nothing, &given]).unwrap();
        assert_eq!(parent.option.timestep, 0.005);
    }
}
