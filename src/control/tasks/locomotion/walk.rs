//! A walk on two feet that follows a command: feet are set down by the divergent component of motion, legs by inverse kinematics, and
//! servos get the torques that bear the weight at the wanted centre of pressure.
//!
//! The body first stands on both feet, which become level. It then moves its weight over the right foot, and steps begin. A body whose
//! task is to stand stays on both feet.

use super::body::Body;
use super::legs::Legs;
use super::seen::{Place, Plane, Seen, about, minus, plus, rotate, wrap};
use super::wish::{Facts, Wish, wish};
use crate::controller::{Controller, command};
use crate::error::ControlError;
use crate::maths::{Pace, Pendulum};
use env::{Env, Rows};
use physics::Data;
use physics::elements::{BodyId, SiteId};
use physics::math::{Quat, ops, quat_mul, quat_normalize};
use robot::{Pose, Walk as Speed};
use std::f64::consts::PI;

/// Duration of a step in times of a fall from the height of the centre of mass, sqrt(h/g).
const PERIOD: f64 = 1.7;
/// Shares of a step in which the foot stays on the ground at its begin, and is back on it at its end.
const GROUND: f64 = 0.1;
/// Height to which feet are lifted, in heights of the root.
const LIFT: f64 = 0.08;
/// Height of the root while it walks, in heights of the root when it stands.
const CROUCH: f64 = 0.95;
/// Rate at which the wanted height changes, in heights a fall.
const LOWER: f64 = 0.045;
/// Share of what the root lacks of its height that an act adds, and most that is added in heights of the root.
const RAISE: [f64; 2] = [0.03, 0.1];
/// Time on both feet before the first step, and that until they are level, in times of a fall.
const SETTLE: [f64; 2] = [4.0, 1.5];
/// Share of the wish that steps are planned for at first: they turn out longer than planned.
const SHARE: f64 = 0.7;
/// Share of what the velocity lacks of the wish that an act adds, forward and otherwise.
const HURRY: [f64; 2] = [0.02, 0.0015];
/// Most that is added, in walking speeds.
const HASTE: f64 = 0.2;
/// Acceleration that commands are limited to, in walking speeds a second.
const RAMP: f64 = 1.0;
/// How much of the divergent component's error the centre of pressure moves by, on one foot and on two.
const GAIN: [f64; 2] = [2.0, 0.5];
/// How far the centre of pressure moves from the middle of a foot, forward and to the side, in distances of the feet.
const SOLE: [f64; 2] = [0.43, 0.27];
/// Share of the difference to what is measured by which the reference is drawn to it: its position on both feet, on one, and its velocity.
const DRAW: [f64; 3] = [0.02, 0.2, 0.2];
/// The same of the planted feet, and of the heading.
const SLIP: [f64; 2] = [0.1, 0.05];
/// Share of the phase's error that an act corrects, and most of it in acts.
const PHASE: [f64; 2] = [0.1, 0.5];
/// How near the divergent component has to be to where a step begins before the first one does, in distances of the feet.
const EARLY: f64 = 0.2;
/// Longest step forward, in heights of the root; smallest one to the side in distances of the feet, and what it may have more than that
/// distance, in heights of the root.
const REACH: [f64; 3] = [0.35, 1.15, 0.3];
/// Share of the step after which its goal stays.
const DECIDED: f64 = 0.9;
/// Share of the root's lean that the swinging foot takes out.
const LEVEL: f64 = 0.2;
/// Difference in height at which a foot is in the air, in heights of the root.
const AIR: f64 = 0.01;

/// The controller.
pub struct Walk {
    legs: Legs,
    root: BodyId,
    feet: [SiteId; 2],
    speed: Speed,
    wish: Wish,
    /// The task is to stand.
    stays: bool,
    /// Height of the root over its feet when it stands \[m\].
    height: f64,
    /// Distance of the feet then \[m\].
    width: f64,
    pendulum: Pendulum,
    now: Now,
    controls: Vec<f64>,
}

/// What changes during an episode.
#[derive(Clone, Default)]
struct Now {
    /// Time since the start \[s\].
    since: f64,
    /// Time in the step \[s\]; `None` before the first one.
    step: Option<f64>,
    /// Index of the foot that stands.
    stance: usize,
    /// Velocity that steps are planned for \[m/s, rad/s\].
    velocity: [f64; 3],
    /// The wish, approached at a limited rate, and what is added to its share.
    wanted: [f64; 3],
    lacking: [f64; 3],
    heading: f64,
    /// Position and velocity of the centre of mass that the legs follow.
    reference: [Plane; 2],
    /// Where feet stand.
    planted: [Place; 2],
    /// Height \[m\] over the level and incline of the feet at the start.
    uneven: [(f64, Quat); 2],
    /// Where the swinging foot left the ground, and where it goes.
    left: Place,
    goal: Plane,
    /// Height that is wanted, and what is added to it \[m\].
    tall: f64,
    raised: f64,
}

