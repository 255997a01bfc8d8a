//! What a picture is of: a model in a state, or an environment after a reset.

use crate::failure::Failure;
use crate::input::library::{Making, Source};
use crate::input::loading::{STANDARD_INPUT, load, own, start};
use crate::input::source::Reading;
use clap::{Args, ValueHint};
use env::visual::VisualKey;
use env::{Compat, Env, Registry, Spec};
use physics::{Data, Model, forward};
use std::path::{Path, PathBuf};

/// A model in a state, or an environment after a reset.
#[derive(Args)]
pub struct SubjectArguments {
    /// MJCF file or compiled model, - for standard input; or the id of an environment, which is then reset
    #[arg(value_name = "MODEL|ID", value_hint = ValueHint::FilePath)]
    name: String,
    /// Start from this keyframe, by name or number [default: the first, if any]
    #[arg(help_heading = "Models", long, value_name = "KEY")]
    keyframe: Option<String>,
    /// Positions, as many as the model's nq, separated by commas
    #[arg(
        help_heading = "Models",
        long,
        value_name = "Q,…",
        value_delimiter = ',',
        num_args = 1,
        allow_hyphen_values = true
    )]
    qpos: Vec<f64>,
    /// Replace TEXT by VALUE in the file and all it includes
    #[arg(help_heading = "Models", long = "define", value_name = "TEXT=VALUE")]
    defines: Vec<String>,
    /// Memory that the model may ask for, in MiB
    #[arg(help_heading = "Models", long, value_name = "MIB", default_value_t = 2048, value_parser = clap::value_parser!(u32).range(1..))]
    memory: u32,
    /// Seed of the reset [default: 0]
    #[arg(help_heading = "Environments", long, value_name = "SEED")]
    seed: Option<u64>,
    /// Change a setting, e.g. frame_skip=20; VALUE is TOML, or text
    #[arg(help_heading = "Environments", long = "set", value_name = "SETTING=VALUE")]
    settings: Vec<String>,
    /// Whose behaviour: `fixed`, or `robohive-0.7` with the original's quirks [default: fixed]
    #[arg(help_heading = "Environments", long, value_name = "VERSION")]
    compat: Option<Compat>,
    /// Folder with RoboHive's envs and simhive, instead of the imported assets
    #[arg(help_heading = "Environments", long, value_name = "FOLDER", value_hint = ValueHint::DirPath)]
    assets: Option<PathBuf>,
    /// Keep compiled models in this folder [default: the environment variable ROBOHIVE_CACHE]
    #[arg(long, value_name = "FOLDER", value_hint = ValueHint::DirPath)]
    cache: Option<PathBuf>,
}

/// What is drawn; all that a picture shows is computed.
pub enum Subject {
    /// A model.
    Model(Box<Model>, Box<Data>),
    /// An environment.
    Env(Box<Env>),
}

impl Subject {
    /// The model.
    pub fn model(&self) -> &Model {
        match self {
            Subject::Model(model, _) => model,
            Subject::Env(env) => &env.scene().model,
        }
    }

    /// Its state.
    pub fn data(&self) -> &Data {
        match self {
            Subject::Model(_, data) => data,
            Subject::Env(env) => &env.scene().data,
        }
    }

    /// The camera that shows it where none is asked for.
    pub fn camera(&self) -> String {
        match self {
            Subject::Model(..) => FREE.to_owned(),
            Subject::Env(env) => camera_of(env),
        }
    }
}

/// The camera that every model has.
pub const FREE: &str = "free";

/// Whether two environments run one task on one model.
pub fn are_related(a: &Spec, b: &Spec) -> bool {
    let model = |spec: &Spec| spec.args.get::<String>("model_path");
    a.suite == b.suite && a.task == b.task && model(a) == model(b)
}

