//! Turning objects of many shapes until they point like their targets.

use super::turning::{self, Placement};
use crate::draws::Rng;
use crate::error::EnvError;
use crate::rotation::quat_of_euler;
use crate::rows::Rows;
use crate::scene::Scene;
use crate::spec::Spec;
use crate::suite::muscle::{Condition, Muscles, observe_activations};
use crate::task::{Defaults, Episode, Pose, Setup, Task, Turn, Verdict, View};
use physics::elements::{BodyId, GeomId, SiteId};
use physics::geometry::shape::inertia;
use physics::math::{scale, sub};
use physics::model::GeomType;
use robot::{Compat, Keeper};
use serde::Deserialize;
use std::sync::Arc;
use toml::Table;

/// Mass of every object \[kg\].
const MASS: f64 = 1.2;
/// Ranges of the target's angles about x and y \[rad\].
const ANGLES: [[f64; 2]; 2] = [[-1.0, 1.0], [-0.8, 1.2]];
/// How far beyond the half length of a capsule the ends of its axis are marked.
const CAPSULE_END: f64 = 1.3;
/// The smallest collection of shapes, which is used otherwise than the rest.
const SMALLEST: &str = "geometries8";

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Args {
    /// The collection of shapes.
    shapes: String,
    #[serde(default)]
    muscle_condition: Condition,
}

/// Sizes of a collection, by kind of geom.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Shapes {
    capsule: Vec<f64>,
    ellipsoid: Vec<f64>,
    cylinder: Vec<f64>,
    #[serde(rename = "box")]
    cuboid: Vec<f64>,
}

/// A body that takes shapes: its geom, and the geoms that mark the ends of its axis.
#[derive(Clone, Copy)]
struct Shaped {
    geom: GeomId,
    top: GeomId,
    bottom: GeomId,
    /// Distance of the marks \[m\].
    length: f64,
}

#[derive(Clone)]
pub struct ShapeReorient {
    muscles: Muscles,
    shapes: Arc<Shapes>,
    object: BodyId,
    target: BodyId,
    place: SiteId,
    /// The object, and the target that looks like it.
    shaped: [Shaped; 2],
    /// Whether sliding friction alone acts, and colours are drawn.
    large: bool,
    compat: Compat,
}

impl ShapeReorient {
    /// The task with these settings.
    ///
    /// # Errors
    /// Settings do not fit, or elements are missing.
    pub fn new(args: Args, setup: &mut Setup<'_>) -> Result<Self, EnvError> {
        let muscles = Muscles::new(args.muscle_condition, setup)?;
        let scene = &*setup.scene;
        Ok(ShapeReorient {
            muscles,
            shapes: Arc::new(Shapes::collection(setup.spec, &args.shapes)?),
            object: scene.body("Object")?,
            target: scene.body("target")?,
            place: scene.site("eps_ball")?,
            shaped: [
                Shaped::new(scene, ["obj", "top", "bot"])?,
                Shaped::new(scene, ["target", "t_top", "t_bot"])?,
            ],
            large: args.shapes != SMALLEST,
            compat: setup.compat,
        })
    }
}

impl Shapes {
    fn collection(spec: &Spec, name: &str) -> Result<Self, EnvError> {
        let mut collections: Table = include_str!("shapes.toml")
            .parse()
            .map_err(|error| spec.wrong(format!("the built-in sizes are malformed: {error}")))?;
        match collections.remove(name) {
            Some(collection) => {
                collection.try_into().map_err(|error: toml::de::Error| spec.wrong(error.message()))
            }
            None => {
                let names: Vec<_> = collections.keys().map(String::as_str).collect();
                Err(spec.wrong(format!("there are no shapes {name}; there are {}", names.join(", "))))
            }
        }
    }

    /// Draws a kind of geom and one of its sizes.
    fn draw(&self, rng: &mut Rng, colors: bool) -> Result<(GeomType, [f64; 3]), EnvError> {
        let kinds = [
            (GeomType::Capsule, &self.capsule),
            (GeomType::Ellipsoid, &self.ellipsoid),
            (GeomType::Cylinder, &self.cylinder),
            (GeomType::Box, &self.cuboid),
        ];
        let &(kind, sizes) = rng.choose(&kinds)?;
        let (sizes, _) = sizes.as_chunks();
        let size = *rng.choose(sizes)?;
        if colors {
            // The original draws the colour of another object of the kind.
            rng.choose(sizes)?;
        }
        Ok((kind, size))
    }
}