/// The centre of pressure, from the foot that stands in the frame of the heading.
struct Pressure {
    at: Plane,
    /// From the middle of each foot.
    offset: Plane,
    /// Share of the weight on the other foot.
    other: f64,
}

impl Walk {
    /// The controller for a body with two legs.
    ///
    /// # Errors
    /// A task without roles; a body that has not two feet, or whose legs are not of servos.
    pub fn new(env: &Env) -> Result<Self, ControlError> {
        let m = &env.scene().model;
        let Body { root, feet, stand, walk, .. } = Body::new(env, "", "walk", 2)?;
        let mut legs = Legs::new(env, root, &feet, &stand)?;
        let homes = legs.homes(m);
        let mut posed = Data::new(m);
        posed.state.qpos.copy_from_slice(&stand);
        physics::forward(m, &mut posed)?;
        let over = posed.com.subtree_com[root.index()][2] - posed.kin.site_xpos[feet[0].index()][2];
        Ok(Walk {
            legs,
            root,
            feet: [feet[0], feet[1]],
            speed: walk,
            wish: wish(&env.spec().task),
            stays: env.spec().task == "stand",
            height: -homes[0][2],
            width: (homes[0][1] - homes[1][1]).abs(),
            pendulum: Pendulum::of_height(over),
            now: Now::default(),
            controls: vec![0.0; m.nu],
        })
    }

    /// Whether the body is on both feet.
    fn is_on_both(&self) -> bool {
        self.now.step.is_none()
    }

    /// Whether it waits on both feet, or stays there.
    fn waits(&self) -> bool {
        self.stays || self.now.since < SETTLE[0] / self.pendulum.rate
    }

    /// Approaches the wish, and the height; returns the height of the root over the feet that the legs are to have.
    fn follow(&mut self, rows: &Rows, dt: f64) -> f64 {
        let Speed { speed, turn } = self.speed;
        let wanted = (self.wish)(&Facts { rows: rows.of(""), walk: self.speed, height: self.height });
        if self.is_on_both() {
            (self.now.wanted, self.now.lacking) = ([0.0; 3], [0.0; 3]);
        }
        let measured = [rows["velocity"][0], rows["velocity"][1], rows["turning"][2]];
        let now = &mut self.now;
        for (i, (most, hurry)) in
            [(speed, HURRY[0]), (speed, HURRY[1]), (turn, HURRY[1])].into_iter().enumerate()
        {
            let step = RAMP * most * dt;
            now.wanted[i] += (wanted[i] - now.wanted[i]).clamp(-step, step);
            let lacking = now.lacking[i] + hurry * (now.wanted[i] - measured[i]);
            now.lacking[i] = lacking.clamp(-HASTE * most, HASTE * most);
            now.velocity[i] = SHARE * now.wanted[i] + now.lacking[i];
        }
        let usual = if self.stays { self.height } else { CROUCH * self.height };
        let goal = rows.get("height_command").map_or(usual, |row| row[0]);
        let step = LOWER * self.height * self.pendulum.rate * dt;
        self.now.tall += (goal - self.now.tall).clamp(-step, step);
        let most = RAISE[1] * self.height;
        let raised = self.now.raised + RAISE[0] * (self.now.tall - rows["height"][0]);
        self.now.raised = raised.clamp(-most, most);
        self.now.tall + self.now.raised
    }

    /// Draws what is remembered to what is measured.
    fn draw(&mut self, seen: &Seen, dt: f64) {
        let now = &mut self.now;
        now.since += dt;
        now.heading += now.velocity[2] * dt;
        now.heading = wrap(now.heading + SLIP[1] * wrap(seen.yaw - now.heading));
        let position = DRAW[usize::from(now.step.is_some())];
        let shares = [position, DRAW[2]];
        for ((reference, real), share) in now.reference.iter_mut().zip([seen.mass, seen.velocity]).zip(shares)
        {
            *reference = [0, 1].map(|i| reference[i] + share * (real[i] - reference[i]));
        }
        for (planted, foot) in now.planted.iter_mut().zip(&seen.feet) {
            planted.at = [0, 1].map(|i| planted.at[i] + SLIP[0] * (foot.place.at[i] - planted.at[i]));
            planted.yaw += SLIP[0] * wrap(foot.place.yaw - planted.yaw);
        }
    }

