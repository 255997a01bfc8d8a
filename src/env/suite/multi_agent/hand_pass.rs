//! Two hands, each on slides and a hinge, of which the left one has a cube on its palm and is to pass it to the palm of the right one
//! (Chen et al., "Towards human-level bimanual dexterous manipulation with reinforcement learning", 2022, has hands that throw).
//!
//! Each observes, in the frame in which its slides move \[m\], its palm (`palm`) and the direction that it faces (`palm_up`), the way
//! from there to the other palm (`mate_error`) and to the load (`load_error`), and velocity \[m/s\] and two axes of the load; `touch` is
//! 1 while it touches the load. Solved: the load is at rest within `radius` of the right palm and touches nothing but that hand. A load
//! that falls ends the episode.

use super::limb::Limb;
use super::part::{Part, STEPS, defaults, team};
use crate::error::EnvError;
use crate::rows::Rows;
use crate::scene::Scene;
use crate::task::{Defaults, Episode, Pose, Setup, Task, Verdict, View};
use crate::team::{Stakes, Team, prefix};
use physics::Data;
use physics::elements::{BodyId, SiteId};
use physics::math::{Vec3, add_scaled, column, mul_mat_vec, norm, ops, quat_mul, sub};
use physics::model::JointType;
use serde::Deserialize;
use std::ops::Range;

/// Speed at which the load is at rest \[m/s\].
const REST: f64 = 0.03;
/// How far below the palms a load has fallen \[m\].
const FALLEN: f64 = 0.25;
/// Number of the hand that is to have the load.
const RECEIVER: usize = 1;

/// Settings of the task.
#[derive(Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Args {
    /// The roles of both hands.
    roles: String,
    /// Largest difference of a slide from its middle at the start \[m\].
    base_noise: f64,
    /// Largest difference of any joint from the pose `cradle` \[rad\].
    joint_noise: f64,
    /// Largest difference of the load from its place on the palm in each direction \[m\], and of its yaw \[rad\].
    load_noise: [f64; 2],
    /// Distance of the load from the palm in which it lies \[m\].
    radius: f64,
}

/// A hand.
#[derive(Clone)]
struct Hand {
    limb: Limb,
    palm: SiteId,
    /// Its slides: places in `qpos`, and directions in the world.
    slides: Vec<(usize, Vec3)>,
}

/// The task.
#[derive(Clone)]
pub struct HandPass {
    hands: [Hand; 2],
    team: Team,
    load: BodyId,
    /// Where `qpos` has the free joint of the load, and `qvel` its velocity.
    pose: Range<usize>,
    speed: usize,
    home: Vec<f64>,
    /// Height below which the load has fallen \[m\].
    floor: f64,
    args: Args,
}

impl HandPass {
    /// The task with these settings.
    ///
    /// # Errors
    /// The model does not fill the roles of `left` and `right`, or lacks the body on which a hand moves (`left_mount`) or a body `load`
    /// with a free joint.
    pub fn new(args: Args, setup: &mut Setup<'_>) -> Result<Self, EnvError> {
        let part = |name| Part {
            name,
            rows: &["palm", "palm_up", "load_error", "load_velocity", "load_axes", "touch"],
            own: &[("reach", 0.5)],
            shared: &[("distance", 1.0), ("passed", 1.0), ("bonus", 2.0), ("dropped", 10.0)],
        };
        let parts = [part("left"), part("right")];
        let (scene, m) = (&*setup.scene, &setup.scene.model);
        let team = team(&parts, &Limb::ROWS, Stakes::Shared, scene)?;
        let roles = setup.roles(&args.roles)?;
        let mut home = m.qpos0.to_vec();
        let mut hand = |part: &Part<'_>| {
            let prefix = prefix(part.name);
            let cast = roles.cast(m, &prefix, "pass from hand to hand");
            cast.pose("cradle", &mut home)?;
            let mount = scene.body(&format!("{prefix}mount"))?;
            let limb = Limb::new(part.name, mount, m);
            let frame = scene.data.kin.xmat[mount.index()];
            let slide =
                |joint: usize| (m.jnt_qposadr[joint] as usize, mul_mat_vec(&frame, m.jnt_axis[joint]));
            let own = |place: &usize| limb.joints.iter().any(|joint| joint.position == *place);
            let slides = (0..m.njnt).filter(|&joint| m.jnt_type[joint] == JointType::Slide as i32);
            let slides = slides.map(slide).filter(|(place, _)| own(place)).collect();
            Ok::<_, EnvError>(Hand { palm: cast.palm()?, slides, limb })
        };
        let hands = [hand(&parts[0])?, hand(&parts[1])?];
        let (load, pose) = setup.loose_body("load")?;
        let speed = m.body_dofadr[load.index()].max(0) as usize;
        let floor = scene.data.site(hands[RECEIVER].palm).xpos()[2] - FALLEN;
        Ok(HandPass { hands, team, load, pose, speed, home, floor, args })
    }

    /// The way from a palm to the load \[m\].
    fn way(&self, d: &Data, hand: &Hand) -> Vec3 {
        sub(d.kin.xpos[self.load.index()], d.kin.site_xpos[hand.palm.index()])
    }

    fn velocity(&self, d: &Data) -> Vec3 {
        [0, 1, 2].map(|i| d.state.qvel[self.speed + i])
    }
}