impl Shaped {
    fn new(scene: &Scene, names: [&str; 3]) -> Result<Self, EnvError> {
        let [geom, top, bottom] = names.map(|name| scene.geom(name));
        let (geom, top, bottom) = (geom?, top?, bottom?);
        let height = |geom: GeomId| scene.model.geom_pos[geom.index()];
        Ok(Shaped { geom, top, bottom, length: crate::rotation::norm(&sub(height(top), height(bottom))) })
    }

    /// Direction of the axis; in the original not of unit length, because it keeps the distance that the model began with.
    fn axis(&self, view: &View<'_>) -> [f64; 3] {
        let place = |geom| *view.data.geom(geom).xpos();
        scale(sub(place(self.top), place(self.bottom)), 1.0 / self.length)
    }
}

impl ShapeReorient {
    /// Gives object and target a shape, and the target an orientation.
    fn take_shape(&mut self, scene: &mut Scene, rng: &mut Rng) -> Result<(), EnvError> {
        let (kind, size) = self.shapes.draw(rng, self.large)?;
        let [x, y] = ANGLES;
        let euler = [rng.uniform(x[0], x[1])?, rng.uniform(y[0], y[1])?, 0.0];
        let end = match kind {
            GeomType::Capsule => CAPSULE_END * size[1],
            GeomType::Cylinder => size[1],
            _ => size[2],
        };
        scene.edit(self.compat, |m| {
            for shaped in &self.shaped {
                m.geom_type[shaped.geom.index()] = kind as i32;
                m.geom_size[shaped.geom.index()] = size;
                m.geom_pos[shaped.top.index()] = [0.0, 0.0, end];
                m.geom_pos[shaped.bottom.index()] = [0.0, 0.0, -end];
            }
            m.body_mass[self.object.index()] = MASS;
            if self.compat == Compat::Fixed {
                m.body_inertia[self.object.index()] = inertia(kind, size, MASS, false);
            }
            if self.large {
                m.geom_condim[self.shaped[0].geom.index()] = 3;
            }
            m.body_quat[self.target.index()] = quat_of_euler(euler);
        })?;
        if self.compat == Compat::Fixed {
            self.shaped.iter_mut().for_each(|shaped| shaped.length = 2.0 * end);
        }
        Ok(())
    }
}

impl Task for ShapeReorient {
    fn defaults(&self) -> Defaults {
        let rows = [
            "hand_jnt",
            "obj_pos",
            "obj_vel",
            "obj_rot",
            "obj_des_rot",
            "obj_err_pos",
            "obj_err_rot",
            "mlen",
            "mvel",
            "mforce",
        ];
        self.muscles.defaults(&rows, &turning::WEIGHTS)
    }

    fn initial_pose(&self, _: &Scene, pose: &mut Pose) -> Result<(), EnvError> {
        turning::open_hand(&mut pose.qpos);
        Ok(())
    }

    fn reset(&mut self, episode: &mut Episode<'_>) -> Result<(), EnvError> {
        self.muscles.rest(episode.scene)?;
        self.take_shape(episode.scene, episode.rng)
    }

    fn act(&mut self, turn: &mut Turn<'_>) -> Result<(), EnvError> {
        self.muscles.drive(turn)
    }

    fn observe(&self, view: &View<'_>, rows: &mut Rows) {
        let [axis, target] = self.shaped.map(|shaped| shaped.axis(view));
        let position = *view.data.body(self.object).xpos();
        let place = *view.data.site(self.place).xpos();
        turning::observe(view, Placement { position, place, axis, target }, rows);
        observe_activations(view, rows);
        rows.set("mlen", "m", &view.data.trn.actuator_length);
        rows.set("mvel", "m/s", &view.data.vel.actuator_velocity);
        rows.set("mforce", "N", &view.data.actuation.actuator_force);
    }

    fn reward(&self, _: &View<'_>, rows: &Rows, terms: &mut Rows) -> Verdict {
        turning::reward(rows, terms)
    }

    fn keep(&mut self, keeper: &mut Keeper) {
        self.muscles.keep(keeper);
        self.shaped.iter_mut().for_each(|shaped| keeper.number(&mut shaped.length));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_collection_has_whole_sizes() {
        let collections: Table = include_str!("shapes.toml").parse().unwrap();
        let counts = collections.into_iter().map(|(name, collection)| {
            let shapes: Shapes = collection.try_into().unwrap();
            let all = [shapes.capsule, shapes.ellipsoid, shapes.cylinder, shapes.cuboid];
            assert!(all.iter().flatten().all(|size| (0.005..0.06).contains(size)), "{name}");
            (name, all.map(|sizes| sizes.len()))
        });
        let expected = [
            ("geometries8", 6),
            ("geometries100", 75),
            ("in_distribution", 750),
            ("out_of_distribution", 750),
        ];
        assert!(counts.eq(expected.map(|(name, count)| (name.to_string(), [count; 4]))));
    }
}
