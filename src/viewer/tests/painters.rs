//! The picture by the GPU that draws a window, beside that of the CPU. Without a GPU nothing is compared, and a line says so;
//! a driver that computes on the CPU, such as Mesa's lavapipe, counts as one.

use eframe::egui::{Context, Pos2, RawInput, Rect, vec2};
use eframe::egui_wgpu::{RenderState, RendererOptions};
use pollster::block_on;
use render::scene::Camera;
use robohive_viewer::Command;
use robohive_viewer::window::{App, Painters, Source, setup};

/// What `validation/pictures.toml` asks of pictures beside each other \[dB\].
const PSNR: f64 = 40.0;
/// The same for the quadruped, whose shadows are made of rounding errors.
const PSNR_STEEP: f64 = 35.0;

/// The GPU of a window that is never shown.
fn state() -> Option<RenderState> {
    let configuration = setup();
    let instance = block_on(configuration.wgpu_setup.new_instance());
    let state = block_on(RenderState::create(&configuration, &instance, None, RendererOptions::default()));
    state.inspect_err(|error| println!("not checked: there is no GPU: {error}")).ok()
}

/// Painters of which the GPU is to draw, whatever it is made of.
fn painters(state: &RenderState) -> Painters {
    let mut painters = Painters::of(Some(state));
    painters.use_gpu(true);
    assert!(painters.uses_gpu(), "{}", painters.reason());
    painters
}

fn frames(app: &mut App, context: &Context, count: usize) {
    for _ in 0..count {
        let screen = Rect::from_min_size(Pos2::ZERO, vec2(900.0, 560.0));
        let input = RawInput { screen_rect: Some(screen), ..RawInput::default() };
        context.run_ui(input, |ui| app.show(ui)).textures_delta.clear();
    }
}

/// Peak signal-to-noise ratio of the picture that the GPU shows beside the CPU's \[dB\].
fn psnr(app: &mut App) -> f64 {
    let shown = app.read_gpu().expect("a GPU that works").expect("a picture by the GPU");
    let [width, height] = app.size();
    let expected = app.drawn_by_cpu([width, height]).expect("a picture by the CPU").expect("a model");
    assert_eq!(shown.len(), 4 * width * height);
    let (pixels, _) = shown.as_chunks::<4>();
    assert!(pixels.iter().all(|pixel| pixel[3] == 255), "the picture is opaque");
    decibels(&shown, &expected.rgb)
}

/// Peak signal-to-noise ratio of bytes R, G, B, A beside bytes R, G, B \[dB\].
fn decibels(shown: &[u8], expected: &[u8]) -> f64 {
    let colours = shown.as_chunks::<4>().0.iter().flat_map(|pixel| &pixel[..3]);
    let sum: f64 = colours.zip(expected).map(|(a, b)| f64::from(a.abs_diff(*b)).powi(2)).sum();
    10.0 * (255.0 * 255.0 * expected.len() as f64 / sum).log10()
}

#[test]
fn own_models_look_the_same_by_gpu_and_cpu() {
    let Some(state) = state() else { return };
    let context = Context::default();
    // One GPU for all models: what it keeps of one must not show in the next.
    let mut app = App::drawn_by(painters(&state), None);
    for source in Source::own() {
        let title = source.title();
        app.open(source);
        frames(&mut app, &context, 3);
        assert_eq!((app.trouble(), app.drawn().1), (None, ""), "{title}");
        let found = psnr(&mut app);
        assert!(found >= if title == "quadruped" { PSNR_STEEP } else { PSNR }, "{title}: {found:.1} dB");
        println!("{title}: {found:.1} dB");
    }
}

#[test]
fn the_picture_follows_state_camera_and_who_draws() {
    let Some(state) = state() else { return };
    let context = Context::default();
    let pile = Source::own().find(|source| source.title() == "pile");
    let mut app = App::drawn_by(painters(&state), pile);
    frames(&mut app, &context, 3);
    let (first, size) = (app.read_gpu().unwrap().unwrap(), app.size());
    (0..200).for_each(|_| app.perform(Command::StepForward));
    app.perform(Command::NextLabels);
    frames(&mut app, &context, 2);
    let second = app.read_gpu().unwrap().unwrap();
    assert_ne!(first, second);
    assert_eq!(app.drawn_by_cpu(size).unwrap().unwrap().rgb.len(), 3 * size[0] * size[1]);
    app.use_gpu(false);
    frames(&mut app, &context, 2);
    assert_eq!(app.drawn().0, "CPU");
    app.use_gpu(true);
    frames(&mut app, &context, 2);
    assert_eq!(app.read_gpu().unwrap().unwrap(), second);
}

#[test]
fn small_pictures_look_the_same_by_gpu_and_cpu() {
    let Some(state) = state() else { return };
    let context = Context::default();
    let workbench = Source::own().find(|source| source.title() == "workbench");
    let mut app = App::drawn_by(painters(&state), workbench);
    app.show_camera("camera \"overview\"");
    frames(&mut app, &context, 3);
    let main = app.read_gpu().unwrap().unwrap();
    let size = app.inset_size().expect("a small picture");
    let shown = app.read_gpu_inset().unwrap().expect("the GPU has drawn it");
    let session = app.opened_mut().unwrap();
    session.camera = Camera::named(session.model(), "overview").unwrap();
    let expected = app.drawn_by_cpu(size).unwrap().unwrap();
    let found = decibels(&shown, &expected.rgb);
    assert!(found >= PSNR, "{found:.1} dB");
    println!("small picture of {size:?}: {found:.1} dB");
    assert_eq!(main.len(), 4 * app.size()[0] * app.size()[1], "the picture keeps its own texture");
}
