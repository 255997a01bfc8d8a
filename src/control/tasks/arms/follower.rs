//! An arm whose tool goes from frame to frame in given times, with the least jerk: joints are looked for at every step, from those of the
//! step before, so that several arms keep time with each other whatever their joints do.

use super::arm::Arm;
use super::frame::Frame;
use crate::error::ControlError;
use crate::maths::MinimumJerk;
use env::Env;
use physics::Data;

/// A motion of the tool.
struct Motion {
    from: Frame,
    to: Frame,
    /// Share of the way that is gone.
    progress: MinimumJerk,
    /// When it began \[s\].
    began: f64,
}

/// An arm that follows motions of its tool.
pub struct Follower {
    /// The arm.
    pub arm: Arm,
    /// Opening of the gripper, 0 to 1.
    pub opening: f64,
    /// Where joints are to be now, and the state in which they are looked for.
    told: Vec<f64>,
    posed: Data,
    motion: Option<Motion>,
}

impl Follower {
    /// An arm that stays.
    pub fn new(env: &Env, arm: Arm) -> Self {
        Follower { arm, opening: 1.0, told: Vec::new(), posed: env.scene().data.clone(), motion: None }
    }

    /// Begins where the arm is, with an open gripper.
    pub fn restart(&mut self, env: &Env) {
        self.arm.begin();
        self.posed = env.scene().data.clone();
        self.told = self.arm.places(&self.posed.state.qpos);
        (self.opening, self.motion) = (1.0, None);
    }

    /// Where the tool is to be at a time \[s\].
    fn wanted(&self, time: f64) -> Option<Frame> {
        let motion = self.motion.as_ref()?;
        let mut gone = [0.0];
        motion.progress.position(time - motion.began, &mut gone);
        Some(motion.from.towards(&motion.to, gone[0]))
    }

    /// Moves the tool from where it is to be now to a frame, within `seconds`.
    ///
    /// # Errors
    /// A time that is not positive.
    pub fn go(&mut self, env: &Env, to: Frame, seconds: f64) -> Result<(), ControlError> {
        let began = env.scene().data.time();
        let from = self.wanted(began).unwrap_or_else(|| self.arm.tool(env));
        let progress = MinimumJerk::between(&[0.0], &[1.0], seconds)?;
        self.motion = Some(Motion { from, to, progress, began });
        Ok(())
    }

    /// Writes the controls of the arm into `controls` (nu), by which the tool is where it is to be at the end of the step.
    pub fn act(&mut self, env: &Env, controls: &mut [f64]) {
        let now = self.told.clone();
        if let Some(frame) = self.wanted(env.scene().data.time() + env.dt()) {
            self.arm.set(&mut self.posed, &now);
            self.told = self.arm.solve(&env.scene().model, &self.posed, &frame).0;
        }
        self.arm.command(env, &now, &self.told, self.opening, controls);
    }
}
