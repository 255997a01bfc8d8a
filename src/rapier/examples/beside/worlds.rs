//! Which models become a world, and how close it is to the model.

use crate::{Subject, first_line};
use physics::Model;
use physics::model::NotSimulated;
use robohive_rapier::{Differences, Options, World, refusals};
use std::collections::{BTreeMap, BTreeSet};
use std::fmt;

/// Largest difference of a world that is its model's.
const EXACT: f64 = 1e-9;

/// What came of a model.
enum Outcome {
    /// Our own loader refuses it.
    Unread(String),
    /// Elements that rapier does not support.
    Refused(Vec<NotSimulated>),
    /// A world: its positions and degrees of freedom, whether they are the model's, and how far it is off.
    Built([usize; 2], bool, Differences),
}

impl Outcome {
    fn of(model: Result<Model, String>) -> Self {
        let m = &match model {
            Ok(m) => m,
            Err(error) => return Outcome::Unread(first_line(&error).into()),
        };
        match World::new(m, Options::default()) {
            Err(first) => {
                let all = refusals(m);
                Outcome::Refused(if all.is_empty() { vec![first] } else { all })
            }
            Ok(world) => {
                let found = world.measure(m);
                let same = (found.nq, found.nv) == (m.nq, m.nv);
                Outcome::Built([m.nq, m.nv], same, found.differences(m))
            }
        }
    }

    fn is_exact(&self) -> bool {
        matches!(self, Outcome::Built(_, true, off) if off.within(EXACT))
    }
}

impl fmt::Display for Outcome {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Outcome::Unread(error) => write!(f, "{error} | | | "),
            Outcome::Refused(all) => match &all[..] {
                [one] => write!(f, "{one} | | | "),
                [one, rest @ ..] => write!(f, "{one}, and {} more | | | ", rest.len()),
                [] => write!(f, "refused | | | "),
            },
            Outcome::Built([nq, nv], same, Differences { mass, axes, inertia, .. }) => {
                let sizes = if *same { "equal" } else { "differ" };
                write!(f, "{nq}, {nv} {sizes} | {mass:.0e} | {axes:.0e} | {inertia:.0e}")
            }
        }
    }
}

/// Prints a row for each model.
pub fn table(all: &[Subject]) {
    println!("| model | nq, nv | mass | axes | inertia | rapier's own loader |");
    println!("|---|---|---|---|---|---|");
    let outcomes: Vec<(Outcome, String)> = all
        .iter()
        .map(|subject| {
            let (ours, theirs) = (Outcome::of(subject.model()), stock_world(subject));
            println!("| {} | {ours} | {theirs} |", subject.name);
            (ours, theirs)
        })
        .collect();
    let count = |what: fn(&Outcome) -> bool| outcomes.iter().filter(|(ours, _)| what(ours)).count();
    let largest = outcomes.iter().fold([0.0_f64; 3], |most, (ours, _)| match ours {
        Outcome::Built(_, _, Differences { mass, axes, inertia, .. }) => {
            [most[0].max(*mass), most[1].max(*axes), most[2].max(*inertia)]
        }
        _ => most,
    });
    let loads = |own: bool| {
        let chosen = all.iter().zip(&outcomes).filter(|(subject, _)| subject.is_own() || !own);
        chosen.filter(|(_, (_, theirs))| theirs == "loads").count()
    };
    println!(
        "\nOf {} models our loader reads {}; {} of these have what rapier does not support, {} become a world, {} with the model's nq \
         and nv, and mass, axes and inertia within {EXACT:e}; the largest differences are {:.0e}, {:.0e} and {:.0e}. rapier3d-mjcf \
         loads {}, {} of them own models.",
        all.len(),
        count(|o| !matches!(o, Outcome::Unread(_))),
        count(|o| matches!(o, Outcome::Refused(_))),
        count(|o| matches!(o, Outcome::Built(..))),
        count(Outcome::is_exact),
        largest[0],
        largest[1],
        largest[2],
        loads(false),
        loads(true)
    );
    let mut asking: BTreeMap<&str, usize> = BTreeMap::new();
    for (ours, _) in &outcomes {
        if let Outcome::Refused(all) = ours {
            let features: BTreeSet<&str> = all.iter().map(|refusal| &refusal.feature[..]).collect();
            features.into_iter().for_each(|feature| *asking.entry(feature).or_default() += 1);
        }
    }
    println!("\n| asked for | models |\n|---|---|");
    asking.iter().for_each(|(feature, models)| println!("| {feature} | {models} |"));
}

#[cfg(feature = "stock")]
fn stock_world(subject: &Subject) -> String {
    crate::stock::load(&subject.path).map_or_else(|error| error, |_| "loads".into())
}

#[cfg(not(feature = "stock"))]
fn stock_world(_: &Subject) -> String {
    "not asked".into()
}
