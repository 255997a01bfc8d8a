//! `view`: a model, an environment or a recording in a window.

use crate::failure::Failure;
use crate::input::library::Making;
use clap::{Args, ValueHint};
use env::Compat;
use std::path::{Path, PathBuf};

/// Look at a model, an environment or a recording in a window, run it, pull it
#[derive(Args)]
#[command(
    after_help = "Space runs and pauses, the arrows step forward and back, a double click selects a body, Ctrl with the right \
button pulls it, and F1 shows all keys and gestures, which are those of MuJoCo's viewer. A model is read again when its file is \
saved, and goes on in the state that it is in. Without a name the window is empty: drop a file on it, or choose a model or an \
environment of our own.

An environment plays episode after episode, seeded with SEED, SEED + 1 and so on, as `robohive run` does; the window shows rewards, \
observations and success, and what acts can be changed to zero actions, random ones, the policy, or sliders that you move.

A trajectory, .npz, as `robohive sim --out` writes it, holds the states of a model without its name: give it by --model. It is replayed \
with a scrubber. With --reference a second trajectory is drawn beside the first, or beside the simulation of a model, translucent and at \
the same time, and Plots follows their difference. A recording of episodes, .h5, as `robohive run --record` writes it, is replayed trial by \
trial in the environment that it names; RoboHive's own files name none: give it by --model ID.

A build has the window with the feature `window`: cargo install --path src/cli --features window

Examples:
  robohive view assets/franka/franka_table.xml
  robohive view quadruped
  robohive view hive/FrankaReach-v0
  robohive view door-v1 --policy door-v1.pickle
  robohive view states.npz --model pile
  robohive view states.npz --model pile --reference other.npz
  robohive view episodes.h5
  robohive view"
)]
pub struct View {
    /// A file (MJCF, URDF, or what `compile` wrote), the name of a model of our own, the id of an environment, or a recording
    /// (.npz, .h5)
    #[arg(value_name = "MODEL|ID|FILE", value_hint = ValueHint::FilePath)]
    pub subject: Option<PathBuf>,
    /// The model of an .npz trajectory, or the id of the environment of an .h5 recording [default: the one that the recording
    /// names]
    #[arg(long, value_name = "MODEL|ID", value_hint = ValueHint::FilePath)]
    pub model: Option<PathBuf>,
    /// A trajectory to draw beside what is shown
    #[arg(long, value_name = "FILE.npz", value_hint = ValueHint::FilePath)]
    pub reference: Option<PathBuf>,
    /// A policy that acts in the environment
    #[arg(long, value_name = "FILE", value_hint = ValueHint::FilePath)]
    pub policy: Option<PathBuf>,
    /// Seed of the first episode
    #[arg(long, value_name = "SEED", default_value_t = 0)]
    pub seed: u64,
    /// Change a setting of the environment, e.g. frame_skip=20 or target_xyz_range.low=[0,0,1]; VALUE is TOML, or text
    #[arg(long = "set", value_name = "SETTING=VALUE")]
    pub settings: Vec<String>,
    /// Whose behaviour the environment has: `fixed` or `robohive-0.7` [default: what the recording names, else `fixed`]
    #[arg(long, value_name = "VERSION")]
    pub compat: Option<Compat>,
    /// Folder with RoboHive's envs and simhive, instead of the imported assets
    #[arg(long, value_name = "FOLDER", value_hint = ValueHint::DirPath)]
    pub assets: Option<PathBuf>,
    /// Keep compiled models in this folder [default: the environment variable ROBOHIVE_CACHE, else the user's cache folder]
    #[arg(long, value_name = "FOLDER", value_hint = ValueHint::DirPath)]
    pub cache: Option<PathBuf>,
}

