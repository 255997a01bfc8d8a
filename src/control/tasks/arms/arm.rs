//! An arm of servos with a gripper, by the roles of its robot: joints that bring its tool to a frame, and controls that bring joints
//! where they are to be.

use super::frame::Frame;
use super::hand::Hand;
use super::starts::posture;
use crate::error::ControlError;
use crate::tasks::joints::{Servo, between, servo_of};
use crate::tasks::roles::{of_arm, roles_of};
use env::Env;
use physics::elements::JointId;
use physics::position::kinematics::kinematics;
use physics::{Data, Model};
use robot::{Pose, Reach, Search};

/// Error at which a frame is reached: distance \[m\] plus weighted angle.
const TOLERANCE: f64 = 2e-4;
/// Error at which a frame counts as one that the arm reaches, and that at which one that it does not reach will do.
const REACHED: f64 = 3e-3;
const NEAR: f64 = 0.03;
/// Weight of an angle \[rad\] beside a distance \[m\].
const ROTATION_WEIGHT: f64 = 0.3;
/// Damping of the least squares: the square of 0.05 (Buss 2004).
const DAMPING: f64 = 2.5e-3;
/// Largest number of updates of a search.
const STEPS: usize = 150;
/// Share of the way to the home pose that an update goes where the arm has more joints than it needs.
const PULL: f64 = 0.02;
/// Postures from which a frame is looked for that is not found from the present one.
const STARTS: usize = 8;
/// Share of what joints lack that a second of control adds to their targets.
const CORRECTION: f64 = 4.0;
/// The most that it adds, and the most that joints may lack for it \[rad\].
const MOST: f64 = 0.1;

/// A joint of the arm.
#[derive(Clone, Copy)]
struct Link {
    joint: JointId,
    servo: Servo,
    control: usize,
}

/// An arm.
pub struct Arm {
    /// Its gripper.
    pub hand: Hand,
    links: Vec<Link>,
    joints: Vec<JointId>,
    home: Vec<f64>,
    /// What is added to the targets of the servos.
    correction: Vec<f64>,
}

impl Arm {
    /// The arm of an environment, for the controller called `name`.
    ///
    /// # Errors
    /// The task names no roles, or the model does not fill them.
    pub fn new(env: &Env, name: &str) -> Result<Self, ControlError> {
        Arm::of_several(env, "", name)
    }

    /// The same of several, whose elements have names that begin with `prefix`.
    ///
    /// # Errors
    /// As [`Arm::new`].
    pub fn of_several(env: &Env, prefix: &str, name: &str) -> Result<Self, ControlError> {
        let m = &env.scene().model;
        let roles = roles_of(env)?;
        let told = |error: robot::ConfigError| ControlError::unfit(env, error.to_string());
        let body = roles.cast(m, prefix, name);
        let mut home = m.qpos0.to_vec();
        let posture = of_arm(env.spec(), "pose").unwrap_or_else(|| "home".into());
        body.pose(&posture, &mut home).map_err(told)?;
        let (root, tool) = (body.root().map_err(told)?, body.tool().map_err(told)?);
        // A wrist that its roles count among the fingers stays with them.
        let of_hand = body.joints_of("open").map_err(told)?;
        let link = |joint| servo_of(m, joint).map(|(control, servo)| Link { joint, servo, control });
        let of_arm = between(m, root, tool).into_iter().filter(|joint| !of_hand.contains(joint));
        let links: Vec<Link> = of_arm.filter_map(link).collect();
        let joints: Vec<JointId> = links.iter().map(|link| link.joint).collect();
        let hand = Hand::new(env, &roles, &body, &joints)?;
        Ok(Arm { hand, correction: vec![0.0; links.len()], links, joints, home })
    }

    /// Begins an episode.
    pub fn begin(&mut self) {
        self.correction.fill(0.0);
    }

    /// Positions of its joints.
    pub fn places(&self, qpos: &[f64]) -> Vec<f64> {
        self.links.iter().map(|link| qpos[link.servo.place]).collect()
    }

    /// Where the tool is when the arm is at home.
    pub fn home(&self, m: &Model) -> Frame {
        let mut posed = Data::new(m);
        posed.state.qpos.copy_from_slice(&self.home);
        kinematics(m, &posed.state, &mut posed.kin);
        Frame::of_site(&posed, self.hand.tool)
    }

    /// Where the tool is.
    pub fn tool(&self, env: &Env) -> Frame {
        Frame::of_site(&env.scene().data, self.hand.tool)
    }

