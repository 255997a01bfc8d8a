//! Tasks by name, and how each is made from settings.

use crate::error::EnvError;
use crate::task::{Setup, Task};
use serde::de::DeserializeOwned;
use std::fmt;
use std::sync::Arc;
use toml::Table;

type Build = dyn Fn(Table, &mut Setup<'_>) -> Result<Box<dyn Task>, EnvError> + Send + Sync;

/// A kind of task: the name that specifications give it, and what makes one from the settings of an id.
#[derive(Clone)]
pub(crate) struct TaskType {
    name: String,
    build: Arc<Build>,
}

impl TaskType {
    /// A task of this name. Settings that `build` does not know are errors if their type denies unknown fields.
    pub(crate) fn new<S, T>(
        name: &str,
        build: impl Fn(S, &mut Setup<'_>) -> Result<T, EnvError> + Send + Sync + 'static,
    ) -> Self
    where
        S: DeserializeOwned,
        T: Task + 'static,
    {
        let boxed = move |own: Table, setup: &mut Setup<'_>| -> Result<Box<dyn Task>, EnvError> {
            let settings = setup.spec.task_args(own)?;
            Ok(Box::new(build(settings, setup)?))
        };
        TaskType { name: name.to_owned(), build: Arc::new(boxed) }
    }

    /// Its name.
    pub(crate) fn name(&self) -> &str {
        &self.name
    }

    /// The task with these settings, its own.
    ///
    /// # Errors
    /// A setting is unknown, missing or wrong; the world does not fit the task.
    pub(crate) fn build(&self, own: Table, setup: &mut Setup<'_>) -> Result<Box<dyn Task>, EnvError> {
        (self.build)(own, setup)
    }
}

impl fmt::Debug for TaskType {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_tuple("TaskType").field(&self.name).finish()
    }
}
