//! Training on environments: what is learnt, and that threads make no difference.

use agents::learn::{Algorithm, Collector, Fit, Horizon, Learner, Npg, Ppo, Sac, Settings};
use agents::nets::Activation;
use env::{Env, Options, OwnModels};
use robohive_agents as agents;

const PPO: Ppo =
    Ppo { epochs: 6, batch: 64, rate: 1e-3, clip: 0.2, entropy: 0.0, longest: 0.5, divergence: 0.05 };

const SAC: Sac = Sac { steps: 3, share: 0.02, entropy: -1.0, rate: 1e-3, remembered: 4000, begin: 1000 };

fn settings(algorithm: Algorithm) -> Settings {
    let (lambda, epochs) = if matches!(algorithm, Algorithm::Sac(_)) { (1.0, 32) } else { (0.95, 6) };
    Settings {
        algorithm,
        episodes: 16,
        horizon: Horizon { gamma: 0.95, lambda },
        hidden: [vec![32, 32], vec![32, 32]],
        activation: Activation::Tanh,
        log_std: [-0.5, -2.0],
        fit: Fit { epochs, batch: 64, rate: 1e-3, longest: 0.5 },
    }
}

fn env() -> Env {
    Env::make("hive/myoElbowPose1D6MRandom-v0", &OwnModels, &Options::default()).unwrap()
}

/// A learner after some iterations, by `threads` threads that step `count` environments each.
fn train(algorithm: Algorithm, iterations: usize, [threads, count]: [usize; 2]) -> (Learner, Vec<f64>) {
    let env = env();
    let mut learner = Learner::new(settings(algorithm), 7, &env);
    let mut collector = Collector::new(&env, count, threads).unwrap();
    let rewards = (0..iterations).map(|_| learner.iterate(&mut collector).unwrap().evaluation.reward);
    let rewards = rewards.collect();
    (learner, rewards)
}

#[test]
fn threads_and_their_environments_make_no_difference() {
    for algorithm in [Algorithm::Ppo(PPO), Algorithm::Npg(Npg { step: 0.1 }), Algorithm::Sac(SAC)] {
        let (alone, rewards) = train(algorithm, 2, [1, 4]);
        for sizes in [[2, 3], [4, 1]] {
            let (other, same) = train(algorithm, 2, sizes);
            assert_eq!((&alone, &rewards), (&other, &same), "{sizes:?}");
        }
        assert!(alone.samples > 0 && alone.episodes == 48);
    }
}

#[test]
fn returns_grow() {
    for algorithm in [Algorithm::Ppo(PPO), Algorithm::Npg(Npg { step: 0.1 }), Algorithm::Sac(SAC)] {
        let (_, rewards) = train(algorithm, 6, [2, 8]);
        let mean = |rewards: &[f64]| rewards.iter().sum::<f64>() / rewards.len() as f64;
        assert!(mean(&rewards[4..]) > mean(&rewards[..2]) + 100.0, "{algorithm:?}: {rewards:?}");
    }
}
