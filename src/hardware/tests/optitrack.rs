//! The driver of a tracker against a simulated one, by RoboHive's packets and by NatNet.

use protocol::Port;
use robohive_hardware::{Services, Setup, Sockets, TendedClock, device};
use robot::{Clock, Config, Device, Fault};
use std::io;
use std::net::Ipv4Addr;
use std::sync::{Arc, Mutex};
use wire::optitrack::{FRAMES, REQUESTS, Tracker};
use wire::{Bench, Carries, LinkId, Plant, Shared, VirtualClock, VirtualPort};

/// A body that swings on six joints, as RoboHive's D'Kitty has them.
const BODY: &str = "<mujoco><option timestep='0.001'/><worldbody><body pos='0 0 1'>
    <joint name='x' type='slide' axis='1 0 0'/><joint name='y' type='slide' axis='0 1 0'/>
    <joint name='z' type='slide' axis='0 0 1' stiffness='200' damping='2'/>
    <joint name='a' axis='1 0 0' stiffness='3' damping='.1'/><joint name='b' axis='0 1 0' stiffness='3' damping='.1'/>
    <joint name='c' axis='0 0 1' stiffness='3' damping='.1'/>
    <geom type='box' size='.2 .1 .05' pos='.05 .02 0' mass='2'/></body></worldbody>
  <sensor><jointpos name='x' joint='x'/><jointpos name='y' joint='y'/><jointpos name='z' joint='z'/>
    <jointpos name='a' joint='a'/><jointpos name='b' joint='b'/><jointpos name='c' joint='c'/></sensor></mujoco>";

fn config(extra: &str) -> Config {
    let sensors: String = ["x", "y", "z", "a", "b", "c"]
        .iter()
        .enumerate()
        .map(|(k, name)| {
            let offset = if *name == "z" { -0.32 } else { 0.0 };
            format!("{{ name = '{name}', range = [-9, 9], hdr_id = {k}, offset = {offset} }},")
        })
        .collect();
    let text = format!(
        "[[device]]\nname = 'root'\n\
         interface = {{ type = 'optitrack', server_name = '127.0.0.1', client_name = 'here', packet_size = 36, id = '1', {extra} }}\n\
         sensor = [{sensors}]"
    );
    Config::from_toml(&text, "root.toml").unwrap()
}

/// The network of a bench with a tracker.
struct Wires {
    bench: Shared,
    links: [LinkId; 2],
}

impl Sockets for Wires {
    fn connect(&self, _: &str, _: u16) -> io::Result<Box<dyn Port>> {
        Err(io::ErrorKind::ConnectionRefused.into())
    }

    fn datagrams(&self, _: &str, server: u16) -> io::Result<(Box<dyn Port>, u16)> {
        assert_eq!(server, 1510);
        Ok((Box::new(VirtualPort::new(self.bench.clone(), self.links[REQUESTS])), 40_000))
    }

    fn listen(&self, _: &str, port: u16, _: Option<Ipv4Addr>) -> io::Result<Box<dyn Port>> {
        assert!(port == 5000 || port == 1511);
        Ok(Box::new(VirtualPort::new(self.bench.clone(), self.links[FRAMES])))
    }
}

struct Rig {
    bench: Shared,
    links: [LinkId; 2],
    device: Box<dyn Device>,
    clock: TendedClock<VirtualClock>,
}

impl Rig {
    fn new(config: &Config) -> Rig {
        let model = robohive_mjcf::load_str(BODY).unwrap().model;
        let mut plant = Plant::new(model).unwrap();
        plant.place(&[0.3, -0.2, 0.05, 0.3, -0.2, 0.4], &[0.0; 6]).unwrap();
        let tracker = Tracker::of(&config.devices[0], &plant).unwrap();
        let mut bench = Bench::new(plant);
        let links = bench.connect_all(Box::new(tracker), [Carries::Datagrams, Carries::Datagrams]);
        let bench: Shared = Arc::new(Mutex::new(bench));
        let (services, clocked) = (Services::default(), bench.clone());
        let setup = Setup::default()
            .in_virtual_time(
                Arc::new(move || Box::new(VirtualClock::new(clocked.clone())) as _),
                services.clone(),
                Arc::new(|_, _| Err(io::ErrorKind::NotFound.into())),
            )
            .with_sockets(Arc::new(Wires { bench: bench.clone(), links }));
        let device = device(&config.devices[0], &setup).unwrap();
        let clock = TendedClock::new(VirtualClock::new(bench.clone()), services);
        Rig { bench, links, device, clock }
    }

