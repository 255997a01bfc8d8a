//! Sessions on a virtual clock: driven, judged, thrown away, gone back in, kept.

use dataset::trace::{Layout, Precision, TraceReader};
use env::{Arguments, Env, Options, OwnModels};
use record::{Recorded, Recording};
use robohive_teleop::{
    Button, Control, Event, Held, Input, JUDGED, Key, Mapping, Mark, Motion, Plan, Reached, Session, Ticked,
};
use std::path::PathBuf;

const ID: &str = "hive/FrankaReach-v0";

fn session(plan: Plan) -> Session {
    let env = Env::make(ID, &OwnModels, &Options::default()).unwrap();
    Session::new(env, Control::Hand, &Mapping::default(), plan).unwrap()
}

fn along(axis: usize, sign: f64) -> Input {
    let mut motion = Motion::default();
    motion.arms[0].along[axis] = sign;
    Input { motion, marks: Vec::new() }
}

fn mark(mark: Mark) -> Input {
    Input { marks: vec![mark], ..Input::default() }
}

fn site(session: &Session, name: &str) -> [f64; 3] {
    let scene = session.env().scene();
    scene.data.kin.site_xpos[scene.model.site(name).unwrap().index()]
}

/// What a person does who sees hand and target: pushes along each axis on which they are apart.
fn towards(session: &Session) -> Input {
    let (hand, target) = (site(session, "grasp"), site(session, "target"));
    let mut motion = Motion::default();
    for k in 0..3 {
        let way = target[k] - hand[k];
        if way.abs() > 0.02 {
            motion.arms[0].along[k] = (way / 0.1).clamp(-1.0, 1.0);
        }
    }
    Input { motion, marks: Vec::new() }
}

/// Drives until the task is solved or `most` ticks are over.
fn drive(session: &mut Session, most: usize) -> usize {
    (1..=most)
        .find(|_| !session.tick(&towards(session)).unwrap().stepped || session.env().verdict().solved)
        .unwrap_or(most)
}

fn scratch(name: &str) -> PathBuf {
    std::env::temp_dir().join(format!("robohive-teleop-{}-{name}", std::process::id()))
}

#[test]
fn a_hand_that_is_pushed_reaches_every_target() {
    let mut session = session(Plan::default());
    let mut ticks = Vec::new();
    for seed in 0..10 {
        assert_eq!(session.seed(), seed);
        ticks.push(drive(&mut session, 100));
        assert!(session.env().verdict().solved, "seed {seed} after {ticks:?}");
        let finished = session.tick(&mark(Mark::Success)).unwrap().finished.unwrap();
        assert_eq!((finished.seed, finished.success, finished.steps), (seed, true, ticks[seed as usize]));
        assert_eq!(finished.kept.rows(), finished.steps + 1);
    }
    assert_eq!(session.counts(), (10, 10));
    println!("ticks to solve: {ticks:?}");
}

#[test]
fn the_hand_follows_keys_and_stops_with_them() {
    let mut session = session(Plan::default());
    let start = site(&session, "grasp");
    (0..8).for_each(|_| drop(session.tick(&along(1, 1.0)).unwrap()));
    let moved = site(&session, "grasp");
    assert!(moved[1] - start[1] > 0.15, "{start:?} {moved:?}");
    assert!((moved[0] - start[0]).abs() < 0.05 && (moved[2] - start[2]).abs() < 0.08, "{start:?} {moved:?}");
    // Released, it stays where it was then: the servo of the first joint swings, by less than a tick of motion.
    let released = site(&session, "grasp");
    let mut ways = Vec::new();
    for _ in 0..40 {
        session.tick(&Input::default()).unwrap();
        let now = site(&session, "grasp");
        ways.push((0..3).map(|k| (now[k] - released[k]).powi(2)).sum::<f64>().sqrt());
    }
    let largest = ways.iter().copied().fold(0.0, f64::max);
    println!("after the release: {largest:.3} m at most, {:.3} m in the end", ways[39]);
    assert!(largest < 0.05 && ways[39] < 0.02, "{ways:?}");
    // Turning moves the hand little, and turns it.
    let scene = |session: &Session| {
        session.env().scene().data.kin.site_xmat[session.pilot().arms()[0].site().index()]
    };
    let before = scene(&session);
    (0..5).for_each(|_| drop(session.tick(&along(5, 1.0)).unwrap()));
    (0..10).for_each(|_| drop(session.tick(&Input::default()).unwrap()));
    let now = scene(&session);
    let trace: f64 = (0..9).map(|k| before[k] * now[k]).sum();
    let angle = ((trace - 1.0) / 2.0).acos();
    assert!((0.25..0.6).contains(&angle), "{angle}");
}

