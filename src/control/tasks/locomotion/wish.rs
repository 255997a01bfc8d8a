//! What tasks ask of a body that walks: the velocity that would do it, from what is observed. Points are in the frame of the heading:
//! forward, left \[m\]; lengths are in heights of the root.

use env::OwnRows;
use physics::math::ops;
use robot::Walk;

/// Distance at which a body passes a post.
const PASS: f64 = 1.7;
/// Distance of the root behind a box from which the box is pushed.
const BEHIND: f64 = 2.2;
/// Distance of the root from the line of pushing within which it pushes on.
const ALIGNED: f64 = 0.5;
/// Distance of the box from its place at which the body stops.
const THERE: f64 = 0.3;
/// Share of the walking speed at which the body pushes.
const PACE: f64 = 0.5;
/// Velocity to the side at that distance, as a share of the walking speed.
const SIDESTEP: f64 = 0.4;

/// What a wish is made of.
pub struct Facts<'a> {
    /// The observation.
    pub rows: OwnRows<'a>,
    /// How fast the body walks.
    pub walk: Walk,
    /// Height of the root \[m\].
    pub height: f64,
}

/// The wish of a task: forward, to the left \[m/s\], counterclockwise \[rad/s\].
pub type Wish = fn(&Facts<'_>) -> [f64; 3];

/// The wish of the task of this name; of one that it does not know, to stand.
pub fn wish(task: &str) -> Wish {
    match task {
        "velocity" => |facts| [0, 1, 2].map(|i| facts.rows["command"][i]),
        "turn" => |facts| {
            let error = facts.rows["direction_error"][0];
            [0.0, 0.0, facts.walk.turn * (2.0 * error).clamp(-1.0, 1.0)]
        },
        "walk_to" | "chase" => |facts| {
            let target = facts.point("target_error");
            facts.towards(target, length(target))
        },
        "weave" => |facts| facts.towards(facts.around(), length(facts.point("target_error"))),
        "push_box" => |facts| facts.push(),
        _ => |_| [0.0; 3],
    }
}

impl Facts<'_> {
    pub fn point(&self, row: &str) -> [f64; 2] {
        [self.rows[row][0], self.rows[row][1]]
    }

    /// The velocity that brings the body towards a point: it turns, walks as far as it looks there, and slows down where it is `far`
    /// from the end of its way no more \[m\].
    pub fn towards(&self, point: [f64; 2], far: f64) -> [f64; 3] {
        let Walk { speed, turn } = self.walk;
        let angle = ops::angle(point[1], point[0]);
        let pace = speed * (1.0 - angle.abs()).clamp(0.0, 1.0) * (far / speed).min(1.0);
        [pace, 0.0, turn * (2.0 * angle).clamp(-1.0, 1.0)]
    }

    /// The target, or a point beside the first post that stands in the way to it.
    fn around(&self) -> [f64; 2] {
        let target = self.point("target_error");
        let far = length(target);
        let [x, y] = target.map(|part| part / far);
        let posts =
            self.rows["posts"].chunks(2).map(|post| (x * post[0] + y * post[1], x * post[1] - y * post[0]));
        let pass = PASS * self.height;
        let in_the_way = posts.filter(|(along, left)| *along > 0.0 && *along < far && left.abs() < pass);
        let Some((along, left)) = in_the_way.min_by(|a, b| a.0.total_cmp(&b.0)) else { return target };
        let side = if left > 0.0 { left - pass } else { left + pass };
        [x * along - y * side, y * along + x * side]
    }

    /// Towards the target, with the box before the body; else to a point behind the box, or beside it on the way there.
    fn push(&self) -> [f64; 3] {
        let (load, target) = (self.point("box_error"), self.point("target_error"));
        let way = [target[0] - load[0], target[1] - load[1]];
        let far = length(way);
        if far < THERE * self.height {
            return [0.0; 3];
        }
        let [x, y] = way.map(|part| part / far);
        // The body from the box, along the line of pushing and to the left of it.
        let (along, left) = (-(x * load[0] + y * load[1]), y * load[0] - x * load[1]);
        let point = |along: f64, left: f64| [load[0] + x * along - y * left, load[1] + y * along + x * left];
        let behind = -BEHIND * self.height;
        if along < 0.0 && left.abs() < ALIGNED * self.height {
            // Sidesteps to the line, looking along it.
            let [pace, _, round] = self.towards(way, far);
            let aside = (-left / (ALIGNED * self.height)).clamp(-1.0, 1.0);
            return [PACE * pace, SIDESTEP * self.walk.speed * aside, round];
        }
        let beside = if along < 0.7 * behind { 0.0 } else { -behind * left.signum() };
        self.towards(point(behind, beside), self.walk.speed)
    }
}

/// Length of a vector in the plane.
pub fn length([x, y]: [f64; 2]) -> f64 {
    (x * x + y * y).sqrt()
}
