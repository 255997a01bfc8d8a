//! The policies that are shipped: what each solves in the environments that it was trained in, beside zero and random actions.

use agents::learn::{Card, Lessons, Settings, Teaching};
use agents::statistics::wilson;
use agents::{Policy, Trained};
use env::episode::evaluate;
use env::{Env, Options, OwnModels};
use std::fmt::Write;

/// Episodes of each, seeded from 0 on: training resets with other seeds.
const EPISODES: u32 = 200;
/// Share of the episodes that a policy is to solve \[%\].
const SOLVES: f64 = 80.0;

/// What a policy comes to.
#[derive(Clone, Debug)]
pub struct Row {
    /// Id of the environment.
    pub id: String,
    /// The command that trained it.
    pub command: String,
    /// Steps of environments that it learnt from.
    pub samples: u64,
    /// Bytes of its file.
    pub bytes: usize,
    /// Successes of the policy, of zero and of random actions \[%\].
    pub success: [f64; 3],
}

/// Every policy that is shipped for an id that contains `only`.
///
/// # Errors
/// There is none; a file is damaged; an environment fails.
pub fn measure(only: &str) -> Result<Vec<Row>, String> {
    let rows = assets::policies().filter(|id| id.contains(only)).map(|id| {
        let made = row(id).map_err(|error| format!("{id}: {error}"))?;
        println!("{id}: {:?}", made.success);
        Ok(made)
    });
    match rows.collect::<Result<Vec<_>, String>>()? {
        rows if rows.is_empty() => Err(format!("no policy is shipped for an id that contains {only:?}")),
        rows => Ok(rows),
    }
}

fn row(id: &str) -> Result<Row, String> {
    let bytes = assets::policy(id).ok_or("it has no file")?;
    let Policy::Trained(trained) = Policy::parse(bytes).map_err(|error| error.to_string())? else {
        return Err("it was not trained here".into());
    };
    let command = command(&trained)?;
    let mut env = Env::make(id, &OwnModels, &Options::default()).map_err(|error| error.to_string())?;
    let (samples, mut success) = (trained.card().samples, [0.0; 3]);
    let policies = [Policy::Trained(trained), Policy::Zero, Policy::random(0)];
    for (policy, success) in policies.into_iter().zip(&mut success) {
        let play = |seed| policy.play(&mut env, seed).map_err(|error| error.to_string());
        let episodes = (0..u64::from(EPISODES)).map(play).collect::<Result<Vec<_>, _>>()?;
        *success = evaluate(&episodes, env.success()).success_percentage;
    }
    Ok(Row { id: id.to_owned(), command, samples, bytes: bytes.len(), success })
}

/// The command that trains a policy, whose settings are those to begin with.
fn command(trained: &Trained) -> Result<String, String> {
    let Card { id, iterations, seed, settings, teacher, .. } = trained.card();
    let algorithm = settings.algorithm.name();
    if Settings::named(algorithm).as_ref() != Some(settings) {
        return Err("its settings are none that `robohive train` has by itself".into());
    }
    let mut command =
        format!("robohive train {id} --algo {algorithm} --iterations {iterations} --seed {seed}");
    if let Some(Teaching { by, lessons }) = teacher {
        let Lessons { episodes, noise } = lessons;
        let _ = write!(command, " --teacher {by} --demonstrations {episodes} --demonstration-noise {noise}");
    }
    Ok(command)
}

/// The table, and whether every policy solves its task and nothing less does as well.
pub fn render(rows: &[Row]) -> (String, Result<(), String>) {
    let mut table = String::from(
        "| id | success | 95 % interval | zero actions | random actions | samples | bytes | trained by |\n|---|---|---|---|---|---|---|---|\n",
    );
    let interval = |solved: f64| wilson(solved / 100.0, EPISODES).map(|share| 100.0 * share);
    for Row { id, command, samples, bytes, success: [solved, zero, random] } in rows {
        let [low, high] = interval(*solved);
        let _ = writeln!(
            table,
            "| {id} | {solved:.1} % | {low:.1} to {high:.1} % | {zero:.1} % | {random:.1} % | {samples} | {bytes} | `{command}` |"
        );
    }
    let missed = |row: &&Row| {
        let [solved, zero, random] = row.success;
        solved < SOLVES || interval(solved)[0] <= zero.max(random)
    };
    let missing: Vec<_> = rows.iter().filter(missed).map(|row| row.id.as_str()).collect();
    match missing.is_empty() {
        true => (table, Ok(())),
        false => (table, Err(format!("not solved, or by less as well: {}", missing.join(", ")))),
    }
}
