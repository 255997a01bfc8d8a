//! Pictures of a scene after the first allocate nothing, those that keep what stands still after some. One test in a program of its own: the counter sees every thread.

use physics::{Data, step};
use robohive_render::picture::Channels;
use robohive_render::raster::Samples;
use robohive_render::scene::{Camera, FreeCamera, Scene, SceneOptions, Show};
use robohive_render::{Assets, Picture, Profile, Renderer, Settings};
use stats_alloc::{INSTRUMENTED_SYSTEM, Region, StatsAlloc};
use std::alloc::System;

#[global_allocator]
static HEAP: &StatsAlloc<System> = &INSTRUMENTED_SYSTEM;

/// A mirror below a sky, textures, spots and a directional light with shadows, more transparent items than an insertion sort
/// takes.
fn gallery() -> String {
    let panes: String = (0..40)
        .map(|k| {
            format!("<geom size='.05' pos='{} {} .3' rgba='1 0 0 .4'/>", f64::from(k % 8) * 0.2 - 0.7, k / 8)
        })
        .collect();
    format!(
        "<mujoco><asset>
        <texture type='skybox' builtin='gradient' rgb1='0 0 1' rgb2='1 1 1' width='8' height='48'/>
        <texture name='t' type='2d' builtin='checker' rgb1='1 0 0' rgb2='0 1 0' width='16' height='16'/>
        <material name='m' texture='t' reflectance='.5'/><hfield name='h' nrow='3' ncol='3' size='1 1 .3 .1'
        elevation='0 1 0 1 2 1 0 1 0'/></asset>
        <worldbody><light pos='0 0 3'/><light pos='1 0 3' dir='-.2 0 -1'/><light type='directional' dir='0 .3 -1'/>
        <geom type='plane' size='0 0 .1' material='m'/><geom type='hfield' hfield='h' pos='2 2 0'/>{panes}
        <body pos='0 0 .6'><freejoint/><geom type='box' size='.2 .2 .2' material='m'/></body>
        </worldbody></mujoco>"
    )
}

const ARM: &str = "<mujoco><worldbody><light pos='0 0 3'/><site name='a' pos='0 0 1'/>
    <body pos='.5 0 .1'><freejoint/><geom type='capsule' size='.05 .2'/><site name='b'/></body></worldbody>
    <tendon><spatial limited='true' range='0 2'><site site='a'/><site site='b'/></spatial></tendon></mujoco>";

#[test]
fn later_pictures_do_not_allocate() {
    for text in [gallery().as_str(), ARM] {
        let model = robohive_mjcf::load_str(text).unwrap().model;
        let mut data = Data::new(&model);
        (0..20).for_each(|_| step(&model, &mut data).unwrap());
        let assets = Assets::new(&model, Profile::Mujoco312).unwrap();
        let show = Show { body_trees: true, joints: true, contact_points: true, ..Show::default() };
        let options = SceneOptions::default().with_show(show);
        let mut scene = Scene::new();
        let camera = Camera::Free(FreeCamera { elevation: -20.0, ..FreeCamera::of(&model) });
        // What stands still is kept after some pictures.
        for (samples, keep, warm) in
            [(Samples::Four, false, 1), (Samples::One, false, 1), (Samples::Four, true, 12)]
        {
            let mut renderer = Renderer::new(Settings::of(&model).with_samples(samples).with_keep(keep));
            let mut picture = Picture::new(96, 72);
            let mut draw = || {
                let view = camera.view(&model, &data).unwrap();
                scene.update(&model, &data, view, &options).unwrap();
                renderer.draw(&assets, &scene, Channels::ALL, &mut picture).unwrap();
                picture.rgb.iter().map(|&x| u64::from(x)).sum::<u64>()
            };
            let first = draw();
            assert!(first > 0);
            (1..warm).for_each(|_| assert_eq!(draw(), first));
            let region = Region::new(HEAP);
            let again = draw();
            let change = region.change();
            assert_eq!(again, first);
            assert_eq!((change.allocations, change.reallocations), (0, 0), "{samples:?} {keep}");
        }
    }
}
