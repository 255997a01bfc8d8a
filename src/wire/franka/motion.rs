//! The motion of an arm: what may be commanded, and what becomes of commands that do not come.

use protocol::franka::{
    ArmLimits, CYCLE, Controller, Generator, JOINTS, Setpoint, TORQUE, TORQUE_RATE, Version, error_bit,
};

/// How much more than a limit is still taken for it, as a share.
const SLACK: f64 = 1e-3;
/// A first command that is further away than this from where the arm stands does not begin there \[rad\].
const START: f64 = 1e-3;

/// What is commanded of the joints, with its derivatives \[rad\].
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Desired {
    pub(super) q: [f64; JOINTS],
    pub(super) dq: [f64; JOINTS],
    pub(super) ddq: [f64; JOINTS],
    pub(super) torque: [f64; JOINTS],
}

/// A motion under way.
#[derive(Clone, Copy, Debug)]
pub(super) struct Motion {
    pub(super) generator: Generator,
    pub(super) controller: Controller,
    /// Number of the request that began it.
    pub(super) id: u32,
    /// Whether a command has come.
    pub(super) begun: bool,
    /// Whether one has come since the last state.
    pub(super) answered: bool,
    /// Cycles in a row without one.
    pub(super) missed: u64,
}

impl Motion {
    pub(super) fn external(&self) -> bool {
        self.controller == Controller::External
    }
}

/// Limits of what is commanded, with the rounding that the version's states bring with them.
#[derive(Clone, Copy, Debug)]
pub(super) struct Judge {
    pub(super) limits: &'static ArmLimits,
    /// Nothing is refused.
    pub(super) lenient: bool,
    /// Rounding of a position that a client has from a state \[rad\].
    rounding: f64,
}

impl Judge {
    pub(super) fn new(version: Version) -> Judge {
        let rounding = match version {
            Version::V5 => 0.0,
            Version::V10 => 4.0 * f64::from(f32::EPSILON),
        };
        Judge { limits: ArmLimits::of(version), lenient: false, rounding }
    }

    /// The course after a command, or the error that it is.
    pub(super) fn follow(
        &self,
        desired: &Desired,
        motion: &Motion,
        setpoint: &Setpoint,
    ) -> Result<Desired, u64> {
        if motion.external() {
            return self.torques(desired, setpoint);
        }
        let mut next = *desired;
        for k in 0..JOINTS {
            let (q, dq) = match motion.generator {
                Generator::JointVelocity => (desired.q[k] + setpoint.dq[k] * CYCLE, setpoint.dq[k]),
                _ => (setpoint.q[k], (setpoint.q[k] - desired.q[k]) / CYCLE),
            };
            next.ddq[k] = (dq - desired.dq[k]) / CYCLE;
            (next.q[k], next.dq[k]) = (q, dq);
        }
        if !next.q.iter().all(|q| q.is_finite()) {
            return Err(error_bit("joint_motion_generator_position_limits_violation"));
        }
        if self.lenient {
            return Ok(next);
        }
        if !motion.begun && (0..JOINTS).any(|k| (next.q[k] - desired.q[k]).abs() > START) {
            return Err(error_bit("joint_position_motion_generator_start_pose_invalid"));
        }
        match (0..JOINTS).find_map(|k| self.joint(desired, &next, k)) {
            Some(error) => Err(error_bit(error)),
            None => Ok(next),
        }
    }

    /// What is wrong with the course of a joint.
    fn joint(&self, before: &Desired, next: &Desired, k: usize) -> Option<&'static str> {
        let over = |value: f64, limit: f64, derivative: i32| {
            value.abs() > limit * (1.0 + SLACK) + self.rounding / CYCLE.powi(derivative)
        };
        let [low, high] = self.limits.position[k];
        let [down, up] = self.limits.velocity_at(k, before.q[k]);
        let jerk = (next.ddq[k] - before.ddq[k]) / CYCLE;
        if next.q[k] < low - 1e-9 || next.q[k] > high + 1e-9 {
            Some("joint_motion_generator_position_limits_violation")
        } else if over(next.dq[k], if next.dq[k] < 0.0 { -down } else { up }, 1) {
            Some("joint_motion_generator_velocity_limits_violation")
        } else if over(next.ddq[k], self.limits.acceleration[k], 2) {
            Some("joint_motion_generator_velocity_discontinuity")
        } else {
            over(jerk, self.limits.jerk[k], 3).then_some("joint_motion_generator_acceleration_discontinuity")
        }
    }

    fn torques(&self, desired: &Desired, setpoint: &Setpoint) -> Result<Desired, u64> {
        for k in 0..JOINTS {
            let (torque, change) = (setpoint.torque[k], setpoint.torque[k] - desired.torque[k]);
            let rounding = TORQUE[k] * self.rounding;
            if torque.is_nan() || torque.abs() > TORQUE[k] * (1.0 + SLACK) {
                return Err(error_bit("tau_j_range_violation"));
            }
            if !self.lenient && change.abs() > TORQUE_RATE * CYCLE * (1.0 + SLACK) + rounding {
                return Err(error_bit("controller_torque_discontinuity"));
            }
        }
        Ok(Desired { torque: setpoint.torque, ..*desired })
    }

    /// The course of a cycle without a command: the acceleration stays, within what velocity and position allow.
    pub(super) fn extrapolate(&self, desired: &mut Desired, motion: &Motion) {
        if motion.external() {
            return;
        }
        for k in 0..JOINTS {
            let [down, up] = self.limits.velocity_at(k, desired.q[k]);
            let dq = (desired.dq[k] + desired.ddq[k] * CYCLE).clamp(down, up);
            let [low, high] = self.limits.position[k];
            desired.ddq[k] = (dq - desired.dq[k]) / CYCLE;
            (desired.q[k], desired.dq[k]) = ((desired.q[k] + dq * CYCLE).clamp(low, high), dq);
        }
    }

    /// The course of a cycle in which the arm comes to rest by itself.
    pub(super) fn brake(&self, desired: &mut Desired) {
        for k in 0..JOINTS {
            let most = self.limits.acceleration[k] * CYCLE;
            let dq = desired.dq[k] - desired.dq[k].clamp(-most, most);
            desired.q[k] += dq * CYCLE;
            (desired.dq[k], desired.ddq[k]) = (dq, 0.0);
        }
        desired.torque = [0.0; JOINTS];
    }

    /// Whether a motion may end here: at rest.
    pub(super) fn at_rest(&self, desired: &Desired) -> bool {
        self.lenient || (0..JOINTS).all(|k| desired.dq[k].abs() <= self.limits.acceleration[k] * CYCLE)
    }
}
