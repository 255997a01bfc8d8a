//! What a teacher did: steps to learn from before and beside one's own.

use super::actor::Actor;
use super::batch::Batch;
use super::rollout::Episode;
use super::teacher::{Lessons, Teacher};
use crate::archive::{self, Archive, Entry, Numbers};
use crate::error::PolicyError;
use env::episode::Summary;
use env::{Env, Rng, Success};
use random::SeedSequence;
use serde::{Deserialize, Serialize};
use std::path::Path;

/// What the file calls itself.
const FORMAT: &str = "robohive-demonstrations-1";
/// What the numbers that are drawn for an episode are for. Keys of four numbers are those of demonstrations alone.
const RESET: u64 = 0;
const NOISE: u64 = 1;
/// Episodes that a teacher may play for each that succeeds.
const ATTEMPTS: u64 = 10;

/// Steps of episodes in which a teacher succeeded, and then of a policy's own that it corrected.
#[derive(Clone, Debug, PartialEq)]
pub struct Demonstrations {
    /// Id of the environment.
    id: String,
    /// Lengths of an observation and of an action.
    sizes: [usize; 2],
    /// What was observed before each step, `[steps × observed]`.
    observations: Vec<f64>,
    /// What the teacher would have done, `[steps × actions]`.
    actions: Vec<f32>,
    /// Steps of each episode.
    lengths: Vec<u64>,
    /// Episodes that the teacher played.
    pub played: u64,
    /// Episodes of a policy that it corrected, the last ones.
    corrected: u64,
}

/// What a file says of the numbers in it.
#[derive(Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
struct Label {
    format: String,
    id: String,
    sizes: [usize; 2],
    steps: usize,
    episodes: usize,
    played: u64,
    #[serde(default)]
    corrected: u64,
}

impl Demonstrations {
    /// Has a teacher play until it has succeeded as often as is asked for, and tells of each episode. The seed decides how episodes
    /// begin.
    ///
    /// # Errors
    /// The teacher succeeds in less than one of ten episodes, or cannot act; more than 64 MiB are asked for; the environment fails.
    pub fn play(
        env: &mut Env,
        teacher: &mut dyn Teacher,
        lessons: Lessons,
        seed: u64,
        mut tell: impl FnMut(&Self),
    ) -> Result<Self, PolicyError> {
        let id = env.spec().id.clone();
        let refuse = |message: String| Err(PolicyError::Teacher { id: id.clone(), message });
        if !(lessons.noise >= 0.0 && lessons.noise.is_finite()) {
            return refuse(format!("the noise of its actions must not be below 0, and is {}", lessons.noise));
        }
        if lessons.episodes == 0 {
            return refuse("at least one demonstration is needed".into());
        }
        let mut kept = Self::none(env);
        while (kept.lengths.len() as u64) < lessons.episodes {
            if kept.played >= ATTEMPTS * lessons.episodes {
                let (found, played, asked) = (kept.lengths.len(), kept.played, lessons.episodes);
                return refuse(format!(
                    "it succeeded in {found} of {played} episodes, and {asked} are asked for"
                ));
            }
            kept.episode(env, teacher, lessons.noise, seed)?;
            if kept.bytes() > archive::MAX_BYTES {
                let (found, most) = (kept.lengths.len(), archive::MAX_BYTES >> 20);
                return refuse(format!("{found} demonstrations have more than {most} MiB: ask for fewer"));
            }
            tell(&kept);
        }
        Ok(kept)
    }

    /// No steps in environments like `env`.
    fn none(env: &Env) -> Self {
        Demonstrations {
            id: env.spec().id.clone(),
            sizes: [env.observation().len(), env.action_len()],
            observations: Vec::new(),
            actions: Vec::new(),
            lengths: Vec::new(),
            played: 0,
            corrected: 0,
        }
    }

    /// Adds what a teacher would have done in episodes of a policy.
    ///
    /// # Errors
    /// It has not been asked; the steps are more than a file can hold.
    pub(super) fn correct(&mut self, episodes: &[Episode]) -> Result<(), PolicyError> {
        let refuse = |message: String| Err(PolicyError::Teacher { id: self.id.clone(), message });
        for episode in episodes {
            if episode.shown.len() != episode.actions.len() {
                return refuse("it is to correct what the policy does, and was given no environments".into());
            }
            let seen = episode.observations.len() - self.sizes[0];
            self.observations.extend_from_slice(&episode.observations[..seen]);
            self.actions.extend_from_slice(&episode.shown);
            self.lengths.push(episode.rewards.len() as u64);
            self.corrected += 1;
        }
        if self.bytes() > archive::MAX_BYTES {
            let most = archive::MAX_BYTES >> 20;
            return refuse(format!(
                "demonstrations and corrections have more than {most} MiB: ask for fewer episodes or iterations"
            ));
        }
        Ok(())
    }

    /// Leaves out all corrected episodes but the first ones.
    ///
    /// # Errors
    /// Fewer episodes are corrected than are asked for.
    pub(crate) fn keep_corrected(&mut self, count: u64) -> Result<(), PolicyError> {
        if self.corrected < count {
            let message =
                format!("it holds {} corrected episodes of {count}: restore the file", self.corrected);
            return Err(PolicyError::content(message));
        }
        self.lengths.truncate(self.lengths.len() - (self.corrected - count) as usize);
        self.corrected = count;
        let [_, steps] = self.sizes();
        self.observations.truncate(steps * self.sizes[0]);
        self.actions.truncate(steps * self.sizes[1]);
        Ok(())
    }

