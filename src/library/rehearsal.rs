//! Robots that are hardware, and their rehearsal: the same drivers against simulated devices, in virtual time.

use env::{Hardware, Ready};
use hardware::{Clocks, Services, Setup, TendedClock, registry};
use physics::{Model, StepError};
use protocol::Port;
use robot::{Clock, Config, WallClock};
use std::fmt;
use std::io;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use wire::{Bench, Plant, PlantError, Rigged, Shared, VirtualClock, VirtualPort};

/// Simulated devices of a robot's config, and what drivers need to find them.
#[derive(Clone)]
pub struct Rehearsal {
    bench: Shared,
    services: Services,
    rigged: Arc<Vec<Rigged>>,
}

/// Why there is no rehearsal.
#[derive(Clone, Debug)]
pub enum RehearsalError {
    /// Physics refuses the state of the model.
    Physics(StepError),
    /// The config and the model do not fit, or nothing of the config can be simulated.
    Devices(PlantError),
}

impl fmt::Display for RehearsalError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            RehearsalError::Physics(error) => error.fmt(f),
            RehearsalError::Devices(error) => error.fmt(f),
        }
    }
}

impl std::error::Error for RehearsalError {}

impl Rehearsal {
    /// The devices of `config` on a model, which they move.
    ///
    /// # Errors
    /// The model's state is one that physics refuses; the config names what the model does not have.
    pub fn new(config: &Config, model: Model) -> Result<Rehearsal, RehearsalError> {
        let plant = Plant::new(model).map_err(RehearsalError::Physics)?;
        let (bench, rigged) = wire::rig(config, plant, false).map_err(RehearsalError::Devices)?;
        Ok(Rehearsal {
            bench: Arc::new(Mutex::new(bench)),
            services: Services::default(),
            rigged: Arc::new(rigged),
        })
    }

    /// The simulated devices and what they move.
    pub fn bench(&self) -> MutexGuard<'_, Bench> {
        self.bench.lock().unwrap_or_else(PoisonError::into_inner)
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

    /// The person who puts everything where an episode begins.
    pub fn person(&self) -> Ready {
        let rehearsal = self.clone();
        Arc::new(move |qpos| {
            let mut bench = rehearsal.bench();
            let rest = vec![0.0; bench.plant().data().state.qvel.len()];
            Ok(bench.plant_mut().place(qpos, &rest)?)
        })
    }

    /// What an environment drives in a rehearsal. `ready` is called besides the simulated person, after it.
    pub fn hardware(&self, config: Config, setup: Setup, ready: Option<Ready>) -> Hardware {
        let (rehearsal, person) = (self.clone(), self.person());
        Hardware {
            registry: Arc::new(registry(&self.setup(setup))),
            clock: Arc::new(move || rehearsal.clock()),
            ready: Arc::new(move |qpos| {
                person(qpos)?;
                ready.as_ref().map_or(Ok(()), |ready| ready(qpos))
            }),
            config: Some(config),
        }
    }
}

/// What an environment drives in earnest, in the time of the wall. Without a config its own is used.
pub fn real_hardware(config: Option<Config>, setup: &Setup, ready: Ready) -> Hardware {
    let start = WallClock::default();
    Hardware { registry: Arc::new(registry(setup)), clock: Arc::new(move || Box::new(start)), ready, config }
}
