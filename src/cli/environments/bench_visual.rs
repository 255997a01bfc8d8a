//! `bench-env --visual`: environment steps per second with the images of the visual keys.

use crate::failure::Failure;
use crate::terminal::show;
use env::{Autoreset, Env, Rng, VecEnv};
use serde_json::{Value, json};
use std::time::Instant;

/// How it is measured.
pub struct Measuring {
    /// Time to measure for, each time [s].
    pub seconds: f64,
    /// Threads of a batch.
    pub threads: usize,
    /// Environments of a batch.
    pub count: usize,
}

/// What was measured of an environment.
pub struct VisualSpeed {
    images: usize,
    /// Time until the first images of an environment, for which its model is prepared [s].
    first: f64,
    /// Steps per second without and with images, of one environment on one thread.
    single: [f64; 2],
    /// Steps per second with images of a batch on all threads.
    batch: Option<f64>,
}

/// Prints the names of the columns.
pub fn show_header() {
    show!(
        "{:<34} {:>6} {:>10} {:>12} {:>10} {:>10} {:>14}",
        "id",
        "images",
        "steps/s",
        "with images",
        "ms/image",
        "first ms",
        "batch steps/s"
    );
}

impl VisualSpeed {
    /// Milliseconds that one image adds to a step.
    fn milliseconds(&self) -> f64 {
        let [without, with] = self.single;
        1e3 * (1.0 / with - 1.0 / without) / self.images as f64
    }

    /// Prints one row.
    pub fn show(&self, id: &str) {
        let batch = self.batch.map_or_else(String::new, |batch| format!("{batch:.1}"));
        let ([without, with], image) = (self.single, self.milliseconds());
        let first = 1e3 * self.first;
        let images = self.images;
        show!("{id:<34} {images:>6} {without:>10.0} {with:>12.1} {image:>10.2} {first:>10.0} {batch:>14}");
    }

    /// The same as JSON.
    pub fn json(&self, id: &str, threads: usize) -> Value {
        json!({
            "id": id, "images": self.images, "steps_per_second": self.single[0],
            "steps_per_second_with_images": self.single[1], "milliseconds_per_image": self.milliseconds(),
            "first_images_seconds": self.first, "threads": threads, "batch_steps_per_second": self.batch,
        })
    }
}

/// Measures an environment.
///
/// # Errors
/// It has no visual keys, or its images cannot be drawn.
pub fn measure(env: &Env, measuring: &Measuring) -> Result<VisualSpeed, Failure> {
    if env.visual_keys().is_empty() {
        return Err(Failure::usage("it has no visual keys, so that there is nothing to draw"));
    }
    let mut env = env.fork().map_err(Failure::new)?;
    env.reset(Some(0)).map_err(Failure::new)?;
    let began = Instant::now();
    env.exteroception().map_err(Failure::usage)?;
    let first = began.elapsed().as_secs_f64();
    let single = [single(&mut env, measuring.seconds, false)?, single(&mut env, measuring.seconds, true)?];
    let batch = (measuring.threads > 1).then(|| batch(&env, measuring)).transpose()?;
    Ok(VisualSpeed { images: env.visual_keys().len(), first, single, batch })
}

/// Steps per second, resets not counted.
fn single(env: &mut Env, seconds: f64, images: bool) -> Result<f64, Failure> {
    let mut rng = Rng::pcg64(0_u64);
    let mut action = vec![0.0; env.action_len()];
    env.reset(Some(0)).map_err(Failure::new)?;
    let (mut spent, mut steps) = (0.0, 0);
    while spent < seconds {
        env.random_action(&mut rng, &mut action).map_err(Failure::new)?;
        let began = Instant::now();
        let step = env.step(&action).map_err(Failure::new)?;
        if images {
            env.exteroception().map_err(Failure::usage)?;
        }
        spent += began.elapsed().as_secs_f64();
        steps += 1;
        if step.terminated || step.truncated {
            env.reset(None).map_err(Failure::new)?;
        }
    }
    Ok(f64::from(steps) / spent)
}

/// Steps per second of a batch, with images.
fn batch(env: &Env, measuring: &Measuring) -> Result<f64, Failure> {
    let count = measuring.count;
    let mut envs = VecEnv::new(env, count, Autoreset::NextStep, measuring.threads).map_err(Failure::new)?;
    let mut rng = Rng::pcg64(1_u64);
    let mut actions = vec![0.0; count * env.action_len()];
    envs.reset(Some(0)).map_err(Failure::new)?;
    let (began, mut steps) = (Instant::now(), 0);
    while began.elapsed().as_secs_f64() < measuring.seconds {
        for action in actions.chunks_exact_mut(env.action_len()) {
            env.random_action(&mut rng, action).map_err(Failure::new)?;
        }
        envs.step(&actions).map_err(Failure::new)?;
        envs.exteroception().map(drop).map_err(Failure::usage)?;
        steps += count;
    }
    Ok(steps as f64 / began.elapsed().as_secs_f64())
}
