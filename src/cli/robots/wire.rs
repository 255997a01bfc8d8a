//! `wire`: simulated devices that other programs open.

use crate::failure::{Failure, unwritable};
use crate::input::library::Making;
use crate::interrupt::Interrupt;
use crate::output::{check_place, keep_input};
use crate::robots::hardware::seconds;
use crate::robots::rehearsal::simulated;
use crate::robots::worn;
use crate::terminal::{note, show};
use clap::{Args, ValueHint};
use protocol::dynamixel::{self, MODELS, v1};
use protocol::optitrack::natnet;
use protocol::servo::Kind;
use protocol::{adb, cyberglove, feetech};
use robot::{Config, Value};
use std::io;
use std::net::{Ipv4Addr, SocketAddr};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant};
use wire::{Bench, Carries, End, LinkId, Outlet, Plant, Rates, Rigged, Terminal, serve};

/// Serve simulated devices on pseudo-terminals and sockets, for any program that speaks their protocols
#[derive(Args)]
#[command(
    after_help = "With a robot config and an environment, every device of the config that can be simulated moves and measures that \
environment's model: `robohive run ID --hardware OUT` then drives it through the real drivers, in real time. With --ids alone, each \
servo drives a flywheel.

The headset and the glove repeat a motion of four seconds: the right controller is gripped and moves on a circle of radius 0.1 m in front of the head, the \
fingers close and open. `robohive teleop ID --device quest:ADDRESS` and `--device glove:PATH` read them.

--faults takes probabilities a message: drop, delay, reorder, duplicate, corrupt, truncate, stall, disconnect, stop. The same seed \
injects the same faults.

Examples:
  robohive wire --ids 1-6 --model XL330-M288 --faults drop=0.001,corrupt=0.001 --seconds 0.2
  robohive wire --ids 1,2 --model AX-12A --seconds 0.2
  robohive wire --config assets/quadruped/servos.toml --env hive/QuadrupedWalk-v0 --seconds 0.2
  robohive wire --quest 1WMHH8000X --glove 22 --seconds 0.2"
)]
pub struct Wire {
    /// Robot config whose devices are simulated
    #[arg(long, value_name = "FILE", value_hint = ValueHint::FilePath, requires = "env", required_unless_present_any = ["ids", "quest", "glove"])]
    config: Option<PathBuf>,
    /// Environment whose model they move
    #[arg(long, value_name = "ID", requires = "config")]
    env: Option<String>,
    /// Write the config with the addresses of the simulated devices to this file (TOML)
    #[arg(long, value_name = "FILE", value_hint = ValueHint::FilePath, requires = "config")]
    out: Option<PathBuf>,
    /// Servos with these ids on one bus, as 1-6 or 10,11,20
    #[arg(long, value_name = "IDS", value_parser = ids, conflicts_with = "config")]
    ids: Option<Ids>,
    /// Model of the servos: a Dynamixel model, which determines the protocol, or Feetech's STS3215
    #[arg(long, value_name = "MODEL", default_value = MODELS[0].kind.name, value_parser = model)]
    model: &'static Kind,
    /// A Quest with this serial number, at an adb server
    #[arg(long, value_name = "SERIAL", conflicts_with = "config", value_parser = serial)]
    quest: Option<String>,
    /// A CyberGlove with 18 or 22 sensors
    #[arg(long, value_name = "SENSORS", conflicts_with = "config", value_parser = ["18", "22"])]
    glove: Option<String>,
    /// Baud rate of their bus, which decides how long answers take
    #[arg(long, value_name = "BAUD", default_value_t = 1_000_000, value_parser = clap::value_parser!(u32).range(9600..=4_500_000))]
    baud: u32,
    /// Make this path a link to the first pseudo-terminal
    #[arg(long, value_name = "PATH", value_hint = ValueHint::FilePath)]
    link: Option<PathBuf>,
    /// Faults of every link, as drop=0.01,delay=0.05
    #[arg(long, value_name = "FAULT=P,…", default_value = "")]
    faults: Rates,
    /// Seed of the faults
    #[arg(long, value_name = "SEED", default_value_t = 0)]
    seed: u64,
    /// End after this time [s]
    #[arg(long, value_name = "SECONDS", value_parser = seconds)]
    seconds: Option<f64>,
    /// How the environment is made
    #[command(flatten)]
    making: Making,
}

