//! What cannot be drawn, and where.

use super::{Shot, renderer};
use render::picture::Channels;
use render::raster::Settings;
use render::scene::{Scene, SceneOptions};
use render::{Picture, RenderError};
use robohive_render_gpu::{Choice, EitherRenderer, GpuError, GpuRenderer};

const WORLD: &str = "<mujoco><worldbody><geom size='.3'/><camera name='a' pos='0 0 2'/></worldbody></mujoco>";

fn shot() -> Shot {
    let model = mjcf::load_str(WORLD).expect("a model").model;
    Shot::of(&model, "a", &SceneOptions::default())
}

#[test]
fn a_gpu_that_is_not_there_is_named_with_those_that_are() {
    let choice = Choice::Named("no such card".into());
    let error = GpuRenderer::new(shot().settings, &choice).expect_err("there is none of this name");
    let message = error.to_string();
    assert!(message.starts_with("there is no GPU named no such card"), "{message}");
    assert!(matches!(error, GpuError::NoAdapter { .. }));
}

#[test]
fn the_cpu_draws_where_the_gpu_cannot_be_had() {
    let shot = shot();
    let mut either = EitherRenderer::new(shot.settings, &Choice::Named("no such card".into()));
    assert_eq!(either.name(), "CPU");
    let mut pictures = [Picture::new(30, 20), Picture::new(20, 30)];
    either
        .draw_batch(&shot.assets, &[&shot.scene, &shot.scene], Channels::ALL, &mut pictures)
        .expect("pictures of the CPU");
    assert!(pictures[0] == shot.on_cpu([30, 20]) && pictures[1] == shot.on_cpu([20, 30]));
    let few = either.draw_batch(&shot.assets, &[], Channels::ALL, &mut pictures);
    assert_eq!(few, Err(GpuError::Batch { scenes: 0, pictures: 2 }));
}

#[test]
fn sizes_frusta_and_batches_at_fault_are_errors() {
    let shot = shot();
    let Some(mut gpu) = renderer(shot.settings) else { return };
    for (width, height) in [(0, 10), (10, 0), (5000, 10)] {
        let mut picture = Picture::new(width, height);
        let found = gpu.draw(&shot.assets, &shot.scene, Channels::RGB, &mut picture);
        assert_eq!(found, Err(GpuError::Render(RenderError::Size { width, height })));
    }
    let mut nowhere = shot.scene.clone();
    nowhere.view.eye[1] = f64::NAN;
    let found = gpu.draw(&shot.assets, &nowhere, Channels::RGB, &mut Picture::new(8, 8));
    assert!(matches!(found, Err(GpuError::Render(RenderError::Frustum { .. }))), "{found:?}");
    let found = gpu.draw_batch(&shot.assets, &[&shot.scene], Channels::RGB, &mut []);
    assert_eq!(found, Err(GpuError::Batch { scenes: 1, pictures: 0 }));
    // It draws on after errors.
    assert_eq!(shot.on_gpu(&mut gpu, [8, 8]).rgb.len(), 3 * 64);
}

#[test]
fn nothing_to_draw_is_black_and_far() {
    let shot = shot();
    let Some(mut gpu) = renderer(shot.settings) else { return };
    let empty = Scene { view: shot.scene.view, ..Scene::new() };
    let mut picture = Picture::new(9, 7);
    gpu.draw(&shot.assets, &empty, Channels::ALL, &mut picture).expect("an empty picture");
    assert!(
        picture.rgb.iter().all(|&byte| byte == 0) && picture.segmentation.iter().all(|&id| id == [-1; 2])
    );
    assert!(picture.depth.iter().all(|&depth| depth == shot.scene.view.frustum.far as f32));
    gpu.draw_batch(&shot.assets, &[], Channels::ALL, &mut []).expect("an empty batch");
    assert_eq!(shot.on_gpu(&mut gpu, [1, 1]).segmentation.len(), 1);
}

#[test]
fn a_shadow_map_that_no_gpu_can_hold_is_an_error() {
    let mut settings = shot().settings;
    settings.shadow.size = 1 << 20;
    if renderer(Settings { ..shot().settings }).is_some() {
        let found = GpuRenderer::new(settings, &Choice::Any).expect_err("too large");
        assert!(matches!(found, GpuError::Unsuitable { .. }), "{found}");
    }
}
