//! Every controller by its name.

use crate::controller::Controller;
use crate::error::ControlError;
use crate::tasks;
use env::{Env, Spec};

/// A controller that is built in.
#[derive(Clone, Copy, Debug)]
#[non_exhaustive]
pub struct Entry {
    /// Its name.
    pub name: &'static str,
    /// What it does, in a line.
    pub summary: &'static str,
    /// What it serves: names of tasks, with all their ids and variants, and single ids.
    pub serves: &'static [&'static str],
    /// Makes it.
    build: fn(&Env) -> Result<Box<dyn Controller>, ControlError>,
}

impl Entry {
    /// Whether it serves an environment.
    pub fn serves(&self, spec: &Spec) -> bool {
        self.serves.iter().any(|served| *served == spec.task || *served == spec.id)
    }
}

/// Every controller. Of several that serve an id, the first is the best.
const ALL: &[Entry] = &[
    Entry {
        name: "reach",
        summary: "inverse kinematics once, then a minimum-jerk motion of the joints",
        serves: &["reach"],
        build: |env| Ok(Box::new(tasks::arms::reach::Reach::new(env)?)),
    },
    Entry {
        name: "trot",
        summary: "a trot by Raibert's steps, legs by inverse kinematics",
        serves: &["chase", "push_box", "stand", "turn", "velocity", "walk_to", "weave"],
        build: |env| Ok(Box::new(tasks::locomotion::trot::Trot::new(env)?)),
    },
];

/// Every controller.
pub fn controllers() -> &'static [Entry] {
    ALL
}

/// The controllers that serve an environment, the best first.
pub fn serving(spec: &Spec) -> impl Iterator<Item = &'static Entry> {
    ALL.iter().filter(move |entry| entry.serves(spec))
}

/// Makes the controller of a name for an environment.
///
/// # Errors
/// There is no such controller; it serves other tasks; the environment lacks what it needs.
pub fn make(name: &str, env: &Env) -> Result<Box<dyn Controller>, ControlError> {
    let spec = env.spec();
    let names = || serving(spec).map(|entry| entry.name).collect();
    let Some(entry) = ALL.iter().find(|entry| entry.name == name) else {
        return Err(ControlError::Unknown { name: name.into(), id: spec.id.clone(), serving: names() });
    };
    if !entry.serves(spec) {
        let (id, serving) = (spec.id.clone(), names());
        return Err(ControlError::NotServed { name: entry.name, id, serves: entry.serves, serving });
    }
    (entry.build)(env)
}

#[cfg(test)]
mod tests {
    use super::*;
    use env::{Options, OwnModels, Registry};
    use std::collections::BTreeSet;

    #[test]
    fn names_differ_and_each_serves_an_id() {
        let names: BTreeSet<_> = ALL.iter().map(|entry| entry.name).collect();
        assert_eq!(names.len(), ALL.len());
        let registry = Registry::builtin();
        for entry in ALL {
            for served in entry.serves {
                let known = registry.specs().iter().any(|spec| *served == spec.task || *served == spec.id);
                assert!(known, "{} serves {served}, which is neither a task nor an id", entry.name);
            }
        }
    }

    #[test]
    fn errors_name_what_serves_the_id() {
        let error = |id, name| {
            let env = Env::make(id, &OwnModels, &Options::default()).unwrap();
            make(name, &env).err().unwrap().to_string()
        };
        let unknown = error("hive/FrankaReach-v0", "rech");
        assert_eq!(unknown, "there is no controller rech; hive/FrankaReach-v0 is served by reach");
        let other = error("hive/ElbowPose-v0", "reach");
        assert!(other.contains("serves reach, not hive/ElbowPose-v0"), "{other}");
        assert!(other.contains("no controller serves hive/ElbowPose-v0"), "{other}");
    }
}
