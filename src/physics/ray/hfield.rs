//! Rays against height fields: a base box, a grid of triangles above it, and the walls around the grid.

use super::hit::{LocalHit, Ray, keep_nearer};
use super::mesh::{across, triangle};
use super::primitive::cuboid_faces;
use crate::math::{Mat3, Vec3};
use crate::model::Model;

/// Nearest hit of height field `id` at a pose, in its frame: z = 0 is where the base meets the grid.
pub(super) fn hfield(m: &Model, id: usize, ray: Ray, pos: Vec3, mat: &Mat3) -> Option<LocalHit> {
    let field = Field::new(m, id);
    let [sx, sy, top, base] = field.size;
    let raised = |height: f64| {
        let centre = std::array::from_fn(|k| pos[k] + mat[3 * k + 2] * height * 0.5);
        ray.local(centre, mat)
    };
    let (mut best, _) = cuboid_faces([sx, sy, 0.5 * base], raised(-base));
    let (entry, walls) = cuboid_faces([sx, sy, 0.5 * top], raised(top));
    let Some(entry) = entry else { return best };
    let ray = ray.local(pos, mat);

    // The segment inside the box of the grid: from the origin, or from where the ray enters.
    let leave = walls.iter().flatten().fold(entry.distance, |a, &b| a.max(b));
    let enter = if leave > entry.distance { entry.distance } else { 0.0 };
    let axes = across(ray.direction);
    let [rows, columns] = field.cells(ray.at(enter), ray.at(leave));
    for r in rows {
        for c in columns.clone() {
            for corners in field.triangles(r, c) {
                if let Some(hit) = triangle(corners, &ray, &axes).filter(|hit| hit.distance >= 0.0) {
                    keep_nearer(&mut best, hit);
                }
            }
        }
    }
    for (side, x) in walls.iter().take(4).enumerate() {
        if let Some(x) = x.filter(|&x| field.below_edge(side, ray.at(x))) {
            let mut normal = [0.0; 3];
            normal[side / 2] = if side % 2 == 0 { -1.0 } else { 1.0 };
            keep_nearer(&mut best, LocalHit { distance: x, normal });
        }
    }
    best
}

/// A height field with its grid.
struct Field<'a> {
    size: [f64; 4],
    rows: usize,
    columns: usize,
    step: [f64; 2],
    heights: &'a [f32],
}

impl<'a> Field<'a> {
    fn new(m: &'a Model, id: usize) -> Self {
        let (rows, columns) = (m.hfield_nrow[id] as usize, m.hfield_ncol[id] as usize);
        let (size, first) = (m.hfield_size[id], m.hfield_adr[id] as usize);
        Field {
            size,
            rows,
            columns,
            step: [2.0 * size[0] / (columns as f64 - 1.0), 2.0 * size[1] / (rows as f64 - 1.0)],
            heights: &m.hfield_data[first..first + rows * columns],
        }
    }

    /// Height of a grid point as a share of the full height.
    fn height(&self, r: usize, c: usize) -> f64 {
        f64::from(self.heights[r * self.columns + c])
    }

    /// Rows and columns of cells that a segment can touch, one more on each side.
    fn cells(&self, a: Vec3, b: Vec3) -> [std::ops::Range<usize>; 2] {
        let range = |axis: usize, count: usize| {
            let at = |p: Vec3| (p[axis] + self.size[axis]) / self.step[axis];
            let first = (at(a).min(at(b)).floor() - 1.0).max(0.0);
            let last = (at(a).max(at(b)).ceil() + 1.0).clamp(0.0, count as f64 - 1.0);
            first as usize..last as usize
        };
        [range(1, self.rows), range(0, self.columns)]
    }

    /// The two triangles of a cell, which meet on the diagonal from its lower corner.
    fn triangles(&self, r: usize, c: usize) -> [[Vec3; 3]; 2] {
        let corner = |dr: usize, dc: usize| {
            let (row, column) = (r + dr, c + dc);
            [
                self.step[0] * column as f64 - self.size[0],
                self.step[1] * row as f64 - self.size[1],
                self.height(row, column) * self.size[2],
            ]
        };
        [[corner(0, 0), corner(0, 1), corner(1, 1)], [corner(0, 0), corner(1, 1), corner(1, 0)]]
    }

    /// True when a point on wall `side` (-x +x -y +y) lies below the edge of the grid.
    fn below_edge(&self, side: usize, p: Vec3) -> bool {
        let along = if side < 2 { 1 } else { 0 };
        let (count, high) =
            if side < 2 { (self.rows, self.columns - 1) } else { (self.columns, self.rows - 1) };
        if count < 2 {
            return false;
        }
        let at = (p[along] + self.size[along]) / self.step[along];
        let cell = at.floor().clamp(0.0, count as f64 - 2.0);
        let fixed = if side % 2 == 1 { high } else { 0 };
        let height = |k: usize| if side < 2 { self.height(k, fixed) } else { self.height(fixed, k) };
        let (low, next) = (height(cell as usize), height(cell as usize + 1));
        p[2] / self.size[2] < low * (cell + 1.0 - at) + next * (at - cell)
    }
}
