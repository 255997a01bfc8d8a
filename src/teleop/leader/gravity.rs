//! Currents by which the servos of a leader arm carry its weight.

use super::config::GravitySettings;
use crate::error::TeleopError;
use physics::model::{SensorType, TrnType};
use physics::{Data, Model};
use robot::{ActuatorConfig, Config};

/// What a motor carries.
#[derive(Clone, Copy, Debug)]
struct Motor {
    /// Place of its joint in `qvel`.
    velocity: usize,
    /// Current for a torque on the joint \[A/(N m)\].
    factor: f64,
}

/// The weight of an arm, as its model has it: the torques that hold it where it is, at rest.
pub struct Gravity {
    model: Model,
    data: Data,
    /// Places in `qpos` of what the sensors read; none for velocities.
    positions: Vec<Option<usize>>,
    motors: Vec<Motor>,
    largest: f64,
}

impl Gravity {
    /// The weight of `model`, carried by the actuators of `config`, all of which take currents.
    ///
    /// # Errors
    /// A sensor or an actuator that the model does not have on a single hinge or slide, or one that takes no currents.
    pub fn new(model: Model, config: &Config, settings: &GravitySettings) -> Result<Self, TeleopError> {
        let sensors = config.devices.iter().flat_map(|device| &device.sensors);
        let positions = sensors.map(|sensor| position(&model, &sensor.name));
        let actuators = config.devices.iter().flat_map(|device| &device.actuators);
        let motors = actuators.map(|actuator| motor(&model, actuator, settings));
        let positions = positions.collect::<Result<_, _>>().map_err(unfit)?;
        let motors = motors.collect::<Result<_, _>>().map_err(unfit)?;
        let data = Data::new(&model);
        Ok(Gravity { model, data, positions, motors, largest: settings.current })
    }

    /// Currents \[A\] of the motors where the sensors read this, each within the largest.
    ///
    /// # Errors
    /// Physics refuses the pose.
    pub fn currents(&mut self, readings: impl Iterator<Item = f64>) -> Result<Vec<f64>, TeleopError> {
        for (position, reading) in self.positions.iter().zip(readings) {
            if let Some(position) = position {
                self.data.state.qpos[*position] = reading;
            }
        }
        physics::forward(&self.model, &mut self.data).map_err(|error| unfit(error.to_string()))?;
        let Data { vel, passive, .. } = &self.data;
        let carried = |motor: &Motor| vel.qfrc_bias[motor.velocity] - passive.qfrc_gravcomp[motor.velocity];
        let current = |motor: &Motor| (carried(motor) * motor.factor).clamp(-self.largest, self.largest);
        Ok(self.motors.iter().map(current).collect())
    }
}

/// Where `qpos` has what a sensor reads.
fn position(model: &Model, sensor: &str) -> Result<Option<usize>, String> {
    let id =
        model.sensor(sensor).ok_or_else(|| format!("the leader's model has no sensor '{sensor}'"))?.index();
    let joint = usize::try_from(model.sensor_objid[id]).ok();
    let reads = |kind: SensorType| model.sensor_type[id] == kind as i32;
    match joint {
        Some(joint) if reads(SensorType::Jointpos) => Ok(Some(model.jnt_qposadr[joint] as usize)),
        Some(_) if reads(SensorType::Jointvel) => Ok(None),
        _ => Err(format!("the sensor '{sensor}' of the leader's model reads no joint")),
    }
}

fn motor(model: &Model, actuator: &ActuatorConfig, settings: &GravitySettings) -> Result<Motor, String> {
    let name = &actuator.name;
    let id =
        model.actuator(name).ok_or_else(|| format!("the leader's model has no actuator '{name}'"))?.index();
    let on_joint = matches!(TrnType::from_code(model.actuator_trntype[id]), Some(TrnType::Joint));
    let joint = usize::try_from(model.actuator_trnid[id][0]).ok().filter(|_| on_joint);
    let joint = joint.ok_or_else(|| format!("the actuator '{name}' of the leader's model moves no joint"))?;
    if !matches!(actuator.mode.as_deref(), Some("current" | "torque")) {
        return Err(format!("the actuator '{name}' carries weight by currents: give it mode = \"current\""));
    }
    if actuator.scale == 0.0 {
        return Err(format!("the scale of the actuator '{name}' is 0"));
    }
    let velocity = model.jnt_dofadr[joint] as usize;
    Ok(Motor { velocity, factor: settings.share / (settings.torque_constant * actuator.scale) })
}

fn unfit(message: String) -> TeleopError {
    TeleopError::Control { message: format!("the leader's weight: {message}") }
}
