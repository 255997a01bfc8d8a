//! The window without a display: keys, clicks on what is named, drags on the picture, dropped files.

#[path = "window/driver.rs"]
mod driver;
#[path = "window/insets.rs"]
mod insets;

use driver::Window;
use eframe::egui::{Event, Key, Modifiers, PointerButton, Pos2, pos2, vec2};
use physics::model::ObjType;
use render::picture::Channels;
use render::scene::Camera;
use robohive_viewer::window::{Making, Recording, Source, States};
use robohive_viewer::{Drawing, Session};
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

/// The middle of the picture.
const MIDDLE: Pos2 = pos2(536.0, 280.0);

#[test]
fn models_of_our_own_go_by_their_names() {
    let titles: Vec<String> = Source::own().map(|source| source.title()).collect();
    let names: Vec<&str> = robohive_viewer::own_models().map(|(name, _)| name).collect();
    assert_eq!(titles, names);
    assert!(names.contains(&"panda") && names.contains(&"quadruped"), "{names:?}");
}

#[test]
fn every_model_of_our_own_is_shown() {
    let mut shown = 0;
    for source in Source::own() {
        let window = Window::of(Some(source.clone()));
        assert_eq!(window.app.trouble(), None, "{source:?}");
        assert!(window.session().model().ngeom > 0, "{source:?}");
        shown += 1;
    }
    assert!(shown >= 10, "{shown}");
}

#[test]
fn environments_are_played() {
    let mut sources = Source::own_environments();
    let mut window = Window::of(sources.find(|source| source.title() == "hive/FrankaReach-v0"));
    assert_eq!(window.app.trouble(), None);
    window.use_named("Step");
    window.use_named("Zero");
    window.use_named("Step");
    let play = window.session().play().unwrap();
    assert_eq!((play.episode().steps, play.action()), (2, &vec![0.0; play.env().action_len()][..]));
    // Rewards are shown by name, and the next episode begins where it is asked for.
    let term = play.env().terms().rows()[0].name().to_owned();
    window.named(&term);
    window.use_named("Reset");
    let play = window.session().play().unwrap();
    assert_eq!((play.episode().steps, play.seed()), (0, 1));
}

#[test]
fn keys_run_step_and_switch() {
    let mut window = Window::own("pile");
    let timestep = window.session().model().opt.timestep;
    (0..3).for_each(|_| window.press(Key::ArrowRight, Modifiers::NONE));
    assert!((window.session().data().time() - 3.0 * timestep).abs() < 1e-12);
    window.press(Key::ArrowLeft, Modifiers::NONE);
    assert_eq!(window.session().history().behind(), 1);
    window.press(Key::Space, Modifiers::NONE);
    assert!(window.session().is_running());
    window.press(Key::Space, Modifiers::NONE);
    assert!(!window.session().is_running());
    window.press(Key::Minus, Modifiers::NONE);
    assert_eq!(window.session().pace().percent(), 80.0);
    window.press(Key::C, Modifiers::NONE);
    window.press(Key::S, Modifiers::NONE);
    window.press(Key::Num1, Modifiers::SHIFT);
    window.press(Key::F7, Modifiers::NONE);
    let options = window.session().options;
    assert!(options.show.contact_points && !options.effects.shadows && !options.groups.sites[1]);
    assert_ne!(options.label, render::scene::LabelChoice::None);
}

#[test]
fn what_is_named_can_be_used() {
    let mut window = Window::own("franka_table");
    window.use_named("Step");
    window.use_named("Step");
    assert_eq!(window.session().history().len(), 3);
    window.use_named("Step back");
    assert_eq!(window.session().history().behind(), 1);
    window.use_named("Run");
    assert!(window.session().is_running());
    window.use_named("Pause");
    assert!(!window.session().is_running());
    window.use_named("Clear all");
    assert!(window.session().data().state.ctrl.iter().all(|&x| x == 0.0));
    window.use_named("Physics");
    (0..30).for_each(|_| window.frame(Vec::new()));
    window.use_named("Help");
    (0..5).for_each(|_| window.frame(Vec::new()));
    window.named("Run or pause");
}

