//! Seeded faults on the links of every driver, in virtual time: what becomes of the commands, and of the robot.
//!
//! `cargo run --profile ci -p robohive-library --example faults -- 10000`
//!
//! Each episode arms the devices and moves them while faults of all kinds are injected. It must end in a typed error that names the
//! device, or well; what motors are told stays within the ranges of the config, and the end effector of an arm in its box; and when the faults have ended the motors are told to
//! stay where they are within a second of the error, and the next reset works.

use env::{Env, Options, OwnModels};
use hardware::{Setup, registry};
use protocol::franka::flange;
use robohive_library::Rehearsal;
use robot::{Config, Robot};
use std::error::Error;
use std::sync::Arc;
use wire::Rates;

/// Faults of a serial line, which carries a hundred messages a second.
const LINE: &str = "drop=0.002,delay=0.0005,reorder=0.0005,duplicate=0.002,corrupt=0.002,truncate=0.001,stall=0.0001,\
                    disconnect=0.0001,stop=0.00005";
/// Faults of an arm's network, which carries two thousand.
const NETWORK: &str = "drop=0.002,delay=0.001,reorder=0.001,duplicate=0.002,corrupt=0.001,truncate=0.001,stall=0.00002,\
                       disconnect=0.00002,stop=0.00001";
/// A box of the arm's fingertips that the motion stays in, and one that it is commanded out of \[m\].
const WIDE: Bounds = [[0.3, 0.8], [-0.4, 0.4], [0.1, 1.0]];
const TIGHT: Bounds = [[0.3, 0.75], [-0.25, 0.25], [0.3, 0.8]];
/// How far the fingertips are from the flange \[m\].
const FINGERTIPS: f64 = 0.1034;
/// Control periods of an episode.
const STEPS: u32 = 30;
/// How long after an error motors may still be told to move \[s\].
const SAFE: f64 = 1.0;
/// For how long they must then be told the same \[s\].
const STILL: f64 = 0.2;

/// Smallest and largest coordinate along each axis \[m\].
type Bounds = [[f64; 2]; 3];

/// What happened to one driver.
#[derive(Default)]
struct Tally {
    faults: u64,
    episodes: u32,
    errors: u32,
    /// Errors that do not name the device.
    nameless: u32,
    /// Largest distance of a command that reached a motor from its range \[rad\].
    beyond: f64,
    /// Largest distance of what an arm was commanded from its box \[m\].
    outside: f64,
    /// Times that motors were told to move on after an error.
    restless: u32,
    /// Resets that failed although the faults had ended.
    lost: u32,
}

/// A driver, the environment whose model its devices move, and its config.
struct Case {
    name: &'static str,
    id: &'static str,
    config: Config,
    rates: &'static str,
    bounds: Option<Bounds>,
}

fn cases() -> Result<Vec<Case>, Box<dyn Error>> {
    let servos = include_str!("../../../assets/quadruped/servos.toml").replace("\"off\"", "\"hold\"");
    let legs = |name, interface| -> Result<Case, Box<dyn Error>> {
        let config = Config::from_toml(&servos.replace("\"dynamixel\"", interface), "servos.toml")?;
        Ok(Case { name, id: "hive/QuadrupedWalk-v0", config, rates: LINE, bounds: None })
    };
    let arm = |name, bounds: Bounds| -> Result<Case, Box<dyn Error>> {
        let text = include_str!("../../../assets/franka/tasks/hardware.toml")
            .replace(
                "hand = true",
                &format!("hand = true, reset_time = 2.0, box = {:?}", bounds.as_flattened()),
            )
            .replace("\"impedance\"", "\"position\"");
        let config = Config::from_toml(&text, "hardware.toml")?;
        Ok(Case { name, id: "hive/FrankaReach-v0", config, rates: NETWORK, bounds: Some(bounds) })
    };
    Ok(vec![
        legs("dynamixel", "\"dynamixel\"")?,
        legs("dynamixel, protocol 1.0", "\"dynamixel\", model = \"MX-28\"")?,
        legs("feetech", "\"feetech\"")?,
        arm("franka", WIDE)?,
        arm("franka, in a tight box", TIGHT)?,
        with_robotiq(arm("franka, robotiq", WIDE)?)?,
    ])
}

/// An arm with a Robotiq gripper on a serial line instead of its own hand: the model's fingers are closed at its width 0 and
/// open at 85 mm.
fn with_robotiq(mut case: Case) -> Result<Case, Box<dyn Error>> {
    let gripper = "
        [[device]]
        name = 'robotiq'
        interface = { type = 'robotiq', name = '/dev/ttyUSB0' }
        sensor = [{ name = 'gripper_position', range = [0.0, 0.05], hdr_id = 0, scale = 0.470588 }]
        actuator = [{ name = 'gripper', pos_range = [0.0, 0.04], vel_range = [-0.1, 0.1], hdr_id = 0, scale = 2.125 }]";
    let arm = &mut case.config.devices[0];
    arm.interface.parameters.remove("hand");
    arm.sensors.retain(|sensor| sensor.name != "gripper_position");
    arm.actuators.retain(|actuator| actuator.name != "gripper");
    case.config.devices.extend(Config::from_toml(gripper, "robotiq.toml")?.devices);
    Ok(case)
}