/// The camera that an environment observes first. An environment that observes none takes the camera of an id that runs
/// the same task on the same model, or the free camera.
pub fn camera_of(env: &Env) -> String {
    if let Some(key) = env.visual_keys().first() {
        return key.camera.clone();
    }
    let is_there = |camera: &String| env.scene().model.camera(camera).is_some();
    let related = Registry::builtin().specs().iter().filter(|spec| are_related(spec, env.spec()));
    related.filter_map(first_camera).find(is_there).unwrap_or_else(|| FREE.to_owned())
}

/// The camera that environments of this specification observe first.
fn first_camera(spec: &Spec) -> Option<String> {
    let key: VisualKey = spec.args.get::<Vec<String>>("visual_keys")?.first()?.parse().ok()?;
    Some(key.camera)
}

impl SubjectArguments {
    /// Loads the model or makes the environment, and brings it into the state that is asked for.
    pub fn find(&self) -> Result<Subject, Failure> {
        let known = Registry::builtin().spec(&self.name);
        match known {
            Ok(_) => self.environment(),
            Err(_) if self.name == STANDARD_INPUT || Path::new(&self.name).exists() => self.model(),
            Err(_) if own(Path::new(&self.name)).is_some() => self.model(),
            Err(error) => {
                Err(Failure::usage(format!("{} is neither a file nor an environment: {error}", self.name)))
            }
        }
    }

    fn environment(&self) -> Result<Subject, Failure> {
        let model_only = [
            ("--keyframe", self.keyframe.is_some()),
            ("--qpos", !self.qpos.is_empty()),
            ("--define", !self.defines.is_empty()),
        ];
        self.refuse(&model_only, "is for models, and", "is an environment, whose reset decides its state")?;
        let source = Source {
            id: self.name.clone(),
            making: Making {
                settings: self.settings.clone(),
                compat: self.compat.unwrap_or(Compat::Fixed),
                assets: self.assets.clone(),
                cache: self.cache.clone(),
                solver: Default::default(),
            },
        };
        let mut env = source.make()?;
        env.reset(Some(self.seed.unwrap_or(0))).map_err(Failure::new)?;
        Ok(Subject::Env(Box::new(env)))
    }

    fn model(&self) -> Result<Subject, Failure> {
        let environment_only = [
            ("--seed", self.seed.is_some()),
            ("--set", !self.settings.is_empty()),
            ("--compat", self.compat.is_some()),
            ("--assets", self.assets.is_some()),
        ];
        self.refuse(&environment_only, "is for environments, and", "is a model")?;
        let reading =
            Reading { defines: self.defines.clone(), cache: self.cache.clone(), memory: self.memory };
        let model = load(Path::new(&self.name), &reading)?;
        let mut data = start(&model, self.keyframe.as_deref())?;
        if !self.qpos.is_empty() {
            if self.qpos.len() != model.nq {
                let (found, nq) = (self.qpos.len(), model.nq);
                return Err(Failure::usage(format!("--qpos has {found} numbers, and the model has {nq}")));
            }
            data.state.qpos.copy_from_slice(&self.qpos);
        }
        forward(&model, &mut data).map_err(Failure::usage)?;
        Ok(Subject::Model(Box::new(model), Box::new(data)))
    }

    /// Refuses options that mean nothing for what is drawn.
    fn refuse(&self, options: &[(&str, bool)], before: &str, after: &str) -> Result<(), Failure> {
        match options.iter().find(|(_, given)| *given) {
            None => Ok(()),
            Some((option, _)) => Err(Failure::usage(format!("{option} {before} {} {after}", self.name))),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn visual_variants_name_a_camera_for_the_others() {
        let registry = Registry::builtin();
        let door = registry.spec("door-v1").ok().unwrap();
        assert_eq!(first_camera(door), None);
        let related: Vec<_> = registry.specs().iter().filter(|spec| are_related(spec, door)).collect();
        assert!(related.len() > 1 && related.iter().all(|spec| spec.id.starts_with("door")));
        assert_eq!(related.into_iter().find_map(first_camera).as_deref(), Some("vil_camera"));
    }
}