#[test]
fn drags_turn_the_camera_and_pull_bodies() {
    let mut window = Window::own("pile");
    let Camera::Free(before) = window.session().camera else { panic!() };
    let path = [MIDDLE, MIDDLE + vec2(56.0, 0.0), MIDDLE + vec2(56.0, 28.0)];
    window.drag(&path, PointerButton::Primary, Modifiers::NONE);
    let Camera::Free(after) = window.session().camera else { panic!() };
    assert!(after.azimuth < before.azimuth - 10.0 && after.elevation < before.elevation - 5.0, "{after:?}");
    // Click twice wherever a body is.
    let body = (0..40).find_map(|i| {
        let at = MIDDLE + vec2((i % 8) as f32 * 20.0 - 80.0, (i / 8) as f32 * 30.0 - 60.0);
        window.click(at);
        window.click(at);
        (0..40).for_each(|_| window.frame(Vec::new()));
        window.session().selected().map(|selected| (at, selected.body))
    });
    let (at, body) = body.expect("some body is near the middle");
    let place = |window: &Window| window.session().data().kin.xpos[body];
    let was = place(&window);
    window.drag(
        &[at, at - vec2(0.0, 40.0), at - vec2(0.0, 80.0)],
        PointerButton::Secondary,
        Modifiers::COMMAND,
    );
    let is = place(&window);
    assert!(is[2] > was[2] + 0.01, "it was placed higher: {was:?}, {is:?}");
    assert!(!window.session().holds());
}

