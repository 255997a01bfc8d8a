//! How many pictures a second the window draws of running models of our own: by the GPU at 1280 x 720, by the CPU at 640 x 360,
//! each with the physics of a sixtieth of a second.
//!
//!     cargo run --release -p robohive-viewer --features robohive-viewer/window --example frames -- [FRAMES]

use eframe::egui::{Context, RawInput};
use eframe::egui_wgpu::{RenderState, RendererOptions, wgpu};
use pollster::block_on;
use robohive_viewer::window::{Channel, Painters, setup};
use robohive_viewer::{Command, Scenery, Session, load_own, own_models};
use std::error::Error;
use std::time::Instant;

/// Sizes of pictures \[pixel\].
const BY_GPU: [usize; 2] = [1280, 720];
const BY_CPU: [usize; 2] = [640, 360];
/// Frames that are not counted.
const FIRST: usize = 10;
/// What goes by in a frame \[s\].
const SPAN: f64 = 1.0 / 60.0;

fn main() -> Result<(), Box<dyn Error>> {
    let frames = std::env::args().nth(1).map_or(Ok(120), |count| count.parse())?;
    let configuration = setup();
    let instance = block_on(configuration.wgpu_setup.new_instance());
    let gpu = block_on(RenderState::create(&configuration, &instance, None, RendererOptions::default()));
    let gpu = gpu.inspect_err(|error| println!("there is no GPU: {error}")).ok();
    let mut painters = Painters::of(gpu.as_ref());
    painters.use_gpu(true);
    println!("frames a second, by {} at {BY_GPU:?} and by the CPU at {BY_CPU:?}", painters.name());
    for (name, _) in own_models() {
        painters.use_gpu(true);
        let by_gpu = gpu.as_ref().map(|state| rate(name, &mut painters, Some(state), BY_GPU, frames));
        painters.use_gpu(false);
        let by_cpu = rate(name, &mut painters, None, BY_CPU, frames)?;
        let by_gpu = by_gpu.transpose()?.map_or("-".into(), |rate| format!("{rate:.0}"));
        println!("{name:16} {by_gpu:>6} {by_cpu:>6.0}");
    }
    Ok(())
}

/// Frames a second of a model that runs.
fn rate(
    name: &str,
    painters: &mut Painters,
    gpu: Option<&RenderState>,
    size: [usize; 2],
    frames: usize,
) -> Result<f64, Box<dyn Error>> {
    let context = Context::default();
    let mut session = Session::new(load_own(name)?.model)?;
    let mut scenery = Scenery::new(session.model())?;
    session.perform(Command::Run);
    let mut frame = || -> Result<(), Box<dyn Error>> {
        session.advance(SPAN, &mut || true);
        scenery.update(&session)?;
        let mut drawn = Ok(());
        let mut output = context.run_ui(RawInput::default(), |ui| {
            drawn = painters.paint(ui.ctx(), &scenery, Channel::Colours, size).map(drop);
        });
        output.textures_delta.clear();
        drawn?;
        if let Some(state) = gpu {
            state.device.poll(wgpu::PollType::wait_indefinitely())?;
        }
        Ok(())
    };
    for _ in 0..FIRST {
        frame()?;
    }
    let began = Instant::now();
    for _ in 0..frames {
        frame()?;
    }
    Ok(frames as f64 / began.elapsed().as_secs_f64())
}
