//! Makes logs of robots with known parameters and noise, fits them, and prints the table of what is found.
//!
//! ```text
//! cargo run --release -p robohive-identify --example recovery > validation/results/identify.md
//! ```

#[path = "../robots/mod.rs"]
#[allow(dead_code)]
mod robots;

use physics::Data;
use robohive_identify::{Found, IdentifyError, Options, Quantity, identify};
use robots::{ARM, FINGER, LEG, Robot};
use std::time::Instant;

/// Logs of each robot, whose errors are counted.
const SEEDS: u64 = 10;

/// What is counted of all logs of a robot.
#[derive(Default)]
struct Count {
    values: usize,
    within_two: usize,
    /// Largest errors: in deviations, and over the true value.
    deviations: f64,
    share: f64,
    seconds: f64,
}

impl Count {
    fn add(&mut self, found: &Found, truth: &[f64], seconds: f64) {
        for ((value, deviation), truth) in found.values.iter().zip(&found.deviations).zip(truth) {
            let error = (value - truth).abs();
            self.values += 1;
            self.within_two += usize::from(error <= 2.0 * deviation);
            self.deviations = self.deviations.max(error / deviation);
            self.share = self.share.max(error / truth.abs());
        }
        self.seconds = self.seconds.max(seconds);
    }
}

fn main() -> Result<(), IdentifyError> {
    println!(
        "# Parameters identified from logs\n\n`cargo run --release -p robohive-identify --example recovery > \
         validation/results/identify.md`: logs of robots whose parameters are known, with noise of {:.0e} rad on positions and {:.0e} \
         rad/s on velocities, {SEEDS} logs each with other noise. The fit begins with 0.5 and 1.6 times the true values by turns. A \
         value with a normal error is within two deviations in 95.4 of 100 cases. Times are those of the slowest fit.\n",
        robots::NOISE[0],
        robots::NOISE[1]
    );
    println!(
        "| robot | parameters | log | values within two deviations | largest error | over the true value | time |"
    );
    println!("|---|---|---|---|---|---|---|");
    let mut first = Vec::new();
    for (name, text, seconds) in [
        ("arm, 7 joints", ARM, 4.0),
        ("leg of a quadruped, 3 joints", LEG, 4.0),
        ("finger, 4 joints", FINGER, 4.0),
    ] {
        let robot = Robot::new(text);
        let model = robot.disturbed();
        let parameters = Quantity::choose("damping,frictionloss,armature", &model)?;
        let mut count = Count::default();
        for seed in 0..SEEDS {
            let log = robot.log(seconds, 0, seed);
            let began = Instant::now();
            let found = identify(&model, &[log], &parameters, &Options::default())?;
            count.add(&found, &robot.truth(&found), began.elapsed().as_secs_f64());
            if seed == 0 {
                first.push((name, robot.truth(&found), found));
            }
        }
        println!(
            "| {name} | {} | {seconds} s | {} of {} | {:.1} deviations | {:.2} % | {:.1} s |",
            parameters.len(),
            count.within_two,
            count.values,
            count.deviations,
            100.0 * count.share,
            count.seconds
        );
    }
    println!(
        "\nThe first log of each:\n\n| robot | parameter | true | before | found | deviation |\n|---|---|---|---|---|---|"
    );
    for (name, truth, found) in first {
        for (i, p) in found.parameters.iter().enumerate() {
            let (value, deviation) = (found.values[i], found.deviations[i]);
            let [truth, start, value] = [truth[i], p.start, value].map(shown);
            println!("| {name} | {} | {truth} | {start} | {value} | {deviation:.1e} |", p.name);
        }
    }
    unidentifiable()
}

/// A value in five digits or so.
fn shown(value: f64) -> String {
    if value.abs() < 0.01 { format!("{value:.4e}") } else { format!("{value:.5}") }
}

/// What a log cannot tell: the dynamics of what stands still, and the mass of what turns about an upright axis.
fn unidentifiable() -> Result<(), IdentifyError> {
    println!("\nWhat a log cannot tell is named:\n\n| log | fitted | named |\n|---|---|---|");
    let arm = Robot::new(ARM);
    let still = arm.rows(&Data::new(&arm.model), 1.0, 0, 1);
    let resting = robots::Rows {
        ctrl: vec![0.0; still.ctrl.len()],
        readings: arm.at_rest(still.times.len(), 1),
        ..still
    };
    for (what, log, fit) in [
        (
            "arm that stands still",
            arm.log_from(&Data::new(&arm.model), resting),
            "joint0.damping,joint0.armature",
        ),
        ("arm that moves", arm.log(4.0, 0, 1), "link0.mass,joint0.armature,joint0.damping"),
    ] {
        let parameters = Quantity::choose(fit, &arm.model)?;
        let found = identify(&arm.model, &[log], &parameters, &Options::default())?;
        let named: Vec<_> = found
            .unknown
            .iter()
            .map(|direction| {
                let parts: Vec<_> =
                    direction.parts.iter().map(|(name, share)| format!("{share:+.2} {name}")).collect();
                parts.join(" ")
            })
            .collect();
        println!("| {what} | {fit} | {} |", if named.is_empty() { "—".into() } else { named.join("; ") });
    }
    Ok(())
}
