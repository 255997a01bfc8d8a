//! What was experienced, from which an algorithm learns again and again.

use super::rollout::Episode;
use crate::archive::{Archive, Entry, Numbers};
use crate::error::PolicyError;
use crate::nets::Running;
use env::Rng;

/// In the place of a share: no step begins at this observation, as it is the last of an episode.
const END: f32 = -1.0;

/// The latest steps, with the observations that they begin and end with: rows of a ring, an episode's one after the other.
#[derive(Clone, Debug, PartialEq)]
pub struct Replay {
    observed: usize,
    actions: usize,
    /// Most rows.
    capacity: usize,
    observations: Vec<f32>,
    taken: Vec<f32>,
    rewards: Vec<f32>,
    /// The share of what comes after the step: 1, or 0 where the task ended; [`END`] where there is no step.
    shares: Vec<f32>,
    /// The row that is written next once all are used.
    next: u64,
}

/// Steps drawn from a replay.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Transitions {
    /// Observations before the steps.
    pub before: Vec<f64>,
    /// Actions taken then.
    pub actions: Vec<f32>,
    /// Discounted sums of the rewards of as many steps as count.
    pub rewards: Vec<f64>,
    /// What the value of the observation after these steps counts: a power of the discount, or 0 where the task ended.
    pub shares: Vec<f64>,
    /// Observations after these steps.
    pub after: Vec<f64>,
}

impl Replay {
    /// An empty one, of at most `capacity` rows.
    pub fn new([observed, actions]: [usize; 2], capacity: usize) -> Self {
        let [observations, taken, rewards, shares] = [const { Vec::new() }; 4];
        Replay { observed, actions, capacity, observations, taken, rewards, shares, next: 0 }
    }

    /// Most bytes of all rows.
    pub fn most_bytes(&self) -> u64 {
        ((self.observed + self.actions + 2) * size_of::<f32>()) as u64 * self.capacity as u64
    }

    /// Number of rows.
    pub fn rows(&self) -> usize {
        self.shares.len()
    }

    /// Adds an episode in the place of the oldest rows.
    pub fn add(&mut self, episode: &Episode) {
        let (steps, nothing) = (episode.rewards.len(), vec![0.0; self.actions]);
        for step in 0..=steps {
            let observation = &episode.observations[step * self.observed..][..self.observed];
            let (action, reward, share) = if step == steps {
                (&nothing[..], 0.0, END)
            } else {
                let ends = step + 1 == steps && episode.terminated;
                let action = &episode.actions[step * self.actions..][..self.actions];
                (action, episode.rewards[step], f32::from(u8::from(!ends)))
            };
            self.push(observation, action, reward as f32, share);
        }
    }

    fn push(&mut self, observation: &[f64], action: &[f32], reward: f32, share: f32) {
        let observation = observation.iter().map(|value| *value as f32);
        if self.rows() < self.capacity {
            self.observations.extend(observation);
            self.taken.extend_from_slice(action);
            self.rewards.push(reward);
            self.shares.push(share);
            return;
        }
        let row = self.next as usize;
        self.observations[row * self.observed..]
            .iter_mut()
            .zip(observation)
            .for_each(|(to, from)| *to = from);
        self.taken[row * self.actions..][..self.actions].copy_from_slice(action);
        (self.rewards[row], self.shares[row]) = (reward, share);
        self.next = (self.next + 1) % self.capacity as u64;
    }

    /// Draws `count` steps, each as likely as any other, with the rewards of `steps` steps from there or of those that are left of
    /// the episode.
    ///
    /// # Panics
    /// There is no step.
    pub fn draw(&self, count: usize, (steps, gamma): (usize, f64), rng: &mut Rng) -> Transitions {
        let mut drawn = Transitions::default();
        while drawn.rewards.len() < count {
            let first = (rng.random() * self.rows() as f64) as usize;
            if self.is_end(first) {
                continue;
            }
            let (mut row, mut reward, mut share) = (first, 0.0, 1.0);
            for _ in 0..steps {
                reward += share * f64::from(self.rewards[row]);
                share *= gamma * f64::from(self.shares[row]);
                // The newest row is the end of an episode: no step leads beyond it to the oldest.
                row = (row + 1) % self.rows();
                if self.is_end(row) {
                    break;
                }
            }
            drawn.before.extend(self.observation(first));
            drawn.actions.extend_from_slice(&self.taken[first * self.actions..][..self.actions]);
            drawn.rewards.push(reward);
            drawn.shares.push(share);
            drawn.after.extend(self.observation(row));
        }
        drawn
    }

    /// Whether no step begins at a row.
    fn is_end(&self, row: usize) -> bool {
        self.shares[row] < 0.0
    }

    fn observation(&self, row: usize) -> impl Iterator<Item = f64> {
        self.observations[row * self.observed..][..self.observed].iter().map(|value| f64::from(*value))
    }

