//! Contacts of a height field: each triangle of the grid, extended down to the base, is a convex prism
//! (documentation: Computation, "Height fields").

use super::convex::penetration;
use super::round_normal;
use super::scratch::ConvexScratch;
use super::shape::{PreContact, Shape};
use super::support::{ConvexBody, Element};
use crate::math::{Mat3, Vec3, add, mul_mat_t_mat, mul_mat_t_vec, mul_mat_vec, sub};
use crate::model::bounds::MAXCONPAIR;
use crate::model::{Disable, Model, Options};
use crate::stages::Kinematics;

/// Share of the coordinates and the radius of a ball that no rounding reaches.
const BALL_SLACK: f64 = 1e-9;

/// A grid of heights in its own frame.
struct Grid<'a> {
    /// Half extent along x and y, height of the top, depth of the base.
    size: [f64; 4],
    rows: usize,
    columns: usize,
    heights: &'a [f32],
    /// Rise of the surface that stands for the contact margin.
    margin: f64,
}

impl<'a> Grid<'a> {
    fn new(m: &'a Model, id: usize, margin: f64) -> Self {
        let (rows, columns) = (m.hfield_nrow[id] as usize, m.hfield_ncol[id] as usize);
        let start = m.hfield_adr[id] as usize;
        let heights = &m.hfield_data[start..start + rows * columns];
        Grid { size: m.hfield_size[id], rows, columns, heights, margin }
    }

    /// True when the box lies beyond the margin of the grid's own box.
    fn misses(&self, min: Vec3, max: Vec3) -> bool {
        let [sx, sy, top, base] = self.size;
        let beyond = |i: usize, low: f64, high: f64| min[i] > high || max[i] < low;
        beyond(0, -sx, sx) || beyond(1, -sy, sy) || beyond(2, -base, top)
    }

    /// Indices of the first and last grid line that enclose \[min, max\] along x (0) or y (1).
    fn lines(&self, axis: usize, min: f64, max: f64) -> (usize, usize) {
        let half = self.size[axis];
        let last = (if axis == 0 { self.columns } else { self.rows }) - 1;
        let index = |x: f64| (x + half) / (2.0 * half) * last as f64;
        let inside = |x: f64| (x.max(0.0) as usize).min(last);
        (inside(index(min).floor()), inside(index(max).ceil()))
    }

    /// True when a body that this ball holds surely lies above the surface.
    fn is_below(&self, centre: Vec3, radius: f64) -> bool {
        let [x, y, z] = centre;
        // More than rounding can bring a point of the body out of the ball.
        let radius = radius + BALL_SLACK * (radius + x.abs() + y.abs() + z.abs());
        let (first_column, last_column) = self.lines(0, x - radius, x + radius);
        let (first_row, last_row) = self.lines(1, y - radius, y + radius);
        if last_column < first_column || last_row < first_row {
            return false;
        }
        self.heights[first_row * self.columns..][..(last_row - first_row + 1) * self.columns]
            .chunks_exact(self.columns)
            .all(|row| row[first_column..=last_column].iter().all(|&h| self.rise(h) < z - radius))
    }

    /// Height of the surface where the data have `height`.
    fn rise(&self, height: f32) -> f64 {
        f64::from(height) * self.size[2] + self.margin
    }

    /// Surface point at a grid node.
    fn node(&self, row: usize, column: usize) -> Vec3 {
        let [sx, sy, ..] = self.size;
        let dx = (2.0 * sx) / (self.columns - 1) as f64;
        let dy = (2.0 * sy) / (self.rows - 1) as f64;
        let height = self.rise(self.heights[row * self.columns + column]);
        [dx * column as f64 - sx, dy * row as f64 - sy, height]
    }

    /// Contacts of a body with this extent in the frame of the field: prisms row by row, each at most one contact. `settle`
    /// is called with each.
    fn prisms(
        &self,
        opt: &Options,
        body: &mut ConvexBody,
        [min, max]: [Vec3; 2],
        scratch: &mut ConvexScratch,
        out: &mut Vec<PreContact>,
        settle: impl Fn(&mut PreContact),
    ) {
        let (first_column, last_column) = self.lines(0, min[0], max[0]);
        let (first_row, last_row) = self.lines(1, min[1], max[1]);
        let first = out.len();
        for row in first_row..last_row {
            // A strip of triangles: nodes alternate between the next row and this one.
            let mut triangle = [[0.0; 3], self.node(row + 1, first_column), self.node(row, first_column)];
            for column in first_column + 1..=last_column {
                for node in [self.node(row + 1, column), self.node(row, column)] {
                    triangle = [triangle[1], triangle[2], node];
                    if triangle.iter().all(|p| p[2] < min[2]) {
                        continue;
                    }
                    let corners = self.prism(triangle);
                    let mut prism = ConvexBody::prism(&corners);
                    let found = out.len();
                    penetration(opt, &mut prism, body, 1, 0.0, scratch, out);
                    out[found..].iter_mut().for_each(&settle);
                    if out.len() - first >= MAXCONPAIR {
                        return;
                    }
                }
            }
        }
    }

