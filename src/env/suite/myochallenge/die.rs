//! The die of a model, and how resets vary it.

use crate::draws::Rng;
use crate::error::EnvError;
use crate::scene::Scene;
use physics::elements::BodyId;
use physics::math::Vec3;
use physics::model::Draft;
use std::ops::Range;
use std::sync::Arc;

/// Geoms at the end of the die's list, boxes that grow in all directions; those before them are beams along its edges.
const BOXES: usize = 3;

/// A die, and what was drawn for it.
#[derive(Clone)]
pub struct Die {
    compiled: Arc<Compiled>,
    /// Masses \[kg\].
    masses: [f64; 2],
    /// Largest change of half sizes \[m\].
    size_change: f64,
    friction: Vec<f64>,
    mass: f64,
    growth: f64,
}

/// The die as the model has it.
struct Compiled {
    body: BodyId,
    geoms: Range<usize>,
    sizes: Vec<Vec3>,
    places: Vec<Vec3>,
    /// Bounds of the coefficients of friction, three a geom.
    friction: [Vec<f64>; 2],
    mass: f64,
    inertia: Vec3,
    /// Half of its width \[m\].
    half: f64,
}

impl Die {
    /// The die of a scene, with the masses \[kg\] and the largest changes of half sizes \[m\] and friction that resets may give it.
    ///
    /// # Errors
    /// The model has no die.
    pub fn new(
        scene: &Scene,
        masses: [f64; 2],
        size_change: f64,
        friction_change: Vec3,
    ) -> Result<Self, EnvError> {
        let (body, m) = (scene.body("Object")?, &scene.model);
        let first = m.body_geomadr[body.index()].max(0) as usize;
        let geoms = first..first + m.body_geomnum[body.index()] as usize;
        let bound = |side: f64| {
            let of_geom = |friction: &Vec3| [0, 1, 2].map(|k| friction[k] + side * friction_change[k]);
            m.geom_friction[geoms.clone()].iter().flat_map(of_geom).collect()
        };
        let sizes = m.geom_size[geoms.clone()].to_vec();
        let compiled = Compiled {
            body,
            friction: [bound(-1.0), bound(1.0)],
            half: sizes.iter().skip(geoms.len().saturating_sub(BOXES)).flatten().copied().fold(0.0, f64::max),
            sizes,
            places: m.geom_pos[geoms.clone()].to_vec(),
            mass: m.body_mass[body.index()],
            inertia: m.body_inertia[body.index()],
            geoms,
        };
        let friction = compiled.friction[0].clone();
        Ok(Die { masses, size_change, friction, mass: compiled.mass, growth: 0.0, compiled: compiled.into() })
    }

    /// Draws friction, mass and the change of half sizes, in this order.
    ///
    /// # Errors
    /// A range that cannot be drawn from.
    pub fn draw(&mut self, rng: &mut Rng) -> Result<(), EnvError> {
        let [low, high] = &self.compiled.friction;
        rng.fill_uniform_each(low, high, &mut self.friction)?;
        self.mass = rng.uniform(self.masses[0], self.masses[1])?;
        self.growth = rng.uniform(-self.size_change, self.size_change)?;
        Ok(())
    }

    /// How much the die's half sizes have changed \[m\].
    pub fn growth(&self) -> f64 {
        self.growth
    }

    /// Writes the die into a model; with `inertia`, also its moments of inertia, which the original leaves as they were.
    pub fn impose(&self, m: &mut Draft<'_>, inertia: bool) {
        let Compiled { body, geoms, sizes, places, .. } = &*self.compiled;
        let boxes = geoms.end.saturating_sub(BOXES);
        for (k, geom) in geoms.clone().enumerate() {
            m.geom_friction[geom].copy_from_slice(&self.friction[3 * k..3 * k + 3]);
            let grown = sizes[k].map(|size| size + self.growth);
            if geom < boxes {
                m.geom_size[geom][1] = grown[1];
            } else {
                m.geom_size[geom] = grown;
            }
            let outward = |x: f64| if x == 0.0 { 0.0 } else { x.signum() * (x.abs() + self.growth) };
            m.geom_pos[geom] = places[k].map(outward);
        }
        m.body_mass[body.index()] = self.mass;
        if inertia {
            let wider = 1.0 + self.growth / self.compiled.half;
            let factor = self.mass / self.compiled.mass * wider * wider;
            m.body_inertia[body.index()] = self.compiled.inertia.map(|moment| moment * factor);
        }
    }
}
