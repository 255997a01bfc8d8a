//! A program and its window over pipes, without a display: what is sent arrives, what a person does comes back, and either end
//! may break off.

use physics::{Data, Model, forward, step};
use render::scene::{Camera, Category, Item, Look, Object, Shape};
use robohive_viewer::remote::{
    Client, Figure, Image, Line, Link, Opening, Order, Orders, PROTOCOL, Place, Refused, Report, Sight, Text,
};
use robohive_viewer::{Command, Grip, Plane, Session};
use std::io::{Write, pipe};
use std::time::{Duration, Instant};

const TEXT: &str = "<mujoco model='pair'><option timestep='.01'/><worldbody><light pos='0 0 3'/>\
    <geom name='floor' type='plane' size='2 2 .1'/>\
    <body name='ball' pos='0 0 1'><freejoint/><geom size='.2'/></body>\
    <body name='arm' pos='1 0 1'><joint name='hinge' axis='0 1 0'/><geom type='capsule' fromto='0 0 0 .5 0 0' size='.05'/></body>\
    <body name='target' mocap='true' pos='0 1 1'><geom size='.1'/></body></worldbody>\
    <equality><joint joint1='hinge'/></equality>\
    <actuator><motor joint='hinge' ctrlrange='-1 1'/><position joint='hinge' kp='3'/></actuator></mujoco>";

fn model() -> Model {
    mjcf::load_str(TEXT).unwrap().model
}

fn simulation(model: &Model) -> Data {
    let mut data = Data::new(model);
    data.state.qvel[0] = 0.5;
    (0..20).for_each(|_| step(model, &mut data).unwrap());
    forward(model, &mut data).unwrap();
    data
}

/// A program, its window, and the session there.
struct Pair {
    client: Client,
    link: Link,
    session: Session,
}

fn opening() -> Opening {
    Opening { title: "pair".into(), left: true, keys: true, ..Opening::default() }
}

fn pair(model: &Model, data: &Data, opening: Opening) -> Pair {
    let ((from_window, to_program), (from_program, to_window)) = (pipe().unwrap(), pipe().unwrap());
    // More than a pipe holds may be said before anybody listens.
    let meeting = std::thread::spawn(move || Link::meet(from_program, to_program, || ()).unwrap().unwrap());
    let client = Client::over(from_window, to_window, opening, Some((model, data)));
    let (mut link, opening) = meeting.join().unwrap();
    assert_eq!((opening.title.as_str(), opening.left, opening.right), ("pair", true, false));
    let session = link.open(&opening).unwrap().expect("there is a model");
    link.tell(&Report::Ready);
    drop(client.reports().wait(LONG, |seen| seen.ready));
    Pair { client, link, session }
}

const LONG: Duration = Duration::from_secs(20);

impl Pair {
    /// Waits for orders that `enough` accepts, and does them.
    fn window(&mut self, enough: impl Fn(&Orders) -> bool) -> Orders {
        let until = Instant::now() + LONG;
        let mut all = self.link.orders();
        while !enough(&all) {
            assert!(Instant::now() < until, "nothing arrives: {all:?}");
            std::thread::sleep(Duration::from_millis(1));
            let more = self.link.orders();
            all.state = more.state.or(all.state);
            all.sight = more.sight.or(all.sight);
            all.items = more.items.or(all.items);
            all.texts = more.texts.or(all.texts);
            all.figures = more.figures.or(all.figures);
            all.images = more.images.or(all.images);
            all.edits.extend(more.edits);
            all.close |= more.close;
        }
        self.link.follow(&mut self.session, &mut all).unwrap();
        all
    }
}

