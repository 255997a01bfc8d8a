//! A robot whose one device is at the end of a simulated serial line, in virtual time.

use protocol::Port;
use robohive_hardware::{Services, Setup, TendedClock, registry};
use robot::{Config, Options, Robot, RobotError};
use std::io;
use std::sync::{Arc, Mutex};
use wire::{Bench, LinkId, Shared, VirtualClock, VirtualPort};

pub struct Rig {
    pub model: physics::Model,
    pub bench: Shared,
    pub link: LinkId,
    pub services: Services,
    /// Armed.
    pub setup: Setup,
    /// What the driver had to say to a person.
    pub said: Arc<Mutex<Vec<String>>>,
}

impl Rig {
    pub fn new(model: physics::Model, bench: Bench, link: LinkId) -> Rig {
        let bench: Shared = Arc::new(Mutex::new(bench));
        let (services, said) = (Services::default(), Arc::new(Mutex::new(Vec::new())));
        let (clocked, opened, heard) = (bench.clone(), bench.clone(), said.clone());
        let open = move |_: &str, _: u32| -> io::Result<Box<dyn Port>> {
            opened.lock().unwrap().set_connected(link, true);
            Ok(Box::new(VirtualPort::new(opened.clone(), link)))
        };
        let clocks = Arc::new(move || Box::new(VirtualClock::new(clocked.clone())) as _);
        let mut setup =
            Setup::default().in_virtual_time(clocks, services.clone(), Arc::new(open)).with_armed(true);
        setup.say = Arc::new(move |line| heard.lock().unwrap().push(line.to_owned()));
        Rig { model, bench, link, services, setup, said }
    }

    pub fn robot(&self, config: &Config) -> Result<Robot, RobotError> {
        let options = Options::default().with_hardware(true).with_normalized(false);
        Robot::with_devices(&self.model, Some(config), options, &registry(&self.setup))
    }

    pub fn clock(&self) -> TendedClock<VirtualClock> {
        TendedClock::new(VirtualClock::new(self.bench.clone()), self.services.clone())
    }

    /// Where the first two motors stand.
    pub fn positions(&self) -> [f64; 2] {
        let bench = self.bench.lock().unwrap();
        [bench.plant().position(0), bench.plant().position(1)]
    }
}
