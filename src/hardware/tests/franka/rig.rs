//! The arm of `hive/FrankaReach-v0` on a bench, and what its driver says to it.

use env::{Env, Hardware, Options as EnvOptions, OwnModels};
use protocol::Port;
use protocol::franka::{ArmLimits, CYCLE, Setpoint, Version};
use robohive_hardware::{Services, Setup, Sockets, TendedClock, registry};
use robot::{Clock, Config, Options, Robot, RobotError};
use std::io;
use std::net::Ipv4Addr;
use std::sync::{Arc, Mutex, PoisonError};
use wire::franka::{Arm, Hand};
use wire::{Bench, Carries, LinkId, Plant, Shared, VirtualClock, VirtualPort};

pub const ID: &str = "hive/FrankaReach-v0";
pub const JOINTS: [&str; 7] = ["joint1", "joint2", "joint3", "joint4", "joint5", "joint6", "joint7"];

/// Where the environment's episodes begin: high above the table, the fingers half open.
pub const START: [f64; 9] = [0.0, 0.0, 0.0, -1.57, 0.0, 1.8675, 0.0, 0.02, 0.02];

/// The config that people copy, with other parameters of its interface.
pub fn config(parameters: &str) -> Config {
    let text = include_str!("../../../../assets/franka/tasks/hardware.toml");
    let (before, rest) = text.split_once("interface = {").unwrap();
    let (_, after) = rest.split_once('}').unwrap();
    let interface = format!(
        "interface = {{ type = 'franka', ip_address = '127.0.0.1', hand = true, reset_time = 1, {parameters} }}"
    );
    Config::from_toml(&format!("{before}{interface}{after}"), "hardware.toml").unwrap()
}

/// Commands that the driver has sent, each with the state that it answers.
pub type Sent = Arc<Mutex<Vec<Setpoint>>>;

/// A port that remembers what went through it.
struct Tap {
    port: VirtualPort,
    version: Version,
    sent: Sent,
}

impl Port for Tap {
    fn send(&mut self, bytes: &[u8]) -> io::Result<()> {
        self.sent
            .lock()
            .unwrap_or_else(PoisonError::into_inner)
            .push(Setpoint::decode(bytes, self.version).expect("a whole command"));
        self.port.send(bytes)
    }

    fn receive(&mut self, buffer: &mut [u8], timeout: f64) -> io::Result<usize> {
        self.port.receive(buffer, timeout)
    }

    fn discard(&mut self) -> io::Result<()> {
        self.port.discard()
    }

    fn now(&self) -> f64 {
        self.port.now()
    }

    fn wait(&mut self, seconds: f64) {
        self.port.wait(seconds);
    }
}

/// The network of a bench.
struct Wires {
    bench: Shared,
    arm: [LinkId; 2],
    hand: [LinkId; 2],
    version: Version,
    sent: Sent,
}

impl Wires {
    fn links(&self, port: u16) -> io::Result<[LinkId; 2]> {
        match port {
            1337 => Ok(self.arm),
            1338 => Ok(self.hand),
            _ => Err(io::Error::new(io::ErrorKind::ConnectionRefused, "nobody listens there")),
        }
    }
}

impl Sockets for Wires {
    fn connect(&self, _host: &str, port: u16) -> io::Result<Box<dyn Port>> {
        let [commands, _] = self.links(port)?;
        self.bench.lock().unwrap().set_connected(commands, false);
        self.bench.lock().unwrap().set_connected(commands, true);
        Ok(Box::new(VirtualPort::new(self.bench.clone(), commands)))
    }

    fn datagrams(&self, _host: &str, server: u16) -> io::Result<(Box<dyn Port>, u16)> {
        let [_, states] = self.links(server)?;
        self.bench.lock().unwrap().set_connected(states, true);
        let port = VirtualPort::new(self.bench.clone(), states);
        if server == 1337 {
            return Ok((Box::new(Tap { port, version: self.version, sent: self.sent.clone() }), 40_000));
        }
        Ok((Box::new(port), 40_001))
    }

    fn listen(&self, _: &str, _: u16, _: Option<Ipv4Addr>) -> io::Result<Box<dyn Port>> {
        Err(io::ErrorKind::Unsupported.into())
    }
}

pub struct Rig {
    pub model: physics::Model,
    pub bench: Shared,
    pub arm: [LinkId; 2],
    pub hand: [LinkId; 2],
    pub services: Services,
    pub setup: Setup,
    pub sent: Sent,
    pub version: Version,
}

