//! An arm that is driven by the target of its hand: inverse kinematics gives the joints.

use crate::error::TeleopError;
use crate::link::{Link, link};
use crate::motion::ArmMotion;
use crate::reached::Reached;
use crate::settings::{ArmSettings, Gains};
use env::Env;
use physics::elements::{ActuatorId, Element, JointId, SiteId};
use physics::math::{
    Quat, Vec3, add, dot, mat_to_quat, normalize, quat_from_axis_angle, quat_mul, quat_normalize, scale, sub,
};
use physics::position::kinematics::kinematics;
use physics::{Data, Model};
use robot::{Pose, Reach, Search};

/// Error below which a target counts as reached \[m, rad\].
const TOLERANCE: f64 = 1e-3;
/// Largest number of updates of a search, which starts from the last solution.
const STEPS: usize = 50;
/// A joint motion below this counts as none \[rad\].
const SMALL: f64 = 1e-3;
/// Damping and largest update \[rad\] of a search, so that it does not drift near the limits of the workspace.
const DAMPING: f64 = 1e-3;
const UPDATE: f64 = 0.5;
/// Fractions of a motion that are tried: near the limits of the workspace a small motion of the hand is a large one of the joints.
const PARTS: [f64; 4] = [1.0, 0.5, 0.25, 0.125];

/// An arm and its target. A copy is sufficient to continue an episode from here.
#[derive(Clone, Debug)]
pub struct Arm {
    site: SiteId,
    links: Vec<Link>,
    joints: Vec<JointId>,
    /// Controls of the gripper.
    gripper: Vec<usize>,
    settings: ArmSettings,
    gains: Gains,
    /// Positions after the reset, to which redundant joints are pulled.
    rest: Vec<f64>,
    /// Commanded positions of the links.
    command: Vec<f64>,
    target: (Vec3, Quat),
    /// The hand moves, and is turned while it does.
    moving: bool,
    turning: bool,
    /// Its motion in the last tick.
    way: Vec3,
    grip: f64,
}

impl Arm {
    /// The arm that moves the site: its joints have actuators; every other actuator belongs to the gripper.
    ///
    /// # Errors
    /// The model has no such site, or nothing that moves it.
    pub fn of(env: &Env, settings: &ArmSettings, gains: Gains) -> Result<Self, TeleopError> {
        Arm::at(env, &settings.sites, "--site", settings, gains)
    }

    /// The first arm, and the left one if the settings name its site. Each has the grippers that are mounted on it; the first also
    /// has those that are mounted on neither.
    ///
    /// # Errors
    /// As [`Arm::of`], or a joint that moves both arms.
    pub fn all_of(env: &Env, settings: &ArmSettings, gains: Gains) -> Result<Vec<Self>, TeleopError> {
        let mut first = Arm::of(env, settings, gains)?;
        if settings.left_sites.is_empty() {
            return Ok(vec![first]);
        }
        let mut left = Arm::at(env, &settings.left_sites, "--left-site", settings, gains)?;
        let model = &env.scene().model;
        let chains = [first.site, left.site].map(|site| chain(model, model.site_bodyid[site.index()]));
        let shared =
            first.links.iter().find(|link| left.links.iter().any(|other| other.control == link.control));
        if let Some(link) = shared {
            let name = model.name_of(JointId::KIND, link.joint.index());
            return Err(missing(format!(
                "the joint {name:?} moves both arms, but they are driven separately: choose sites on separate arms"
            )));
        }
        let links = |arm: &Arm, control: usize| arm.links.iter().any(|link| link.control == control);
        let hangs = |control: usize, chain: &[i32]| hangs(model, control, chain);
        first.gripper.retain(|&k| !links(&left, k) && hangs(k, &chains[0]) >= hangs(k, &chains[1]));
        left.gripper.retain(|&k| !links(&first, k) && hangs(k, &chains[1]) > hangs(k, &chains[0]));
        Ok(vec![first, left])
    }

