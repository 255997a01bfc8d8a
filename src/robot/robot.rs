//! A robot: actions in, controls out; sensors in, readings out.

use crate::action::{self, Actions};
use crate::binding::{Binding, Group, Sensor, Target};
use crate::config::Config;
use crate::delay::Delay;
use crate::device::Registry;
use crate::error::RobotError;
use crate::interval::clip;
use crate::links::Links;
use crate::options::{Noise, Options};
use crate::reading::{History, Readings};
use physics::{Data, Model};
use random::{BitGenerator, Generator};

/// Readings that are kept for history or delay.
const MAX_STEPS: usize = 1 << 16;

/// Devices that act on a model and sense it, or hardware that the model mirrors.
///
/// Control and sensing allocate nothing after the first reading.
pub struct Robot {
    pub(crate) binding: Binding,
    pub(crate) options: Options,
    pub(crate) actions: Actions,
    /// No config: the whole state is read, every actuator commanded.
    pub(crate) default: bool,
    pub(crate) links: Links,
    pub(crate) controls: Vec<f64>,
    /// What the devices say, before clipping, noise and delay.
    pub(crate) raw: Readings,
    pub(crate) history: History,
    pub(crate) delay: Option<Delay>,
}

impl Robot {
    /// A robot over simulated devices. Without config it has one device, `default_robot`, which reads the whole state and
    /// commands every actuator.
    ///
    /// # Errors
    /// Names that the model does not have, elements and modes that a robot cannot use, options that make no sense, and
    /// [`Options::hardware`], which needs [`Robot::with_devices`].
    pub fn new(model: &Model, config: Option<&Config>, options: Options) -> Result<Robot, RobotError> {
        Robot::with_devices(model, config, options, &Registry::default())
    }

    /// A robot over the devices of `registry` when [`Options::hardware`] is set, over simulated ones otherwise. The
    /// devices are connected. Devices of the config without sensors and actuators (cameras) are not.
    ///
    /// # Errors
    /// As [`Robot::new`]; interfaces that nothing drives; devices that cannot be connected.
    pub fn with_devices(
        model: &Model,
        config: Option<&Config>,
        options: Options,
        registry: &Registry,
    ) -> Result<Robot, RobotError> {
        check(&options)?;
        let binding = match config {
            Some(config) => Binding::new(model, config, options.compat)?,
            None => Binding::of_everything(model),
        };
        let width = if config.is_some() { binding.sensors.len() } else { model.nq + model.nv + model.na };
        let actions = Actions::new(model, &binding, config.is_none(), &options)?;
        let late = options.delay_steps + options.jitter_steps > 0 && !options.hardware;
        Ok(Robot {
            links: Links::new(&binding, width, config, &options, registry)?,
            default: config.is_none(),
            controls: vec![0.0; model.nu],
            raw: Readings::new(width, binding.devices.len()),
            history: History::new(options.history, width, binding.devices.len()),
            delay: late.then(|| Delay::new(options.delay_steps, options.jitter_steps, width)),
            actions,
            options,
            binding,
        })
    }

    /// Numbers in an action, one for each control of the model.
    pub fn action_len(&self) -> usize {
        self.controls.len()
    }

    /// How it acts and senses.
    pub fn options(&self) -> &Options {
        &self.options
    }

    /// Names of its devices, in the order of the config.
    pub fn devices(&self) -> impl Iterator<Item = &str> {
        self.binding.devices.iter().map(|device| device.name.as_str())
    }

    /// Names of its sensors, in the order of the values of [`Readings`]; none without a config.
    pub fn sensors(&self) -> impl Iterator<Item = &str> {
        self.binding.sensors.iter().map(|sensor| sensor.config.name.as_str())
    }

    /// Turns a policy's action into controls: units, limits of velocity, position and effort, of the joints as `data` has
    /// them, for the next `duration` seconds. Sends them to the devices.
    ///
    /// # Errors
    /// Actions of another length or that are no finite numbers, bad periods; devices that failed, in this call or in a
    /// [`Robot::sense`] before it.
    pub fn control(
        &mut self,
        model: &Model,
        data: &Data,
        action: &[f64],
        duration: f64,
    ) -> Result<&[f64], RobotError> {
        self.links.last_fault()?;
        action::check(model, action, duration)?;
        self.actions.control((model, &self.binding), data, (action, duration), &mut self.controls);
        self.links.apply(&self.binding, data.state.time, &self.controls)?;
        Ok(&self.controls)
    }

    /// What [`Robot::control`] would send and return, without sending anything.
    ///
    /// # Errors
    /// Those of the action.
    pub fn plan(
        &mut self,
        model: &Model,
        data: &Data,
        action: &[f64],
        duration: f64,
    ) -> Result<Vec<f64>, RobotError> {
        action::check(model, action, duration)?;
        let mut controls = self.controls.clone();
        self.actions.control((model, &self.binding), data, (action, duration), &mut controls);
        Ok(controls)
    }

