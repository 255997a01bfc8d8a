//! Lines some pixels wide: rays of rangefinders, edges of boxes.
//!
//! With four samples a line is a rectangle about its middle; with one, a parallelogram with two sides along the columns or the
//! rows, whichever it is farther from (OpenGL 2.1 specification, section 3.4.2).

use super::window::clip::{Corner, clip_line};
use super::window::coverage::{Facing, Pattern, Target, Triangle};
use super::window::lens::Lens;
use super::window::vertices::{Vertex, inside};
use crate::scene::{Item, Scene, Shape};

/// Opacity from which on an item is opaque.
pub(super) const OPAQUE: f32 = 0.995;
/// Width of the edges of boxes, in units of the line width.
const EDGE: f32 = 1.5;

/// One line, world frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Line {
    /// The item that it belongs to.
    pub item: usize,
    /// Its ends \[m\].
    pub ends: [[f64; 3]; 2],
    /// Its width, in units of the line width.
    pub width: f32,
    /// It is blended over what is behind it.
    pub transparent: bool,
}

/// Appends the lines of a scene.
pub fn list(scene: &Scene, out: &mut Vec<Line>) {
    out.clear();
    for (index, item) in scene.items.iter().enumerate() {
        let transparent = item.rgba[3] < OPAQUE;
        match item.shape {
            Shape::Line => {
                let ends = [place(item, [0.0; 3]), place(item, [0.0, 0.0, item.size[2]])];
                out.push(Line { item: index, ends, width: item.size[0], transparent });
            }
            Shape::LineBox => {
                for (axis, sides) in (0..12).map(|k| (k / 4, k % 4)) {
                    let end = |along: f32| {
                        let mut p = [0.0; 3];
                        p[axis] = along * item.size[axis];
                        for (bit, other) in [(axis + 1) % 3, (axis + 2) % 3].into_iter().enumerate() {
                            p[other] =
                                if sides >> bit & 1 == 0 { -item.size[other] } else { item.size[other] };
                        }
                        place(item, p)
                    };
                    out.push(Line { item: index, ends: [end(-1.0), end(1.0)], width: EDGE, transparent });
                }
            }
            _ => {}
        }
    }
}

fn place(item: &Item, p: [f32; 3]) -> [f64; 3] {
    std::array::from_fn(|i| {
        let turned = (0..3).map(|j| f64::from(item.mat[3 * i + j]) * f64::from(p[j])).sum::<f64>();
        turned + f64::from(item.pos[i])
    })
}

impl Line {
    /// Calls `see` with the two triangles that the line covers.
    pub fn triangles(&self, lens: &Lens, pattern: &Pattern, line_width: f32, mut see: impl FnMut(&Triangle)) {
        let project = |p: [f64; 3]| -> Corner {
            let [x, y, z, w] =
                lens.projection.0.map(|row| (row[0] * p[0] + row[1] * p[1] + row[2] * p[2] + row[3]) as f32);
            let side =
                lens.mirror.map_or(1.0, |plane| (0..3).map(|k| plane[k] * p[k]).sum::<f64>() + plane[3]);
            [x, y, z, w, side as f32]
        };
        let Some(ends) = clip_line(self.ends.map(project)) else { return };
        let target = Target::new(*pattern, Facing::Both, &lens.region);
        for corners in strip(ends.map(|end| inside(&end)), self.width * line_width, pattern) {
            if let Some(triangle) = Triangle::new(&corners, &target) {
                see(&triangle);
            }
        }
    }
}

/// The two triangles that a line covers, of a width in pixels.
pub fn strip([a, b]: [Vertex; 2], width: f32, pattern: &Pattern) -> [[Vertex; 3]; 2] {
    let (dx, dy) = (b.at()[0] - a.at()[0], b.at()[1] - a.at()[1]);
    let half = 0.5 * width;
    let (x, y) = if *pattern == Pattern::FOUR {
        let length = (dx * dx + dy * dy).sqrt().max(1e-3);
        (-dy * half / length, dx * half / length)
    } else if dx.abs() > dy.abs() {
        (0.0, half)
    } else {
        (half, 0.0)
    };
    let beside = |v: Vertex, sign: f32| Vertex::new([v.at()[0] + sign * x, v.at()[1] + sign * y], v.z());
    let [p, q, r, s] = [beside(a, 1.0), beside(a, -1.0), beside(b, -1.0), beside(b, 1.0)];
    [[p, q, s], [q, r, s]]
}
