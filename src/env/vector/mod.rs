//! Many environments of one id, stepped together.

#[cfg(feature = "threads")]
mod asynchronous;
mod images;
mod pool;
mod real;
mod slot;
#[cfg(feature = "threads")]
mod workers;

pub use real::Real;
pub use slot::{Autoreset, Final, StepRecord};

use crate::environment::{Env, Step};
use crate::error::EnvError;
use pool::Pool;
use slot::{Order, Slot};

/// Environments stepped together, each with its own model edits, state and draws. Results do not depend on the number of
/// threads, to the last bit.
///
/// All step at once ([`VecEnv::step`]), or some are sent actions and those that finish first are received (`VecEnv::send`
/// and `VecEnv::receive`, feature `threads`).
pub struct VecEnv {
    /// `None` where an environment is under way on a thread.
    slots: Vec<Option<Box<Slot>>>,
    records: Vec<StepRecord>,
    width: usize,
    action_width: usize,
    observations: Vec<f64>,
    pool: Pool,
    /// Environments that were sent and not received.
    under_way: usize,
    /// Those of them that have finished.
    #[cfg(feature = "threads")]
    arrived: std::collections::VecDeque<(usize, Box<Slot>)>,
    #[cfg(feature = "threads")]
    workers: Option<workers::Workers>,
}

impl VecEnv {
    /// `count` copies of an environment on a number of threads, which start when they are needed; 0 threads are as many as
    /// there are cores.
    ///
    /// # Errors
    /// The robot is hardware.
    pub fn new(env: &Env, count: usize, autoreset: Autoreset, threads: usize) -> Result<Self, EnvError> {
        // More than there can be where the product overflows: the reservation is then refused.
        let numbers = count.saturating_mul(env.observation().len());
        let too_many = |_| EnvError::Selection { message: format!("{count} environments fit in no memory") };
        let (mut slots, mut records, mut observations) = (Vec::new(), Vec::new(), Vec::new());
        slots.try_reserve_exact(count).map_err(too_many)?;
        records.try_reserve_exact(count).map_err(too_many)?;
        observations.try_reserve_exact(numbers).map_err(too_many)?;
        records.resize(count, StepRecord::default());
        observations.resize(numbers, 0.0);
        for _ in 0..count {
            slots.push(Some(Box::new(Slot::new(env.fork()?, autoreset))));
        }
        Ok(VecEnv {
            slots,
            records,
            width: env.observation().len(),
            action_width: env.action_len(),
            observations,
            pool: Pool::new(threads),
            under_way: 0,
            #[cfg(feature = "threads")]
            arrived: std::collections::VecDeque::new(),
            #[cfg(feature = "threads")]
            workers: None,
        })
    }

    /// Bytes that one more copy of an environment takes, about: what it owns, and what contacts add as it moves.
    pub fn bytes_of(env: &Env) -> usize {
        let mut bytes = size_of::<Slot>();
        for data in [&env.scene.data, &env.observed] {
            bytes += size_of_val(data);
            data.visit(&env.scene.model, &mut |_, _, values| {
                values.pieces(&mut |piece| bytes += piece.len());
            });
        }
        let pixels: usize = env.visual_keys().iter().map(|key| key.shape().iter().product::<usize>()).sum();
        // As much again stands for working memory, rows and the task, which have no count of their own.
        2 * bytes + size_of::<f32>() * pixels
    }

    /// Another batch in the same state, which goes on by itself on threads of its own.
    ///
    /// # Errors
    /// The robot is hardware; environments are under way.
    pub fn fork(&self, threads: usize) -> Result<Self, EnvError> {
        self.check_at_home()?;
        let slots = self.slots.iter().flatten();
        let forks: Result<_, EnvError> = slots.map(|slot| Ok(Some(Box::new(slot.fork()?)))).collect();
        Ok(VecEnv {
            slots: forks?,
            records: self.records.clone(),
            width: self.width,
            action_width: self.action_width,
            observations: self.observations.clone(),
            pool: Pool::new(threads),
            under_way: 0,
            #[cfg(feature = "threads")]
            arrived: std::collections::VecDeque::new(),
            #[cfg(feature = "threads")]
            workers: None,
        })
    }