    /// Sends the controls of the last [`Robot::control`] once more, so that the watchdog of a device hears a command.
    ///
    /// # Errors
    /// A device that failed, or refuses them.
    pub fn repeat(&mut self, time: f64) -> Result<(), RobotError> {
        self.links.last_fault()?;
        self.links.apply(&self.binding, time, &self.controls)
    }

    /// The controls of the last [`Robot::control`]; zeros before the first.
    pub fn last_control(&self) -> &[f64] {
        &self.controls
    }

    /// Reads every sensor, of simulated devices from `truth`, which must be the result of a forward pass: delayed,
    /// clipped to its range, with noise from `rng`, one draw for each sensor in the order of the config.
    ///
    /// A device that fails keeps its last values and time stamp; [`Robot::fault`] tells, and the next
    /// [`Robot::control`] refuses.
    pub fn sense<B: BitGenerator>(
        &mut self,
        model: &Model,
        truth: &Data,
        rng: &mut Generator<B>,
    ) -> &Readings {
        self.measure(truth);
        let readings = self.history.advance();
        readings.copy_from(&self.raw);
        if let Some(delay) = &mut self.delay {
            let jitter = match delay.jitter() {
                0 => 0,
                most => rng.integer(0..=most as u64).map_or(0, |jitter| jitter as usize),
            };
            delay.record(self.raw.time, &self.raw.values);
            readings.time = delay.deliver(model.opt.timestep, jitter, &mut readings.values);
            readings.stamps.fill(readings.time);
        }
        if !self.options.hardware {
            let scale = self.options.noise_scale;
            for (value, sensor) in readings.values.iter_mut().zip(&self.binding.sensors) {
                *value = clip(*value, sensor.config.range);
                if scale != 0.0 {
                    *value += scale * sensor.config.noise * draw(self.options.noise, rng);
                }
            }
        }
        readings
    }

    /// Lets delayed sensors see a state between two control periods; called after every time step, delays are exact to
    /// the step, otherwise to the control period. Without delays it does nothing.
    pub fn track(&mut self, truth: &Data) {
        if self.delay.is_some() {
            self.measure(truth);
        }
        if let Some(delay) = &mut self.delay {
            delay.record(self.raw.time, &self.raw.values);
        }
    }

    /// [`Robot::track`] has something to do.
    pub fn tracks_steps(&self) -> bool {
        self.delay.is_some()
    }

    /// Changes how old readings are, up to the [`Options::delay_steps`] that the robot was made with; nothing where it was made
    /// without a delay.
    pub fn set_delay_steps(&mut self, steps: usize) {
        if let Some(delay) = &mut self.delay {
            delay.set_steps(steps);
        }
    }

    /// Begins an episode at the state of `truth`, after a forward pass: devices move to its positions, and all readings
    /// of the history are of this state. Of simulated devices they are drawn one after the other, as RoboHive draws
    /// them.
    ///
    /// # Errors
    /// Devices that fail.
    pub fn reset<B: BitGenerator>(
        &mut self,
        model: &Model,
        truth: &Data,
        rng: &mut Generator<B>,
    ) -> Result<&Readings, RobotError> {
        self.links.forget_fault();
        self.links.reset(&self.binding, &truth.state.qpos)?;
        if let Some(delay) = &mut self.delay {
            delay.clear();
        }
        let readings = if self.options.hardware { 1 } else { self.history.length() };
        for _ in 0..readings {
            self.sense(model, truth, rng);
        }
        if self.options.hardware {
            self.history.repeat_newest();
        }
        self.links.last_fault()?;
        Ok(self.history.newest())
    }

    /// Informs the devices that a person has moved the measured objects, after a reset.
    ///
    /// # Errors
    /// Devices that fail.
    pub fn moved(&mut self) -> Result<(), RobotError> {
        self.links.moved(&self.binding)
    }

    /// The newest readings.
    pub fn readings(&self) -> &Readings {
        self.history.newest()
    }

    /// The readings of `age` readings ago, 0 for the newest; `None` beyond [`Options::history`].
    pub fn past(&self, age: usize) -> Option<&Readings> {
        self.history.past(age)
    }

