//! A square cloth with a rod along two of its sides: where it is, how it lies at the start, what it covers, and whether the arm touches it.

use crate::error::EnvError;
use crate::task::{Pose, Setup};
use physics::elements::BodyId;
use physics::math::{Vec3, add, norm, ops, quat_from_axis_angle, quat_rotate, scale, sub};
use physics::{Data, Model};

/// Side of the cells in which the covered area is counted \[m\].
const CELL: f64 = 0.0025;

/// A cloth.
#[derive(Clone)]
pub struct Cloth {
    /// Points along a side.
    side: usize,
    /// Where `qpos` has the first of the three slides of each point.
    joints: Vec<usize>,
    /// Where points are in the scene, lying flat \[m\].
    flat: Vec<Vec3>,
    /// The rods, and where `qpos` has their free joints.
    rods: [(BodyId, usize); 2],
    /// Of each body, whether it is the cloth's.
    own: Vec<bool>,
    triangles: Vec<[usize; 3]>,
}

impl Cloth {
    /// The one flex of the scene, a square grid, with the free bodies `rod_0` and `rod_1` along its first and its last row.
    ///
    /// # Errors
    /// The scene has another flex, points that do not move on three slides, or no such rods.
    pub fn new(setup: &Setup<'_>) -> Result<Self, EnvError> {
        let (m, data) = (&setup.scene.model, &setup.scene.data);
        let wrong = || setup.wrong("the scene needs one flex, a square grid of points on three slides each");
        let side = m.nflexvert.isqrt();
        if m.nflex != 1 || m.flex_dim[0] != 2 || side * side != m.nflexvert || side < 2 {
            return Err(wrong());
        }
        let slides = |body: usize| {
            (m.body_jntnum[body] == 3).then(|| m.jnt_qposadr[m.body_jntadr[body] as usize] as usize)
        };
        let points = || m.flex_vertbodyid.iter().map(|body| *body as usize);
        let joints: Option<Vec<usize>> = points().map(slides).collect();
        let rod = |name: &str| setup.loose_body(name).map(|(body, place)| (body, place.start));
        let rods = [rod("rod_0")?, rod("rod_1")?];
        let mut own = vec![false; m.nbody];
        points().chain(rods.iter().map(|(body, _)| body.index())).for_each(|body| own[body] = true);
        let corners = m.flex_elem.as_chunks::<3>().0;
        Ok(Cloth {
            side,
            joints: joints.ok_or_else(wrong)?,
            flat: data.flex.flexvert_xpos.to_vec(),
            rods,
            own,
            triangles: corners.iter().map(|corners| corners.map(|corner| corner as usize)).collect(),
        })
    }

    /// Where its points are, row by row \[m\].
    pub fn places<'d>(&self, data: &'d Data) -> &'d [Vec3] {
        &data.flex.flexvert_xpos
    }

    /// The numbers of its corner points. The first two, and the last two, share a side.
    pub fn corners(&self) -> [usize; 4] {
        let (end, all) = (self.side - 1, self.side * self.side);
        [0, end, all - 1 - end, all - 1]
    }

    /// Where its middle is \[m\].
    pub fn middle(&self, data: &Data) -> Vec3 {
        self.places(data)[self.side * self.side / 2]
    }

    /// Where the middles of its rods' seams are, that with the handle first \[m\].
    pub fn rods(&self, data: &Data) -> [Vec3; 2] {
        let (places, [a, b, c, d]) = (self.places(data), self.corners());
        [[a, b], [c, d]].map(|[first, last]| scale(add(places[first], places[last]), 0.5))
    }

    /// Distance of a row of points from the next, lying flat \[m\].
    pub fn spacing(&self) -> f64 {
        norm(sub(self.flat[self.side], self.flat[0]))
    }

    /// Lays it in the shape to which `shaped` takes its points from where they lie flat, as seen from the middle \[m\], turned by `turn` \[rad\]
    /// and moved by `x` and `y` \[m\]; its rods stay level. Returns where the middles of their seams are then, that with the handle first \[m\].
    pub fn lay(&self, pose: &mut Pose, [x, y, turn]: [f64; 3], shaped: impl Fn(Vec3) -> Vec3) -> [Vec3; 2] {
        let (middle, turn) = (self.flat[self.flat.len() / 2], quat_from_axis_angle([0.0, 0.0, 1.0], turn));
        let moved = |place: Vec3| add(quat_rotate(turn, shaped(place)), [x, y, 0.0]);
        let ways: Vec<Vec3> =
            self.flat.iter().map(|&place| sub(add(middle, moved(sub(place, middle))), place)).collect();
        let mut slide = |joint: usize, way: Vec3| (0..3).for_each(|i| pose.qpos[joint + i] += way[i]);
        self.joints.iter().zip(&ways).for_each(|(&joint, &way)| slide(joint, way));
        let [a, b, c, d] = self.corners().map(|corner| add(self.flat[corner], ways[corner]));
        let seams = [[a, b], [c, d]];
        let middles = seams.map(|[first, last]| scale(add(first, last), 0.5));
        for (((_, joint), [first, last]), middle) in self.rods.iter().zip(seams).zip(&middles) {
            // Rods lie along y in the scene.
            let [x, y, _] = sub(last, first);
            let turn = quat_from_axis_angle([0.0, 0.0, 1.0], -ops::atan2(x, y));
            pose.qpos[*joint..joint + 3].copy_from_slice(middle);
            pose.qpos[joint + 3..joint + 7].copy_from_slice(&turn);
        }
        middles
    }

    /// Whether the arm touches it or its rods.
    pub fn is_touched(&self, m: &Model, data: &Data) -> bool {
        self.touched_by(m, data, |body| m.body_weldid[body as usize] != 0)
    }

    /// Whether one of other bodies touches it or its rods.
    pub fn touched_by(&self, m: &Model, data: &Data, others: impl Fn(i32) -> bool) -> bool {
        data.con.contact.iter().any(|contact| {
            // What has no geom is the flex.
            let bodies = contact.geom.map(|geom| usize::try_from(geom).ok().map(|geom| m.geom_bodyid[geom]));
            let own = bodies.map(|body| body.is_none_or(|body| self.own[body as usize]));
            own[0] != own[1] && bodies[usize::from(own[0])].is_some_and(&others)
        })
    }

    /// Area that it covers, seen from above, as a share of its own.
    pub fn covered(&self, data: &Data) -> f64 {
        let area = |places: &[Vec3]| {
            cells(places.len(), |point| [0, 1].map(|i| places[point][i] / CELL), &self.triangles)
        };
        area(self.places(data)) as f64 / area(&self.flat).max(1) as f64
    }
}

