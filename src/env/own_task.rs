//! Tasks that a program brings itself.

use crate::arguments::Arguments;
use crate::error::EnvError;
use crate::task::{Setup, Task};
use std::fmt;
use std::sync::Arc;

type Build = dyn Fn(&Arguments, &mut Setup<'_>) -> Result<Box<dyn Task>, EnvError> + Send + Sync;

/// How a task is built from its own settings.
#[derive(Clone)]
pub(crate) struct OwnTask(Arc<Build>);

impl OwnTask {
    pub(crate) fn new(
        build: impl Fn(&Arguments, &mut Setup<'_>) -> Result<Box<dyn Task>, EnvError> + Send + Sync + 'static,
    ) -> Self {
        OwnTask(Arc::new(build))
    }

    pub(crate) fn build(&self, own: &Arguments, setup: &mut Setup<'_>) -> Result<Box<dyn Task>, EnvError> {
        (self.0)(own, setup)
    }
}

impl fmt::Debug for OwnTask {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("OwnTask")
    }
}
