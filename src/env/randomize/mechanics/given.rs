//! Statistics of a model that its file gives, beside those that follow from the rest.

use crate::error::EnvError;
use crate::scene::Scene;
use physics::Model;
use physics::model::{EditError, Statistic};

/// Which statistics a file gives: those that differ from the computed ones.
#[derive(Clone)]
pub(crate) struct Given {
    stated: Statistic,
    computed: Statistic,
}

impl Given {
    /// Of a model as it was made.
    pub(crate) fn of(model: &Model) -> Result<Self, EditError> {
        Ok(Given { stated: model.stat.clone(), computed: model.computed_statistic()? })
    }

    /// Lets the others follow from the model as it is now: tasks write poses from which nothing is derived, and an edit
    /// would take the old statistics for given ones.
    ///
    /// # Errors
    /// The model cannot be what its numbers say.
    pub(crate) fn settle(&self, scene: &mut Scene) -> Result<(), EnvError> {
        let (stated, before) = (&self.stated, &self.computed);
        let mut stat = scene.model.computed_statistic()?;
        let keep = |stated: f64, before: f64, now: &mut f64| {
            if stated != before {
                *now = stated;
            }
        };
        keep(stated.meaninertia, before.meaninertia, &mut stat.meaninertia);
        keep(stated.meanmass, before.meanmass, &mut stat.meanmass);
        keep(stated.meansize, before.meansize, &mut stat.meansize);
        keep(stated.extent, before.extent, &mut stat.extent);
        if stated.center != before.center {
            stat.center = stated.center;
        }
        scene.overwrite(|m| *m.stat = stat)
    }
}
