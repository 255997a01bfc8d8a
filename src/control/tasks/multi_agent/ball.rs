//! What a player asks of its body: to kick a ball to another body, and to wait for one that comes. Points are in the frame of the heading:
//! forward, left; lengths are in heights of the root, unless they are said to be in metres.

use crate::tasks::locomotion::wish::{Facts, length};
use physics::math::ops;

/// Distance of the root behind the ball from which a player runs at it.
const BEHIND: f64 = 1.7;
/// Distance of the root from the line of the kick within which it runs.
const ALIGNED: f64 = 0.15;
/// Angle from that line within which it runs \[rad\].
const STRAIGHT: f64 = 0.15;
/// Distance to the side at which it passes the ball on the way behind it.
const ROUND: f64 = 1.6;
/// Distance from the middle of the field up to which a player goes.
const LINE: f64 = 2.5;
/// Distance over which a body slows down as it comes to a place.
const SLOW: f64 = 0.6;
/// Fastest step to the side, as a share of the walking speed.
const SIDESTEP: f64 = 0.6;
/// Speed towards the other body at which a ball needs no more pushing, and that at which one comes, as shares of the walking speed.
const ROLLING: f64 = 1.0;
const COMING: f64 = 0.1;
/// How far ahead its way is looked at \[s\].
const AHEAD: f64 = 5.0;

type Point = [f64; 2];

/// The player's wish.
pub fn play(facts: &Facts<'_>) -> [f64; 3] {
    let [ball, mate, forth] = ["ball_error", "mate_error", "forth"].map(|row| facts.point(row));
    let (here, line) = (facts.rows["line_distance"][0], LINE * facts.height);
    let way = unit([mate[0] - ball[0], mate[1] - ball[1]]);
    // How far the ball is in the own half [m], and whether it is on its way.
    let own = here - dot(ball, forth);
    let gone =
        own < 0.0 || here < line && dot(facts.point("ball_velocity"), way) > ROLLING * facts.walk.speed;
    match facts.rows["turn"][0] {
        1.0 if gone => step(facts, scale(forth, (here - line).min(0.0)), forth),
        1.0 => kick(facts, ball, way),
        -1.0 => {
            let [pace, aside, round] = step(facts, meet(facts, ball, forth, own > 0.0), unit(ball));
            // A body that waits goes no farther than the line.
            let most = facts.walk.speed * (here - line) / (SLOW * facts.height);
            let beyond = (dot([pace, aside], forth) - most).max(0.0);
            [pace - beyond * forth[0], aside - beyond * forth[1], round]
        }
        _ => [0.0; 3],
    }
}

/// Behind the ball, looking along the way of the pass; then through it.
fn kick(facts: &Facts<'_>, ball: Point, way: Point) -> [f64; 3] {
    let height = facts.height;
    // The body from the ball: along the way, and to the left of it.
    let (along, left) = (-dot(ball, way), way[1] * ball[0] - way[0] * ball[1]);
    let angle = ops::angle(way[1], way[0]);
    let tight = if -along < 0.8 * BEHIND * height { 2.0 } else { 1.0 };
    if along < 0.0 && left.abs() < tight * ALIGNED * height && angle.abs() < tight * STRAIGHT {
        let aside = (-left / (ALIGNED * height)).clamp(-1.0, 1.0);
        return [facts.walk.speed, SIDESTEP * facts.walk.speed * aside, turn(facts, way)];
    }
    let beside = if along < -0.8 * BEHIND * height { 0.0 } else { ROUND * height * sign(left) };
    let back = -BEHIND * height;
    let point = [ball[0] + way[0] * back - way[1] * beside, ball[1] + way[1] * back + way[0] * beside];
    step(facts, point, way)
}

/// Where to meet a ball: on its way, if it comes; else at the ball, if it is in the own half.
fn meet(facts: &Facts<'_>, ball: Point, forth: Point, here: bool) -> Point {
    let speed = facts.point("ball_velocity");
    let coming = -dot(speed, forth);
    if coming > COMING * facts.walk.speed {
        // The point of its way beside the body.
        let time = (dot(ball, forth) / coming).clamp(0.0, AHEAD);
        let side = [-forth[1], forth[0]];
        return scale(side, dot(ball, side) + time * dot(speed, side));
    }
    let near = length(ball);
    scale(ball, if here { (1.0 - facts.height / near).max(0.0) } else { 0.0 })
}

/// To a point \[m\], looking along a direction.
fn step(facts: &Facts<'_>, point: Point, look: Point) -> [f64; 3] {
    let speed = facts.walk.speed;
    let share = |part: f64, most: f64| speed * (part / (SLOW * facts.height)).clamp(-most, most);
    [share(point[0], 1.0), share(point[1], SIDESTEP), turn(facts, look)]
}

fn turn(facts: &Facts<'_>, look: Point) -> f64 {
    facts.walk.turn * (2.0 * ops::angle(look[1], look[0])).clamp(-1.0, 1.0)
}

fn sign(value: f64) -> f64 {
    if value < 0.0 { -1.0 } else { 1.0 }
}

fn dot(a: Point, b: Point) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

fn scale(way: Point, factor: f64) -> Point {
    way.map(|part| factor * part)
}

fn unit(way: Point) -> Point {
    scale(way, 1.0 / length(way).max(f64::MIN_POSITIVE))
}
