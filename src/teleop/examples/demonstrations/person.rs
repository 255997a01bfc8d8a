//! A scripted person: sees hand, cube and target, and says what to do.

use super::scene::Task;
use super::speaker::{TICK, Wish};
use env::Env;
use std::f64::consts::FRAC_PI_2;

/// How far above the table the hand goes where nothing is to be touched \[m\].
const ABOVE: f64 = 0.14;
/// Where fingers push the cube, and do not touch the table \[m\].
const LOW: f64 = 0.032;
/// A distance of the hand that is none \[m\], and an angle \[rad\].
const NEAR: f64 = 0.008;
const TURNED: f64 = 0.06;
/// The part of a way that a person goes in a tick.
const PART: f64 = 0.15;
/// Most that a push moves the hand in a tick \[m\].
const PUSH: f64 = 0.008;

/// What a person has got to.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
enum Stage {
    #[default]
    Over,
    Down,
    Close(u32),
    Carry,
}

/// A person, in the middle of a task.
#[derive(Debug, Default)]
pub struct Person {
    stage: Stage,
}

type Place = [f64; 3];

/// What a person sees.
struct Seen {
    hand: Place,
    /// Angle of the line between the fingers \[rad\], of a gripper that is the same after half a turn.
    fingers: f64,
    cube: Place,
    target: Place,
}

fn seen(env: &Env) -> Seen {
    let scene = env.scene();
    let (model, kin) = (&scene.model, &scene.data.kin);
    // Reaching has no cube.
    let place = |name: &str| model.site(name).map(|site| kin.site_xpos[site.index()]).unwrap_or_default();
    let hand = model.site("grasp").map(|site| kin.site_xmat[site.index()]).unwrap_or_default();
    Seen {
        hand: place("grasp"),
        fingers: hand[4].atan2(hand[1]),
        cube: place("cube"),
        target: place("target"),
    }
}

fn way(from: Place, to: Place) -> Place {
    [0, 1, 2].map(|k| to[k] - from[k])
}

fn length(way: Place) -> f64 {
    way.iter().map(|x| x * x).sum::<f64>().sqrt()
}

/// A motion of the hand by a way: as the arm is behind what it is told, a part of it a tick.
fn go(by: Place) -> Wish {
    Wish { by: by.map(|x| (PART * x).clamp(-TICK, TICK)), ..Wish::default() }
}

impl Person {
    /// What the person does next.
    pub fn wish(&mut self, env: &Env, task: Task) -> Wish {
        let seen = seen(env);
        let wish = match task {
            Task::Reach => go(way(seen.hand, seen.target)),
            Task::Push => self.push(&seen),
            Task::PickUp => self.pick_up(&seen),
        };
        Wish { done: env.verdict().solved, ..wish }
    }

    /// Behind the cube as seen from the target, down to the table, and on.
    fn push(&mut self, Seen { hand, cube, target, .. }: &Seen) -> Wish {
        let [x, y, _] = way(*cube, *target);
        let far = x.hypot(y).max(1e-9);
        let (ahead, aside) = ([x / far, y / far], [-y / far, x / far]);
        let behind = |by: f64, height: f64| [cube[0] - by * ahead[0], cube[1] - by * ahead[1], height];
        match self.stage {
            Stage::Over => {
                let by = way(*hand, behind(0.08, ABOVE));
                if length(by) < 2.0 * NEAR {
                    self.stage = Stage::Down;
                }
                Wish { grip: Some(true), ..go(by) }
            }
            Stage::Down => {
                let by = way(*hand, behind(0.08, LOW));
                if length(by) < 2.0 * NEAR {
                    self.stage = Stage::Carry;
                }
                go(by)
            }
            _ => {
                // Straight on, and back into the line that leads through the cube.
                let [dx, dy, _] = way(*hand, *cube);
                let off = dx * aside[0] + dy * aside[1];
                if off.abs() > 0.025 || dx * ahead[0] + dy * ahead[1] < 0.0 {
                    self.stage = Stage::Over;
                }
                let by = [0, 1].map(|k| PUSH * ahead[k] + PART * off * aside[k]);
                Wish { by: [by[0], by[1], PART * (LOW - hand[2])], ..Wish::default() }
            }
        }
    }

    /// Over the cube with the fingers along its sides, down, closed, and to the target.
    fn pick_up(&mut self, Seen { hand, fingers, cube, target }: &Seen) -> Wish {
        match self.stage {
            Stage::Over => {
                let turn = FRAC_PI_2 * (fingers / FRAC_PI_2).round() - fingers;
                let by = way(*hand, [cube[0], cube[1], cube[2] + 0.1]);
                if length(by) < NEAR && turn.abs() < TURNED {
                    self.stage = Stage::Down;
                }
                Wish { turn: PART * turn, grip: Some(false), ..go(by) }
            }
            Stage::Down => {
                let by = way(*hand, *cube);
                if length(by) < NEAR {
                    self.stage = Stage::Close(0);
                }
                go(by)
            }
            Stage::Close(ticks) => {
                self.stage = if ticks < 6 { Stage::Close(ticks + 1) } else { Stage::Carry };
                Wish { grip: Some(true), ..Wish::default() }
            }
            Stage::Carry => {
                if length(way(*hand, *cube)) > 0.06 {
                    self.stage = Stage::Over;
                }
                go(way(*cube, *target))
            }
        }
    }
}
