//! Drivers against simulated devices, in virtual time.

use crate::failure::Failure;
use crate::input::library::Making;
use env::{Env, Options};
use library::{Rehearsal, RehearsalError};
use robot::Config;

/// The simulated devices of `config` on the model of an environment.
pub fn rehearsal(config: &Config, env: &mut Env) -> Result<Rehearsal, Failure> {
    Rehearsal::new(config, env).map_err(|error| match error {
        RehearsalError::Start(_) | RehearsalError::Physics(_) => Failure::new(error),
        RehearsalError::Devices(_) => Failure::usage(error),
    })
}

/// The environment of an id, simulated, whose model the devices move.
pub fn simulated(id: &str, making: &Making) -> Result<Env, Failure> {
    let options: Options = making.options()?;
    Env::make(id, &making.assets()?, &options).map_err(Failure::usage)
}