fn main() -> Result<(), Box<dyn Error>> {
    let wanted: u64 = std::env::args().nth(1).map_or(Ok(1000), |count| count.parse())?;
    let cases = cases()?;
    let share = wanted.div_ceil(cases.len() as u64);
    println!(
        "| driver | faults | episodes | ended by an error | without the device's name | commands beyond their range | outside the box | not stopped | lost |"
    );
    println!("|---|---|---|---|---|---|---|---|---|");
    let mut sound = true;
    for case in &cases {
        let mut tally = Tally::default();
        let mut seed = 0;
        while tally.faults < share {
            seed += 1;
            if seed % 50 == 0 {
                eprintln!("{}: {} of {share} faults in {} episodes", case.name, tally.faults, tally.episodes);
            }
            strike(case, seed, &mut tally)?;
        }
        let Tally { faults, episodes, errors, nameless, beyond, outside, restless, lost } = tally;
        println!(
            "| {} | {faults} | {episodes} | {errors} | {nameless} | {beyond:.4} rad | {outside:.4} m | {restless} | {lost} |",
            case.name
        );
        sound &= nameless == 0 && beyond < 2e-3 && outside == 0.0 && restless == 0 && lost == 0;
    }
    if sound { Ok(()) } else { Err("a driver did what it must not do".into()) }
}

/// One robot, one seed: an episode under faults, then one without.
fn strike(case: &Case, seed: u64, tally: &mut Tally) -> Result<(), Box<dyn Error>> {
    let mut env = Env::make(case.id, &OwnModels, &Options::default())?;
    let rehearsal = Rehearsal::new(&case.config, &mut env)?;
    let mut setup = Setup::default().with_armed(true);
    setup.say = Arc::new(|_| {});
    let registry = registry(&rehearsal.setup(setup));
    let options = robot::Options::default().with_hardware(true);
    let (model, data) = (env.scene().model.clone(), env.scene().data.clone());
    let mut rng = random::Generator::pcg64(seed);
    let mut robot = Robot::with_devices(&model, Some(&case.config), options, &registry)?;
    let mut clock = rehearsal.clock();
    let mut mirror = data.clone();
    rehearsal.inject(case.rates.parse::<Rates>()?, seed);
    tally.episodes += 1;
    let mut failed = robot.reset(&model, &data, &mut rng).err();
    for k in 0..STEPS {
        if failed.is_some() {
            break;
        }
        let action: Vec<f64> = (0..model.nu).map(|j| 0.15 * (0.2 * f64::from(k) + j as f64).sin()).collect();
        failed = robot.control(&model, &mirror, &action, 0.05).err();
        clock.wait(0.05);
        robot.sense(&model, &mirror, &mut rng);
        robot.write_readings(&mut mirror);
        tally.beyond = tally.beyond.max(beyond(case, &rehearsal));
        if let Some(bounds) = &case.bounds {
            tally.outside = tally.outside.max(outside(bounds, &rehearsal));
        }
    }
    tally.faults += rehearsal.struck();
    rehearsal.inject(Rates::default(), 0);
    rehearsal.bench().stop_button(false);
    if let Some(error) = &failed {
        tally.errors += 1;
        let text = error.to_string();
        tally.nameless += u32::from(!case.config.devices.iter().any(|device| text.contains(&device.name)));
    }
    if failed.is_some() {
        clock.wait(SAFE);
        let told = commands(&rehearsal);
        clock.wait(STILL);
        tally.restless += u32::from(told != commands(&rehearsal));
    }
    let again = robot.reset(&model, &data, &mut rng).err();
    if let Some(error) = again {
        println!("lost, {} seed {seed}: {error}", case.name);
        tally.lost += 1;
    }
    robot.close()?;
    Ok(())
}

/// How far the farthest command of the plant is from the range that the config has for it.
fn beyond(case: &Case, rehearsal: &Rehearsal) -> f64 {
    let bench = rehearsal.bench();
    let actuators = case.config.devices.iter().flat_map(|device| &device.actuators);
    let distance = actuators.filter_map(|actuator| {
        let motor = bench.plant().motor(&actuator.name).ok()?;
        let [low, high] = actuator.position_range;
        let told = bench.plant().data().state.ctrl[bench.plant().model().actuator_ctrladr[motor] as usize];
        Some((low - told).max(told - high))
    });
    distance.fold(0.0, f64::max)
}

/// How far from its box the fingertips are where the arm is commanded to be.
fn outside(bounds: &Bounds, rehearsal: &Rehearsal) -> f64 {
    let told = commands(rehearsal);
    let Some(q) = told.first_chunk::<7>() else { return f64::INFINITY };
    let pose = flange(q);
    let axis = |k: usize| {
        let (place, [low, high]) = (pose[12 + k] + FINGERTIPS * pose[8 + k], bounds[k]);
        (low - place).max(place - high)
    };
    (0..3).map(axis).fold(0.0, f64::max)
}

/// What the motors are told.
fn commands(rehearsal: &Rehearsal) -> Vec<f64> {
    rehearsal.bench().plant().data().state.ctrl.to_vec()
}
