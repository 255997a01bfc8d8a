//! Pictures of scenes made up from bytes: items and lights anywhere, of any size, and models with random assets.

use std::sync::OnceLock;

use super::bytes::Bytes;
use mjcf::{Limits, Loader};
use physics::{Data, Model, forward};
use render::picture::Channels;
use render::raster::{Samples, ShadowSettings};
use render::scene::{
    Camera, Category, Effects, Fog, FreeCamera, Haze, Item, Light, LightKind, Look, Object, SceneOptions,
    Shape, Show,
};
use render::view::Frustum;
use render::{Assets, Picture, Profile, Renderer, Scene, Settings, View};

/// A picture of a made-up scene, or of a made-up model: the first bit says which.
pub fn render(data: &[u8]) {
    let mut bytes = Bytes(data);
    let choice = bytes.next();
    let drawn = if choice & 1 == 0 { made_up_scene(&mut bytes) } else { made_up_model(&mut bytes) };
    let Some((assets, scene, settings)) = drawn else { return };
    let channels = Channels { rgb: choice & 2 == 0, depth: choice & 4 == 0, segmentation: choice & 8 == 0 };
    let [width, height] = [bytes.next(), bytes.next()].map(|side| 1 + usize::from(side) % 64);
    let mut renderer = Renderer::new(settings);
    let mut first = Picture::new(width, height);
    if renderer.draw(&assets, &scene, channels, &mut first).is_err() {
        return;
    }
    check(&first, &scene, channels);
    // What a renderer drew before leaves no trace: neither another picture nor a part of the scene.
    let mut other = scene.clone();
    other.items.truncate(scene.items.len() / 2);
    other.lights.reverse();
    let _ = renderer.draw(&assets, &other, Channels::ALL, &mut Picture::new(height, width));
    let mut second = Picture::new(width, height);
    assert_eq!(renderer.draw(&assets, &scene, channels, &mut second), Ok(()));
    assert!(first == second, "the second picture of a scene is another one");
}

/// The arrays are as long as asked for, distances lie within the frustum, every id is an item's.
fn check(picture: &Picture, scene: &Scene, channels: Channels) {
    let pixels = picture.width * picture.height;
    let length = |wanted: bool| if wanted { pixels } else { 0 };
    assert_eq!(picture.rgb.len(), 3 * length(channels.rgb));
    assert_eq!(picture.depth.len(), length(channels.depth));
    assert_eq!(picture.segmentation.len(), length(channels.segmentation));
    let Frustum { near, far, .. } = scene.view.frustum;
    let range = (near * 0.999) as f32..=(far * 1.001) as f32;
    assert!(picture.depth.iter().all(|z| range.contains(z)), "{range:?}: {:?}", picture.depth);
    let known = |&[id, kind]: &[i32; 2]| {
        [id, kind] == [-1; 2] || scene.items.iter().any(|item| item.object == Object { kind, id })
    };
    assert!(picture.segmentation.iter().all(known));
}

/// Mostly one of a few turns, else any matrix.
fn turn(bytes: &mut Bytes) -> [f32; 9] {
    match bytes.next() % 4 {
        0 => [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0],
        1 => [0.0, 0.0, 1.0, 0.6, 0.8, 0.0, -0.8, 0.6, 0.0],
        2 => [0.36, 0.48, -0.8, -0.8, 0.6, 0.0, 0.48, 0.64, 0.6],
        _ => bytes.numbers(),
    }
}

