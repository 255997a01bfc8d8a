//! The robot and its surroundings, which the devices of a bench move and measure.

use physics::model::{ConstraintType, SensorType, TrnType};
use physics::{Data, Model, StepError};
use std::fmt;

/// What a device makes of one motor.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Drive {
    /// The actuator as the model has it, with this control: for a position servo the target \[rad, m\].
    Control(f64),
    /// No torque; the joint turns freely.
    #[default]
    Off,
    /// This velocity \[rad/s, m/s\], held with the damping that the model's servo has.
    Velocity(f64),
    /// This torque or force \[N m, N\], within the actuator's range of forces.
    Effort(f64),
}

/// Gains of an actuator: `[gain, constant bias, bias of length, bias of velocity]`.
type Gains = [f64; 4];

/// An actuator of the model, on one joint.
#[derive(Clone, Copy, Debug)]
struct Motor {
    control: usize,
    joint: usize,
    position: usize,
    velocity: usize,
    own: Gains,
    limited: bool,
    set: Gains,
}

/// A plant cannot be made of a model.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PlantError(String);

impl PlantError {
    /// An error that says this.
    pub(crate) fn new(message: impl Into<String>) -> PlantError {
        PlantError(message.into())
    }
}

impl fmt::Display for PlantError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

impl std::error::Error for PlantError {}

/// A model in motion. What it is told stays until it is told otherwise.
pub struct Plant {
    model: Model,
    data: Data,
    motors: Vec<Option<Motor>>,
    /// Time steps since it was made or set.
    steps: u64,
    begun: f64,
    fault: Option<StepError>,
    held: bool,
}

impl Plant {
    /// A model at its reference configuration, or its first key.
    ///
    /// # Errors
    /// The state is one that physics refuses.
    pub fn new(model: Model) -> Result<Plant, StepError> {
        let mut data = Data::new(&model);
        physics::forward(&model, &mut data)?;
        let motors = (0..model.nactuator).map(|id| motor(&model, id)).collect();
        Ok(Plant { model, data, motors, steps: 0, begun: 0.0, fault: None, held: false })
    }

    /// The model; gains of its actuators change with what devices make of them.
    pub fn model(&self) -> &Model {
        &self.model
    }

    /// The state.
    pub fn data(&self) -> &Data {
        &self.data
    }

    /// The number of an actuator that moves one joint.
    ///
    /// # Errors
    /// The model has none of that name, or it moves something else.
    pub fn motor(&self, actuator: &str) -> Result<usize, PlantError> {
        let Some(id) = self.model.actuator(actuator) else {
            let nearest = physics::model::Suggestions::default()
                .nearest(actuator, self.model.actuator_names().map(|(_, name)| name));
            let hint = nearest.map_or_else(String::new, |name| format!("; did you mean '{name}'?"));
            return Err(PlantError(format!("the model has no actuator '{actuator}'{hint}")));
        };
        let id = id.index();
        match self.motors[id] {
            Some(_) => Ok(id),
            None => {
                Err(PlantError(format!("the actuator '{actuator}' does not move a single hinge or slide")))
            }
        }
    }

    /// Where `qpos` has the hinge or slide whose position a sensor reads.
    ///
    /// # Errors
    /// The model has no sensor of that name, or it reads something else.
    pub(crate) fn joint_of_sensor(&self, sensor: &str) -> Result<usize, PlantError> {
        let Some(id) = self.model.sensor(sensor) else {
            return Err(PlantError(format!("the model has no sensor '{sensor}'")));
        };
        if self.model.sensor_type[id] != SensorType::Jointpos as i32 {
            return Err(PlantError(format!("the sensor '{sensor}' does not read the position of a joint")));
        }
        let joint = self.model.sensor_objid[id].max(0) as usize;
        Ok(self.model.jnt_qposadr[joint] as usize)
    }

    /// Where `qpos` has the free joint of the body whose position or orientation a sensor reads; a component in brackets may
    /// follow the sensor's name. `None` for other sensors.
    pub(crate) fn free_joint(&self, sensor: &str) -> Option<usize> {
        let name = sensor.split_once('[').map_or(sensor, |(name, _)| name);
        robot::free_joint(&self.model, name)
    }

    /// Drives a motor, from the next time step on.
    pub fn drive(&mut self, motor: usize, drive: Drive) {
        let Some(Some(state)) = self.motors.get_mut(motor) else { return };
        let Motor { own, .. } = *state;
        let (gains, control) = match drive {
            Drive::Control(control) => (own, control),
            Drive::Off => ([0.0; 4], 0.0),
            Drive::Velocity(velocity) => {
                // A servo without damping of its own gets a tenth of its stiffness.
                let damping = if own[3] < 0.0 { -own[3] } else { 0.1 * own[0].abs() };
                ([damping, 0.0, 0.0, -damping], velocity)
            }
            Drive::Effort(effort) => ([1.0, 0.0, 0.0, 0.0], effort),
        };
        self.data.state.ctrl[state.control] = control;
        if gains == state.set {
            return;
        }
        state.set = gains;
        let limited = state.limited && gains == own;
        let written = self.model.overwrite(|draft| {
            draft.actuator_gainprm[motor][0] = gains[0];
            draft.actuator_biasprm[motor][..3].copy_from_slice(&gains[1..]);
            draft.actuator_ctrllimited[motor] = limited;
        });
        debug_assert!(written.is_ok(), "gains are finite");
    }

