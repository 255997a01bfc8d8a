//! What the folders of robots list, and how several of them draw.

use workshop::{Mesh, Profile, Vec3, extrude, loft, rounded_box};

/// A mesh: the name of its file, without the ending, and what makes it.
pub(crate) type Shape = (&'static str, fn() -> Mesh);

/// A box between two corners, its edges cut by `radius`.
pub(crate) fn block(low: Vec3, high: Vec3, radius: f64) -> Mesh {
    let half = [0, 1, 2].map(|axis| (high[axis] - low[axis]) / 2.0);
    rounded_box(half, radius, 1).moved([0, 1, 2].map(|axis| (low[axis] + high[axis]) / 2.0))
}

/// A part drawn in the plane of x and z, between two places along y.
pub(crate) fn side(outline: &Profile, [low, high]: [f64; 2]) -> Mesh {
    extrude(outline, &[], [-high, -low]).mapped(|[x, z, y]| [x, -y, z])
}

/// A hull of sections across an axis \[m\], in `count` steps round: place along the axis, half sizes along the two axes after it (x, y, z,
/// x …), and the middle along these. `exponent` is that of [`Profile::superellipse`].
pub(crate) fn hull(axis: usize, sections: &[[f64; 5]], exponent: f64, count: usize) -> Mesh {
    let ring = |[along, a, b, u, v]: &[f64; 5]| -> Vec<Vec3> {
        let point = |[x, y]: &[f64; 2]| {
            let mut point = [0.0; 3];
            (point[axis], point[(axis + 1) % 3], point[(axis + 2) % 3]) = (*along, u + x, v + y);
            point
        };
        Profile::superellipse([*a, *b], exponent, count).points().iter().map(point).collect()
    };
    loft(&sections.iter().map(ring).collect::<Vec<_>>())
}
