//! The window of another program, without a display: what the program orders is shown, and keys, gestures and panels are
//! reported to it.

use eframe::egui::{Context, Event, Key, Modifiers, PointerButton, Pos2, RawInput, Rect, pos2, vec2};
use physics::{Data, Model, forward};
use robohive_viewer::remote::{Bytes, Client, Figure, Image, Line, Link, Opening, Order, Place, Text};
use robohive_viewer::window::{App, Painters};
use std::io::pipe;
use std::time::{Duration, Instant};

const LONG: Duration = Duration::from_secs(20);

const TEXT: &str = "<mujoco model='served'><statistic center='0 0 1' extent='2'/><visual><global elevation='0'/></visual>\
    <worldbody><body name='ball' pos='0 0 1'><freejoint/><geom size='.5'/></body></worldbody></mujoco>";

/// A program, and its window.
struct Served {
    client: Client,
    context: Context,
    app: App,
    time: f64,
    data: Data,
    model: Model,
}

impl Served {
    fn new(opening: Opening) -> Self {
        let model = mjcf::load_str(TEXT).unwrap().model;
        let mut data = Data::new(&model);
        forward(&model, &mut data).unwrap();
        let ((from_window, to_program), (from_program, to_window)) = (pipe().unwrap(), pipe().unwrap());
        let meeting =
            std::thread::spawn(move || Link::meet(from_program, to_program, || ()).unwrap().unwrap());
        let client = Client::over(from_window, to_window, opening, Some((&model, &data)));
        let (link, opening) = meeting.join().unwrap();
        let context = Context::default();
        let app = App::of_program(&context, Painters::default(), link, &opening);
        let mut served = Served { client, context, app, time: 0.0, data, model };
        (0..3).for_each(|_| served.frame(Vec::new()));
        served
    }

    fn frame(&mut self, events: Vec<Event>) {
        self.time += 1.0 / 60.0;
        let screen = Rect::from_min_size(Pos2::ZERO, vec2(900.0, 560.0));
        let input =
            RawInput { screen_rect: Some(screen), time: Some(self.time), events, ..RawInput::default() };
        let app = &mut self.app;
        let mut output = self.context.run_ui(input, |ui| app.show(ui));
        output.textures_delta.clear();
    }

    /// Frames until something is so.
    fn until(&mut self, is_so: impl Fn(&Self) -> bool) {
        let until = Instant::now() + LONG;
        while !is_so(self) {
            assert!(Instant::now() < until, "it does not come to pass");
            self.frame(Vec::new());
        }
    }

    fn press(&mut self, key: Key) {
        let event = |pressed| Event::Key {
            key,
            physical_key: None,
            pressed,
            repeat: false,
            modifiers: Modifiers::NONE,
        };
        self.frame(vec![event(true), event(false)]);
    }

    fn button(&mut self, button: PointerButton, pressed: bool, modifiers: Modifiers) {
        let click = Event::PointerButton { pos: MIDDLE, button, pressed, modifiers };
        self.frame(vec![Event::ModifiersChanged(modifiers), Event::PointerMoved(MIDDLE), click]);
    }
}

/// The middle of the picture, where the ball is.
const MIDDLE: Pos2 = pos2(450.0, 270.0);

fn bare() -> Opening {
    Opening { title: "served".into(), keys: true, ..Opening::default() }
}

#[test]
fn states_are_shown_and_the_window_keeps_no_time() {
    let mut served = Served::new(bare());
    assert!(served.app.has_program() && served.app.trouble().is_none());
    served.data.state.qpos[2] = 2.5;
    assert!(served.client.sync(&served.model, &served.data, true));
    served.until(|served| served.app.opened().unwrap().data().kin.xpos[1][2] == 2.5);
    served.press(Key::Space);
    served.press(Key::ArrowRight);
    served.press(Key::Backspace);
    let session = served.app.opened().unwrap();
    assert!(!session.is_running() && session.data().time() == 0.0 && session.data().kin.xpos[1][2] == 2.5);
    let place = served.client.reports().wait(LONG, |seen| seen.place.is_some()).place.unwrap();
    assert!(place.left == 0 && place.width == 900 && place.height > 400 && place.bottom > 0, "{place:?}");
}