    /// The arm that moves the first of these sites, which `option` names.
    fn at(
        env: &Env,
        sites: &[String],
        option: &str,
        settings: &ArmSettings,
        gains: Gains,
    ) -> Result<Self, TeleopError> {
        let model = &env.scene().model;
        let Some(site) = sites.iter().find_map(|name| model.site(name)) else {
            let has: Vec<&str> = model.site_names().map(|(_, name)| name).take(12).collect();
            return Err(missing(format!(
                "no hand to move: the model has none of the sites {}; name one by {option}: {}. What has no hand is driven by --control \
                 joints, and a robot on legs by --control base",
                sites.join(", "),
                has.join(", ")
            )));
        };
        let chain = chain(model, model.site_bodyid[site.index()]);
        let (mut links, mut gripper) = (Vec::new(), Vec::new());
        for actuator in model.actuators() {
            let control = usize::try_from(model.actuator_ctrladr[actuator.index()]).ok();
            let Some(control) = control else { continue };
            match link(model, actuator, control)
                .filter(|link| chain.contains(&model.jnt_bodyid[link.joint.index()]))
            {
                Some(link) => links.push(link),
                None => gripper.push(control),
            }
        }
        if links.is_empty() {
            let name = model.name_of(SiteId::KIND, site.index());
            return Err(missing(format!(
                "no actuator moves the site {name:?} through a joint; use --control joints"
            )));
        }
        let joints = links.iter().map(|link| link.joint).collect();
        let mut arm = Arm {
            site,
            joints,
            gripper,
            settings: settings.clone(),
            gains,
            rest: Vec::new(),
            command: Vec::new(),
            target: Default::default(),
            moving: false,
            turning: false,
            way: [0.0; 3],
            grip: settings.gripper,
            links,
        };
        arm.begin(env);
        Ok(arm)
    }

    /// Takes the state after a reset as the rest pose, and the hand's pose as its target.
    pub fn begin(&mut self, env: &Env) {
        let (model, data) = (&env.scene().model, &env.scene().data);
        self.rest = data.state.qpos.clone();
        self.command = self.links.iter().map(|link| data.state.qpos[link.position]).collect();
        self.target = self.hand(model, data, &self.command);
        (self.moving, self.turning, self.grip) = (false, false, self.settings.gripper);
    }

    /// Takes the present state of arm and gripper as their targets, after something else has moved them.
    pub fn take_over(&mut self, env: &Env) {
        let (model, data) = (&env.scene().model, &env.scene().data);
        self.stay(model, data);
        if let Some(&control) = self.gripper.first() {
            let [low, high] = model.actuator_ctrlrange[control];
            let part = (env.robot().last_control()[control] - low) / (high - low);
            self.grip = if part.is_finite() { (2.0 * part - 1.0).clamp(-1.0, 1.0) } else { self.grip };
        }
    }

    /// Pose of the hand for these joint positions.
    fn hand(&self, model: &Model, data: &Data, joints: &[f64]) -> (Vec3, Quat) {
        let mut there = data.clone();
        for (link, position) in self.links.iter().zip(joints) {
            there.state.qpos[link.position] = *position;
        }
        kinematics(model, &there.state, &mut there.kin);
        let site = self.site.index();
        (there.kin.site_xpos[site], mat_to_quat(&there.kin.site_xmat[site]))
    }

    /// Moves the target by a motion, or at most by a fraction of it, and writes the resulting controls. `within` has the smallest
    /// and the largest controls that the robot can follow in this tick: a longer motion is shortened by the same factor for all
    /// joints, so that the hand keeps its direction.
    pub fn drive(
        &mut self,
        env: &Env,
        (motion, most): (&ArmMotion, f64),
        within: [&[f64]; 2],
        controls: &mut [f64],
    ) -> Reached {
        let (model, data) = (&env.scene().model, &env.scene().data);
        if let Some(grip) = motion.gripper {
            self.grip = grip.clamp(-1.0, 1.0);
        }
        let reached = if motion.moves() {
            let begins = !std::mem::replace(&mut self.moving, true);
            self.turning |= motion.turns();
            // A followed hand that pauses keeps its direction: along it the target ends where the arm is.
            let pauses = motion.hand.is_some_and(|hand| hand.way == [0.0; 3]);
            self.way = if pauses && !begins { self.way } else { motion.way() };
            let mut reached = self.pursue(model, data, motion, most);
            if begins && reached != Reached::Yes {
                // The target cannot be reached from here: continue from the actual pose.
                self.stay(model, data);
                reached = self.pursue(model, data, motion, most);
            }
            reached
        } else {
            self.rest_at(model, data);
            Reached::Yes
        };
        let part = self.part(data, within);
        for (link, command) in self.links.iter().zip(&self.command) {
            let now = data.state.qpos[link.position];
            controls[link.control] = now + part * (command - now) + link.droop(data);
        }
        for &control in &self.gripper {
            let [low, high] = model.actuator_ctrlrange[control];
            controls[control] = low + (high - low) * (self.grip + 1.0) / 2.0;
        }
        reached
    }

    /// The fraction of the motion to their commands that all joints can make in a tick.
    fn part(&self, data: &Data, [low, high]: [&[f64]; 2]) -> f64 {
        let part = |(link, command): (&Link, &f64)| {
            let (now, droop) = (data.state.qpos[link.position], link.droop(data));
            let way = command - now;
            let end = if way > 0.0 { high[link.control] } else { low[link.control] };
            if way.abs() < SMALL { 1.0 } else { ((end - droop - now) / way).clamp(0.0, 1.0) }
        };
        self.links.iter().zip(&self.command).map(part).fold(1.0, f64::min)
    }

