//! Recordings of a session, replays, references beside it, signals and profiles.

use dataset::NpzReader;
use dataset::trace::TraceReader;
use env::{Env, Options, OwnModels};
use record::{Description, Trajectory};
use robohive_viewer::{Acting, Drawing, Play, Session, Signal, Signals, convergence};
use std::path::{Path, PathBuf};

fn model(path: &str) -> physics::Model {
    mjcf::load(format!("{}/../../{path}", env!("CARGO_MANIFEST_DIR"))).unwrap().model
}

fn place(name: &str) -> PathBuf {
    std::env::temp_dir().join(format!("robohive-viewer-{}-{name}", std::process::id()))
}

fn archive(path: &Path) -> NpzReader {
    NpzReader::open(path).unwrap()
}

#[test]
fn what_is_recorded_is_replayed() {
    let path = place("pile.npz");
    let mut session = Session::new(model("assets/pile/pile.xml")).unwrap();
    session.record(&path).unwrap();
    session.run(true);
    session.advance(0.1, &mut || true);
    session.run(false);
    let last = session.data().state.qpos.clone();
    let recorded = session.stop_recording().unwrap().unwrap();
    let steps = (0.1 / session.model().opt.timestep).round() as u64;
    assert_eq!((recorded.count, recorded.unit), (steps + 1, "states"));

    let trajectory = Trajectory::of_archive("pile.npz", &archive(&path), session.model()).unwrap();
    let mut replayed = Session::new(session.model().clone()).unwrap();
    replayed.set_replay(Some(trajectory)).unwrap();
    let first = replayed.data().state.qpos.clone();
    replayed.run(true);
    replayed.advance(0.05, &mut || true);
    let (row, half) = (replayed.replay().unwrap().row(), replayed.data().time());
    assert!((half - 0.05).abs() < 1.5 * session.model().opt.timestep, "{half}");
    assert!(row > 5 && replayed.data().state.qpos != first);
    // Steps go from state to state, and the end is the end.
    replayed.step_back();
    assert_eq!(replayed.replay().unwrap().row(), row - 1);
    replayed.seek(usize::MAX);
    assert_eq!(replayed.data().state.qpos, last);
    replayed.run(true);
    replayed.advance(0.1, &mut || true);
    assert!(!replayed.is_running());
    // From there, physics may go on.
    replayed.set_replay(None).unwrap();
    replayed.step_forward();
    assert!(replayed.data().time() > 0.1);
    std::fs::remove_file(&path).unwrap();
}

#[test]
fn a_recorded_reference_is_followed_and_drawn() {
    let own = "validation/reference/own/franka_table.npz";
    let path = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../..").join(own);
    let model = model("assets/franka/franka_table.xml");
    let trajectory = Trajectory::of_archive("franka_table.npz", &archive(&path), &model).unwrap();
    assert_eq!(trajectory.len(), 500);
    let controls = archive(&path).require("rollout.ctrl").unwrap().values.to_f64();
    let mut session = Session::new(model).unwrap();
    let mut drawing = Drawing::new(session.model()).unwrap();
    let plain = drawing.draw(&session, [96, 64]).unwrap().rgb.clone();
    session.set_reference(Some(trajectory)).unwrap();
    // Nothing was recorded at the start, whose state is that before the first step.
    assert_eq!(session.reference().unwrap().difference(), None);
    let nu = session.model().nu;
    for row in 0..200 {
        session.edit(|_, data| data.state.ctrl.copy_from_slice(&controls[row * nu..(row + 1) * nu]));
        session.step_forward();
        let difference = session.reference().unwrap().difference().expect("a state of this time");
        assert!(difference < 1e-9, "row {row}: {difference}");
    }
    // Without the recorded controls the two go apart, and both are seen.
    session.edit(|_, data| data.state.ctrl.fill(0.0));
    (0..200).for_each(|_| session.step_forward());
    assert!(session.reference().unwrap().difference().unwrap() > 0.01);
    let both = drawing.draw(&session, [96, 64]).unwrap().rgb.clone();
    session.set_reference(None).unwrap();
    let alone = drawing.draw(&session, [96, 64]).unwrap().rgb.clone();
    let differing = |a: &[u8], b: &[u8]| a.iter().zip(b).filter(|(a, b)| a != b).count();
    assert!(differing(&both, &alone) > 200, "{}", differing(&both, &alone));
    assert!(differing(&plain, &alone) > 200);
}

#[test]
fn trajectories_of_other_models_are_refused() {
    let reference = |name: &str| {
        PathBuf::from(env!("CARGO_MANIFEST_DIR")).join(format!("../../validation/reference/own/{name}.npz"))
    };
    let pile = model("assets/pile/pile.xml");
    let wrong = Trajectory::of_archive("arm.npz", &archive(&reference("franka_table")), &pile).unwrap_err();
    assert!(wrong.to_string().contains("is it of this model"), "{wrong}");
    let own = Trajectory::of_archive("pile.npz", &archive(&reference("pile")), &pile).unwrap();
    let mut other = Session::new(model("assets/franka/franka_table.xml")).unwrap();
    let wrong = other.set_replay(Some(own)).unwrap_err();
    assert!(wrong.to_string().contains("pile.npz holds states of another model"), "{wrong}");
    assert!(other.replay().is_none());
}