#[test]
fn what_cannot_be_reached_is_refused_and_the_arm_keeps_to_its_ranges() {
    let mut session = session(Plan::default());
    let mut refused = Vec::new();
    for _ in 0..60 {
        let ticked = session.tick(&along(0, 1.0)).unwrap();
        refused.extend(ticked.refused);
        let scene = session.env().scene();
        for joint in 0..7 {
            let [low, high] = scene.model.jnt_range[joint];
            let at = scene.data.state.qpos[joint];
            assert!((low - 0.02..=high + 0.02).contains(&at), "joint {joint} at {at}");
        }
    }
    assert!(refused.contains(&Reached::Nowhere) || refused.contains(&Reached::Far), "{refused:?}");
    // And back it comes, in a straight line, as fast as its joints can go.
    let far = site(&session, "grasp");
    let mut aside: f64 = 0.0;
    for _ in 0..28 {
        session.tick(&along(0, -1.0)).unwrap();
        let [_, y, z] = site(&session, "grasp");
        aside = aside.max((y - far[1]).abs()).max((z - far[2]).abs());
    }
    assert!(site(&session, "grasp")[0] < far[0] - 0.4 && aside < 0.02, "{far:?} {aside}");
}

#[test]
fn going_back_and_on_from_there_is_as_if_it_had_never_been() {
    let mut session = session(Plan { seed: 3, ..Plan::default() });
    let (right, up) = (along(1, 1.0), along(2, 1.0));
    (0..6).for_each(|_| drop(session.tick(&right).unwrap()));
    (0..9).for_each(|_| drop(session.tick(&up).unwrap()));
    (0..9).for_each(|_| drop(session.tick(&mark(Mark::Back)).unwrap()));
    assert!(session.is_paused());
    assert_eq!(session.steps(), (6, 9));
    session.tick(&mark(Mark::Forward)).unwrap();
    session.tick(&mark(Mark::Back)).unwrap();
    assert!(!session.tick(&Input::default()).unwrap().stepped, "time stands still until something moves");
    (0..4).for_each(|_| drop(session.tick(&right).unwrap()));
    assert_eq!(session.steps(), (10, 0));
    let gone_back = session.tick(&mark(Mark::Failure)).unwrap().finished.unwrap();

    let mut straight = self::session(Plan { seed: 3, ..Plan::default() });
    (0..10).for_each(|_| drop(straight.tick(&right).unwrap()));
    let plain = straight.tick(&mark(Mark::Failure)).unwrap().finished.unwrap();
    assert_eq!((gone_back.steps, gone_back.reward, gone_back.success), (10, plain.reward, false));
    let [a, b] = ["back.h5", "plain.h5"].map(scratch);
    for (path, finished) in [(&a, &gone_back), (&b, &plain)] {
        let mut file = Recording::create(path, Layout::RoboHive, Precision::Full, &[]).unwrap();
        file.add(&finished.kept).unwrap();
        file.close().unwrap();
    }
    let [a, b] = [a, b].map(|path| TraceReader::open(&path).unwrap());
    let entries = a.entries("Trial0").unwrap();
    assert!(entries.len() > 30);
    for entry in entries {
        let other = b.entries("Trial0").unwrap().into_iter().find(|other| other.key == entry.key).unwrap();
        let (left, right) = (a.read(&entry).unwrap(), b.read(&other).unwrap());
        let bits =
            |array: &dataset::Array| array.values.to_f64().iter().map(|x| x.to_bits()).collect::<Vec<_>>();
        assert_eq!((&left.shape, bits(&left)), (&right.shape, bits(&right)), "{}", entry.key);
    }
}

