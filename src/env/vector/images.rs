//! The images of all environments of a batch.

use super::{VecEnv, at_home};
use crate::environment::Env;
use crate::error::EnvError;
use crate::pictures::eyes::Exteroception;
use render::Settings;
use render::raster::Shot;

impl VecEnv {
    /// Draws the images of every environment, as [`Env::exteroception`] draws them, and returns them: on the threads, or all
    /// together where what draws is faster so, such as a GPU.
    ///
    /// # Errors
    /// The first environment whose images cannot be drawn; some are under way.
    pub fn exteroception(&mut self) -> Result<impl ExactSizeIterator<Item = &Exteroception>, EnvError> {
        self.check_at_home()?;
        let first = self.slots.first().map(|slot| &at_home(slot).env);
        if first.is_some_and(|env| env.sight.draws_batches(&env.scene.model)) {
            self.draw_together()?;
        } else {
            self.try_each(|env| env.exteroception().map(drop))?;
        }
        Ok(self.slots.iter().map(|slot| at_home(slot).env.visuals().expect("they were drawn")))
    }

    /// Draws all images at once; the threads list what they show and encode them.
    fn draw_together(&mut self) -> Result<(), EnvError> {
        self.try_each(Env::list_images)?;
        let Some(first) = self.slots.first().map(|slot| &at_home(slot).env) else { return Ok(()) };
        let (sight, model) = (first.sight.clone(), first.scene.model.clone());
        let mut batches: Vec<(Settings, Vec<Shot<'_>>)> = Vec::new();
        for slot in self.slots.iter_mut().flatten().filter(|slot| slot.env.visuals().is_none()) {
            let settings = Settings::of(&slot.env.scene.model);
            match batches.iter_mut().find(|(known, _)| *known == settings) {
                Some((_, shots)) => shots.extend(slot.env.shots()),
                None => batches.push((settings, slot.env.shots().collect())),
            }
        }
        sight.draw_listed(&model, &mut batches)?;
        self.try_each(Env::finish_images)
    }

    /// Does something to every environment, on the threads; the error of the first that fails.
    fn try_each(&mut self, each: impl Fn(&mut Env) -> Result<(), EnvError> + Sync) -> Result<(), EnvError> {
        let mut outcomes: Vec<_> = self.slots.iter().map(|_| Ok(())).collect();
        let work: Vec<_> = self.slots.iter_mut().flatten().zip(&mut outcomes).collect();
        self.pool.each(work, |(slot, outcome)| *outcome = each(&mut slot.env))?;
        outcomes.into_iter().collect()
    }
}