    /// A point from a foot, in the frame of the heading.
    fn beside(&self, point: Plane, foot: usize, seen: &Seen) -> Plane {
        rotate(minus(point, seen.feet[foot].place.at), -self.now.heading)
    }

    /// 1 while the right foot stands, -1 while the left one does.
    fn side(&self) -> f64 {
        if self.now.stance == 0 { -1.0 } else { 1.0 }
    }

    /// Advances the step by `dt` seconds, less or more by what the divergent component is behind or ahead, and changes feet at its end.
    fn advance(&mut self, seen: &Seen, divergent: Plane, pace: &Pace, dt: f64) {
        let stance = self.now.stance;
        let (ends, rest) = if let Some(time) = self.now.step {
            let begin = self.pendulum.begin(pace, self.side());
            let aside = self.beside(divergent, stance, seen)[1];
            let late = self.pendulum.time(aside * self.side(), begin[1] * self.side()) - time;
            let most = PHASE[1] * dt;
            let time = time + dt + (PHASE[0] * late).clamp(-most, most);
            self.now.step = Some(time);
            (time >= pace.period, time - pace.period)
        } else {
            let near = self.beside(divergent, 1 - stance, seen)[1].abs();
            let begin = self.pendulum.begin(pace, 1.0)[1].abs();
            (!self.waits() && near < begin + EARLY * self.width, 0.0)
        };
        if ends {
            self.now.left = seen.feet[stance].place;
            self.now.stance = 1 - stance;
            self.now.step = Some(rest);
            self.now.planted[1 - stance] = seen.feet[1 - stance].place;
        }
    }

    /// The centre of pressure that brings the divergent component, seen from the foot that stands, to where it is to be.
    fn press(&self, seen: &Seen, divergent: Plane, pace: &Pace) -> Pressure {
        let stance = self.now.stance;
        let apart = self.beside(seen.feet[1 - stance].place.at, stance, seen);
        let sole = SOLE.map(|share| share * self.width);
        let Some(time) = self.now.step else {
            let back = |i: usize| divergent[i] + GAIN[1] * (divergent[i] - 0.5 * apart[i]);
            // All weight on the foot from which the first step goes, else as much on each as keeps the body over the middle.
            let wanted = [back(0), if self.waits() { back(1) } else { 0.0 }];
            let along = wanted[0] * apart[0] + wanted[1] * apart[1];
            let share = (along / (apart[0] * apart[0] + apart[1] * apart[1])).clamp(0.0, 1.0);
            let (rise, air) = (seen.feet[1 - stance].height - seen.feet[stance].height, AIR * self.height);
            let other = if rise > air {
                0.0
            } else if rise < -air {
                1.0
            } else {
                share
            };
            let offset = [0, 1].map(|i| (wanted[i] - other * apart[i]).clamp(-sole[i], sole[i]));
            return Pressure { at: [0, 1].map(|i| offset[i] + other * apart[i]), offset, other };
        };
        let regular =
            self.pendulum.begin(pace, self.side()).map(|begin| self.pendulum.later(begin, 0.0, time));
        let at = [0, 1].map(|i| (GAIN[0] * (divergent[i] - regular[i])).clamp(-sole[i], sole[i]));
        Pressure { at, offset: at, other: 0.0 }
    }

    /// Poses of the planted feet from a root over `root` at this height, while they become level.
    fn stand(&self, root: Plane, height: f64) -> [Pose; 2] {
        let uneven = (1.0 - self.now.since * self.pendulum.rate / SETTLE[1]).max(0.0);
        [0, 1].map(|k| {
            let (rise, [a, b, c, d]) = self.now.uneven[k];
            let incline = quat_normalize([a * uneven + 1.0 - uneven, b * uneven, c * uneven, d * uneven]);
            self.pose(&self.now.planted[k], uneven * rise - height, root, incline)
        })
    }

    /// Pose of a foot at `up` over a root over `root`, in its frame.
    fn pose(&self, place: &Place, up: f64, root: Plane, incline: Quat) -> Pose {
        let [x, y] = rotate(minus(place.at, root), -self.now.heading);
        let orientation = quat_mul(incline, about(wrap(place.yaw - self.now.heading)));
        Pose { position: Some([x, y, up]), orientation: Some(orientation) }
    }

