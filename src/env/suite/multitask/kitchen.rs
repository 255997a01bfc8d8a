//! A kitchen: knobs, doors, a light, a microwave and a kettle.

use super::chore::{Args, Chore};
use crate::draws::Ranges;
use crate::error::EnvError;
use crate::rows::Rows;
use crate::scene::Scene;
use crate::task::{Defaults, Episode, Pose, Setup, Task, Verdict, View};
use physics::math::{Vec3, add};
use robot::Keeper;
use serde::Deserialize;
use toml::{Table, Value};

/// Joints of the objects, and the site at which each is moved.
const OBJECTS: [(&str, &str); 15] = [
    ("knob1_joint", "knob1_site"),
    ("knob2_joint", "knob2_site"),
    ("knob3_joint", "knob3_site"),
    ("knob4_joint", "knob4_site"),
    ("lightswitch_joint", "light_site"),
    ("slidedoor_joint", "slide_site"),
    ("leftdoorhinge", "leftdoor_site"),
    ("rightdoorhinge", "rightdoor_site"),
    ("micro0joint", "microhandle_site"),
    ("kettle0:Tx", "kettle_site0"),
    ("kettle0:Ty", "kettle_site0"),
    ("kettle0:Tz", "kettle_site0"),
    ("kettle0:Rx", "kettle_site0"),
    ("kettle0:Ry", "kettle_site0"),
    ("kettle0:Rz", "kettle_site0"),
];

/// The settings that chores elsewhere do not have.
const OWN: [&str; 2] = ["robot_jnt_reset_noise_scale", "robot_base_reset_range"];

#[derive(Deserialize)]
struct Randomness {
    /// Share of a robot joint's span over which it starts.
    #[serde(default)]
    robot_jnt_reset_noise_scale: f64,
    /// Where the robot stands from its place in the model \[m\].
    robot_base_reset_range: Option<Ranges>,
}

#[derive(Clone)]
pub struct Kitchen {
    chore: Chore,
    noise: f64,
    shift: Option<Ranges>,
    /// The robot's place in the model \[m\].
    place: Vec3,
}

impl Kitchen {
    /// The task with these settings.
    ///
    /// # Errors
    /// Settings do not fit; elements are missing.
    pub fn new(own: Table, setup: &mut Setup<'_>) -> Result<Self, EnvError> {
        let (random, mut shared): (Table, Table) =
            own.into_iter().partition(|(key, _)| OWN.contains(&key.as_str()));
        let random: Randomness = setup.spec.task_args(random)?;
        let names = |names: Vec<&str>| Value::Array(names.into_iter().map(Value::from).collect());
        let (joints, sites) = OBJECTS.into_iter().unzip();
        shared.entry("obj_jnt_names").or_insert_with(|| names(joints));
        shared.entry("obj_interaction_site").or_insert_with(|| names(sites));
        let args: Args = setup.spec.task_args(shared)?;
        let chore = Chore::new(&args, setup)?;
        Ok(Kitchen {
            place: setup.scene.model.body_pos[chore.base.index()],
            chore,
            noise: random.robot_jnt_reset_noise_scale,
            shift: random.robot_base_reset_range,
        })
    }
}

impl Task for Kitchen {
    fn defaults(&self) -> Defaults {
        self.chore.defaults(&["robot_jnt", "objs_jnt", "obj_goal", "ee_pose"], true)
    }

    fn initial_pose(&self, scene: &Scene, pose: &mut Pose) -> Result<(), EnvError> {
        self.chore.initial_pose(scene, pose)
    }

    fn reset(&mut self, episode: &mut Episode<'_>) -> Result<(), EnvError> {
        self.chore.shake(self.noise, episode.rng, episode.start);
        if let Some(shift) = &self.shift {
            let place = add(self.place, shift.draw(episode.rng)?);
            episode.scene.overwrite(|m| m.body_pos[self.chore.base.index()] = place)?;
        }
        Ok(())
    }

    fn observe(&self, view: &View<'_>, rows: &mut Rows) {
        self.chore.observe(view, rows);
    }

    fn reward(&self, _: &View<'_>, rows: &Rows, terms: &mut Rows) -> Verdict {
        self.chore.reward(rows, terms)
    }

    fn constant_rows(&self) -> Vec<String> {
        self.chore.constant_rows()
    }

    fn keep(&mut self, keeper: &mut Keeper) {
        self.chore.keep(keeper);
    }
}
