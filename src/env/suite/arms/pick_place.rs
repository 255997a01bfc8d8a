//! Picking and placing: one of three objects in a bin is to come into the other bin. Objects can be of random shapes.

use super::delivery::{Delivery, Names};
use crate::draws::Ranges;
use crate::draws::Rng;
use crate::error::EnvError;
use crate::rotation::quat_of_euler;
use crate::rows::Rows;
use crate::task::{Defaults, Episode, Setup, Task, Verdict, View};
use physics::elements::BodyId;
use physics::math::{Quat, Vec3, add};
use physics::model::GeomType;
use robot::Compat;
use serde::Deserialize;
use std::f64::consts::FRAC_PI_2;
use std::ops::Range;

/// The objects; settings name the site of the one to be delivered.
const OBJECTS: [&str; 3] = ["obj0", "obj1", "obj2"];

/// Half of the width \[m\] of the box that an object's place is drawn from.
const JITTER: f64 = 0.01;

/// Shapes to choose from.
const SHAPES: [GeomType; 5] =
    [GeomType::Sphere, GeomType::Capsule, GeomType::Ellipsoid, GeomType::Cylinder, GeomType::Box];

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Args {
    robot_ndof: usize,
    robot_site_name: String,
    object_site_name: String,
    target_site_name: String,
    target_xyz_range: Ranges,
    #[serde(default)]
    randomize: bool,
    geom_sizes: Option<Ranges>,
}

/// An object on a free joint.
#[derive(Clone)]
struct Object {
    body: BodyId,
    /// Its place in the model file \[m\].
    place: Vec3,
    geoms: Vec<usize>,
    /// Where its pose stands in `qpos`.
    pose: Range<usize>,
}

/// What was drawn for an object.
struct Draw {
    pos: Vec3,
    quat: Quat,
    geoms: Vec<Shape>,
}

/// What was drawn for a geom.
struct Shape {
    kind: GeomType,
    size: Vec3,
    pos: Vec3,
    quat: Quat,
    rgba: [f64; 4],
}

#[derive(Clone)]
pub struct PickPlace {
    delivery: Delivery,
    targets: Ranges,
    objects: Vec<Object>,
    /// Sizes of random shapes; `None` leaves the objects as they are.
    sizes: Option<Ranges>,
    compat: Compat,
}

impl PickPlace {
    /// The task with these settings.
    ///
    /// # Errors
    /// Settings, sites or bodies are missing.
    pub fn new(args: Args, setup: &mut Setup<'_>) -> Result<Self, EnvError> {
        let names = Names {
            robot_ndof: args.robot_ndof,
            robot_site_name: &args.robot_site_name,
            object_site_name: &args.object_site_name,
            target_site_name: &args.target_site_name,
        };
        let sizes = match (args.randomize, args.geom_sizes) {
            (true, None) => {
                return Err(setup.wrong("geom_sizes is missing, from which randomize draws"));
            }
            (true, sizes) => sizes,
            (false, _) => None,
        };
        Ok(PickPlace {
            delivery: Delivery::new(setup.spec, setup.scene, &names)?,
            targets: args.target_xyz_range,
            objects: OBJECTS.iter().map(|name| object(setup, name)).collect::<Result<_, _>>()?,
            sizes,
            compat: setup.compat,
        })
    }
}

fn object(setup: &Setup<'_>, name: &str) -> Result<Object, EnvError> {
    let body = setup.scene.body(name)?;
    let model = &setup.scene.model;
    let view = model.body(body);
    let mut joints = view.joints().map(|joint| model.joint(joint).qpos_range());
    let pose = joints
        .next()
        .filter(|pose| pose.len() == 7)
        .ok_or_else(|| setup.wrong(format!("the body {name} needs a free joint")))?;
    let geoms = view.geoms().map(|geom| geom.index()).collect();
    Ok(Object { body, place: view.pos(), geoms, pose })
}

