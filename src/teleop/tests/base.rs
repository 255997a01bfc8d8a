//! A quadruped that trots by velocity, on a virtual clock: how well it follows.

#[path = "../examples/demonstrations/steer.rs"]
mod steer;

use env::{Arguments, Env, Options, OwnModels};
use physics::math::{quat_conj, quat_rotate};
use robohive_teleop::{Control, Input, Mapping, Mark, Motion, Plan, Session};
use steer::towards_target;

const ID: &str = "hive/QuadrupedWalk-v0";

fn session(settings: &str, mapping: &str) -> Session {
    let changes: Arguments = settings.parse().unwrap();
    let env = Env::make(ID, &OwnModels, &Options::default().with_changes(changes)).unwrap();
    let mapping = Mapping::from_toml(mapping, "base.toml").unwrap();
    Session::new(env, Control::Base, &mapping, Plan::default()).unwrap()
}

/// Mean velocity over `seconds` [m/s, m/s, rad/s]: forward, to the left, counterclockwise, in the frame of the torso.
fn measured(session: &mut Session, base: [f64; 3], seconds: f64) -> Option<[f64; 3]> {
    let input = Input { motion: Motion { base, ..Motion::default() }, marks: Vec::new() };
    let ticks = (seconds / session.env().dt()).round() as usize;
    let mut sum = [0.0; 3];
    for _ in 0..ticks {
        let before = session.env().scene().data.state.clone();
        let ticked = session.tick(&input).unwrap();
        if ticked.finished.is_some() {
            return None;
        }
        let after = &session.env().scene().data.state;
        let dt = session.env().dt();
        let turned = [before.qpos[3], before.qpos[4], before.qpos[5], before.qpos[6]];
        let way = [0, 1, 2].map(|k| (after.qpos[k] - before.qpos[k]) / dt);
        let [right, ahead, _] = quat_rotate(quat_conj(turned), way);
        let yaw =
            |q: &[f64]| (2.0 * (q[3] * q[6] + q[4] * q[5])).atan2(1.0 - 2.0 * (q[5] * q[5] + q[6] * q[6]));
        let mut turn = yaw(&after.qpos) - yaw(&before.qpos);
        turn -= (turn / std::f64::consts::TAU).round() * std::f64::consts::TAU;
        for (sum, x) in sum.iter_mut().zip([ahead, -right, turn / dt]) {
            *sum += x / ticks as f64;
        }
    }
    Some(sum)
}

/// Largest velocities of the usual mapping.
const LARGEST: [f64; 3] = [0.2, 0.1, 0.5];

#[test]
fn the_robot_goes_as_fast_as_it_is_told() {
    // At the ten actions a second of the environment, and at fifty.
    for (skip, rate) in [(40, 10), (8, 50)] {
        let mut worst = [0.0_f64; 3];
        for base in [
            [1.0, 0.0, 0.0],
            [0.5, 0.0, 0.0],
            [-1.0, 0.0, 0.0],
            [0.0, 1.0, 0.0],
            [0.0, -1.0, 0.0],
            [0.0, 0.0, 1.0],
            [0.0, 0.0, -1.0],
            [0.7, 0.0, 0.7],
            [0.7, 0.7, 0.0],
        ] {
            let mut session = session(&format!("frame_skip = {skip}\nmax_episode_steps = 10000"), "");
            measured(&mut session, base, 2.0).unwrap();
            let got = measured(&mut session, base, 5.0).expect("it does not fall");
            let told: Vec<f64> = base.iter().zip(LARGEST).map(|(part, most)| part * most).collect();
            println!("{rate} Hz: told {told:.2?}, goes {got:.3?} m/s, m/s, rad/s");
            for k in 0..3 {
                worst[k] = worst[k].max((got[k] - told[k]).abs());
            }
            // Without input, it stands.
            measured(&mut session, [0.0; 3], 1.0).unwrap();
            let rest = measured(&mut session, [0.0; 3], 1.0).unwrap();
            assert!(rest.iter().all(|x| x.abs() < 0.01), "{rest:?}");
        }
        println!("{rate} Hz: at most {worst:.3?} off");
        for (off, most) in worst.into_iter().zip(LARGEST) {
            assert!(off < most / 4.0, "a quarter of the largest velocity: {worst:?}");
        }
    }
}

#[test]
fn a_person_who_steers_walks_to_the_targets_of_the_task() {
    let mut steps = Vec::new();
    for seed in 0..10 {
        let mut session = session("max_episode_steps = 10000\nframe_skip = 40", "");
        for _ in 0..seed {
            session.tick(&Input { marks: vec![Mark::Skip], ..Input::default() }).unwrap();
        }
        let taken = (1..=400).find(|_| {
            let base = towards_target(session.env());
            let ticked =
                session.tick(&Input { motion: Motion { base, ..Motion::default() }, marks: vec![] }).unwrap();
            assert!(ticked.finished.is_none(), "seed {seed}: it falls");
            session.env().verdict().solved
        });
        steps.push(taken);
    }
    println!("steps of 0.1 s to the target: {steps:?}");
    assert!(steps.iter().all(Option::is_some), "{steps:?}");
}

#[test]
fn a_robot_without_four_legs_is_refused_by_what_it_lacks() {
    for (id, says) in [("hive/ElbowPose-v0", "free joint"), ("hive/FrankaReach-v0", "free joint")] {
        let env = Env::make(id, &OwnModels, &Options::default()).unwrap();
        let error = Session::new(env, Control::Base, &Mapping::default(), Plan::default()).err().unwrap();
        assert!(error.to_string().contains(says), "{error}");
    }
    let wrong = Mapping::from_toml("[base]\nspeed = 1", "base.toml").unwrap_err().to_string();
    assert!(wrong.contains("[base] speed is unknown; the entries are forward"), "{wrong}");
    let wrong = Mapping::from_toml("[keyboard]\nw = ['+y', '+ahead']", "base.toml").unwrap_err().to_string();
    assert!(wrong.contains("+forward"), "{wrong}");
}
