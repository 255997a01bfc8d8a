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

use crate::environment::Env;
use crate::error::EnvError;
use crate::memory::keep_rows;
use crate::rows::{Name, Rows};
use crate::scene::Scene;
use crate::task::Rng;
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
            keep_rows(&mut self.drawn, keeper);
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

impl Env {
    /// What the last reset drew of the look of the scene, a row for each thing that changes; `None` where nothing does. It
    /// has no rows before the first reset.
    ///
    /// The row of a texture holds the number of its pattern (colour, checker, gradient, noise), red, green and blue of both
    /// colours, the squares of a checker along a side, and the seed of a noise.
    pub fn look(&self) -> Option<&Rows> {
        self.look.as_ref().map(|look| &look.drawn)
    }

    /// Gives the scene a look that was drawn before, by the same settings; the state stays.
    ///
    /// # Errors
    /// The look has other rows than this environment draws.
    pub fn set_look(&mut self, drawn: &Rows) -> Result<(), EnvError> {
        let foreign = |message: String| EnvError::ForeignState { message };
        let Some(look) = &mut self.look else {
            return Err(foreign("this environment has no visual_randomization".into()));
        };
        let rows = drawn.iter().map(|(row, values)| (row.name(), values.len()));
        if !rows.eq(look.dials.iter().map(|dial| (dial.name.as_str(), dial.width()))) {
            return Err(foreign("its look has other rows than visual_randomization names".into()));
        }
        if let Some((row, _)) = drawn.iter().find(|(_, values)| values.iter().any(|value| !value.is_finite()))
        {
            return Err(foreign(format!("the row {} of its look is not finite", row.name())));
        }
        look.drawn.clone_from(drawn);
        look.write(&mut self.scene)?;
        self.scene.forward()?;
        self.observe_readings()?;
        self.eyes.close();
        Ok(())
    }
}
