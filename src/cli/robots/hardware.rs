//! `hardware`: inspect a robot's devices, and move them from the command line.

use crate::failure::Failure;
use crate::interrupt::Interrupt;
use crate::robots::calibrate::{self, Calibrate};
use crate::robots::devices::{Connected, Devices, Reached, failed};
use crate::robots::live::{Arming, READING};
use crate::terminal::{show, show_json};
use ::hardware::camera::{self, CameraError, Cameras, Streamed, Wanted, video_devices};
use ::hardware::recorder::{What, read};
use ::hardware::{kinds, serial_ports};
use clap::{Args, Subcommand, ValueHint};
use robot::{Clock, Fault};
use serde_json::json;
use std::io::IsTerminal;
use std::path::PathBuf;

/// Inspect a robot's devices: list them, measure their latency, show their readings, move them home, calibrate them
#[derive(Args)]
#[command(
    after_help = "A robot config names devices, each with an interface whose `type` is a driver. Nothing moves without --arm; reading needs \
none. --rehearse ID puts simulated devices in their place, which speak the same protocols and move the model of that environment.

Examples:
  robohive hardware list
  robohive hardware check assets/quadruped/servos.toml --rehearse hive/QuadrupedWalk-v0
  robohive hardware home assets/quadruped/servos.toml --arm --rehearse hive/QuadrupedWalk-v0"
)]
pub struct Hardware {
    /// What to do.
    #[command(subcommand)]
    command: Command,
}

/// What to do with devices.
#[derive(Subcommand)]
enum Command {
    /// List drivers, and serial ports and video devices of this machine
    #[command(after_help = "Examples:\n  robohive hardware list")]
    List(List),
    /// Connect the devices, and measure how fast and how regularly they answer
    #[command(
        after_help = "Latency is the time that a reading takes; a tick is missed when the reading before it took longer than a period. \
With --json the whole histogram.

Examples:
  robohive hardware check assets/quadruped/servos.toml --rehearse hive/QuadrupedWalk-v0 --rate 50"
    )]
    Check(Check),
    /// Show what the devices measure, until Ctrl-C
    #[command(after_help = "Examples:
  robohive hardware monitor assets/quadruped/servos.toml --rehearse hive/QuadrupedWalk-v0")]
    Monitor(Monitor),
    /// Move every actuator to the middle of its range, by minimum jerk
    #[command(after_help = "Without --arm, which lets them move, it says that nothing moved.

Examples:
  robohive hardware home assets/quadruped/servos.toml --arm --rehearse hive/QuadrupedWalk-v0")]
    Home(Home),
    /// Find scales and offsets of joints: a person holds the robot in known poses
    #[command(
        after_help = "The robot is without torque; the command names a pose, the person moves the joints there by hand and presses \
Enter. Lower and upper ends of the ranges give offset and direction of each joint. Scales keep their size, which is the device's unit.

Examples:
  robohive hardware calibrate assets/quadruped/servos.toml --out calibrated.toml\\
 --rehearse hive/QuadrupedWalk-v0
  robohive hardware calibrate assets/quadruped/servos.toml --out knee.toml\\
 --rehearse hive/QuadrupedWalk-v0 --pose front_left_knee=-1 --pose front_left_knee=1"
    )]
    Calibrate(Calibrate),
    /// Print a flight recorder's file: the last minutes of a device
    #[command(after_help = "One line a record: number, time, what, values in the device's units.

Examples:
  robohive hardware home assets/quadruped/servos.toml --arm --rehearse hive/QuadrupedWalk-v0\\
 --flight flights
  robohive hardware flight flights/legs.flight --last 5")]
    Flight(Flight),
}

#[derive(Args)]
struct List {
    /// Print one JSON object instead
    #[arg(long)]
    json: bool,
}

#[derive(Args)]
struct Check {
    #[command(flatten)]
    devices: Devices,
    /// Readings of each device
    #[arg(long, value_name = "N", default_value_t = 1000, value_parser = clap::value_parser!(u32).range(1..=1_000_000))]
    samples: u32,
    /// Readings a second
    #[arg(long, value_name = "HZ", default_value_t = 100.0, value_parser = rate)]
    rate: f64,
    /// Print one JSON object instead
    #[arg(long)]
    json: bool,
}