    /// Resets every environment; environment k is seeded with `seed + k`.
    ///
    /// # Errors
    /// The first environment that cannot be reset.
    pub fn reset(&mut self, seed: Option<u64>) -> Result<&[f64], EnvError> {
        let count = self.len();
        let seeds: Vec<_> =
            (0..count).map(|index| seed.map(|seed| seed.wrapping_add(index as u64))).collect();
        self.with_observations(|envs, rows| envs.reset_into(&seeds, &vec![true; count], rows))
    }

    /// Resets the environments that are chosen, without seeding them.
    ///
    /// # Errors
    /// The first environment that cannot be reset.
    ///
    /// # Panics
    /// `chosen` has another length than there are environments.
    pub fn reset_only(&mut self, chosen: &[bool]) -> Result<&[f64], EnvError> {
        let seeds = vec![None; self.len()];
        self.with_observations(|envs, rows| envs.reset_into(&seeds, chosen, rows))
    }

    /// Resets the environments that are chosen, each with its own seed, and writes the observations of all (count x
    /// observation length).
    ///
    /// # Errors
    /// The first environment that cannot be reset; some are under way.
    ///
    /// # Panics
    /// `seeds`, `chosen` or `observations` have other lengths than there are environments.
    pub fn reset_into<T: Real>(
        &mut self,
        seeds: &[Option<u64>],
        chosen: &[bool],
        observations: &mut [T],
    ) -> Result<(), EnvError> {
        assert_eq!([seeds.len(), chosen.len()], [self.len(); 2], "one seed and flag for each environment");
        self.run(observations, |index, slot| {
            if chosen[index] {
                slot.run(Order::Reset(seeds[index]));
            }
        })
    }

    /// Steps every environment with its row of `actions` (count x action length), and returns the observations (count x
    /// observation length). What the steps yielded follows with [`VecEnv::steps`].
    ///
    /// # Errors
    /// As [`VecEnv::step_into`].
    pub fn step(&mut self, actions: &[f64]) -> Result<&[f64], EnvError> {
        self.with_observations(|envs, rows| envs.step_into(actions, rows))
    }

    /// Steps every environment, and writes the observations where the caller keeps them.
    ///
    /// # Errors
    /// Actions of another length or that are not finite, or environments that are under way: then none has stepped. The
    /// first environment that fails; the others have stepped.
    ///
    /// # Panics
    /// `observations` has another length.
    pub fn step_into<A: Real, T: Real>(
        &mut self,
        actions: &[A],
        observations: &mut [T],
    ) -> Result<(), EnvError> {
        self.check_actions(self.len(), actions)?;
        let width = self.action_width;
        self.run(observations, |index, slot| {
            slot.set_action(&actions[index * width..(index + 1) * width]);
            slot.run(Order::Step);
        })
    }

    /// What the last call yielded, environment by environment.
    ///
    /// # Panics
    /// Environments are under way.
    pub fn steps(&self) -> impl ExactSizeIterator<Item = &Step> {
        (0..self.len()).map(|index| self.last_step(index))
    }

    /// What the last call yielded of one environment.
    ///
    /// # Panics
    /// It is under way.
    pub fn last_step(&self, index: usize) -> &Step {
        at_home(&self.slots[index]).outcome.as_ref().expect("errors are taken out before")
    }

    /// What the last call yielded of every environment, in few bytes each. Of an environment that is under way, what it yielded
    /// before.
    pub fn records(&self) -> &[StepRecord] {
        &self.records
    }

    /// The observation that ended an episode in the last call, where [`Autoreset::SameStep`] has replaced it.
    pub fn final_observation(&self, index: usize) -> Option<&[f64]> {
        self.last(index).map(|last| last.observation.as_slice())
    }

    /// What an episode ended with in the last call, where [`Autoreset::SameStep`] has replaced it.
    ///
    /// # Panics
    /// The environment is under way.
    pub fn last(&self, index: usize) -> Option<&Final> {
        at_home(&self.slots[index]).last()
    }

    /// The observations of the last [`VecEnv::step`] or [`VecEnv::reset`] (count x observation length).
    pub fn observations(&self) -> &[f64] {
        &self.observations
    }

    /// The environments.
    ///
    /// # Panics
    /// Some are under way.
    pub fn envs(&self) -> impl ExactSizeIterator<Item = &Env> {
        self.slots.iter().map(|slot| &at_home(slot).env)
    }