    /// Looks for joints that bring the tool to a frame, from where `data` has them. Returns them and the error that is left.
    pub fn solve(&self, m: &Model, data: &Data, frame: &Frame) -> (Vec<f64>, f64) {
        let redundant = self.joints.len() > 6;
        let rest = redundant.then_some(&self.home[..]);
        let reach = Reach { joints: &self.joints, rest, pull: PULL };
        let search = Search {
            tolerance: TOLERANCE,
            rotation_weight: ROTATION_WEIGHT,
            damping: DAMPING,
            damping_threshold: 0.0,
            progress_threshold: 1e4,
            max_steps: STEPS,
            ..Search::default()
        };
        let pose = Pose { position: Some(frame.place), orientation: Some(frame.turn) };
        let found = search.run_within(m, data, self.hand.tool, &pose, &reach);
        (self.places(&found.qpos), found.error)
    }

    /// The frame of several that is reached with the least motion of the joints from where `from` has them, and the joints there; `None`
    /// where the arm comes near none of them.
    pub fn nearest(&self, env: &Env, from: &[f64], frames: &[Frame]) -> Option<(Frame, Vec<f64>)> {
        let m = &env.scene().model;
        let mut data = env.scene().data.clone();
        let mut best: Option<([f64; 2], Frame, Vec<f64>)> = None;
        for start in 0..STARTS {
            self.set(&mut data, &self.start(m, from, start));
            for frame in frames {
                let (joints, error) = self.solve(m, &data, frame);
                let way = joints.iter().zip(from).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
                // Of frames that are reached the nearest counts, of others the error.
                let rank = [error.max(REACHED), way];
                if error < NEAR && best.as_ref().is_none_or(|(least, ..)| rank < *least) {
                    best = Some((rank, *frame, joints));
                }
            }
            if best.as_ref().is_some_and(|([error, _], ..)| *error <= REACHED) {
                break;
            }
        }
        best.map(|(_, frame, joints)| (frame, joints))
    }

    /// A posture to begin a search with: the present one, the home pose, then others.
    fn start(&self, m: &Model, from: &[f64], start: usize) -> Vec<f64> {
        match start {
            0 => from.to_vec(),
            1 => self.places(&self.home),
            _ => posture(m, &self.joints, start),
        }
    }

    /// Puts the joints of a state.
    pub fn set(&self, data: &mut Data, joints: &[f64]) {
        for (link, place) in self.links.iter().zip(joints) {
            data.state.qpos[link.servo.place] = *place;
        }
    }

    /// Writes the controls of the arm into `controls` (nu), which bring the joints from `now`, where they are to be at present, to `next`,
    /// where they are to be a step later, and the fingers to an opening.
    pub fn command(&mut self, env: &Env, now: &[f64], next: &[f64], opening: f64, controls: &mut [f64]) {
        let (qpos, dt) = (&env.scene().data.state.qpos, env.dt());
        for (k, link) in self.links.iter().enumerate() {
            let lacks = now[k] - qpos[link.servo.place];
            // Of a joint that is far behind, as its robot's limits of velocity make it, nothing can be learnt.
            if lacks.abs() < MOST {
                self.correction[k] = (self.correction[k] + CORRECTION * dt * lacks).clamp(-MOST, MOST);
            }
            let lag = link.servo.lag * (next[k] - now[k]) / dt;
            controls[link.control] = next[k] + lag + self.correction[k];
        }
        self.hand.command(qpos, opening, controls);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tasks::arms::grasp::from_above;
    use env::{Env, Options, OwnModels};
    use physics::math::{distance, dot};

    /// The four arms differ in the axes of their tools, in the number of joints and in what moves their fingers.
    #[test]
    fn every_arm_brings_its_fingers_to_either_side_of_a_thing() {
        for robot in ["Panda", "Sawyer", "Fetch", "SO101"] {
            let id = format!("hive/{robot}Stack-v0");
            let mut env = Env::make(&id, &OwnModels, &Options::default()).unwrap();
            env.reset(Some(1)).unwrap();
            let (arm, scene) = (Arm::new(&env, "test").unwrap(), env.scene());
            let thing = Frame { place: [0.05, 0.46, 0.82], turn: [1.0, 0.0, 0.0, 0.0] };
            let frames = from_above(&arm, &thing, 0.03, 0.1, true);
            let from = arm.places(&scene.data.state.qpos);
            let (frame, joints) = arm.nearest(&env, &from, &frames).unwrap_or_else(|| panic!("{id}"));
            let mut data = scene.data.clone();
            arm.set(&mut data, &joints);
            physics::forward(&scene.model, &mut data).unwrap();
            let tool = Frame::of_site(&data, arm.hand.tool);
            assert!(distance(tool.place, frame.place) < 1e-3, "{id}: {:?}", tool.place);
            assert!(dot(arm.hand.pointing(tool.turn), [0.0, 0.0, -1.0]) > 0.9999, "{id}: {:?}", tool.turn);
            let [narrow, wide] = [0.01, 0.03].map(|width| arm.hand.opening(width));
            assert!(0.0 < narrow && narrow < wide && wide < 1.0, "{id}: {narrow}, {wide}");
        }
    }
}
