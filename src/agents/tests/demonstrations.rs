//! Demonstrations: which are kept, what files hold, and what is learnt from them.

use agents::learn::{Collector, Demonstrations, Learner, Lessons, Settings, Teacher};
use agents::{Policy, PolicyError};
use env::{Env, Options, OwnModels};
use robohive_agents as agents;
use std::path::Path;

/// An elbow, which reaches a third of its poses when no muscle is excited.
const ID: &str = "hive/myoElbowPose1D6MRandom-v0";

fn env(id: &str) -> Env {
    Env::make(id, &OwnModels, &Options::default()).unwrap()
}

fn play(
    id: &str,
    teacher: &mut dyn Teacher,
    episodes: u64,
    noise: f64,
    seed: u64,
) -> Result<Demonstrations, String> {
    let says = |error: PolicyError| error.to_string();
    Demonstrations::play(&mut env(id), teacher, Lessons { episodes, noise }, seed, |_| ()).map_err(says)
}

/// Small actions that follow from what is observed.
struct Bent;

fn bent(observation: &[f64], k: usize) -> f64 {
    0.2 * (3.0 * observation[0] + k as f64).sin()
}

impl Teacher for Bent {
    fn begin(&mut self, _: &Env, _: u64) -> Result<(), PolicyError> {
        Ok(())
    }

    fn act(&mut self, env: &Env, action: &mut [f64]) -> Result<(), PolicyError> {
        action.iter_mut().enumerate().for_each(|(k, value)| *value = bent(env.observation(), k));
        Ok(())
    }
}

#[test]
fn only_successes_are_kept_and_a_seed_repeats_them() {
    let one = play(ID, &mut Policy::Zero, 3, 0.0, 1).unwrap();
    assert_eq!(one.sizes(), [3, 300]);
    assert!(one.played > 3, "{}", one.played);
    assert_eq!(one, play(ID, &mut Policy::Zero, 3, 0.0, 1).unwrap());
    assert_ne!(one, play(ID, &mut Policy::Zero, 3, 0.0, 2).unwrap());
    let disturbed = play(ID, &mut Policy::Zero, 1, 0.3, 1).unwrap();
    assert_ne!(disturbed, play(ID, &mut Policy::Zero, 1, 0.0, 1).unwrap());
}

#[test]
fn who_fails_is_no_teacher() {
    let why = play("hive/Acrobot-v0", &mut Policy::Zero, 1, 0.0, 1).unwrap_err();
    assert!(why.contains("hive/Acrobot-v0: it succeeded in 0 of 10 episodes, and 1 are asked for"), "{why}");
    let why = play(ID, &mut Policy::Zero, 1, f64::NAN, 1).unwrap_err();
    assert!(why.contains("the noise of its actions"), "{why}");
    let why = play(ID, &mut Policy::Zero, 0, 0.0, 1).unwrap_err();
    assert!(why.contains("at least one demonstration"), "{why}");
}

#[test]
fn files_hold_them() {
    let file = Path::new(env!("CARGO_TARGET_TMPDIR")).join("demonstrations.safetensors");
    let mut one = play(ID, &mut Policy::Zero, 2, 0.1, 5).unwrap();
    one.save(&file).unwrap();
    assert_eq!(one, Demonstrations::open(&env(ID), &file).unwrap());
    let says = |id: &str| Demonstrations::open(&env(id), &file).map(drop).unwrap_err().to_string();
    assert!(says("hive/FrankaReach-v0").contains(&format!("it holds demonstrations in {ID}")));
    let whole = std::fs::read(&file).unwrap();
    std::fs::write(&file, &whole[..whole.len() - 8]).unwrap();
    assert!(says(ID).contains("demonstrations.safetensors") && says(ID).contains("no safetensors file"));
    let steps = whole.windows(14).position(|part| part == b"\\\"steps\\\":200,").unwrap();
    let mut changed = whole.clone();
    changed[steps..steps + 14].copy_from_slice(b"\\\"steps\\\":100,");
    std::fs::write(&file, &changed).unwrap();
    assert!(says(ID).contains("the tensor \"observations\" is"), "{}", says(ID));
    assert!(Policy::open(&file).map(drop).unwrap_err().to_string().contains("its card is not understood"));
}

