//! `hardware calibrate`: scales and offsets of joints, from poses in which a person holds the robot.

use crate::failure::{Failure, unwritable};
use crate::output::{check_place, keep_existing, keep_input};
use crate::robots::devices::{Connected, Devices, Reached, failed};
use crate::robots::live::READING;
use crate::terminal::{note, show};
use ::hardware::calibration::{Fit, Joint, Measured, SERVOS, adopt, fit, joints};
use clap::{Args, ValueHint};
use library::Rehearsal;
use robot::{Clock, Config};
use std::io::BufRead;
use std::path::PathBuf;

/// Time between two readings of a pose \[s\].
const PERIOD: f64 = 0.01;

/// What calibrating needs.
#[derive(Args)]
pub struct Calibrate {
    #[command(flatten)]
    devices: Devices,
    /// Write the config with the new scales and offsets to this file (TOML; comments are not kept)
    #[arg(long, value_name = "FILE", value_hint = ValueHint::FilePath)]
    out: PathBuf,
    /// Replace the file if it exists
    #[arg(long)]
    force: bool,
    /// A pose to hold, in this order: lower or upper, the ends of the config's ranges, zero, or joint=value,… in the model's units;
    /// lower and upper without any. One pose gives the offset, two which way the joint counts as well
    #[arg(long = "pose", value_name = "POSE", value_parser = pose)]
    poses: Vec<Pose>,
    /// Readings of each pose
    #[arg(long, value_name = "N", default_value_t = 50, value_parser = clap::value_parser!(u32).range(1..=100_000))]
    samples: u32,
    /// Refuse joints that are farther from a pose than this, or move by more while they are read [rad, m]
    #[arg(long, value_name = "DISTANCE", default_value_t = 0.1, value_parser = tolerance)]
    tolerance: f64,
    /// In a rehearsal, mount the simulated devices as this config says, which the new one is to find
    #[arg(long, value_name = "CONFIG", value_hint = ValueHint::FilePath, requires = "rehearse")]
    mounted: Option<PathBuf>,
}

fn tolerance(text: &str) -> Result<f64, String> {
    let tolerance = text.parse::<f64>().ok().filter(|distance| *distance > 0.0 && distance.is_finite());
    tolerance.ok_or_else(|| "it must be a number above 0".to_owned())
}

/// Where the joints are held.
#[derive(Clone, Debug, PartialEq)]
enum Pose {
    Lower,
    Upper,
    Zero,
    Given(Vec<(String, f64)>),
}

fn pose(text: &str) -> Result<Pose, String> {
    match text {
        "lower" => return Ok(Pose::Lower),
        "upper" => return Ok(Pose::Upper),
        "zero" => return Ok(Pose::Zero),
        _ => {}
    }
    let entry = |entry: &str| {
        let (name, value) = entry.split_once('=')?;
        let value = value.trim().parse::<f64>().ok().filter(|value| value.is_finite())?;
        Some((name.trim().to_owned(), value))
    };
    let given = text.split(',').map(entry).collect::<Option<Vec<_>>>();
    given
        .map(Pose::Given)
        .ok_or_else(|| format!("'{text}' is no pose: lower, upper, zero, or joint=value as hip=0.5,knee=-1"))
}

impl Pose {
    /// Where a joint of this name and range is held; `None` if it is not.
    fn position(&self, name: &str, range: [f64; 2]) -> Option<f64> {
        match self {
            Pose::Lower => Some(range[0]),
            Pose::Upper => Some(range[1]),
            Pose::Zero => Some(0.0),
            Pose::Given(given) => given.iter().find(|(joint, _)| joint == name).map(|(_, value)| *value),
        }
    }
}

/// A joint under calibration.
struct Held {
    device: usize,
    joint: Joint,
    name: String,
    range: [f64; 2],
    scale: f64,
    measured: Vec<Measured>,
    /// Where the present pose has it.
    position: Option<f64>,
}

