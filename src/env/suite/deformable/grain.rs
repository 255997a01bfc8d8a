//! Grains, and vessels that they lie in.

use crate::draws::Rng;
use crate::error::EnvError;
use crate::rows::Rows;
use crate::task::{Episode, Pose, Setup, View};
use physics::elements::{BodyId, SiteId};
use physics::math::{Vec3, mul_mat_t_vec, sub};
use physics::{Data, Model};

/// How far a grain starts from its place in the scene at most, along each axis \[m\].
const JITTER: f64 = 3e-4;

/// All grains of a scene.
#[derive(Clone)]
pub struct Grains {
    bodies: Vec<BodyId>,
    /// Where `qpos` has the free joint of each.
    joints: Vec<usize>,
    /// Radius of one \[m\].
    pub radius: f64,
}

impl Grains {
    /// The free bodies whose names begin with `grain`.
    ///
    /// # Errors
    /// There are none, or they have no shape.
    pub fn new(setup: &Setup<'_>) -> Result<Self, EnvError> {
        let m = &setup.scene.model;
        let named = m.body_names().filter(|(_, name)| name.starts_with("grain"));
        let bodies: Vec<BodyId> = named.map(|(id, _)| id).collect();
        let free = |grain: &BodyId| {
            let joint = m.body(*grain).joints().next().map(|joint| m.joint(joint).qpos_range());
            joint.filter(|place| place.len() == 7).map(|place| place.start)
        };
        let joints: Option<Vec<usize>> = bodies.iter().map(free).collect();
        let geom = bodies.first().and_then(|grain| usize::try_from(m.body_geomadr[grain.index()]).ok());
        let (joints, geom) =
            joints.zip(geom).ok_or_else(|| setup.wrong("the scene needs free bodies named grain…"))?;
        Ok(Grains { bodies, joints, radius: m.geom_size[geom][0] })
    }

    /// Puts a vessel, and the grains that lie in it, somewhere on the table \[m\], and moves each a little.
    ///
    /// # Errors
    /// A place that is no number.
    pub fn put(&self, vessel: &Vessel, place: [f64; 2], episode: &mut Episode<'_>) -> Result<(), EnvError> {
        let way = vessel.put(place, episode)?;
        self.shift(way, episode.start);
        self.jitter(episode.rng, episode.start)
    }

    /// Moves each a fraction of a millimetre that is drawn.
    ///
    /// # Errors
    /// None that draws of these ranges have.
    pub fn jitter(&self, rng: &mut Rng, pose: &mut Pose) -> Result<(), EnvError> {
        for &joint in &self.joints {
            for place in &mut pose.qpos[joint..joint + 3] {
                *place += rng.uniform(-JITTER, JITTER)?;
            }
        }
        Ok(())
    }

    /// Moves all of them along the table \[m\].
    fn shift(&self, way: [f64; 2], pose: &mut Pose) {
        for &joint in &self.joints {
            for (place, way) in pose.qpos[joint..].iter_mut().zip(way) {
                *place += way;
            }
        }
    }

    /// Where each is \[m\].
    pub fn places(&self, data: &Data) -> impl Iterator<Item = Vec3> {
        self.bodies.iter().map(|grain| data.kin.xpos[grain.index()])
    }

    /// The share of them whose places are as `wanted`.
    pub fn share(&self, data: &Data, wanted: impl Fn(Vec3) -> bool) -> f64 {
        self.places(data).filter(|place| wanted(*place)).count() as f64 / self.bodies.len() as f64
    }

    /// Writes the row `grains`.
    pub fn observe(&self, view: &View<'_>, rows: &mut Rows) {
        rows.set("grains", "m", self.places(view.data).flatten());
    }
}

/// Where a grain is, seen from a vessel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Whereabouts {
    /// In it.
    Inside,
    /// Higher than its rim.
    Over,
    /// Neither.
    Beside,
}

/// A box that is open above: a body, and a site of the same name that is its inside.
#[derive(Clone, Copy)]
pub struct Vessel {
    body: BodyId,
    inside: SiteId,
    /// Where the scene has the body \[m\].
    home: Vec3,
}

impl Vessel {
    /// The vessel of this name.
    ///
    /// # Errors
    /// Its body or its site is missing.
    pub fn new(name: &str, setup: &Setup<'_>) -> Result<Self, EnvError> {
        let (body, inside) = (setup.scene.body(name)?, setup.scene.site(name)?);
        Ok(Vessel { body, inside, home: setup.scene.model.body_pos[body.index()] })
    }

    /// The middle of its inside \[m\].
    pub fn middle(&self, data: &Data) -> Vec3 {
        *data.site(self.inside).xpos()
    }

    /// Its upward axis.
    pub fn up(&self, data: &Data) -> Vec3 {
        let axes = data.site(self.inside).xmat();
        [axes[2], axes[5], axes[8]]
    }

    /// Height of its rim where it stands upright \[m\].
    pub fn rim(&self, m: &Model, data: &Data) -> f64 {
        self.middle(data)[2] + m.site_size[self.inside.index()][2]
    }

    /// Where a place \[m\] is.
    pub fn whereabouts(&self, place: Vec3, m: &Model, data: &Data) -> Whereabouts {
        let half = m.site_size[self.inside.index()];
        let site = data.site(self.inside);
        let local = mul_mat_t_vec(site.xmat(), sub(place, *site.xpos()));
        match local {
            [_, _, z] if z > half[2] => Whereabouts::Over,
            _ if (0..3).all(|i| local[i].abs() < half[i]) => Whereabouts::Inside,
            _ => Whereabouts::Beside,
        }
    }

    /// Puts it somewhere on the table \[m\]. Returns the way there from where the scene has it.
    ///
    /// # Errors
    /// A place that is no number.
    pub fn put(&self, place: [f64; 2], episode: &mut Episode<'_>) -> Result<[f64; 2], EnvError> {
        let body = self.body.index();
        episode.scene.model.edit(|m| m.body_pos[body][..2].copy_from_slice(&place))?;
        Ok([place[0] - self.home[0], place[1] - self.home[1]])
    }
}