/// A clone of two short demonstrations strays from its teacher's way; corrected there, it finds back.
#[test]
fn corrections_teach_what_demonstrations_do_not_show() {
    let env = env(ID);
    let mut collector = Collector::new(&env, 4, 1).unwrap();
    let away = |mut learner: Learner, collector: &mut Collector, name: &str| {
        learner.teach(play(ID, &mut Bent, 2, 0.0, 3).unwrap());
        (0..12).for_each(|_| _ = learner.iterate(collector).unwrap());
        let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
        learner.save_policy(ID, None, &path).unwrap();
        let mut policy = Policy::open(&path).unwrap();
        (70..80).map(|seed| mean_error(&mut policy, seed)).sum::<f64>() / 10.0
    };
    let settings = |algorithm: Settings| Settings { episodes: 4, ..algorithm };
    let clone =
        away(Learner::new(settings(Settings::cloning()), 3, &env), &mut collector, "cloned.safetensors");
    let mut learner = Learner::new(settings(Settings::dagger()), 3, &env);
    learner.teach(play(ID, &mut Bent, 2, 0.0, 3).unwrap());
    let why = learner.iterate(&mut collector).unwrap_err().to_string();
    assert!(why.contains("it is to correct what the policy does, and was given no environments"), "{why}");
    collector.teach(|_| Ok(Box::new(Bent))).unwrap();
    let learner = Learner::new(settings(Settings::dagger()), 3, &env);
    let corrected = away(learner, &mut collector, "corrected.safetensors");
    assert!(corrected < 0.5 * clone && corrected < 0.05, "{corrected} and {clone}");
}

/// How far a policy's actions are from its teacher's in an episode, on average.
fn mean_error(policy: &mut Policy, seed: u64) -> f64 {
    let (mut env, mut sum, steps) = (env(ID), 0.0, 100);
    env.reset(Some(seed)).unwrap();
    let mut action = vec![0.0; env.action_len()];
    for _ in 0..steps {
        policy.action(&env, &mut action).unwrap();
        let away = (0..action.len()).map(|k| (action[k] - bent(env.observation(), k)).abs());
        sum += away.sum::<f64>() / (steps * action.len()) as f64;
        env.step(&action).unwrap();
    }
    sum
}

#[test]
fn a_clone_acts_as_its_teacher() {
    let env = env(ID);
    let shown = play(ID, &mut Bent, 6, 0.05, 3).unwrap();
    let mut learner = Learner::new(Settings { episodes: 4, ..Settings::cloning() }, 3, &env);
    let mut collector = Collector::new(&env, 4, 1).unwrap();
    let why = learner.iterate(&mut collector).unwrap_err().to_string();
    assert!(why.contains("it learns from demonstrations, and there are none"), "{why}");
    learner.teach(shown);
    let before = learner.iterate(&mut collector).unwrap();
    (0..3).for_each(|_| _ = learner.iterate(&mut collector).unwrap());
    let after = learner.iterate(&mut collector).unwrap();
    assert!(after.update.entropy < before.update.entropy - 0.2, "{before:?} {after:?}");
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join("clone.safetensors");
    learner.save_policy(ID, None, &path).unwrap();
    let (mut clone, mut env, mut away) = (Policy::open(&path).unwrap(), self::env(ID), 0.0_f64);
    env.reset(Some(77)).unwrap();
    let mut action = vec![0.0; env.action_len()];
    for _ in 0..100 {
        clone.action(&env, &mut action).unwrap();
        let wanted = (0..action.len()).map(|k| bent(env.observation(), k));
        away = action.iter().zip(wanted).fold(away, |away, (a, b)| away.max((a - b).abs()));
        env.step(&action).unwrap();
    }
    assert!(away < 0.12, "{away}");
}