#[test]
fn a_recording_loads_and_replays_to_the_last_bit() {
    let path = scratch("reach.h5");
    let mut session = session(Plan { seed: 5, solved_for: 1, ..Plan::default() });
    let mut file = Recording::create(&path, Layout::RoboHive, Precision::Full, &[]).unwrap();
    let mut finished = None;
    for _ in 0..200 {
        let ticked: Ticked = session.tick(&towards(&session)).unwrap();
        if let Some(episode) = ticked.finished {
            file.add(&episode.kept).unwrap();
            finished = Some(episode);
            break;
        }
    }
    let finished = finished.expect("the task ends the episode when it is solved");
    assert!(finished.success);
    // The file can be read before it is closed: a kill would leave this.
    let trace = TraceReader::open(&path).unwrap();
    let judged = trace.entries("Trial0").unwrap().into_iter().find(|entry| entry.key == JUDGED).unwrap();
    assert_eq!(trace.read(&judged).unwrap().values.to_f64(), [1.0]);
    let recorded = Recorded::read(&trace, "Trial0").unwrap();
    assert_eq!(recorded.seed, Some(5));
    let mut env = Env::make(ID, &OwnModels, &Options::default()).unwrap();
    env.reset(recorded.seed).unwrap();
    assert!(recorded.start(&env).is_none(), "the reset of the seed is where it began");
    for step in 0..finished.steps {
        env.step(recorded.actions.row(step).unwrap()).unwrap();
    }
    assert_eq!(env.observation(), recorded.observations.as_ref().unwrap().last().unwrap());
    assert!(env.verdict().solved);
    file.close().unwrap();

    // By robot, in the layout of RoboSet.
    let path = scratch("roboset.h5");
    let mut file = Recording::create(&path, Layout::RoboSet, Precision::Full, &[]).unwrap();
    file.add(&finished.kept).unwrap();
    let (_, episodes, unmapped) = file.close().unwrap();
    assert_eq!(episodes, 1);
    assert!(
        unmapped.iter().any(|name| name == JUDGED),
        "the layout has no place for it, and says so: {unmapped:?}"
    );
    let roboset = Recorded::read(&TraceReader::open(&path).unwrap(), "Trial0").unwrap();
    assert_eq!(roboset.actions.row(0), recorded.actions.row(0));
}

#[test]
fn marks_do_what_they_say() {
    let mut session = session(Plan { seed: 7, episodes: 2, ..Plan::default() });
    // Nothing happened yet: nothing to keep.
    assert!(session.tick(&mark(Mark::Success)).unwrap().finished.is_none());
    let first = session.env().observation().to_vec();
    (0..5).for_each(|_| drop(session.tick(&along(0, -1.0)).unwrap()));
    let thrown = session.tick(&mark(Mark::Discard)).unwrap();
    assert!(thrown.discarded && thrown.finished.is_none());
    assert_eq!((session.seed(), session.env().observation()), (7, &first[..]));
    session.tick(&mark(Mark::Skip)).unwrap();
    assert_eq!((session.seed(), session.counts()), (8, (0, 0)));
    assert_ne!(session.env().observation(), &first[..]);
    // Paused and slow.
    session.tick(&along(0, 1.0)).unwrap();
    session.tick(&mark(Mark::Pause)).unwrap();
    assert!(!session.tick(&Input::default()).unwrap().stepped);
    let period = session.period();
    session.tick(&mark(Mark::Slow)).unwrap();
    assert_eq!(session.period(), 4.0 * period);
    session.tick(&mark(Mark::Slow)).unwrap();
    assert!(session.tick(&along(0, 1.0)).unwrap().stepped, "a motion ends the pause");
    assert!(!session.tick(&mark(Mark::Failure)).unwrap().over);
    session.tick(&along(0, 1.0)).unwrap();
    let last = session.tick(&mark(Mark::Success)).unwrap();
    assert!(last.over && last.finished.is_some());
    assert_eq!(session.counts(), (2, 1));
    assert!(session.line().contains("1 of 2 succeeded"), "{}", session.line());
    assert!(session.tick(&mark(Mark::End)).unwrap().over);
}

