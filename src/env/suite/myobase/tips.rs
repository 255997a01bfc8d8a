//! Sites that are to reach targets, and how far they are from them.

use crate::draws::Rng;
use crate::error::EnvError;
use crate::rotation::norm;
use crate::rows::Rows;
use crate::scene::Scene;
use crate::suite::muscle::observe_activations;
use crate::suite::named::Named;
use crate::task::{Verdict, View};
use physics::elements::SiteId;
use physics::math::{add, sub};

/// A site and the box that its target is drawn from.
#[derive(Clone, Debug)]
struct Tip {
    site: SiteId,
    target: SiteId,
    low: [f64; 3],
    high: [f64; 3],
}

/// Sites with targets. Each target is a site of its own, called like the site with `_target` appended.
#[derive(Clone, Debug)]
pub struct Tips {
    tips: Vec<Tip>,
    near: f64,
    far: f64,
}

/// How far the sites are from their targets.
#[derive(Clone, Copy, Debug)]
pub struct Approach {
    /// Length of all errors as one vector \[m\].
    pub distance: f64,
    /// One for each of two thresholds that the distance is below.
    pub bonus: f64,
    /// Solved within the nearer threshold, done beyond the far one, but not within the first two steps.
    pub verdict: Verdict,
}

impl Tips {
    /// The sites that `ranges` names, with thresholds \[m\] per site.
    ///
    /// # Errors
    /// The model lacks a site or its target.
    pub fn new(scene: &Scene, ranges: &Named<[[f64; 3]; 2]>, near: f64, far: f64) -> Result<Self, EnvError> {
        let tip = |(name, [low, high]): &(String, [[f64; 3]; 2])| {
            let target = scene.site(&format!("{name}_target"))?;
            Ok(Tip { site: scene.site(name)?, target, low: *low, high: *high })
        };
        let tips = ranges.0.iter().map(tip).collect::<Result<Vec<_>, EnvError>>()?;
        let count = tips.len() as f64;
        Ok(Tips { near: count * near, far: far * count, tips })
    }

    /// Draws a target for every site, in the world.
    ///
    /// # Errors
    /// Ranges that cannot be drawn from.
    pub fn draw_targets(&self, scene: &mut Scene, rng: &mut Rng) -> Result<(), EnvError> {
        for tip in &self.tips {
            let target = tip.draw(rng)?;
            scene.overwrite(|m| m.site_pos[tip.target.index()] = target)?;
        }
        Ok(())
    }

    /// Draws a target for every site, from where the site is.
    ///
    /// # Errors
    /// Ranges that cannot be drawn from.
    pub fn draw_targets_nearby(&self, scene: &mut Scene, rng: &mut Rng) -> Result<(), EnvError> {
        for tip in &self.tips {
            let target = add(*scene.data.site(tip.site).xpos(), tip.draw(rng)?);
            scene.overwrite(|m| m.site_pos[tip.target.index()] = target)?;
        }
        Ok(())
    }

    /// Writes the rows of a reaching task.
    pub fn observe(&self, view: &View<'_>, rows: &mut Rows) {
        let position = |site: SiteId| *view.data.site(site).xpos();
        rows.set("qpos", "rad, m", &view.data.state.qpos);
        rows.set("qvel", "rad, m", view.data.state.qvel.iter().map(|velocity| velocity * view.dt));
        observe_activations(view, rows);
        rows.set("tip_pos", "m", self.tips.iter().flat_map(|tip| position(tip.site)));
        rows.set("target_pos", "m", self.tips.iter().flat_map(|tip| position(tip.target)));
        let error = |tip: &Tip| sub(position(tip.target), position(tip.site));
        rows.set("reach_err", "m", self.tips.iter().flat_map(error));
    }

    /// How far the sites are from their targets, by the row `reach_err`.
    pub fn approach(&self, view: &View<'_>, rows: &Rows) -> Approach {
        let distance = norm(&rows["reach_err"]);
        let within = |threshold| f64::from(distance < threshold);
        let far = if rows["time"][0] > 2.0 * view.dt { self.far } else { f64::INFINITY };
        Approach {
            distance,
            bonus: within(2.0 * self.near) + within(self.near),
            verdict: Verdict { sparse: -distance, solved: distance < self.near, done: distance > far },
        }
    }
}

impl Tip {
    fn draw(&self, rng: &mut Rng) -> Result<[f64; 3], EnvError> {
        let mut offset = [0.0; 3];
        rng.fill_uniform_each(&self.low, &self.high, &mut offset)?;
        Ok(offset)
    }
}
