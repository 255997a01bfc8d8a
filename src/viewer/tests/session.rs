//! A session: time, history, keyframes, reloading, hands, and what is copied from it.

use agents::Policy;
use env::{Env, Options, OwnModels};
use physics::{Data, step};
use render::scene::Camera;
use robohive_viewer::{Acting, Grip, Look, Plane, Play, SPEEDS, Session, WatchError, text, watch};
use std::path::Path;

fn own(name: &str) -> Session {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../assets").join(name);
    Session::new(mjcf::load(path).unwrap().model).unwrap()
}

fn of(text: &str) -> Session {
    Session::new(mjcf::load_str(text).unwrap().model).unwrap()
}

/// A ball above the floor, seen from the side.
const BALL: &str = "<mujoco><statistic center='0 0 .5' extent='1'/><visual><global elevation='0'/></visual><worldbody>\
    <geom type='plane' size='2 2 .1'/><camera name='side' pos='0 -3 1' xyaxes='1 0 0 0 0 1'/>\
    <body name='ball' pos='0 0 .5'><freejoint/><geom name='ball' size='.2'/></body></worldbody>\
    <keyframe><key name='high' qpos='0 0 1.5 1 0 0 0'/></keyframe></mujoco>";

#[test]
fn a_session_takes_the_steps_that_a_program_would() {
    let mut session = own("quadruped/quadruped.xml");
    let mut data = Data::new(session.model());
    data.reset_to_key(session.model(), 0).unwrap();
    session.run(true);
    let mut steps = 0;
    for _ in 0..30 {
        steps += session.advance(1.0 / 60.0, &mut || true);
    }
    let expected = (0.5 / session.model().opt.timestep) as usize;
    assert!(steps.abs_diff(expected) <= 1, "{steps} steps in half a second");
    (0..steps).try_for_each(|_| step(session.model(), &mut data)).unwrap();
    assert_eq!(session.data().state.qpos, data.state.qpos);
}

#[test]
fn speeds_slow_time_down_and_what_cannot_be_caught_up_with_is_given_up() {
    let mut session = of(BALL);
    session.run(true);
    (0..3).for_each(|_| session.pace_mut().slower());
    assert_eq!(session.pace().percent(), SPEEDS[3]);
    assert_eq!(session.advance(0.1, &mut || true), 25);
    // Ten seconds went by in which no step was allowed: they are not owed for ever.
    assert_eq!(session.advance(10.0, &mut || false), 0);
    let mut left = 1000;
    let steps = session.advance(0.004, &mut || {
        left -= 1;
        left > 0
    });
    assert!(steps <= 2, "{steps}");
    let reached = session.pace().reached().unwrap();
    assert!(reached < 1.0, "{reached} %");
}

#[test]
fn history_goes_back_and_forth_and_branches() {
    let mut session = of(BALL);
    for _ in 0..20 {
        session.step_forward();
    }
    let latest = session.data().state.qpos.clone();
    assert_eq!((session.history().len(), session.history().behind()), (21, 0));
    for _ in 0..7 {
        session.step_back();
    }
    assert_eq!(session.history().behind(), 7);
    assert!((session.data().time() - 13.0 * 0.002).abs() < 1e-12);
    for _ in 0..7 {
        session.step_forward();
    }
    assert_eq!((session.history().behind(), &session.data().state.qpos), (0, &latest));
    session.show_past(1000);
    assert_eq!((session.history().behind(), session.data().time()), (20, 0.0));
    session.run(true);
    session.advance(0.01, &mut || true);
    assert_eq!((session.history().len(), session.history().behind()), (2, 0));
}

#[test]
fn history_is_bounded() {
    let mut session = of(BALL);
    for _ in 0..2100 {
        session.step_forward();
    }
    assert_eq!(session.history().len(), 2000);
    session.show_past(1999);
    assert!((session.data().time() - 101.0 * 0.002).abs() < 1e-9, "{}", session.data().time());
}

#[test]
fn a_reloaded_model_goes_on_where_the_former_was() {
    let mut session = of(BALL);
    session.camera = Camera::Fixed(0);
    session.run(true);
    session.advance(0.2, &mut || true);
    let (height, time) = (session.data().state.qpos[2], session.data().time());
    let edited = BALL.replace(
        "<body name='ball'",
        "<camera name='new'/><body name='new'><joint/><geom size='.1'/></body><body name='ball'",
    );
    let edited = edited
        .replace("<key name='high' qpos='0 0 1.5 1 0 0 0'/>", "")
        .replace("<camera name='side'", "<camera name='first'/><camera name='side'");
    session.replace(mjcf::load_str(&edited).unwrap().model).unwrap();
    assert!(session.is_running());
    assert_eq!((session.data().state.qpos[3], session.data().time()), (height, time));
    assert_eq!(session.camera, Camera::Fixed(1), "the camera is found by its name");
    let without = BALL.replace("name='side'", "name='other'");
    session.replace(mjcf::load_str(&without).unwrap().model).unwrap();
    assert!(matches!(session.camera, Camera::Free(_)));
}

