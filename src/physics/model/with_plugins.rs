//! A compiled model, and the plugins at work in it. They stand in one file because they name each other: a model keeps
//! instances of plugins, and an instance computes from the model.

use super::appearance::Appearance;
use super::distance_field::Field;
use super::plugin_config::{AttributeError, Config};
use super::plugin_error::RegistryError;
use crate::arrays::{Arrays, ObjType, Options, Stage, Visual};
use crate::caches::Caches;
use crate::caches::bending_factor::BendingFactor;
use crate::caches::climb::Slopes;
use crate::caches::origin::Origin;
use crate::stages::{
    AccelerationInputs, Configuration, Contacts, PositionInputs, State, Transmission, Velocity,
    VelocityInputs,
};
use std::fmt::Debug;
use std::ops::Deref;
use std::sync::Arc;

/// A compiled model: constant while a simulation runs, shared by any number of [`Data`](crate::Data).
///
/// All its numbers are read through [`Arrays`], to which a model dereferences: `m.nq`, `m.body_mass`. They are changed
/// with [`Model::edit`] and [`Model::overwrite`], options also with [`Model::options_mut`]. Clones share every array and
/// cache; an array becomes a model's own when it is first written.
#[derive(Clone, Debug, Default)]
pub struct Model {
    pub(crate) arrays: Arrays,
    pub(crate) caches: Caches,
    pub(crate) plugins: Instances,
}

impl Deref for Model {
    type Target = Arrays;

    fn deref(&self) -> &Arrays {
        &self.arrays
    }
}

impl Model {
    /// A model of arrays that nobody has checked: for the compiler, which makes consistent ones, and for tests of
    /// single stages. Functions of this crate panic where arrays contradict each other.
    #[doc(hidden)]
    pub fn unchecked(arrays: Arrays) -> Self {
        Model { arrays, ..Model::default() }
    }

    /// The arrays to write, without the checks and the derived quantities of an edit, as for [`Model::unchecked`].
    #[doc(hidden)]
    pub fn unchecked_mut(&mut self) -> &mut Arrays {
        self.caches = Caches::default();
        &mut self.arrays
    }

    /// Index of the element of one kind called `name`, by a hash table.
    pub fn id_of(&self, kind: ObjType, name: &str) -> Option<usize> {
        self.caches.names.get(self, kind, name)
    }

    /// What ids found in the model, and data made for it, are marked with.
    pub(crate) fn origin(&self) -> Origin {
        #[cfg(debug_assertions)]
        return *self.caches.origin.get_or_init(|| Origin::of(&self.arrays));
        #[cfg(not(debug_assertions))]
        Origin::default()
    }

    /// The arrays to write what is derived from others; caches stay.
    pub(crate) fn derived_mut(&mut self) -> &mut Arrays {
        &mut self.arrays
    }

    /// The options, to change. Nothing in the model is derived from them.
    pub fn options_mut(&mut self) -> &mut Options {
        &mut self.arrays.opt
    }

    /// The visualisation options, to change. Nothing in the model is derived from them, and no motion depends on them.
    pub fn visual_mut(&mut self) -> &mut Visual {
        &mut self.arrays.vis
    }

    /// The plugins that [`Arrays::plugin`] counts.
    pub fn registry(&self) -> &Registry {
        self.plugins.registry()
    }

    /// The plugins at work.
    pub(crate) fn plugins(&self) -> &Instances {
        &self.plugins
    }

    /// Hulls in the layout that collision climbs.
    pub(crate) fn slopes(&self) -> &Slopes {
        self.caches.slopes.get_or_init(|| Slopes::new(&self.arrays))
    }

    /// The constant factor of inertia and bending, by vertices.
    pub(crate) fn bending_factor(&self) -> &BendingFactor {
        self.caches.bending.get_or_init(|| BendingFactor::new(&self.arrays))
    }

    /// Drops what was made of the factor before it changed.
    pub(crate) fn forget_bending_factor(&mut self) {
        self.caches.bending = Arc::default();
    }
}

/// What a plugin can be asked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Capability {
    /// Forces of actuators.
    Actuator,
    /// Readings of sensors.
    Sensor,
    /// Passive forces.
    Passive,
    /// Signed distances of geoms.
    Sdf,
}

