//! Ids of environments with their suites and lengths, from the registry; sizes of observations and actions from a record, since
//! few machines have all models.

use crate::stage::save;
use env::{Assets, Env, EnvError, Folder, Options, OwnModels, Registry, Spec};
use std::collections::BTreeMap;
use std::fmt::Write;
use std::path::Path;

/// The record: an id, the numbers that it observes, and those of an action, a line.
const RECORD: &str = "site/reference/sizes.txt";

type Sizes = BTreeMap<String, [usize; 2]>;

/// Numbers of an observation and of an action.
fn size(id: &str, assets: &dyn Assets) -> Result<[usize; 2], EnvError> {
    let env = Env::make(id, assets, &Options::default())?;
    Ok([env.observation().len(), env.action_len()])
}

fn recorded(root: &Path) -> Result<Sizes, String> {
    let text = std::fs::read_to_string(root.join(RECORD)).map_err(|error| format!("{RECORD}: {error}"))?;
    let line = |(number, line): (usize, &str)| {
        let mut words = line.split(' ');
        let id = words.next().unwrap_or_default().to_owned();
        let sizes: Option<Vec<usize>> = words.map(|word| word.parse().ok()).collect();
        let sizes = sizes.and_then(|sizes| <[usize; 2]>::try_from(sizes).ok());
        let sizes =
            sizes.ok_or_else(|| format!("{RECORD}:{}: a line is an id and two numbers", number + 1))?;
        Ok((id, sizes))
    };
    text.lines().enumerate().map(line).collect()
}

/// Makes the record again, with RoboHive's models in the folder `models`; the number of ids.
///
/// # Errors
/// An environment cannot be made.
pub fn sizes(root: &Path, models: &Path) -> Result<usize, String> {
    let assets = Folder::new(models);
    let mut text = String::new();
    let specs = Registry::builtin().specs();
    for spec in specs {
        let [observation, action] =
            size(&spec.id, &assets).map_err(|error| format!("{}: {error}", spec.id))?;
        // Writing to a String cannot fail.
        let _ = writeln!(text, "{} {observation} {action}", spec.id);
    }
    save(&root.join(RECORD), text.as_bytes())?;
    Ok(specs.len())
}

/// All ids by suites, after a table of the suites.
///
/// # Errors
/// The record lacks an id, or says of one on models of our own what is not so.
pub fn environments(root: &Path) -> Result<String, String> {
    let sizes = recorded(root)?;
    let specs = Registry::builtin().specs();
    let mut suites: Vec<&str> = Vec::new();
    for spec in specs {
        if !suites.contains(&spec.suite.as_str()) {
            suites.push(&spec.suite);
        }
    }
    let mut text = String::from("| suite | ids |\n|---|---|\n");
    let of = |suite: &str| -> Vec<&Spec> { specs.iter().filter(|spec| spec.suite == suite).collect() };
    // Writing to a String cannot fail.
    for suite in &suites {
        let _ = writeln!(text, "| [{suite}](#{suite}) | {} |", of(suite).len());
    }
    let _ = writeln!(text, "| all | {} |\n", specs.len());
    for suite in suites {
        let _ = writeln!(
            text,
            "## {suite}\n\n| id | task | steps | observation | action |\n|---|---|---|---|---|"
        );
        for spec in of(suite) {
            let known = sizes.get(&spec.id).ok_or_else(|| lacks(&spec.id))?;
            if spec.id.starts_with("hive/")
                && size(&spec.id, &OwnModels).map_err(|error| error.to_string())? != *known
            {
                return Err(lacks(&spec.id));
            }
            let [observation, action] = known;
            let _ = writeln!(
                text,
                "| `{}` | {} | {} | {observation} | {action} |",
                spec.id, spec.task, spec.max_episode_steps
            );
        }
        let _ = writeln!(text);
    }
    Ok(text)
}

fn lacks(id: &str) -> String {
    format!(
        "{RECORD} lacks or misstates {id}: record it again by `cargo run -p robohive-site -- sizes FOLDER`"
    )
}
