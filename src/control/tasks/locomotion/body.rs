//! The body of a task, by its roles.

use crate::error::ControlError;
use crate::tasks::roles::{roles, roles_of};
use env::{Env, Spec};
use physics::elements::{BodyId, SiteId};
use physics::math::Vec3;
use robot::Walk;

/// A body with feet, as its roles describe it.
pub struct Body {
    /// Body whose pose and velocity tasks read.
    pub root: BodyId,
    /// Sites at the soles.
    pub feet: Vec<SiteId>,
    /// Positions of all joints when it stands (nq).
    pub stand: Vec<f64>,
    /// How fast it walks.
    pub walk: Walk,
    /// Direction that it looks in, in the frame of the root.
    pub forward: Vec3,
}

/// Number of feet of the body of a task, if its row names roles; 0 for one that has none.
pub fn feet(spec: &Spec) -> Option<usize> {
    Some(roles(spec).ok()?.feet.map_or(0, |feet| feet.names.len()))
}

impl Body {
    /// The body of a task whose elements have names that begin with `prefix`, for the controller called `name`, which is for
    /// bodies with `count` feet.
    ///
    /// # Errors
    /// A task without roles, a model that does not fill them, another number of feet.
    pub fn new(env: &Env, prefix: &str, name: &str, count: usize) -> Result<Self, ControlError> {
        let m = &env.scene().model;
        let roles = roles_of(env)?;
        let unfit = |error: robot::ConfigError| ControlError::unfit(env, error.to_string());
        let body = roles.cast(m, prefix, name);
        let feet = body.feet().map_err(unfit)?;
        if feet.len() != count {
            let message = format!("{name} is for bodies with {count} feet, not {}", feet.len());
            return Err(ControlError::unfit(env, message));
        }
        let mut stand = m.qpos0.to_vec();
        body.pose("stand", &mut stand).map_err(unfit)?;
        Ok(Body {
            root: body.root().map_err(unfit)?,
            feet,
            stand,
            walk: body.walk().map_err(unfit)?,
            forward: body.forward(),
        })
    }
}
