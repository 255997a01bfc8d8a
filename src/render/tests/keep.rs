//! Pictures in which what stands still is kept, and pictures drawn several at a time, have the bits of pictures drawn alone.

use physics::{Data, Model, forward, step};
use robohive_render::picture::Channels;
use robohive_render::raster::{Batch, Shot};
use robohive_render::scene::{Camera, SceneOptions};
use robohive_render::{Assets, Picture, Profile, Renderer, Scene, Settings};

/// A mirroring floor, a block at rest, a ball that falls onto it, something transparent, two lamps with shadows and a sky.
const MODEL: &str = "<mujoco>
  <asset>
    <texture name='sky' type='skybox' builtin='gradient' width='32' height='32'/>
    <texture name='tiles' type='2d' builtin='checker' width='64' height='64'/>
    <material name='tiles' texture='tiles' texrepeat='4 4' reflectance='.4'/>
  </asset>
  <worldbody>
    <light pos='0 0 3' castshadow='true'/>
    <light pos='2 1 3' dir='-2 -1 -3' directional='true' castshadow='true'/>
    <camera name='fixed' pos='0 -2.5 1.2' xyaxes='1 0 0 0 .4 1'/>
    <camera name='side' pos='2.2 0 1.5' xyaxes='0 1 0 -.5 0 1'/>
    <geom type='plane' size='2 2 .1' material='tiles'/>
    <geom type='box' size='.2 .2 .1' pos='0 0 .1' rgba='.8 .3 .2 1'/>
    <geom type='sphere' size='.15' pos='.5 .3 .3' rgba='.2 .3 .8 .5'/>
    <body pos='.05 0 1'><freejoint/><geom type='sphere' size='.1' rgba='.2 .8 .3 1'/>
      <camera name='moving' mode='targetbody' target='still' pos='0 -1.5 1'/></body>
    <body name='still' pos='0 .6 .2'><geom size='.1'/></body>
    <geom type='plane' size='0 0 .1' pos='0 0 -.5'/>
  </worldbody>
</mujoco>";

struct World {
    model: Model,
    data: Data,
    assets: Assets,
    camera: Camera,
}

impl World {
    fn new() -> Self {
        let model = robohive_mjcf::load_str(MODEL).expect("a sound model").model;
        let data = Data::new(&model);
        let assets = Assets::new(&model, Profile::Mujoco312).expect("sound assets");
        let camera = Camera::named(&model, "fixed").expect("a camera");
        World { model, data, assets, camera }
    }

    /// The scene ten steps later.
    fn next(&mut self) -> Scene {
        (0..10).for_each(|_| step(&self.model, &mut self.data).expect("a step"));
        forward(&self.model, &mut self.data).expect("a pass");
        self.scene(&self.camera)
    }

    /// The present scene from a camera.
    fn scene(&self, camera: &Camera) -> Scene {
        let view = camera.view(&self.model, &self.data).expect("a view");
        let mut scene = Scene::new();
        scene.update(&self.model, &self.data, view, &SceneOptions::default()).expect("a scene");
        scene
    }
}

#[test]
fn what_is_kept_changes_no_bit() {
    let mut world = World::new();
    let settings = Settings::of(&world.model);
    let mut keeping = Renderer::new(settings);
    let mut plain = Renderer::new(settings.with_keep(false));
    let mut different = 0;
    let mut last = Vec::new();
    // The ball comes to rest within these, and is then kept too.
    for frame in 0..120 {
        let scene = world.next();
        let (mut a, mut b) = (Picture::new(72, 56), Picture::new(72, 56));
        keeping.draw(&world.assets, &scene, Channels::ALL, &mut a).expect("a picture");
        plain.draw(&world.assets, &scene, Channels::ALL, &mut b).expect("a picture");
        assert!(a == b, "frame {frame}");
        different += usize::from(a.rgb != last);
        last = a.rgb;
    }
    assert!(different > 20, "only {different} pictures differ from the one before");
}