impl Task for HandPass {
    fn defaults(&self) -> Defaults {
        defaults(&self.team, STEPS)
    }

    fn team(&self) -> Option<&Team> {
        Some(&self.team)
    }

    fn initial_pose(&self, _: &Scene, pose: &mut Pose) -> Result<(), EnvError> {
        pose.qpos.copy_from_slice(&self.home);
        Ok(())
    }

    fn reset(&mut self, episode: &mut Episode<'_>) -> Result<(), EnvError> {
        let (rng, qpos) = (&mut *episode.rng, &mut episode.start.qpos);
        let place = self.pose.start;
        let mut load: Vec3 = [0, 1, 2].map(|i| self.home[place + i]);
        for (k, hand) in self.hands.iter().enumerate() {
            for joint in &hand.limb.joints {
                qpos[joint.position] += self.args.joint_noise * rng.uniform(-1.0, 1.0)?;
            }
            for (place, axis) in &hand.slides {
                qpos[*place] = self.args.base_noise * rng.uniform(-1.0, 1.0)?;
                // The load lies on the palm of the first.
                load = if k == RECEIVER { load } else { add_scaled(load, *axis, qpos[*place]) };
            }
        }
        let [aside, yaw] = self.args.load_noise;
        for part in &mut load[..2] {
            *part += aside * rng.uniform(-1.0, 1.0)?;
        }
        let (sine, cosine) = ops::sincos(yaw * rng.uniform(-1.0, 1.0)? / 2.0);
        let turn = [3, 4, 5, 6].map(|i| self.home[place + i]);
        qpos[place..place + 3].copy_from_slice(&load);
        qpos[place + 3..place + 7].copy_from_slice(&quat_mul([cosine, 0.0, 0.0, sine], turn));
        Ok(())
    }

    fn observe(&self, view: &View<'_>, rows: &mut Rows) {
        let d = view.data;
        let site = |hand: &Hand| d.kin.site_xpos[hand.palm.index()];
        let axes = &d.kin.xmat[self.load.index()];
        for (k, hand) in self.hands.iter().enumerate() {
            let (limb, palm) = (&hand.limb, site(hand));
            let local = |vector: Vec3| limb.local(d, vector);
            let up = column(&d.kin.site_xmat[hand.palm.index()], 2);
            rows.within(&limb.prefix, |rows| {
                limb.observe(d, rows);
                rows.set("palm", "m", local(sub(palm, d.kin.xpos[limb.root.index()])));
                rows.set("palm_up", "", local(up));
                rows.set("mate_error", "m", local(sub(site(&self.hands[1 - k]), palm)));
                rows.set("load_error", "m", local(self.way(d, hand)));
                rows.set("load_velocity", "m/s", local(self.velocity(d)));
                rows.set("load_axes", "", [2, 0].into_iter().flat_map(|axis| local(column(axes, axis))));
                let touches = limb.touching(view, self.load).next().is_some();
                rows.set("touch", "", [f64::from(touches)]);
            });
        }
    }

    fn reward(&self, view: &View<'_>, rows: &Rows, terms: &mut Rows) -> Verdict {
        let (m, d) = (view.model, view.data);
        let to = &self.hands[RECEIVER];
        let distance = norm(self.way(d, to));
        let touch = |hand: &Hand| rows.of(&hand.limb.prefix)["touch"][0] > 0.0;
        let passed = touch(to) && to.limb.alone(m, d, self.load);
        let solved = passed && distance < self.args.radius && norm(self.velocity(d)) < REST;
        let dropped = d.kin.xpos[self.load.index()][2] < self.floor;
        terms.set("distance", "m", [-distance]);
        terms.set("passed", "", [f64::from(passed)]);
        terms.set("bonus", "", [f64::from(solved)]);
        terms.set("dropped", "", [-f64::from(dropped)]);
        for hand in &self.hands {
            let own = rows.of(&hand.limb.prefix);
            let far = norm([0, 1, 2].map(|i| own["mate_error"][i]));
            terms.within(&hand.limb.prefix, |terms| terms.set("reach", "m", [-far]));
        }
        Verdict { sparse: f64::from(solved), solved, done: dropped }
    }

    fn resting_rows(&self) -> Vec<String> {
        self.hands.iter().map(|hand| format!("{}touch", hand.limb.prefix)).collect()
    }
}