/// Runs the command.
pub fn run(a: &Calibrate) -> Result<(), Failure> {
    keep_input(&a.devices.config, &a.out)?;
    check_place(&a.out)?;
    keep_existing(&a.out, a.force)?;
    let Reached { mut devices, mut clock, rehearsal, .. } =
        a.devices.reach_mounted(READING.setup(), a.mounted.as_deref())?;
    let mut held = all_joints(&devices);
    let ends = [Pose::Lower, Pose::Upper];
    let poses = if a.poses.is_empty() { &ends[..] } else { &a.poses };
    check_names(poses, &held)?;
    note("nothing has torque that was not given any; switch the robot off and on where a joint resists");
    for (number, pose) in poses.iter().enumerate() {
        held.iter_mut().for_each(|joint| joint.position = pose.position(&joint.name, joint.range));
        show!("pose {} of {}", number + 1, poses.len());
        for (name, position) in held.iter().filter_map(|joint| Some((&joint.name, joint.position?))) {
            show!("  {name:<28} {position:>9.4}");
        }
        if rehearsal.is_none() {
            wait_for_person()?;
        }
        measure(a, &mut devices, &mut held, clock.as_mut(), rehearsal.as_ref())?;
    }
    for device in &mut devices {
        device.device.close().map_err(|fault| failed(&device.config.name, &fault))?;
    }
    let mut config = Config::read(&a.devices.config).map_err(Failure::usage)?;
    found(a, &devices, &held, &mut config)?;
    std::fs::write(&a.out, config.to_toml()).map_err(unwritable(&a.out))?;
    show!("config: {}", a.out.display());
    Ok(())
}

fn all_joints(devices: &[Connected]) -> Vec<Held> {
    let of_device = |(device, connected): (usize, &Connected)| {
        let actuators = connected.config.actuators.clone();
        joints(&connected.config).into_iter().map(move |joint| {
            let actuator = &actuators[joint.actuator];
            let (name, range, scale) = (actuator.name.clone(), actuator.position_range, actuator.scale);
            Held { device, joint, name, range, scale, measured: Vec::new(), position: None }
        })
    };
    devices.iter().enumerate().flat_map(of_device).collect()
}

/// Poses may name joints alone that there are, at places within their ranges.
fn check_names(poses: &[Pose], held: &[Held]) -> Result<(), Failure> {
    if held.is_empty() {
        return Err(Failure::usage(format!(
            "no servo ({}) is commanded by position and has a sensor that reads it",
            SERVOS.join(", ")
        )));
    }
    let names = || held.iter().map(|joint| joint.name.as_str()).collect::<Vec<_>>().join(", ");
    for pose in poses {
        match pose {
            Pose::Given(given) => {
                if let Some((unknown, _)) =
                    given.iter().find(|(name, _)| held.iter().all(|h| h.name != *name))
                {
                    return Err(Failure::usage(format!(
                        "no joint that can be calibrated is named '{unknown}'; there are {}",
                        names()
                    )));
                }
                let outside = |joint: &&Held| {
                    pose.position(&joint.name, joint.range)
                        .is_some_and(|place| !(joint.range[0]..=joint.range[1]).contains(&place))
                };
                if let Some(joint) = held.iter().find(outside) {
                    return Err(Failure::usage(format!(
                        "the pose of '{}' is outside its range, {:?}; poses are in the model's units, rad or m",
                        joint.name, joint.range
                    )));
                }
            }
            Pose::Zero => {
                let outside = |joint: &&Held| !(joint.range[0]..=joint.range[1]).contains(&0.0);
                if let Some(joint) = held.iter().find(outside) {
                    return Err(Failure::usage(format!(
                        "zero is outside the range of '{}', {:?}; name a pose as {}=value",
                        joint.name, joint.range, joint.name
                    )));
                }
            }
            Pose::Lower | Pose::Upper => {}
        }
    }
    Ok(())
}