fn symmetric<const N: usize>(rng: &mut Rng, half: [f64; N]) -> Result<[f64; N], EnvError> {
    Ranges { low: half.map(|x| -x), high: half }.draw(rng)
}

impl PickPlace {
    fn draw(&self, rng: &mut Rng, object: &Object, sizes: &Ranges) -> Result<Draw, EnvError> {
        let jitter = match self.compat {
            Compat::RoboHive07 => Ranges { low: [-JITTER; 3], high: [-JITTER; 3] },
            Compat::Fixed => Ranges { low: [-JITTER; 3], high: [JITTER; 3] },
        };
        let pos = add(object.place, jitter.draw(rng)?);
        let quat = quat_of_euler(symmetric(rng, [FRAC_PI_2; 3])?);
        let shape = |_: &usize| -> Result<Shape, EnvError> {
            let kind = *rng.choose(&SHAPES)?;
            let size = sizes.draw(rng)?;
            Ok(Shape {
                kind,
                size,
                pos: symmetric(rng, size)?,
                quat: quat_of_euler(symmetric(rng, [FRAC_PI_2; 3])?),
                rgba: Ranges { low: [0.2, 0.2, 0.2, 1.0], high: [0.9, 0.9, 0.9, 1.0] }.draw(rng)?,
            })
        };
        Ok(Draw { pos, quat, geoms: object.geoms.iter().map(shape).collect::<Result<_, _>>()? })
    }

    /// Gives the objects their shapes and places. The free joints decide where the bodies are; the original writes the
    /// places to the bodies, where nothing reads them, and leaves bounds of the geoms as they were.
    fn place(&self, episode: &mut Episode<'_>, draws: &[Draw]) -> Result<(), EnvError> {
        let drawn = || self.objects.iter().zip(draws);
        episode.scene.edit(self.compat, |m| {
            for (object, draw) in drawn() {
                for (geom, shape) in object.geoms.iter().zip(&draw.geoms) {
                    m.geom_type[*geom] = shape.kind as i32;
                    m.geom_size[*geom] = shape.size;
                    m.geom_pos[*geom] = shape.pos;
                    m.geom_quat[*geom] = shape.quat;
                    m.geom_rgba[*geom] = shape.rgba.map(|channel| channel as f32);
                }
            }
        })?;
        match self.compat {
            Compat::RoboHive07 => episode.scene.overwrite(|m| {
                for (object, draw) in drawn() {
                    m.body_pos[object.body.index()] = draw.pos;
                    m.body_quat[object.body.index()] = draw.quat;
                }
            }),
            Compat::Fixed => {
                for (object, draw) in drawn() {
                    let pose = &mut episode.start.qpos[object.pose.clone()];
                    pose[..3].copy_from_slice(&draw.pos);
                    pose[3..].copy_from_slice(&draw.quat);
                }
                Ok(())
            }
        }
    }
}

impl Task for PickPlace {
    fn defaults(&self) -> Defaults {
        match self.compat {
            Compat::RoboHive07 => Delivery::defaults(),
            Compat::Fixed => Delivery::defaults().proprio(&Delivery::PROPRIO),
        }
    }

    fn reset(&mut self, episode: &mut Episode<'_>) -> Result<(), EnvError> {
        if self.sizes.is_some() || self.compat == Compat::Fixed {
            let target = self.targets.draw(episode.rng)?;
            episode.scene.overwrite(|m| m.site_pos[self.delivery.target.index()] = target)?;
        }
        let Some(sizes) = &self.sizes else { return Ok(()) };
        let draw = |object| self.draw(episode.rng, object, sizes);
        let draws: Vec<Draw> = self.objects.iter().map(draw).collect::<Result<_, _>>()?;
        self.place(episode, &draws)
    }

    fn observe(&self, view: &View<'_>, rows: &mut Rows) {
        self.delivery.observe(view, rows);
    }

    fn reward(&self, _: &View<'_>, rows: &Rows, terms: &mut Rows) -> Verdict {
        Delivery::reward(self.compat, rows, terms)
    }
}
