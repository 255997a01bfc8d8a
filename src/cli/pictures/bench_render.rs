//! `bench-render`: how long pictures of a model take.

use crate::failure::Failure;
use crate::input::loading::load;
use crate::input::source::Reading;
use crate::pictures::render_requests::Requests;
use crate::pictures::renderer::RendererArguments;
use crate::pictures::studio::{Kind, Studio, camera, start};
use crate::terminal::{show, show_json};
use clap::{Args, ValueHint};
use physics::{Data, Model, forward, step};
use render::scene::Camera;
use render::{Assets, Profile};
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
