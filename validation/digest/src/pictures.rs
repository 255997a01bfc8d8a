//! Hashes of pictures: every bit of colours, depth and segmentation, equal on every build.

use crate::fnv::Fnv;
use crate::models::Case;
use crate::set_controls;
use physics::table::Slice;
use physics::{Data, Model};
use render::picture::Channels;
use render::raster::{Batch, Samples};
use render::scene::{Camera, Effects, FreeCamera, SceneOptions, Show};
use render::{Assets, Picture, Profile, Scene, Settings};

/// Steps before the pictures are taken.
const STEPS: usize = 100;
/// Simulations of one model, each under controls of its own.
const ENVIRONMENTS: usize = 2;

/// Pictures of one model, of one kind.
pub struct Shot {
    /// Name in the table.
    pub name: &'static str,
    case: Case,
    kind: Kind,
}

/// What a hash takes in.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Kind {
    /// Colours at four samples a pixel, with shadows.
    Colours,
    /// Colours at one sample a pixel, with shadows, as MuJoCo 3.1.3 textures them.
    OneSample,
    /// Colours at four samples a pixel, without shadows.
    NoShadows,
    /// Distances.
    Depth,
    /// Segmentation.
    Ids,
}

const fn shot(name: &'static str, file: &'static str, kind: Kind) -> Shot {
    Shot { name, case: Case::of(name, file), kind }
}

macro_rules! shots {
    ($($name:literal: $file:literal,)*) => {
        [$(
            shot(concat!($name, "_colours"), $file, Kind::Colours),
            shot(concat!($name, "_one_sample"), $file, Kind::OneSample),
            shot(concat!($name, "_no_shadows"), $file, Kind::NoShadows),
            shot(concat!($name, "_depth"), $file, Kind::Depth),
            shot(concat!($name, "_ids"), $file, Kind::Ids),
        )*]
    };
}

/// All pictures of the table, in its order.
pub const SHOTS: [Shot; 60] = shots![
    "gallery": "gallery.xml",
    "franka_table": "franka/franka_table.xml",
    "elbow": "elbow/elbow.xml",
    "quadruped": "quadruped/quadruped.xml",
    "humanoid": "humanoid/humanoid.xml",
    "pile": "pile/pile.xml",
    "workbench": "workbench/workbench.xml",
    "yard": "yard/yard.xml",
    "servos": "servos/servos.xml",
    "delays": "delays/delays.xml",
    "drape": "drape/drape.xml",
    "grasp": "grasp/grasp.xml",
];

/// Hash of the pictures of `shot`: of every simulation from its four cameras, drawn on `threads` threads.
///
/// # Errors
/// The model does not load, a state is refused, or a picture cannot be drawn; in words.
pub fn hash_of(shot: &Shot, threads: usize) -> Result<u64, String> {
    let model = shot.case.load()?;
    let profile = if shot.kind == Kind::OneSample { Profile::Mujoco313 } else { Profile::Mujoco312 };
    let assets = Assets::new(&model, profile).map_err(|error| error.to_string())?;
    let states: Result<Vec<Data>, String> = (0..ENVIRONMENTS).map(|index| state(&model, index)).collect();
    let mut scenes = Vec::new();
    for data in states? {
        let mut posed = assets.clone();
        posed.pose(&model, &data, &SceneOptions::default()).map_err(|error| error.to_string())?;
        for (index, camera) in cameras(&model).into_iter().enumerate() {
            let size = [(96, 64), (61, 47)][index % 2];
            scenes.push((scene(&model, &data, camera, shot.kind, index)?, posed.clone(), size));
        }
    }
    let channels = match shot.kind {
        Kind::Colours | Kind::OneSample | Kind::NoShadows => Channels::RGB,
        Kind::Depth => Channels::DEPTH,
        Kind::Ids => Channels::SEGMENTATION,
    };
    let mut pictures: Vec<Picture> = scenes.iter().map(|(_, _, (w, h))| Picture::new(*w, *h)).collect();
    let mut shots: Vec<_> = scenes
        .iter()
        .zip(&mut pictures)
        .map(|((scene, assets, _), picture)| render::raster::Shot { assets, scene, channels, picture })
        .collect();
    Batch::new(settings(&model, shot.kind), threads).draw(&mut shots).map_err(|error| error.to_string())?;
    let mut hash = Fnv::default();
    for picture in &pictures {
        let size = [picture.height, picture.width];
        hash.array("rgb", &size, Slice::U8(&picture.rgb));
        hash.array("depth", &size, Slice::F32(&picture.depth));
        hash.array("segmentation", &size, Slice::I32(picture.segmentation.as_flattened()));
    }
    Ok(hash.finish())
}