#[derive(Args)]
struct Monitor {
    #[command(flatten)]
    devices: Devices,
    /// Readings a second
    #[arg(long, value_name = "HZ", default_value_t = 10.0, value_parser = rate)]
    rate: f64,
    /// End after this time [s]
    #[arg(long, value_name = "SECONDS", value_parser = seconds)]
    seconds: Option<f64>,
}

#[derive(Args)]
struct Home {
    #[command(flatten)]
    devices: Devices,
    #[command(flatten)]
    arming: Arming,
}

#[derive(Args)]
struct Flight {
    /// The file
    #[arg(value_name = "FILE", value_hint = ValueHint::FilePath)]
    file: PathBuf,
    /// Only the last N records
    #[arg(long, value_name = "N")]
    last: Option<usize>,
}

/// A rate of readings.
fn rate(text: &str) -> Result<f64, String> {
    let rate = text.parse::<f64>().ok().filter(|rate| (0.1..=10_000.0).contains(rate));
    rate.ok_or_else(|| "it must be a number from 0.1 to 10000".to_owned())
}

/// A time after which a command ends.
pub fn seconds(text: &str) -> Result<f64, String> {
    let seconds = text.parse::<f64>().ok().filter(|seconds| *seconds >= 0.0);
    seconds.ok_or_else(|| "it must be a number of seconds, 0 or more".to_owned())
}

/// Runs the command.
pub fn run(a: &Hardware) -> Result<(), Failure> {
    match &a.command {
        Command::List(a) => list(a),
        Command::Check(a) => check(a),
        Command::Monitor(a) => monitor(a),
        Command::Home(a) => home(a),
        Command::Calibrate(a) => calibrate::run(a),
        Command::Flight(a) => flight(a),
    }
}

fn list(a: &List) -> Result<(), Failure> {
    let (kinds, ports, videos): (Vec<_>, _, _) = (kinds().collect(), serial_ports(), video_devices());
    if a.json {
        show_json(
            &json!({"drivers": kinds, "cameras": camera::KINDS, "simulated": wire::kinds().collect::<Vec<_>>(), "serial_ports": ports,
                "video_devices": videos.iter().map(|found| json!({"path": found.path, "name": found.name, "usb": found.usb,
                    "serial": found.serial})).collect::<Vec<_>>()}),
        );
        return Ok(());
    }
    show!("drivers       {}", kinds.join(", "));
    show!("cameras       {}", camera::KINDS.join(", "));
    show!("serial ports  {}", if ports.is_empty() { "none".to_owned() } else { ports.join(", ") });
    if videos.is_empty() {
        show!("video devices none");
    }
    for found in videos {
        let serial = found.serial.map_or_else(String::new, |serial| format!(", serial number {serial}"));
        show!("video device  {} {}{serial}", found.path, found.name);
    }
    Ok(())
}

/// How a device answered.
#[derive(Default)]
struct Answers {
    /// Time of each reading [s].
    latencies: Vec<f64>,
    faults: u32,
    /// What the last of them was.
    fault: Option<Fault>,
    missed: u32,
}

impl Answers {
    /// Quantile of the latencies [ms].
    fn quantile(&self, share: f64) -> f64 {
        let place = ((self.latencies.len().max(1) - 1) as f64 * share).round() as usize;
        self.latencies.get(place).map_or(f64::NAN, |latency| latency * 1e3)
    }
}

fn check(a: &Check) -> Result<(), Failure> {
    let reached = a.devices.reach(READING.setup())?;
    let mut cameras = reached.cameras()?;
    let Reached { mut devices, mut clock, .. } = reached;
    let period = 1.0 / a.rate;
    let interrupt = Interrupt::listen().map_err(Failure::new)?;
    for device in &mut devices {
        // Why the newest reading did not come.
        let (mut answers, mut lost) = (Answers::default(), None);
        for _ in 0..a.samples {
            if interrupt.code().is_some() {
                break;
            }
            let begun = clock.now();
            match device.read() {
                Ok(_) => {
                    answers.latencies.push(clock.now() - begun);
                    lost = None;
                }
                Err(fault) => {
                    answers.faults += 1;
                    answers.fault = Some(fault.clone());
                    lost = Some(fault);
                }
            }
            let left = begun + period - clock.now();
            if left > 0.0 {
                clock.wait(left);
            } else {
                answers.missed += 1;
            }
        }
        answers.latencies.sort_by(f64::total_cmp);
        report(a, device, &answers);
        if let Some(fault) = lost {
            return Err(failed(&device.config.name, &fault));
        }
        device.device.close().map_err(|fault| failed(&device.config.name, &fault))?;
    }
    look(a, &mut cameras, &mut *clock, &interrupt)?;
    interrupt.code().map_or(Ok(()), |code| Err(Failure::silent(code)))
}

