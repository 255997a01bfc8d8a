//! Laws that every episode keeps, whatever acts in it: physics does not break down, no number is NaN, nothing falls through a table or out of
//! the world, and soft things stay as long as they are. Measured under random actions.

mod soft;
mod things;

use crate::by_id;
use crate::own_ids::own_ids;
use agents::Policy;
use env::{Env, Options, OwnModels, Spec};
use soft::Soft;
use std::collections::BTreeMap;
use std::fmt::Write;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};
use things::Things;

/// Episodes of each id where none are asked for.
pub const EPISODES: u64 = 200;

const HEAD: &str = "\
| id | episodes | steps | ended by physics | resets, bad controls | steps with NaN | ends with a body lost | free bodies | longest edge, of its rest | vertices inside the table, most | edges through the cloth, most | rope, of its rest | holds |
|---|---|---|---|---|---|---|---|---|---|---|---|---|
";

/// What the episodes of an id come to.
#[derive(Clone, Debug, Default)]
pub struct Row {
    /// The id.
    pub id: String,
    /// Episodes.
    pub episodes: u64,
    /// Steps of the environment.
    pub steps: usize,
    /// Episodes that physics ended.
    pub unstable: usize,
    /// Resets of the state, and controls taken as zero.
    pub warnings: usize,
    /// Steps with a number that is not finite in observation or reward.
    pub not_finite: usize,
    /// Free bodies of the model.
    pub bodies: usize,
    /// Episodes at whose end a free body was below the floor or inside the table, or the mass had changed.
    pub lost: usize,
    /// What is soft, in models that have it.
    pub soft: Option<Soft>,
}

impl Row {
    fn holds(&self) -> bool {
        let whole = self.soft.as_ref().is_none_or(Soft::is_whole);
        self.unstable + self.warnings + self.not_finite + self.lost == 0 && whole
    }

    /// Its row of the table.
    fn line(&self) -> String {
        let Row { id, episodes, steps, unstable, warnings, not_finite, bodies, lost, soft, .. } = self;
        let [edge, through, pierced, rope] = soft.as_ref().map_or(["-"; 4].map(String::from), Soft::cells);
        let holds = if self.holds() { "yes" } else { "no" };
        format!(
            "| {id} | {episodes} | {steps} | {unstable} | {warnings} | {not_finite} | {lost} | {bodies} \
             | {edge} | {through} | {pierced} | {rope} | {holds} |"
        )
    }
}

/// Every id on a model of our own, of one suite or of all, on a number of threads. Ids that add pictures to another one are left out. Prints each row
/// as it is measured, so that a run that is cut off has told what it found.
///
/// # Errors
/// There is no such suite; an environment that fails, with its id.
pub fn measure(suite: &str, only: &str, episodes: u64, threads: usize) -> Result<Vec<Row>, String> {
    let specs: Vec<_> = own_ids(suite, only).collect();
    if specs.is_empty() {
        return Err(format!("no id of the suite {suite:?} contains {only:?}"));
    }
    let (next, rows) = (AtomicUsize::new(0), Mutex::new(BTreeMap::new()));
    let work = || {
        while let Some((place, spec)) =
            specs.get(next.fetch_add(1, Ordering::Relaxed)).map(|spec| (spec.id.clone(), spec))
        {
            let row = row(spec, episodes).map_err(|error| format!("{}: {error}", spec.id));
            println!("{}", row.as_ref().map_or_else(Clone::clone, Row::line));
            if let Ok(mut rows) = rows.lock() {
                rows.insert(place, row);
            }
        }
    };
    std::thread::scope(|scope| (0..threads.max(1)).for_each(|_| drop(scope.spawn(work))));
    let mut rows = rows.into_inner().map_err(|error| error.to_string())?;
    specs.iter().filter_map(|spec| rows.remove(&spec.id)).collect()
}

