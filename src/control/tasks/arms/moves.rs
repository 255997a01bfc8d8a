//! Moves of an arm, one after the other: along a line or by the shortest way of its joints, with the least jerk.

use super::arm::Arm;
use super::frame::Frame;
use crate::controller::{Controller, command};
use crate::error::ControlError;
use crate::maths::MinimumJerk;
use env::Env;
use physics::math::{distance, norm, quat_difference};

/// Distance between the frames of a line at which joints are looked for \[m\].
const SPACING: f64 = 0.01;
/// Angle between such frames, where the tool only turns \[rad\].
const TURN: f64 = 0.1;
/// How an arm moves at full speed.
#[derive(Clone, Copy, Debug)]
pub struct Pace {
    /// Speed of its fastest joint \[rad/s\].
    pub joint: f64,
    /// Speed of its tool \[m/s\].
    pub tool: f64,
    /// What joints may lack at the end of a move that is not to be precise \[rad\].
    pub near: f64,
}

/// An arm that has time.
const CALM: Pace = Pace { joint: 1.5, tool: 0.5, near: 0.02 };
/// How long an arm waits for joints that lack more \[s\].
const PATIENCE: f64 = 0.4;
/// Shortest move \[s\].
const SHORTEST: f64 = 0.1;

/// A move.
#[derive(Clone, Debug)]
pub struct Move {
    /// Where the tool goes: one of these frames, that with the least motion of the joints.
    pub to: Vec<Frame>,
    /// Whether it goes on a straight line.
    pub straight: bool,
    /// Opening of the gripper on the way and after it, 0 to 1.
    pub opening: f64,
    /// Speed, as a share of full speed.
    pub speed: f64,
    /// How long the arm waits then \[s\].
    pub pause: f64,
    /// Whether the arm waits until its joints have come, whatever its pace.
    pub precise: bool,
}

impl Move {
    /// A straight move whose end is waited for.
    pub fn precise(to: Frame, opening: f64, speed: f64, pause: f64) -> Self {
        Move { to: vec![to], straight: true, opening, speed, pause, precise: true }
    }
}

/// Says what an arm does next.
pub trait Script: Send {
    /// Begins an episode.
    ///
    /// # Errors
    /// The state admits no plan.
    fn begin(&mut self, env: &Env, arm: &Arm) -> Result<(), ControlError>;

    /// The next move, when the last one is over; `None` to stay.
    ///
    /// # Errors
    /// The state admits no plan.
    fn next(&mut self, env: &Env, arm: &Arm) -> Result<Option<Move>, ControlError>;
}

/// Joints along the way of a move.
struct Path {
    /// Joints, each with the time that full speed takes to them \[s\].
    joints: Vec<(f64, Vec<f64>)>,
    /// How much of that time has been gone.
    progress: MinimumJerk,
    began: f64,
    ends: f64,
    /// What joints may lack at the end \[rad\].
    near: f64,
}

impl Path {
    fn at(&self, time: f64) -> Vec<f64> {
        let mut gone = [0.0];
        self.progress.position(time - self.began, &mut gone);
        let after = self.joints.partition_point(|(passed, _)| *passed < gone[0]);
        let after = after.clamp(1, self.joints.len() - 1);
        let ((start, a), (end, b)) = (&self.joints[after - 1], &self.joints[after]);
        let share = ((gone[0] - start) / (end - start)).clamp(0.0, 1.0);
        a.iter().zip(b).map(|(a, b)| a + share * (b - a)).collect()
    }
}

/// A controller that does what a script says.
pub struct Scripted<S> {
    arm: Arm,
    script: S,
    path: Option<Path>,
    opening: f64,
    pace: Pace,
    controls: Vec<f64>,
}

impl<S: Script> Scripted<S> {
    /// The controller.
    pub fn new(arm: Arm, script: S) -> Self {
        Scripted { arm, script, path: None, opening: 1.0, pace: CALM, controls: Vec::new() }
    }