#[test]
fn dropped_files_open_and_say_what_is_wrong() {
    let folder = std::env::temp_dir().join(format!("robohive-window-{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    let (good, bad) = (folder.join("good.xml"), folder.join("bad.xml"));
    let text = "<mujoco model='dropped'><worldbody><body name='a'><freejoint/><geom size='.1'/></body></worldbody></mujoco>";
    std::fs::write(&good, text).unwrap();
    std::fs::write(&bad, "<mujoco>\n<worldbody><geom sise='1'/></worldbody></mujoco>").unwrap();
    let mut window = Window::of(None);
    window.drop_file(&bad);
    let trouble = window.app.trouble().expect("the file is wrong").to_owned();
    assert!(
        trouble.contains("bad.xml:2:") && trouble.contains("sise") && trouble.contains("size"),
        "{trouble}"
    );
    assert!(window.app.opened().is_none());
    window.drop_file(&good);
    assert_eq!((window.app.trouble(), window.session().model().name.as_str()), (None, "dropped"));
    // Read again, it goes on where it was; with an error, it stays.
    (0..5).for_each(|_| window.press(Key::ArrowRight, Modifiers::NONE));
    let height = window.session().data().state.qpos[2];
    std::fs::write(&good, text.replace("name='a'", "name='a' gravcomp='1'")).unwrap();
    window.press(Key::L, Modifiers::COMMAND);
    assert_eq!(
        (window.session().model().body_gravcomp[1], window.session().data().state.qpos[2]),
        (1.0, height)
    );
    std::fs::write(&good, "<mujoco>").unwrap();
    window.press(Key::L, Modifiers::COMMAND);
    assert!(window.app.trouble().is_some_and(|trouble| trouble.contains("good.xml")));
    assert_eq!(window.session().model().label_of(ObjType::Body, 1), "body \"a\"");
    std::fs::remove_dir_all(&folder).unwrap();
}

/// A folder of its own for the files of a test.
fn folder(name: &str) -> PathBuf {
    let folder = std::env::temp_dir().join(format!("robohive-window-{name}-{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    folder
}

#[test]
fn a_dropped_trajectory_is_replayed_and_a_second_one_shown_beside_it() {
    let folder = folder("trajectory");
    let states = folder.join("states.npz");
    let mut session = Session::new(Window::own("pile").session().model().clone()).unwrap();
    session.record(&states).unwrap();
    session.run(true);
    session.advance(0.05, &mut || true);
    session.stop_recording().unwrap();
    let mut window = Window::of(None);
    window.drop_file(&states);
    assert!(
        window.app.trouble().is_some_and(|why| why.contains("open the model first")),
        "{:?}",
        window.app.trouble()
    );
    let mut window = Window::own("pile");
    window.drop_file(&states);
    assert_eq!(window.app.trouble(), None);
    let rows = window.session().replay().expect("it is replayed").trajectory().len();
    window.press(Key::ArrowRight, Modifiers::NONE);
    assert_eq!((window.session().replay().unwrap().row(), rows), (1, 26));
    window.drop_file(&states);
    assert_eq!(window.session().reference().unwrap().difference(), Some(0.0));
    window.use_named("Simulate from here");
    assert!(window.session().replay().is_none() && window.session().reference().is_some());
    window.drop_file(&folder.join("other.npz"));
    assert!(window.app.trouble().is_some_and(|why| why.contains("other.npz")), "{:?}", window.app.trouble());
    std::fs::remove_dir_all(&folder).unwrap();
}

#[test]
fn recorded_states_open_with_their_model() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let states = |name: &str| root.join(format!("validation/reference/own/{name}.npz"));
    let model = |name: &str| Source::own().find(|source| source.title() == name).unwrap();
    let shown = |replayed: Option<&str>, reference: &str| {
        let [replayed, reference] = [replayed, Some(reference)].map(|name| name.map(states));
        Source::States(Box::new(States { of: model("pile"), replayed, reference }))
    };
    let source = shown(Some("pile"), "pile");
    assert!(source.title().ends_with("pile.npz: pile") && source.check().is_ok());
    let mut window = Window::of(Some(source));
    assert_eq!(window.session().reference().unwrap().difference(), Some(0.0));
    window.press(Key::ArrowRight, Modifiers::NONE);
    assert_eq!(window.session().replay().unwrap().row(), 1);
    // Read again, the model is shown in the same states.
    window.press(Key::L, Modifiers::COMMAND);
    assert_eq!((window.app.trouble(), window.session().replay().map(|replay| replay.row())), (None, Some(1)));
    assert!(window.session().reference().is_some());
    // Beside a simulation, a reference alone.
    let window = Window::of(Some(shown(None, "pile")));
    assert!(window.session().replay().is_none() && window.session().reference().is_some());
    let wrong = shown(Some("franka_table"), "pile");
    let why = wrong.check().unwrap_err().to_string();
    assert!(why.contains("franka_table.npz") && why.contains("is it of this model?"), "{why}");
    let window = Window::of(Some(wrong));
    assert_eq!(window.app.trouble(), Some(&why[..]));
    let environment = Source::own_environments().next().unwrap();
    let wrong = States { of: environment, replayed: Some(states("pile")), reference: None };
    let why = Source::States(Box::new(wrong)).check().unwrap_err().to_string();
    assert!(why.contains("is an environment"), "{why}");
    let missing = Recording { path: "nowhere.h5".into(), environment: None, making: Making::default() };
    assert!(Source::Episodes(missing).check().unwrap_err().to_string().contains("nowhere.h5"));
}

#[test]
fn recorded_episodes_are_shown_trial_by_trial() {
    let folder = folder("episodes");
    let file = folder.join("reach.h5");
    let mut sources = Source::own_environments();
    let mut window = Window::of(sources.find(|source| source.title() == "hive/FrankaReach-v0"));
    let session = window.app.opened_mut().unwrap();
    let horizon = session.play().unwrap().env().spec().max_episode_steps;
    session.record(&file).unwrap();
    session.begin(3);
    (0..2 * horizon + 2).for_each(|_| session.step_forward());
    assert_eq!(session.stop_recording().unwrap().unwrap().count, 2);
    window.drop_file(&file);
    assert_eq!(window.app.trouble(), None);
    window.app.opened_mut().unwrap().seek(usize::MAX);
    let first = window.session().data().state.qpos.clone();
    assert_eq!(window.session().replay().unwrap().trajectory().len(), horizon + 1);
    window.use_named("Trial0");
    (0..10).for_each(|_| window.frame(Vec::new()));
    window.use_named("Trial1");
    assert!(window.session().replay().unwrap().trajectory().name().ends_with("Trial1"));
    window.app.opened_mut().unwrap().seek(usize::MAX);
    assert_ne!(window.session().data().state.qpos, first, "each has actions of its own");
    std::fs::remove_dir_all(&folder).unwrap();
}

#[test]
fn depth_and_objects_are_seen_in_false_colours() {
    let mut window = Window::own("pile");
    let size = [160, 120];
    let mut drawing = Drawing::new(window.session().model()).unwrap();
    let drawn = |window: &mut Window| window.app.drawn_by_cpu(size).unwrap().unwrap();
    let choose = |window: &mut Window, from: &str, to: &str| {
        window.use_named(from);
        (0..10).for_each(|_| window.frame(Vec::new()));
        window.use_named(to);
        (0..3).for_each(|_| window.frame(Vec::new()));
        assert_eq!(window.app.trouble(), None);
    };
    let colours = drawn(&mut window).rgb;
    choose(&mut window, "Colours", "Depth");
    let seen = drawn(&mut window);
    let depth = drawing.draw_channels(window.session(), size, Channels::DEPTH).unwrap().depth.clone();
    assert_eq!(seen.depth, depth);
    let nearest = (0..depth.len()).min_by(|&a, &b| depth[a].total_cmp(&depth[b])).unwrap();
    let farthest = (0..depth.len()).max_by(|&a, &b| depth[a].total_cmp(&depth[b])).unwrap();
    let pixel = |at: usize| [seen.rgb[3 * at], seen.rgb[3 * at + 1], seen.rgb[3 * at + 2]];
    assert_eq!([pixel(nearest), pixel(farthest)], [video::DEPTH_COLOURS[0], video::DEPTH_COLOURS[4]]);
    assert_eq!(window.texts.iter().filter(|text| text.ends_with(" m")).count(), 2, "{:?}", window.texts);
    window.named("drawn by CPU");
    choose(&mut window, "Depth", "Objects");
    let seen = drawn(&mut window);
    let objects = drawing.draw_channels(window.session(), size, Channels::SEGMENTATION).unwrap();
    assert_eq!(seen.segmentation, objects.segmentation);
    let pairs: BTreeSet<_> = seen.segmentation.iter().zip(seen.rgb.as_chunks::<3>().0).collect();
    let kinds: BTreeSet<_> = seen.segmentation.iter().collect();
    let shades: BTreeSet<_> = seen.rgb.as_chunks::<3>().0.iter().collect();
    assert!(kinds.len() > 5 && pairs.len() == kinds.len() && shades.len() == kinds.len(), "{kinds:?}");
    assert!(!window.texts.iter().any(|text| text.ends_with(" m")));
    choose(&mut window, "Objects", "Colours");
    assert_eq!(drawn(&mut window).rgb, colours);
}

#[test]
fn keys_move_the_action_instead_of_switching() {
    let mut sources = Source::own_environments();
    let mut window = Window::of(sources.find(|source| source.title() == "hive/FrankaReach-v0"));
    window.use_named("By hand");
    window.use_named("Keys move actions");
    let shows = window.session().options.show;
    let hold = |pressed| Event::Key {
        key: Key::D,
        physical_key: None,
        pressed,
        repeat: false,
        modifiers: Modifiers::NONE,
    };
    window.frame(vec![hold(true)]);
    for _ in 0..5 {
        std::thread::sleep(std::time::Duration::from_millis(20));
        window.frame(Vec::new());
    }
    window.frame(vec![hold(false)]);
    let moved = window.app.opened_mut().unwrap().play_mut().unwrap().hand().to_vec();
    assert!(moved[0] > 0.0 && moved[1..].iter().all(|&x| x == 0.0), "{moved:?}");
    assert_eq!(window.session().options.show, shows, "D would hide static bodies");
}

#[test]
fn states_models_and_numbers_are_written() {
    let mut window = Window::own("pile");
    let written = std::rc::Rc::new(std::cell::RefCell::new(Vec::new()));
    let to = written.clone();
    window.app.save_by(Box::new(move |name, bytes| {
        to.borrow_mut().push((name.to_owned(), bytes.to_vec()));
        Ok(name.to_owned())
    }));
    window.use_named("Keep state");
    for name in ["Save as MJCF", "Save compiled", "Print data", "Save kept states"] {
        window.use_named("File");
        (0..5).for_each(|_| window.frame(Vec::new()));
        window.use_named(name);
        (0..5).for_each(|_| window.frame(Vec::new()));
    }
    assert_eq!(window.app.trouble(), None);
    let written = written.borrow();
    let of =
        |name: &str| &written.iter().find(|(file, _)| file == name).unwrap_or_else(|| panic!("no {name}")).1;
    let text = |name: &str| String::from_utf8(of(name).clone()).unwrap();
    let again = mjcf::load_str(text("model.xml")).unwrap().model;
    let model = window.session().model();
    assert_eq!((again.nbody, &again.body_mass[..]), (model.nbody, &model.body_mass[..]));
    assert_eq!(physics::Model::from_bytes(of("model.rhm")).unwrap().nq, model.nq);
    assert!(text("data.txt").contains(&format!("qpos [{}]", model.nq)));
    assert!(text("keyframes.xml").contains("<key time=\"0\" qpos="));
}