/// Plays the episodes of an id, seeded from 0 on.
fn row(spec: &Spec, episodes: u64) -> Result<Row, String> {
    let said = |error: &dyn std::fmt::Display| error.to_string();
    let mut env = Env::make(&spec.id, &OwnModels, &Options::default()).map_err(|error| said(&error))?;
    let mut row = Row { id: spec.id.clone(), episodes, ..Row::default() };
    let mut action = vec![0.0; env.action_len()];
    let policy = Policy::random(0);
    for seed in 0..episodes {
        env.reset(Some(seed)).map_err(|error| format!("seed {seed}: {error}"))?;
        let things = Things::of(&env);
        let mut soft = Soft::of(&env);
        let mut policy = policy.for_episode(seed);
        let before = warnings(&env);
        loop {
            policy.action(&env, &mut action).map_err(|error| format!("seed {seed}: {error}"))?;
            let step = env.step(&action).map_err(|error| format!("seed {seed}: {error}"))?;
            row.steps += 1;
            row.unstable += usize::from(step.fault.is_some());
            let finite = step.reward.is_finite() && env.observation().iter().all(|x| x.is_finite());
            row.not_finite += usize::from(!finite);
            soft.iter_mut().for_each(|soft| soft.look(&env));
            if step.terminated || step.truncated {
                break;
            }
        }
        row.warnings += warnings(&env).saturating_sub(before);
        row.bodies = things.count();
        row.lost += usize::from(things.are_lost(&env));
        row.soft = soft.map(|soft| soft.with(row.soft.take()));
    }
    Ok(row)
}

fn warnings(env: &Env) -> usize {
    let warnings = &env.scene().data.warnings;
    warnings.resets() + warnings.bad_ctrl.count
}

/// The table, and whether every episode keeps the laws.
pub fn render(rows: &[Row]) -> (String, Result<(), String>) {
    let mut table = String::from(HEAD);
    for row in rows {
        let _ = writeln!(table, "{}", row.line());
    }
    let broken: Vec<_> = rows.iter().filter(|row| !row.holds()).map(|row| row.id.as_str()).collect();
    let verdict = if broken.is_empty() {
        Ok(())
    } else {
        Err(format!("laws are broken in episodes of {}", broken.join(", ")))
    };
    (table, verdict)
}

/// The table of a written section, whose rows can be kept.
///
/// # Errors
/// It has other columns.
pub fn kept(section: &str) -> Result<&str, String> {
    let table = section.trim().split_once("\n\n").map_or(section.trim(), |(table, _)| table);
    if table.is_empty() || table.starts_with(HEAD.trim()) {
        return Ok(table);
    }
    Err("the written table has other columns: measure the suite without --only, which replaces it".into())
}

/// A table, with its sums, in which the rows of `newer` replace or join those that are `kept`.
pub fn joined(kept: &str, newer: &str) -> String {
    let table = by_id::joined(kept, newer);
    let rows: Vec<Vec<&str>> = table.lines().skip(2).map(|line| line.split(" | ").collect()).collect();
    let sum = |column: usize| rows.iter().filter_map(|row| row.get(column)?.parse::<u64>().ok()).sum::<u64>();
    let broken = rows.iter().filter(|row| row.last().is_some_and(|holds| *holds != "yes |")).count();
    format!(
        "{table}\n\n{} ids, {} episodes, {} steps; {broken} of the ids break a law.\n",
        rows.len(),
        sum(1),
        sum(2)
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_of_several_measurements_are_summed() {
        let row = |id: &str, lost| Row { id: id.into(), episodes: 200, steps: 7, lost, ..Row::default() };
        let table = |id: &str, lost| render(&[row(id, lost)]).0;
        let first = joined("", &table("hive/FurutaPendulum-v0", 0));
        let both = joined(kept(&first).unwrap(), &table("hive/Acrobot-v0", 1));
        assert!(both.ends_with("\n\n2 ids, 400 episodes, 14 steps; 1 of the ids break a law.\n"), "{both}");
        assert_eq!(joined(kept(&both).unwrap(), &table("hive/Acrobot-v0", 1)), both);
        assert!(kept("| suite | ids |\n|---|---|\n| classical | 10 |\n").is_err());
        assert!(render(&[row("hive/Acrobot-v0", 1)]).1.is_err());
    }
}
