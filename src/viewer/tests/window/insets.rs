//! What other cameras see, over the picture.

use crate::driver::Window;
use eframe::egui::{Key, Modifiers, Rect};
use robohive_viewer::window::Source;

const OVERVIEW: &str = "camera \"overview\"";
const EYE: &str = "camera \"eye\"";

fn places(window: &Window) -> Vec<(String, Rect)> {
    window.app.insets().map(|(name, place)| (name.to_owned(), place)).collect()
}

/// A window on a model with two cameras, whose panel of cameras is open.
fn opened() -> Window {
    let mut window = Window::own("workbench");
    assert!(places(&window).is_empty());
    window.use_named("View");
    window.use_named("Cameras");
    (0..30).for_each(|_| window.frame(Vec::new()));
    window
}

#[test]
fn chosen_cameras_are_shown_until_they_are_unticked() {
    let mut window = opened();
    window.click_as_reader(&format!("Show {EYE}"));
    window.use_named(&format!("Show {OVERVIEW}"));
    let shown = places(&window);
    // In the order of the model, each in its own shape, apart and over the picture.
    let names: Vec<&str> = shown.iter().map(|(name, _)| &name[..]).collect();
    assert_eq!(names, [OVERVIEW, EYE]);
    let (first, second) = (shown[0].1, shown[1].1);
    let area = window.app.area();
    assert!(
        area.contains_rect(first) && area.contains_rect(second) && !first.intersects(second),
        "{shown:?}"
    );
    for place in [first, second] {
        assert!((place.width() / place.height() - 4.0 / 3.0).abs() < 0.02, "{place:?}");
        assert!((place.width() / area.width() - 0.25).abs() < 0.01, "{place:?} in {area:?}");
    }
    // Somebody who does not see them hears what they are.
    window.named(&format!("What {EYE} sees"));
    assert!(window.texts.iter().any(|text| text == OVERVIEW), "{:?}", window.texts);
    assert_eq!(window.app.trouble(), None);
    window.click_as_reader(&format!("Show {EYE}"));
    assert_eq!(places(&window).len(), 1);
    window.use_named(&format!("Show {OVERVIEW}"));
    assert!(places(&window).is_empty());
    assert!(!window.texts.iter().any(|text| text == OVERVIEW));
}

#[test]
fn they_follow_the_scene_and_show_what_is_chosen() {
    let mut window = opened();
    window.use_named(&format!("Show {OVERVIEW}"));
    let seen = |window: &Window| window.picture_at(places(window)[0].1).expect("it is shown");
    let (size, first) = seen(&window);
    window.frame(Vec::new());
    assert!(seen(&window).1 == first);
    // As the camera itself shows it in the middle of the window, at the same size.
    let session = window.app.opened_mut().unwrap();
    let free = session.camera;
    session.camera = render::scene::Camera::named(session.model(), "overview").unwrap();
    let whole = window.app.drawn_by_cpu(size).unwrap().unwrap();
    assert!(whole.rgb == first, "a small picture is what the camera sees");
    window.app.opened_mut().unwrap().camera = free;
    (0..100).for_each(|_| window.press(Key::ArrowRight, Modifiers::NONE));
    let (_, later) = seen(&window);
    assert!(later != first);
    window.click_as_reader(&format!("Objects of {OVERVIEW}"));
    let (_, objects) = seen(&window);
    // Flat colours: far fewer than a shaded picture has.
    let colours = |rgb: &[u8]| rgb.as_chunks::<3>().0.iter().collect::<std::collections::BTreeSet<_>>().len();
    assert!(colours(&objects) * 4 < colours(&later), "{} {}", colours(&objects), colours(&later));
}

#[test]
fn they_are_chosen_by_name_for_every_model_and_after_it_was_read_again() {
    let mut window = opened();
    window.use_named(&format!("Show {OVERVIEW}"));
    window.press(Key::L, Modifiers::COMMAND);
    window.frame(Vec::new());
    assert_eq!(places(&window).len(), 1);
    let own = |name: &str| Source::own().find(|source| source.title() == name).unwrap();
    window.app.open(own("pile"));
    window.frame(Vec::new());
    assert!(places(&window).is_empty() && window.app.trouble().is_none());
    window.app.open(own("workbench"));
    window.frame(Vec::new());
    assert_eq!(places(&window).len(), 1);
}