    /// Plays an episode, and keeps its steps if it is a success; where a task counts a share of solved steps, if it ends solved.
    fn episode(
        &mut self,
        env: &mut Env,
        teacher: &mut dyn Teacher,
        noise: f64,
        seed: u64,
    ) -> Result<(), PolicyError> {
        let draws = |purpose: u64| SeedSequence::with_spawn_key(seed, vec![self.played, purpose, 0, 0]);
        let [low, high] = draws(RESET).generate_state::<2>().map(u64::from);
        let (start, mut rng) = (high << 32 | low, Rng::pcg64(draws(NOISE)));
        self.played += 1;
        env.reset(Some(start))?;
        teacher.begin(env, start)?;
        let (from, steps) = (self.actions.len(), self.observations.len());
        let (mut summary, mut action) = (Summary::default(), vec![0.0; env.action_len()]);
        while !(summary.terminated || summary.truncated) {
            teacher.act(env, &mut action)?;
            self.observations.extend_from_slice(env.observation());
            self.actions.extend(action.iter().map(|value| *value as f32));
            action.iter_mut().for_each(|value| *value += noise * rng.standard_normal());
            let step = env.step(&action)?;
            summary.add(env, &step);
        }
        let length = (self.actions.len() - from) / env.action_len().max(1);
        let succeeded = match env.success() {
            Success::MoreThan(steps) => summary.solved > steps,
            Success::Share => env.verdict().solved,
        };
        if succeeded {
            self.lengths.push(length as u64);
        } else {
            self.actions.truncate(from);
            self.observations.truncate(steps);
        }
        Ok(())
    }

    /// Number of episodes, and of steps in all of them.
    pub fn sizes(&self) -> [usize; 2] {
        [self.lengths.len(), self.lengths.iter().sum::<u64>() as usize]
    }

    /// Size of what a file holds.
    fn bytes(&self) -> u64 {
        (8 * self.observations.len() + 4 * self.actions.len() + 8 * self.lengths.len()) as u64
    }

    /// What was observed, row after row.
    pub(super) fn observations(&self) -> &[f64] {
        &self.observations
    }

    /// The steps as a policy normalises them now, without advantages and returns.
    pub(super) fn batch(&self, actor: &Actor) -> Batch {
        let input = actor.normalized(&self.observations);
        Batch { input, actions: self.actions.clone(), ..Batch::default() }
    }

    /// Writes them into a file.
    ///
    /// # Errors
    /// The file cannot be written, or would be too large.
    pub fn save(&mut self, path: &Path) -> Result<(), PolicyError> {
        let [episodes, steps] = self.sizes();
        let label = Label {
            format: FORMAT.into(),
            id: self.id.clone(),
            sizes: self.sizes,
            steps,
            episodes,
            played: self.played,
            corrected: self.corrected,
        };
        let label = serde_json::to_string(&label).map_err(|error| PolicyError::content(error.to_string()))?;
        archive::write(path, label, &self.entries(steps), archive::MAX_BYTES)
    }

    /// Reads what [`Demonstrations::save`] wrote of an environment like `env`.
    ///
    /// # Errors
    /// The file cannot be read, holds no demonstrations, or some of another environment.
    pub fn open(env: &Env, path: &Path) -> Result<Self, PolicyError> {
        let bytes = archive::read(path, archive::MAX_BYTES)?;
        let fill = || {
            let archive = Archive::parse(&bytes)?;
            let wrong = |error| PolicyError::content(format!("its card is not understood: {error}"));
            let label: Label = serde_json::from_str(archive.card()).map_err(wrong)?;
            if label.format != FORMAT {
                let message = format!("its format is {:?}, and {FORMAT:?} is understood", label.format);
                return Err(PolicyError::content(message));
            }
            let (id, sizes) = (&env.spec().id, [env.observation().len(), env.action_len()]);
            if (&label.id, label.sizes) != (id, sizes) {
                let message = format!("it holds demonstrations in {}", label.id);
                return Err(PolicyError::Foreign { id: id.clone(), message });
            }
            let numbers = label.steps.checked_mul(8 * sizes[0].max(1));
            let counts = label.episodes.max(label.corrected as usize);
            if numbers.is_none_or(|bytes| bytes > archive.size) || counts > archive.size.min(label.episodes) {
                return Err(PolicyError::content("its card says of more steps than the file holds"));
            }
            let mut read = Demonstrations {
                id: label.id,
                sizes,
                observations: vec![0.0; label.steps * sizes[0]],
                actions: vec![0.0; label.steps * sizes[1]],
                lengths: vec![0; label.episodes],
                played: label.played,
                corrected: label.corrected,
            };
            archive.fill(read.entries(label.steps))?;
            if read.lengths.iter().try_fold(0_u64, |sum, steps| sum.checked_add(*steps))
                != Some(label.steps as u64)
            {
                return Err(PolicyError::content("the lengths of its episodes do not add up to its steps"));
            }
            Ok(read)
        };
        fill().map_err(|error: PolicyError| error.within(path))
    }

    fn entries(&mut self, steps: usize) -> Vec<Entry<'_>> {
        vec![
            Entry::matrix("observations", steps.max(1), Numbers::F64(&mut self.observations)),
            Entry::matrix("actions", steps.max(1), Numbers::F32(&mut self.actions)),
            Entry::new("lengths", Numbers::U64(&mut self.lengths)),
        ]
    }
}
