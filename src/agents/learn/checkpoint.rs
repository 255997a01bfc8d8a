//! Trainings in files. A checkpoint holds all that decides how a training goes on, so that one which went on from a checkpoint has the bits of
//! one that was never interrupted; a policy holds what acts.

use super::actor::Actor;
use super::learner::Learner;
use super::settings::Settings;
use super::teacher::Teaching;
use crate::archive::{self, Archive};
use crate::error::PolicyError;
use env::{Env, Rng};
use serde::{Deserialize, Serialize};
use std::path::Path;

/// What the files call themselves.
const FORMAT: &str = "robohive-training-1";

/// What a file says of the numbers in it.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
#[non_exhaustive]
pub struct Card {
    /// The format of the file.
    pub format: String,
    /// Id of the environment.
    pub id: String,
    /// Length of an observation.
    pub observed: usize,
    /// Length of an action.
    pub actions: usize,
    /// Seed of the training.
    pub seed: u64,
    /// Iterations made.
    pub iterations: u64,
    /// Steps of environments that it learnt from.
    pub samples: u64,
    /// Version of the engine.
    pub engine: String,
    /// How it was trained.
    pub settings: Settings,
    /// Who showed how its task is done, where it learnt from demonstrations.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub teacher: Option<Teaching>,
}

impl Learner {
    fn card(&self, id: &str, teacher: Option<&Teaching>) -> Card {
        Card {
            format: FORMAT.into(),
            id: id.into(),
            observed: self.actor.net.inputs(),
            actions: self.actor.actions(),
            seed: self.seed,
            iterations: self.iterations,
            samples: self.samples,
            engine: env!("CARGO_PKG_VERSION").into(),
            settings: self.settings.clone(),
            teacher: teacher.cloned(),
        }
    }

    /// How it is trained.
    pub fn settings(&self) -> &Settings {
        &self.settings
    }

    /// Its seed.
    pub fn seed(&self) -> u64 {
        self.seed
    }

    /// Writes all of it, and who taught it, into a file, which [`Learner::resume`] and, as a policy, [`Policy::open`](crate::Policy::open) read.
    ///
    /// # Errors
    /// The file cannot be written.
    pub fn save(&mut self, id: &str, teacher: Option<&Teaching>, path: &Path) -> Result<(), PolicyError> {
        let card = text(&self.card(id, teacher))?;
        archive::write(path, card, &self.entries(), archive::MAX_CHECKPOINT_BYTES)
    }

    /// Writes the policy alone, and who taught it, into a file, which [`Policy::open`](crate::Policy::open) reads.
    ///
    /// # Errors
    /// The file cannot be written.
    pub fn save_policy(
        &mut self,
        id: &str,
        teacher: Option<&Teaching>,
        path: &Path,
    ) -> Result<(), PolicyError> {
        let card = text(&self.card(id, teacher))?;
        archive::write(path, card, &self.actor.entries(), archive::MAX_BYTES)
    }

    /// Goes on from what [`Learner::save`] wrote, on environments like `env`.
    ///
    /// # Errors
    /// The file cannot be read, holds no checkpoint, or one of another environment or version.
    pub fn resume(path: &Path, env: &Env) -> Result<Self, PolicyError> {
        let bytes = archive::read(path, archive::MAX_CHECKPOINT_BYTES)?;
        let fill = || {
            let archive = Archive::parse(&bytes)?;
            let card = Card::of(&archive)?;
            card.check(env)?;
            if card.engine != env!("CARGO_PKG_VERSION") {
                let (theirs, ours) = (card.engine, env!("CARGO_PKG_VERSION"));
                let message =
                    format!("a training of version {theirs} goes on in that version; this is {ours}");
                return Err(PolicyError::content(message));
            }
            let mut learner = Learner::new(card.settings, card.seed, env);
            learner.fill(&archive)?;
            Ok(learner)
        };
        fill().map_err(|error: PolicyError| error.within(path))
    }
}

impl Card {
    /// What a file says of itself, of which no more is read: a checkpoint can have gigabytes.
    pub(crate) fn of_file(path: &Path) -> Result<Self, PolicyError> {
        let (text, size) = archive::read_card(path)?;
        Card::parse(&text, size).map_err(|error| error.within(path))
    }

    pub(crate) fn of(archive: &Archive<'_>) -> Result<Self, PolicyError> {
        Card::parse(archive.card(), archive.size as u64)
    }

    /// The card of a file of this size.
    fn parse(text: &str, size: u64) -> Result<Self, PolicyError> {
        let wrong = |error| PolicyError::content(format!("its card is not understood: {error}"));
        let card: Card = serde_json::from_str(text).map_err(wrong)?;
        if card.format != FORMAT {
            let message = format!("its format is {:?}, and {FORMAT:?} is understood", card.format);
            return Err(PolicyError::content(message));
        }
        if card.parameters().is_none_or(|count| count as u64 > size / 4) {
            let message =
                "its card says of a larger network than the file holds, or of a layer without width";
            return Err(PolicyError::content(message));
        }
        Ok(card)
    }

    /// Number of parameters of its policy's network; none where a width is zero, or there are more than can be counted.
    fn parameters(&self) -> Option<usize> {
        let [hidden, values] = &self.settings.hidden;
        let outputs = self.settings.head().outputs(self.actions);
        let widths = [&[self.observed], &hidden[..], &[outputs]].concat();
        if widths.contains(&0) || values.contains(&0) {
            return None;
        }
        let layers = widths.windows(2).map(|pair| pair[0].checked_add(1)?.checked_mul(pair[1]));
        layers.sum()
    }

    /// Refuses an environment that is none of its id, or does not fit.
    fn check(&self, env: &Env) -> Result<(), PolicyError> {
        let (id, sizes) = (&env.spec().id, [env.observation().len(), env.action_len()]);
        if (&self.id, [self.observed, self.actions]) == (id, sizes) {
            return Ok(());
        }
        let message = format!(
            "it was trained on {} with {} observed numbers and {} actions; here are {} and {}",
            self.id, self.observed, self.actions, sizes[0], sizes[1]
        );
        Err(PolicyError::Foreign { id: id.clone(), message })
    }

    /// The policy of a file.
    pub(crate) fn actor(&self, archive: &Archive<'_>) -> Result<Actor, PolicyError> {
        let (Settings { hidden: [hidden, _], activation, .. }, head) = (&self.settings, self.settings.head());
        let sizes = [self.observed, self.actions];
        let mut actor = Actor::new(sizes, hidden, *activation, head, &mut Rng::pcg64(0_u64));
        archive.fill(actor.entries())?;
        Ok(actor)
    }
}

fn text(card: &Card) -> Result<String, PolicyError> {
    serde_json::to_string(card).map_err(|error| PolicyError::content(error.to_string()))
}
