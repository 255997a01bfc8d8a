//! The loose end of a rope: where it is taken, and how.

use crate::error::ControlError;
use crate::tasks::arms::arm::Arm;
use crate::tasks::arms::frame::Frame;
use crate::tasks::arms::moves::Move;
use env::Env;
use physics::elements::{BodyId, GeomId, SiteId};
use physics::math::{Vec3, add, distance, norm, ops, scale, sub};
use std::f64::consts::FRAC_PI_2;

/// How far over the rope the hand comes \[m\].
const ABOVE: f64 = 0.08;
/// How far over the middle of the rope the fingertips hold it \[m\].
const OVER: f64 = 0.005;
/// Gap on each side between the rope and fingers that are about to take it \[m\].
const ROOM: f64 = 0.014;
/// Distance from the fingertips at which they have lost it \[m\].
const LOST: f64 = 0.05;
/// Which link is held, from the loose end: the fingers are to have rope on both sides.
const HELD: usize = 2;

/// A rope of links `rope_0` … that ends at the site `rope_end`, where it may have the geom `handle`, a post to take it by.
pub struct Strand {
    links: Vec<BodyId>,
    end: SiteId,
    handle: Option<GeomId>,
    /// Width of what is held \[m\].
    width: f64,
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
        let (m, end) = (&scene.model, scene.site("rope_end")?);
        let handle = m.geom("handle");
        let held = handle.or_else(|| m.body(links[links.len() - 1]).geoms().next());
        let held = held.ok_or_else(|| ControlError::unfit(env, "the last link of the rope has no geom"))?;
        Ok(Strand { links, end, handle, width: 2.0 * m.geom_size[held.index()][0] })
    }

    /// Where it is held near its loose end.
    pub fn grip(&self, env: &Env) -> Grip {
        let data = &env.scene().data;
        let place = |k: usize| *data.body(self.links[k]).xpos();
        let held = self.links.len() - HELD;
        let (begins, ends) = (place(held), place(held + 1));
        let (link, end) = (sub(ends, begins), *data.site(self.end).xpos());
        // All links are as long as this one.
        let (place_held, links) = match self.handle {
            Some(handle) => (*data.geom(handle).xpos(), self.links.len() as f64),
            None => (add(scale(add(begins, ends), 0.5), [0.0, 0.0, OVER]), held as f64 + 0.5),
        };
        Grip {
            first: place(0),
            end,
            place: place_held,
            along: ops::atan2(link[1], link[0]),
            length: norm(link) * links,
        }
    }

    /// Angle from the direction of the rope to that in which fingers close that are to pull it: across it, or `post` where they take hold of a
    /// post \[rad\].
    pub fn closing(&self, post: f64) -> f64 {
        if self.handle.is_some() { post } else { FRAC_PI_2 }
    }

    /// Whether fingers that held it have lost it.
    pub fn is_lost(&self, env: &Env, arm: &Arm) -> bool {
        distance(arm.tool(env).place, self.grip(env).place) > LOST
    }

    /// Opening of the hand's fingers around what is held, 0 to 1.
    pub fn opening(&self, arm: &Arm) -> f64 {
        arm.hand.opening(self.width + 2.0 * ROOM)
    }

    /// The tool with its fingertips at a place, the hand pointing down and fingers that close along the direction at `angle` in the plane of the
    /// table \[rad\].
    pub fn down(&self, arm: &Arm, place: Vec3, angle: f64) -> Frame {
        let (sine, cosine) = ops::sincos(angle);
        arm.hand.around(place, self.width, [0.0, 0.0, -1.0], [cosine, sine, 0.0])
    }

    /// Moves that take it, with fingers that close along the direction at `angle` in the plane of the table \[rad\], and in `pause` \[s\].
    pub fn grasp(&self, arm: &Arm, grip: &Grip, angle: f64, pause: f64) -> Vec<Move> {
        let (hold, open) = (self.down(arm, grip.place, angle), self.opening(arm));
        let above = hold.moved([0.0, 0.0, ABOVE]);
        let towards = |to| Move { straight: false, ..Move::precise(to, open, 1.0, 0.2) };
        vec![towards(above), Move::precise(hold, open, 0.25, 0.4), Move::precise(hold, 0.0, 1.0, pause)]
    }
}