/// A model with one of everything that items refer to.
const WORLD: &str = "<mujoco>
    <visual><quality numslices='6' numstacks='4' numquads='2' shadowsize='64'/></visual>
    <asset>
        <texture type='skybox' builtin='gradient' rgb1='.3 .5 .7' rgb2='0 0 0' width='4' height='24'/>
        <texture name='flat' type='2d' builtin='checker' rgb1='.2 .3 .4' rgb2='.7 .6 .5' width='9' height='5'/>
        <texture name='cube' type='cube' builtin='gradient' rgb1='.9 .7 .2' rgb2='.1 .3 .3' width='3' height='3'/>
        <material name='flat' texture='flat' texrepeat='3 2'/>
        <material name='even' texture='flat' texuniform='true'/>
        <material name='cube' texture='cube' texuniform='true'/>
        <hfield name='hill' nrow='3' ncol='4' size='1 1 .5 .1' elevation='0 1 2 1 0 1 3 1 4 5 3 2'/>
        <mesh name='wedge' vertex='0 0 0  .3 0 0  0 .3 0  .3 .3 0  0 0 .25  0 .3 .25'/>
    </asset>
    <worldbody>
        <geom type='plane' size='0 0 .1' material='flat'/><geom type='plane' size='1 2 .1'/>
        <geom type='hfield' hfield='hill'/><geom type='mesh' mesh='wedge'/>
    </worldbody>
</mujoco>";

fn world() -> &'static (Model, Assets) {
    static WORLD_ASSETS: OnceLock<(Model, Assets)> = OnceLock::new();
    WORLD_ASSETS.get_or_init(|| {
        let model = Loader::default().load_str(WORLD).expect("the world is sound").model;
        let assets = Assets::new(&model, Profile::Mujoco312).expect("its assets are");
        (model, assets)
    })
}

fn settings(bytes: &mut Bytes<'_>) -> Settings {
    let size = [0, 1, 2, 3, 64, 255, 4096, usize::MAX][usize::from(bytes.next()) % 8];
    Settings::default()
        .with_samples(if bytes.next() & 1 == 0 { Samples::Four } else { Samples::One })
        .with_shadow(ShadowSettings { size, clip: bytes.number(), scale: bytes.number() })
        .with_slices(usize::from(bytes.next()) % 12)
        .with_line_width(bytes.number())
        .with_keep(bytes.next() & 1 == 0)
}

fn made_up_scene(bytes: &mut Bytes<'_>) -> Option<(Assets, Scene, Settings)> {
    let settings = settings(bytes);
    let view = view(bytes);
    let effects = bytes.next();
    let flag = |bit: u8| effects >> bit & 1 == 1;
    let fog = flag(0).then(|| Fog { start: bytes.number(), end: bytes.number(), rgb: bytes.numbers() });
    let haze = flag(1).then(|| Haze {
        share: bytes.number(),
        rgb: bytes.numbers(),
        pos: bytes.numbers(),
        mat: turn(bytes),
    });
    let lights = (0..effects >> 4).map(|_| light(bytes)).collect();
    let mut items = Vec::new();
    while !bytes.0.is_empty() && items.len() < 16 {
        items.push(item(bytes, items.len()));
    }
    let scene = Scene {
        items,
        lights,
        ambient: bytes.number(),
        view,
        fog,
        sky: flag(2).then_some(usize::from(flag(3))),
        haze,
        shadows: !flag(3),
        reflections: true,
        wireframe: flag(5),
        additive: flag(6),
        culling: !flag(7),
        ..Scene::default()
    };
    Some((world().1.clone(), scene, settings))
}

/// Mostly a sound view towards the origin.
fn view(bytes: &mut Bytes<'_>) -> View {
    let choice = bytes.next();
    let frustum = Frustum {
        orthographic: choice & 1 == 1,
        center: 0.0,
        half_width: None,
        bottom: -0.05,
        top: 0.05,
        near: 0.1,
        far: 20.0,
    };
    let sound = View { eye: [0.0, -3.0, 1.0], forward: [0.0, 0.96, -0.28], up: [0.0, 0.28, 0.96], frustum };
    match choice >> 1 & 3 {
        0 | 1 => sound,
        2 => View { eye: bytes.wide(), ..sound },
        _ => {
            let [center, half_width, bottom, top, near, far] = bytes.wide();
            let half_width = (choice & 8 == 0).then_some(half_width);
            let frustum = Frustum { center, half_width, bottom, top, near, far, ..frustum };
            View { eye: bytes.wide(), forward: bytes.wide(), up: bytes.wide(), frustum }
        }
    }
}