/// Reads every camera as often as a device is read, and reports counts of its frames.
fn look(
    a: &Check,
    cameras: &mut Cameras,
    clock: &mut dyn Clock,
    interrupt: &Interrupt,
) -> Result<(), Failure> {
    let before: Vec<_> = cameras.streams().map(|stream| stream.counts).collect();
    let begun = clock.now();
    let (mut rgb, mut depth) = (Vec::new(), Vec::new());
    let streams: Vec<_> = cameras
        .streams()
        .map(|Streamed { camera, which, format, .. }| (camera.to_owned(), which, format))
        .collect();
    let mut faults: Vec<(u32, Option<CameraError>)> = vec![(0, None); streams.len()];
    let mut lost = None;
    for _ in 0..if streams.is_empty() { 0 } else { a.samples } {
        if interrupt.code().is_some() {
            break;
        }
        lost = None;
        for ((camera, which, format), (count, last)) in streams.iter().zip(&mut faults) {
            let colours = *which == "rgb";
            let wanted = Wanted { rgb: colours.then_some(&mut rgb), depth: (!colours).then_some(&mut depth) };
            if let Err(error) = cameras.take(camera, [format.height, format.width], wanted) {
                *count += 1;
                *last = Some(error.clone());
                lost = Some(error);
            }
        }
        clock.wait(1.0 / a.rate);
    }
    let seconds = clock.now() - begun;
    for ((stream, before), (faults, last)) in cameras.streams().zip(before).zip(faults) {
        let (frames, dropped) =
            (stream.counts.frames - before.frames, stream.counts.dropped - before.dropped);
        let damaged = stream.counts.damaged - before.damaged;
        let Streamed { camera, which, format, counts } = stream;
        let last = last.map(|error| error.fault);
        if a.json {
            show_json(&json!({
                "camera": camera, "stream": which, "encoding": format.encoding.to_string(), "width": format.width,
                "height": format.height, "rate": format.rate, "seconds": seconds, "frames": frames, "dropped": dropped,
                "damaged": damaged, "longest_interval": counts.longest, "faults": faults,
                "fault": last.map(|fault| json!({"kind": fault.kind(), "text": fault.to_string()})),
            }));
            continue;
        }
        show!(
            "{camera} ({which}): {} {} x {} at {} Hz",
            format.encoding,
            format.width,
            format.height,
            format.rate
        );
        show!("  frames      {frames} in {seconds:.2} s, {dropped} dropped, {damaged} damaged");
        show!("  interval    {:.1} ms at most between two frames", counts.longest * 1e3);
        let last = last.map_or_else(String::new, |fault| format!(", the last: {fault}"));
        show!("  reads       {faults} of {} failed{last}", a.samples);
    }
    lost.map_or(Ok(()), |error| Err(Failure::new(error)))
}

fn report(a: &Check, device: &Connected, answers: &Answers) {
    let (name, kind) = (&device.config.name, device.config.interface.kind.as_deref().unwrap_or_default());
    let [p50, p99, most] = [0.5, 0.99, 1.0].map(|share| answers.quantile(share));
    let (sensors, actuators) = (device.config.sensors.len(), device.config.actuators.len());
    if a.json {
        show_json(&json!({
            "device": name, "kind": kind, "sensors": sensors, "actuators": actuators, "readings": answers.latencies.len(),
            "faults": answers.faults, "fault": answers.fault.as_ref().map(|fault| json!({"kind": fault.kind(), "text": fault.to_string()})),
            "missed_ticks": answers.missed, "latencies_ms":
            answers.latencies.iter().map(|latency| latency * 1e3).collect::<Vec<_>>(),
        }));
        return;
    }
    show!("{name} ({kind}): {sensors} sensors, {actuators} actuators");
    let fault = answers.fault.as_ref().map_or_else(String::new, |fault| format!(", the last: {fault}"));
    show!("  readings    {} of {}, {} faults{fault}", answers.latencies.len(), a.samples, answers.faults);
    show!("  latency     {p50:.2} ms at the median, {p99:.2} ms at 99 %, {most:.2} ms at most");
    show!("  ticks       {} missed at {} Hz", answers.missed, a.rate);
}