/// Words of a row of cells.
const WORDS: usize = 16;

/// Cells of unit side whose middles are in a triangle at least, of points within as many cells as a row has.
fn cells(count: usize, point: impl Fn(usize) -> [f64; 2], triangles: &[[usize; 3]]) -> usize {
    let bounds = |i: usize| {
        let along = (0..count).map(|k| point(k)[i]);
        let [low, high] =
            [along.clone().fold(f64::INFINITY, f64::min), along.fold(f64::NEG_INFINITY, f64::max)];
        (low.floor(), (high - low).clamp(0.0, (64 * WORDS) as f64 - 2.0).ceil() as usize + 1)
    };
    let [(left, width), (low, height)] = [bounds(0), bounds(1)];
    let cross =
        |p: [f64; 2], q: [f64; 2], r: [f64; 2]| (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]);
    let mut covered = 0;
    for row in 0..height {
        let mut line = [0u64; WORDS];
        for corners in triangles {
            let [a, b, c] = corners.map(|corner| {
                let [x, y] = point(corner);
                [x - left, y - low]
            });
            let span = |i: usize, most: usize| {
                let [first, last] = [a[i].min(b[i]).min(c[i]), a[i].max(b[i]).max(c[i])];
                first.max(0.0) as usize..(last.ceil() as usize).min(most)
            };
            if !span(1, height).contains(&row) || cross(a, b, c) == 0.0 {
                continue;
            }
            for column in span(0, width) {
                let middle = [column as f64 + 0.5, row as f64 + 0.5];
                let sides = [cross(a, b, middle), cross(b, c, middle), cross(c, a, middle)];
                let within = sides.iter().all(|side| *side >= 0.0) || sides.iter().all(|side| *side <= 0.0);
                line[column / 64] |= u64::from(within) << (column % 64);
            }
        }
        covered += line.iter().map(|word| word.count_ones() as usize).sum::<usize>();
    }
    covered
}

#[cfg(test)]
mod tests {
    use super::cells;

    /// A square of 10 cells, and the same folded along its diagonal and in half.
    #[test]
    fn covered_cells_are_counted_once() {
        let square = [[0.0, 0.0], [10.0, 0.0], [10.0, 10.0], [0.0, 10.0]];
        let triangles = [[0, 1, 2], [0, 3, 2]];
        assert_eq!(cells(4, |k| square[k], &triangles), 100);
        let folded = [[0.0, 0.0], [10.0, 0.0], [10.0, 10.0], [10.0, 0.0]];
        assert_eq!(cells(4, |k| folded[k], &triangles), 55);
        assert_eq!(cells(4, |_| [0.2, 0.2], &triangles), 0);
    }
}