/// Ids of servos.
#[derive(Clone)]
struct Ids(Vec<u8>);

fn ids(text: &str) -> Result<Ids, String> {
    let wrong = || format!("'{text}' is not a list of ids from 0 to 252, such as 1-6 or 10,11,20");
    let mut ids = Vec::new();
    for part in text.split(',') {
        let (first, last) = part.split_once('-').unwrap_or((part, part));
        let [first, last] = [first, last].map(|id| id.trim().parse::<u8>().ok().filter(|id| *id <= 252));
        let (first, last) = (first.ok_or_else(wrong)?, last.ok_or_else(wrong)?);
        if first > last {
            return Err(format!("'{part}' begins above its end: write {last}-{first}"));
        }
        for id in first..=last {
            if ids.contains(&id) {
                return Err(format!("the id {id} is there twice: servos on one bus have ids of their own"));
            }
            ids.push(id);
        }
    }
    Ok(Ids(ids))
}

/// The serial number of a headset: a word in a list of words.
fn serial(text: &str) -> Result<String, String> {
    if text.is_empty() || !text.bytes().all(|byte| byte.is_ascii_graphic()) {
        return Err("a serial number has letters and digits, and no spaces, as 1WMHH8000X".to_owned());
    }
    Ok(text.to_owned())
}

fn model(text: &str) -> Result<&'static Kind, String> {
    let kinds = || dynamixel::KINDS.iter().chain(&v1::KINDS).chain(&feetech::KINDS);
    kinds().find(|kind| kind.name == text).ok_or_else(|| {
        let names: Vec<_> = kinds().map(|kind| kind.name).collect();
        format!("the models are {}", names.join(", "))
    })
}

/// Runs the command.
pub fn run(a: &Wire) -> Result<(), Failure> {
    if let Some((out, input)) = a.out.as_ref().zip(a.config.as_ref()) {
        keep_input(input, out)?;
        check_place(out)?;
    }
    let (mut bench, mut config, rigged) = match (&a.config, &a.env) {
        (Some(path), Some(id)) => devices_of(a, path, id)?,
        _ => stand(a)?,
    };
    let mut ends: Vec<(LinkId, End)> = Vec::new();
    for device in &rigged {
        for (outlet, link) in &device.links {
            // Links with the same seed would have faults in the same messages.
            bench.inject(*link, a.faults, a.seed.wrapping_add(ends.len() as u64));
            let end = end(*outlet).map_err(|error| Failure::new(format!("{}: {error}", device.device)))?;
            let address = end.address();
            show!("{}: {}", device.device, described(*outlet, &address));
            readdress(&mut config, device, *outlet, &address);
            ends.push((*link, end));
        }
    }
    let _linked = a.link.as_deref().map(|path| Linked::new(path, &ends)).transpose()?;
    if let Some(out) = &a.out {
        std::fs::write(out, config.to_toml()).map_err(unwritable(out))?;
        show!("config: {}", out.display());
    }
    serve_until(a, bench, ends)
}

/// The outer end of a link, on this machine alone.
fn end(outlet: Outlet) -> io::Result<End> {
    let here = |port| SocketAddr::from((Ipv4Addr::LOCALHOST, port));
    match outlet {
        Outlet::Serial => Terminal::open().map(End::Terminal),
        Outlet::Tcp(_) => End::tcp(here(0)),
        // NatNet requests go to a fixed port of the server; frames and states go to a port of the driver.
        Outlet::Udp(port @ natnet::COMMAND_PORT) => End::udp(here(port), None),
        Outlet::Udp(port) => End::udp(here(0), Some(here(port))),
    }
}

