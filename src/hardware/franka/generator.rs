//! From targets that come now and then to a command a millisecond.

use crate::safety::limits::{Course, Limits};
use protocol::franka::{ArmLimits, CYCLE, JOINTS};

/// Share of the arm's acceleration that is used.
const ACCELERATION: f64 = 0.8;
/// Share of that which braking towards an end of a joint takes where the arm's limit of velocity falls.
const APPROACH: f64 = 0.7;
/// Packets that may be lost while the arm goes on accelerating.
const LOST: f64 = 3.0;
/// Commands of the first stage whose mean is sent. Sixteen of 1 ms: their accelerations differ by at most twice the largest,
/// so that the jerk j is at most a fifth of the arm's. Where a packet is lost, the arm goes on with the acceleration that it
/// has, and makes of the next command an acceleration that is 2 j × 1 ms too large and a jerk of 4 j: both within its limits.
const MEAN: usize = 16;
/// Distance that is kept from the ends of a joint \[rad\].
const MARGIN: f64 = 0.01;

/// A motion of one joint: a course within velocity and acceleration, of which the mean over [`MEAN`] cycles is commanded.
/// What holds for every part of a mean holds for the mean, and its jerk is bounded by the time over which it is taken.
#[derive(Clone, Copy, Debug, Default)]
struct Joint {
    course: Course,
    recent: [f64; MEAN],
    target: f64,
}

/// A motion of all joints towards a target.
#[derive(Clone, Debug)]
pub(super) struct Generator {
    arm: &'static ArmLimits,
    joints: [Joint; JOINTS],
    next: usize,
    /// Targets are commanded as they are.
    direct: bool,
    halted: bool,
    commanded: [f64; JOINTS],
    velocity: [f64; JOINTS],
}

impl Generator {
    /// At rest at `q`.
    pub(super) fn at(arm: &'static ArmLimits, q: [f64; JOINTS], direct: bool) -> Generator {
        let joints = q.map(|q| Joint { course: Course::at(q), recent: [q; MEAN], target: q });
        Generator { arm, joints, next: 0, direct, halted: false, commanded: q, velocity: [0.0; JOINTS] }
    }

    /// Positions that a joint may be commanded \[rad\].
    pub(super) fn range(arm: &ArmLimits, joint: usize) -> [f64; 2] {
        let [low, high] = arm.position[joint];
        let (offset, deceleration) = arm.approach(joint);
        // Nearer than this to its end the arm allows no velocity towards it.
        let margin = if deceleration > 0.0 { offset * offset / (2.0 * deceleration) } else { 0.0 };
        [low + margin + MARGIN, high - margin - MARGIN]
    }

    /// Where it goes from now on; not while it halts.
    pub(super) fn aim(&mut self, joint: usize, target: f64) {
        let [low, high] = Generator::range(self.arm, joint);
        if !self.halted {
            self.joints[joint].target = target.clamp(low, high);
        }
    }

    /// Comes to rest as soon as it can, and stays there.
    pub(super) fn halt(&mut self) {
        if std::mem::replace(&mut self.halted, true) {
            return;
        }
        let rest = self.rest();
        self.joints.iter_mut().zip(rest).for_each(|(joint, rest)| joint.target = rest);
    }

    /// Where it would come to rest if it halted now.
    pub(super) fn rest(&self) -> [f64; JOINTS] {
        std::array::from_fn(|k| {
            let rate = self.joints[k].course.rate;
            let way = rate * rate.abs() / (2.0 * ACCELERATION * self.arm.acceleration[k]) + rate * CYCLE;
            let [low, high] = Generator::range(self.arm, k);
            let here = if self.direct { self.commanded[k] } else { self.joints[k].course.value };
            // A joint may stand beyond the range that targets have.
            (here + way).clamp(low.min(here), high.max(here))
        })
    }

    /// Where it goes.
    pub(super) fn targets(&self) -> [f64; JOINTS] {
        self.joints.map(|joint| joint.target)
    }

    /// Goes on after a halt, with the next target.
    pub(super) fn resume(&mut self) {
        self.halted = false;
    }

    /// What was commanded last.
    pub(super) fn commanded(&self) -> [f64; JOINTS] {
        self.commanded
    }

    /// Whether it stands still and has nowhere to go.
    pub(super) fn at_rest(&self) -> bool {
        (0..JOINTS).all(|k| self.velocity[k] == 0.0 && self.commanded[k] == self.joints[k].target)
    }

    /// The next millisecond.
    pub(super) fn step(&mut self) -> [f64; JOINTS] {
        for k in 0..JOINTS {
            let before = self.commanded[k];
            self.commanded[k] = if self.direct { self.joints[k].target } else { self.advance(k) };
            self.velocity[k] = (self.commanded[k] - before) / CYCLE;
        }
        self.next = (self.next + 1) % MEAN;
        self.commanded
    }

    fn advance(&mut self, k: usize) -> f64 {
        let acceleration = ACCELERATION * self.arm.acceleration[k];
        let joint = &mut self.joints[k];
        let here = joint.course.value;
        let up = joint.target > here;
        let limits = Limits { rate: rate(self.arm, k, here, up), acceleration, ..Limits::NONE };
        joint.recent[self.next] = joint.course.advance(joint.target, &limits, CYCLE);
        let first = joint.recent[0];
        // The mean of equal values is that value, to the bit.
        first + joint.recent.iter().map(|value| value - first).sum::<f64>() / MEAN as f64
    }
}

