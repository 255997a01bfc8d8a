//! A finger that hangs down: a joint that swings it sideways, two that bend it outwards, and the servos that move them.

use crate::error::ControlError;
use crate::tasks::joints::{Servo, between, servo_of};
use env::Env;
use physics::elements::{BodyId, JointId, SiteId};
use physics::math::{Vec3, cross, distance, dot, ops};

/// A joint, its servo, and which way it turns.
struct Part {
    dof: usize,
    control: usize,
    servo: Servo,
    /// 1 where a positive angle moves the tip counterclockwise round the shaft, or outwards; else -1.
    sense: f64,
    /// Angle that it was told last \[rad\].
    before: f64,
}

/// A finger by its lengths, between its joints and to its tip \[m\].
pub struct Finger {
    parts: [Part; 3],
    lengths: [f64; 3],
    /// Where its uppermost joint is \[m\], world frame.
    top: Vec3,
    /// Direction from the shaft to the finger \[rad\].
    pub direction: f64,
    pub tip: SiteId,
}

impl Finger {
    /// The finger that ends in a tip, round a shaft at the origin. It hangs straight from its first joint in the present state.
    ///
    /// # Errors
    /// A finger of other joints, or without a servo for each.
    pub fn new(env: &Env, root: BodyId, tip: SiteId) -> Result<Self, ControlError> {
        let (m, data) = (&env.scene().model, &env.scene().data);
        let unfit = || ControlError::unfit(env, "a finger is three hinges with a servo each");
        let joints: [JointId; 3] = between(m, root, tip).try_into().map_err(|_| unfit())?;
        let anchor = |joint: JointId| data.kin.xanchor[joint.index()];
        let places = [anchor(joints[0]), anchor(joints[1]), anchor(joints[2]), *data.site(tip).xpos()];
        let top = places[0];
        let direction = ops::atan2(top[1], top[0]);
        let (sine, cosine) = ops::sincos(direction);
        let part = |(joint, towards): (JointId, Vec3)| {
            let (control, servo) = servo_of(m, joint).filter(|(_, servo)| servo.stiffness > 0.0)?;
            let moves = cross(data.kin.xaxis[joint.index()], [0.0, 0.0, -1.0]);
            let dof = m.jnt_dofadr[joint.index()] as usize;
            let sense = dot(moves, towards).signum();
            Some(Part { dof, control, servo, sense, before: 0.0 })
        };
        let (round, out) = ([-sine, cosine, 0.0], [cosine, sine, 0.0]);
        let [swing, upper, lower] = joints;
        let mut parts = [(swing, round), (upper, out), (lower, out)].map(part).into_iter();
        let mut next = || parts.next().flatten().ok_or_else(unfit);
        Ok(Finger {
            parts: [next()?, next()?, next()?],
            lengths: [0, 1, 2].map(|k| distance(places[k], places[k + 1])),
            top,
            direction,
            tip,
        })
    }

    /// Begins where the joints are (nq).
    pub fn begin(&mut self, qpos: &[f64]) {
        self.parts.iter_mut().for_each(|part| part.before = qpos[part.servo.place]);
    }

    /// Writes the targets of the servos that bring the tip to `place` \[m\], world frame, within a step, into `controls` (nu); one too far
    /// away is pointed at.
    pub fn point(&mut self, env: &Env, place: Vec3, controls: &mut [f64]) {
        let (sine, cosine) = ops::sincos(self.direction);
        let [x, y, z] = [0, 1, 2].map(|i| place[i] - self.top[i]);
        let (out, round) = (cosine * x + sine * y, cosine * y - sine * x);
        let [link, upper, lower] = self.lengths;
        let down = ops::sqrt(round * round + z * z) - link;
        let bent = (out * out + down * down - upper * upper - lower * lower) / (2.0 * upper * lower);
        let bend = ops::acos(bent.clamp(-1.0, 1.0));
        let (across, along) = (lower * ops::sin(bend), upper + lower * ops::cos(bend));
        let lean = ops::atan2(out, down) + ops::atan2(across, along);
        let bias = &env.scene().data.vel.qfrc_bias;
        for (part, angle) in self.parts.iter_mut().zip([ops::atan2(round, -z), lean, -bend]) {
            let angle = part.sense * angle;
            let Servo { lag, stiffness, .. } = part.servo;
            let ahead = lag * (angle - part.before) / env.dt();
            controls[part.control] = angle + ahead + bias[part.dof] / stiffness;
            part.before = angle;
        }
    }
}
