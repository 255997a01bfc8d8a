//! Visual domain randomisation: textures, colours, lights, cameras and distractors that differ from episode to episode.
//!
//! Draws come from a stream of their own, so that a task draws the same with and without them; they are made at every reset,
//! written into this environment's copy of the model, and kept to be recorded and restored. What is written leaves the motion
//! as it is: distractors must be bodies that touch nothing. Sensors that look through a camera see that it moved.

mod choice;
mod config;
mod dial;
mod texture;

pub use config::{
    CameraRange, DistractorRange, LightRange, MaterialRange, Pattern, TextureRange, VisualRandomization,
};

use crate::draws::Rng;
use crate::error::EnvError;
use crate::rows::{Name, Rows};
use crate::scene::Scene;
use dial::{Dial, WIDTH};
use physics::Model;
use random::SeedSequence;
use robot::Keeper;

/// Which descendant of an environment's seed the look of a scene is drawn from.
const STREAM: u64 = 1;

/// What changes in the look of an environment, and how it looks now.
#[derive(Clone)]
pub(crate) struct Look {
    dials: Vec<Dial>,
    /// The model before anything was drawn.
    base: Model,
    rng: Rng,
    drawn: Rows,
}

/// A look that was drawn, and where the sequence of draws stands.
#[derive(Clone)]
pub(crate) struct LookState {
    rng: Rng,
    drawn: Rows,
}

impl Look {
    /// Finds what a configuration names.
    ///
    /// # Errors
    /// A name or range that is wrong.
    pub(crate) fn new(config: &VisualRandomization, model: &Model, seed: u64) -> Result<Self, String> {
        let dials = choice::dials(config, model)?;
        Ok(Look { dials, base: model.clone(), rng: stream(seed), drawn: Rows::default() })
    }

    /// Restarts its draws.
    pub(crate) fn seed(&mut self, seed: u64) {
        self.rng = stream(seed);
    }

    /// Draws a look and writes it into the model.
    ///
    /// # Errors
    /// The model refuses it.
    pub(crate) fn draw(&mut self, scene: &mut Scene) -> Result<(), EnvError> {
        self.drawn.begin();
        for dial in &self.dials {
            let mut values = [0.0; WIDTH];
            let values = &mut values[..dial.width()];
            dial.draw(&mut self.rng, values)?;
            self.drawn.set(Name(&dial.name), dial.unit, values.iter());
        }
        self.write(scene)
    }

    /// What was drawn last.
    pub(crate) fn drawn(&self) -> &Rows {
        &self.drawn
    }

    /// Takes what was drawn before, by the same configuration, and writes it into the model.
    ///
    /// # Errors
    /// It has other rows than this look draws, or values that are not finite.
    pub(crate) fn show(&mut self, drawn: &Rows, scene: &mut Scene) -> Result<(), EnvError> {
        let foreign = |message: String| EnvError::ForeignState { message };
        let rows = drawn.iter().map(|(row, values)| (row.name(), values.len()));
        if !rows.eq(self.dials.iter().map(|dial| (dial.name.as_str(), dial.width()))) {
            return Err(foreign("its look has other rows than visual_randomization names".into()));
        }
        if let Some((row, _)) = drawn.iter().find(|(_, values)| values.iter().any(|value| !value.is_finite()))
        {
            return Err(foreign(format!("the row {} of its look is not finite", row.name())));
        }
        self.drawn.clone_from(drawn);
        self.write(scene)
    }

    fn write(&self, scene: &mut Scene) -> Result<(), EnvError> {
        scene.overwrite(|m| {
            for (dial, (_, values)) in self.dials.iter().zip(self.drawn.iter()) {
                dial.write(values, &self.base, m);
            }
        })
    }

    /// Writes what was drawn and where the sequence of draws stands, or reads it; the model is kept elsewhere.
    pub(crate) fn keep(&mut self, keeper: &mut Keeper) {
        keeper.generator(&mut self.rng);
        let mut drawn = !self.drawn.rows().is_empty();
        keeper.flag(&mut drawn);
        if drawn && self.drawn.rows().is_empty() {
            let dials = &self.dials;
            dials.iter().for_each(|dial| {
                self.drawn.set(Name(&dial.name), dial.unit, [0.0; WIDTH][..dial.width()].iter());
            });
        }
        if drawn {
            self.drawn.keep(keeper);
        }
    }

    pub(crate) fn state(&self) -> LookState {
        LookState { rng: self.rng.clone(), drawn: self.drawn.clone() }
    }

    /// Takes over a state whose model has been taken over already.
    pub(crate) fn restore(&mut self, state: &LookState) {
        self.rng = state.rng.clone();
        self.drawn.clone_from(&state.drawn);
    }
}

fn stream(seed: u64) -> Rng {
    Rng::pcg64(SeedSequence::with_spawn_key(seed, [STREAM]))
}