#[test]
fn an_episode_ends_at_its_horizon() {
    let mut session = session(Plan { horizon: 4, ..Plan::default() });
    let ends: Vec<bool> = (0..8).map(|_| session.tick(&along(2, 1.0)).unwrap().finished.is_some()).collect();
    assert_eq!(ends, [false, false, false, true, false, false, false, true]);
}

#[test]
fn joints_and_units_are_driven_too() {
    for (id, settings) in [("hive/ElbowPose-v0", ""), ("hive/FrankaReach-v0", "normalize_act = false")] {
        let changes: Arguments = settings.parse().unwrap();
        let env = Env::make(id, &OwnModels, &Options::default().with_changes(changes)).unwrap();
        let mut session = Session::new(env, Control::Joints, &Mapping::default(), Plan::default()).unwrap();
        let before = session.env().scene().data.state.qpos.clone();
        let motion = Motion { joints: vec![(0, 1.0), (99, 1.0)], ..Motion::default() };
        for _ in 0..10 {
            assert!(
                session.tick(&Input { motion: motion.clone(), marks: Vec::new() }).unwrap().stepped,
                "{id}"
            );
        }
        let moved = session.env().scene().data.state.qpos[0] - before[0];
        assert!(moved.abs() > 0.05, "{id} {moved}");
    }
    let env = Env::make("hive/ElbowPose-v0", &OwnModels, &Options::default()).unwrap();
    let error =
        Session::new(env, Control::Hand, &Mapping::default(), Plan::default()).err().unwrap().to_string();
    assert!(error.contains("--site") || error.contains("--control joints"), "{error}");
}

#[test]
fn keys_become_motions_on_a_virtual_clock() {
    let mut session = session(Plan::default());
    let (mut held, mut mapping) = (Held::default(), Mapping::default());
    let start = site(&session, "grasp");
    // A key is held for 0.8 s, repeated every 40 ms, as a terminal without releases tells it.
    let (mut now, mut stepped_after) = (0.0, 0);
    for tick in 0..25 {
        for _ in 0..2 {
            now += 0.04;
            if now < 0.8 {
                held.apply(Event::Press(Button::Key(Key::Char('z'))), now);
            }
        }
        let input = mapping.read(&held.sample(now));
        stepped_after += usize::from(input.motion.moves() && now > 0.8 + 0.2);
        session.tick(&input).unwrap();
        if tick == 0 {
            assert_eq!(input.motion.arms[0].along[2], -1.0);
        }
    }
    assert_eq!(stepped_after, 0, "a key that is not repeated is released within 0.2 s");
    assert!(site(&session, "grasp")[2] < start[2] - 0.1);
}

#[test]
fn stops_add_up_to_nothing() {
    let mut session = session(Plan::default());
    let (start, index) = (site(&session, "grasp"), session.pilot().arms()[0].site().index());
    let pose = |session: &Session| session.env().scene().data.kin.site_xmat[index];
    let upright = pose(&session);
    // Short presses to and fro: the arm is behind its target at every release.
    for k in 0..120 {
        let sign = if (k / 20) % 2 == 0 { 1.0 } else { -1.0 };
        session.tick(&if k % 3 == 0 { along(1, sign) } else { Input::default() }).unwrap();
    }
    (0..6).for_each(|_| drop(session.tick(&along(1, -0.1)).unwrap()));
    (0..10).for_each(|_| drop(session.tick(&Input::default()).unwrap()));
    let (end, now) = (site(&session, "grasp"), pose(&session));
    let trace: f64 = (0..9).map(|k| upright[k] * now[k]).sum();
    let turn = ((trace - 1.0) / 2.0).clamp(-1.0, 1.0).acos();
    let aside = (end[0] - start[0]).hypot(end[2] - start[2]);
    println!("forty presses along y move the hand by {aside:.3} m across, and turn it by {turn:.3} rad");
    assert!(turn < 0.1 && aside < 0.03, "{turn} rad, {aside} m");
}