    /// Positions in which the joints of these actuators are within their ranges: as they are, or in the middle.
    ///
    /// # Errors
    /// Actuators that the model does not have.
    pub(crate) fn within<'a>(
        &self,
        actuators: impl Iterator<Item = &'a robot::ActuatorConfig>,
    ) -> Result<Vec<f64>, PlantError> {
        let mut qpos = self.data.state.qpos.to_vec();
        for actuator in actuators {
            let Some(motor) = self.motors[self.motor(&actuator.name)?] else { continue };
            let [low, high] = actuator.position_range;
            if !(low..=high).contains(&qpos[motor.position]) {
                qpos[motor.position] = (low + high) / 2.0;
            }
        }
        Ok(qpos)
    }

    /// Position of a motor's joint \[rad, m\].
    pub fn position(&self, motor: usize) -> f64 {
        self.motors[motor].map_or(0.0, |motor| self.data.state.qpos[motor.position])
    }

    /// Velocity of a motor's joint \[rad/s, m/s\].
    pub fn velocity(&self, motor: usize) -> f64 {
        self.motors[motor].map_or(0.0, |motor| self.data.state.qvel[motor.velocity])
    }

    /// Torque or force of a motor in the last time step \[N m, N\].
    pub fn effort(&self, motor: usize) -> f64 {
        self.data.actuation.actuator_force[motor]
    }

    /// Torque or force that gravity and motion ask of a motor's joint to leave its velocity as it is, \[N m, N\].
    pub fn bias(&self, motor: usize) -> f64 {
        self.motors[motor].map_or(0.0, |motor| self.data.vel.qfrc_bias[motor.velocity])
    }

    /// Torque or force that the surroundings exert on a motor's joint by contacts \[N m, N\].
    pub fn external(&self, motor: usize) -> f64 {
        let Some(Motor { velocity, joint, .. }) = self.motors[motor] else { return 0.0 };
        let efc = &self.data.efc;
        // Friction and the joint's own limit are constraints too, but the joint's own.
        let own = |row: usize| {
            let (kind, id) = (efc.efc_type[row], efc.efc_id[row] as usize);
            if kind == ConstraintType::FrictionDof as i32 && id == velocity {
                efc.efc_force[row]
            } else if kind == ConstraintType::LimitJoint as i32 && id == joint {
                let [low, high] = self.model.jnt_range[joint];
                let upper = self.position(motor) > (low + high) / 2.0;
                if upper { -efc.efc_force[row] } else { efc.efc_force[row] }
            } else {
                0.0
            }
        };
        self.data.acc.qfrc_constraint[velocity] - (0..efc.nefc).map(own).sum::<f64>()
    }

    /// Seconds that it has moved.
    pub fn time(&self) -> f64 {
        self.begun + self.steps as f64 * self.model.opt.timestep
    }

    /// When the next time step ends.
    pub fn next(&self) -> f64 {
        self.begun + (self.steps + 1) as f64 * self.model.opt.timestep
    }

    /// One time step. Physics that fails stops the plant, see [`Plant::fault`].
    pub fn step(&mut self) {
        self.steps += 1;
        if self.fault.is_none() && !self.held {
            self.fault = physics::step(&self.model, &mut self.data).err();
        }
    }

    /// Holds everything where it is while time goes on, as people do with what they put in place; or lets go.
    pub fn set_held(&mut self, held: bool) {
        self.held = held;
    }

    /// Why physics refused to go on.
    pub fn fault(&self) -> Option<&StepError> {
        self.fault.as_ref()
    }

    /// Puts joints of motors at these positions, at rest, as a hand that holds them would; all else stays.
    ///
    /// # Errors
    /// The state is one that physics refuses.
    pub fn hold(&mut self, places: &[(usize, f64)]) -> Result<(), StepError> {
        for (motor, position) in places {
            let Some(Some(motor)) = self.motors.get(*motor) else { continue };
            self.data.state.qpos[motor.position] = *position;
            self.data.state.qvel[motor.velocity] = 0.0;
        }
        physics::forward(&self.model, &mut self.data)
    }

    /// Puts robot and surroundings somewhere else, as a person would between two episodes; controls stay.
    ///
    /// # Errors
    /// The state is one that physics refuses.
    pub fn place(&mut self, qpos: &[f64], qvel: &[f64]) -> Result<(), StepError> {
        let controls = self.data.state.ctrl.to_vec();
        self.data.reset(&self.model);
        self.data.state.qpos.copy_from_slice(qpos);
        self.data.state.qvel.copy_from_slice(qvel);
        self.data.state.ctrl.copy_from_slice(&controls);
        self.fault = None;
        physics::forward(&self.model, &mut self.data)
    }
}

/// The motor of an actuator; `None` unless it moves one hinge or slide.
fn motor(model: &Model, id: usize) -> Option<Motor> {
    let joint = model.actuator_trnid[id][0];
    let on_joint = model.actuator_trntype[id] == TrnType::Joint as i32 && model.actuator_ctrlnum[id] == 1;
    let joint = usize::try_from(joint).ok().filter(|_| on_joint)?;
    let bias = &model.actuator_biasprm[id];
    let own = [model.actuator_gainprm[id][0], bias[0], bias[1], bias[2]];
    Some(Motor {
        control: model.actuator_ctrladr[id] as usize,
        joint,
        position: model.jnt_qposadr[joint] as usize,
        velocity: model.jnt_dofadr[joint] as usize,
        own,
        limited: model.actuator_ctrllimited[id],
        set: own,
    })
}