fn wait_for_person() -> Result<(), Failure> {
    note("move the joints there by hand, hold them, and press Enter");
    let mut line = String::new();
    match std::io::stdin().lock().read_line(&mut line) {
        Ok(0) => Err(Failure::new("nobody is there to hold the pose: standard input has ended")),
        Ok(_) => Ok(()),
        Err(error) => Err(Failure::new(error)),
    }
}

/// Reads the joints of a pose, and keeps the mean.
fn measure(
    a: &Calibrate,
    devices: &mut [Connected],
    held: &mut [Held],
    clock: &mut dyn Clock,
    rehearsal: Option<&Rehearsal>,
) -> Result<(), Failure> {
    let mut readings = vec![Vec::new(); held.len()];
    for _ in 0..a.samples {
        if let Some(rehearsal) = rehearsal {
            hold(rehearsal, held)?;
        }
        for device in devices.iter_mut() {
            device.read().map_err(|fault| failed(&device.config.name, &fault))?;
        }
        for (joint, readings) in held.iter().zip(&mut readings) {
            readings.push(devices[joint.device].values[joint.joint.sensor]);
        }
        clock.wait(PERIOD);
    }
    for (joint, readings) in held.iter_mut().zip(&readings) {
        let Some(position) = joint.position else { continue };
        let least = readings.iter().copied().fold(f64::INFINITY, f64::min);
        let most = readings.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let swept = (most - least) / joint.scale.abs();
        if swept > a.tolerance {
            return Err(Failure::new(format!(
                "'{}' moved by {swept:.3} while it was read; hold it still",
                joint.name
            )));
        }
        let reading = readings.iter().sum::<f64>() / readings.len() as f64;
        joint.measured.push(Measured { position, reading });
    }
    Ok(())
}

/// The person who holds the simulated robot.
fn hold(rehearsal: &Rehearsal, held: &[Held]) -> Result<(), Failure> {
    let mut bench = rehearsal.bench();
    let plant = bench.plant_mut();
    let mut places = Vec::new();
    for (name, position) in held.iter().filter_map(|joint| Some((&joint.name, joint.position?))) {
        places.push((plant.motor(name).map_err(Failure::usage)?, position));
    }
    plant.hold(&places).map_err(Failure::new)
}

/// Fits, shows and adopts every joint that was held.
fn found(a: &Calibrate, devices: &[Connected], held: &[Held], config: &mut Config) -> Result<(), Failure> {
    show!("{:<28} {:>7} {:>9} {:>10} {:>10}", "joint", "scale", "offset", "was", "residual");
    let mut wrong = None;
    for joint in held.iter().filter(|joint| !joint.measured.is_empty()) {
        let device = &devices[joint.device].config;
        let refuse = |error| Failure::new(format!("'{}' of device '{}': {error}", joint.name, device.name));
        let fit = fit(joint.scale, &joint.measured).map_err(refuse)?;
        let worst = fit.residuals.iter().map(|residual| residual.abs()).fold(0.0, f64::max);
        show_fit(joint, &fit, device.actuators[joint.joint.actuator].offset, worst);
        if worst > a.tolerance {
            wrong.get_or_insert((joint, worst));
        }
        let Some(target) = config.devices.iter_mut().find(|other| other.name == device.name) else {
            continue;
        };
        adopt(target, &joint.joint, &fit);
    }
    match wrong {
        None => Ok(()),
        Some((joint, worst)) => Err(Failure::new(format!(
            "'{}' was {worst:.3} away from a pose; nothing is written: hold the poses better, or check the ranges and the scale",
            joint.name
        ))),
    }
}

fn show_fit(joint: &Held, fit: &Fit, before: f64, worst: f64) {
    let way = match fit.moved {
        None => "  (one pose: the way is the config's)",
        Some(_) if fit.scale.signum() != joint.scale.signum() => "  (it counts the other way)",
        Some(_) => "",
    };
    show!("{:<28} {:>7.3} {:>9.4} {before:>10.4} {worst:>10.4}{way}", joint.name, fit.scale, fit.offset);
}