    /// Moves the target by the largest fraction of a motion that the joints can follow.
    fn pursue(&mut self, model: &Model, data: &Data, motion: &ArmMotion, most: f64) -> Reached {
        let mut start = data.clone();
        for (link, command) in self.links.iter().zip(&self.command) {
            start.state.qpos[link.position] = *command;
        }
        let mut why = Reached::Nowhere;
        for part in PARTS {
            let wanted = self.moved(motion, most * part);
            match self.joints_at(model, data, &start, wanted) {
                Ok(joints) => {
                    (self.command, self.target) = (joints, wanted);
                    return Reached::Yes;
                }
                Err(refused) => why = refused,
            }
        }
        why
    }

    /// The joint positions for a target.
    fn joints_at(
        &self,
        model: &Model,
        now: &Data,
        start: &Data,
        target: (Vec3, Quat),
    ) -> Result<Vec<f64>, Reached> {
        let search = Search {
            tolerance: TOLERANCE,
            max_steps: STEPS,
            damping: DAMPING,
            damping_threshold: 0.0,
            max_update: UPDATE,
            ..Search::default()
        };
        let pose = Pose { position: Some(target.0), orientation: Some(target.1) };
        let reach = Reach { joints: &self.joints, rest: Some(&self.rest), pull: self.settings.pull };
        let found = search.run_within(model, start, self.site, &pose, &reach);
        if !found.reached {
            return Err(Reached::Nowhere);
        }
        let joints: Vec<f64> = self.links.iter().map(|link| found.qpos[link.position]).collect();
        let ahead = |(link, joint): (&Link, &f64)| (joint - now.state.qpos[link.position]).powi(2);
        let distance = self.links.iter().zip(&joints).map(ahead).sum::<f64>().sqrt();
        if distance > self.settings.reach { Err(Reached::Far) } else { Ok(joints) }
    }

    /// The target after a fraction of a motion.
    fn moved(&self, motion: &ArmMotion, part: f64) -> (Vec3, Quat) {
        let [x, y, z, roll, pitch, yaw] = motion.along;
        let (mut position, mut turned) = self.target;
        position = add(position, scale([x, y, z], part * self.gains.position));
        for (axis, angle) in [([1.0, 0.0, 0.0], roll), ([0.0, 1.0, 0.0], pitch), ([0.0, 0.0, 1.0], yaw)] {
            if angle != 0.0 {
                turned = quat_mul(quat_from_axis_angle(axis, part * self.gains.rotation * angle), turned);
            }
        }
        if let Some(hand) = motion.hand {
            position = add(position, scale(hand.way, part));
            turned = quat_mul(hand.turn, turned);
        }
        (position, quat_normalize(turned))
    }

    /// Stops at the present pose when a motion ends. Perpendicular to the motion, and in orientation if it was not turned, the hand keeps
    /// its target: otherwise the tracking error would accumulate with every stop.
    fn rest_at(&mut self, model: &Model, data: &Data) {
        if std::mem::take(&mut self.moving) {
            let (place, direction) = self.target;
            self.stay(model, data);
            if !std::mem::take(&mut self.turning) {
                self.target.1 = direction;
            }
            let (along, length) = normalize(self.way);
            let stopped = if length > 0.0 { dot(sub(self.target.0, place), along) } else { 0.0 };
            self.target.0 = add(place, scale(along, stopped));
        }
    }

    /// Takes the present pose as the target.
    fn stay(&mut self, model: &Model, data: &Data) {
        self.command = self.links.iter().map(|link| data.state.qpos[link.position]).collect();
        self.target = self.hand(model, data, &self.command);
    }

    /// Target of the gripper, -1 (closed) to 1 (open).
    pub fn grip(&self) -> f64 {
        self.grip
    }

    /// The site of the hand.
    pub fn site(&self) -> SiteId {
        self.site
    }
}

/// The bodies from one to the world.
fn chain(model: &Model, body: i32) -> Vec<i32> {
    std::iter::successors(Some(body), |&body| {
        usize::try_from(body).ok().filter(|&body| body > 0).map(|body| model.body_parentid[body])
    })
    .collect()
}

/// How many bodies of a chain carry what the actuator of a control drives; none where it drives no joint.
fn hangs(model: &Model, control: usize, chain: &[i32]) -> usize {
    let drives = |actuator: &ActuatorId| model.actuator_ctrladr[actuator.index()] == control as i32;
    let link = model.actuators().find(drives).and_then(|actuator| link(model, actuator, control));
    let bodies =
        link.map(|link| self::chain(model, model.jnt_bodyid[link.joint.index()])).unwrap_or_default();
    bodies.iter().filter(|body| chain.contains(body)).count()
}

fn missing(message: String) -> TeleopError {
    TeleopError::Control { message }
}