/// A kind of plugin.
pub trait Plugin: Debug + Send + Sync {
    /// Its name, which models use; distinct from all others.
    fn name(&self) -> &str;

    /// Names of the attributes that an instance may set; a model that sets another is refused.
    fn attributes(&self) -> &[&str];

    /// What it can be asked for; a model that asks for something else is refused.
    fn capabilities(&self) -> &[Capability];

    /// When its sensors can be read: after positions, velocities or accelerations.
    fn stage(&self) -> Stage {
        Stage::Acc
    }

    /// How many numbers an instance keeps in [`State::plugin_state`](crate::data::State::plugin_state).
    ///
    /// # Errors
    /// What is wrong with the attributes.
    fn states(&self, _config: &Config) -> Result<usize, AttributeError> {
        Ok(0)
    }

    /// How many numbers a sensor of an instance reads.
    ///
    /// # Errors
    /// What is wrong with the attributes.
    fn readings(&self, _config: &Config) -> Result<usize, AttributeError> {
        Ok(0)
    }

    /// The field of an instance with capability [`Sdf`](Capability::Sdf), in its own frame \[m\].
    ///
    /// # Errors
    /// What is wrong with the attributes.
    fn field(&self, _config: &Config) -> Result<Option<Box<dyn Field>>, AttributeError> {
        Ok(None)
    }

    /// Makes instance `id` of a compiled model.
    ///
    /// # Errors
    /// What is wrong with the attributes, or with the elements that use the instance.
    fn instance(&self, config: &Config, m: &Model, id: usize) -> Result<Box<dyn Instance>, AttributeError>;
}

/// What a passive force may depend on.
#[derive(Clone, Copy, Debug)]
pub struct PassiveInputs<'a> {
    /// The model.
    pub m: &'a Model,
    /// State, poses, centres of mass and tendon paths.
    pub at: Configuration<'a>,
    /// Contacts.
    pub con: &'a Contacts,
    /// Velocities of tendons, actuators and bodies.
    pub vel: &'a Velocity,
}

/// What the force of an actuator may depend on.
#[derive(Clone, Copy, Debug)]
pub struct ActuatorInputs<'a> {
    /// The model.
    pub m: &'a Model,
    /// State and controls, which are neither delayed nor limited to their ranges.
    pub state: &'a State,
    /// Lengths and moment arms.
    pub trn: &'a Transmission,
    /// Velocities of actuators.
    pub vel: &'a Velocity,
}

/// What a sensor may read, by the stage of its plugin.
#[derive(Clone, Copy, Debug)]
pub enum SensorInputs<'a> {
    /// All that depends on positions.
    Position(&'a PositionInputs<'a>),
    /// All that depends on positions and velocities.
    Velocity(&'a VelocityInputs<'a>),
    /// All that a step computes.
    Acceleration(&'a AccelerationInputs<'a>),
}

/// What a picture may depend on.
#[derive(Clone, Copy, Debug)]
pub struct AppearanceInputs<'a> {
    /// The model.
    pub m: &'a Model,
    /// State, poses, contacts and forces.
    pub at: AccelerationInputs<'a>,
    /// Readings of all sensors.
    pub readings: &'a [f64],
}

/// A plugin at work in one model. It may keep what follows from the model, and nothing that a step changes.
pub trait Instance: Debug + Send + Sync {
    /// Sets the state of the instance, which is zero, at a reset of the simulation.
    fn reset(&self, _m: &Model, _state: &mut [f64]) {}

    /// Adds its forces to `qfrc`, one number a degree of freedom \[N, N m\].
    fn passive(&self, _inputs: &PassiveInputs, _qfrc: &mut [f64]) {}

    /// Sets the rates of the activations of its actuators in `act_dot`, which already holds the rates of built-in dynamics.
    fn activation_rates(&self, _inputs: &ActuatorInputs, _act_dot: &mut [f64]) {}

    /// Sets the forces of its actuators in `force`, one number an output, before ranges limit them \[N, N m\].
    fn forces(&self, _inputs: &ActuatorInputs, _act_dot: &[f64], _force: &mut [f64]) {}

