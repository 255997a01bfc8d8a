//! What every reset draws into the model of an environment, and how it comes back.

use super::dial::{Dial, Target, WIDTH};
use crate::draws::Rng;
use crate::error::EnvError;
use crate::rows::{Name, Rows};
use crate::scene::Scene;
use physics::Model;
use random::SeedSequence;
use robot::Keeper;

/// What changes in the model of an environment, and how it was drawn last.
#[derive(Clone)]
pub(crate) struct Drawn<T> {
    pub(super) dials: Vec<Dial<T>>,
    /// The model before anything was drawn.
    pub(super) base: Box<Model>,
    rng: Rng,
    rows: Rows,
}

/// What was drawn, and where the sequence of draws stands.
#[derive(Clone)]
pub(crate) struct DrawnState {
    base: Box<Model>,
    rng: Rng,
    rows: Rows,
}

impl<T: Target> Drawn<T> {
    pub(super) fn of(dials: Vec<Dial<T>>, model: &Model, seed: u64) -> Self {
        Drawn { dials, base: Box::new(model.clone()), rng: stream(seed, T::STREAM), rows: Rows::default() }
    }

    /// Restarts the draws.
    pub(crate) fn seed(&mut self, seed: u64) {
        self.rng = stream(seed, T::STREAM);
    }

    /// Draws, and writes what was drawn into the model.
    ///
    /// # Errors
    /// There is no such draw; the model refuses it.
    pub(crate) fn draw(&mut self, id: &str, scene: &mut Scene) -> Result<(), EnvError> {
        self.rows.begin();
        for dial in &self.dials {
            let mut values = [0.0; WIDTH];
            let values = &mut values[..dial.width()];
            dial.draw(&mut self.rng, &self.rows, values).map_err(|message| EnvError::Setting {
                id: id.to_owned(),
                message: format!("{}: {message}", T::SETTING),
            })?;
            self.rows.set(Name(&dial.name), dial.unit, values.iter());
        }
        self.write(scene)
    }

    /// What was drawn last, a row for each dial; none before the first draw.
    pub(crate) fn rows(&self) -> &Rows {
        &self.rows
    }

    /// Takes what was drawn before, by the same configuration, and writes it into the model.
    ///
    /// # Errors
    /// It has other rows than are drawn here, or values that are not finite.
    pub(crate) fn show(&mut self, drawn: &Rows, scene: &mut Scene) -> Result<(), EnvError> {
        let foreign = |message: String| EnvError::ForeignState { message };
        let rows = drawn.iter().map(|(row, values)| (row.name(), values.len()));
        if !rows.eq(self.dials.iter().map(|dial| (dial.name.as_str(), dial.width()))) {
            return Err(foreign(format!("it has other rows than {} draws", T::SETTING)));
        }
        if let Some((row, _)) = drawn.iter().find(|(_, values)| values.iter().any(|value| !value.is_finite()))
        {
            return Err(foreign(format!("the row {} of its {} is not finite", row.name(), T::SETTING)));
        }
        self.rows.clone_from(drawn);
        self.write(scene)
    }

    /// Writes what was drawn last into the model; nothing before the first draw.
    ///
    /// # Errors
    /// The model refuses it.
    pub(crate) fn write(&self, scene: &mut Scene) -> Result<(), EnvError> {
        if self.rows.rows().is_empty() {
            return Ok(());
        }
        T::change(scene, |m| {
            self.dials.iter().for_each(|dial| dial.target.restore(&self.base, m));
            for (dial, (_, values)) in self.dials.iter().zip(self.rows.iter()) {
                dial.target.write(values, &self.base, m);
            }
        })
    }

    /// The dials with what was drawn last.
    pub(super) fn turned(&self) -> impl Iterator<Item = (&T, &[f64])> {
        self.dials.iter().zip(self.rows.iter()).map(|(dial, (_, values))| (&dial.target, values))
    }

    /// Writes what was drawn and where the sequence of draws stands, or reads it; the model is kept elsewhere.
    pub(crate) fn keep(&mut self, keeper: &mut Keeper) {
        keeper.generator(&mut self.rng);
        let mut drawn = !self.rows.rows().is_empty();
        keeper.flag(&mut drawn);
        if !drawn {
            self.rows = Rows::default();
        } else if self.rows.rows().is_empty() {
            for dial in &self.dials {
                self.rows.set(Name(&dial.name), dial.unit, [0.0; WIDTH][..dial.width()].iter());
            }
        }
        if drawn {
            self.rows.keep(keeper);
        }
    }

    pub(crate) fn state(&self) -> DrawnState {
        DrawnState { base: self.base.clone(), rng: self.rng.clone(), rows: self.rows.clone() }
    }

    /// Takes over a state whose model has been taken over already.
    pub(crate) fn restore(&mut self, state: &DrawnState) {
        self.base = state.base.clone();
        self.rng = state.rng.clone();
        self.rows.clone_from(&state.rows);
    }
}

fn stream(seed: u64, stream: u64) -> Rng {
    Rng::pcg64(SeedSequence::with_spawn_key(seed, [stream]))
}