#[test]
fn keys_are_reported_and_may_do_nothing_else() {
    let mut served = Served::new(bare());
    [Key::C, Key::F6, Key::ArrowLeft].into_iter().for_each(|key| served.press(key));
    assert_eq!(served.client.reports().wait(LONG, |seen| seen.keys.len() == 3).keys, [67, 295, 263]);
    assert!(served.client.seen().is_some_and(|sight| sight.options.show.contact_points));
    let mut mute = Served::new(Opening { keys: false, ..bare() });
    mute.press(Key::C);
    assert_eq!(mute.client.reports().wait(LONG, |seen| !seen.keys.is_empty()).keys, [67]);
    assert!(!mute.app.opened().unwrap().options.show.contact_points);
}

#[test]
fn a_body_is_selected_and_pulled() {
    let mut served = Served::new(bare());
    for _ in 0..2 {
        served.button(PointerButton::Primary, true, Modifiers::NONE);
        served.button(PointerButton::Primary, false, Modifiers::NONE);
    }
    drop(served.client.reports().wait(LONG, |seen| seen.grasp.is_some_and(|grasp| grasp.body == 1)));
    // Two clicks more would be others.
    (0..60).for_each(|_| served.frame(Vec::new()));
    served.button(PointerButton::Secondary, true, Modifiers::COMMAND);
    for step in 1..5 {
        served.frame(vec![Event::PointerMoved(MIDDLE - vec2(0.0, 20.0 * step as f32))]);
    }
    let grasp = served.client.reports().wait(LONG, |seen| seen.grasp.is_some_and(|grasp| grasp.pulls)).grasp;
    let grasp = grasp.unwrap();
    assert!(grasp.target[2] > served.data.kin.xpos[1][2] + 0.1 && grasp.mass > 0.0, "{grasp:?}");
    // The program moves the body, not the window.
    assert_eq!(served.app.opened().unwrap().data().state.qpos, served.data.state.qpos);
    served.button(PointerButton::Secondary, false, Modifiers::NONE);
    served.frame(Vec::new());
    drop(served.client.reports().wait(LONG, |seen| seen.grasp.is_some_and(|grasp| !grasp.pulls)));
}

#[test]
fn overlays_and_messages_are_shown_and_the_program_closes_the_window() {
    let mut served = Served::new(bare());
    let place = Place { left: 10, bottom: 20, width: 200, height: 100 };
    let texts =
        (0..9).map(|corner| Text { big: corner == 2, corner, first: "title".into(), second: "text".into() });
    served.client.tell(&Order::Texts(texts.collect()));
    let image = |bytes| Image { place, rgb: Bytes(vec![7; bytes]) };
    // One is no picture of its size.
    served.client.tell(&Order::Images(vec![image(60_000), image(5)]));
    let line =
        Line { name: "a".into(), rgb: [1.0; 3], points: vec![[0.0, 1.0], [f32::NAN, 2.0], [3.0, 4.0]] };
    for (bars, grows) in [(false, true), (true, false)] {
        let figure = Figure {
            place,
            title: "figure".into(),
            across: "s".into(),
            bars,
            legend: true,
            grows,
            range: [[0.0, 2.0], [1.0, 1.0]],
            background: [0.0, 0.0, 0.0, 2.0],
            lines: vec![line.clone()],
        };
        served.client.tell(&Order::Figures(vec![figure]));
        served.client.tell(&Order::Trouble(format!("bars {bars}")));
        served.until(|served| served.app.trouble() == Some(&format!("bars {bars}")));
        (0..3).for_each(|_| served.frame(Vec::new()));
    }
    served.client.tell(&Order::Trouble(String::new()));
    served.until(|served| served.app.trouble().is_none());
    served.press(Key::L);
    served.client.tell(&Order::Close);
    (0..5).for_each(|_| served.frame(Vec::new()));
}

#[test]
fn reloading_is_asked_of_the_program() {
    let mut served = Served::new(Opening { runs: true, ..bare() });
    served.until(|served| served.app.opened().unwrap().data().time() > 0.0);
    let event = |pressed| Event::Key {
        key: Key::L,
        physical_key: None,
        pressed,
        repeat: false,
        modifiers: Modifiers::COMMAND,
    };
    served.frame(vec![Event::ModifiersChanged(Modifiers::COMMAND), event(true), event(false)]);
    drop(served.client.reports().wait(LONG, |seen| seen.reload));
    assert!(served.client.reports().look().reload);
    let title = Opening { title: "again".into(), left: true, ..bare() };
    served.client.open(title, Some((&served.model, &served.data)));
    served.until(|served| served.app.opened().unwrap().is_following());
}