    /// All of it, by names.
    pub(crate) fn entries(&mut self) -> Vec<Entry<'_>> {
        let rows = self.rows().max(1);
        let entries = [
            Entry::matrix("observations", rows, Numbers::F32(&mut self.observations)),
            Entry::matrix("actions", rows, Numbers::F32(&mut self.taken)),
            Entry::new("rewards", Numbers::F32(&mut self.rewards)),
            Entry::new("shares", Numbers::F32(&mut self.shares)),
            Entry::new("next", Numbers::U64(std::slice::from_mut(&mut self.next))),
        ];
        entries.into_iter().map(|entry| entry.of("replay")).collect()
    }

    /// Makes room for the rows that a file holds.
    pub(crate) fn make_room(&mut self, archive: &Archive<'_>) -> Result<(), PolicyError> {
        let rows = archive.numbers("replay.shares")?;
        if rows > self.capacity {
            let message = format!("its replay has {rows} rows, and {} were to be kept", self.capacity);
            return Err(PolicyError::content(message));
        }
        self.observations.resize(rows * self.observed, 0.0);
        self.taken.resize(rows * self.actions, 0.0);
        self.rewards.resize(rows, 0.0);
        self.shares.resize(rows, END);
        Ok(())
    }

    /// Refuses what no replay can be after it was read.
    pub(crate) fn check(&self) -> Result<(), PolicyError> {
        let (next, rows) = (self.next as usize, self.rows());
        let newest = (next + rows.max(1) - 1) % rows.max(1);
        let has_steps = self.shares.iter().any(|share| *share >= 0.0);
        let is_sound = next < rows.max(1) && (rows == 0 || has_steps && self.is_end(newest));
        let is_sound = is_sound && self.shares.iter().all(|share| [END, 0.0, 1.0].contains(share));
        if is_sound { Ok(()) } else { Err(PolicyError::content("its replay holds no whole episodes")) }
    }
}

/// Takes the discounted returns of an episode's steps in, by whose deviation rewards are scaled.
pub fn observe_returns(returns: &mut Running, episode: &Episode, gamma: f64) {
    let mut sum = 0.0;
    for reward in episode.rewards.iter().rev() {
        sum = reward + gamma * sum;
        returns.observe(&[sum]);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use env::episode::Summary;

    /// Observations that count steps from `first` on, and rewards of the same numbers.
    fn episode(first: usize, steps: usize, terminated: bool) -> Episode {
        let numbers = |count: usize| (first..first + count).map(|k| k as f64);
        Episode {
            observations: numbers(steps + 1).collect(),
            actions: numbers(steps).map(|k| -k as f32).collect(),
            shown: Vec::new(),
            rewards: numbers(steps).collect(),
            terminated,
            summary: Summary::default(),
        }
    }

    #[test]
    fn rewards_of_several_steps_add_up_to_the_end_of_an_episode() {
        let mut replay = Replay::new([1, 1], 100);
        replay.add(&episode(10, 4, true));
        replay.add(&episode(20, 2, false));
        let drawn = replay.draw(200, (3, 0.5), &mut Rng::pcg64(1_u64));
        let mut found = std::collections::BTreeMap::new();
        for k in 0..200 {
            let row = [drawn.rewards[k], drawn.shares[k], drawn.after[k], f64::from(drawn.actions[k])];
            found.insert(drawn.before[k] as u64, row);
        }
        let expected = [
            (10, [10.0 + 5.5 + 3.0, 0.125, 13.0, -10.0]),
            (11, [11.0 + 6.0 + 3.25, 0.0, 14.0, -11.0]),
            (12, [12.0 + 6.5, 0.0, 14.0, -12.0]),
            (13, [13.0, 0.0, 14.0, -13.0]),
            (20, [20.0 + 10.5, 0.25, 22.0, -20.0]),
            (21, [21.0, 0.5, 22.0, -21.0]),
        ];
        assert_eq!(found.into_iter().collect::<Vec<_>>(), expected);
    }

    #[test]
    fn a_full_replay_forgets_the_oldest_steps() {
        let mut replay = Replay::new([1, 1], 10);
        (0..7).for_each(|k| replay.add(&episode(10 * k, 3, false)));
        assert_eq!(replay.rows(), 10);
        replay.check().unwrap();
        let drawn = replay.draw(300, (2, 1.0), &mut Rng::pcg64(2_u64));
        for k in 0..300 {
            let steps = drawn.after[k] - drawn.before[k];
            let sum: f64 = (0..steps as u64).map(|step| drawn.before[k] + step as f64).sum();
            assert_eq!((drawn.rewards[k], drawn.shares[k]), (sum, 1.0));
        }
        let mut starts: Vec<u64> = drawn.before.iter().map(|value| *value as u64).collect();
        starts.sort_unstable();
        starts.dedup();
        assert_eq!(starts, [42, 50, 51, 52, 60, 61, 62], "a step and the end of the fifth episode are left");
    }
}
