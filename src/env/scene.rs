//! The world that a task acts in: a model with this environment's edits, and its state.

use crate::error::EnvError;
use physics::elements::{ActuatorId, BodyId, GeomId, JointId, SensorId, SiteId};
use physics::model::Draft;
use physics::{Data, Engine, Model, Mover, StepError};
use robot::Compat;

/// A model and its state, owned by one environment.
#[derive(Clone, Debug)]
pub struct Scene {
    /// The compiled model; arrays that no environment has written are shared with every other environment.
    pub model: Model,
    /// Its state and what follows from it.
    pub data: Data,
    /// What moves it.
    pub mover: Mover,
}

impl Scene {
    /// A scene at the model's reference configuration, its derived quantities computed.
    ///
    /// # Errors
    /// The model has no state that physics accepts there.
    pub fn new(model: Model) -> Result<Self, EnvError> {
        Self::under(model, &Engine::default())
    }

    /// The same under another engine.
    ///
    /// # Errors
    /// As [`Scene::new`], and the first element that the engine does not simulate.
    pub fn under(model: Model, engine: &Engine) -> Result<Self, EnvError> {
        let mover = engine.start(&model).map_err(StepError::from)?;
        let data = Data::new(&model);
        let mut scene = Scene { model, data, mover };
        scene.forward()?;
        Ok(scene)
    }

    /// Returns the state to the model's reference configuration; whatever moves it forgets what it did.
    pub fn reset(&mut self) {
        self.data.reset(&self.model);
        self.mover.reset();
    }

    /// Recomputes all that follows from the state, after it or the model was written.
    ///
    /// # Errors
    /// The state is one that physics refuses.
    pub fn forward(&mut self) -> Result<(), StepError> {
        physics::forward(&self.model, &mut self.data)
    }

    /// Advances by `count` time steps in the order of RoboHive's simulation: the second half of the current step, whole
    /// steps, the first half of the next one; under another engine whole steps and that half. Positions and velocities then belong to the new state, forces to the state
    /// before it. `each` sees the state after every time step.
    ///
    /// # Errors
    /// Physics refuses a step; the state is the one that it refused.
    pub fn advance(&mut self, count: usize, mut each: impl FnMut(&Data)) -> Result<(), StepError> {
        let Scene { model, data, mover } = self;
        if let Some(stepper) = mover.foreign() {
            for _ in 0..count {
                stepper.step(model, data)?;
                each(data);
            }
            return physics::step1(model, data);
        }
        physics::step2(model, data)?;
        each(data);
        for _ in 1..count {
            physics::step(model, data)?;
            each(data);
        }
        physics::step1(model, data)
    }

    /// Advances by `count` whole time steps, and computes accelerations and forces of bodies from the last one.
    ///
    /// # Errors
    /// Physics refuses a step; the state is the one that it refused.
    pub fn advance_plainly(&mut self, count: usize, mut each: impl FnMut(&Data)) -> Result<(), StepError> {
        for _ in 0..count {
            self.mover.step(&self.model, &mut self.data)?;
            each(&self.data);
        }
        physics::derive_body_forces(&self.model, &mut self.data);
        Ok(())
    }

    /// [`Scene::forward`] right after [`Scene::advance`], which has done most of it.
    pub fn complete(&mut self) {
        physics::forward_after_step1(&self.model, &mut self.data);
    }

    /// Writes numbers of the model as they are; nothing is derived from them.
    ///
    /// # Errors
    /// A number that is NaN, or a reference that leads nowhere; the model is then as it was.
    pub fn overwrite(&mut self, change: impl FnOnce(&mut Draft<'_>)) -> Result<(), EnvError> {
        Ok(self.model.overwrite(change)?)
    }

    /// Writes numbers of the model. As the original does it, nothing is derived from them; otherwise everything is.
    ///
    /// # Errors
    /// The model cannot be what the numbers say.
    pub fn edit(&mut self, compat: Compat, change: impl FnOnce(&mut Draft<'_>)) -> Result<(), EnvError> {
        match compat {
            Compat::RoboHive07 => self.overwrite(change),
            Compat::Fixed => Ok(self.model.edit(change)?),
        }
    }

    /// A body by name.
    ///
    /// # Errors
    /// The model has none of that name.
    pub fn body(&self, name: &str) -> Result<BodyId, EnvError> {
        self.model
            .body(name)
            .ok_or_else(|| EnvError::missing("body", name, self.model.body_names().map(|(_, n)| n)))
    }

    /// A joint by name.
    ///
    /// # Errors
    /// The model has none of that name.
    pub fn joint(&self, name: &str) -> Result<JointId, EnvError> {
        self.model
            .joint(name)
            .ok_or_else(|| EnvError::missing("joint", name, self.model.joint_names().map(|(_, n)| n)))
    }

    /// A geom by name.
    ///
    /// # Errors
    /// The model has none of that name.
    pub fn geom(&self, name: &str) -> Result<GeomId, EnvError> {
        self.model
            .geom(name)
            .ok_or_else(|| EnvError::missing("geom", name, self.model.geom_names().map(|(_, n)| n)))
    }

    /// A site by name.
    ///
    /// # Errors
    /// The model has none of that name.
    pub fn site(&self, name: &str) -> Result<SiteId, EnvError> {
        self.model
            .site(name)
            .ok_or_else(|| EnvError::missing("site", name, self.model.site_names().map(|(_, n)| n)))
    }

    /// A sensor by name.
    ///
    /// # Errors
    /// The model has none of that name.
    pub fn sensor(&self, name: &str) -> Result<SensorId, EnvError> {
        self.model
            .sensor(name)
            .ok_or_else(|| EnvError::missing("sensor", name, self.model.sensor_names().map(|(_, n)| n)))
    }

    /// An actuator by name.
    ///
    /// # Errors
    /// The model has none of that name.
    pub fn actuator(&self, name: &str) -> Result<ActuatorId, EnvError> {
        self.model
            .actuator(name)
            .ok_or_else(|| EnvError::missing("actuator", name, self.model.actuator_names().map(|(_, n)| n)))
    }
}
