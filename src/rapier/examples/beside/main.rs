//! Rapier beside our own solver, and beside rapier's own loader of MJCF, in tables:
//!
//! ```sh
//! cargo run --release -p robohive-rapier --features stock --example beside -- worlds|motion|speed|piles [CORPUS LIST]
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
use std::error::Error;
use std::path::{Path, PathBuf};

const USAGE: &str = "usage: beside worlds|motion|speed|piles [CORPUS LIST]";

/// Begins the names of this repository's models.
const OWN: &str = "own ";

/// Models of this repository, as paths in `assets`.
const MODELS: [&str; 11] = [
    "delays/delays",
    "drape/drape",
    "elbow/elbow",
    "franka/franka_table",
    "grasp/grasp",
    "humanoid/humanoid",
    "pile/pile",
    "quadruped/quadruped",
    "servos/servos",
    "workbench/workbench",
    "yard/yard",
];

/// A model and what stands for it in a table.
pub struct Subject {
    /// Name in the table.
    pub name: String,
    /// Where loaders find it.
    pub path: PathBuf,
}

impl Subject {
    fn new(name: &str, path: PathBuf) -> Self {
        Subject { name: name.into(), path }
    }

    /// The model, or why there is none.
    pub fn model(&self) -> Result<Model, String> {
        // Three of RoboHive's files are templates.
        let loaded = mjcf::Loader::default().substitute("OBJECT_NAME", "airplane").load(&self.path);
        loaded.map(|loaded| loaded.model).map_err(|error| error.to_string())
    }

    fn own(path: &str) -> Self {
        Subject::new(&format!("{OWN}{path}"), Path::new("assets").join(path).with_extension("xml"))
    }

    /// Whether it is one of this repository's models.
    pub fn is_own(&self) -> bool {
        self.name.starts_with(OWN)
    }
}

/// What an error says first; the rest would not fit in a table.
pub fn first_line(error: &str) -> &str {
    error.lines().next().unwrap_or(error)
}

/// Our own models, then those of the list.
fn subjects(corpus: Option<(&str, &str)>) -> std::io::Result<Vec<Subject>> {
    let mut all: Vec<_> = MODELS.map(Subject::own).into();
    if let Some((corpus, list)) = corpus {
        let text = std::fs::read_to_string(list)?;
        all.extend(text.lines().map(|line| Subject::new(line, Path::new(corpus).join(line))));
    }
    Ok(all)
}

fn main() -> Result<(), Box<dyn Error>> {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let words: Vec<&str> = words.iter().map(String::as_str).collect();
    let (what, corpus) = match words[..] {
        [what] => (what, None),
        [what, corpus, list] => (what, Some((corpus, list))),
        _ => return Err(USAGE.into()),
    };
    match what {
        "worlds" => worlds::table(&subjects(corpus)?),
        "motion" => motion::table(&subjects(corpus)?)?,
        "speed" => speed::table(&subjects(corpus)?),
        "piles" => speed::piles()?,
        _ => return Err(USAGE.into()),
    }
    Ok(())
}
