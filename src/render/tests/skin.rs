//! Skins in pictures: they follow their bodies, swell along their normals, and can be hidden.

use physics::{Data, Model, forward};
use robohive_render::picture::Channels;
use robohive_render::scene::{Camera, SceneOptions, Shape};
use robohive_render::{Assets, Picture, Profile, RenderError, Renderer, Scene, Settings};

/// A square over the floor of the world, half of it on a hinge at y = 0.
const MODEL: &str = "<mujoco>
  <statistic extent='2'/>
  <worldbody>
    <camera name='above' pos='0 0 4'/>
    <body name='flap' pos='0 0 1'><joint axis='1 0 0'/><geom size='.01' mass='1'/></body>
  </worldbody>
  <deformable>
    <skin name='cloth' rgba='1 0 0 1' vertex='-1 -1 1 1 -1 1 -1 0 1 1 0 1 -1 1 1 1 1 1' face='0 1 2 1 3 2 2 3 4 3 5 4'>
      <bone body='world' bindpos='0 0 0' bindquat='1 0 0 0' vertid='0 1 2 3' vertweight='1 1 1 1'/>
      <bone body='flap' bindpos='0 0 1' bindquat='1 0 0 0' vertid='2 3 4 5' vertweight='1 1 1 1'/>
    </skin>
  </deformable>
</mujoco>";

fn world(text: &str, angle: f64) -> (Model, Data, Assets) {
    let model = robohive_mjcf::load_str(text).unwrap().model;
    let mut data = Data::new(&model);
    data.state.qpos[0] = angle;
    forward(&model, &mut data).unwrap();
    let mut assets = Assets::new(&model, Profile::Mujoco312).unwrap();
    assets.pose(&model, &data, &SceneOptions::default()).unwrap();
    (model, data, assets)
}

/// Positions and normals of the skin.
fn surface(assets: &Assets) -> (Vec<[f32; 3]>, Vec<[f32; 3]>) {
    let surface = assets.surfaces.last().unwrap();
    (surface.positions.clone(), surface.normals.clone())
}

fn near(a: [f32; 3], b: [f32; 3]) -> bool {
    a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-6)
}

#[test]
fn vertices_follow_their_bones() {
    let (_, _, flat) = world(MODEL, 0.0);
    let (positions, normals) = surface(&flat);
    assert!(near(positions[4], [-1.0, 1.0, 1.0]) && normals.iter().all(|&n| near(n, [0.0, 0.0, 1.0])));
    let (_, _, raised) = world(MODEL, std::f64::consts::FRAC_PI_2);
    let (positions, normals) = surface(&raised);
    assert!(near(positions[0], [-1.0, -1.0, 1.0]) && near(positions[3], [1.0, 0.0, 1.0]));
    assert!(near(positions[5], [1.0, 0.0, 2.0]) && near(normals[5], [0.0, -1.0, 0.0]), "{positions:?}");
    let swollen = MODEL.replace("rgba", "inflate='.25' rgba");
    let (positions, _) = surface(&world(&swollen, 0.0).2);
    assert!(positions.iter().all(|p| (p[2] - 1.25).abs() < 1e-6));
}

/// Vertices between two bones are where MuJoCo 3.12.0 puts them: `scene.skinvert` and `scene.skinnormal` after
/// `mjv_updateScene` of this model.
#[test]
fn a_bent_and_swollen_skin_is_mujocos() {
    let swollen = MODEL.replace("rgba", "inflate='.25' rgba");
    let (positions, normals) = surface(&world(&swollen, 0.7).2);
    let expected = [
        ([-1.0, -1.0, 1.25], [0.0, 0.0, 1.0]),
        ([1.0, -1.0, 1.25], [0.0, 0.0, 1.0]),
        ([-1.0, -0.056731228, 1.2434781], [0.0, -0.22692491, 0.97391236]),
        ([1.0, -0.11346245, 1.2227695], [0.0, -0.4538498, 0.89107823]),
        ([-1.0, 0.6037878, 1.8354282], [0.0, -0.6442177, 0.7648422]),
        ([1.0, 0.6037878, 1.8354282], [0.0, -0.6442177, 0.7648422]),
    ];
    assert_eq!(positions.len(), expected.len());
    for ((position, normal), (theirs, upwards)) in positions.iter().zip(&normals).zip(expected) {
        assert!(near(*position, theirs) && near(*normal, upwards), "{position:?} {normal:?}");
    }
}

#[test]
fn a_surface_changes_only_when_the_skin_moves() {
    let (model, mut data, mut assets) = world(MODEL, 0.3);
    let before = assets.clone();
    assets.pose(&model, &data, &SceneOptions::default()).unwrap();
    let last = assets.surfaces.len() - 1;
    assert!(std::sync::Arc::ptr_eq(&before.surfaces[last], &assets.surfaces[last]));
    data.state.qpos[0] = 0.4;
    forward(&model, &mut data).unwrap();
    assets.pose(&model, &data, &SceneOptions::default()).unwrap();
    assert!(!std::sync::Arc::ptr_eq(&before.surfaces[last], &assets.surfaces[last]));
    data.kin.xpos[1][0] = f64::NAN;
    assert!(
        matches!(assets.pose(&model, &data, &SceneOptions::default()), Err(RenderError::NotFinite { what }) if what.contains("cloth"))
    );
}

#[test]
fn skins_are_seen_where_they_are_and_can_be_hidden() {
    let (model, data, assets) = world(MODEL, 0.0);
    let view = Camera::named(&model, "above").unwrap().view(&model, &data).unwrap();
    let shown = |options: &SceneOptions| {
        let mut scene = Scene::new();
        scene.update(&model, &data, view, options).unwrap();
        let mut picture = Picture::new(32, 32);
        let mut renderer = Renderer::new(Settings::of(&model));
        renderer.draw(&assets, &scene, Channels { depth: true, ..Channels::RGB }, &mut picture).unwrap();
        let skins = scene.items.iter().filter(|item| matches!(item.shape, Shape::Skin { .. })).count();
        (skins, picture.depth[32 * 16 + 12], picture.rgb[3 * (32 * 16 + 12)])
    };
    let (skins, depth, red) = shown(&SceneOptions::default());
    assert_eq!(skins, 1);
    assert!((depth - 3.0).abs() < 1e-3 && red > 50, "{depth} {red}");
    let mut options = SceneOptions::default();
    options.show.skins = false;
    assert_eq!((shown(&options).0, shown(&options).2), (0, 0));
    let mut options = SceneOptions::default();
    options.groups.skins[0] = false;
    assert_eq!(shown(&options).0, 0);
}
