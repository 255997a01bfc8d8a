//! The roles of a task's body.

use crate::error::ControlError;
use env::{Env, Spec};
use robot::Roles;
use std::collections::BTreeMap;

/// A setting of the arm of a task, in the table `arm` or by itself.
pub(crate) fn of_arm(spec: &Spec, setting: &str) -> Option<String> {
    let arm = spec.args.get::<BTreeMap<String, String>>("arm");
    arm.and_then(|mut arm| arm.remove(setting)).or_else(|| spec.args.get(setting))
}

/// Roles that the row of a task names, or those of the robot in whose folder its model is.
pub(crate) fn roles(spec: &Spec) -> Result<Roles, String> {
    let beside = || {
        let model: String = spec.args.get("model_path")?;
        let robot = model.strip_prefix("hive/")?.split('/').next()?;
        Some(format!("hive/{robot}/roles.toml"))
    };
    let path = of_arm(spec, "roles").or_else(beside).ok_or("the setting roles is needed")?;
    let text = path.strip_prefix("hive/").and_then(assets::text);
    let text = text.ok_or_else(|| {
        format!("{path} is none of our own models' files (hive/...), whose roles controllers read")
    })?;
    Roles::from_toml(text, &path).map_err(|error| error.to_string())
}

/// Roles of the robot of an environment.
///
/// # Errors
/// A task without roles, or a file that is none of roles.
pub(crate) fn roles_of(env: &Env) -> Result<Roles, ControlError> {
    roles(env.spec()).map_err(|message| ControlError::unfit(env, message))
}