#[test]
fn edits_and_other_cameras_are_seen_at_once() {
    let mut world = World::new();
    let mut keeping = Renderer::new(Settings::of(&world.model));
    let mut scene = world.next();
    let mut picture = Picture::new(64, 64);
    let mut draw = |scene: &Scene| {
        keeping.draw(&world.assets, scene, Channels::RGB, &mut picture).expect("a picture");
        picture.rgb.clone()
    };
    let before = (0..4).map(|_| draw(&scene)).collect::<Vec<_>>();
    assert!(before.iter().all(|rgb| *rgb == before[0]));
    scene.items[1].rgba = [0.1, 0.9, 0.1, 1.0];
    let green = draw(&scene);
    assert_ne!(green, before[0]);
    scene.lights[1].diffuse = [1.0, 0.0, 0.0];
    assert_ne!(draw(&scene), green);
    scene.view.eye[0] += 0.3;
    assert_ne!(draw(&scene), green);
}

#[test]
fn pictures_of_a_batch_are_those_drawn_alone() {
    let mut world = World::new();
    let settings = Settings::of(&world.model);
    let scenes: Vec<_> = (0..7).map(|_| world.next()).collect();
    let alone: Vec<_> = scenes
        .iter()
        .map(|scene| {
            let mut picture = Picture::new(48, 40);
            Renderer::new(settings)
                .draw(&world.assets, scene, Channels::ALL, &mut picture)
                .expect("a picture");
            picture
        })
        .collect();
    assert_ne!(alone[0], alone[6]);
    for threads in [1, 2, 3] {
        let mut pictures = vec![Picture::new(48, 40); scenes.len()];
        let mut shots: Vec<_> = scenes
            .iter()
            .zip(&mut pictures)
            .map(|(scene, picture)| Shot { assets: &world.assets, scene, channels: Channels::ALL, picture })
            .collect();
        Batch::new(settings, threads).draw(&mut shots).expect("pictures");
        assert!(pictures == alone, "{threads} threads");
    }
}

#[test]
fn pictures_of_one_state_drawn_together_are_those_drawn_alone() {
    let mut world = World::new();
    let settings = Settings::of(&world.model);
    // Two that stand, one that moves, one of another size that a backdrop is kept for, and one that is the first again.
    let cameras = ["fixed", "moving", "side", "free", "fixed"];
    let cameras = cameras.map(|name| Camera::named(&world.model, name).expect("a camera"));
    let sizes = [(64, 48), (40, 40), (56, 64), (33, 21), (64, 48)];
    let channels = [Channels::RGB, Channels::ALL, Channels::RGB, Channels::ALL, Channels::DEPTH];
    let mut alone = Renderer::new(settings.with_keep(false));
    let mut together = Renderer::new(settings);
    for frame in 0..30 {
        world.next();
        let scenes = cameras.map(|camera| world.scene(&camera));
        let mut pictures = sizes.map(|(width, height)| Picture::new(width, height));
        let mut expected = pictures.clone();
        for ((scene, picture), channels) in scenes.iter().zip(&mut expected).zip(channels) {
            alone.draw(&world.assets, scene, channels, picture).expect("a picture");
        }
        let mut shots: Vec<_> = (scenes.iter().zip(&mut pictures).zip(channels))
            .map(|((scene, picture), channels)| Shot { assets: &world.assets, scene, channels, picture })
            .collect();
        together.draw_all(&mut shots).expect("pictures");
        assert!(pictures == expected, "frame {frame}");
    }
}

#[test]
fn a_picture_that_fails_leaves_the_others_alone() {
    let mut world = World::new();
    let settings = Settings::of(&world.model);
    let first = world.next();
    let mut broken = first.clone();
    broken.view.eye[0] = f64::NAN;
    let scenes =
        [first.clone(), broken, world.scene(&Camera::named(&world.model, "side").expect("a camera"))];
    let draw = |scenes: &[Scene]| {
        let mut pictures = vec![Picture::new(40, 30); scenes.len()];
        let mut shots: Vec<_> = (scenes.iter().zip(&mut pictures))
            .map(|(scene, picture)| Shot { assets: &world.assets, scene, channels: Channels::RGB, picture })
            .collect();
        let outcome = Renderer::new(settings).draw_all(&mut shots);
        (pictures, outcome)
    };
    let (pictures, outcome) = draw(&scenes);
    assert!(outcome.is_err());
    assert!(pictures[0] == draw(&scenes[..1]).0[0] && pictures[2] == draw(&scenes[2..]).0[0]);
    assert!(pictures[1].rgb.is_empty());
}