/// Largest velocity of a joint towards one side.
fn rate(arm: &ArmLimits, k: usize, q: f64, up: bool) -> f64 {
    let acceleration = ACCELERATION * arm.acceleration[k];
    let largest = arm.velocity[k] - LOST * CYCLE * arm.acceleration[k];
    let (offset, deceleration) = arm.approach(k);
    if deceleration == 0.0 {
        return largest;
    }
    let [low, high] = arm.position[k];
    let left = (if up { high - q } else { q - low }).max(0.0);
    let share = (APPROACH * acceleration / deceleration).min(1.0).sqrt();
    largest.min(((2.0 * deceleration * left).sqrt() - offset).max(0.0) * share)
}

#[cfg(test)]
mod tests {
    use super::*;
    use protocol::franka::{FER, FR3};

    /// Largest shares of the arm's limits of velocity, acceleration and jerk that a motion takes.
    fn shares(arm: &'static ArmLimits, commands: &[[f64; JOINTS]]) -> [f64; 3] {
        let mut largest = [0.0_f64; 3];
        for k in 0..JOINTS {
            let q: Vec<_> = commands.iter().map(|command| command[k]).collect();
            let derive = |values: &[f64]| {
                values.windows(2).map(|pair| (pair[1] - pair[0]) / CYCLE).collect::<Vec<_>>()
            };
            let velocity = derive(&q);
            let acceleration = derive(&velocity);
            for (at, v) in velocity.iter().enumerate() {
                let [down, up] = arm.velocity_at(k, q[at]);
                let bound = if *v < 0.0 { -down } else { up };
                largest[0] = largest[0].max(if *v == 0.0 { 0.0 } else { v.abs() / bound });
            }
            for a in &acceleration {
                largest[1] = largest[1].max(a.abs() / arm.acceleration[k]);
            }
            for jerk in derive(&acceleration) {
                largest[2] = largest[2].max(jerk.abs() / arm.jerk[k]);
            }
            let [low, high] = arm.position[k];
            assert!(q.iter().all(|q| (low..=high).contains(q)), "joint {k}");
        }
        largest
    }

    #[test]
    fn no_sequence_of_targets_leads_beyond_the_limits_of_either_arm() {
        for arm in [&FER, &FR3] {
            let start = std::array::from_fn(|k| f64::midpoint(arm.position[k][0], arm.position[k][1]));
            let mut rng = random::Generator::pcg64(7_u64);
            let mut commands = vec![start; 4];
            let mut generator = Generator::at(arm, start, false);
            for _ in 0..400 {
                // Targets anywhere, often at the ends, after 1 to 400 ms.
                for k in 0..JOINTS {
                    let [low, high] = Generator::range(arm, k);
                    let share = (3.0 * rng.random() - 1.0).clamp(0.0, 1.0);
                    generator.aim(k, low + share * (high - low));
                }
                let pause = rng.integer(1..400).unwrap();
                commands.extend((0..pause).map(|_| generator.step()));
            }
            generator.halt();
            commands.extend((0..1000).map(|_| generator.step()));
            assert!(generator.at_rest());
            let [v, a, j] = shares(arm, &commands);
            assert!(v <= 1.0 && a <= 0.8 + 1e-6 && j <= 0.2 + 1e-4, "{v} {a} {j}");
            assert!(v > 0.9 && a > 0.75, "the limits are used: {v} {a}");
        }
    }

    #[test]
    fn it_begins_where_it_stands_and_ends_at_the_target_to_the_bit() {
        let start = [0.1, 0.2, -0.3, -2.0, 0.123_456_789, 2.0, 0.7];
        let mut generator = Generator::at(&FER, start, false);
        assert_eq!(generator.step(), start);
        generator.aim(0, 0.5);
        let cycles = (0..).take_while(|_| generator.step()[0] != 0.5).count();
        // 0.4 rad with 12 rad/s² and at most 2.13 rad/s, and 16 ms of the mean.
        assert!((366..400).contains(&cycles), "{cycles}");
        assert!(
            generator.at_rest() || {
                generator.step();
                generator.at_rest()
            }
        );
        let mut direct = Generator::at(&FER, start, true);
        direct.aim(0, 0.5);
        assert_eq!(direct.step()[0], 0.5);
    }

    #[test]
    fn it_halts_within_its_braking_distance() {
        let mut generator = Generator::at(&FER, [0.0; JOINTS], false);
        generator.aim(0, 2.0);
        for _ in 0..500 {
            generator.step();
        }
        let before = generator.commanded()[0];
        generator.halt();
        let cycles = (0..1000)
            .take_while(|_| {
                generator.step();
                !generator.at_rest()
            })
            .count();
        let way = generator.commanded()[0] - before;
        // 2.13 rad/s with 12 rad/s²: 0.178 s and 0.189 rad, and half the mean's 16 ms at full speed.
        assert!(cycles < 200 && (0.19..0.22).contains(&way), "{cycles} {way}");
        generator.aim(0, -2.0);
        assert_eq!(generator.step()[0], before + way);
        generator.resume();
        generator.aim(0, -2.0);
        assert!(generator.step()[0] < before + way);
    }
}
