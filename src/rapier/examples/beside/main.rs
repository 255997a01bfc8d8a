//! Rapier beside our own solver, and beside rapier's own loader of MJCF, in tables:
//!
//! ```sh
//! cargo run --release -p robohive-rapier --features stock --example beside -- worlds|motion|speed|piles|bits [CORPUS LIST]
//! ```
//!
//! Own models always; with the folder that holds RoboHive's `envs` and `simhive` and a list of models in it, one path a line,
//! those too.

mod motion;
mod scenes;
mod speed;
#[cfg(feature = "stock")]
mod stock;
mod worlds;

use physics::Model;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// A model and what stands for it in a table.
pub struct Subject {
    /// Name in the table.
    pub name: String,
    /// Where rapier's own loader finds it.
    pub path: PathBuf,
    /// The model, or why there is none.
    pub model: Result<Model, String>,
}

impl Subject {
    fn read(name: &str, path: PathBuf) -> Self {
        // Three of RoboHive's files are templates.
        let loaded = mjcf::Loader::default().substitute("OBJECT_NAME", "airplane").load(&path);
        let model = loaded.map(|loaded| loaded.model).map_err(|error| error.to_string());
        Subject { name: name.into(), path, model }
    }
}

/// Our own models, then those of the list.
fn subjects(corpus: Option<(&str, &str)>) -> std::io::Result<Vec<Subject>> {
    let own = [
        "delays",
        "drape",
        "elbow",
        "franka/franka_table",
        "grasp",
        "humanoid",
        "pile",
        "quadruped",
        "servos",
    ]
    .into_iter()
    .chain(["workbench", "yard"])
    .map(|name| if name.contains('/') { name.to_owned() } else { format!("{name}/{name}") })
    .map(|path| Subject::read(&format!("own {path}"), Path::new("assets").join(path + ".xml")));
    let mut all: Vec<_> = own.collect();
    if let Some((corpus, list)) = corpus {
        let text = std::fs::read_to_string(list)?;
        all.extend(text.lines().map(|line| Subject::read(line, Path::new(corpus).join(line))));
    }
    Ok(all)
}

fn main() -> ExitCode {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let words: Vec<&str> = words.iter().map(String::as_str).collect();
    let (what, corpus) = match words[..] {
        [what] => (what, None),
        [what, corpus, list] => (what, Some((corpus, list))),
        _ => ("", None),
    };
    let all = match subjects(corpus) {
        Ok(all) => all,
        Err(error) => {
            eprintln!("{error}");
            return ExitCode::FAILURE;
        }
    };
    match what {
        "worlds" => worlds::table(&all),
        "motion" => motion::table(&all),
        "speed" => speed::table(&all),
        "piles" => speed::piles(),
        "bits" => motion::bits(),
        _ => {
            eprintln!("usage: beside worlds|motion|speed|piles|bits [CORPUS LIST]");
            return ExitCode::FAILURE;
        }
    }
    ExitCode::SUCCESS
}
