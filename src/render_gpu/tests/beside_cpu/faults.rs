//! What cannot be drawn, and where.

use super::{Measures, Shot, renderer};
use render::painter::{Painter, Painters};
use render::picture::Channels;
use render::raster;
use render::scene::{Scene, SceneOptions};
use render::{Picture, RenderError};
use robohive_render_gpu::{Choice, EitherPainters, EitherRenderer, GpuError, GpuRenderer};

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
    assert_eq!((either.name(), either.draws_batches()), ("CPU".into(), false));
    let mut pictures = [Picture::new(30, 20), Picture::new(20, 30)];
    let Shot { assets, scene, settings } = &shot;
    let shots =
        pictures.iter_mut().map(|picture| raster::Shot { assets, scene, channels: Channels::ALL, picture });
    either.paint(settings, &mut shots.collect::<Vec<_>>()).expect("pictures of the CPU");
    assert!(pictures[0] == shot.on_cpu([30, 20]) && pictures[1] == shot.on_cpu([20, 30]));
}

#[test]
fn painters_lend_what_was_returned_to_them() {
    let shot = shot();
    if renderer(shot.settings).is_none() {
        return;
    }
    let painters = EitherPainters::new(Choice::Any);
    let mut pictures = [Picture::new(30, 20), Picture::new(30, 20)];
    for picture in &mut pictures {
        let mut painter = painters.painter(&shot.settings);
        assert!(painter.draws_batches());
        let Shot { assets, scene, settings } = &shot;
        painter
            .paint(settings, &mut [raster::Shot { assets, scene, channels: Channels::ALL, picture }])
            .expect("a picture");
    }
    assert!(pictures[0] == pictures[1]);
    Measures::of(&shot.on_cpu([30, 20]), &pictures[0]).check_small("a lent painter");
    let mut wrong = Picture::new(0, 5);
    let (Shot { assets, scene, settings }, picture) = (&shot, &mut wrong);
    let found = painters
        .painter(settings)
        .paint(settings, &mut [raster::Shot { assets, scene, channels: Channels::RGB, picture }]);
    assert_eq!(found, Err(RenderError::Size { width: 0, height: 5 }));
}

#[test]
fn sizes_and_frusta_at_fault_are_errors() {
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
    gpu.draw_batch(&mut []).expect("an empty batch");
    assert_eq!(shot.on_gpu(&mut gpu, [1, 1]).segmentation.len(), 1);
}

#[test]
fn a_shadow_map_that_no_gpu_can_hold_is_an_error() {
    let mut settings = shot().settings;
    settings.shadow.size = 1 << 20;
    if renderer(shot().settings).is_some() {
        let found = GpuRenderer::new(settings, &Choice::Any).expect_err("too large");
        assert!(matches!(found, GpuError::Unsuitable { .. }), "{found}");
    }
}