/// What the words ask for.
#[derive(Clone, Copy)]
#[cfg_attr(not(feature = "window"), expect(dead_code, reason = "only a build with a window shows it"))]
enum Subject<'a> {
    Nothing,
    /// A model or an environment.
    Named(&'a Path),
    /// A trajectory and the name of its model.
    States(&'a Path, &'a Path),
    /// Recorded episodes.
    Episodes(&'a Path),
}

impl View {
    /// What is asked for; refuses what does not go together.
    fn subject(&self) -> Result<Subject<'_>, Failure> {
        let refuse = |given: bool, why: String| if given { Err(Failure::usage(why)) } else { Ok(()) };
        let reference = "--reference FILE.npz is drawn beside a model or an .npz trajectory";
        let Some(path) = self.subject.as_deref() else {
            refuse(self.reference.is_some(), format!("{reference}; name one"))?;
            refuse(
                self.model.is_some(),
                "--model goes with a recording; a model itself needs no option".into(),
            )?;
            return Ok(Subject::Nothing);
        };
        let shown = path.display();
        let ending = path.extension().and_then(|ending| ending.to_str()).unwrap_or_default().to_lowercase();
        let recorded = matches!(&ending[..], "npz" | "h5" | "hdf5");
        refuse(recorded && self.policy.is_some(), format!("{shown} is replayed; no policy acts in it"))?;
        match &ending[..] {
            "npz" => {
                let model = self.model.as_deref().ok_or_else(|| {
                    Failure::usage(format!(
                        "{shown} holds states, and not whose: give their model by --model MODEL"
                    ))
                })?;
                Ok(Subject::States(path, model))
            }
            "h5" | "hdf5" => {
                refuse(self.reference.is_some(), format!("{reference}; {shown} holds episodes"))?;
                Ok(Subject::Episodes(path))
            }
            _ => {
                refuse(
                    self.model.is_some(),
                    format!("--model goes with a recording, .npz or .h5; {shown} is none"),
                )?;
                Ok(Subject::Named(path))
            }
        }
    }

    /// How environments are made that no recording describes.
    fn making(&self) -> Making {
        Making {
            settings: self.settings.clone(),
            compat: self.compat.unwrap_or(Compat::Fixed),
            assets: self.assets.clone(),
            cache: self.cache.clone(),
            solver: Default::default(),
        }
    }
}

/// Runs the command.
#[cfg(feature = "window")]
pub fn run(a: &View) -> Result<(), Failure> {
    let source = subjects::source(a, a.subject()?)?;
    viewer::window::run(source, subjects::recordings(a)?).map_err(|error| Failure::new(error.to_string()))
}

/// Says how to get a window.
#[cfg(not(feature = "window"))]
pub fn run(a: &View) -> Result<(), Failure> {
    let instead = match a.subject()? {
        Subject::Named(path) => format!("; `robohive render {}` draws a picture", path.display()),
        _ => String::new(),
    };
    a.making().changes()?;
    Err(Failure::usage(format!(
        "this build has no window; `cargo install --path src/cli --features window` installs one that has{instead}"
    )))
}

/// From names to what the window shows.
#[cfg(feature = "window")]
mod subjects {
    use super::{Subject, View};
    use crate::failure::Failure;
    use agents::Policy;
    use env::{Env, Options, Registry};
    use std::path::Path;
    use viewer::Play;
    use viewer::window::{Making, Recipe, Recording, Source, States};

    /// What the window shows. What is wrong with recordings and environments is said here rather than in the window.
    pub fn source(a: &View, subject: Subject<'_>) -> Result<Option<Source>, Failure> {
        let states = |of: Source, replayed: Option<&Path>| {
            let replayed = replayed.map(Path::to_owned);
            Source::States(Box::new(States { of, replayed, reference: a.reference.clone() }))
        };
        let source = match subject {
            Subject::Nothing => return Ok(None),
            Subject::Named(name) => {
                let found = named(a, name)?;
                if a.reference.is_none() {
                    return Ok(Some(found));
                }
                states(found, None)
            }
            Subject::States(path, model) => states(named(a, model)?, Some(path)),
            Subject::Episodes(path) => {
                let environment = a.model.as_ref().map(|id| id.to_string_lossy().into_owned());
                Source::Episodes(Recording { path: path.to_owned(), environment, making: recordings(a)? })
            }
        };
        source.check().map_err(|error| Failure::usage(error.to_string()))?;
        Ok(Some(source))
    }

    /// Makes the environments of recordings: as these describe them, and the arguments change them.
    pub fn recordings(a: &View) -> Result<Making, Failure> {
        let (making, compat) = (a.making(), a.compat);
        let (library, own) = (making.assets()?, making.changes()?);
        Ok(Making::by(move |described| {
            let mut changes = described.settings.clone();
            changes.extend(own.clone());
            let compat = compat.unwrap_or(described.compat);
            Env::make(&described.id, &library, &Options::default().with_compat(compat).with_changes(changes))
        }))
    }

