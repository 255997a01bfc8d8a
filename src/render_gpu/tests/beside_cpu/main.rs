//! Pictures of a GPU beside those of the CPU, which are the reference. Without a GPU nothing is compared, and every test says
//! so; a driver that computes on the CPU, such as Mesa's lavapipe, counts as one.

mod batches;
mod compare;
mod faults;
mod models;
mod shown;
mod synthetic;

use compare::Measures;
use physics::{Data, Model, forward};
use render::picture::Channels;
use render::raster::{self, Renderer, Settings};
use render::scene::{Camera, Scene, SceneOptions};
use render::{Assets, Picture, Profile};
use robohive_render_gpu::{Choice, GpuError, GpuRenderer};

/// A renderer on any GPU. Without a GPU a line is printed, which `cargo xtask gpu` looks for.
fn renderer(settings: Settings) -> Option<GpuRenderer> {
    match GpuRenderer::new(settings, &Choice::Any) {
        Ok(renderer) => Some(renderer),
        Err(error @ GpuError::NoAdapter { .. }) => {
            println!("not checked: {error}");
            None
        }
        Err(error) => panic!("{error}"),
    }
}

/// A model in its first keyframe, or its reference pose, seen by a camera.
struct Shot {
    assets: Assets,
    scene: Scene,
    settings: Settings,
}

impl Shot {
    fn of(model: &Model, camera: &str, options: &SceneOptions) -> Self {
        let mut data = Data::new(model);
        if model.nkey > 0 {
            data.reset_to_key(model, 0).expect("a keyframe");
        }
        forward(model, &mut data).expect("a state");
        let view =
            Camera::named(model, camera).and_then(|camera| camera.view(model, &data)).expect("a camera");
        let mut scene = Scene::new();
        scene.update(model, &data, view, options).expect("a scene");
        let assets = Assets::new(model, Profile::default()).expect("sound assets");
        Shot { assets, scene, settings: Settings::of(model) }
    }

    /// The picture of the CPU.
    fn on_cpu(&self, [width, height]: [usize; 2]) -> Picture {
        let mut picture = Picture::new(width, height);
        let mut renderer = Renderer::new(self.settings);
        renderer.draw(&self.assets, &self.scene, Channels::ALL, &mut picture).expect("a picture of the CPU");
        picture
    }

    /// The picture of a GPU.
    fn on_gpu(&self, renderer: &mut GpuRenderer, [width, height]: [usize; 2]) -> Picture {
        let mut picture = Picture::new(width, height);
        renderer.draw(&self.assets, &self.scene, Channels::ALL, &mut picture).expect("a picture of the GPU");
        picture
    }

    /// How far the two are from each other; nothing without a GPU.
    fn measure(&self, size: [usize; 2]) -> Option<Measures> {
        let ours = self.on_gpu(&mut renderer(self.settings)?, size);
        Some(Measures::of(&self.on_cpu(size), &ours))
    }
}

/// Draws shots in one batch.
fn batch(gpu: &mut GpuRenderer, shown: &[&Shot], channels: Channels, pictures: &mut [Picture]) {
    let pairs = shown.iter().zip(pictures);
    let mut shots: Vec<_> = pairs
        .map(|(Shot { assets, scene, .. }, picture)| raster::Shot { assets, scene, channels, picture })
        .collect();
    gpu.draw_batch(&mut shots).expect("a batch");
}
