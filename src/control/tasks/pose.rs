//! Poses of servoed joints: every servo is told its place at once, of which the robot's limits of velocity make a motion.

use super::joints::{Servo, first_place};
use crate::controller::{Controller, command};
use crate::error::ControlError;
use env::Env;
use physics::model::TrnType;

/// What a task observes of the pose.
struct Shown {
    /// The row of errors.
    row: &'static str,
    /// The place in `qpos` of the first joint of the row.
    first: usize,
    /// 1 where an error is what is lacking, -1 where it is what is too much.
    sign: f64,
}

/// The controller.
pub struct ServoPose {
    shown: Shown,
    servos: Vec<Servo>,
    controls: Vec<f64>,
}

impl ServoPose {
    /// The controller for a robot whose actuators servo the joints of the pose.
    ///
    /// # Errors
    /// An actuator that moves none of these joints; a setting or a joint is missing.
    pub fn new(env: &Env) -> Result<Self, ControlError> {
        let (m, count) = (&env.scene().model, env.scene().model.nu);
        let shown = match env.spec().task.as_str() {
            "kitty_stand" => {
                Shown { row: "pose_error", first: first_place(env, "dof_range_names")?, sign: 1.0 }
            }
            _ => Shown { row: "pose_err", first: 0, sign: -1.0 },
        };
        let errors = env.rows()[shown.row].len();
        let servo = |actuator: usize| {
            let moves = m.actuator_trntype[actuator] == TrnType::Joint as i32;
            let servo = moves.then(|| Servo::new(m, actuator));
            let servo = servo.filter(|servo| (shown.first..shown.first + errors).contains(&servo.place));
            servo.ok_or_else(|| {
                ControlError::unfit(env, format!("actuator {actuator} moves no joint of the pose"))
            })
        };
        let servos = (0..count).map(servo).collect::<Result<_, _>>()?;
        Ok(ServoPose { servos, shown, controls: vec![0.0; count] })
    }
}

impl Controller for ServoPose {
    fn reset(&mut self, _: &Env, _: u64) -> Result<(), ControlError> {
        Ok(())
    }

    fn act(&mut self, env: &Env, action: &mut [f64]) -> Result<(), ControlError> {
        let (qpos, errors) = (&env.scene().data.state.qpos, &env.rows()[self.shown.row]);
        for (servo, control) in self.servos.iter().zip(&mut self.controls) {
            *control = qpos[servo.place] + self.shown.sign * errors[servo.place - self.shown.first];
        }
        command(env, &self.controls, action)
    }
}