/// A simulation some steps after its first keyframe, or its reference.
fn state(model: &Model, index: usize) -> Result<Data, String> {
    let mut data = Data::new(model);
    if model.nkey > 0 {
        data.reset_to_key(model, 0).map_err(|error| error.to_string())?;
    }
    for step in 0..STEPS {
        set_controls(model, &mut data.state.ctrl, step, index);
        physics::step(model, &mut data).map_err(|error| error.to_string())?;
    }
    physics::forward(model, &mut data).map_err(|error| error.to_string())?;
    Ok(data)
}

/// The free camera, one near the ground from which the horizon is seen, one with parallel rays, and the model's first.
fn cameras(model: &Model) -> [Camera; 4] {
    let free = FreeCamera::of(model);
    let low = FreeCamera { distance: 0.7 * free.distance, azimuth: 167.0, elevation: -4.0, ..free };
    let flat = FreeCamera {
        distance: 0.5 * free.distance,
        azimuth: 40.0,
        orthographic: true,
        fovy: model.stat.extent,
        ..free
    };
    let own =
        if model.ncam > 0 { Camera::Fixed(0) } else { Camera::Free(FreeCamera { azimuth: 200.0, ..free }) };
    [Camera::Free(free), Camera::Free(low), Camera::Free(flat), own]
}

/// What is drawn: without decorations for the first cameras, with fog or many decorations for the others.
fn scene(model: &Model, data: &Data, camera: Camera, kind: Kind, index: usize) -> Result<Scene, String> {
    let effects = Effects::default().with_shadows(kind != Kind::NoShadows).with_fog(index == 2);
    let show = Show {
        joints: index == 3,
        contact_points: index == 3,
        contact_forces: index == 3,
        body_trees: index == 3,
        cameras: index == 2,
        transparent: index == 2,
        ..Show::default()
    };
    let options = SceneOptions::default().with_effects(effects).with_show(show);
    let view = camera.view(model, data).map_err(|error| error.to_string())?;
    let mut scene = Scene::new();
    scene.update(model, data, view, &options).map_err(|error| error.to_string())?;
    Ok(scene)
}

fn settings(model: &Model, kind: Kind) -> Settings {
    let samples = if kind == Kind::OneSample { Samples::One } else { Samples::Four };
    Settings::of(model).with_samples(samples)
}

#[cfg(test)]
mod tests {
    use super::*;
    use render::scene::Shape;

    #[test]
    fn the_gallery_shows_everything_that_a_picture_can() {
        let model = SHOTS[0].case.load().expect("the gallery loads");
        let data = state(&model, 0).expect("it is simulated");
        let scenes: Vec<Scene> = (0..4)
            .map(|index| {
                scene(&model, &data, cameras(&model)[index], Kind::Colours, index).expect("it is shown")
            })
            .collect();
        let items = || scenes.iter().flat_map(|scene| &scene.items);
        let shapes =
            [Shape::Sphere, Shape::Box, Shape::Capsule, Shape::Cylinder, Shape::Line, Shape::LineBox];
        assert!(shapes.iter().all(|shape| items().any(|item| item.shape == *shape)));
        assert!(items().any(|item| matches!(item.shape, Shape::Plane { .. }) && item.look.reflectance > 0.0));
        assert!(items().any(|item| matches!(item.shape, Shape::Hfield { .. })));
        assert!(items().any(|item| matches!(item.shape, Shape::Mesh { .. })));
        assert!(items().any(|item| item.rgba[3] < 1.0));
        assert!(scenes.iter().all(|scene| scene.sky.is_some()) && scenes[1].haze.is_some());
        assert!(scenes[2].fog.is_some() && scenes[2].view.frustum.orthographic);
        assert_eq!(scenes[0].lights.iter().filter(|light| light.shadow).count(), 2);
        assert!(scenes[3].view.frustum.half_width.is_some());
    }
}
