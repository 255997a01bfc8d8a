//! The tasks of the claw, on a claw of one finger whose valve hangs and swings by itself.

use mjcf::Loader;
use mjcf::files::Memory;
use robohive_env::check::check;
use robohive_env::{Arguments, AssetError, Assets, Env, EnvError, Options, Registry, Spec};
use std::f64::consts::{FRAC_PI_3, FRAC_PI_6, PI, TAU};
use std::path::PathBuf;
use std::sync::Arc;

const CLAW: &str = "<mujoco>
    <compiler angle='radian'/>
    <option timestep='0.0025'/>
    <default>
        <geom type='capsule' size='.01' fromto='0 0 0 0 0 -.05' contype='0' conaffinity='0'/>
        <joint damping='.1' armature='.001'/>
        <default class='overlay'><joint damping='100' frictionloss='100'/></default>
    </default>
    <worldbody>
        <body pos='0 0 .4'><joint name='FFJ10' axis='0 1 0' range='-.45 1.35'/><geom/>
            <body pos='0 0 -.05'><joint name='FFJ11' axis='1 0 0' range='-2 2'/><geom/>
                <body pos='0 0 -.05'><joint name='FFJ12' axis='1 0 0' range='-2 2'/><geom/></body></body></body>
        <body pos='0 0 .4' childclass='overlay'><joint name='_FFJ10' axis='0 1 0'/><geom/>
            <body pos='0 0 -.05'><joint name='_FFJ11' axis='1 0 0'/><geom/>
                <body pos='0 0 -.05'><joint name='_FFJ12' axis='1 0 0'/><geom/></body></body></body>
        <body pos='1 0 .2'><joint name='valve_OBJRx' axis='0 1 0'/><geom fromto='0 0 0 .1 0 0'/></body>
        <body name='target'><site/></body>
    </worldbody>
    <actuator>
        <position joint='FFJ10' kp='2' ctrlrange='-.48 .48'/>
        <position joint='FFJ11' kp='2' ctrlrange='-1.57 1.57'/>
        <position joint='FFJ12' kp='2' ctrlrange='-1.57 1.57'/>
    </actuator></mujoco>";

const POSE: [&str; 2] = ["DClawPoseFixed-v0", "DClawPoseRandom-v0"];
const TURN: [&str; 2] = ["DClawTurnFixed-v0", "DClawTurnRandom-v0"];
const SCREW: [&str; 2] = ["DClawScrewFixed-v0", "DClawScrewRandom-v0"];

/// Places in the state.
const FINGER: std::ops::Range<usize> = 0..3;
const OVERLAY: std::ops::Range<usize> = 3..6;
const VALVE: usize = 6;

/// The claw, whatever model is asked for.
struct OneFinger;

impl Assets for OneFinger {
    fn model(&self, _: &str) -> Result<(Loader, PathBuf), AssetError> {
        let mut files = Memory::default();
        files.insert("claw.xml", CLAW.as_bytes());
        Ok((Loader::default().files(files), "claw.xml".into()))
    }

    fn read(&self, path: &str) -> Result<Arc<[u8]>, AssetError> {
        Err(format!("{path} is not here").into())
    }
}

fn make_with(id: &str, changes: &str) -> Result<Env, EnvError> {
    let fingers = if POSE.contains(&id) { "overlay_range_names = ['_FFJ10', '_FFJ12']" } else { "" };
    let text = format!("dof_range_names = ['FFJ10', 'FFJ12']\n{fingers}\n");
    let mut all: Arguments = text.parse().unwrap();
    all.extend(changes.parse::<Arguments>().unwrap());
    Env::make(id, &OneFinger, &Options::default().with_changes(all))
}

fn make(id: &str) -> Env {
    make_with(id, "").unwrap()
}

fn qpos(env: &Env) -> &[f64] {
    &env.scene().data.state.qpos
}

/// The same angle between minus half a turn and half a turn.
fn wrapped(angle: f64) -> f64 {
    (angle + PI).rem_euclid(TAU) - PI
}

