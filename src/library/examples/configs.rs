//! RoboHive's own robot configs on simulated devices, beside the simulation: the same environment, seed and actions.
//!
//! `ROBOHIVE_STORE=FOLDER cargo run --release -p robohive-library --example configs`
//!
//! The store has RoboHive's models (`robohive assets import`). Each line is the first episode with zero actions: the largest difference
//! between the joint positions that devices read and those of the simulation at the end, and the return of both.

use env::{Assets, Env, Options};
use hardware::Setup;
use robohive_library::{Library, Rehearsal};
use robot::Config;
use std::error::Error;
use std::sync::Arc;

/// Environments, and the configs that RoboHive has for their robots.
const CASES: [(&str, &str); 9] = [
    ("DKittyStandFixed-v0", "envs/quadrupeds/dkitty/dkitty_stand_v0.config"),
    ("DKittyWalkFixed-v0", "envs/quadrupeds/dkitty/dkitty_walk_v0.config"),
    ("FrankaReachFixed-v0", "envs/arms/franka/assets/franka_reach_v0.config"),
    ("FrankaPushFixed-v0", "envs/arms/franka/assets/franka_ycb_v0.config"),
    ("FrankaPickPlaceFixed-v0", "envs/arms/franka/assets/franka_busbin_v0.config"),
    ("rpFrankaDmanusPoseFixed-v0", "envs/fm/assets/franka_dmanus.config"),
    ("rpFrankaRobotiqData-v0", "envs/fm/assets/franka_robotiq.config"),
    ("FK1_MicroOpenFixed-v4", "envs/multi_task/common/microwave/franka_microwave.config"),
    ("FK1_SdoorOpenFixed-v4", "envs/multi_task/common/slidecabinet/franka_slidecabinet.config"),
];

/// Most steps of an episode.
const STEPS: usize = 50;

fn main() -> Result<(), Box<dyn Error>> {
    let library = Library::from_environment(None, None)?;
    println!(
        "| config | environment | devices | steps | largest joint difference at the end [rad] | return | in simulation |"
    );
    println!("|---|---|---|---|---|---|---|");
    for (id, path) in CASES {
        let text = String::from_utf8(library.read(path)?.to_vec())?;
        let config = Config::from_literal(&text, path)?;
        // The devices move an environment of their own; `simulated` is the one for comparison.
        let mut world = Env::make(id, &library, &Options::default())?;
        let rehearsal = Rehearsal::new(&config, &mut world)?;
        let mut setup = Setup::default().with_armed(true);
        setup.say = Arc::new(|_| {});
        let hardware = rehearsal.hardware(config.clone(), setup, None);
        let mut live = Env::make(id, &library, &Options::default().with_hardware(Some(hardware)))?;
        let mut simulated = Env::make(id, &library, &Options::default())?;
        let (mut returns, mut steps) = ([0.0; 2], [0; 2]);
        for (k, env) in [&mut live, &mut simulated].into_iter().enumerate() {
            env.reset(Some(0))?;
            let action = vec![0.0; env.action_len()];
            while steps[k] < STEPS {
                let step = env.step(&action)?;
                (returns[k], steps[k]) = (returns[k] + step.reward, steps[k] + 1);
                if step.terminated || step.truncated {
                    break;
                }
            }
        }
        let positions = [&live, &simulated].map(|env| &env.scene().data.state.qpos);
        let model = &live.scene().model;
        let joints = config.devices.iter().flat_map(|device| device.on_hardware().actuators);
        let apart = joints.filter_map(|actuator| {
            let joint = model.actuator_trnid[model.actuator(&actuator.name)?.index()][0];
            let place = model.jnt_qposadr[usize::try_from(joint).ok()?] as usize;
            Some((positions[0][place] - positions[1][place]).abs())
        });
        let apart = apart.fold(0.0, f64::max);
        let driven = config.devices.iter().filter_map(|device| device.interface.kind.as_deref());
        let kinds = driven.fold(Vec::new(), |mut kinds: Vec<&str>, kind| {
            if !kinds.contains(&kind) {
                kinds.push(kind);
            }
            kinds
        });
        println!(
            "| `{path}` | {id} | {} | {} and {} | {apart:.4} | {:.3} | {:.3} |",
            kinds.join(", "),
            steps[0],
            steps[1],
            returns[0],
            returns[1]
        );
    }
    Ok(())
}
