//! Shapes that plugins add.

use super::sink::{Form, Items, Source, unnamed};
use crate::RenderError;

/// Adds the marks of plugins, whatever else is shown: they come before everything else, as in MuJoCo.
///
/// # Errors
/// A mark has a shape that its size does not tell.
pub(super) fn of_plugins(from: Source<'_>, items: &mut Items<'_>) -> Result<(), RenderError> {
    for mark in from.appearance.marks() {
        let form = Form::primitive(mark.shape.code(), mark.size, mark.pos, &mark.mat).ok_or_else(|| {
            let message = format!(
                "a plugin adds a mark of shape {:?}: use a sphere, an ellipsoid, a capsule, a cylinder or a box",
                mark.shape
            );
            RenderError::Model { message }
        })?;
        items.decor(&form, mark.rgba, unnamed(mark.id));
    }
    Ok(())
}