#[test]
fn every_id_keeps_the_contract_and_lasts_as_long_as_robels() {
    for (ids, seconds) in [(POSE, 4.0), (TURN, 4.0), (SCREW, 8.0)] {
        for id in ids {
            let mut env = make(id);
            let report = check(&mut env, 3, 1000).unwrap();
            assert_eq!(report.violations, [], "{id}");
            assert_eq!((report.steps, report.terminated), (env.spec().max_episode_steps, 0), "{id}");
            assert!((report.steps as f64 * env.dt() - seconds).abs() < 1e-9, "{id}");
        }
    }
}

#[test]
fn actions_are_positions_over_the_ranges_of_the_actuators() {
    for id in POSE.into_iter().chain(TURN).chain(SCREW) {
        let mut env = make(id);
        env.reset(Some(1)).unwrap();
        assert_eq!(env.rows()["last_action"], [0.0; 3], "{id}");
        env.step(&[0.5, -2.0, 1.0]).unwrap();
        let expected = [0.24, -1.57, 1.57];
        let control = &env.scene().data.state.ctrl;
        assert!(control.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-15), "{id}: {control:?}");
        let action = &env.rows()["last_action"];
        assert!(action.iter().zip([0.5, -1.0, 1.0]).all(|(a, b)| (a - b).abs() < 1e-15), "{id}: {action:?}");
    }
}

#[test]
fn a_fixed_turn_is_half_a_turn() {
    let mut env = make("DClawTurnFixed-v0");
    env.reset(Some(1)).unwrap();
    assert_eq!(qpos(&env)[FINGER], [0.0, -FRAC_PI_3, FRAC_PI_3]);
    assert_eq!(qpos(&env)[VALVE], 0.0);
    assert!((env.rows()["target_error"][0] - PI).abs() < 1e-15);
    assert!((env.dense() + 5.0 * PI).abs() < 1e-14 && env.verdict().sparse.abs() < 1e-15);
    let mut world = env.world();
    world.qpos.as_mut().unwrap()[VALVE] = PI - 0.2;
    env.set_world(&world).unwrap();
    assert!((env.dense() - (10.0 - 5.0 * 0.2)).abs() < 1e-13 && !env.verdict().solved);
    world.qpos.as_mut().unwrap()[VALVE] = PI + 0.05;
    world.qpos.as_mut().unwrap()[0] = 0.3;
    env.set_world(&world).unwrap();
    assert!((env.dense() - (60.0 - 5.0 * 0.05 - 0.3)).abs() < 1e-13 && env.verdict().solved);
}

#[test]
fn random_turns_go_from_near_zero_to_near_half_a_turn() {
    let mut env = make("DClawTurnRandom-v0");
    for seed in 0..50 {
        env.reset(Some(seed)).unwrap();
        let start = qpos(&env)[VALVE];
        let target = env.rows()["target_error"][0] + start;
        assert!(start.abs() <= FRAC_PI_3, "{start}");
        assert!(wrapped(target - PI).abs() <= FRAC_PI_3 + 1e-15, "{target}");
    }
}

#[test]
fn a_screw_is_to_follow_a_mark_of_constant_velocity() {
    for id in SCREW {
        let mut env = make(id);
        env.reset(Some(8)).unwrap();
        let start = qpos(&env)[VALVE];
        assert!(env.rows()["target_error"][0].abs() < 1e-15 && env.verdict().solved);
        assert!((env.dense() - 60.0).abs() < 1e-13, "{}", env.dense());
        let mark = |env: &Env| wrapped(env.rows()["target_error"][0] + qpos(env)[VALVE]);
        let mut last = mark(&env);
        let mut steps = Vec::new();
        for _ in 0..80 {
            env.step(&[0.0; 3]).unwrap();
            steps.push(wrapped(mark(&env) - last));
            last = mark(&env);
        }
        let velocity = steps[0] / env.dt();
        assert!(steps.iter().all(|step| (step / env.dt() - velocity).abs() < 1e-13), "{steps:?}");
        if id == "DClawScrewFixed-v0" {
            assert!(start == 0.0 && (velocity - 0.5).abs() < 1e-13);
        } else {
            assert!(start.abs() <= PI && start != 0.0 && velocity.abs() <= 0.75 && velocity != 0.5);
        }
    }
}