fn light(bytes: &mut Bytes<'_>) -> Light {
    let choice = bytes.next();
    let spot = LightKind::Spot {
        cutoff: bytes.number(),
        exponent: bytes.number(),
        attenuation: if choice & 2 == 0 { [1.0, 0.0, 0.0] } else { bytes.numbers() },
    };
    Light {
        kind: if choice & 1 == 0 { spot } else { LightKind::Directional },
        pos: bytes.numbers(),
        dir: if choice & 4 == 0 { [0.0, 0.6, -0.8] } else { bytes.numbers() },
        ambient: [0.1; 3],
        diffuse: bytes.numbers(),
        specular: [0.3; 3],
        shadow: choice & 8 == 0,
        headlight: false,
    }
}

fn item(bytes: &mut Bytes<'_>, id: usize) -> Item {
    let number = usize::from(bytes.next() % 5);
    let number = if number == 4 { usize::MAX } else { number };
    let shapes = [
        Shape::Sphere,
        Shape::Box,
        Shape::Capsule,
        Shape::Cylinder,
        Shape::Plane { geom: number },
        Shape::Hfield { hfield: number },
        Shape::Mesh { mesh: number },
        Shape::Hull { mesh: number },
        Shape::Arrow,
        Shape::ThinArrow,
        Shape::DoubleArrow,
        Shape::Line,
        Shape::LineBox,
        Shape::Triangle,
        Shape::Label,
    ];
    let choice = bytes.next();
    let [emission, specular, shininess, reflectance] =
        if choice & 1 == 0 { [0.5; 4] } else { bytes.numbers() };
    Item {
        shape: shapes[usize::from(bytes.next()) % shapes.len()],
        pos: bytes.numbers(),
        mat: turn(bytes),
        size: bytes.numbers(),
        rgba: if choice & 2 == 0 {
            [0.5, 0.6, 0.7, if choice & 4 == 0 { 1.0 } else { 0.4 }]
        } else {
            bytes.numbers()
        },
        look: Look { emission, specular, shininess, reflectance },
        material: (choice & 8 == 0).then_some(number),
        rbound: bytes.number(),
        object: Object { kind: 5, id: id as i32 },
        category: if choice & 16 == 0 { Category::Dynamic } else { Category::Decor },
        unlisted: choice & 32 != 0,
        label: String::new(),
    }
}

/// A model in text whose numbers are the bytes', written over with others where that is allowed.
fn made_up_model(bytes: &mut Bytes<'_>) -> Option<(Assets, Scene, Settings)> {
    let limits = Limits::default().with_copies(300).with_memory(64 << 20);
    let mut model = Loader::default().limits(limits).load_str(text(bytes)).ok()?.model;
    let over: [f32; 6] = bytes.numbers();
    let _ = model.overwrite(|draft| {
        let wide = over.map(f64::from);
        draft.geom_size.iter_mut().zip(wide).for_each(|(size, x)| size[0] = x);
        draft.mat_texrepeat.iter_mut().for_each(|repeat| repeat[0] = over[1]);
        draft.hfield_data.iter_mut().take(1).for_each(|x| *x = over[2]);
        draft.mesh_vert.iter_mut().take(1).for_each(|p| p[1] = over[3]);
        draft.light_cutoff.iter_mut().for_each(|x| *x = over[4]);
        draft.stat.extent = wide[5];
    });
    let profile = if bytes.next() & 1 == 0 { Profile::Mujoco312 } else { Profile::Mujoco313 };
    let mut assets = Assets::new(&model, profile).ok()?;
    let mut data = Data::new(&model);
    forward(&model, &mut data).ok()?;
    let flags = bytes.next();
    let show = Show {
        joints: flags & 1 == 0,
        contact_points: flags & 2 == 0,
        contact_forces: flags & 2 == 0,
        inertias: flags & 4 == 0,
        cameras: flags & 8 == 0,
        lights: flags & 8 == 0,
        convex_hulls: flags & 16 == 0,
        body_trees: flags & 32 == 0,
        ..Show::default()
    };
    let effects = Effects::default().with_fog(flags & 64 == 0).with_wireframe(flags & 65 == 65);
    let options = SceneOptions::default().with_show(show).with_effects(effects);
    let free = FreeCamera::of(&model);
    let camera = match flags & 128 == 0 {
        true => Camera::Fixed(0),
        false => Camera::Free(FreeCamera {
            distance: bytes.number().into(),
            azimuth: bytes.number().into(),
            ..free
        }),
    };
    let mut scene = Scene::new();
    scene.update(&model, &data, camera.view(&model, &data).ok()?, &options).ok()?;
    assets.pose(&model, &data, &options).ok()?;
    Some((assets, scene, Settings::of(&model).with_shadow(settings(bytes).shadow)))
}

