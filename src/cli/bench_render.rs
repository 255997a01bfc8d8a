//! `bench-render`: how long pictures of a model take.

use crate::Failure;
use crate::arguments::Reading;
use crate::loading::load;
use crate::render_requests::Requests;
use crate::renderer::RendererArguments;
use crate::terminal::{show, show_json};
use clap::{Args, ValueHint};
use physics::{Data, Model, forward, step};
use render::picture::Channels;
use render::raster::Shot;
use render::scene::{Camera, Effects, SceneOptions};
use render::{Assets, Painter, Painters, Picture, Profile, Scene, Settings};
use serde_json::json;
use std::path::PathBuf;
use std::time::Instant;

/// Measure how long pictures of a model take
#[derive(Args)]
#[command(
    after_help = "Each picture shows another state of a short motion from keyframe 0, or qpos0. Its time includes listing \
what is to be drawn and drawing it, but neither physics nor loading. One thread draws. For a renderer that draws many \
pictures at once, such as a GPU, the time of a picture in batches of 24 follows.

Examples:
  robohive bench-render assets/franka/franka_table.xml --camera front
  robohive bench-render assets/humanoid/humanoid.xml --size 84 --frames 100 --json"
)]
pub struct BenchRender {
    /// MJCF file or compiled model
    #[arg(value_name = "MODEL", value_hint = ValueHint::FilePath)]
    model: PathBuf,
    /// How it is read
    #[command(flatten)]
    reading: Reading,
    /// Camera of the model, or `free`
    #[arg(long, value_name = "NAME", default_value = "free")]
    camera: String,
    /// Columns and rows of the pictures
    #[arg(long, value_name = "N", default_value_t = 224, value_parser = clap::value_parser!(u16).range(1..=8192))]
    size: u16,
    /// What draws
    #[command(flatten)]
    renderer: RendererArguments,
    /// Pictures of each kind
    #[arg(long, value_name = "N", default_value_t = 32, value_parser = clap::value_parser!(u32).range(1..=1_000_000))]
    frames: u32,
    /// Print one JSON object instead
    #[arg(long)]
    json: bool,
    /// Draw what each line of standard input asks for and answer with a line of JSON, for a program that measures processor time
    #[arg(long, hide = true, conflicts_with = "json")]
    requests: bool,
}

/// States of the motion that pictures go through.
const STATES: usize = 24;
/// Steps between two of them.
const APART: usize = 5;

/// What a picture is of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// Colours, four samples a pixel unless the model has fewer.
    Rgb,
    /// Colours without shadows.
    Plain,
    /// Distances.
    Depth,
    /// Segmentation.
    Ids,
}

impl Kind {
    /// All of them, by the names that they are asked for.
    pub const ALL: [(&'static str, Kind); 4] =
        [("rgb", Kind::Rgb), ("plain", Kind::Plain), ("depth", Kind::Depth), ("ids", Kind::Ids)];

    fn channels(self) -> Channels {
        match self {
            Kind::Rgb | Kind::Plain => Channels::RGB,
            Kind::Depth => Channels::DEPTH,
            Kind::Ids => Channels::SEGMENTATION,
        }
    }
}

/// What draws one model on one thread.
pub struct Studio<'a> {
    /// The model.
    pub model: &'a Model,
    /// Its triangles and textures.
    pub assets: Assets,
    painter: Box<dyn Painter>,
    settings: Settings,
    scenes: Vec<Scene>,
    pictures: Vec<Picture>,
}

impl<'a> Studio<'a> {
    /// A studio with its own memory for pictures.
    pub fn new(model: &'a Model, assets: &'a Assets, painters: &dyn Painters) -> Self {
        let settings = Settings::of(model);
        let painter = painters.painter(&settings);
        Studio { model, assets: assets.clone(), painter, settings, scenes: Vec::new(), pictures: Vec::new() }
    }

    /// Lists what is to be drawn of a state and draws it, from all cameras together.
    pub fn take(
        &mut self,
        data: &Data,
        cameras: &[Camera],
        side: usize,
        kind: Kind,
    ) -> Result<&[Picture], Failure> {
        let effects = Effects { shadows: kind != Kind::Plain, ..Effects::default() };
        let options = SceneOptions { effects, ..SceneOptions::default() };
        self.scenes.resize_with(cameras.len(), Scene::new);
        self.pictures.resize_with(cameras.len(), Picture::default);
        for (scene, camera) in self.scenes.iter_mut().zip(cameras) {
            let view = camera.view(self.model, data).map_err(Failure::new)?;
            scene.update(self.model, data, view, &options).map_err(Failure::new)?;
        }
        self.assets.pose(self.model, data, &options).map_err(Failure::new)?;
        let (assets, channels) = (&self.assets, kind.channels());
        let shot = |(scene, picture)| {
            let picture: &mut Picture = picture;
            (picture.width, picture.height) = (side, side);
            Shot { assets, scene, channels, picture }
        };
        let mut shots: Vec<_> = self.scenes.iter().zip(&mut self.pictures).map(shot).collect();
        self.painter.paint(&self.settings, &mut shots).map_err(Failure::new)?;
        Ok(&self.pictures)
    }

