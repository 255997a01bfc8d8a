//! Vectors of sensors and actuators in the model's order and units, and in the hardware's.

use crate::binding::{Actuator, Binding, Sensor};
use crate::compat::Compat;
use crate::config::HardwareId;
use crate::error::{Part, RobotError};
use crate::robot::Robot;

/// Order and units of a vector.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Space {
    /// The model's: actuators by place in `ctrl`, sensors by place in `sensordata`.
    Simulation,
    /// The hardware's: one number for each entry of the config, in its order; under [`Compat::RoboHive07`] at the index
    /// `hdr_id` of a vector of the model's length.
    Hardware,
}

/// An entry of the config: where its number stands in each space, and what converts it.
struct Entry<'a> {
    name: &'a str,
    simulation: usize,
    hardware: &'a HardwareId,
    scale: f64,
    offset: f64,
}

impl Robot {
    /// A vector of sensors or actuators of one space in the other. What the config does not list is 0, under
    /// [`Compat::RoboHive07`] as it was at its place.
    ///
    /// # Errors
    /// Equal spaces, vectors of another length; `hdr_id`s that are no place in the vector, under
    /// [`Compat::RoboHive07`].
    pub fn remap(&self, vector: &[f64], part: Part, from: Space, to: Space) -> Result<Vec<f64>, RobotError> {
        if from == to {
            return Err(RobotError::SameSpace);
        }
        let entries = self.entries(part);
        let model_length = self.binding.length(part);
        let ordered = self.options.compat == Compat::Fixed;
        let hardware_length = if ordered { entries.len() } else { model_length };
        let lengths = match from {
            Space::Simulation => [model_length, hardware_length],
            Space::Hardware => [hardware_length, model_length],
        };
        if vector.len() != lengths[0] {
            let what = "a vector of this space";
            return Err(RobotError::Length { what, given: vector.len(), expected: lengths[0] });
        }
        let mut out = if ordered { vec![0.0; lengths[1]] } else { vector.to_vec() };
        for (place, entry) in entries.iter().enumerate() {
            let index = if ordered { Some(place) } else { python_index(entry.hardware, hardware_length) };
            let hardware = index.ok_or_else(|| RobotError::HardwareIndex {
                name: entry.name.to_owned(),
                length: hardware_length,
            })?;
            let (read, written) = match from {
                Space::Simulation => (entry.simulation, hardware),
                Space::Hardware => (hardware, entry.simulation),
            };
            // Factors of sensors convert from hardware to model, factors of actuators from model to hardware.
            let forward = (part == Part::Sensor) == (from == Space::Hardware);
            out[written] = if forward {
                vector[read] * entry.scale + entry.offset
            } else {
                (vector[read] - entry.offset) / entry.scale
            };
        }
        Ok(out)
    }

    fn entries(&self, part: Part) -> Vec<Entry<'_>> {
        let Binding { sensors, actuators, .. } = &self.binding;
        match part {
            Part::Sensor => sensors
                .iter()
                .map(|Sensor { config: c, source, .. }| Entry {
                    name: &c.name,
                    simulation: *source,
                    hardware: &c.hardware,
                    scale: c.scale,
                    offset: c.offset,
                })
                .collect(),
            Part::Actuator => actuators
                .iter()
                .map(|Actuator { config: c, control, .. }| Entry {
                    name: &c.name,
                    simulation: *control,
                    hardware: &c.hardware,
                    scale: c.scale,
                    offset: c.offset,
                })
                .collect(),
        }
    }
}

/// A place in a vector of `length` numbers as Python takes it: from the end where it is negative.
fn python_index(id: &HardwareId, length: usize) -> Option<usize> {
    let HardwareId::Number(number) = *id else { return None };
    let from_start = if number < 0 { number.checked_add(length as i64)? } else { number };
    usize::try_from(from_start).ok().filter(|&index| index < length)
}