    /// The same at another pace.
    pub fn with_pace(self, pace: Pace) -> Self {
        Scripted { pace, ..self }
    }

    /// Whether a move has been made: its time has passed, and joints that limits of velocity hold back have come, or will not.
    fn is_over(&self, env: &Env, path: &Path, now: f64) -> bool {
        let there = path.at(now);
        let each = self.arm.places(&env.scene().data.state.qpos);
        let lacks = each.iter().zip(&there).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        now > path.ends - 1e-9 && (lacks < path.near || now > path.ends + PATIENCE)
    }

    fn start(&mut self, env: &Env, step: &Move) -> Result<(), ControlError> {
        let scene = env.scene();
        let now = scene.data.time();
        let from = match &self.path {
            Some(path) => path.at(now),
            None => self.arm.places(&scene.data.state.qpos),
        };
        let mut data = scene.data.clone();
        self.arm.set(&mut data, &from);
        physics::forward(&scene.model, &mut data)?;
        let begin = Frame::of_site(&data, self.arm.hand.tool);
        // An arm that does not reach what has fallen away stays.
        let near = self.arm.nearest(env, &from, &step.to);
        let (end, there) = near.unwrap_or_else(|| (begin, from.clone()));
        let length = distance(begin.place, end.place);
        let mut joints = vec![(0.0, from)];
        if step.straight {
            let turn = norm(quat_difference(end.turn, begin.turn));
            // What stays where it is turns there, and all else turns on its way.
            let pieces = if length < SPACING { turn / TURN } else { length / SPACING };
            let count = pieces.ceil().max(1.0) as usize;
            for k in 1..=count {
                let frame = begin.towards(&end, k as f64 / count as f64);
                let (place, _) = self.arm.solve(&scene.model, &data, &frame);
                self.arm.set(&mut data, &place);
                self.extend(&mut joints, place, length / count as f64);
            }
        } else {
            self.extend(&mut joints, there, length);
        }
        let full = joints[joints.len() - 1].0;
        let seconds = MinimumJerk::shortest(&[0.0], &[full], &[step.speed]).max(SHORTEST);
        let progress = MinimumJerk::between(&[0.0], &[full], seconds)?;
        self.opening = step.opening;
        let near = if step.precise { CALM.near } else { self.pace.near };
        self.path = Some(Path { joints, progress, began: now, ends: now + seconds + step.pause, near });
        Ok(())
    }

    /// Adds joints to a way, which take the tool `length` \[m\] farther.
    fn extend(&self, joints: &mut Vec<(f64, Vec<f64>)>, next: Vec<f64>, length: f64) {
        let (passed, last) = &joints[joints.len() - 1];
        let farthest = last.iter().zip(&next).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        let seconds = (farthest / self.pace.joint).max(length / self.pace.tool).max(f64::MIN_POSITIVE);
        joints.push((passed + seconds, next));
    }
}

impl<S: Script> Controller for Scripted<S> {
    fn reset(&mut self, env: &Env, _: u64) -> Result<(), ControlError> {
        self.arm.begin();
        (self.path, self.opening) = (None, 1.0);
        self.controls.resize(env.scene().model.nu, 0.0);
        self.script.begin(env, &self.arm)
    }

    fn act(&mut self, env: &Env, action: &mut [f64]) -> Result<(), ControlError> {
        let now = env.scene().data.time();
        // Rounding of the time is no reason to wait for another step.
        if self.path.as_ref().is_none_or(|path| self.is_over(env, path, now))
            && let Some(step) = self.script.next(env, &self.arm)?
        {
            self.start(env, &step)?;
        }
        let path = self.path.as_ref().ok_or_else(|| ControlError::unfit(env, "the script has no moves"))?;
        let (here, there) = (path.at(now), path.at(now + env.dt()));
        self.arm.command(env, &here, &there, self.opening, &mut self.controls);
        command(env, &self.controls, action)
    }
}
