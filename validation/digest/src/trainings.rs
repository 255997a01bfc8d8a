//! Trainings: what each algorithm has learnt after some iterations, as a hash of the policy's parameters.

use crate::fnv::Fnv;
use agents::Policy;
use agents::learn::{Algorithm, Collector, Demonstrations, Fit, Learner, Lessons, Settings};
use env::{Env, Options, OwnModels};
use physics::table::Slice;

/// The environment: of short episodes, and solved in a third of them without an action.
const ID: &str = "hive/myoElbowPose1D6MRandom-v0";
const ITERATIONS: usize = 20;
const SEED: u64 = 7;

/// A training by one algorithm.
pub struct Training {
    pub name: &'static str,
    settings: fn() -> Settings,
}

pub const TRAININGS: &[Training] = &[
    Training { name: "training_npg", settings: Settings::npg },
    Training { name: "training_ppo", settings: Settings::ppo },
    Training { name: "training_sac", settings: Settings::sac },
    Training { name: "training_bc", settings: Settings::cloning },
    Training { name: "training_dagger", settings: Settings::dagger },
    Training { name: "training_dapg", settings: Settings::dapg },
];

/// The hash after all iterations on `threads` threads.
///
/// # Errors
/// The environment cannot be made, or the training fails; in words.
pub fn hash_of(training: &Training, threads: usize) -> Result<u64, String> {
    learn(small((training.settings)()), threads).map_err(|error| format!("{}: {error}", training.name))
}

/// The same settings with two episodes an iteration and networks of 16 numbers, which unoptimised builds train too.
fn small(settings: Settings) -> Settings {
    let mut small = Settings { episodes: 2, hidden: [vec![16], vec![16]], ..settings };
    if let Algorithm::Sac(sac) = &mut small.algorithm {
        // Room for half of what is observed, so that some of it is forgotten.
        (sac.begin, sac.remembered) = (500, 2100);
        small.fit = Fit { epochs: 8, batch: 32, ..small.fit };
    }
    small
}

fn learn(settings: Settings, threads: usize) -> Result<u64, Box<dyn std::error::Error>> {
    let mut env = Env::make(ID, &OwnModels, &Options::default())?;
    let (algorithm, mut collector) = (settings.algorithm, Collector::new(&env, 2, threads)?);
    let mut learner = Learner::new(settings, SEED, &env);
    if algorithm.needs_demonstrations() {
        let lessons = Lessons { episodes: 2, noise: 0.1 };
        learner.teach(Demonstrations::play(&mut env, &mut Policy::Zero, lessons, SEED, |_| ())?);
    }
    if algorithm.needs_corrections() {
        collector.teach(|_| Ok(Box::new(Policy::Zero)))?;
    }
    for _ in 0..ITERATIONS {
        learner.iterate(&mut collector)?;
    }
    let (mut hash, parameters) = (Fnv::default(), &learner.actor.parameters);
    hash.array("policy", &[parameters.len()], Slice::F32(parameters));
    Ok(hash.finish())
}
