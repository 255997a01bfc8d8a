//! How much each corner of a triangle, or each end of a line, counts in a point of the window.

use crate::raster::window::clip::clip_line;
use crate::raster::window::coverage::Extent;

/// The pixel of the window nearest to a corner, or the first where the corner is behind the eye. It depends on nothing but
/// the triangle, as its colours then do.
pub fn anchor([x, y, _, w]: [f32; 4], extent: Extent) -> [f32; 2] {
    let near =
        |x: f32, pixels: i32| if w > 0.0 { (x / w).clamp(0.0, pixels as f32).floor() + 0.5 } else { 0.5 };
    [near(x, extent.width), near(y, extent.height)]
}

/// What multiplies column, row and 1, counted from `anchor`, to give the share of each corner: with corners (x w, y w, w) as rows
/// of a matrix, the columns of its inverse (Olano and Greer, "Triangle scan conversion using 2D homogeneous coordinates", 1997).
pub fn shares(corners: [[f32; 4]; 3], anchor: [f32; 2]) -> [[f32; 3]; 3] {
    let rows = corners.map(|[x, y, _, w]| {
        let w = f64::from(w);
        [f64::from(x) - f64::from(anchor[0]) * w, f64::from(y) - f64::from(anchor[1]) * w, w]
    });
    let normals: [[f64; 3]; 3] = std::array::from_fn(|i| {
        let (a, b) = (rows[(i + 1) % 3], rows[(i + 2) % 3]);
        [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
    });
    let determinant: f64 = (0..3).map(|k| rows[0][k] * normals[0][k]).sum();
    normals.map(|n| n.map(|x| (x / determinant) as f32))
}

/// The same along a line, whose second end counts as the second corner, and a third counts nothing: all points across the line have
/// the shares of the nearest point on it.
pub fn shares_along(ends: [[f32; 4]; 2], anchor: [f32; 2]) -> [[f32; 3]; 3] {
    const FIRST: [[f32; 3]; 3] = [[0.0, 0.0, 1.0], [0.0; 3], [0.0; 3]];
    let Some(drawn) = clip_line(ends.map(|[x, y, z, w]| [x, y, z, w, 1.0])) else { return FIRST };
    let single = |corner: [f32; 4]| corner.map(f64::from);
    let (from, to) = (single(ends[0]), single(ends[1]));
    let along: [f64; 4] = std::array::from_fn(|k| to[k] - from[k]);
    let length: f64 = along.iter().map(|x| x * x).sum();
    // Places in the window, and what the ends of the whole line count there before normalisation.
    let [(p, at_p), (q, at_q)] = drawn.map(|[x, y, z, w, _]| {
        let [x, y, z, w] = single([x, y, z, w]);
        let way = [x, y, z, w]
            .iter()
            .zip(from)
            .zip(along)
            .map(|((x, from), along)| (x - from) * along)
            .sum::<f64>();
        let share = way / length;
        ([x / w - f64::from(anchor[0]), y / w - f64::from(anchor[1])], [(1.0 - share) / w, share / w])
    });
    let way = [q[0] - p[0], q[1] - p[1]];
    let square = (way[0] * way[0] + way[1] * way[1]).max(SHORTEST * SHORTEST);
    let row = |k: usize| {
        let rise = (at_q[k] - at_p[k]) / square;
        let start = at_p[k] - rise * (p[0] * way[0] + p[1] * way[1]);
        [rise * way[0], rise * way[1], start].map(|x| x as f32)
    };
    let rows = [row(0), row(1), [0.0; 3]];
    if rows.iter().flatten().all(|x| x.is_finite()) { rows } else { FIRST }
}

/// Lines shorter than this count as points \[pixel\].
const SHORTEST: f64 = 1e-3;

#[cfg(test)]
mod tests {
    use super::*;

    fn share(rows: [[f32; 3]; 3], x: f32, y: f32) -> [f32; 3] {
        let raw = rows.map(|[a, b, c]| a * x + b * y + c);
        raw.map(|share| share / raw.iter().sum::<f32>())
    }

    #[test]
    fn ends_of_a_line_share_by_perspective_and_across_it_alike() {
        // At distances 1 and 3 from the eye: halfway in the window the nearer end counts 3 / 4.
        let ends = [[10.0, 20.0, 0.5, 1.0], [90.0, 60.0, 0.2, 3.0]];
        let rows = shares_along(ends, [4.5, 7.5]);
        for across in [0.0, 2.0] {
            let [near, far, other] = share(rows, 20.0 - 4.5, 20.0 + across - 7.5);
            assert!((near - 0.75).abs() < 1e-5 && (far - 0.25).abs() < 1e-5 && other == 0.0, "{near} {far}");
        }
    }

    #[test]
    fn a_line_that_reaches_behind_the_eye_has_the_shares_of_its_visible_part() {
        // From a distance of 1 to one of -1, cut at the near plane, where z is w
        let ends = [[10.0, 20.0, 0.5, 1.0], [30.0, 20.0, 0.25, -1.0]];
        let rows = shares_along(ends, [10.5, 20.5]);
        // A quarter of the way: (15, 20, 0.4375, 0.5) is seen at (30, 40).
        let [near, far, _] = share(rows, 30.0 - 10.5, 40.0 - 20.5);
        assert!((near - 0.75).abs() < 1e-5 && (far - 0.25).abs() < 1e-5, "{near} {far}");
    }
}