    /// Reads sensor `sensor` of the model into `out`, which is zero.
    fn read(&self, _m: &Model, _inputs: &SensorInputs, _sensor: usize, _out: &mut [f64]) {}

    /// Moves the state of the instance, `own`, over a time step. The rest of the state is that after the step, without
    /// `plugin_state`.
    fn advance(&self, _m: &Model, _state: &State, _own: &mut [f64]) {}

    /// Changes how the state looks: colours of geoms, and shapes beside them. Called whenever a scene is put together, whatever
    /// the plugin can be asked for.
    fn appearance(&self, _inputs: &AppearanceInputs, _out: &mut Appearance) {}

    /// Its signed distance field.
    fn field(&self) -> Option<&dyn Field> {
        None
    }
}

/// Plugins by name. The numbers in [`Arrays::plugin`] are places in it; the default has MuJoCo's own.
#[derive(Clone, Debug)]
pub struct Registry {
    plugins: Arc<Vec<Arc<dyn Plugin>>>,
}

impl Registry {
    /// These plugins, by place.
    pub(crate) fn of(plugins: Vec<Arc<dyn Plugin>>) -> Self {
        Registry { plugins: Arc::new(plugins) }
    }

    /// Adds a plugin.
    ///
    /// # Errors
    /// Its name is taken, or its declaration makes no sense.
    pub fn register(&mut self, plugin: impl Plugin + 'static) -> Result<(), RegistryError> {
        let name = plugin.name().to_owned();
        if self.slot(&name).is_some() {
            return Err(RegistryError::Taken(name));
        }
        if name.is_empty() || name.contains('\0') || plugin.attributes().iter().any(|a| a.contains('\0')) {
            return Err(RegistryError::Name(name));
        }
        if plugin.capabilities().contains(&Capability::Sensor) && plugin.stage() == Stage::None {
            return Err(RegistryError::Stage(name));
        }
        Arc::make_mut(&mut self.plugins).push(Arc::new(plugin));
        Ok(())
    }

    /// The place of the plugin called `name`.
    pub fn slot(&self, name: &str) -> Option<usize> {
        self.plugins.iter().position(|p| p.name() == name)
    }

    /// The plugin at a place.
    pub fn get(&self, slot: usize) -> Option<&Arc<dyn Plugin>> {
        self.plugins.get(slot)
    }

    /// The names of all plugins.
    pub fn names(&self) -> impl Iterator<Item = &str> {
        self.plugins.iter().map(|p| p.name())
    }
}

/// The plugins of a model at work, one an instance.
#[derive(Clone, Debug)]
pub(crate) struct Instances {
    registry: Registry,
    list: Arc<Vec<Running>>,
}

impl Default for Instances {
    /// None, of no plugins.
    fn default() -> Self {
        Instances::of(Registry::of(Vec::new()), Vec::new())
    }
}

/// An instance, its kind, and where its state is.
#[derive(Debug)]
pub(crate) struct Running {
    pub kind: Arc<dyn Plugin>,
    pub instance: Box<dyn Instance>,
    pub state: std::ops::Range<usize>,
}

impl Running {
    /// Whether it can be asked for `capability`.
    pub fn can(&self, capability: Capability) -> bool {
        self.kind.capabilities().contains(&capability)
    }
}

impl Instances {
    /// Instances of the plugins in `registry`.
    pub fn of(registry: Registry, list: Vec<Running>) -> Self {
        Instances { registry, list: Arc::new(list) }
    }

    /// The plugins that slots count.
    pub fn registry(&self) -> &Registry {
        &self.registry
    }

    /// Names of the kinds of all instances.
    pub fn names(&self) -> impl Iterator<Item = &str> {
        self.list.iter().map(|running| running.kind.name())
    }

    /// The instances with a capability, with their numbers.
    pub fn with(&self, capability: Capability) -> impl Iterator<Item = (usize, &Running)> {
        self.list.iter().enumerate().filter(move |(_, running)| running.can(capability))
    }

    /// All instances.
    pub fn all(&self) -> &[Running] {
        &self.list
    }

    /// Instance `id`.
    pub fn get(&self, id: i32) -> Option<&Running> {
        self.list.get(usize::try_from(id).ok()?)
    }
}