    /// Values of one device in `readings`.
    pub fn values_of<'r>(&self, device: &str, readings: &'r Readings) -> Option<&'r [f64]> {
        let group = self.binding.devices.iter().find(|group| group.name == device)?;
        readings.values.get(group.sensors.clone())
    }

    /// How a device failed since the last reset.
    pub fn fault(&self) -> Option<&RobotError> {
        self.links.fault()
    }

    /// Writes the newest readings, and their time, into the state of `observed`; tells whether anything differed from
    /// what stood there. What follows from the state needs a forward pass then.
    pub fn write_readings(&self, observed: &mut Data) -> bool {
        let readings = self.history.newest();
        let state = &mut observed.state;
        let mut changed = write(&mut state.time, readings.time);
        if self.default {
            let places = state.qpos.iter_mut().chain(&mut state.qvel).chain(&mut state.act);
            for (place, value) in places.zip(&readings.values) {
                changed |= write(place, *value);
            }
        }
        for (sensor, value) in self.binding.sensors.iter().zip(&readings.values) {
            changed |= match sensor.target {
                Target::Position(address) => write(&mut state.qpos[address], *value),
                Target::Velocity(address) => write(&mut state.qvel[address], *value),
            };
        }
        changed
    }

    /// Clips a wanted pose to what the devices can have: to the ranges of a device's actuators, or of its sensors if it has no
    /// actuators.
    pub fn clip_reset(&self, qpos: &mut [f64], qvel: &mut [f64]) {
        for Group { sensors, actuators, .. } in &self.binding.devices {
            for actuator in &self.binding.actuators[actuators.clone()] {
                let position = &mut qpos[actuator.position];
                *position = clip(*position, actuator.position_range());
            }
            let passive = if actuators.is_empty() && !self.default { sensors.clone() } else { 0..0 };
            for sensor in &self.binding.sensors[passive] {
                let value = match sensor.target {
                    Target::Position(address) => &mut qpos[address],
                    Target::Velocity(address) => &mut qvel[address],
                };
                *value = clip(*value, sensor.config.range);
            }
        }
    }

    /// Ends the connections to the devices; the robot cannot be used after it.
    ///
    /// # Errors
    /// The first device that fails; the others are closed all the same.
    pub fn close(mut self) -> Result<(), RobotError> {
        self.links.close(&self.binding)
    }

    /// Fills `raw` with what the devices say.
    fn measure(&mut self, truth: &Data) {
        let values = &mut self.raw.values;
        if self.default {
            let state = truth.state.qpos.iter().chain(&truth.state.qvel).chain(&truth.state.act);
            values.iter_mut().zip(state).for_each(|(value, state)| *value = *state);
        } else {
            // Entries that the hardware lacks keep their simulated values.
            let simulated = |sensor: &Sensor| !self.options.hardware || !sensor.on_hardware;
            let all = values.iter_mut().zip(&self.binding.sensors);
            for (value, sensor) in all.filter(|(_, sensor)| simulated(sensor)) {
                *value = truth.sensor.sensordata[sensor.source];
            }
        }
        self.links.read(&self.binding, truth.state.time, &mut self.raw);
    }
}

impl Robot {
    /// Turns controls with units into -1 to 1, in place: of the config's actuators by the range of the action mode, clipped.
    ///
    /// # Errors
    /// Not one number for each control.
    pub fn normalize(&self, model: &Model, controls: &mut [f64]) -> Result<(), RobotError> {
        self.check_length(controls)?;
        self.actions.normalize(model, &self.binding, controls);
        Ok(())
    }

    /// Turns actions from -1 to 1, clipped for the config's actuators, into controls with units, in place.
    ///
    /// # Errors
    /// Not one number for each control.
    pub fn unnormalize(&self, model: &Model, actions: &mut [f64]) -> Result<(), RobotError> {
        self.check_length(actions)?;
        self.actions.unnormalize(model, &self.binding, actions);
        Ok(())
    }

    pub(crate) fn check_length(&self, vector: &[f64]) -> Result<(), RobotError> {
        let (given, expected) = (vector.len(), self.action_len());
        if given == expected {
            Ok(())
        } else {
            Err(RobotError::Length { what: "an action", given, expected })
        }
    }
}

/// Writes `value`; tells whether its bits differ from those that stood there.
fn write(place: &mut f64, value: f64) -> bool {
    let differs = place.to_bits() != value.to_bits();
    *place = value;
    differs
}

/// A number of the noise's distribution.
fn draw<B: BitGenerator>(noise: Noise, rng: &mut Generator<B>) -> f64 {
    match noise {
        // The interval has a length, so the draw cannot fail.
        Noise::Uniform => rng.uniform(-1.0, 1.0).unwrap_or_default(),
        Noise::Gaussian => rng.standard_normal(),
    }
}

fn check(options: &Options) -> Result<(), RobotError> {
    let wrong = |name, reason: &str| Err(RobotError::Option { name, reason: reason.to_owned() });
    if !(options.noise_scale >= 0.0 && options.noise_scale.is_finite()) {
        return wrong("noise_scale", "it must be 0 or a positive number");
    }
    if options.history == 0 {
        return wrong("history", "at least the newest reading is kept");
    }
    for (name, steps) in [
        ("history", options.history),
        ("delay_steps", options.delay_steps),
        ("jitter_steps", options.jitter_steps),
    ] {
        if steps > MAX_STEPS {
            return wrong(name, "more than 65536 are not kept");
        }
    }
    Ok(())
}