#[test]
fn episodes_are_recorded_from_their_start_and_shown_again() {
    let path = place("reach.h5");
    let make = || Env::make("hive/FrankaReach-v0", &OwnModels, &Options::default()).unwrap();
    let mut session = Session::playing(Play::new(make(), None, 4).unwrap());
    session.play_mut().unwrap().let_act(Acting::Random);
    session.step_forward();
    // The present episode has begun already: the next one is the first in the file.
    session.record(&path).unwrap();
    session.begin(7);
    let horizon = session.play().unwrap().env().spec().max_episode_steps;
    (0..horizon + 3).for_each(|_| session.step_forward());
    let recorded = session.stop_recording().unwrap().unwrap();
    assert_eq!((recorded.count, recorded.unit), (1, "episodes"));

    let trace = TraceReader::open(&path).unwrap();
    let described = Description::of(&trace, None).unwrap();
    assert_eq!(described.id, "hive/FrankaReach-v0");
    let mut env = make();
    let trajectory = Trajectory::of_trial(&trace, "Trial0", &mut env).unwrap();
    assert_eq!(trajectory.len(), horizon + 1);
    // The states are those of the same episode played by a program.
    let mut play = Play::new(make(), None, 7).unwrap();
    play.let_act(Acting::Random);
    let free = vec![[0.0; 6]; play.env().scene().model.nbody];
    for row in 0..horizon {
        assert_eq!(trajectory.qpos(row), play.env().scene().data.state.qpos, "row {row}");
        play.step(&free).unwrap();
    }
    let mut shown = Session::new(env.scene().model.clone()).unwrap();
    shown.set_replay(Some(trajectory)).unwrap();
    shown.seek(horizon);
    assert_eq!(shown.data().state.qpos, play.env().scene().data.state.qpos);
    std::fs::remove_file(&path).unwrap();
}

#[test]
fn signals_are_measured_once_a_state_and_forget_what_was_undone() {
    let mut session = Session::new(model("assets/pile/pile.xml")).unwrap();
    session.edit_options(|options| options.enableflags.set(physics::model::Enable::ENERGY, true));
    let mut signals = Signals::default();
    signals.follow(Signal::Energy, true);
    signals.follow(Signal::Watched("qpos".into(), 2), true);
    signals.follow(Signal::Difference, true);
    for _ in 0..20 {
        session.step_forward();
        signals.measure(&session);
        signals.measure(&session);
    }
    let lengths: Vec<usize> = signals.series().iter().map(|series| series.points().len()).collect();
    assert_eq!(lengths, [20, 20, 0], "there is no reference to differ from");
    let height = signals.series()[1].points().last().unwrap();
    assert_eq!(height, [session.data().time(), session.data().state.qpos[2]]);
    assert!(signals.series()[0].points().all(|[_, energy]| energy > 0.0));
    session.show_past(15);
    signals.measure(&session);
    assert_eq!(signals.series()[1].points().len(), 5);
    signals.follow(Signal::Energy, false);
    assert!(!signals.follows(&Signal::Energy) && signals.series().len() == 2);
}

#[test]
fn a_profile_adds_up_and_changes_no_step() {
    let start = || Session::new(model("assets/pile/pile.xml")).unwrap();
    let (mut plain, mut watched) = (start(), start());
    watched.profile = Some(Default::default());
    for session in [&mut plain, &mut watched] {
        session.run(true);
        for _ in 0..10 {
            session.advance(0.02, &mut || true);
        }
    }
    assert_eq!(plain.data().state.qpos, watched.data().state.qpos);
    let profile = watched.profile.as_ref().unwrap();
    let steps: usize = profile.frames().map(|frame| frame.steps).sum();
    assert_eq!((profile.frames().len(), steps as f64 * watched.model().opt.timestep), (10, 0.2));
    let mean = profile.mean();
    assert!(mean.whole() > 0.0 && mean.stages.iter().filter(|&&seconds| seconds > 0.0).count() > 8);
    assert!(mean.contacts > 0 && mean.rows >= mean.contacts && mean.iterations > 0);
    let gains = convergence(watched.data());
    assert!(gains.len() == mean.iterations && gains.iter().all(|[improvement, _]| improvement.is_finite()));
}

#[test]
fn what_takes_the_place_of_a_recorded_motion_completes_the_file() {
    let steps = |session: &mut Session| (0..7).for_each(|_| session.step_forward());
    let rows = |path: &Path| {
        let rows = archive(path).require("time").unwrap().rows();
        std::fs::remove_file(path).unwrap();
        rows
    };
    let (reloaded, replayed, dropped) = (place("reloaded.npz"), place("replayed.npz"), place("dropped.npz"));
    let mut session = Session::new(model("assets/pile/pile.xml")).unwrap();
    session.record(&reloaded).unwrap();
    steps(&mut session);
    session.keep_key();
    session.replace(model("assets/pile/pile.xml")).unwrap();
    assert_eq!((session.fault(), session.kept_keys().len()), (None, 1));
    assert!(session.kept_keys()[0].time() > 0.0, "what was kept is kept over a reload");
    let trajectory = Trajectory::of_archive("reloaded.npz", &archive(&reloaded), session.model()).unwrap();
    session.record(&replayed).unwrap();
    steps(&mut session);
    session.set_replay(Some(trajectory)).unwrap();
    assert!(session.recording().is_none());
    session.set_replay(None).unwrap();
    session.record(&dropped).unwrap();
    steps(&mut session);
    drop(session);
    // The states before seven steps, and the last.
    assert_eq!([reloaded, replayed, dropped].map(|path| rows(&path)), [8, 8, 8]);
}
