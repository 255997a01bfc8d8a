//! `bench-env`: environment steps per second, and where the time goes.

use crate::environments::batch_speed::batch_speed;
use crate::environments::bench_visual::{self, Measuring};
use crate::environments::env_requests::Subject;
use crate::failure::Failure;
use crate::input::library::Making;
use crate::pictures::renderer::RendererArguments;
use crate::terminal::{show, show_json};
use clap::Args;
use env::{Env, Rng, Scene};
use render::Painters;
use serde_json::json;
use std::sync::Arc;
use std::time::Instant;

/// Measure environment steps per second, and the share of the environment's own layer
#[derive(Args)]
#[command(
    after_help = "Random actions, episodes reset as they end. `layer` is the share of a step that is not physics: the \
same controls are sent through the same physics again without robot, observation and reward. With --visual every step draws \
the images of the visual keys; `first` is the time until the first of them, for which triangles and textures are prepared.

Examples:
  robohive bench-env hive/FrankaReach-v0
  robohive bench-env hive/FrankaReach-v0 --threads 2 --seconds 1 --json
  robohive bench-env hive/FrankaReach_v2d-v0 --visual"
)]
pub struct BenchEnv {
    /// Ids of environments
    #[arg(value_name = "ID", required = true)]
    ids: Vec<String>,
    /// How they are made
    #[command(flatten)]
    making: Making,
    /// Threads of a batch, measured beside one environment on one thread
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u16).range(1..=1024))]
    threads: u16,
    /// Time to measure for [s]
    #[arg(long, value_name = "S", default_value_t = 2.0)]
    seconds: f64,
    /// Draw the images of the visual keys in every step
    #[arg(long, conflicts_with = "requests")]
    visual: bool,
    /// What draws them
    #[command(flatten)]
    renderer: RendererArguments,
    /// Print one JSON array instead
    #[arg(long)]
    json: bool,
    /// Answer requests of standard input for parts of the time of one environment, a line of JSON each
    #[arg(long, hide = true, conflicts_with = "json")]
    requests: bool,
}

/// Steps between two looks at the clock.
const CHUNK: usize = 10;
/// Environments of a batch for each thread.
const PER_THREAD: usize = 4;

/// What was measured of an environment.
struct Speed {
    /// Steps per second of one environment on one thread.
    single: f64,
    /// Share of a step that is not physics.
    layer: f64,
    /// Steps per second of a batch on all threads, and on one.
    batch: Option<[f64; 2]>,
}

/// Runs the command.
pub fn run(a: &BenchEnv) -> Result<(), Failure> {
    let mut rows = Vec::new();
    let painters = a.renderer.painters_if(a.visual, "--visual")?;
    if a.requests {
        return a.ids.iter().try_for_each(|id| answer(id, a));
    }
    if a.visual {
        return visual(a, &painters);
    }
    if !a.json {
        show!("{:<40} {:>12} {:>8} {:>14} {:>10}", "id", "steps/s", "layer", "batch steps/s", "x one");
    }
    for id in &a.ids {
        let env = a.making.make(id)?;
        let speed = measure(&env, a).map_err(|error| Failure::new(format!("{id}: {error}")))?;
        if a.json {
            rows.push(json!({
                "id": id, "steps_per_second": speed.single, "layer": speed.layer, "threads": a.threads,
                "batch_steps_per_second": speed.batch.map(|[all, _]| all),
                "batch_one_thread": speed.batch.map(|[_, one]| one),
            }));
            continue;
        }
        let layer = 100.0 * speed.layer;
        let [all, ratio] = match speed.batch {
            Some([all, one]) => [format!("{all:.0}"), format!("{:.2}", all / one)],
            None => ["".into(), "".into()],
        };
        show!("{id:<40} {:>12.0} {layer:>7.1}% {all:>14} {ratio:>10}", speed.single);
    }
    if a.json {
        show_json(&rows.into());
    }
    Ok(())
}

/// Measures with images.
fn visual(a: &BenchEnv, painters: &Arc<dyn Painters>) -> Result<(), Failure> {
    let threads = usize::from(a.threads);
    let measuring = Measuring { seconds: a.seconds, threads, count: PER_THREAD * threads };
    let mut rows = Vec::new();
    if !a.json {
        bench_visual::show_header();
    }
    for id in &a.ids {
        let speed = bench_visual::measure(&a.making.make_with(id, painters.clone())?, &measuring)
            .map_err(|error| Failure { code: error.code, ..Failure::new(format!("{id}: {error}")) })?;
        if a.json {
            rows.push(speed.json(id, threads));
        } else {
            speed.show(id);
        }
    }
    if a.json {
        show_json(&rows.into());
    }
    Ok(())
}

fn answer(id: &str, a: &BenchEnv) -> Result<(), Failure> {
    let count = PER_THREAD * usize::from(a.threads);
    Subject { id, making: &a.making, env: a.making.make(id)?, count, seconds: a.seconds }.answer()
}

fn measure(env: &Env, a: &BenchEnv) -> Result<Speed, Failure> {
    let (single, layer) = single(env, a.seconds)?;
    let mut batch = None;
    if a.threads > 1 {
        let count = PER_THREAD * usize::from(a.threads);
        let all = batch_speed(env, count, usize::from(a.threads), a.seconds)?;
        batch = Some([all, batch_speed(env, count, 1, a.seconds)?]);
    }
    Ok(Speed { single, layer, batch })
}

/// Steps per second of one environment, and the share of its own layer.
fn single(env: &Env, seconds: f64) -> Result<(f64, f64), Failure> {
    let mut env = env.fork().map_err(Failure::new)?;
    let mut rng = Rng::pcg64(0_u64);
    let mut action = vec![0.0; env.action_len()];
    env.reset(Some(0)).map_err(Failure::new)?;
    let (mut whole, mut physics, mut steps) = (0.0_f64, 0.0_f64, 0);
    while whole + physics < seconds {
        let mut twin = env.scene().clone();
        let mut controls = Vec::new();
        let mut ended = false;
        for _ in 0..CHUNK {
            env.random_action(&mut rng, &mut action).map_err(Failure::new)?;
            let began = Instant::now();
            let step = env.step(&action).map_err(Failure::new)?;
            whole += began.elapsed().as_secs_f64();
            controls.push(env.robot().last_control().to_vec());
            steps += 1;
            ended = step.terminated || step.truncated;
            if ended {
                break;
            }
        }
        let began = Instant::now();
        again(&mut twin, &controls, env.frame_skip());
        physics += began.elapsed().as_secs_f64();
        if ended {
            env.reset(None).map_err(Failure::new)?;
        }
    }
    Ok((steps as f64 / whole, (1.0 - physics / whole).max(0.0)))
}

/// Sends controls through physics alone. A step that is refused was refused before, and ends the episode.
fn again(scene: &mut Scene, controls: &[Vec<f64>], frame_skip: usize) {
    for control in controls {
        scene.data.state.ctrl.copy_from_slice(control);
        if scene.advance(frame_skip, |_| ()).is_err() {
            return;
        }
        scene.complete();
    }
}