fn monitor(a: &Monitor) -> Result<(), Failure> {
    let Reached { mut devices, mut clock, .. } = a.devices.reach(READING.setup())?;
    if devices.is_empty() {
        return Err(Failure::usage(
            "the chosen devices are cameras, which have no sensors to show: `robohive hardware check` looks through them",
        ));
    }
    let interrupt = Interrupt::listen().map_err(Failure::new)?;
    let begun = clock.now();
    let terminal = std::io::stdout().is_terminal();
    let mut lines = 0;
    let seconds = a.seconds.unwrap_or(if terminal { f64::INFINITY } else { 0.0 });
    while interrupt.code().is_none() && (lines == 0 || clock.now() - begun < seconds) {
        if terminal && lines > 0 {
            // Back over the table that stands there.
            print!("\x1b[{lines}A");
        }
        lines = 0;
        for device in &mut devices {
            let state = match device.read() {
                Ok(time) => format!("{time:.2} s"),
                Err(fault) => fault.to_string(),
            };
            show!("{} {state:<60}", device.config.name);
            for (k, sensor) in device.config.sensors.iter().enumerate() {
                show!(
                    "  {:<28} {:>10.4}  ({:.4} on the device)      ",
                    sensor.name,
                    device.value(k),
                    device.values[k]
                );
            }
            lines += 1 + device.config.sensors.len();
        }
        clock.wait(1.0 / a.rate);
    }
    devices
        .iter_mut()
        .try_for_each(|device| device.device.close().map_err(|fault| failed(&device.config.name, &fault)))
}

fn home(a: &Home) -> Result<(), Failure> {
    let interrupt = Interrupt::listen().map_err(Failure::new)?;
    let Reached { mut devices, .. } = a.devices.reach(a.arming.setup_until(&interrupt))?;
    if devices.iter().all(|device| device.config.actuators.is_empty()) {
        return Err(Failure::usage("the chosen devices have no actuators to move"));
    }
    for device in devices.iter_mut().filter(|device| !device.config.actuators.is_empty()) {
        let targets: Vec<_> = device.config.actuators.iter().map(middle).collect();
        device.device.reset(&targets).map_err(|fault| Failure {
            code: interrupt.code().unwrap_or(1),
            ..failed(&device.config.name, &fault)
        })?;
        device.read().map_err(|fault| failed(&device.config.name, &fault))?;
        show!("{}: {} actuators at the middle of their ranges", device.config.name, targets.len());
    }
    devices
        .iter_mut()
        .try_for_each(|device| device.device.close().map_err(|fault| failed(&device.config.name, &fault)))
}

/// The middle of an actuator's range, in the units of the device.
fn middle(actuator: &robot::ActuatorConfig) -> f64 {
    let [low, high] = actuator.position_range;
    (low + high) / 2.0 * actuator.scale + actuator.offset
}

fn flight(a: &Flight) -> Result<(), Failure> {
    let entries = read(&a.file).map_err(Failure::usage)?;
    let first = a.last.map_or(0, |last| entries.len().saturating_sub(last));
    for entry in &entries[first..] {
        let (what, content) = match &entry.what {
            What::Reading(values) => ("reading", format!("{values:.5?}")),
            What::Command(values) => ("command", format!("{values:.5?}")),
            What::Fault(text) => ("fault", text.clone()),
            What::Note(text) => ("note", text.clone()),
        };
        show!("{:>9} {:>10.4} s  {what:<8} {content}", entry.number, entry.time);
    }
    show!("{} records of {}", entries.len() - first, a.file.display());
    Ok(())
}
