//! Two hands that slides and a hinge move: the one with the load comes over the edge of the other's palm and tips the load into it, stage
//! by stage.

use crate::controller::{Controller, command};
use crate::error::ControlError;
use crate::maths::MinimumJerk;
use crate::tasks::joints::{between, servo_of};
use crate::tasks::roles::roles_of;
use env::Env;
use env::team::prefix;
use physics::elements::{BodyId, JointId, SiteId};
use physics::math::{Vec3, add, cross, dot, normalize, scale, sub};
use physics::model::JointType;

/// Distance between the middles of the palms when the load is tipped over: to the side, and in height \[m\].
const BESIDE: f64 = 0.08;
const BELOW: f64 = 0.085;
/// How far the giver's palm is turned to tip the load, and that of the receiver to let it slide to the thumb \[rad\].
const TIP: f64 = 1.2;
const LEAN: f64 = 0.25;
/// How long the giver takes to tip the load \[s\].
const TIPPING: f64 = 1.6;
/// How long the hands stay at the end, again and again \[s\].
const LAST: f64 = 1.0;
/// How far the giver goes back \[m\].
const BACK: f64 = 0.12;

/// A joint that moves a hand.
#[derive(Clone, Copy)]
struct Drive {
    joint: JointId,
    place: usize,
    control: usize,
}

/// A hand.
struct Hand {
    palm: SiteId,
    slides: Vec<Drive>,
    roll: Drive,
}

/// The controller.
pub struct PairHands {
    /// The giver, and the receiver.
    hands: [Hand; 2],
    load: BodyId,
    stage: usize,
    motion: Option<MinimumJerk>,
    began: f64,
    until: f64,
    /// Where all joints are to be at the end of the stage, by their controls.
    goal: Vec<f64>,
    controls: Vec<f64>,
}

impl Hand {
    fn new(env: &Env, agent: &str, controls: &mut [f64]) -> Result<Self, ControlError> {
        let (scene, m) = (env.scene(), &env.scene().model);
        let told = |error: robot::ConfigError| ControlError::unfit(env, error.to_string());
        let (roles, prefix) = (roles_of(env)?, prefix(agent));
        let body = roles.cast(m, &prefix, "pair_hands");
        let (palm, mount) = (body.palm().map_err(told)?, scene.body(&format!("{prefix}mount"))?);
        let drive = |joint: JointId| {
            let (control, servo) = servo_of(m, joint)?;
            Some(Drive { joint, place: servo.place, control })
        };
        let drives = between(m, mount, palm).into_iter().filter_map(drive);
        let slides = |drive: &Drive| m.jnt_type[drive.joint.index()] == JointType::Slide as i32;
        let (slides, rolls): (Vec<Drive>, Vec<Drive>) = drives.partition(slides);
        let [roll] = rolls[..] else {
            return Err(ControlError::unfit(
                env,
                format!("{} hinges turn the hand {agent}, not one", rolls.len()),
            ));
        };
        // Fingers stay as the cradle has them.
        let mut cradle = m.qpos0.to_vec();
        body.pose("cradle", &mut cradle).map_err(told)?;
        for joint in body.joints_of("cradle").map_err(told)? {
            if let Some((control, servo)) = servo_of(m, joint) {
                controls[control] = cradle[servo.place];
            }
        }
        Ok(Hand { palm, slides, roll })
    }
}

impl PairHands {
    /// The controller of a task for two hands, of which the first has the load.
    ///
    /// # Errors
    /// An environment for another number of agents; a hand that no hinge or several turn; a model without a body `load`.
    pub fn new(env: &Env) -> Result<Self, ControlError> {
        let agents = env.team().map_or(&[][..], |team| team.agents());
        let [giver, receiver] = agents else {
            return Err(ControlError::unfit(env, format!("it has {} agents, not two", agents.len())));
        };
        let mut controls = vec![0.0; env.scene().model.nu];
        Ok(PairHands {
            hands: [
                Hand::new(env, giver.name(), &mut controls)?,
                Hand::new(env, receiver.name(), &mut controls)?,
            ],
            load: env.scene().body("load")?,
            stage: 0,
            motion: None,
            began: 0.0,
            until: 0.0,
            goal: controls.clone(),
            controls,
        })
    }

    /// Moves a palm by a way \[m\] from where it is.
    fn shift(&mut self, env: &Env, number: usize, way: Vec3) {
        let d = &env.scene().data;
        for drive in &self.hands[number].slides {
            self.goal[drive.control] = d.state.qpos[drive.place] + dot(way, d.kin.xaxis[drive.joint.index()]);
        }
    }

    /// Turns a palm by an angle \[rad\] from level, towards a side.
    fn tilt(&mut self, env: &Env, number: usize, side: Vec3, angle: f64) {
        let hand = &self.hands[number];
        let axis = env.scene().data.kin.xaxis[hand.roll.joint.index()];
        self.goal[hand.roll.control] = angle * dot(cross(axis, [0.0, 0.0, 1.0]), side).signum();
    }

    /// Begins a stage: where hands are to be at its end. Returns its length \[s\].
    fn begin(&mut self, env: &Env) -> f64 {
        let d = &env.scene().data;
        let [giver, receiver] = [0, 1].map(|k| d.kin.site_xpos[self.hands[k].palm.index()]);
        // Level, across the fingers of the giver, towards the receiver.
        let along = d.kin.xaxis[self.hands[0].roll.joint.index()];
        let across = normalize(cross([0.0, 0.0, 1.0], along)).0;
        let way = sub(receiver, giver);
        let side = scale(across, dot(way, across).signum());
        match self.stage {
            0 => {
                // The load comes before the middle of the receiver's palm.
                let load = dot(sub(d.kin.xpos[self.load.index()], giver), along);
                let apart = add(scale(side, BESIDE), [0.0, 0.0, -BELOW]);
                let lacks = sub(add(apart, scale(along, load)), way);
                self.shift(env, 0, scale(lacks, -0.5));
                self.shift(env, 1, scale(lacks, 0.5));
                self.tilt(env, 1, side, LEAN);
                1.5
            }
            1 => {
                self.tilt(env, 0, side, TIP);
                TIPPING
            }
            2 => 0.5,
            3 => {
                self.shift(env, 0, add(scale(side, -BACK), [0.0, 0.0, BACK]));
                1.0
            }
            4 => {
                self.tilt(env, 0, side, 0.0);
                self.tilt(env, 1, side, 0.0);
                1.0
            }
            _ => LAST,
        }
    }
}

impl Controller for PairHands {
    fn reset(&mut self, env: &Env, _: u64) -> Result<(), ControlError> {
        let d = &env.scene().data;
        for drive in self.hands.iter().flat_map(|hand| hand.slides.iter().chain([&hand.roll])) {
            self.goal[drive.control] = d.state.qpos[drive.place];
        }
        self.controls.clone_from(&self.goal);
        (self.stage, self.until, self.motion) = (0, d.time(), None);
        Ok(())
    }

    fn act(&mut self, env: &Env, action: &mut [f64]) -> Result<(), ControlError> {
        let now = env.scene().data.time();
        if now >= self.until - 1e-9 {
            let from = self.goal.clone();
            let seconds = self.begin(env);
            self.motion = Some(MinimumJerk::between(&from, &self.goal, seconds)?);
            (self.began, self.until) = (now, now + seconds);
            self.stage += 1;
        }
        if let Some(motion) = &self.motion {
            motion.position(now + env.dt() - self.began, &mut self.controls);
        }
        command(env, &self.controls, action)
    }
}
