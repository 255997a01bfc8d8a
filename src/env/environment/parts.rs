//! The parts that an environment is made of: model, robot, initial pose.

use super::hardware::Hardware;
use crate::assets::{AssetError, Assets, foreign_model, own_file, own_model};
use crate::error::EnvError;
use crate::scene::Scene;
use crate::spec::{Settings, Spec};
use crate::task::Pose;
use mjcf::Loaded;
use physics::Model;
use physics::model::{JointType, TrnType};
use robot::{Compat, Config, ConfigError, Robot};

/// Loads the model with the replacements and moves that the settings ask for.
pub(crate) fn load(spec: &Spec, settings: &Settings, assets: &dyn Assets) -> Result<Loaded, EnvError> {
    let path = &settings.model_path;
    let missing = |hint: AssetError| EnvError::MissingFile {
        id: spec.id.clone(),
        path: path.clone(),
        hint: hint.to_string(),
    };
    let (mut loader, file) = own_model(path)
        .or_else(|| foreign_model(path))
        .unwrap_or_else(|| assets.model(path))
        .map_err(missing)?;
    for [from, to] in &settings.define {
        loader = loader.define(from, to);
    }
    for [body, parent] in &settings.reparent {
        loader = loader.reparent(body, parent);
    }
    let wrong = |diagnostics| EnvError::Model {
        path: file.display().to_string(),
        diagnostics: Box::new(diagnostics),
    };
    loader.load(&file).map_err(wrong)
}

/// Reads the robot's configuration, where the settings name one.
pub(crate) fn read_config(
    spec: &Spec,
    settings: &Settings,
    assets: &dyn Assets,
) -> Result<Option<Config>, EnvError> {
    let Some(path) = &settings.config_path else { return Ok(None) };
    let missing = |hint: AssetError| EnvError::MissingFile {
        id: spec.id.clone(),
        path: path.clone(),
        hint: hint.to_string(),
    };
    let bytes = own_file(path).map_or_else(|| assets.read(path), Ok).map_err(missing)?;
    Ok(Some(parse_config(&String::from_utf8_lossy(&bytes), path)?))
}

/// Finds what the robot's configuration names in the model.
pub(crate) fn build_robot(
    spec: &Spec,
    settings: &Settings,
    config: Option<&Config>,
    model: &Model,
    compat: Compat,
    hardware: Option<&Hardware>,
) -> Result<Robot, EnvError> {
    let oldest_reading =
        settings.physics_randomization.as_ref().map_or(0, |physics| physics.oldest_reading());
    let options = robot::Options::default()
        .with_mode(settings.action_mode().map_err(|message| spec.wrong(message))?)
        .with_normalized(settings.normalize_act)
        .with_noise_scale(settings.noise_scale)
        .with_compat(compat)
        .with_delay_steps(oldest_reading)
        .with_hardware(hardware.is_some());
    Ok(match hardware {
        Some(hardware) => Robot::with_devices(model, config, options, &hardware.registry)?,
        None => Robot::new(model, config, options)?,
    })
}

/// The reference configuration; where actions are normalised, every hinge and slide that an actuator moves is in the
/// middle of its range.
pub(crate) fn initial_pose(scene: &Scene, normalized: bool) -> Pose {
    let m = &scene.model;
    let mut pose = Pose { qpos: scene.data.state.qpos.clone(), qvel: scene.data.state.qvel.clone() };
    if normalized {
        for actuator in 0..m.nactuator {
            let joint = m.actuator_trnid[actuator][0];
            if m.actuator_trntype[actuator] != TrnType::Joint as i32 || joint < 0 {
                continue;
            }
            let joint = joint as usize;
            let kind = m.jnt_type[joint];
            if kind == JointType::Hinge as i32 || kind == JointType::Slide as i32 {
                let [low, high] = m.jnt_range[joint];
                pose.qpos[m.jnt_qposadr[joint] as usize] = (low + high) / 2.0;
            }
        }
    }
    pose
}

/// Reads TOML from files of that extension, and RoboHive's literals from all others.
fn parse_config(text: &str, path: &str) -> Result<Config, ConfigError> {
    if path.ends_with(".toml") { Config::from_toml(text, path) } else { Config::from_literal(text, path) }
}

/// What an action may be, of one actuator.
pub(crate) fn action_bounds(scene: &Scene, normalized: bool, k: usize) -> [f64; 2] {
    if normalized { [-1.0, 1.0] } else { scene.model.actuator_ctrlrange[k] }
}
