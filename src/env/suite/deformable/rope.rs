//! A rope of links on ball joints: where it is, and how it lies on the table at the start.

use crate::draws::{Ranges, Rng};
use crate::error::EnvError;
use crate::task::{Pose, Setup};
use physics::Data;
use physics::elements::{BodyId, SiteId};
use physics::math::{Vec3, norm, ops, sub};
use std::f64::consts::TAU;

/// Shapes at the start: direction from end to end, turn of an arc to either side, largest turn of a wave on it \[rad\].
pub type Shapes = Ranges;

/// A rope.
#[derive(Clone)]
pub struct Rope {
    /// Its links from the first end.
    pub links: Vec<BodyId>,
    /// Where `qpos` has the joint before each link.
    joints: Vec<usize>,
    end: SiteId,
    /// Its length \[m\].
    pub length: f64,
    shapes: Shapes,
}

impl Rope {
    /// The rope of links `rope_0` … that ends at the site `rope_end`.
    ///
    /// # Errors
    /// There is none, or its links are not on ball joints; shapes that no rope has.
    pub fn new(shapes: Shapes, setup: &Setup<'_>) -> Result<Self, EnvError> {
        let turns = [shapes.low[1], shapes.high[1], shapes.high[2]];
        if !turns.iter().all(|turn| (0.0..TAU).contains(turn)) {
            return Err(setup.wrong("shapes: the turns of arc and wave are 0 or more, and below a full turn"));
        }
        let m = &setup.scene.model;
        let links: Vec<BodyId> = (0..).map_while(|k| m.body(&format!("rope_{k}"))).collect();
        let ball = |link: &BodyId| {
            let joint = m.body(*link).joints().next().map(|joint| m.joint(joint).qpos_range());
            joint.filter(|place| place.len() == 4).map(|place| place.start)
        };
        let joints: Option<Vec<usize>> = links.iter().map(ball).collect();
        let joints = joints
            .filter(|joints| joints.len() > 1)
            .ok_or_else(|| setup.wrong("the scene needs bodies rope_0, rope_1 … on ball joints"))?;
        let mut rope = Rope { links, joints, end: setup.scene.site("rope_end")?, length: 0.0, shapes };
        let places: Vec<Vec3> = rope.places(&setup.scene.data).collect();
        rope.length = places.windows(2).map(|pair| norm(sub(pair[1], pair[0]))).sum();
        Ok(rope)
    }

    /// Where its ends and the joints between its links are, from the first end to the last \[m\].
    pub fn places(&self, data: &Data) -> impl DoubleEndedIterator<Item = Vec3> {
        let joints = self.links.iter().map(|link| *data.body(*link).xpos());
        joints.chain([self.end(data)])
    }

    /// Where its last end is \[m\].
    pub fn end(&self, data: &Data) -> Vec3 {
        *data.site(self.end).xpos()
    }

    /// Lays it into a shape that is drawn.
    ///
    /// # Errors
    /// Shapes that are no ranges.
    pub fn lay(&self, rng: &mut Rng, pose: &mut Pose) -> Result<(), EnvError> {
        let [towards, arc, wave] = self.shapes.draw(rng)?;
        let arc = if rng.uniform(0.0, 1.0)? < 0.5 { -arc } else { arc };
        self.bend([towards, arc, wave], pose);
        Ok(())
    }

    /// Lays it to one side or the other, in a shape that is drawn, with its loose end turned back to the middle.
    ///
    /// # Errors
    /// Shapes that are no ranges.
    pub fn lay_aside(&self, rng: &mut Rng, pose: &mut Pose) -> Result<(), EnvError> {
        let [towards, arc, wave] = self.shapes.draw(rng)?;
        let side = if rng.uniform(0.0, 1.0)? < 0.5 { -1.0 } else { 1.0 };
        self.bend([side * towards, -side * arc, side * wave], pose);
        Ok(())
    }

    fn bend(&self, [towards, arc, wave]: [f64; 3], pose: &mut Pose) {
        let heading = |k: usize| {
            let share = k as f64 / (self.links.len() - 1) as f64;
            towards + arc * (share - 0.5) + wave * ops::sin(TAU * share)
        };
        let mut before = 0.0;
        for (k, &joint) in self.joints.iter().enumerate() {
            let (sine, cosine) = ops::sincos((heading(k) - before) / 2.0);
            pose.qpos[joint..joint + 4].copy_from_slice(&[cosine, 0.0, 0.0, sine]);
            before = heading(k);
        }
    }
}
