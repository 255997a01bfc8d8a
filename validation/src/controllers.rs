//! Tasks and the controllers that solve them, beside actions that are zero or random: successes on the same seeds, and the speed of the
//! environments.

use crate::by_id;
use crate::own_ids::own_ids;
use agents::Policy;
use control::{Controller, Entry};
use env::episode::{Summary, evaluate};
use env::{Env, Options, OwnModels};
use std::collections::BTreeSet;
use std::fmt::Write;
use std::time::{Duration, Instant};

/// Episodes of each, seeded from 0 on.
const EPISODES: u64 = 20;
/// Share of the episodes that a controller is to solve \[%\].
const SOLVES: f64 = 80.0;
/// Share that zero or random actions may solve \[%\].
const FAILS: f64 = 5.0;

/// Tables that are written: of successes, and of speeds.
const TABLES: usize = 2;

/// Tasks of others that are kept as they are defined, and why zero or random actions solve them too.
const EASY: &[(&str, &str)] = &[
    (
        "hive/DClawScrewFixed-v0",
        "the mark starts where the valve is, and a touch moves the valve along with it for six steps",
    ),
    (
        "hive/DClawScrewRandom-v0",
        "the mark starts where the valve is, and a slow one is near it for six steps",
    ),
    (
        "hive/pen-v1",
        "the target may be near the pen, and a pen that rolls or falls points its way for six steps",
    ),
];

/// What a task comes to.
#[derive(Clone, Debug)]
pub struct Row {
    /// The id.
    pub id: String,
    /// The suite.
    pub suite: String,
    /// The controller.
    pub controller: &'static str,
    /// Successes of the controller, of zero and of random actions \[%\].
    pub success: [f64; 3],
    /// Steps of the environment a second, under random actions: one over the median of their times, which other work of the machine
    /// does not change.
    pub speed: f64,
    /// Control period \[s\].
    pub dt: f64,
    /// Mean time of the controller for an action \[s\].
    pub thought: f64,
}

/// What acts.
enum Actor {
    Policy(Policy),
    Controller(Box<dyn Controller>),
}

/// Successes \[%\], steps, and times of the environment and of what acts.
struct Played {
    success: f64,
    steps: usize,
    /// Median time of a step.
    step: Duration,
    thought: Duration,
}

/// Every id on a model of our own that a controller serves and that contains `only`, of one suite or of all. Ids that add pictures to
/// another one are left out.
///
/// # Errors
/// There is no such id; an environment or a controller that fails, with its id.
pub fn measure(suite: &str, only: &str) -> Result<Vec<Row>, String> {
    let mut rows = Vec::new();
    for spec in own_ids(suite, only) {
        if let Some(entry) = control::serving(spec).next() {
            rows.push(row(&spec.id, entry).map_err(|error| format!("{}: {error}", spec.id))?);
        }
    }
    if rows.is_empty() {
        return Err(format!("no controller serves an id of the suite {suite:?} that contains {only:?}"));
    }
    Ok(rows)
}

fn row(id: &str, entry: &'static Entry) -> Result<Row, String> {
    let mut env = Env::make(id, &OwnModels, &Options::default()).map_err(|error| error.to_string())?;
    let controller = control::make(entry.name, &env).map_err(|error| error.to_string())?;
    let by_controller = play(&mut env, Actor::Controller(controller))?;
    let by_zero = play(&mut env, Actor::Policy(Policy::Zero))?;
    let by_random = play(&mut env, Actor::Policy(Policy::random(0)))?;
    let row = Row {
        id: id.to_owned(),
        suite: env.spec().suite.clone(),
        controller: entry.name,
        success: [by_controller.success, by_zero.success, by_random.success],
        speed: 1.0 / by_random.step.as_secs_f64().max(1e-9),
        dt: env.dt(),
        thought: by_controller.thought.as_secs_f64() / by_controller.steps.max(1) as f64,
    };
    println!("{id}: {:?}", row.success);
    Ok(row)
}

