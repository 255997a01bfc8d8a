//! Cameras of robots on hardware, and simulated cameras for rehearsals.

use env::{CameraError, Cameras, OpenCameras};
use hardware::Setup;
use hardware::camera::{
    self, Capture, Captures, Encoding, Format, Frame, Request, Wanted, depth_to_z16, rgb_to_yuyv,
};
use physics::{Data, forward};
use render::picture::Channels;
use render::scene::{Camera, SceneOptions};
use render::{Assets, Picture, Profile, Renderer, Scene, Settings};
use robot::{Config, Fault};
use std::io;
use std::sync::{Arc, PoisonError};
use std::time::Duration;
use wire::{Bench, Shared};

/// Opens the cameras of a config as `setup` says.
pub(crate) fn opener(setup: Setup) -> OpenCameras {
    Arc::new(move |config: &Config| {
        let cameras =
            camera::Cameras::connect(config, &setup).map_err(|error| CameraError::new(error.to_string()))?;
        Ok(Box::new(Frames(cameras)))
    })
}

/// Frames of real or simulated cameras, for visual keys.
struct Frames(camera::Cameras);

impl Cameras for Frames {
    fn names(&self) -> Vec<String> {
        self.0.names().map(str::to_owned).collect()
    }

    fn take(&mut self, camera: &str, channels: Channels, picture: &mut Picture) -> Result<(), CameraError> {
        let Picture { width, height, rgb, depth, .. } = picture;
        let wanted = Wanted { rgb: channels.rgb.then_some(rgb), depth: channels.depth.then_some(depth) };
        self.0.take(camera, [*height, *width], wanted).map_err(|error| CameraError::new(error.to_string()))
    }
}

/// Unit of a simulated camera's depth \[m\]: the default of a real one.
const UNIT: f64 = 0.001;

/// Simulated cameras of a bench: each renders from the model's camera of its name, in the bench's time.
pub(crate) struct Onlookers(pub(crate) Shared);

impl Captures for Onlookers {
    fn open(&self, name: &str, request: &Request) -> Result<Box<dyn Capture>, Fault> {
        let bench = lock(&self.0);
        let model = bench.plant().model();
        let refused = |error: render::RenderError| Fault::Refused(error.to_string());
        let camera = Camera::named(model, name).map_err(refused)?;
        let format = Format {
            encoding: request.encodings[0],
            width: request.width,
            height: request.height,
            rate: request.rate,
        };
        if format.encoding == Encoding::Mjpg {
            return Err(Fault::Refused(
                "a simulated camera sends no JPEG pictures; set its 'format' to 'yuyv'".to_owned(),
            ));
        }
        Ok(Box::new(Onlooker {
            camera,
            format,
            assets: Assets::new(model, Profile::Mujoco312).map_err(refused)?,
            renderer: Renderer::new(Settings::of(model)),
            scene: Scene::new(),
            picture: Picture::new(format.width, format.height),
            data: Data::new(model),
            frame: Vec::new(),
            sent: 0,
            due: f64::NEG_INFINITY,
            bench: self.0.clone(),
        }))
    }
}

/// A simulated camera. Frames that are not read are neither drawn nor counted, since only the newest is used.
struct Onlooker {
    bench: Shared,
    camera: Camera,
    format: Format,
    assets: Assets,
    renderer: Renderer,
    scene: Scene,
    picture: Picture,
    data: Data,
    frame: Vec<u8>,
    sent: u32,
    /// Time of the next frame [s].
    due: f64,
}

impl Capture for Onlooker {
    fn format(&self) -> Format {
        self.format
    }

    fn settles(&self) -> bool {
        false
    }

    fn next(&mut self, _: Duration) -> io::Result<Option<Frame<'_>>> {
        let bench = self.bench.clone();
        let bench = lock(&bench);
        let time = bench.time();
        if time < self.due {
            return Ok(None);
        }
        self.draw(&bench).map_err(io::Error::other)?;
        drop(bench);
        match self.format.encoding {
            Encoding::Z16 => depth_to_z16(&self.picture.depth, UNIT, &mut self.frame),
            _ => rgb_to_yuyv(&self.picture.rgb, &mut self.frame),
        }
        self.due = time + 1.0 / self.format.rate;
        self.sent = self.sent.wrapping_add(1);
        Ok(Some(Frame { bytes: &self.frame, sequence: self.sent, time, damaged: false }))
    }
}

impl Onlooker {
    fn draw(&mut self, bench: &Bench) -> Result<(), Box<dyn std::error::Error + Send + Sync>> {
        let model = bench.plant().model();
        let options = SceneOptions::default();
        self.data.clone_from(bench.plant().data());
        forward(model, &mut self.data)?;
        let view = self.camera.view(model, &self.data)?;
        self.assets.pose(model, &self.data, &options)?;
        self.scene.update(model, &self.data, view, &options)?;
        let depth = self.format.encoding == Encoding::Z16;
        let channels = if depth { Channels::DEPTH } else { Channels::RGB };
        self.renderer.draw(&self.assets, &self.scene, channels, &mut self.picture)?;
        Ok(())
    }
}

/// Locks the bench, also after a panic elsewhere.
fn lock(bench: &Shared) -> std::sync::MutexGuard<'_, Bench> {
    bench.lock().unwrap_or_else(PoisonError::into_inner)
}