impl Rig {
    pub fn new(version: Version, prepare: impl FnOnce(Arm) -> Arm) -> Rig {
        // The model as the environment compiles it.
        let model = Env::make(ID, &OwnModels, &EnvOptions::default()).unwrap().scene().model.clone();
        let mut plant = Plant::new(model.clone()).unwrap();
        let mut ready: Vec<f64> = model.key_qpos.iter().take(model.nq).copied().collect();
        ready[..9].copy_from_slice(&START);
        plant.place(&ready, &vec![0.0; model.nv]).unwrap();
        let arm = prepare(Arm::new(version, &plant, JOINTS).unwrap());
        let hand = Hand::new(&plant, "gripper", 0.08).unwrap();
        let mut bench = Bench::new(plant);
        let arm = bench.connect_all(Box::new(arm), [Carries::AT_ONCE, Carries::Datagrams]);
        let hand = bench.connect_all(Box::new(hand), [Carries::AT_ONCE, Carries::Datagrams]);
        let bench: Shared = Arc::new(Mutex::new(bench));
        let (services, sent, clocked) = (Services::default(), Sent::default(), bench.clone());
        let wires = Wires { bench: bench.clone(), arm, hand, version, sent: sent.clone() };
        let mut setup = Setup::default()
            .in_virtual_time(
                Arc::new(move || Box::new(VirtualClock::new(clocked.clone())) as _),
                services.clone(),
                Arc::new(|_, _| Err(io::ErrorKind::NotFound.into())),
            )
            .with_sockets(Arc::new(wires))
            .with_armed(true);
        setup.say = Arc::new(|_| {});
        Rig { model, bench, arm, hand, services, setup, sent, version }
    }

    pub fn robot(&self, config: &Config) -> Result<Robot, RobotError> {
        let options = Options::default().with_hardware(true).with_normalized(false);
        Robot::with_devices(&self.model, Some(config), options, &registry(&self.setup))
    }

    pub fn clock(&self) -> TendedClock<VirtualClock> {
        TendedClock::new(VirtualClock::new(self.bench.clone()), self.services.clone())
    }

    /// Where an episode begins.
    pub fn data(&self) -> physics::Data {
        let mut data = physics::Data::new(&self.model);
        data.state.qpos.copy_from_slice(&self.model.key_qpos[..self.model.nq]);
        data.state.qpos[..9].copy_from_slice(&START);
        data.state.ctrl.copy_from_slice(&START[..8]);
        physics::forward(&self.model, &mut data).unwrap();
        data
    }

    pub fn positions(&self) -> [f64; 7] {
        let bench = self.bench.lock().unwrap();
        std::array::from_fn(|k| bench.plant().position(bench.plant().motor(JOINTS[k]).unwrap()))
    }

    /// What the joints are commanded: targets of the plant's servos.
    pub fn commanded(&self) -> [f64; 7] {
        let bench = self.bench.lock().unwrap();
        std::array::from_fn(|k| bench.plant().data().state.ctrl[k])
    }

    /// Another process: nobody tends what the one before has left.
    pub fn restart(&mut self) {
        self.services = Services::default();
        self.setup.services = Some(self.services.clone());
    }

    pub fn environment(&self, config: Config, seed: u64) -> Env {
        let (placed, ticking, services) = (self.bench.clone(), self.bench.clone(), self.services.clone());
        let held = services.clone();
        let hardware = Hardware {
            cameras: None,
            registry: Arc::new(registry(&self.setup)),
            clock: Arc::new(move || {
                Box::new(TendedClock::new(VirtualClock::new(ticking.clone()), services.clone())) as _
            }),
            // The person between two episodes: everything is where the episode begins, and at rest.
            // It is held there until the arm has said so.
            ready: Arc::new(move |qpos| {
                let mut bench = placed.lock().unwrap();
                let rest = vec![0.0; bench.plant().data().state.qvel.len()];
                bench.plant_mut().place(qpos, &rest)?;
                bench.plant_mut().set_held(true);
                drop(bench);
                TendedClock::new(VirtualClock::new(placed.clone()), held.clone()).wait(0.002);
                placed.lock().unwrap().plant_mut().set_held(false);
                Ok(())
            }),
            config: Some(config),
        };
        Env::make(ID, &OwnModels, &EnvOptions::default().with_seed(seed).with_hardware(Some(hardware)))
            .unwrap()
    }

    /// Whether all commands of a motion that has positions are within what the arm allows. A gap in the states that they
    /// answer stands for a beginning or for states that were lost; what lies between is checked by its mean velocity.
    pub fn check_commands(&self) {
        let limits = ArmLimits::of(self.version);
        let sent = self.sent.lock().unwrap();
        for k in 0..7 {
            let mut course: Option<(u64, f64, Option<f64>, Option<f64>)> = None;
            for setpoint in sent.iter() {
                let q = setpoint.q[k];
                let [low, high] = limits.position[k];
                assert!((low..=high).contains(&q), "joint {k} at {q}");
                let next = match course {
                    Some((message, before, dq, ddq))
                        if setpoint.message > message && setpoint.message - message <= 20 =>
                    {
                        let count = setpoint.message - message;
                        let rate = (q - before) / (count as f64 * CYCLE);
                        assert!(rate.abs() <= limits.velocity[k] + 1e-9, "joint {k}: {rate} rad/s");
                        let exact = count == 1;
                        let acceleration = dq.filter(|_| exact).map(|dq| (rate - dq) / CYCLE);
                        if let Some(acceleration) = acceleration {
                            assert!(
                                acceleration.abs() <= limits.acceleration[k],
                                "joint {k}: {acceleration} rad/s²"
                            );
                        }
                        if let (Some(acceleration), Some(ddq)) = (acceleration, ddq) {
                            let jerk: f64 = (acceleration - ddq) / CYCLE;
                            assert!(jerk.abs() <= limits.jerk[k], "joint {k}: {jerk} rad/s³");
                        }
                        (setpoint.message, q, exact.then_some(rate), acceleration)
                    }
                    _ => (setpoint.message, q, None, None),
                };
                course = Some(next);
            }
        }
    }
}
