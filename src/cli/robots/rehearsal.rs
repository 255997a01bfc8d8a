//! Drivers against simulated devices, in virtual time.

use crate::failure::Failure;
use ::hardware::{Clocks, Services, Setup, TendedClock};
use env::{Env, Options};
use protocol::Port;
use robot::{Clock, Config};
use std::io;
use std::sync::{Arc, Mutex, PoisonError};
use wire::{Plant, Rigged, Shared, VirtualClock, VirtualPort};

/// Simulated devices of a robot's config, and what drivers need to find them.
pub struct Rehearsal {
    bench: Shared,
    services: Services,
    rigged: Arc<Vec<Rigged>>,
}

impl Rehearsal {
    /// The devices of `config` on the model of an environment.
    pub fn new(config: &Config, env: &Env) -> Result<Rehearsal, Failure> {
        let plant = Plant::new(env.scene().model.clone()).map_err(Failure::new)?;
        let (bench, rigged) = wire::rig(config, plant, false).map_err(Failure::usage)?;
        Ok(Rehearsal {
            bench: Arc::new(Mutex::new(bench)),
            services: Services::default(),
            rigged: Arc::new(rigged),
        })
    }

    /// `setup` with the simulated devices in place of real ones.
    pub fn setup(&self, setup: Setup) -> Setup {
        let (bench, rigged) = (self.bench.clone(), self.rigged.clone());
        let open = move |address: &str, _: u32| -> io::Result<Box<dyn Port>> {
            let found = rigged.iter().find(|device| device.address == address);
            let device = found.ok_or_else(|| {
                io::Error::new(io::ErrorKind::NotFound, format!("no simulated device is at {address}"))
            })?;
            bench.lock().unwrap_or_else(PoisonError::into_inner).set_connected(device.link, true);
            Ok(Box::new(VirtualPort::new(bench.clone(), device.link)))
        };
        let bench = self.bench.clone();
        let clocks: Clocks = Arc::new(move || Box::new(VirtualClock::new(bench.clone())));
        setup.in_virtual_time(clocks, self.services.clone(), Arc::new(open))
    }

    /// A clock that lets the simulated time pass.
    pub fn clock(&self) -> Box<dyn Clock + Send> {
        Box::new(TendedClock::new(VirtualClock::new(self.bench.clone()), self.services.clone()))
    }

    /// Another that does.
    pub fn clocks(&self) -> Arc<dyn Fn() -> Box<dyn Clock + Send> + Send + Sync> {
        let (bench, services) = (self.bench.clone(), self.services.clone());
        Arc::new(move || Box::new(TendedClock::new(VirtualClock::new(bench.clone()), services.clone())))
    }

    /// The person who puts everything where an episode begins.
    pub fn person(&self) -> env::Ready {
        let bench = self.bench.clone();
        Arc::new(move |qpos| {
            let mut bench = bench.lock().unwrap_or_else(PoisonError::into_inner);
            let rest = vec![0.0; bench.plant().data().state.qvel.len()];
            Ok(bench.plant_mut().place(qpos, &rest)?)
        })
    }
}

/// The environment of an id, simulated, whose model the devices move.
pub fn simulated(id: &str, making: &crate::input::library::Making) -> Result<Env, Failure> {
    let options: Options = making.options()?;
    Env::make(id, &making.assets()?, &options).map_err(Failure::usage)
}