#[test]
fn a_step_that_fails_stops_the_session_and_says_why() {
    let mut session = of(BALL);
    session.run(true);
    session.edit(|_, data| data.state.qvel[0] = f64::NAN);
    session.advance(0.1, &mut || true);
    assert!(!session.is_running());
    let why = session.fault().unwrap().to_owned();
    assert!(why.contains("qvel") || why.contains("NaN") || why.contains("velocit"), "{why}");
    session.run(true);
    assert!(!session.is_running(), "it does not run from there");
    session.reset();
    assert!(session.fault().is_none());
    assert_eq!(session.data().state.qpos[2], 1.5);
}

#[test]
fn a_hand_pulls_and_lets_go() {
    let mut session = of(BALL);
    session.edit(|_, data| data.state.qpos[2] = 0.5);
    assert!(session.select(1.5, [0.02, 0.97]).is_none(), "nothing is there");
    session.grab(Grip::Pull);
    assert!(!session.holds());
    let picked = session.select(1.5, [0.5, 0.5]).unwrap();
    assert_eq!((picked.body, session.model().ngeom), (1, 2));
    session.grab(Grip::Pull);
    session.drag(Plane::Vertical, [0.0, 0.3]);
    assert_eq!(session.shown().selection.unwrap().body, 1);
    // Paused: it is where it is wanted.
    session.advance(0.02, &mut || true);
    let raised = session.data().state.qpos[2];
    assert!(raised > 0.7, "{raised}");
    session.run(true);
    for _ in 0..50 {
        session.advance(0.1, &mut || true);
    }
    // The point on the surface seems to have 3/8 of the mass; below it the ball comes to hang.
    let expected = raised - 0.2 - 8.0 / 3.0 * 9.81 / 100.0;
    let hanging = session.data().state.qpos[2];
    assert!((hanging - expected).abs() < 0.03, "it hangs at {hanging} m, expected at {expected} m");
    session.release();
    session.advance(0.1, &mut || true);
    session.advance(0.1, &mut || true);
    let fallen = hanging - session.data().state.qpos[2];
    assert!((fallen - 9.81 * 0.2 * 0.2 / 2.0).abs() < 0.05, "it has fallen {fallen} m");
    assert!(session.shown().selection.is_none());
}

#[test]
fn cameras_cycle_and_look_where_they_are_told() {
    let mut session = of(BALL);
    session.edit(|_, data| data.state.qpos[2] = 0.5);
    session.cycle_camera(1);
    assert_eq!(session.camera, Camera::Fixed(0));
    let before = session.camera;
    session.look(Look::Orbit, [0.3, 0.1]);
    assert_eq!(session.camera, before, "a camera of the model stays");
    session.cycle_camera(1);
    assert!(matches!(session.camera, Camera::Free(_)));
    session.cycle_camera(-1);
    session.cycle_camera(-1);
    session.look_at(1.5, [0.5, 0.5], true);
    let Camera::Free(free) = session.camera else { panic!("{:?}", session.camera) };
    assert_eq!(free.track, Some(1));
    assert!((free.lookat[0] + 0.2).abs() < 0.01 || (free.lookat[1] + 0.2).abs() < 0.01, "{:?}", free.lookat);
}

#[test]
fn noise_stays_within_ranges_and_repeats() {
    let wander = || {
        let mut session = own("servos/servos.xml");
        (session.noise.scale, session.noise.rate) = (0.5, 0.1);
        session.run(true);
        session.advance(0.09, &mut || true);
        session.data().state.ctrl.clone()
    };
    let session = own("servos/servos.xml");
    let (model, controls) = (session.model(), wander());
    assert!(controls.iter().any(|&x| x != 0.0));
    for (i, x) in controls.iter().enumerate().filter(|&(i, _)| model.actuator_ctrllimited[i]) {
        let [low, high] = model.actuator_ctrlrange[i];
        assert!((low..=high).contains(x), "{x} of control {i}");
    }
    assert_eq!(controls, wander());
}