#[test]
fn states_models_and_items_arrive_as_they_were() {
    let mut model = model();
    let mut data = simulation(&model);
    let mut pair = pair(&model, &data, opening());
    assert_eq!(pair.session.data().kin.xpos, data.kin.xpos);
    assert_eq!(pair.session.data().state.qpos, data.state.qpos);
    assert!(pair.session.is_following() && !pair.session.is_running());
    // The program goes on, and edits its model.
    (0..50).for_each(|_| step(&model, &mut data).unwrap());
    data.state.xfrc_applied[1][2] = 3.0;
    model
        .overwrite(|draft| {
            draft.geom_rgba[1] = [0.1, 0.2, 0.3, 0.4];
            draft.opt.gravity = [0.0, 1.0, -2.0];
            draft.vis.map.znear = 0.02;
        })
        .unwrap();
    forward(&model, &mut data).unwrap();
    assert!(pair.client.sync(&model, &data, true));
    pair.window(|orders| orders.state.is_some());
    let (shown, state) = (pair.session.model(), &pair.session.data().state);
    assert_eq!(state.qpos, data.state.qpos);
    assert_eq!((state.time, state.xfrc_applied[1][2]), (data.state.time, 3.0));
    assert_eq!(pair.session.data().kin.geom_xpos, data.kin.geom_xpos);
    assert_eq!((shown.geom_rgba[1], shown.opt.gravity), ([0.1, 0.2, 0.3, 0.4], [0.0, 1.0, -2.0]));
    assert_eq!(shown.vis.map.znear, 0.02);
    // The state alone leaves the model as it was.
    model.overwrite(|draft| draft.geom_rgba[1] = [1.0; 4]).unwrap();
    pair.client.sync(&model, &data, false);
    pair.window(|orders| orders.state.is_some());
    assert_eq!(pair.session.model().geom_rgba[1], [0.1, 0.2, 0.3, 0.4]);
    let item = Item {
        shape: Shape::Mesh { mesh: 3 },
        pos: [1.0, 2.0, 3.0],
        mat: [0.0, 1.0, 0.0, -1.0, 0.0, 0.0, 0.0, 0.0, 1.0],
        size: [0.1, 0.2, 0.3],
        rgba: [0.5, 0.25, 0.125, 1.0],
        look: Look { emission: 0.25, ..Look::default() },
        material: Some(7),
        rbound: 2.0,
        object: Object { kind: -1, id: 5 },
        category: Category::Decor,
        unlisted: true,
        label: "here".into(),
    };
    pair.client.tell(&Order::Items(vec![item.clone(), Item { shape: Shape::Arrow, ..item.clone() }]));
    pair.window(|orders| orders.items.is_some());
    assert_eq!(pair.session.guests()[0], item);
    assert_eq!(pair.session.guests()[1].shape, Shape::Arrow);
}

#[test]
fn overlays_arrive_and_the_latest_replace_the_former() {
    let model = model();
    let mut pair = pair(&model, &simulation(&model), opening());
    let place = Place { left: 3, bottom: 4, width: 2, height: 1 };
    let text = |first: &str| Text { big: true, corner: 3, first: first.into(), second: "x".into() };
    pair.client.tell(&Order::Texts(vec![text("old")]));
    pair.client.tell(&Order::Texts(vec![text("new"), text("too")]));
    let image = Image { place, rgb: robohive_viewer::remote::Bytes(vec![1, 2, 3, 4, 5, 6]) };
    pair.client.tell(&Order::Images(vec![image.clone()]));
    let line = Line { name: "a".into(), rgb: [1.0, 0.5, 0.0], points: vec![[0.0, 1.0], [2.0, 3.0]] };
    let figure = Figure {
        place,
        title: "t".into(),
        across: "s".into(),
        bars: false,
        legend: true,
        grows: false,
        range: [[0.0, 1.0], [2.0, 3.0]],
        background: [0.0, 0.0, 0.0, 0.5],
        lines: vec![line],
    };
    pair.client.tell(&Order::Figures(vec![figure.clone()]));
    let orders = pair.window(|orders| orders.figures.is_some());
    assert_eq!(orders.texts.unwrap(), [text("new"), text("too")]);
    assert_eq!((orders.images.unwrap(), orders.figures.unwrap()), (vec![image], vec![figure]));
}

