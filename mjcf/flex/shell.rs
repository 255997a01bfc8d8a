//! Boxes, cylinders and ellipsoids: the surface of a grid of points, as triangles or as tetrahedra that meet in the
//! middle.

use super::cloud::Cloud;
use super::regular::{Regular, Shape};
use crate::vector::normalize;

/// The two sides of the box across one axis.
struct Side {
    /// Axis across.
    across: usize,
    /// Axes along the side, the slower one first.
    along: [usize; 2],
}

/// Sides in the order in which their points are numbered.
const SIDES: [Side; 3] =
    [Side { across: 2, along: [0, 1] }, Side { across: 1, along: [0, 2] }, Side { across: 0, along: [1, 2] }];

/// A surface under construction, with the number of each point by its place in the grid.
struct Shell<'a> {
    wanted: &'a Regular,
    cloud: Cloud,
    number: Vec<i32>,
    made: i32,
}

/// The shape asked for. Surfaces of triangles are open at the top.
///
/// # Errors
/// An axis has less than two points.
pub(super) fn build(wanted: &Regular) -> Result<Cloud, String> {
    if wanted.count.iter().any(|&n| n < 2) {
        return Err("a box, cylinder or ellipsoid needs at least 2 points along each axis".into());
    }
    let mut shell = Shell {
        wanted,
        cloud: Cloud { dim: wanted.dim, ..Cloud::default() },
        number: vec![0; wanted.count.iter().product()],
        made: 0,
    };
    shell.points();
    shell.elements();
    Ok(shell.cloud)
}

impl Shell<'_> {
    fn slot(&self, at: [usize; 3]) -> usize {
        let [_, ny, nz] = self.wanted.count;
        (at[0] * ny + at[1]) * nz + at[2]
    }

    /// Triangles leave the top open.
    fn is_open(&self) -> bool {
        self.wanted.dim == 2
    }

    /// Whether side `end` across `side` is there.
    fn has(&self, side: &Side, end: usize) -> bool {
        !(self.is_open() && side.across == 2 && end != 0)
    }

    /// Whether the points of a side begin a number of their own: those that an earlier side has do not.
    fn begins(&self, side: &Side, at: [usize; 3]) -> bool {
        let [_, ny, nz] = self.wanted.count;
        let below_top = self.is_open() || at[2] + 1 < nz;
        match side.across {
            2 => true,
            1 => at[2] > 0 && below_top,
            _ => at[2] > 0 && below_top && at[1] > 0 && at[1] + 1 < ny,
        }
    }

    fn points(&mut self) {
        if self.wanted.dim == 3 {
            self.cloud.point.extend([0.0; 3]);
        }
        if self.wanted.textured {
            self.cloud.texcoord.extend([0.0; 2]);
        }
        let first = i32::from(self.wanted.dim == 3);
        self.each(|shell, side, at| {
            if !shell.begins(side, at) {
                return;
            }
            let point = projected(shell.wanted, at);
            shell.cloud.point.extend(point);
            if shell.wanted.textured {
                let share = side.along.map(|axis| shell.wanted.share(at[axis], axis));
                shell.cloud.texcoord.extend(share);
            }
            let slot = shell.slot(at);
            shell.number[slot] = first + shell.made;
            shell.made += 1;
        });
    }

    /// Calls `visit` for every place of every side, in the order of numbers.
    fn each(&mut self, mut visit: impl FnMut(&mut Self, &Side, [usize; 3])) {
        let count = self.wanted.count;
        for side in &SIDES {
            for end in [0, count[side.across] - 1] {
                if !self.has(side, end) {
                    continue;
                }
                for u in 0..count[side.along[0]] {
                    for v in 0..count[side.along[1]] {
                        visit(self, side, place(side, end, u, v));
                    }
                }
            }
        }
    }

    fn elements(&mut self) {
        let count = self.wanted.count;
        self.each(|shell, side, at| {
            let [u, v] = side.along.map(|axis| at[axis]);
            if u + 1 == count[side.along[0]] || v + 1 == count[side.along[1]] {
                return;
            }
            let end = at[side.across];
            let id = |[u, v]: [usize; 2]| shell.number[shell.slot(place(side, end, u, v))];
            let (near, far) = ([u, v], [u + 1, v + 1]);
            let (beside, above) = ([u + 1, v], [u, v + 1]);
            let corners = if shell.wanted.dim == 3 {
                vec![0, id(near), id(beside), id(far), 0, id(near), id(above), id(far)]
            } else if side.across == 2 && end == 0 {
                [near, far, beside, near, above, far].map(id).to_vec()
            } else if (side.across == 1 && end != 0) || (side.across == 0 && end == 0) {
                [beside, near, above, beside, above, far].map(id).to_vec()
            } else {
                [near, beside, far, near, far, above].map(id).to_vec()
            };
            shell.cloud.element.extend(corners);
        });
    }
}

/// Place in the grid of place `u`, `v` of a side.
fn place(side: &Side, end: usize, u: usize, v: usize) -> [usize; 3] {
    let mut at = [end; 3];
    (at[side.along[0]], at[side.along[1]]) = (u, v);
    at
}

/// The point of the shape that a place of the box becomes.
fn projected(wanted: &Regular, at: [usize; 3]) -> [f64; 3] {
    let half = wanted.half();
    let unit: [f64; 3] = std::array::from_fn(|k| 2.0 * at[k] as f64 / (wanted.count[k] - 1) as f64 - 1.0);
    match wanted.shape {
        Shape::Cylinder => {
            let reach = unit[0].abs().max(unit[1].abs());
            let mut direction = [unit[0], unit[1]];
            normalize(&mut direction);
            [direction[0] * (half[0] * reach), direction[1] * (half[1] * reach), unit[2] * half[2]]
        }
        Shape::Ellipsoid => {
            let mut direction = unit;
            normalize(&mut direction);
            std::array::from_fn(|k| direction[k] * half[k])
        }
        _ => std::array::from_fn(|k| unit[k] * half[k]),
    }
}