#[test]
fn states_and_cameras_are_copied_as_text_that_reads_back() {
    let mut session = own("franka/franka_table.xml");
    session.run(true);
    session.advance(0.1, &mut || true);
    let key = text::key(session.model(), session.data(), true);
    let ball = {
        let mut session = of(BALL);
        session.run(true);
        session.advance(0.1, &mut || true);
        session
    };
    let exact = text::key(ball.model(), ball.data(), true);
    let rounded = text::key(ball.model(), ball.data(), false);
    assert!(key.starts_with("<key time=\"0.1") && key.contains(" ctrl=\""), "{key}");
    assert!(rounded.len() < exact.len());
    let read = |key: &str| {
        let text = BALL.replace("<key name='high' qpos='0 0 1.5 1 0 0 0'/>", key);
        of(&text).data().state.clone()
    };
    let state = &ball.data().state;
    assert_eq!(
        (&read(&exact).qpos, &read(&exact).qvel, read(&exact).time),
        (&state.qpos, &state.qvel, state.time)
    );
    assert!((read(&rounded).qpos[2] - state.qpos[2]).abs() < 1e-5);

    let view = ball.view().unwrap();
    let with = BALL.replace("<camera name='side'", &format!("{}<camera name='side'", text::camera(&view)));
    let copy = of(&with);
    let again = Camera::Fixed(0).view(copy.model(), copy.data()).unwrap();
    let off = |a: [f64; 3], b: [f64; 3]| physics::math::distance(a, b);
    assert!(off(again.eye, view.eye) + off(again.forward, view.forward) + off(again.up, view.up) < 1e-4);
}

#[test]
fn numbers_are_watched_by_name() {
    let session = of(BALL);
    let look = |name, index| watch(session.model(), session.data(), name, index);
    assert_eq!(look("qpos", 2), Ok(1.5));
    assert_eq!(look("qpos", 7), Err(WatchError::Index { name: "qpos".into(), index: 7, len: 7 }));
    let unknown = look("qposs", 0).unwrap_err().to_string();
    assert_eq!(unknown, "no array \"qposs\"; did you mean \"qpos\"?");
}

/// What `robohive run` would play: the mirror shows the environment's own state, episode after episode.
#[test]
fn an_environment_is_played_as_without_a_viewer() {
    let id = "hive/ElbowPose-v0";
    let make = || Env::make(id, &OwnModels, &Options::default()).unwrap();
    let mut session = Session::playing(Play::new(make(), None, 7).unwrap());
    let (mut alone, mut policy) = (make(), Policy::random(7));
    alone.reset(Some(7)).unwrap();
    let mut action = vec![0.0; alone.action_len()];
    let (mut total, length) = (0.0, alone.spec().max_episode_steps);
    session.run(true);
    while session.play().unwrap().episode().steps < length {
        assert_eq!(session.advance(session.span(), &mut || true), 1);
        policy.action(&alone, &mut action).unwrap();
        total += alone.step(&action).unwrap().reward;
    }
    assert_eq!(session.data().state.qpos, alone.scene().data.state.qpos);
    let play = session.play().unwrap();
    assert_eq!((play.episode().reward, play.finished().0, play.is_over()), (total, 1, true));
    // The next step starts the next episode.
    session.advance(session.span(), &mut || true);
    alone.reset(Some(8)).unwrap();
    assert_eq!((session.play().unwrap().seed(), session.data().time()), (8, alone.scene().data.time()));
    assert_eq!(session.data().state.qpos, alone.scene().data.state.qpos);
}

#[test]
fn an_environment_goes_on_from_its_latest_state() {
    let env = Env::make("hive/FrankaReach-v0", &OwnModels, &Options::default()).unwrap();
    let mut session = Session::playing(Play::new(env, None, 0).unwrap());
    (0..5).for_each(|_| session.step_forward());
    let latest = session.data().time();
    (0..3).for_each(|_| session.step_back());
    assert!(session.data().time() < latest);
    session.run(true);
    assert_eq!(session.data().time(), latest);
    session.advance(session.span(), &mut || true);
    assert!((session.data().time() - latest - session.span()).abs() < 1e-9);
}

#[test]
fn hands_and_pulls_act_in_an_environment() {
    let env = Env::make("hive/FrankaReach-v0", &OwnModels, &Options::default()).unwrap();
    let mut session = Session::playing(Play::new(env, None, 0).unwrap());
    let play = session.play_mut().unwrap();
    play.let_act(Acting::Policy);
    assert_eq!(play.acting(), Acting::Random, "there is no policy");
    play.let_act(Acting::Hand);
    play.hand().fill(0.25);
    session.step_forward();
    assert!(session.play().unwrap().action().iter().all(|&a| a == 0.25));
    // A body that is pulled upwards rises against the same action.
    let hand = session.model().nbody - 1;
    let height = |session: &Session| session.data().kin.xpos[hand][2];
    let mut left =
        Session::playing(Play::new(session.play().unwrap().env().fork().unwrap(), None, 3).unwrap());
    let mut pulled =
        Session::playing(Play::new(session.play().unwrap().env().fork().unwrap(), None, 3).unwrap());
    for session in [&mut left, &mut pulled] {
        session.play_mut().unwrap().let_act(Acting::Zero);
    }
    pulled.set_selected(Some(hand));
    pulled.grab(Grip::Pull);
    pulled.drag(Plane::Vertical, [0.0, 0.5]);
    for session in [&mut left, &mut pulled] {
        session.run(true);
        for _ in 0..5 {
            session.advance(session.span(), &mut || true);
        }
    }
    assert!(height(&pulled) > height(&left) + 1e-4, "{} {}", height(&pulled), height(&left));
}
