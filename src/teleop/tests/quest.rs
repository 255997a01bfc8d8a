//! A scripted hand over the wire: a simulated adb server, whose headset's log drives an arm on a virtual clock.

use env::{Env, Options, OwnModels};
use protocol::Port;
use protocol::adb::{Next, Opening};
use robohive_teleop::{Control, Event, HandMove, Held, Input, Mapping, Plan, Quest, Session};
use std::sync::{Arc, Mutex};
use wire::adb::{Server, Shown};
use wire::{Bench, Carries, Plant, Rates, VirtualPort};

const ID: &str = "hive/FrankaReach-v0";
/// Frames of the headset a second.
const RATE: f64 = 72.0;
const SQUARE: [f64; 9] = [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0];

fn env() -> Env {
    Env::make(ID, &OwnModels, &Options::default()).unwrap()
}

fn site(env: &Env, name: &str) -> [f64; 3] {
    let scene = env.scene();
    scene.data.kin.site_xpos[scene.model.site(name).unwrap().index()]
}

/// A way of the robot's hand in the frame of a headset behind it: x right, y up, z backward.
fn seen([x, y, z]: [f64; 3], share: f64) -> [f64; 3] {
    [-y * share, z * share, -x * share]
}

/// Seconds for which the hand holds the grip before it moves.
const FIRST: f64 = 0.25;

/// A hand that holds the grip and goes `way` in `seconds`, and rests for a second; with the button `last` it ends.
fn script(way: [f64; 3], seconds: f64, last: &str) -> Vec<Shown> {
    let frames = ((FIRST + seconds + 1.0) * RATE) as usize;
    let frame = |k: usize, buttons: &str| {
        let time = k as f64 / RATE;
        let share = ((time - FIRST) / seconds).clamp(0.0, 1.0);
        Shown { time, hands: [None, Some((seen(way, share), SQUARE))], buttons: buttons.to_owned() }
    };
    (0..frames).map(|k| frame(k, "R,RG")).chain([frame(frames, last)]).collect()
}

/// The log of a scripted headset, opened as a client opens it.
fn log(script: Vec<Shown>, faults: Rates, seed: u64) -> VirtualPort {
    let mut bench = Bench::new(Plant::new(env().scene().model.clone()).unwrap());
    let link = bench.connect(Box::new(Server::new("1WMHH", script)), Carries::AT_ONCE);
    let bench = Arc::new(Mutex::new(bench));
    let mut port = VirtualPort::new(bench.clone(), link);
    let (mut opening, mut request) = Opening::new(Some("1WMHH"), "logcat -T 1");
    let mut bytes = [0; 64];
    loop {
        port.send(&request).unwrap();
        let count = port.receive(&mut bytes, 0.1).unwrap();
        match opening.take(&bytes[..count]).unwrap() {
            Next::Wait => request.clear(),
            Next::Send(next) => request = next,
            Next::Begun(first) => {
                assert!(first.is_empty());
                break;
            }
        }
    }
    bench.lock().unwrap().inject(link, faults, seed);
    port
}

/// What a tick saw: its time, and whether the hand was followed.
struct Tick {
    time: f64,
    /// When the last line came.
    last: f64,
    followed: bool,
    solved: bool,
    hand: [f64; 3],
}

/// Drives a session by what comes, tick by tick of virtual time, for `seconds` or until an episode is finished.
fn drive(session: &mut Session, port: &mut VirtualPort, seconds: f64) -> (Vec<Tick>, Option<bool>) {
    let (mut quest, mut held, mut mapping) = (Quest::default(), Held::default(), Mapping::default());
    let (mut ticks, mut bytes, mut last) = (Vec::new(), [0; 4096], port.now());
    let end = port.now() + seconds;
    while port.now() < end {
        let due = port.now() + session.period();
        while port.now() < due {
            let count = port.receive(&mut bytes, due - port.now()).unwrap();
            let mut events: Vec<Event> = Vec::new();
            quest.feed(&bytes[..count], &mut events);
            last = if count > 0 { port.now() } else { last };
            events.into_iter().for_each(|event| held.apply(event, port.now()));
        }
        let input = mapping.read(&held.sample(port.now()));
        let followed = input.motion.arms[0].hand.is_some();
        let ticked = session.tick(&input).unwrap();
        let solved = session.env().verdict().solved;
        let hand = site(session.env(), "grasp");
        ticks.push(Tick { time: port.now(), last, followed, solved, hand });
        if let Some(finished) = ticked.finished {
            return (ticks, Some(finished.success && finished.kept.rows() > 1));
        }
    }
    (ticks, None)
}

