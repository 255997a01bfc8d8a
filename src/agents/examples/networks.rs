//! Time of a gradient step of small networks for a sample: forward, backward and Adam, on one thread.
//!
//! `cargo run --release -p robohive-agents --example networks`

use agents::nets::{Activation, Adam, Mlp, Tape};
use random::Generator;
use robohive_agents as agents;
use std::time::Instant;

/// Inputs, width of the two hidden layers, outputs.
const NETWORKS: [[usize; 3]; 5] = [[42, 32, 30], [60, 64, 12], [108, 64, 39], [60, 256, 12], [108, 256, 39]];
const BATCHES: [usize; 2] = [256, 2048];
/// Runs of which the shortest counts, each of about as many samples.
const RUNS: usize = 7;
const SAMPLES: usize = 20_000;

fn main() {
    println!(
        "| inputs, hidden, outputs | batch | training [µs a sample] | forward, batch 1 [µs] | batch 16 [µs a sample] |"
    );
    println!("|---|---|---|---|---|");
    let mut rng = Generator::pcg64(1_u64);
    for [inputs, width, outputs] in NETWORKS {
        let net = Mlp::new(&[inputs, width, width, outputs], Activation::Tanh, false);
        let mut parameters = net.draw(1.0, &mut rng);
        let mut numbers = |len: usize| -> Vec<f32> { (0..len).map(|_| rng.random() as f32 - 0.5).collect() };
        for batch in BATCHES {
            let (input, slopes) = (numbers(batch * inputs), numbers(batch * outputs));
            let (mut tape, mut adam) = (Tape::default(), Adam::new(net.parameters()));
            let training = shortest(batch, || {
                net.forward(&parameters, &input, &mut tape);
                let mut gradient = vec![0.0; net.parameters()];
                net.backward(&parameters, &tape, &slopes, &mut gradient);
                adam.step(1e-6, 0.0, &gradient, &mut parameters);
            });
            let mut forward =
                |rows: usize| shortest(rows, || net.forward(&parameters, &input[..rows * inputs], &mut tape));
            let (one, sixteen) = (forward(1), forward(16));
            println!(
                "| {inputs}, 2 x {width}, {outputs} | {batch} | {training:.2} | {one:.2} | {sixteen:.2} |"
            );
        }
    }
}

/// Shortest time for a sample of runs of a step, which takes `batch` of them \[µs\].
fn shortest(batch: usize, mut step: impl FnMut()) -> f64 {
    let repeats = SAMPLES.div_ceil(batch);
    let mut run = || {
        let start = Instant::now();
        (0..repeats).for_each(|_| step());
        start.elapsed().as_secs_f64() * 1e6 / (repeats * batch) as f64
    };
    (0..RUNS).map(|_| run()).fold(f64::INFINITY, f64::min)
}
