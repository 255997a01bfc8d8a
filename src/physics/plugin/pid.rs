//! `mujoco.pid`: a PID controller of the length of its actuator. The integral and the set point before, which bounds the
//! rate of the next, are activations.

use crate::actuation::activation::next_activation;
use crate::actuation::setpoint::activations;
use crate::math::clip;
use crate::model::{ActuatorInputs, AttributeError, Capability, Config, DynType, Instance, Model, Plugin};

/// The plugin.
#[derive(Debug)]
pub(super) struct Pid;

impl Plugin for Pid {
    fn name(&self) -> &str {
        "mujoco.pid"
    }

    fn attributes(&self) -> &[&str] {
        &["kp", "ki", "kd", "imax", "slewmax"]
    }

    fn capabilities(&self) -> &[Capability] {
        &[Capability::Actuator]
    }

    fn instance(&self, config: &Config, m: &Model, id: usize) -> Result<Box<dyn Instance>, AttributeError> {
        let gain = |name| config.number(name).map(Option::unwrap_or_default);
        let integral = gain("ki")?;
        // The bound of the integral is the quotient: with a negative gain it is positive where 'imax' is negative.
        let most = config.number("imax")?;
        if most.is_some_and(|force| force < 0.0) && integral >= 0.0 {
            return Err("attribute 'imax' is negative: set it to 0 or more".into());
        }
        let controller = Controller {
            proportional: gain("kp")?,
            integral,
            derivative: gain("kd")?,
            bound: most.filter(|_| integral != 0.0).map(|force| force / integral),
            slew: config.number("slewmax")?,
            actuators: (0..m.nactuator).filter(|&i| m.actuator_plugin[i] == id as i32).collect(),
        };
        controller.check(m)?;
        Ok(Box::new(controller))
    }
}

/// An instance with its actuators.
#[derive(Debug)]
struct Controller {
    proportional: f64,
    integral: f64,
    derivative: f64,
    /// Of the integral of the error, either way.
    bound: Option<f64>,
    /// Rate of the set point.
    slew: Option<f64>,
    actuators: Vec<usize>,
}

/// The activations of one actuator that belong to the controller.
#[derive(Default)]
struct Memory {
    integral: f64,
    setpoint: Option<f64>,
}

impl Controller {
    fn check(&self, m: &Model) -> Result<(), AttributeError> {
        if self.bound.is_some_and(|bound| bound < 0.0) {
            return Err("attribute 'imax' has the sign of a negative bound: set it to 0 or more".into());
        }
        if self.slew.is_some_and(|slew| slew < 0.0) {
            return Err("attribute 'slewmax' is negative: set it to 0 or more".into());
        }
        if self.actuators.is_empty() {
            return Err("no actuator uses the instance: remove it, or name it in one".into());
        }
        let own = i32::from(self.integral != 0.0) + i32::from(self.slew.is_some());
        for &i in &self.actuators {
            let filtered = matches!(
                DynType::from_code(m.actuator_dyntype[i]),
                Some(DynType::Filter | DynType::Filterexact | DynType::Integrator)
            );
            let (found, wanted) = (m.actuator_actnum[i], own + i32::from(filtered));
            if found != wanted {
                return Err(format!(
                    "actuator {i} has {found} activations where {wanted} are needed: set actdim=\"{wanted}\""
                )
                .into());
            }
        }
        Ok(())
    }

    fn memory(&self, inputs: &ActuatorInputs, i: usize) -> Memory {
        let mut slots = activations(inputs.m, i).map(|k| inputs.state.act[k]);
        let mut memory = Memory::default();
        if self.integral != 0.0 {
            memory.integral = slots.next().unwrap_or_default();
        }
        if self.slew.is_some() {
            memory.setpoint = slots.next().filter(|_| inputs.state.time > 0.0);
        }
        memory
    }

    /// The control or activation that the length is to follow; with `early`, the activation after the step.
    fn setpoint(&self, inputs: &ActuatorInputs, i: usize, memory: &Memory, early: Option<&[f64]>) -> f64 {
        let ActuatorInputs { m, state, .. } = *inputs;
        let target = match activations(m, i).last() {
            Some(last) if m.actuator_dyntype[i] != DynType::None.code() => match early {
                Some(act_dot) => next_activation(m, i, last, &state.act, act_dot[last], 0.0),
                None => state.act[last],
            },
            _ => {
                let k = m.actuator_ctrladr[i] as usize;
                if m.actuator_ctrllimited[k] {
                    clip(state.ctrl[k], m.actuator_ctrlrange[k])
                } else {
                    state.ctrl[k]
                }
            }
        };
        match (self.slew, memory.setpoint) {
            (Some(slew), Some(before)) => {
                let reach = slew * m.opt.timestep;
                clip(target, [before - reach, before + reach])
            }
            _ => target,
        }
    }

    fn next_integral(&self, memory: &Memory, error: f64, timestep: f64) -> f64 {
        let sum = memory.integral + error * timestep;
        self.bound.map_or(sum, |bound| clip(sum, [-bound, bound]))
    }
}

impl Instance for Controller {
    fn activation_rates(&self, inputs: &ActuatorInputs, act_dot: &mut [f64]) {
        let timestep = inputs.m.opt.timestep;
        for &i in &self.actuators {
            let memory = self.memory(inputs, i);
            let setpoint = self.setpoint(inputs, i, &memory, None);
            let error = setpoint - inputs.trn.actuator_length[inputs.m.actuator_outadr[i] as usize];
            let mut slots = activations(inputs.m, i);
            if self.integral != 0.0
                && let Some(slot) = slots.next()
            {
                let next = self.next_integral(&memory, error, timestep);
                act_dot[slot] = (next - inputs.state.act[slot]) / timestep;
            }
            if self.slew.is_some()
                && let Some(slot) = slots.next()
            {
                act_dot[slot] = (setpoint - inputs.state.act[slot]) / timestep;
            }
        }
    }

    fn forces(&self, inputs: &ActuatorInputs, act_dot: &[f64], force: &mut [f64]) {
        let m = inputs.m;
        for &i in &self.actuators {
            let memory = self.memory(inputs, i);
            let early = m.actuator_actearly[i].then_some(act_dot);
            let out = m.actuator_outadr[i] as usize;
            let error = self.setpoint(inputs, i, &memory, early) - inputs.trn.actuator_length[out];
            let rate = match activations(m, i).last() {
                Some(last) if m.actuator_dyntype[i] != DynType::None.code() => act_dot[last],
                _ => 0.0,
            };
            let slip = rate - inputs.vel.actuator_velocity[out];
            let integral = match self.integral {
                0.0 => 0.0,
                _ => self.next_integral(&memory, error, m.opt.timestep),
            };
            force[out] = self.proportional * error + self.derivative * slip + self.integral * integral;
        }
    }
}
