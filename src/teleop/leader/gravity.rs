//! Gravity compensation of a leader arm: the currents of its servos.

use super::config::GravitySettings;
use crate::error::TeleopError;
use physics::model::{SensorType, TrnType};
use physics::{Data, Model};
use robot::{ActuatorConfig, Config};

/// A motor of the compensation.
#[derive(Clone, Copy, Debug)]
struct Motor {
    /// Index of its joint in `qvel`.
    velocity: usize,
    /// Current for a torque on the joint \[A/(N m)\].
    factor: f64,
}

/// Gravity compensation of an arm from its model: the torques that hold it at rest in its present pose.
pub struct Gravity {
    model: Model,
    data: Data,
    /// Indices in `qpos` of the sensors' joints; `None` for sensors of velocity.
    positions: Vec<Option<usize>>,
    motors: Vec<Motor>,
    largest: f64,
}

impl Gravity {
    /// Compensation of the weight of `model` by the actuators of `config`, all of which must be commanded by current.
    ///
    /// # Errors
    /// A sensor or an actuator that the model does not have on a single hinge or slide, or an actuator not commanded by current.
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

    /// Currents of the motors \[A\] for these readings of the sensors, each limited to the largest current.
    ///
    /// # Errors
    /// The physics of the model fails at this pose.
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

/// Index in `qpos` of a sensor's joint.
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
        return Err(format!(
            "the actuator '{name}' must be commanded by current: give it mode = \"current\""
        ));
    }
    if actuator.scale == 0.0 {
        return Err(format!("the scale of the actuator '{name}' must not be 0"));
    }
    let velocity = model.jnt_dofadr[joint] as usize;
    Ok(Motor { velocity, factor: settings.share / (settings.torque_constant * actuator.scale) })
}

fn unfit(message: String) -> TeleopError {
    TeleopError::Control { message: format!("gravity compensation of the leader: {message}") }
}