#[test]
fn what_a_person_does_comes_back() {
    let mut model = model();
    let data = simulation(&model);
    let mut pair = pair(&model, &data, opening());
    pair.session.cycle_camera(0);
    let Camera::Free(mut free) = pair.session.camera else { panic!("it begins free") };
    free.azimuth = 12.5;
    pair.session.camera = Camera::Free(free);
    pair.session.perform(Command::NextLabels);
    pair.session.perform(Command::Show(14));
    pair.session.perform(Command::Sites(1));
    pair.session.edit(|_, data| {
        data.state.ctrl[1] = 0.75;
        data.state.eq_active[0] = false;
    });
    pair.session.edit_options(|options| options.gravity[2] = -3.0);
    pair.session.set_selected(Some(1));
    pair.session.grab(Grip::Pull);
    pair.session.drag(Plane::Vertical, [0.0, 0.25]);
    pair.link.report(&pair.session);
    pair.link.tell(&Report::Key(262));
    pair.link.report_place(Place { left: 1, bottom: 2, width: 3, height: 4 });
    let options = pair.session.options;
    {
        let seen = pair.client.reports().wait(LONG, |seen| seen.place.is_some());
        assert_eq!((seen.controls.get(&1), seen.controls.len()), (Some(&0.75), 1));
        assert_eq!(seen.equalities.get(&0), Some(&false));
        assert_eq!((seen.settings.len(), seen.settings[0].name.as_str()), (1, "gravity"));
        assert_eq!((seen.keys.as_slice(), seen.place.unwrap().height), (&[262][..], 4));
        let grasp = seen.grasp.unwrap();
        assert!(grasp.body == 1 && grasp.pulls && !grasp.turns && grasp.mass > 0.0, "{grasp:?}");
        assert!(grasp.target[2] > data.kin.xpos[1][2] + 0.01, "{grasp:?}");
        assert_eq!(grasp.origin[2] - data.kin.xipos[1][2], grasp.target[2] - data.kin.xpos[1][2]);
    }
    let sight = pair.client.seen().expect("the camera was moved");
    assert_eq!(sight, Sight { camera: Camera::Free(free), options });
    // What is reported is no news any more: not to the window, nor to the program that has taken it over.
    pair.link.report(&pair.session);
    model.options_mut().gravity[2] = -3.0;
    pair.client.agrees(&model);
    pair.client.sync(&model, &data, true);
    let orders = pair.window(|orders| orders.state.is_some());
    assert!(orders.edits.is_empty());
    pair.session.release();
    pair.link.report(&pair.session);
    let seen = pair.client.reports().wait(LONG, |seen| seen.grasp.is_some_and(|grasp| !grasp.pulls));
    assert!(seen.controls.len() == 1 && seen.grasp.unwrap().body == 1);
}

#[test]
fn a_sight_chosen_before_the_programs_word_was_heard_does_not_count() {
    let model = model();
    let mut pair = pair(&model, &simulation(&model), opening());
    pair.session.perform(Command::Show(0));
    pair.link.report(&pair.session);
    drop(pair.client.reports().wait(LONG, |seen| seen.sight.is_some()));
    let mine = Sight { camera: Camera::free(&model), options: Default::default() };
    pair.client.look(mine);
    assert!(pair.client.seen().is_none());
    pair.window(|orders| orders.sight.is_some());
    assert_eq!(pair.session.options, mine.options);
    pair.link.report(&pair.session);
    pair.session.perform(Command::Show(2));
    pair.link.report(&pair.session);
    drop(pair.client.reports().wait(LONG, |seen| seen.sight.is_some()));
    assert!(pair.client.seen().is_some_and(|sight| sight.options.show.joints));
}

#[test]
fn followers_keep_no_time_and_runners_return_their_state() {
    let model = model();
    let data = simulation(&model);
    let mut follower = pair(&model, &data, opening());
    for command in [Command::Run, Command::StepForward, Command::Reset, Command::StepBack] {
        follower.session.perform(command);
    }
    assert_eq!(follower.session.advance(1.0, &mut || true), 0);
    assert_eq!(follower.session.data().state.qpos, data.state.qpos);
    follower.link.leave(Some(&follower.session));
    let seen = follower.client.reports().wait(LONG, |seen| seen.left);
    assert!(seen.last.is_none());
    drop(seen);
    let mut runner = pair(&model, &data, Opening { runs: true, ..opening() });
    assert_eq!(runner.session.advance(0.1, &mut || true), 10);
    runner.link.leave(Some(&runner.session));
    let last = runner.client.reports().wait(LONG, |seen| seen.left).last.take().expect("its state");
    let mut reached = Data::new(&model);
    assert!(last.write(&mut reached));
    let mut expected = data.clone();
    (0..10).for_each(|_| step(&model, &mut expected).unwrap());
    assert_eq!(reached.state.qpos, expected.state.qpos);
    assert!(!runner.client.is_open());
}