    /// Where the foot in the air is to be at `time` in the step, and its height; its goal is where the next step begins regularly.
    fn swing(
        &mut self,
        (time, pace): (f64, &Pace),
        seen: &Seen,
        divergent: Plane,
        pressure: Plane,
    ) -> (Place, f64) {
        let (side, rest) = (self.side(), pace.period - time);
        let end = [0, 1].map(|i| self.pendulum.later(divergent[i], pressure[i], rest));
        let mut step = minus(end, self.pendulum.begin(pace, -side));
        let reach = REACH[0] * self.height;
        step[0] = step[0].clamp(-reach, reach);
        let widest = self.width + REACH[2] * self.height;
        step[1] = side * (side * step[1]).clamp(REACH[1] * self.width, widest);
        let part = ((time / pace.period - GROUND) / (1.0 - 2.0 * GROUND)).clamp(0.0, 1.0);
        if part < DECIDED {
            self.now.goal = plus(seen.feet[self.now.stance].place.at, rotate(step, self.now.heading));
        }
        // Leaves and reaches the ground without a jump in velocity.
        let way = part - ops::sin(2.0 * PI * part) / (2.0 * PI);
        let Place { at, yaw } = self.now.left;
        let goal = self.now.heading + self.now.velocity[2] * (rest + pace.period / 2.0);
        let at = [0, 1].map(|i| at[i] + way * (self.now.goal[i] - at[i]));
        (Place { at, yaw: yaw + way * wrap(goal - yaw) }, LIFT * self.height * ops::sin(PI * part))
    }
}

/// A pose of a foot with a share of the root's lean taken out; `up` is the vertical in the frame of the root.
fn levelled(pose: Pose, up: &[f64]) -> Pose {
    let [u, v] = [LEVEL * up[0], LEVEL * up[1]];
    let tilt = quat_normalize([1.0, -0.5 * v, 0.5 * u, 0.0]);
    Pose {
        position: pose.position.map(|[x, y, z]| [x + u * z, y + v * z, z - u * x - v * y]),
        orientation: pose.orientation.map(|orientation| quat_mul(tilt, orientation)),
    }
}

impl Controller for Walk {
    fn reset(&mut self, env: &Env, _: u64) -> Result<(), ControlError> {
        let (m, d) = (&env.scene().model, &env.scene().data);
        self.legs.begin(m, &d.state.qpos);
        let seen = Seen::new(m, d, self.root, self.feet);
        self.now = Now {
            heading: seen.yaw,
            reference: [seen.mass, seen.velocity],
            planted: seen.feet.map(|foot| foot.place),
            uneven: seen.feet.map(|foot| (foot.height - seen.root[2] + self.height, foot.incline)),
            tall: self.height,
            ..Now::default()
        };
        Ok(())
    }

    fn act(&mut self, env: &Env, action: &mut [f64]) -> Result<(), ControlError> {
        let (m, d, rows, dt) = (&env.scene().model, &env.scene().data, env.rows(), env.dt());
        let seen = Seen::new(m, d, self.root, self.feet);
        let height = self.follow(rows, dt);
        self.draw(&seen, dt);
        let [ahead, left, _] = self.now.velocity;
        let period = PERIOD / self.pendulum.rate;
        let pace = Pace { velocity: [ahead, left], width: self.width, period };
        let divergent = [0, 1].map(|i| self.pendulum.divergent(seen.mass[i], seen.velocity[i]));
        self.advance(&seen, divergent, &pace, dt);
        let stance = self.now.stance;
        let divergent = self.beside(divergent, stance, &seen);
        let pressure = self.press(&seen, divergent, &pace);
        let centre = plus(seen.feet[stance].place.at, rotate(pressure.at, self.now.heading));
        let [place, velocity] = self.now.reference;
        let moved = [0, 1].map(|i| self.pendulum.moved([place[i], velocity[i]], centre[i], dt));
        self.now.reference = [moved.map(|[place, _]| place), moved.map(|[_, velocity]| velocity)];
        let root = minus(self.now.reference[0], minus(seen.mass, [seen.root[0], seen.root[1]]));
        let mut poses = self.stand(root, height);
        if let Some(time) = self.now.step {
            let (place, lift) = self.swing((time, &pace), &seen, divergent, pressure.at);
            let level = [1.0, 0.0, 0.0, 0.0];
            poses[stance] = self.pose(&self.now.planted[stance], -height, root, level);
            poses[1 - stance] = levelled(self.pose(&place, lift - height, root, level), &rows["up"]);
        }
        self.legs.solve(m, &poses, dt, &mut self.controls);
        let weight = 9.81 * m.body_subtreemass[self.root.index()];
        for (leg, share) in [(stance, 1.0 - pressure.other), (1 - stance, pressure.other)] {
            let foot = seen.feet[leg];
            let [x, y] = plus(foot.place.at, rotate(pressure.offset, self.now.heading));
            self.legs.bear(m, d, leg, ([x, y, foot.height], [0.0, 0.0, share * weight]), &mut self.controls);
        }
        command(env, &self.controls, action)
    }
}
