//! Holding an object at a goal.

use crate::draws::Rng;
use crate::error::EnvError;
use crate::rotation::norm;
use crate::rows::Rows;
use crate::scene::Scene;
use crate::suite::muscle::{Condition, Muscles, effort, observe_activations};
use crate::task::{Defaults, Episode, Pose, Setup, Task, Turn, Verdict, View};
use physics::elements::{BodyId, GeomId, SiteId};
use physics::geometry::shape::{inertia, volume};
use physics::math::{add, sub};
use physics::model::GeomType;
use robot::{Compat, Keeper};
use serde::Deserialize;

/// Distance \[m\] within which the object is at the goal.
const NEAR: f64 = 0.01;
/// Beyond this distance \[m\] it has been dropped.
const DROPPED: f64 = 0.3;
/// Angle \[rad\] of the forearm that turns the palm up.
const PALM_UP: f64 = -1.5;
/// How far \[m\] a goal may be from where the object starts, along each axis.
const OFFSET: [f64; 3] = [0.03; 3];
/// Half axes \[m\] of the object, lowest and highest.
const SIZES: [[f64; 3]; 2] = [[0.02; 3], [0.03; 3]];
/// Positions and degrees of freedom of the object, behind the hand's.
const OBJECT: [usize; 2] = [7, 6];

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Args {
    /// Whether goals and objects are drawn.
    #[serde(default)]
    randomize: bool,
    #[serde(default)]
    muscle_condition: Condition,
}

#[derive(Clone)]
pub struct ObjectHold {
    muscles: Muscles,
    object: SiteId,
    goal: SiteId,
    body: BodyId,
    geom: GeomId,
    /// Where the object starts \[m\].
    place: [f64; 3],
    randomize: bool,
    /// Density of the object \[kg/m³\].
    density: f64,
    compat: Compat,
}

impl ObjectHold {
    /// The task with these settings.
    ///
    /// # Errors
    /// Settings do not fit, or elements are missing.
    pub fn new(args: Args, setup: &mut Setup<'_>) -> Result<Self, EnvError> {
        let muscles = Muscles::new(args.muscle_condition, setup)?;
        let scene = &*setup.scene;
        let (object, body, geom) = (scene.site("object")?, scene.body("object")?, scene.geom("object")?);
        let size = scene.model.geom_size[geom.index()];
        Ok(ObjectHold {
            muscles,
            object,
            goal: scene.site("goal")?,
            body,
            geom,
            place: *scene.data.site(object).xpos(),
            randomize: args.randomize,
            density: scene.model.body_mass[body.index()] / volume(GeomType::Ellipsoid, size, false),
            compat: setup.compat,
        })
    }

    /// Draws where the goal is, and how large the object.
    fn draw(&self, scene: &mut Scene, rng: &mut Rng) -> Result<(), EnvError> {
        let (mut offset, mut size) = ([0.0; 3], [0.0; 3]);
        rng.fill_uniform_each(&OFFSET.map(|x| -x), &OFFSET, &mut offset)?;
        rng.fill_uniform_each(&SIZES[0], &SIZES[1], &mut size)?;
        scene.edit(self.compat, |m| {
            m.site_pos[self.goal.index()] = add(self.place, offset);
            m.site_size[self.goal.index()] = size;
            m.geom_size[self.geom.index()] = size;
            if self.compat == Compat::Fixed {
                let mass = self.density * volume(GeomType::Ellipsoid, size, false);
                m.body_mass[self.body.index()] = mass;
                m.body_inertia[self.body.index()] = inertia(GeomType::Ellipsoid, size, mass, false);
            }
        })
    }
}

impl Task for ObjectHold {
    fn defaults(&self) -> Defaults {
        let weights = [("goal_dist", 100.0), ("bonus", 4.0), ("penalty", 10.0)];
        self.muscles.defaults(&["hand_qpos", "hand_qvel", "obj_pos", "obj_err"], &weights)
    }

    fn initial_pose(&self, scene: &Scene, pose: &mut Pose) -> Result<(), EnvError> {
        pose.qpos[..scene.model.nq - OBJECT[0]].fill(0.0);
        pose.qpos[0] = PALM_UP;
        Ok(())
    }

    fn reset(&mut self, episode: &mut Episode<'_>) -> Result<(), EnvError> {
        self.muscles.rest(episode.scene)?;
        if self.randomize {
            self.draw(episode.scene, episode.rng)?;
        }
        Ok(())
    }

    fn act(&mut self, turn: &mut Turn<'_>) -> Result<(), EnvError> {
        self.muscles.drive(turn)
    }

    fn observe(&self, view: &View<'_>, rows: &mut Rows) {
        let state = &view.data.state;
        let (positions, dofs) = (view.model.nq - OBJECT[0], view.model.nv - OBJECT[1]);
        rows.set("hand_qpos", "rad", &state.qpos[..positions]);
        rows.set("hand_qvel", "rad", state.qvel[..dofs].iter().map(|velocity| velocity * view.dt));
        let object = *view.data.site(self.object).xpos();
        rows.set("obj_pos", "m", object);
        rows.set("obj_err", "m", sub(*view.data.site(self.goal).xpos(), object));
        observe_activations(view, rows);
    }

    fn reward(&self, _: &View<'_>, rows: &Rows, terms: &mut Rows) -> Verdict {
        let distance = norm(&rows["obj_err"]);
        let within = |threshold| f64::from(distance < threshold);
        let dropped = distance > DROPPED;
        terms.set("goal_dist", "m", [-distance]);
        terms.set("bonus", "", [within(2.0 * NEAR) + within(NEAR)]);
        terms.set("act_reg", "", [-effort(rows)]);
        terms.set("penalty", "", [-f64::from(dropped)]);
        Verdict { sparse: -distance, solved: distance < NEAR, done: dropped }
    }

    fn keep(&mut self, keeper: &mut Keeper) {
        self.muscles.keep(keeper);
    }
}
