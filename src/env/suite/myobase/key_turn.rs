//! Turning a key between thumb and index finger.

use crate::error::EnvError;
use crate::rotation::norm;
use crate::rows::Rows;
use crate::scene::Scene;
use crate::suite::muscle::{Condition, Muscles, effort, observe_activations};
use crate::task::{Defaults, Episode, Pose, Setup, Task, Turn, Verdict, View};
use physics::elements::{BodyId, SiteId};
use physics::math::{add, sub};
use robot::Keeper;
use serde::Deserialize;
use std::f64::consts::{FRAC_PI_2, PI};

/// Distance \[m\] at which a finger tip touches the head of the key.
const TOUCH: f64 = 0.03;
/// Beyond this distance \[m\] from touching the episode ends.
const FAR: f64 = 0.1;
/// How far \[m\] the key may stand from its place along each axis.
const OFFSET: [f64; 3] = [0.01; 3];

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Args {
    #[serde(default = "goal_th")]
    goal_th: f64,
    #[serde(default)]
    key_init_range: [f64; 2],
    #[serde(default)]
    muscle_condition: Condition,
}

#[expect(clippy::approx_constant, reason = "RoboHive says 3.14, which is less than π")]
fn goal_th() -> f64 {
    3.14
}

#[derive(Clone)]
pub struct KeyTurn {
    muscles: Muscles,
    head: SiteId,
    index: SiteId,
    thumb: SiteId,
    key: BodyId,
    /// Where the key stands at first \[m\].
    place: [f64; 3],
    /// Angles \[rad\] of the key that episodes start with.
    starts: [f64; 2],
    /// Angle \[rad\] beyond which the key has been turned.
    goal: f64,
}

impl KeyTurn {
    /// The task with these settings.
    ///
    /// # Errors
    /// Settings do not fit, or elements are missing.
    pub fn new(args: Args, setup: &mut Setup<'_>) -> Result<Self, EnvError> {
        let muscles = Muscles::new(args.muscle_condition, setup)?;
        let scene = &*setup.scene;
        let head = scene.site("keyhead")?;
        Ok(KeyTurn {
            muscles,
            head,
            index: scene.site("IFtip")?,
            thumb: scene.site("THtip")?,
            key: scene.body("key")?,
            place: *scene.data.site(head).xpos(),
            starts: args.key_init_range,
            goal: args.goal_th,
        })
    }
}

impl Task for KeyTurn {
    fn defaults(&self) -> Defaults {
        let rows = ["hand_qpos", "hand_qvel", "key_qpos", "key_qvel", "IFtip_approach", "THtip_approach"];
        let weights = [
            ("key_turn", 1.0),
            ("IFtip_approach", 10.0),
            ("THtip_approach", 10.0),
            ("act_reg", 1.0),
            ("bonus", 4.0),
            ("penalty", 25.0),
        ];
        self.muscles.defaults(&rows, &weights)
    }

    fn initial_pose(&self, scene: &Scene, pose: &mut Pose) -> Result<(), EnvError> {
        pose.qpos[..scene.model.nq - 1].fill(0.0);
        Ok(())
    }

    fn reset(&mut self, episode: &mut Episode<'_>) -> Result<(), EnvError> {
        self.muscles.rest(episode.scene)?;
        let [low, high] = self.starts;
        let key = episode.start.qpos.len() - 1;
        episode.start.qpos[key] = episode.rng.uniform(low, high)?;
        if low < high {
            let mut offset = [0.0; 3];
            episode.rng.fill_uniform_each(&OFFSET.map(|x| -x), &OFFSET, &mut offset)?;
            episode.scene.overwrite(|m| m.body_pos[self.key.index()] = add(self.place, offset))?;
        }
        Ok(())
    }

    fn act(&mut self, turn: &mut Turn<'_>) -> Result<(), EnvError> {
        self.muscles.drive(turn)
    }

    fn observe(&self, view: &View<'_>, rows: &mut Rows) {
        let state = &view.data.state;
        let (hand, key) = (view.model.nq - 1, view.model.nv - 1);
        rows.set("hand_qpos", "rad", &state.qpos[..hand]);
        rows.set("hand_qvel", "rad", state.qvel[..key].iter().map(|velocity| velocity * view.dt));
        rows.set("key_qpos", "rad", &state.qpos[hand..]);
        rows.set("key_qvel", "rad", [state.qvel[key] * view.dt]);
        let head = *view.data.site(self.head).xpos();
        for (name, tip) in [("IFtip_approach", self.index), ("THtip_approach", self.thumb)] {
            rows.set(name, "m", sub(head, *view.data.site(tip).xpos()));
        }
        observe_activations(view, rows);
    }

    fn reward(&self, _: &View<'_>, rows: &Rows, terms: &mut Rows) -> Verdict {
        let [index, thumb] =
            ["IFtip_approach", "THtip_approach"].map(|name| (norm(&rows[name]) - TOUCH).abs());
        let angle = rows["key_qpos"][0];
        let turned = |threshold| f64::from(angle > threshold);
        let off = |distance| f64::from(distance > FAR / 2.0);
        terms.set("key_turn", "rad", [angle]);
        terms.set("IFtip_approach", "m", [-index]);
        terms.set("THtip_approach", "m", [-thumb]);
        terms.set("act_reg", "", [-effort(rows)]);
        terms.set("bonus", "", [turned(FRAC_PI_2) + turned(PI)]);
        terms.set("penalty", "", [-off(index) - off(thumb)]);
        Verdict { sparse: angle, solved: angle > self.goal, done: index > FAR || thumb > FAR }
    }

    fn keep(&mut self, keeper: &mut Keeper) {
        self.muscles.keep(keeper);
    }
}
