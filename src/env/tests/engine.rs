//! Environments under another engine, and what its memory has to do with their saved states.

use physics::data::ForeignSnapshot;
use physics::{Data, Engine, Memory, Model, StepError, Stepper};
use robohive_env::{Env, Options, OwnModels};
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Our own pipeline as another engine, whose memory is the number of steps that it made since its reset.
#[derive(Clone, Debug, Default)]
struct Counted {
    steps: usize,
    /// The same number, for the test to see.
    shown: Arc<AtomicUsize>,
}

impl Counted {
    fn show(&mut self, steps: usize) {
        self.steps = steps;
        self.shown.store(steps, Ordering::Relaxed);
    }
}

impl Stepper for Counted {
    fn reset(&mut self) {
        self.show(0);
    }

    fn step(&mut self, m: &Model, d: &mut Data) -> Result<(), StepError> {
        self.show(self.steps + 1);
        physics::step(m, d)
    }

    fn save(&self) -> Memory {
        Memory::of(self.steps)
    }

    fn restore(&mut self, memory: &Memory) -> Result<(), ForeignSnapshot> {
        self.show(*memory.get().ok_or(ForeignSnapshot)?);
        Ok(())
    }

    fn duplicate(&self) -> Box<dyn Stepper> {
        Box::new(self.clone())
    }
}

fn make(engine: Engine) -> Env {
    Env::make("hive/FrankaReach-v0", &OwnModels, &Options::default().with_engine(engine)).unwrap()
}

/// Observations of some steps.
fn roll(env: &mut Env, steps: usize) -> Vec<f64> {
    let mut seen = Vec::new();
    for step in 0..steps {
        let action: Vec<f64> =
            (0..env.action_len()).map(|k| (0.7 * step as f64 + 1.3 * k as f64).sin()).collect();
        env.step(&action).unwrap();
        seen.extend_from_slice(env.observation());
    }
    seen
}

#[test]
fn another_engine_is_stepped_reset_saved_and_restored() {
    let shown = Arc::new(AtomicUsize::new(0));
    let counter = Counted { steps: 0, shown: shown.clone() };
    let steps = || shown.load(Ordering::Relaxed);
    let mut own = make(Engine::default());
    let mut other = make(Engine::new("counted", move |_| Ok(Box::new(counter.clone()))));
    own.reset(Some(3)).unwrap();
    other.reset(Some(3)).unwrap();
    assert_eq!(steps(), 0);
    assert_eq!(roll(&mut own, 10), roll(&mut other, 10), "whole steps are the two halves of ours");
    let made = steps();
    assert!(made > 0 && made.is_multiple_of(10), "{made}");

    let saved = other.state();
    let then = roll(&mut other, 5);
    assert_eq!(steps(), made + made / 2);
    other.set_state(&saved).unwrap();
    assert_eq!(steps(), made);
    assert_eq!(roll(&mut other, 5), then);

    let mut fresh = make(Engine::default());
    fresh.reset(Some(4)).unwrap();
    let (before, qpos) = (steps(), other.scene().data.state.qpos.clone());
    let refusal = other.set_state(&fresh.state()).unwrap_err().to_string();
    assert!(refusal.contains("another model or engine"), "{refusal}");
    assert_eq!((steps(), &other.scene().data.state.qpos), (before, &qpos), "what is refused changes nothing");
    assert!(fresh.set_state(&other.state()).is_err());

    other.reset(Some(5)).unwrap();
    assert_eq!(steps(), 0);
}