fn session(seed: u64) -> Session {
    Session::new(env(), Control::Hand, &Mapping::default(), Plan { seed, ..Plan::default() }).unwrap()
}

/// From where the hand is to the target.
fn way(env: &Env) -> [f64; 3] {
    let (hand, target) = (site(env, "grasp"), site(env, "target"));
    std::array::from_fn(|k| target[k] - hand[k])
}

#[test]
fn a_scripted_hand_solves_reach_over_the_wire() {
    for seed in 0..5 {
        let mut session = session(seed);
        let mut port = log(script(way(session.env()), 2.0, "A"), Rates::default(), 0);
        let (ticks, outcome) = drive(&mut session, &mut port, 10.0);
        // The tick of the button begins the next episode.
        let [.., before, _] = &ticks[..] else { panic!("{} ticks", ticks.len()) };
        assert!(before.solved && outcome == Some(true), "seed {seed}: {outcome:?} at {:?}", before.hand);
        assert!(ticks.iter().filter(|tick| tick.followed).count() > 20);
    }
}

#[test]
fn a_log_that_stalls_stops_the_arm_and_does_not_move_it_when_it_comes_back() {
    let mut session = session(3);
    let mut rates = Rates::default();
    rates.stall = 0.01;
    let mut port = log(script([0.0, 0.3, 0.0], 4.0, ""), rates, 7);
    let (ticks, _) = drive(&mut session, &mut port, 6.0);
    // 0.15 s after the last line nothing is followed.
    let stale: Vec<&Tick> = ticks.iter().filter(|tick| tick.time - tick.last > 0.15).collect();
    assert!(stale.len() >= 5, "the log stalled: {}", stale.len());
    assert!(stale.iter().all(|tick| !tick.followed));
    // Lines of a stall are no motion: no tick jumps.
    let step =
        |pair: &[Tick]| (0..3).map(|k| (pair[1].hand[k] - pair[0].hand[k]).powi(2)).sum::<f64>().sqrt();
    let leap = ticks.windows(2).map(step).fold(0.0, f64::max);
    println!("{} of {} ticks stale, largest way of a tick {:.1} mm", stale.len(), ticks.len(), 1e3 * leap);
    assert!(leap < 0.02, "{leap}");
    let moved = ticks[ticks.len() - 1].hand[1] - ticks[0].hand[1];
    assert!((0.05..0.3).contains(&moved), "stalls are not caught up with: {moved}");
}

#[test]
fn a_clutch_that_is_pressed_again_moves_nothing_by_itself() {
    let mut session = session(3);
    // Where the hand is after `ticks` of this input, on average over what is left of the arm's swinging.
    let mut follow = |way: Option<[f64; 3]>, ticks: u32| {
        let mut sum = 0.0;
        for tick in 0..ticks {
            let mut input = Input::default();
            input.motion.arms[0].hand = way.map(|way| HandMove { way, turn: [1.0, 0.0, 0.0, 0.0] });
            session.tick(&input).unwrap();
            sum += if tick >= ticks / 2 { site(session.env(), "grasp")[2] } else { 0.0 };
        }
        sum / f64::from(ticks - ticks / 2)
    };
    // The hand rises, pauses, and the clutch is let go while the arm is still behind.
    follow(Some([0.0, 0.0, 0.05]), 2);
    follow(Some([0.0; 3]), 1);
    let rest = follow(None, 88);
    let again = follow(Some([0.0; 3]), 88);
    println!("at rest at {rest:.4} m, and at {again:.4} m when the clutch was pressed again");
    assert!((again - rest).abs() < 2e-3, "{rest} {again}");
}
