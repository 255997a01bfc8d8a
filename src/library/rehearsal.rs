//! Robots that are hardware, and their rehearsal: the same drivers against simulated devices, in virtual time.

use crate::cameras::{Onlookers, opener};
use env::{Env, EnvError, Hardware, Ready};
use hardware::{Clocks, Services, Setup, Sockets, TendedClock, TendedPort, registry};
use physics::StepError;
use protocol::Port;
use robot::{Clock, Config, WallClock};
use std::fmt;
use std::io;
use std::net::Ipv4Addr;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use wire::{Bench, Outlet, Plant, PlantError, Rates, Rigged, Shared, VirtualClock, VirtualPort};

/// Simulated devices of a robot's config, and what drivers need to find them.
#[derive(Clone)]
pub struct Rehearsal {
    bench: Shared,
    services: Services,
    rigged: Arc<Vec<Rigged>>,
}

/// Why there is no rehearsal.
#[derive(Debug)]
pub enum RehearsalError {
    /// The environment cannot begin an episode.
    Start(EnvError),
    /// Physics refuses the state of the model.
    Physics(StepError),
    /// The config and the model do not fit, or nothing of the config can be simulated.
    Devices(PlantError),
}

impl fmt::Display for RehearsalError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            RehearsalError::Start(error) => error.fmt(f),
            RehearsalError::Physics(error) => error.fmt(f),
            RehearsalError::Devices(error) => error.fmt(f),
        }
    }
}

impl std::error::Error for RehearsalError {}

impl Rehearsal {
    /// The devices of `config` on the model of a simulated environment, which they move from where an episode begins.
    ///
    /// # Errors
    /// The environment has no start; the config names what its model does not have.
    pub fn new(config: &Config, env: &mut Env) -> Result<Rehearsal, RehearsalError> {
        env.reset(Some(0)).map_err(RehearsalError::Start)?;
        let scene = env.scene();
        let mut plant = Plant::new(scene.model.clone()).map_err(RehearsalError::Physics)?;
        let rest = vec![0.0; scene.data.state.qvel.len()];
        plant.place(&scene.data.state.qpos, &rest).map_err(RehearsalError::Physics)?;
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

    /// Injects faults into all links from now on.
    pub fn inject(&self, rates: Rates, seed: u64) {
        let mut bench = self.bench();
        for (k, (_, link)) in self.rigged.iter().flat_map(|device| &device.links).enumerate() {
            bench.inject(*link, rates, seed.wrapping_mul(64).wrapping_add(k as u64));
        }
    }

    /// Number of faults injected since [`Rehearsal::inject`].
    pub fn struck(&self) -> u64 {
        let bench = self.bench();
        self.rigged.iter().flat_map(|device| &device.links).map(|(_, link)| bench.struck(*link)).sum()
    }

    /// `setup` with the simulated devices in place of real ones.
    pub fn setup(&self, setup: Setup) -> Setup {
        let wires =
            Wires { bench: self.bench.clone(), services: self.services.clone(), rigged: self.rigged.clone() };
        let serial = wires.clone();
        let open = move |address: &str, _: u32| serial.open(address, Outlet::Serial);
        let bench = self.bench.clone();
        let clocks: Clocks = Arc::new(move || Box::new(VirtualClock::new(bench.clone())));
        setup
            .in_virtual_time(clocks, self.services.clone(), Arc::new(open))
            .with_sockets(Arc::new(wires))
            .with_captures(Arc::new(Onlookers(self.bench.clone())))
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
        let setup = self.setup(setup);
        Hardware {
            registry: Arc::new(registry(&setup)),
            cameras: Some(opener(setup)),
            clock: Arc::new(move || rehearsal.clock()),
            ready: Arc::new(move |qpos| {
                person(qpos)?;
                ready.as_ref().map_or(Ok(()), |ready| ready(qpos))
            }),
            config: Some(config),
        }
    }
}

/// Ports and network of the simulated devices.
#[derive(Clone)]
struct Wires {
    bench: Shared,
    services: Services,
    rigged: Arc<Vec<Rigged>>,
}

impl Wires {
    /// The link of the device at an address; a connection starts again.
    fn open(&self, address: &str, outlet: Outlet) -> io::Result<Box<dyn Port>> {
        let devices = self.rigged.iter().filter(|device| device.address == address);
        let found = devices.flat_map(|device| &device.links).find(|(place, _)| *place == outlet);
        let (_, link) = found.ok_or_else(|| {
            io::Error::new(
                io::ErrorKind::NotFound,
                format!("no simulated device is at {address} ({outlet:?})"),
            )
        })?;
        let mut bench = self.bench.lock().unwrap_or_else(PoisonError::into_inner);
        if matches!(outlet, Outlet::Tcp(_)) {
            bench.set_connected(*link, false);
        }
        bench.set_connected(*link, true);
        let port = VirtualPort::new(self.bench.clone(), *link);
        Ok(Box::new(TendedPort::new(port, self.services.clone())))
    }
}

impl Sockets for Wires {
    fn connect(&self, host: &str, port: u16) -> io::Result<Box<dyn Port>> {
        self.open(host, Outlet::Tcp(port))
    }

    fn datagrams(&self, host: &str, server: u16) -> io::Result<(Box<dyn Port>, u16)> {
        // The port of this machine is a name only: the link is known.
        Ok((self.open(host, Outlet::Udp(server))?, 40_000))
    }

    fn listen(&self, host: &str, port: u16, _group: Option<Ipv4Addr>) -> io::Result<Box<dyn Port>> {
        self.open(host, Outlet::Udp(port))
    }
}

/// What an environment drives in earnest, in the time of the wall. Without a config its own is used.
pub fn real_hardware(config: Option<Config>, setup: &Setup, ready: Ready) -> Hardware {
    let start = WallClock::default();
    Hardware {
        registry: Arc::new(registry(setup)),
        cameras: Some(opener(setup.clone())),
        clock: Arc::new(move || Box::new(start)),
        ready,
        config,
    }
}
