//! What a robot remembers between steps, and copies of robots.

use crate::delay::Delay;
use crate::error::RobotError;
use crate::keeper::Keeper;
use crate::links::Links;
use crate::reading::{History, Readings};
use crate::robot::Robot;

/// The last controls and readings: all that a simulated robot carries from one step to the next.
#[derive(Clone, Debug)]
pub struct Memory {
    controls: Vec<f64>,
    history: History,
    delay: Option<Delay>,
}

impl Memory {
    /// Writes it, or reads it into the memory of a robot of the same config and options.
    pub fn keep(&mut self, keeper: &mut Keeper) {
        keeper.numbers(&mut self.controls);
        self.history.keep(keeper);
        if let Some(delay) = &mut self.delay {
            delay.keep(keeper);
        }
    }
}

impl Robot {
    /// What it remembers.
    pub fn memory(&self) -> Memory {
        Memory { controls: self.controls.clone(), history: self.history.clone(), delay: self.delay.clone() }
    }

    /// Returns to what it, or another robot of the same config and options, remembered.
    pub fn restore(&mut self, memory: &Memory) {
        self.controls.clone_from(&memory.controls);
        self.history.clone_from(&memory.history);
        self.delay.clone_from(&memory.delay);
    }

    /// Records controls, in the units of the actuators and without limits, as the last step's.
    ///
    /// # Errors
    /// Not one number for each control.
    pub fn set_control(&mut self, controls: &[f64]) -> Result<&[f64], RobotError> {
        self.check_length(controls)?;
        self.controls.copy_from_slice(controls);
        Ok(&self.controls)
    }

    /// Another robot over simulated devices of its own, which remembers the same.
    ///
    /// # Errors
    /// Hardware, which is there only once.
    pub fn fork(&self) -> Result<Robot, RobotError> {
        if self.options.hardware {
            let reason = "a robot over hardware cannot be copied".to_owned();
            return Err(RobotError::Option { name: "hardware", reason });
        }
        Ok(Robot {
            links: Links::simulated(&self.binding, self.raw.values.len()),
            binding: self.binding.clone(),
            options: self.options.clone(),
            actions: self.actions.clone(),
            default: self.default,
            controls: self.controls.clone(),
            raw: Readings::new(self.raw.values.len(), self.binding.devices.len()),
            history: self.history.clone(),
            delay: self.delay.clone(),
        })
    }
}