/// A number as text that a model may have: not too extreme, so that most are read.
fn word(bytes: &mut Bytes<'_>) -> String {
    let x = f64::from(bytes.next() as i8);
    match bytes.next() % 16 {
        0 => format!("{x}e30"),
        1 => format!("{x}e-30"),
        2 => "0".into(),
        _ => format!("{}", x / 32.0),
    }
}

fn words(bytes: &mut Bytes<'_>, count: usize) -> String {
    (0..count).map(|_| word(bytes)).collect::<Vec<_>>().join(" ")
}

fn text(bytes: &mut Bytes<'_>) -> String {
    let size = |bytes: &mut Bytes<'_>| 1 + bytes.next() % 40;
    let [width, height, face] = [size(bytes), size(bytes), size(bytes)];
    let kinds = ["sphere", "box", "capsule", "cylinder", "ellipsoid", "plane"];
    let mut bodies = String::new();
    for k in 0..bytes.next() % 5 {
        let kind = kinds[usize::from(bytes.next()) % kinds.len()];
        let joint = if bytes.next() & 1 == 0 && kind != "plane" { "<freejoint/>" } else { "" };
        let material = ["flat", "cube", "glass"][usize::from(bytes.next()) % 3];
        let [pos, dims, turn] = [words(bytes, 3), words(bytes, 3), words(bytes, 3)];
        bodies += &format!(
            "<body pos='{pos}'>{joint}<geom type='{kind}' size='{dims}' euler='{turn}' mass='1' material='{material}'/>\
             <site name='s{k}'/></body>"
        );
    }
    let [repeat, light, camera, hill, elevation, mesh] = [
        words(bytes, 2),
        words(bytes, 3),
        words(bytes, 3),
        words(bytes, 4),
        words(bytes, 6),
        words(bytes, 12),
    ];
    format!(
        "<mujoco><visual><quality numslices='6' numstacks='4' numquads='2' shadowsize='64'/></visual><asset>
        <texture type='skybox' builtin='gradient' rgb1='.3 .5 .7' rgb2='0 0 0' width='{face}' height='{face}'/>
        <texture name='flat' type='2d' builtin='checker' rgb1='.2 .3 .4' rgb2='1 1 1' width='{width}' height='{height}'/>
        <texture name='cube' type='cube' builtin='gradient' rgb1='1 1 0' rgb2='0 0 1' width='{face}' height='{face}'/>
        <material name='flat' texture='flat' texrepeat='{repeat}' reflectance='.4'/>
        <material name='cube' texture='cube' texuniform='true'/><material name='glass' rgba='1 .5 1 .4'/>
        <hfield name='hill' nrow='2' ncol='3' size='{hill}' elevation='{elevation}'/><mesh name='m' vertex='{mesh}'/>
        </asset><worldbody><light pos='{light}' dir='{light}'/><light type='directional' dir='{camera}'/>
        <camera pos='{camera}' fovy='60'/><geom type='plane' size='0 0 .1' material='flat'/>
        <geom type='hfield' hfield='hill' pos='1 1 0'/><geom type='mesh' mesh='m' material='flat'/>{bodies}</worldbody></mujoco>"
    )
}