    /// A file, an environment, or a model of our own.
    fn named(a: &View, subject: &Path) -> Result<Source, Failure> {
        let name = subject.to_string_lossy();
        if !subject.is_file() && Registry::builtin().spec(&name).is_ok() {
            return environment(a, &name);
        }
        if a.policy.is_some() || a.compat.is_some() || !a.settings.is_empty() {
            return Err(Failure::usage(format!(
                "--policy, --compat and --set go with environments; {name} is none"
            )));
        }
        if subject.is_file() {
            return Ok(Source::File(subject.to_owned()));
        }
        Source::own().find(|source| source.title() == name).ok_or_else(|| unknown(&name))
    }

    fn environment(a: &View, id: &str) -> Result<Source, Failure> {
        let policy = a
            .policy
            .as_ref()
            .map(Policy::open)
            .transpose()
            .map_err(|error| Failure::usage(error.to_string()))?;
        let making = a.making();
        let (library, options, seed) = (making.assets()?, making.options()?, a.seed);
        let name = id.to_owned();
        let make = move || {
            let env = Env::make(&name, &library, &options)?;
            Ok(Play::new(env, policy.clone(), seed)?.made_by(options.clone()))
        };
        make().map_err(Failure::usage)?;
        Ok(Source::Environment(Recipe::new(id, make)))
    }

    fn unknown(name: &str) -> Failure {
        let near = Registry::builtin().spec(name).err().map(|error| error.to_string()).unwrap_or_default();
        let names: Vec<String> = Source::own().map(|source| source.title()).collect();
        Failure::usage(format!(
            "{name} is neither a file nor a model of our own ({}) nor an environment: {near}",
            names.join(", ")
        ))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::Parser;

    #[derive(Parser)]
    struct Words {
        #[command(flatten)]
        view: View,
    }

    fn view(words: &str) -> View {
        Words::parse_from(["view"].into_iter().chain(words.split_whitespace())).view
    }

    #[test]
    fn recordings_are_told_from_models_by_their_endings() {
        assert!(matches!(view("").subject(), Ok(Subject::Nothing)));
        assert!(matches!(view("arm.xml --reference a.npz").subject(), Ok(Subject::Named(_))));
        let states = view("a.NPZ --model arm.xml --reference b.npz");
        assert!(matches!(states.subject(), Ok(Subject::States(_, model)) if model == Path::new("arm.xml")));
        assert!(matches!(view("a.h5").subject(), Ok(Subject::Episodes(_))));
        assert!(matches!(view("a.hdf5 --model door-v1").subject(), Ok(Subject::Episodes(_))));
    }

    #[test]
    fn what_does_not_go_together_is_refused() {
        let refused = [
            ("a.npz", "give their model by --model MODEL"),
            ("a.npz --model pile --policy p.pickle", "no policy acts in it"),
            ("a.h5 --reference b.npz", "a.h5 holds episodes"),
            ("--reference b.npz", "beside a model or an .npz trajectory; name one"),
            ("--model pile", "--model goes with a recording"),
            ("pile --model pile", "pile is none"),
        ];
        for (words, why) in refused {
            let error = view(words).subject().err().unwrap_or_else(|| panic!("{words} is taken"));
            assert!(error.to_string().contains(why), "{words}: {error}");
        }
    }

    #[cfg(feature = "window")]
    #[test]
    fn recordings_open_and_wrong_ones_say_what_is_wrong() {
        let root = concat!(env!("CARGO_MANIFEST_DIR"), "/../..");
        let own = |name: &str| format!("{root}/validation/reference/own/{name}.npz");
        let asked = |words: &str| {
            let view = view(words);
            view.subject().and_then(|subject| subjects::source(&view, subject))
        };
        let (pile, arm) = (own("pile"), own("franka_table"));
        for words in [format!("{pile} --model pile --reference {pile}"), format!("pile --reference {pile}")] {
            assert!(asked(&words).is_ok_and(|source| source.is_some()), "{words}");
        }
        for (words, why) in [
            (format!("{arm} --model pile"), "is it of this model?"),
            (format!("pile --reference {arm}"), "is it of this model?"),
            (format!("{pile} --model hive/FrankaReach-v0"), "is an environment"),
            (format!("{pile} --model no_model"), "nor a model of our own"),
            (format!("{pile} --model pile --set a=1"), "go with environments"),
            ("nowhere.npz --model pile".to_owned(), "nowhere.npz"),
            ("nowhere.h5".to_owned(), "nowhere.h5"),
        ] {
            let error = asked(&words).err().unwrap_or_else(|| panic!("{words} is taken"));
            assert!(error.to_string().contains(why), "{words}: {error}");
        }
    }
}