#[test]
fn states_of_other_models_are_refused() {
    let model = model();
    let data = simulation(&model);
    let mut pair = pair(&model, &data, opening());
    let other =
        mjcf::load_str("<mujoco><worldbody><body><freejoint/><geom size='1'/></body></worldbody></mujoco>");
    let other = other.unwrap().model;
    pair.client.sync(&other, &Data::new(&other), false);
    let until = Instant::now() + LONG;
    let mut orders = pair.link.orders();
    while orders.state.is_none() {
        assert!(Instant::now() < until);
        orders = pair.link.orders();
    }
    let refused = pair.link.follow(&mut pair.session, &mut orders);
    assert!(matches!(refused, Err(Refused::State)), "{refused:?}");
    assert_eq!(pair.session.data().state.qpos, data.state.qpos);
}

#[test]
fn either_end_may_break_off() {
    let model = model();
    let data = simulation(&model);
    let Pair { mut client, link, .. } = pair(&model, &data, opening());
    assert!(client.is_open() && client.sync(&model, &data, true));
    // The window's process dies.
    drop(link);
    drop(client.reports().wait(LONG, |seen| seen.over));
    assert!(!client.is_open());
    assert!(!client.sync(&model, &data, true), "nothing is sent, and nothing fails");
    client.close();
    // The program's process dies.
    let Pair { client, link, .. } = pair(&model, &data, opening());
    drop(client);
    let until = Instant::now() + LONG;
    while !link.orders().close {
        assert!(Instant::now() < until);
    }
}

/// What a client says of a window that answers with these bytes.
fn answered(bytes: &[u8]) -> String {
    let ((from_window, mut to_program), (from_program, to_window)) = (pipe().unwrap(), pipe().unwrap());
    to_program.write_all(bytes).unwrap();
    drop(to_program);
    let client = Client::over(from_window, to_window, opening(), None);
    let seen = client.reports().wait(LONG, |seen| seen.over);
    drop(from_program);
    seen.failed.clone().unwrap_or_default()
}

#[test]
fn what_is_no_window_is_named() {
    let greeting = |text: &str| {
        [&(8 + text.len() as u64).to_le_bytes()[..], &(text.len() as u64).to_le_bytes(), text.as_bytes()]
            .concat()
    };
    let other = answered(&greeting("robohive viewer 0, 0.0.1"));
    assert!(other.contains("0.0.1") && other.contains(PROTOCOL), "{other}");
    let noise = answered(b"Traceback (most recent call last):");
    assert!(noise.contains("1 GiB"), "{noise}");
    let unknown = [greeting(PROTOCOL), 1_u64.to_le_bytes().to_vec(), vec![200]].concat();
    assert!(answered(&unknown).contains("200 stands for no Report"), "{}", answered(&unknown));
    let cut = [greeting(PROTOCOL), 9_u64.to_le_bytes().to_vec(), vec![7]].concat();
    assert!(answered(&cut).contains("shorter"), "{}", answered(&cut));
    assert_eq!(answered(&greeting(PROTOCOL)), "");
}

#[test]
fn a_slow_window_holds_the_latest_state_alone() {
    let model = model();
    let mut data = simulation(&model);
    let mut pair = pair(&model, &data, opening());
    for _ in 0..2000 {
        data.state.time += 1.0;
        assert!(pair.client.sync(&model, &data, true));
    }
    let last = data.state.time;
    pair.window(|orders| orders.state.as_ref().is_some_and(|state| state.time == last));
    assert_eq!(pair.session.data().time(), last);
}