#[test]
fn a_fixed_pose_is_shown_and_rewarded() {
    let mut env = make("DClawPoseFixed-v0");
    env.reset(Some(2)).unwrap();
    let goal = qpos(&env)[OVERLAY].to_vec();
    let errors: Vec<_> = qpos(&env)[FINGER].iter().zip(&goal).map(|(angle, goal)| goal - angle).collect();
    assert_eq!(env.rows()["qpos_error"], errors[..]);
    let norm = errors.iter().map(|error| error * error).sum::<f64>().sqrt();
    assert!(norm > 0.1 && (env.dense() + norm).abs() < 1e-15);
    for (solved, offset) in [(true, 9.9_f64), (false, 10.1)] {
        let mut world = env.world();
        let angles = world.qpos.as_mut().unwrap();
        FINGER.for_each(|k| angles[k] = goal[k] - offset.to_radians());
        world.qvel.as_mut().unwrap()[..3].copy_from_slice(&[3.0, -4.0, 0.0]);
        env.set_world(&world).unwrap();
        let dense = -offset.to_radians() * 3.0_f64.sqrt() - 0.1 * 4.0;
        assert!((env.dense() - dense).abs() < 1e-14, "{} and not {dense}", env.dense());
        assert_eq!(env.verdict().solved, solved);
        assert!((env.verdict().sparse - (1.0 - offset / 45.0)).abs() < 1e-14);
    }
}

#[test]
fn a_moving_pose_swings_slowly_and_is_shown() {
    let mut env = make("DClawPoseRandom-v0");
    for seed in 0..5 {
        env.reset(Some(seed)).unwrap();
        assert_eq!(env.rows()["qpos_error"], [0.0; 3], "the claw starts at the goal");
        let mut last = qpos(&env)[FINGER].to_vec();
        let mut way = 0.0;
        for _ in 0..80 {
            env.step(&[0.2, -0.3, 0.1]).unwrap();
            let state = qpos(&env);
            let errors = &env.rows()["qpos_error"];
            let goal: Vec<_> = state[FINGER].iter().zip(errors).map(|(angle, error)| angle + error).collect();
            for (k, shown) in OVERLAY.enumerate() {
                assert!((goal[k] - last[k]).abs() <= FRAC_PI_6 * env.dt() + 1e-12);
                assert!((state[shown] - goal[k]).abs() < 1e-3, "{} shows {}", state[shown], goal[k]);
                way += (goal[k] - last[k]).abs();
            }
            last = goal;
        }
        assert!(way > 0.1, "{way}");
    }
}

#[test]
fn wrong_settings_are_named() {
    for (id, changes, text) in [
        (TURN[0], "target_velocity_range = [0, 1]", "takes no target_velocity_range"),
        (SCREW[0], "target_angle_range = [0, 1]", "takes no target_angle_range"),
        (SCREW[0], "speed = 1", "speed"),
        (TURN[0], "target_body_name = 'targt'", "target"),
        (TURN[0], "valve_joint_name = 'crank'", "no joint named crank"),
        (TURN[0], "dof_range_names = ['FFJ10', 'FFJ11']", "3 each; here are 2 positions"),
        (TURN[0], "dof_range_names = ['FFJ12', 'FFJ10']", "from FFJ12 to FFJ10"),
        (POSE[0], "goal = 'still'", "swing"),
        (POSE[0], "overlay_range_names = ['FFJ10', '_FFJ12']", "the overlay has 6 joints, and the claw 3"),
    ] {
        let error =
            make_with(id, changes).err().unwrap_or_else(|| panic!("{changes} is accepted")).to_string();
        assert!(error.contains(text), "{changes}: {error}");
    }
    let reversed = "initial_angle_range = [1, 0]";
    assert!(make_with(TURN[0], reversed).unwrap().reset(Some(0)).is_err());
}

#[test]
fn the_suite_has_six_ids_beside_robohives_own() {
    let specs = Registry::builtin().specs();
    let count = |own: fn(&Spec) -> bool| specs.iter().filter(|spec| own(spec)).count();
    assert_eq!(count(|spec| spec.suite == "dclaw" && !spec.id.starts_with("hive/")), 6);
    assert_eq!(count(|spec| spec.suite != "dclaw" && !spec.id.starts_with("hive/")), 521);
}