    /// One environment; `None` while it is under way.
    pub fn env(&self, index: usize) -> Option<&Env> {
        self.slots[index].as_ref().map(|slot| &slot.env)
    }

    /// One environment, to be changed; `None` while it is under way.
    pub fn env_mut(&mut self, index: usize) -> Option<&mut Env> {
        self.slots[index].as_mut().map(|slot| &mut slot.env)
    }

    /// How many there are.
    pub fn len(&self) -> usize {
        self.slots.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.slots.is_empty()
    }

    /// The number of values in an observation of one environment.
    pub fn observation_len(&self) -> usize {
        self.width
    }

    /// The number of values in an action of one environment.
    pub fn action_len(&self) -> usize {
        self.action_width
    }

    /// Fails while environments are under way.
    ///
    /// # Errors
    /// How many are.
    pub fn check_at_home(&self) -> Result<(), EnvError> {
        match self.under_way {
            0 => Ok(()),
            count => Err(EnvError::Selection {
                message: format!("{count} environments are still under way: receive them first"),
            }),
        }
    }

    /// Runs `each` on every environment, writes the observations, and fails with the first error.
    fn run<T: Real>(
        &mut self,
        observations: &mut [T],
        each: impl Fn(usize, &mut Slot) + Sync,
    ) -> Result<(), EnvError> {
        self.check_at_home()?;
        let count = self.len();
        assert_eq!(observations.len(), count * self.width, "one row for each environment");
        let rows = rows(observations, count, self.width);
        let slots = self.slots.iter_mut().flatten().map(AsMut::as_mut);
        let places = slots.zip(&mut self.records).zip(rows).enumerate();
        let work = |(index, ((slot, record), row))| Work { index, slot, record, row };
        let work: Vec<Work<'_, T>> = places.map(work).collect();
        let each = |Work { index, slot, record, row }: Work<'_, T>| {
            each(index, slot);
            slot.write(row);
            *record = slot.record();
        };
        self.pool.each(work, each)?;
        let failed: Vec<_> = (0..count).filter(|&index| self.records[index].failed).collect();
        let mut outcomes = failed.into_iter().map(|index| {
            let outcome = self.slots[index].as_mut().map_or(Ok(()), |slot| slot.take_error());
            outcome.map_err(|error| EnvError::InBatch { index, error: error.into() })
        });
        let first = outcomes.next().unwrap_or(Ok(()));
        outcomes.for_each(drop);
        first
    }

    /// Runs something that writes observations where this batch keeps its own.
    fn with_observations(
        &mut self,
        run: impl FnOnce(&mut Self, &mut [f64]) -> Result<(), EnvError>,
    ) -> Result<&[f64], EnvError> {
        let mut observations = std::mem::take(&mut self.observations);
        let outcome = run(self, &mut observations);
        self.observations = observations;
        outcome.map(|()| self.observations.as_slice())
    }

    fn check_actions<A: Real>(&self, count: usize, actions: &[A]) -> Result<(), EnvError> {
        let expected = count * self.action_width;
        if actions.len() != expected {
            return Err(EnvError::ActionLength { expected, found: actions.len() });
        }
        match actions.iter().position(|value| !value.to_f64().is_finite()) {
            None => Ok(()),
            Some(place) => {
                let value = actions[place].to_f64();
                let error = EnvError::ActionValue { index: place % self.action_width, value };
                Err(EnvError::InBatch { index: place / self.action_width, error: error.into() })
            }
        }
    }

    #[cfg(feature = "threads")]
    fn slot_mut(&mut self, index: usize) -> &mut Slot {
        self.slots[index].as_mut().expect("ids were checked")
    }
}

/// One environment of a batch, and where what it yields is written.
struct Work<'a, T> {
    index: usize,
    slot: &'a mut Slot,
    record: &'a mut StepRecord,
    row: &'a mut [T],
}

fn at_home(slot: &Option<Box<Slot>>) -> &Slot {
    slot.as_ref().expect("environments that are under way are received first")
}

/// Rows of a flat batch, also of rows without values.
fn rows<T>(batch: &mut [T], count: usize, width: usize) -> Vec<&mut [T]> {
    if width > 0 {
        return batch.chunks_exact_mut(width).collect();
    }
    (0..count).map(|_| Default::default()).collect()
}
