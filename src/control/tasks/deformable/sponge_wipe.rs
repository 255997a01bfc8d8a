//! Wiping a board: the sponge is led to and fro over the box round the marks that remain, a little below where it would only touch, until
//! none does.

use crate::error::ControlError;
use crate::tasks::arms::arm::Arm;
use crate::tasks::arms::moves::{Move, Script};
use env::Env;
use physics::math::Vec3;

/// How far the underside would be below the board if that gave way \[m\].
const PRESS: f64 = 0.005;
/// How far over the board the sponge is carried \[m\].
const ABOVE: f64 = 0.05;
/// Distance of lanes, as a share of the sponge's width.
const LANE: f64 = 0.7;
/// Speeds over and on the board, as shares of full speed.
const SPEED: [f64; 2] = [0.5, 0.3];

#[derive(Default)]
pub struct SpongeWipe {
    /// What is left to do, the last first.
    plan: Vec<Move>,
}

/// Least and largest of the numbers.
fn bounds(numbers: impl Iterator<Item = f64>) -> [f64; 2] {
    numbers.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], x| [low.min(x), high.max(x)])
}

impl SpongeWipe {
    /// Lanes over the marks that remain, along the longer side of the box round them.
    fn plan(&mut self, env: &Env, arm: &Arm) {
        let (rows, tool) = (env.rows(), arm.tool(env));
        let nodes = rows["sponge"].as_chunks::<3>().0;
        let marks = rows["marks"].as_chunks::<2>().0.iter().zip(&rows["wiped"]);
        let left = || marks.clone().filter(|(_, wiped)| **wiped == 0.0).map(|(mark, _)| *mark);
        let sponge = [0, 1].map(|i| bounds(nodes.iter().map(|node| node[i])));
        let patch = [0, 1].map(|i| bounds(left().map(|mark| mark[i])));
        let size = patch.map(|[low, high]| high - low);
        let (along, across) = if size[0] > size[1] { (0, 1) } else { (1, 0) };
        let width = sponge[across][1] - sponge[across][0];
        let lanes = (size[across] / (LANE * width)).ceil().max(1.0);
        let middle = sponge.map(|[low, high]| f64::midpoint(low, high));
        let [over, on] = [ABOVE, -PRESS].map(|height| height - rows["clearance"][0]);
        let at = |[x, y]: [f64; 2], height: f64| {
            let way: Vec3 = [x - middle[0], y - middle[1], height];
            tool.moved(way)
        };
        let mut places = Vec::new();
        for lane in 0..lanes as usize {
            let beside = patch[across][0] + size[across] * (lane as f64 + 0.5) / lanes;
            let mut ends = patch[along];
            if lane % 2 == 1 {
                ends.reverse();
            }
            places.extend(ends.map(|end| if along == 0 { [end, beside] } else { [beside, end] }));
        }
        let wipe = |place: &[f64; 2]| Move::precise(at(*place, on), 0.0, SPEED[1], 0.0);
        self.plan = vec![Move::precise(at(places[0], over), 0.0, SPEED[0], 0.1)];
        self.plan.extend(places.iter().map(wipe));
        self.plan.push(Move::precise(at(places[places.len() - 1], over), 0.0, SPEED[1], 0.1));
        self.plan.reverse();
    }
}

impl Script for SpongeWipe {
    fn begin(&mut self, env: &Env, arm: &Arm) -> Result<(), ControlError> {
        self.plan(env, arm);
        Ok(())
    }

    fn next(&mut self, env: &Env, arm: &Arm) -> Result<Option<Move>, ControlError> {
        if self.plan.is_empty() && env.rows()["remaining"][0] > 0.0 {
            self.plan(env, arm);
        }
        Ok(self.plan.pop())
    }
}
