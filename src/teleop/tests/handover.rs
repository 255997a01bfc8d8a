//! Control that a policy and a person share, on a virtual clock.

use agents::Policy;
use dataset::trace::{Layout, Precision, TraceReader};
use env::{Env, Options, OwnModels};
use record::Recording;
use robohive_teleop::{Control, INTERVENTION, Input, Mapping, Mark, Plan, Session};

const ID: &str = "hive/FrankaReach-v0";

fn session(control: Control, policy: &Policy) -> Session {
    let env = Env::make(ID, &OwnModels, &Options::default()).unwrap();
    let session = Session::new(env, control, &Mapping::default(), Plan { seed: 4, ..Plan::default() });
    session.unwrap().with_policy(policy).unwrap()
}

fn mark(mark: Mark) -> Input {
    Input { marks: vec![mark], ..Input::default() }
}

fn up() -> Input {
    let mut input = Input::default();
    input.motion.arms[0].along[2] = 1.0;
    input
}

fn hand(session: &Session) -> [f64; 3] {
    let scene = session.env().scene();
    scene.data.kin.site_xpos[scene.model.site("grasp").unwrap().index()]
}

fn distance(a: [f64; 3], b: [f64; 3]) -> f64 {
    (0..3).map(|k| (a[k] - b[k]).powi(2)).sum::<f64>().sqrt()
}

#[test]
fn the_policy_acts_until_the_person_touches_and_the_recording_says_who() {
    let mut session = session(Control::Hand, &Policy::random(0));
    assert!(!session.tick(&Input::default()).unwrap().stepped, "time stands still at first");
    assert!(session.line().contains("policy acts"), "{}", session.line());
    let mut acted = vec![session.tick(&mark(Mark::Pause)).unwrap().by_hand.unwrap()];
    for tick in 0..30 {
        let input = match tick {
            8 | 9 => up(),
            16 | 24 => mark(Mark::Policy),
            _ => Input::default(),
        };
        let ticked = session.tick(&input).unwrap();
        assert!(ticked.stepped);
        acted.push(ticked.by_hand.unwrap());
    }
    let expected: Vec<bool> = (0..31).map(|k| (9..17).contains(&k) || k >= 25).collect();
    assert_eq!(acted, expected, "by touch, given back, and by the key");
    assert!(session.line().contains("BY HAND"), "{}", session.line());
    let finished = session.tick(&mark(Mark::Success)).unwrap().finished.unwrap();
    assert_eq!(session.by_hand(), Some(false), "the policy begins every episode");

    let path = std::env::temp_dir().join(format!("robohive-shared-{}.h5", std::process::id()));
    let mut file = Recording::create(&path, Layout::RoboHive, Precision::Full, &[]).unwrap();
    file.add(&finished.kept).unwrap();
    file.close().unwrap();
    let trace = TraceReader::open(&path).unwrap();
    let entry = trace.entries("Trial0").unwrap().into_iter().find(|entry| entry.key == INTERVENTION).unwrap();
    let recorded: Vec<bool> = trace.read(&entry).unwrap().values.to_f64().iter().map(|x| *x != 0.0).collect();
    assert_eq!((&recorded[..31], recorded[31]), (&expected[..], false), "in the last state nobody acts");
}

#[test]
fn without_a_policy_there_is_nothing_to_give_back_to() {
    let env = Env::make(ID, &OwnModels, &Options::default()).unwrap();
    let mut session = Session::new(env, Control::Hand, &Mapping::default(), Plan::default()).unwrap();
    assert_eq!(session.tick(&mark(Mark::Policy)).unwrap().impossible, Some(Mark::Policy));
    assert_eq!(session.by_hand(), None);
}

#[test]
fn nothing_jumps_when_the_person_takes_over() {
    // Random actions throw the arm about: whoever takes over begins where it is, and stays near there.
    for control in [Control::Hand, Control::Joints] {
        let mut largest: f64 = 0.0;
        let mut before: f64 = 0.0;
        for taken in [5, 9, 14] {
            let mut session = session(control, &Policy::random(0));
            session.tick(&mark(Mark::Pause)).unwrap();
            for _ in 0..taken {
                let last = hand(&session);
                session.tick(&Input::default()).unwrap();
                before = before.max(distance(hand(&session), last));
            }
            session.tick(&mark(Mark::Policy)).unwrap();
            let mut last = hand(&session);
            for _ in 0..15 {
                session.tick(&Input::default()).unwrap();
                largest = largest.max(distance(hand(&session), last));
                last = hand(&session);
            }
            assert!(distance(hand(&session), last) < 2e-3, "it comes to rest");
        }
        println!(
            "{control:?}: a tick of the policy moves the hand by up to {before:.3} m, after taking over {largest:.3} m"
        );
        assert!(largest < before, "{control:?}: {largest} m in a tick after the policy's {before} m");
    }
}

#[test]
fn going_back_brings_back_who_acted_and_what_the_policy_would_do() {
    let mut session = session(Control::Hand, &Policy::random(0));
    session.tick(&mark(Mark::Pause)).unwrap();
    (0..5).for_each(|_| drop(session.tick(&Input::default()).unwrap()));
    let observed = |session: &Session| session.env().observation().to_vec();
    let after = observed(&session);
    (0..3).for_each(|_| drop(session.tick(&up()).unwrap()));
    assert_eq!(session.by_hand(), Some(true));
    (0..6).for_each(|_| drop(session.tick(&mark(Mark::Back)).unwrap()));
    assert_eq!((session.by_hand(), session.steps()), (Some(false), (3, 6)));
    // Time goes on, and the policy does what it did.
    session.tick(&mark(Mark::Pause)).unwrap();
    (0..2).for_each(|_| drop(session.tick(&Input::default()).unwrap()));
    assert_eq!(session.steps(), (6, 0));
    let mut again = self::session(Control::Hand, &Policy::random(0));
    again.tick(&mark(Mark::Pause)).unwrap();
    (0..5).for_each(|_| drop(again.tick(&Input::default()).unwrap()));
    assert_eq!((observed(&again), observed(&session)), (after.clone(), after));
}
