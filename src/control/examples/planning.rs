//! How often a search by sampling can plan: `cargo run --profile ci -p robohive-control --example planning` prints a row for each kind of
//! task that MuJoCo MPC publishes settings of, with its horizon, time step, spline points, noise and rollouts, on our model of that
//! kind, by one thread and by two. The motion is warm: every plan starts from the state that the one before it led to.

use physics::{Data, Model, Snapshot, step};
use robohive_control::maths::{Method, Sampler, Settings};
use std::error::Error;
use std::time::Instant;

/// Plans of one measurement.
const PLANS: usize = 12;
/// Measurements of each number of threads, in turns.
const ROUNDS: usize = 5;

/// Settings of a kind of task, from the `task.xml` files of google-deepmind/mujoco_mpc.
struct Kind {
    name: &'static str,
    scene: &'static str,
    method: Method,
    /// Horizon and time step \[s\].
    horizon: f64,
    step: f64,
    knots: usize,
    noise: f64,
    rollouts: usize,
}

const KINDS: [Kind; 6] = [
    kind("acrobot", "classical/tasks/acrobot.xml", [2.0, 0.01, 0.05], 10, 10),
    kind("quadruped, hill", "minicheetah/scene.xml", [0.25, 0.01, 0.3], 5, 60),
    kind("humanoid, stand", "humanoid/humanoid.xml", [0.35, 0.015, 0.05], 3, 60),
    kind("arm, reach and pick", "panda/scene.xml", [0.5, 0.009, 0.1], 7, 60),
    kind("Allegro, cube", "allegro/scene.xml", [0.5, 0.01, 0.1], 6, 10),
    Kind {
        method: Method::CrossEntropy { elites: 6 },
        ..kind("Shadow, reorient", "shadow/scene.xml", [0.25, 0.01, 0.2], 5, 60)
    },
];

const fn kind(
    name: &'static str,
    scene: &'static str,
    [horizon, step, noise]: [f64; 3],
    knots: usize,
    rollouts: usize,
) -> Kind {
    Kind { name, scene, method: Method::Predictive, horizon, step, knots, noise, rollouts }
}

/// The same for every state, so that no sample costs more than another and is ended early.
fn cost(_: &Model, _: &Data) -> f64 {
    1.0
}

/// A search, and the motion that it plans for.
struct Planned {
    sampler: Sampler,
    data: Data,
}

impl Planned {
    fn new(model: &Model, kind: &Kind, threads: usize) -> Result<Self, Box<dyn Error>> {
        let mut data = Data::new(model);
        if model.nkey > 0 {
            data.reset_to_key(model, 0)?;
        }
        let Kind { method, knots, noise, rollouts: samples, .. } = *kind;
        let steps = (kind.horizon / kind.step).round() as usize;
        let settings = Settings { method, samples, steps, knots, noise, threads, seed: 1 };
        Ok(Planned { sampler: Sampler::new(model, settings)?, data })
    }

    /// Plans and follows the plan for a step, again and again; seconds of the plans.
    fn seconds(&mut self, model: &Model) -> Result<f64, Box<dyn Error>> {
        let (mut state, mut spent) = (Snapshot::default(), 0.0);
        for _ in 0..PLANS {
            self.data.save(&mut state);
            let began = Instant::now();
            self.sampler.improve(&state, cost)?;
            spent += began.elapsed().as_secs_f64();
            self.sampler.controls(0.0, &mut self.data.state.ctrl);
            step(model, &mut self.data)?;
            self.sampler.shift(1);
        }
        Ok(spent)
    }
}

fn measure(kind: &Kind) -> Result<String, Box<dyn Error>> {
    let mut model = mjcf::Loader::default().files(assets::Own).load(kind.scene)?.model;
    model.options_mut().timestep = kind.step;
    let mut sides = [Planned::new(&model, kind, 1)?, Planned::new(&model, kind, 2)?];
    let mut least = [f64::INFINITY; 2];
    for _ in 0..ROUNDS {
        for (side, least) in sides.iter_mut().zip(&mut least) {
            *least = least.min(side.seconds(&model)?);
        }
    }
    assert_eq!(sides[0].data.state.qpos, sides[1].data.state.qpos, "threads change no bit");
    let [one, two] = least.map(|seconds| PLANS as f64 / seconds);
    let steps = (kind.horizon / kind.step).round();
    let Kind { name, scene, horizon, step, knots, rollouts, .. } = kind;
    Ok(format!(
        "| {name} | `{scene}` | {horizon} | {} | {knots} | {rollouts} | {one:.0} | {two:.0} | {:.2} | {:.0} |",
        1e3 * step,
        two / one,
        one * steps * *rollouts as f64,
    ))
}

fn main() -> Result<(), Box<dyn Error>> {
    println!(
        "| kind | scene | horizon [s] | step [ms] | knots | rollouts | plans a second | by two threads | ratio | steps a second, one thread |"
    );
    println!("|---|---|---|---|---|---|---|---|---|---|");
    for kind in &KINDS {
        println!("{}", measure(kind)?);
    }
    Ok(())
}
