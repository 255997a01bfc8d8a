//! Laws that every episode keeps, whatever acts in it: physics does not break down, no number is NaN, nothing falls through a table or out of
//! the world, and soft things stay as long as they are. Measured under random actions.

mod soft;
mod things;

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

/// What the episodes of an id come to.
#[derive(Clone, Debug, Default)]
pub struct Row {
    /// The id.
    pub id: String,
    /// The suite.
    pub suite: String,
    /// Episodes, and steps of the environment in all of them.
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
        let whole = self.soft.as_ref().is_none_or(|soft| soft.through == 0);
        self.unstable + self.warnings + self.not_finite + self.lost == 0 && whole
    }
}

/// Every id on a model of our own, of one suite or of all, on a number of threads. Ids that add pictures to another one are left out.
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
            println!(
                "{}: {}",
                spec.id,
                row.as_ref().map_or("fails", |row| if row.holds() { "holds" } else { "breaks" })
            );
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
    let mut row = Row { id: spec.id.clone(), suite: spec.suite.clone(), episodes, ..Row::default() };
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

/// The tables, and whether every episode keeps the laws.
pub fn render(rows: &[Row]) -> (String, Result<(), String>) {
    let mut table = String::from(
        "| suite | ids | episodes | steps | ended by physics | resets, bad controls | steps with NaN | ends with a body lost |\n\
         |---|---|---|---|---|---|---|---|\n",
    );
    let mut suites: BTreeMap<&str, Vec<&Row>> = BTreeMap::new();
    rows.iter().for_each(|row| suites.entry(&row.suite).or_default().push(row));
    for (suite, rows) in &suites {
        let sum = |of: fn(&Row) -> usize| rows.iter().map(|row| of(row)).sum::<usize>();
        let _ = writeln!(
            table,
            "| {suite} | {} | {} | {} | {} | {} | {} | {} |",
            rows.len(),
            sum(|row| row.episodes as usize),
            sum(|row| row.steps),
            sum(|row| row.unstable),
            sum(|row| row.warnings),
            sum(|row| row.not_finite),
            sum(|row| row.lost),
        );
    }
    let soft: Vec<_> = rows.iter().filter_map(|row| Some((row, row.soft.as_ref()?))).collect();
    if !soft.is_empty() {
        table += "\n| id | longest edge, of its rest | vertices inside the table, most | rope, of its rest | free bodies |\n|---|---|---|---|---|\n";
        for (row, soft) in soft {
            let ratio = |ratio: Option<f64>| ratio.map_or("-".to_owned(), |ratio| format!("{ratio:.4}"));
            let (edge, rope) = (ratio(soft.stretch), ratio(soft.rope));
            let _ = writeln!(table, "| {} | {edge} | {} | {rope} | {} |", row.id, soft.through, row.bodies);
        }
    }
    let broken: Vec<_> = rows.iter().filter(|row| !row.holds()).collect();
    if broken.is_empty() {
        return (table, Ok(()));
    }
    table += "\n| id that breaks a law | ended by physics | resets, bad controls | steps with NaN | ends with a body lost |\n|---|---|---|---|---|\n";
    for row in &broken {
        let Row { id, unstable, warnings, not_finite, lost, .. } = row;
        let _ = writeln!(table, "| {id} | {unstable} | {warnings} | {not_finite} | {lost} |");
    }
    let ids: Vec<_> = broken.iter().map(|row| row.id.as_str()).collect();
    (table, Err(format!("laws are broken in episodes of {}", ids.join(", "))))
}
