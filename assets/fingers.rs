//! What fingers of machines consist of, along z, bending about x \[m\].

use workshop::{Mesh, Profile, Station, Vec3, loft, sweep};

/// A plate whose outline is drawn in x and z, between two heights of y, its rims cut by `bevel`.
pub(crate) fn plate(outline: &Profile, [low, high]: [f64; 2], bevel: f64) -> Mesh {
    let ring = |inset: f64, y: f64| -> Vec<Vec3> {
        // Towards y, x and z run clockwise.
        outline.inset(inset).points().iter().rev().map(|[x, z]| [*x, y, *z]).collect()
    };
    loft(&[ring(bevel, low), ring(0.0, low + bevel), ring(0.0, high - bevel), ring(bevel, high)])
}

/// A body along z over rounded rectangles: heights, half widths in x and y, and how far the middle is off in y. Corners are arcs
/// of `steps` pieces.
pub(crate) fn bar(sections: &[(f64, [f64; 2], f64)], corner: f64, steps: usize) -> Mesh {
    let ring = |(z, half, off): &(f64, [f64; 2], f64)| -> Vec<Vec3> {
        let outline = Profile::rounded_rectangle(*half, corner, steps);
        outline.points().iter().map(|[x, y]| [*x, *y + off, *z]).collect()
    };
    loft(&sections.iter().map(ring).collect::<Vec<_>>())
}

/// A fingertip: flat at the joint, round at the end, fuller on the side of the palm, in `count` steps round.
pub(crate) fn tip(length: f64, [wide, deep]: [f64; 2], count: usize) -> Mesh {
    let round = Profile::superellipse([wide, deep], 2.4, count);
    let path = [
        (0.16, 0.7, 0.0),
        (0.22, 0.9, 0.0),
        (0.45, 1.0, -0.0004),
        (0.65, 0.97, -0.0006),
        (0.82, 0.8, -0.0003),
        (0.94, 0.5, 0.0004),
        (1.0, 0.0, 0.0008),
    ];
    let stations = path.map(|(at, size, off)| Station { at: [0.0, off, at * length], size: [size; 2] });
    sweep(&round, &stations)
}
