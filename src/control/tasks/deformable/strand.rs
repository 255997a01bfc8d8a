//! The loose end of a rope: where it is taken, and how.

use crate::error::ControlError;
use crate::tasks::arms::arm::Arm;
use crate::tasks::arms::frame::Frame;
use crate::tasks::arms::moves::Move;
use env::Env;
use physics::elements::{BodyId, SiteId};
use physics::math::{Vec3, add, norm, ops, scale, sub};

/// How far over the rope the hand comes \[m\].
const ABOVE: f64 = 0.08;
/// How far over the middle of the rope the fingertips hold it \[m\].
const OVER: f64 = 0.005;
/// Width of the rope \[m\].
const WIDTH: f64 = 0.01;
/// Which link is held, from the loose end: the fingers are to have rope on both sides.
const HELD: usize = 2;

/// A rope of links `rope_0` … that ends at the site `rope_end`.
pub struct Strand {
    links: Vec<BodyId>,
    end: SiteId,
}

/// Where a rope can be held.
pub struct Grip {
    /// Its first end \[m\].
    pub first: Vec3,
    /// Its loose end \[m\].
    pub end: Vec3,
    /// Where the fingertips hold it \[m\].
    pub place: Vec3,
    /// Direction of the rope there, in the plane of the table \[rad\].
    pub along: f64,
    /// Length from the first end to there \[m\].
    pub length: f64,
}

impl Strand {
    /// Opening of the gripper around the rope, 0 to 1.
    pub const OPEN: f64 = 0.5;

    /// The rope of an environment.
    ///
    /// # Errors
    /// It has none.
    pub fn new(env: &Env) -> Result<Self, ControlError> {
        let scene = env.scene();
        let links: Vec<BodyId> = (0..).map_while(|k| scene.model.body(&format!("rope_{k}"))).collect();
        if links.len() <= HELD {
            return Err(ControlError::unfit(env, "the scene has no rope"));
        }
        Ok(Strand { links, end: scene.site("rope_end")? })
    }

    /// Where it is held near its loose end.
    pub fn grip(&self, env: &Env) -> Grip {
        let data = &env.scene().data;
        let place = |k: usize| *data.body(self.links[k]).xpos();
        let held = self.links.len() - HELD;
        let (begins, ends) = (place(held), place(held + 1));
        let link = sub(ends, begins);
        Grip {
            first: place(0),
            end: *data.site(self.end).xpos(),
            place: add(scale(add(begins, ends), 0.5), [0.0, 0.0, OVER]),
            along: ops::atan2(link[1], link[0]),
            // All links are as long as this one, which is held in its middle.
            length: norm(link) * (held as f64 + 0.5),
        }
    }

    /// Moves that take it, with fingers that close along the direction at `angle` in the plane of the table \[rad\].
    pub fn grasp(&self, arm: &Arm, grip: &Grip, angle: f64) -> Vec<Move> {
        let hold = down(arm, grip.place, angle);
        let above = hold.moved([0.0, 0.0, ABOVE]);
        let towards =
            |to, opening, speed, pause| Move { straight: false, ..Move::precise(to, opening, speed, pause) };
        vec![
            towards(above, Self::OPEN, 1.0, 0.2),
            Move::precise(hold, Self::OPEN, 0.25, 0.4),
            Move::precise(hold, 0.0, 1.0, 0.4),
        ]
    }
}

/// The tool with its fingertips at a place, the hand pointing down and fingers that close along the direction at `angle` in the plane of the
/// table \[rad\].
pub fn down(arm: &Arm, place: Vec3, angle: f64) -> Frame {
    let (sine, cosine) = ops::sincos(angle);
    arm.hand.around(place, WIDTH, [0.0, 0.0, -1.0], [cosine, sine, 0.0])
}
