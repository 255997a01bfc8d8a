//! Poses: each servo is told where its joint of the second claw, which shows the goal, will be at the end of the step, with what it stays
//! behind a motion and under the weight of the finger.

use crate::controller::{Controller, command};
use crate::error::ControlError;
use crate::tasks::joints::{Servo, first_place};
use env::Env;

/// A servo, and the joint that it follows.
struct Follower {
    servo: Servo,
    dof: usize,
    /// The place in `qpos` of the joint that shows where it is to be.
    shown: usize,
    /// Where that was before this step \[rad\].
    before: f64,
}

pub struct ClawPose {
    followers: Vec<Follower>,
    controls: Vec<f64>,
}

impl ClawPose {
    /// The controller.
    ///
    /// # Errors
    /// A setting or a joint is missing.
    pub fn new(env: &Env) -> Result<Self, ControlError> {
        let [claw, overlay] =
            [first_place(env, "dof_range_names")?, first_place(env, "overlay_range_names")?];
        let m = &env.scene().model;
        let follower = |actuator: usize| {
            let servo = Servo::new(m, actuator);
            let dof = m.jnt_dofadr[m.actuator_trnid[actuator][0] as usize] as usize;
            Follower { shown: overlay + servo.place - claw, before: 0.0, servo, dof }
        };
        Ok(ClawPose { followers: (0..m.nu).map(follower).collect(), controls: vec![0.0; m.nu] })
    }
}

impl Controller for ClawPose {
    fn reset(&mut self, env: &Env, _: u64) -> Result<(), ControlError> {
        let qpos = &env.scene().data.state.qpos;
        self.followers.iter_mut().for_each(|follower| follower.before = qpos[follower.shown]);
        Ok(())
    }

    fn act(&mut self, env: &Env, action: &mut [f64]) -> Result<(), ControlError> {
        let (data, dt) = (&env.scene().data, env.dt());
        for (follower, control) in self.followers.iter_mut().zip(&mut self.controls) {
            let now = data.state.qpos[follower.shown];
            let speed = (now - follower.before) / dt;
            follower.before = now;
            let Servo { lag, stiffness, .. } = follower.servo;
            *control = now + speed * (dt + lag) + data.vel.qfrc_bias[follower.dof] / stiffness;
        }
        command(env, &self.controls, action)
    }
}