/// How to connect to an end.
fn described(outlet: Outlet, address: &str) -> String {
    match outlet {
        Outlet::Serial => address.to_owned(),
        Outlet::Tcp(_) => format!("connections at {address}"),
        Outlet::Udp(natnet::COMMAND_PORT) => format!("requests at {address}"),
        Outlet::Udp(port) => format!("datagrams from {address}, to port {port} unless announced"),
    }
}

/// Writes the address of a link to the config.
fn readdress(config: &mut Config, device: &Rigged, outlet: Outlet, address: &str) {
    let found = config.devices.iter_mut().find(|other| other.name == device.device);
    let Some(parameters) = found.map(|found| &mut found.interface.parameters) else { return };
    let first = matches!(device.links.first(), Some((first, _)) if *first == outlet);
    let port = address.rsplit_once(':').and_then(|(_, port)| port.parse().ok());
    match outlet {
        Outlet::Serial | Outlet::Tcp(_) if first => {
            parameters.insert(device.key.to_owned(), Value::Text(address.to_owned()));
        }
        // The second TCP server of an arm is that of its hand.
        Outlet::Tcp(_) => {
            parameters.extend(port.map(|port| ("hand_port".to_owned(), Value::Integer(port))));
        }
        Outlet::Udp(_) if first => {
            parameters.insert(device.key.to_owned(), Value::Text(Ipv4Addr::LOCALHOST.to_string()));
        }
        // Drivers announce their port for states, and the port for requests is fixed.
        Outlet::Serial | Outlet::Udp(_) => {}
    }
}

/// Serves until a signal, or until the time is over.
fn serve_until(a: &Wire, bench: Bench, mut ends: Vec<(LinkId, End)>) -> Result<(), Failure> {
    let bench = Arc::new(Mutex::new(bench));
    let stop = Arc::new(AtomicBool::new(false));
    let interrupt = Interrupt::listen().map_err(Failure::new)?;
    let begun = Instant::now();
    let over = || a.seconds.is_some_and(|seconds| begun.elapsed().as_secs_f64() >= seconds);
    std::thread::scope(|scope| {
        let serving = scope.spawn(|| serve(&bench, &mut ends, &stop));
        while interrupt.code().is_none() && !over() && !serving.is_finished() {
            std::thread::sleep(Duration::from_millis(20));
        }
        stop.store(true, Ordering::Relaxed);
        serving.join().map_err(|_| Failure::new("serving ended by a panic"))?.map_err(Failure::new)
    })?;
    let bench = bench.lock().unwrap_or_else(std::sync::PoisonError::into_inner);
    let struck: u64 = ends.iter().map(|(link, _)| bench.struck(*link)).sum();
    show!("served {:.1} s, {struck} faults", bench.time());
    match bench.plant().fault() {
        Some(fault) => Err(Failure::new(format!("the plant stopped: {fault}"))),
        None => interrupt.code().map_or(Ok(()), |code| Err(Failure::silent(code))),
    }
}

/// Devices of a config on the model of an environment.
fn devices_of(a: &Wire, path: &Path, id: &str) -> Result<(Bench, Config, Vec<Rigged>), Failure> {
    let config = Config::read(path).map_err(Failure::usage)?;
    let mut env = simulated(id, &a.making)?;
    env.reset(Some(0)).map_err(Failure::usage)?;
    let env::Scene { model, data, .. } = env.scene();
    let mut plant = Plant::new(model.clone()).map_err(Failure::new)?;
    plant.place(&data.state.qpos, &vec![0.0; model.nv]).map_err(Failure::new)?;
    let (bench, rigged) = wire::rig(&config, plant, false).map_err(Failure::usage)?;
    Ok((bench, config, rigged))
}

