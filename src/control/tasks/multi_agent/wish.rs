//! What an agent asks of its body: a velocity, from what it observes. Points are in the frame of the heading: forward, left \[m\].

use super::ball::play;
use crate::tasks::locomotion::wish::{Facts, Wish, length};

/// Distance of a pusher from the middle of the line of pushing \[m\].
const ASIDE: f64 = 0.24;
/// Distance from that place within which a pusher goes on forward, sidestepping \[m\].
const ALIGNED: f64 = 0.12;
/// Velocity to the side at that distance, as a share of the walking speed.
const SIDESTEP: f64 = 0.4;
/// Distance by which a pusher is ahead of the other at which it stands and waits \[m\].
const LEAD: f64 = 0.15;
/// Distance of the box from its place at which a pusher stops \[m\].
const THERE: f64 = 0.1;
/// Room that two bodies leave each other, in heights of the root.
const PASS: f64 = 2.6;
/// How fast an evader flees, as a share of its walking speed.
const FLIGHT: f64 = 0.7;
/// Share of the way to the centre that draws an evader back to it.
const HOME: f64 = 0.35;

/// The wish of an agent in the task of this name; in one that it does not know, to stand.
pub fn wish(task: &str, agent: &str) -> Wish {
    match (task, agent) {
        ("pair_push_box", _) => push,
        ("pair_swap", _) => pass,
        ("pair_pass_ball", _) => play,
        ("tag", "chaser") => |facts| facts.towards(facts.point("mate_error"), f64::INFINITY),
        ("tag", "evader") => flee,
        _ => |_| [0.0; 3],
    }
}

/// Along the line from the box to its place, beside the other pusher and not ahead of it.
fn push(facts: &Facts<'_>) -> [f64; 3] {
    let (load, target) = (facts.point("box_error"), facts.point("target_error"));
    let mate = facts.point("mate_error");
    let [x, y] = [target[0] - load[0], target[1] - load[1]];
    let far = length([x, y]);
    // How far the body is ahead of the other, and to the left of it.
    let (lead, beside) = (-(x * mate[0] + y * mate[1]) / far, y * mate[0] - x * mate[1]);
    push_from(facts, ASIDE * beside.signum(), (1.0 - lead / LEAD).clamp(0.0, 1.0))
}

/// Along the line from the box to its place, so far to the left of it \[m\], at a share of the pace.
pub fn push_from(facts: &Facts<'_>, aside: f64, share: f64) -> [f64; 3] {
    let (load, target) = (facts.point("box_error"), facts.point("target_error"));
    let way = [target[0] - load[0], target[1] - load[1]];
    let far = length(way);
    if far < THERE {
        return [0.0; 3];
    }
    // The body from the box, to the left of the line of pushing.
    let left = (way[1] * load[0] - way[0] * load[1]) / far;
    let [pace, _, round] = facts.towards(way, far);
    let sidestep = ((aside - left) / ALIGNED).clamp(-1.0, 1.0);
    [pace * share, SIDESTEP * facts.walk.speed * sidestep, round]
}

/// Towards the place, to the right past a body that comes along the way.
fn pass(facts: &Facts<'_>) -> [f64; 3] {
    let (target, mate) = (facts.point("target_error"), facts.point("mate_error"));
    let far = length(target);
    let [x, y] = target.map(|part| part / far);
    let (along, left) = (x * mate[0] + y * mate[1], x * mate[1] - y * mate[0]);
    let room = PASS * facts.height;
    let point = if along > 0.0 && along < far && left < room {
        [x * along + y * (room - left), y * along - x * (room - left)]
    } else {
        target
    };
    facts.towards(point, far)
}

/// Away from the chaser, and the more towards the centre the further that is.
fn flee(facts: &Facts<'_>) -> [f64; 3] {
    let (mate, centre) = (facts.point("mate_error"), facts.point("centre_error"));
    let near = length(mate);
    let way = [0, 1].map(|i| HOME * centre[i] - mate[i] / near);
    let [pace, aside, round] = facts.towards(way, f64::INFINITY);
    [FLIGHT * pace, aside, round]
}
