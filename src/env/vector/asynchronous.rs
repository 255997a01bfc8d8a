//! Sending actions to some environments of a batch, and receiving those that finish first, as EnvPool does it.

use super::VecEnv;
use super::real::Real;
use super::slot::Order;
use super::workers::{Job, Workers};
use crate::error::EnvError;

impl VecEnv {
    /// Lets the environments `ids` step with their rows of `actions` (ids x action length), on threads of their own, and
    /// returns at once. Each is out of reach until [`VecEnv::receive`] returns it. Results of one environment do not
    /// depend on threads, nor on the others.
    ///
    /// # Errors
    /// An index that does not exist, is named twice, or is under way; actions of another length, or not finite. Then
    /// nothing was sent.
    pub fn send<A: Real>(&mut self, ids: &[usize], actions: &[A]) -> Result<(), EnvError> {
        self.check_ids(ids)?;
        let width = self.action_len();
        self.check_actions(ids.len(), actions)?;
        for (row, &id) in ids.iter().enumerate() {
            self.slot_mut(id).set_action(&actions[row * width..(row + 1) * width]);
        }
        self.dispatch(ids, |_| Order::Step)
    }

    /// Lets the environments `ids` reset, each with its seed, and returns at once.
    ///
    /// # Errors
    /// As [`VecEnv::send`]; another number of seeds.
    pub fn send_resets(&mut self, ids: &[usize], seeds: &[Option<u64>]) -> Result<(), EnvError> {
        self.check_ids(ids)?;
        if seeds.len() != ids.len() {
            let message = format!("{} seeds for {} environments", seeds.len(), ids.len());
            return Err(EnvError::Selection { message });
        }
        self.dispatch(ids, |row| Order::Reset(seeds[row]))
    }

    /// Waits until as many environments as `ids` has places have finished what was sent, and writes their indices and their
    /// observations (`ids.len()` x observation length), the one that finished first at the front.
    ///
    /// # Errors
    /// Fewer are under way; the first environment that could not be reset. Then all others can still be received.
    pub fn receive<T: Real>(&mut self, ids: &mut [usize], observations: &mut [T]) -> Result<(), EnvError> {
        let count = ids.len();
        if count > self.under_way {
            let under_way = self.under_way;
            let message = format!("{count} environments were asked for, and {under_way} are under way");
            return Err(EnvError::Selection { message });
        }
        assert_eq!(observations.len(), count * self.width, "one row for each environment");
        self.collect(count)?;
        let wrong = (0..count).find(|&k| self.arrived[k].1.outcome.is_err());
        if let Some((index, slot)) = wrong.and_then(|k| self.arrived.remove(k)) {
            self.under_way -= 1;
            let slot = self.slots[index].insert(slot);
            return slot.take_error().map_err(|error| EnvError::InBatch { index, error: error.into() });
        }
        let mut rows = super::rows(observations, count, self.width).into_iter();
        for (place, (index, slot)) in ids.iter_mut().zip(self.arrived.drain(..count)) {
            *place = index;
            rows.next().into_iter().for_each(|row| slot.write(row));
            self.records[index] = slot.record();
            self.slots[index] = Some(slot);
        }
        self.under_way -= count;
        Ok(())
    }

    /// How many environments were sent and not received.
    pub fn under_way(&self) -> usize {
        self.under_way
    }

    /// Waits until `count` environments have arrived.
    fn collect(&mut self, count: usize) -> Result<(), EnvError> {
        let lacking = count.saturating_sub(self.arrived.len());
        if lacking == 0 {
            return Ok(());
        }
        match &self.workers {
            Some(workers) if !workers.are_foreign() => {
                self.arrived.extend(workers.receive(lacking));
                Ok(())
            }
            _ => Err(EnvError::Selection {
                message: "environments that were under way when a process forked are its parent's".into(),
            }),
        }
    }

    fn dispatch(&mut self, ids: &[usize], order: impl Fn(usize) -> Order) -> Result<(), EnvError> {
        if self.workers.as_ref().is_none_or(Workers::are_foreign) {
            let started = Workers::start(self.pool.threads());
            let started = started.map_err(|error| EnvError::Threads { message: error.to_string() })?;
            self.workers = Some(started);
        }
        let slots = &mut self.slots;
        let job = |(row, &index): (usize, &usize)| {
            let slot = slots[index].take().expect("ids were checked");
            Job { index, slot, order: order(row) }
        };
        let jobs: Vec<_> = ids.iter().enumerate().map(job).collect();
        self.under_way += jobs.len();
        self.workers.as_ref().expect("they were started").send(jobs);
        Ok(())
    }

    fn check_ids(&self, ids: &[usize]) -> Result<(), EnvError> {
        let count = self.len();
        let mut named = vec![false; count];
        for &id in ids {
            let message = if id >= count {
                format!("there is no environment {id}: there are {count}, from 0 on")
            } else if named[id] {
                format!("environment {id} is named twice")
            } else if self.slots[id].is_none() {
                format!("environment {id} is still under way: receive it first")
            } else {
                named[id] = true;
                continue;
            };
            return Err(EnvError::Selection { message });
        }
        Ok(())
    }
}