/// Devices without a robot.
fn stand(a: &Wire) -> Result<(Bench, Config, Vec<Rigged>), Failure> {
    let ids = a.ids.as_ref().map_or(&[][..], |ids| &ids.0);
    let mut bench = Bench::new(Plant::new(flywheels(ids)?).map_err(Failure::new)?);
    let mut rigged = Vec::new();
    let mut add = |device: &str, kind: &str, outlet, link| {
        rigged.push(Rigged {
            device: device.to_owned(),
            kind: kind.to_owned(),
            key: "name",
            address: String::new(),
            links: vec![(outlet, link)],
        });
    };
    if !ids.is_empty() {
        let (kind, link) = servos(a, ids, &mut bench)?;
        add("servos", kind, Outlet::Serial, link);
    }
    if let Some(serial) = &a.quest {
        let link = bench.connect(Box::new(worn::headset(serial)), Carries::AT_ONCE);
        add("quest", "adb", Outlet::Tcp(adb::PORT), link);
    }
    if let Some(sensors) = &a.glove {
        let glove = worn::glove(if sensors == "18" { 18 } else { 22 });
        let link = bench.connect(Box::new(glove), Carries::serial(cyberglove::BAUD.into()));
        add("glove", "cyberglove", Outlet::Serial, link);
    }
    Ok((bench, Config::default(), rigged))
}

/// A flywheel for each servo.
fn flywheels(ids: &[u8]) -> Result<physics::Model, Failure> {
    let wheel = |id: &u8| {
        format!(
            "<body pos='{id} 0 0'><joint name='{id}' axis='0 1 0' damping='.05' armature='.01'/><geom type='cylinder' size='.05 .01' mass='.1'/></body>"
        )
    };
    let motor = |id: &u8| format!("<position name='{id}' joint='{id}' kp='10' kv='.5' forcerange='-4 4'/>");
    let text = format!(
        "<mujoco><option gravity='0 0 0' integrator='implicitfast'/><worldbody>{}</worldbody><actuator>{}</actuator></mujoco>",
        ids.iter().map(wheel).collect::<String>(),
        ids.iter().map(motor).collect::<String>()
    );
    Ok(mjcf::load_str(&text).map_err(Failure::usage)?.model)
}

/// Servos with flywheels on one line; the type of interface that drives them.
fn servos(a: &Wire, ids: &[u8], bench: &mut Bench) -> Result<(&'static str, LinkId), Failure> {
    let kind =
        if feetech::KINDS.iter().any(|kind| kind.name == a.model.name) { "feetech" } else { "dynamixel" };
    let mut text =
        format!("[[device]]\nname = 'servos'\ninterface = {{ type = '{kind}', baud = {}, ", a.baud);
    text += &format!("model = '{}' }}\nactuator = [", a.model.name);
    for id in ids {
        let middle = f64::midpoint(0.0, (a.model.last + 1) as f64) * a.model.position;
        text += &format!(
            "{{ name = '{id}', pos_range = [-1, 1], vel_range = [-1, 1], hdr_id = {id}, offset = {middle} }},"
        );
    }
    let config = Config::from_toml(&(text + "]"), "servos").map_err(Failure::new)?;
    let links = wire::connect(&config.devices[0], bench, false).map_err(Failure::usage)?;
    Ok((kind, links[0].1))
}

/// A link in the file system that goes when the command does.
struct Linked(PathBuf);

impl Linked {
    fn new(path: &Path, ends: &[(LinkId, End)]) -> Result<Linked, Failure> {
        let terminal = ends.iter().find(|(_, end)| matches!(end, End::Terminal(_)));
        let (_, terminal) = terminal.ok_or_else(|| {
            Failure::usage("--link applies only to pseudo-terminals, and no device here has one: remove it")
        })?;
        let to = terminal.address();
        std::os::unix::fs::symlink(to, path).map_err(|error| {
            Failure::usage(format!("--link {}: {error}; choose a path that does not exist", path.display()))
        })?;
        show!("linked as {}", path.display());
        Ok(Linked(path.to_owned()))
    }
}

impl Drop for Linked {
    fn drop(&mut self) {
        if let Err(error) = std::fs::remove_file(&self.0) {
            note(&format!("the link {} was not removed: {error}", self.0.display()));
        }
    }
}