    fn truth(&self) -> Vec<f64> {
        self.bench.lock().unwrap().plant().data().state.qpos.to_vec()
    }
}

#[test]
fn both_protocols_give_the_pose_in_single_precision() {
    for extra in ["", "protocol = 'natnet'", "protocol = 'natnet', multicast = true"] {
        let config = config(extra);
        let mut rig = Rig::new(&config);
        rig.device.connect().unwrap();
        let (mut worst, mut fastest) = (0.0_f64, 0.0_f64);
        let mut values = [0.0; 6];
        for _ in 0..200 {
            rig.clock.wait(0.01);
            rig.device.read(&mut values).unwrap();
            let velocities = rig.bench.lock().unwrap().plant().data().state.qvel.to_vec();
            fastest = velocities.iter().fold(fastest, |fastest, velocity| fastest.max(velocity.abs()));
            for (k, truth) in rig.truth().into_iter().enumerate() {
                let value = values[k] + config.devices[0].sensors[k].offset;
                let turns = if k < 3 { 0.0 } else { ((value - truth) / std::f64::consts::TAU).round() };
                worst = worst.max((value - truth - turns * std::f64::consts::TAU).abs());
            }
        }
        rig.device.close().unwrap();
        // A frame is as old as a period and a time step at most; between two looks the body is a little faster than at them.
        let oldest = 1.0 / 120.0 + 0.001;
        assert!(worst < 1.1 * fastest * oldest, "{extra}: {worst} at {fastest}");
        assert!(worst > 0.0);
    }
}

#[test]
fn a_lost_tracker_is_stale_in_time_and_found_again_by_a_reset() {
    let config = config("protocol = 'natnet'");
    let mut rig = Rig::new(&config);
    rig.device.connect().unwrap();
    let mut values = [0.0; 6];
    rig.bench.lock().unwrap().stop_button(true);
    rig.clock.wait(0.12);
    let fault = rig.device.read(&mut values).unwrap_err();
    assert!(matches!(fault, Fault::Stale(45..=110)), "{fault}");
    rig.bench.lock().unwrap().stop_button(false);
    rig.clock.wait(0.2);
    rig.device.reset(&[]).unwrap();
    rig.device.read(&mut values).unwrap();
    rig.device.close().unwrap();
    assert!(rig.bench.lock().unwrap().connected(rig.links[FRAMES]));
}

#[test]
fn what_is_missing_is_named() {
    let mut rig = Rig::new(&config(""));
    rig.bench.lock().unwrap().stop_button(true);
    let said = rig.device.connect().unwrap_err().to_string();
    assert!(said.contains("no frame of the rigid body 1 came from 127.0.0.1 in 1 s"), "{said}");
    let mut natnet = Rig::new(&config("protocol = 'natnet'"));
    natnet.bench.lock().unwrap().stop_button(true);
    let said = natnet.device.connect().unwrap_err().to_string();
    assert!(said.contains("no NatNet server answers at 127.0.0.1:1510"), "{said}");
    let setup = Setup::default();
    for (change, part) in [
        ("protocol = 'motive'", "protocol"),
        ("porto = 1", "'porto' of its interface is not known"),
        ("port = 0", "'port' of its interface is 0"),
    ] {
        let said = device(&config(change).devices[0], &setup).err().unwrap().to_string();
        assert!(said.contains(part), "{said}");
    }
}
