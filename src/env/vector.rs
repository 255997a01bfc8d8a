//! Many environments of one id, stepped together.

use crate::environment::{Env, Step};
use crate::error::EnvError;
use crate::exteroception::Exteroception;

/// What happens after an episode has ended (Gymnasium's `AutoresetMode`).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Autoreset {
    /// The next step ignores its action and resets.
    #[default]
    NextStep,
    /// The step that ends an episode resets; the last observation is kept aside.
    SameStep,
    /// Nothing: the caller resets.
    Disabled,
}

/// Environments stepped together, each with its own model edits, state and draws. Results do not depend on the number of
/// threads, to the last bit.
pub struct VecEnv {
    envs: Vec<Slot>,
    autoreset: Autoreset,
    width: usize,
    observations: Vec<f64>,
    #[cfg(feature = "threads")]
    pool: rayon::ThreadPool,
}

struct Slot {
    env: Env,
    /// The last step ended the episode.
    ended: bool,
    /// What the last call yielded.
    outcome: Result<Step, EnvError>,
    /// The observation that ended the episode, where the same step reset.
    last: Option<Vec<f64>>,
}

impl VecEnv {
    /// `count` copies of an environment on a pool of threads; 0 threads are as many as there are cores.
    ///
    /// # Errors
    /// The threads cannot be started; the robot is hardware.
    pub fn new(env: &Env, count: usize, autoreset: Autoreset, threads: usize) -> Result<Self, String> {
        #[cfg(not(feature = "threads"))]
        let _ = threads;
        let slot = |_| {
            let outcome = Ok(Step { reward: 0.0, terminated: false, truncated: false, fault: None });
            env.fork()
                .map(|env| Slot { env, ended: false, outcome, last: None })
                .map_err(|error| error.to_string())
        };
        Ok(VecEnv {
            envs: (0..count).map(slot).collect::<Result<_, _>>()?,
            autoreset,
            width: env.observation().len(),
            observations: vec![0.0; count * env.observation().len()],
            #[cfg(feature = "threads")]
            pool: rayon::ThreadPoolBuilder::new()
                .num_threads(threads)
                .build()
                .map_err(|error| error.to_string())?,
        })
    }

    /// Resets every environment; that of index k is seeded with `seed + k`.
    ///
    /// # Errors
    /// The first environment that cannot be reset.
    pub fn reset(&mut self, seed: Option<u64>) -> Result<&[f64], EnvError> {
        self.run(|index, slot, observation| {
            let seed = seed.map(|seed| seed.wrapping_add(index as u64));
            slot.reset(seed, observation);
        });
        self.first_error()
    }

    /// Resets the environments that are chosen, without seeding them.
    ///
    /// # Errors
    /// The first environment that cannot be reset.
    ///
    /// # Panics
    /// `chosen` has another length than there are environments.
    pub fn reset_only(&mut self, chosen: &[bool]) -> Result<&[f64], EnvError> {
        assert_eq!(chosen.len(), self.envs.len(), "one flag for each environment");
        self.run(|index, slot, observation| {
            if chosen[index] {
                slot.reset(None, observation);
            }
        });
        self.first_error()
    }

    /// Steps every environment with its row of `actions` (count x action length), and returns the observations (count x
    /// observation length). What the steps yielded follows with [`VecEnv::steps`].
    ///
    /// # Errors
    /// The first environment that cannot take its action; the others have stepped.
    pub fn step(&mut self, actions: &[f64]) -> Result<&[f64], EnvError> {
        let width = self.envs.first().map_or(0, |slot| slot.env.action_len());
        if actions.len() != width * self.envs.len() {
            return Err(EnvError::ActionLength { expected: width * self.envs.len(), found: actions.len() });
        }
        let autoreset = self.autoreset;
        self.run(|index, slot, observation| {
            slot.step(&actions[index * width..(index + 1) * width], autoreset, observation);
        });
        self.first_error()
    }

    fn run(&mut self, each: impl Fn(usize, &mut Slot, &mut [f64]) + Sync) {
        let rows = self.observations.chunks_exact_mut(self.width.max(1));
        #[cfg(feature = "threads")]
        {
            use rayon::prelude::*;
            let mut work: Vec<_> = self.envs.iter_mut().zip(rows).enumerate().collect();
            self.pool.install(|| {
                work.par_iter_mut().with_max_len(1).for_each(|(index, (slot, row))| each(*index, slot, row));
            });
        }
        #[cfg(not(feature = "threads"))]
        self.envs.iter_mut().zip(rows).enumerate().for_each(|(index, (slot, row))| each(index, slot, row));
    }

    fn first_error(&mut self) -> Result<&[f64], EnvError> {
        for slot in &mut self.envs {
            if slot.outcome.is_err() {
                let quiet = Ok(Step { reward: 0.0, terminated: false, truncated: true, fault: None });
                std::mem::replace(&mut slot.outcome, quiet)?;
            }
        }
        Ok(&self.observations)
    }

    /// Draws the images of every environment, on the pool, each as [`Env::exteroception`] draws them, and returns them.
    ///
    /// # Errors
    /// The first environment whose images cannot be drawn.
    pub fn exteroception(&mut self) -> Result<impl ExactSizeIterator<Item = &Exteroception>, EnvError> {
        let draw = |slot: &mut Slot| slot.env.exteroception().map(|_| ());
        #[cfg(feature = "threads")]
        {
            use rayon::prelude::*;
            let envs = &mut self.envs;
            self.pool.install(|| envs.par_iter_mut().with_max_len(1).try_for_each(draw))?;
        }
        #[cfg(not(feature = "threads"))]
        self.envs.iter_mut().try_for_each(draw)?;
        Ok(self.envs.iter().map(|slot| slot.env.visuals().expect("they were drawn")))
    }

    /// What the last call yielded, environment by environment.
    pub fn steps(&self) -> impl ExactSizeIterator<Item = &Step> {
        self.envs.iter().map(|slot| slot.outcome.as_ref().expect("errors are taken out before"))
    }

    /// The observation that ended an episode in the last call, where [`Autoreset::SameStep`] has replaced it.
    pub fn final_observation(&self, index: usize) -> Option<&[f64]> {
        self.envs[index].last.as_deref()
    }

    /// The observations of the last call (count x observation length).
    pub fn observations(&self) -> &[f64] {
        &self.observations
    }

    /// The environments.
    pub fn envs(&self) -> impl ExactSizeIterator<Item = &Env> {
        self.envs.iter().map(|slot| &slot.env)
    }

    /// How many there are.
    pub fn len(&self) -> usize {
        self.envs.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.envs.is_empty()
    }
}

impl Slot {
    fn reset(&mut self, seed: Option<u64>, observation: &mut [f64]) {
        self.ended = false;
        self.last = None;
        self.outcome = self.env.reset(seed).map(|first| {
            observation.copy_from_slice(first);
            Step { reward: 0.0, terminated: false, truncated: false, fault: None }
        });
    }

    fn step(&mut self, action: &[f64], autoreset: Autoreset, observation: &mut [f64]) {
        if self.ended && autoreset == Autoreset::NextStep {
            return self.reset(None, observation);
        }
        self.last = None;
        self.outcome = self.env.step(action);
        observation.copy_from_slice(self.env.observation());
        let Ok(step) = &self.outcome else { return };
        self.ended = step.terminated || step.truncated;
        if self.ended && autoreset == Autoreset::SameStep {
            let (step, last) = (step.clone(), self.env.observation().to_vec());
            self.reset(None, observation);
            self.last = Some(last);
            if self.outcome.is_ok() {
                self.outcome = Ok(step);
            }
        }
    }
}