    /// The prism under three surface points, base first.
    fn prism(&self, surface: [Vec3; 3]) -> [Vec3; 6] {
        let [a, b, c] = surface;
        let foot = |p: Vec3| [p[0], p[1], -self.size[3]];
        [foot(a), foot(b), foot(c), a, b, c]
    }
}

/// Height field and convex geom: prisms row by row, each at most one contact.
pub fn height_field(
    m: &Model,
    kin: &Kinematics,
    g1: usize,
    g2: usize,
    margin: f64,
    scratch: &mut ConvexScratch,
    out: &mut Vec<PreContact>,
) {
    let Ok(id) = usize::try_from(m.geom_dataid[g1]) else { return };
    let grid = Grid::new(m, id, margin);

    // Bounding sphere, then bounding box of the geom, both in the frame of the height field.
    let pos = mul_mat_t_vec(&kin.geom_xmat[g1], sub(kin.geom_xpos[g2], kin.geom_xpos[g1]));
    let radius = m.geom_rbound[g2] + margin;
    if grid.misses(pos.map(|x| x - radius), pos.map(|x| x + radius)) || grid.is_below(pos, m.geom_rbound[g2])
    {
        return;
    }
    let (field, shape) = (Shape::new(m, kin, g1), Shape::new(m, kin, g2));
    let local = Shape { pos, mat: mul_mat_t_mat(&field.mat, &shape.mat), ..shape };
    let Some(mut body) = ConvexBody::new(&local, 0.0) else { return };
    let (min, max) = extent(&mut body);
    if grid.misses(min.map(|x| x - margin), max.map(|x| x + margin)) {
        return;
    }
    body.margin = margin;

    grid.prisms(&m.opt, &mut body, [min, max], scratch, out, |contact| {
        *contact = placed(contact, field.pos, &field.mat);
        if m.opt.disableflags.contains(Disable::NATIVECCD) {
            round_normal::correct(contact, &field, &shape);
        }
    });
}

/// Height field and element of a flex; the margin raises the field and inflates the element.
pub(super) fn element(
    m: &Model,
    field: &Shape,
    element: &Element,
    centre: Vec3,
    margin: f64,
    scratch: &mut ConvexScratch,
    out: &mut Vec<PreContact>,
) {
    let Some(id) = field.data() else { return };
    let grid = Grid::new(m, id, margin);
    let local = |p: Vec3| mul_mat_t_vec(&field.mat, sub(p, field.pos));
    let element = Element { corners: element.corners.map(local), ..*element };
    let (mut min, mut max) = (element.corners[0], element.corners[0]);
    for corner in &element.corners()[1..] {
        for i in 0..3 {
            min[i] = min[i].min(corner[i]);
            max[i] = max[i].max(corner[i]);
        }
    }
    if grid.misses(min.map(|x| x - margin), max.map(|x| x + margin)) {
        return;
    }
    let mut body = ConvexBody::element(&element, local(centre));
    grid.prisms(&m.opt, &mut body, [min, max], scratch, out, |contact| {
        *contact = placed(contact, field.pos, &field.mat);
    });
}

/// Smallest box around a body, from its support points.
fn extent(body: &mut ConvexBody) -> (Vec3, Vec3) {
    let (mut min, mut max) = ([0.0; 3], [0.0; 3]);
    for i in 0..3 {
        let mut dir = [0.0; 3];
        dir[i] = 1.0;
        max[i] = body.support_of_solid(dir)[i];
        dir[i] = -1.0;
        min[i] = body.support_of_solid(dir)[i];
    }
    (min, max)
}

/// A contact in a frame, seen from the world.
fn placed(contact: &PreContact, pos: Vec3, mat: &Mat3) -> PreContact {
    PreContact {
        pos: add(mul_mat_vec(mat, contact.pos), pos),
        normal: mul_mat_vec(mat, contact.normal),
        ..*contact
    }
}