    /// Draws all states in colours at once.
    fn take_batch(&mut self, states: &[Data], camera: &Camera, side: usize) -> Result<(), Failure> {
        let mut scenes = vec![Scene::new(); states.len()];
        let mut posed = vec![self.assets.clone(); states.len()];
        let options = SceneOptions::default();
        for ((scene, assets), data) in scenes.iter_mut().zip(&mut posed).zip(states) {
            let view = camera.view(self.model, data).map_err(Failure::new)?;
            scene.update(self.model, data, view, &options).map_err(Failure::new)?;
            assets.pose(self.model, data, &options).map_err(Failure::new)?;
        }
        let mut pictures = vec![Picture::new(side, side); states.len()];
        let Studio { painter, settings, .. } = self;
        let shots = scenes.iter().zip(&posed).zip(&mut pictures);
        let shots =
            shots.map(|((scene, assets), picture)| Shot { assets, scene, channels: Channels::RGB, picture });
        painter.paint(settings, &mut shots.collect::<Vec<_>>()).map_err(Failure::new)
    }

    /// Items of the last scene, and triangles of one pass over them.
    pub fn load(&self) -> [usize; 2] {
        let mut parts = Vec::new();
        let items = self.scenes.first().map_or(&[][..], |scene| &scene.items[..]);
        items.iter().for_each(|item| self.assets.parts(item, &mut parts));
        let triangles = parts.iter().map(|part| self.assets.surfaces[part.surface].faces.len()).sum();
        [items.len(), triangles]
    }
}

/// The camera of this name, or the free one.
pub fn camera(model: &Model, name: &str) -> Result<Camera, Failure> {
    Camera::named(model, name).map_err(Failure::usage)
}

/// Runs the command.
pub fn run(a: &BenchRender) -> Result<(), Failure> {
    let model = load(&a.model, &a.reading)?;
    let assets = Assets::new(&model, Profile::default()).map_err(Failure::new)?;
    let camera = camera(&model, &a.camera)?;
    let mut studio = Studio::new(&model, &assets, &*a.renderer.painters()?);
    if a.requests {
        if a.renderer.is_gpu() {
            return Err(Failure::usage("--requests measures the CPU"));
        }
        return Requests::new(studio, camera).answer();
    }
    let states = motion(&model)?;
    let mut found = serde_json::Map::new();
    for (name, kind) in Kind::ALL {
        let side = usize::from(a.size);
        for data in &states {
            studio.take(data, &[camera], side, kind)?;
        }
        let began = Instant::now();
        for data in states.iter().cycle().take(a.frames as usize) {
            studio.take(data, &[camera], side, kind)?;
        }
        let milliseconds = 1e3 * began.elapsed().as_secs_f64() / f64::from(a.frames);
        found.insert(format!("{name}_ms"), milliseconds.into());
    }
    let batch =
        studio.painter.draws_batches().then(|| batch(&mut studio, &states, &camera, a)).transpose()?;
    let [items, triangles] = studio.load();
    let renderer = studio.painter.name();
    if a.json {
        found.extend([("items".to_owned(), items.into()), ("triangles".to_owned(), triangles.into())]);
        found.extend([("renderer".to_owned(), renderer.into()), ("batch_rgb_ms".to_owned(), batch.into())]);
        found.insert("size".to_owned(), json!(a.size));
        show_json(&found.into());
        return Ok(());
    }
    show!("{items} items, {triangles} triangles, {0} x {0} pixels, {renderer}", a.size);
    for (name, _) in Kind::ALL {
        let text = match name {
            "plain" => "without shadows",
            "ids" => "segmentation",
            name => name,
        };
        show!("{text:<16} {:>9.2} ms", found[&format!("{name}_ms")].as_f64().unwrap_or(f64::NAN));
    }
    if let Some(batch) = batch {
        show!("{:<16} {batch:>9.2} ms", "rgb in batches");
    }
    Ok(())
}

/// Milliseconds of a picture in colours, in batches of all states.
fn batch(studio: &mut Studio<'_>, states: &[Data], camera: &Camera, a: &BenchRender) -> Result<f64, Failure> {
    let side = usize::from(a.size);
    studio.take_batch(states, camera, side)?;
    let began = Instant::now();
    let batches = (a.frames as usize).div_ceil(states.len());
    for _ in 0..batches {
        studio.take_batch(states, camera, side)?;
    }
    Ok(1e3 * began.elapsed().as_secs_f64() / (batches * states.len()) as f64)
}

/// Data at keyframe 0, or at `qpos0`.
pub fn start(model: &Model) -> Result<Data, Failure> {
    let mut data = Data::new(model);
    if model.nkey > 0 {
        data.reset_to_key(model, 0).map_err(Failure::new)?;
    }
    Ok(data)
}

/// States of a short motion without controls.
fn motion(model: &Model) -> Result<Vec<Data>, Failure> {
    let mut data = start(model)?;
    let mut states = Vec::new();
    for _ in 0..STATES {
        for _ in 0..APART {
            step(model, &mut data).map_err(Failure::new)?;
        }
        forward(model, &mut data).map_err(Failure::new)?;
        states.push(data.clone());
    }
    Ok(states)
}