fn play(env: &mut Env, mut actor: Actor) -> Result<Played, String> {
    let mut action = vec![0.0; env.action_len()];
    let mut episodes = Vec::new();
    let (mut stepped, mut thought) = (Vec::new(), Duration::ZERO);
    for seed in 0..EPISODES {
        let said = |error: &dyn std::fmt::Display| format!("seed {seed}: {error}");
        env.reset(Some(seed)).map_err(|error| said(&error))?;
        match &mut actor {
            Actor::Policy(policy) => *policy = policy.for_episode(seed),
            Actor::Controller(controller) => controller.reset(env, seed).map_err(|error| said(&error))?,
        }
        let mut episode = Summary::default();
        while !episode.terminated && !episode.truncated {
            let began = Instant::now();
            match &mut actor {
                Actor::Policy(policy) => policy.action(env, &mut action).map_err(|error| said(&error))?,
                Actor::Controller(controller) => {
                    controller.act(env, &mut action).map_err(|error| said(&error))?;
                }
            }
            let acted = Instant::now();
            let step = env.step(&action).map_err(|error| said(&error))?;
            thought += acted - began;
            stepped.push(acted.elapsed());
            episode.add(env, &step);
        }
        episodes.push(episode);
    }
    let steps = episodes.iter().map(|episode| episode.steps).sum();
    let success = evaluate(&episodes, env.success()).success_percentage;
    stepped.sort_unstable();
    let step = stepped.get(stepped.len() / 2).copied().unwrap_or_default();
    Ok(Played { success, steps, step, thought })
}

/// The tables, and whether every task is solved by its controller and by nothing less.
pub fn render(rows: &[Row]) -> (String, Result<(), String>) {
    let mut table = String::from(
        "| id | suite | controller | success | zero actions | random actions |\n|---|---|---|---|---|---|\n",
    );
    for Row { id, suite, controller, success: [solved, zero, random], .. } in rows {
        let _ = writeln!(
            table,
            "| {id} | {suite} | {controller} | {solved:.0} % | {zero:.0} % | {random:.0} % |"
        );
    }
    table += "\n| id | env steps a second | times real time | time of the controller for a step |\n|---|---|---|---|\n";
    for Row { id, speed, dt, thought, .. } in rows {
        let _ = writeln!(table, "| {id} | {speed:.0} | {:.0} | {:.3} ms |", speed * dt, 1e3 * thought);
    }
    let easy = |row: &Row| EASY.iter().find(|(id, _)| *id == row.id);
    for (id, reason) in rows.iter().filter_map(easy) {
        let _ = write!(table, "\n{id} is solved by less, as RoboHive or ROBEL defines it: {reason}.\n");
    }
    let missed = |row: &&Row| {
        let by_less = easy(row).is_none() && row.success[1..].iter().any(|&share| share >= FAILS);
        row.success[0] < SOLVES || by_less
    };
    let missing: Vec<_> = rows.iter().filter(missed).map(|row| row.id.as_str()).collect();
    let verdict = if missing.is_empty() {
        Ok(())
    } else {
        Err(format!("not solved by their controllers, or by less: {}", missing.join(", ")))
    };
    (table, verdict)
}

/// A written text of tables in which the rows and reasons of `newer` replace or join those of `older`.
pub fn joined(older: &str, newer: &str) -> String {
    let [older, newer]: [Vec<&str>; 2] = [older, newer].map(|text| text.trim().split("\n\n").collect());
    let table = |text: &[&'_ str], k: usize| text.get(k).map_or("", |table| *table).to_owned();
    let tables = (0..TABLES).map(|k| by_id::joined(&table(&older, k), &table(&newer, k)));
    let reasons: BTreeSet<_> = older.iter().skip(TABLES).chain(newer.iter().skip(TABLES)).collect();
    tables.chain(reasons.into_iter().map(|reason| (*reason).to_owned())).collect::<Vec<_>>().join("\n\n")
        + "\n"
}

#[cfg(test)]
mod tests {
    use super::*;

    fn row(id: &str, success: f64) -> Row {
        let suite = "classical".to_owned();
        Row {
            id: id.into(),
            suite,
            controller: "c",
            success: [success, 0.0, 0.0],
            speed: 10.0,
            dt: 0.1,
            thought: 0.0,
        }
    }

    #[test]
    fn measured_rows_replace_written_ones_and_others_stay() {
        let (furuta, acrobot) = ("hive/FurutaPendulum-v0", "hive/Acrobot-v0");
        let older = render(&[row(furuta, 90.0)]).0;
        let joined = joined(&older, &render(&[row(acrobot, 100.0), row(furuta, 95.0)]).0);
        assert_eq!(joined, render(&[row(acrobot, 100.0), row(furuta, 95.0)]).0);
        let kept = super::joined(&joined, &render(&[row(acrobot, 40.0)]).0);
        assert_eq!(kept, render(&[row(acrobot, 40.0), row(furuta, 95.0)]).0);
        assert_eq!(super::joined("", &older), older);
    }
}
