//! What the settings of a task name.

use crate::error::ControlError;
use env::Env;
use physics::elements::SiteId;

/// The site that a setting names.
///
/// # Errors
/// The task has no such setting, or the model no such site.
pub fn site(env: &Env, setting: &str) -> Result<SiteId, ControlError> {
    let named = env.spec().args.get::<String>(setting);
    let named = named.ok_or_else(|| ControlError::unfit(env, format!("the setting {setting} is needed")))?;
    Ok(env.scene().site(&named)?)
}
