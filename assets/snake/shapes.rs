//! What the links of the snake look like, each in the frame of its body \[m\]: its joint at the origin, the link behind it along -x.

use crate::shape::hull;
use workshop::{Mesh, ellipsoid, revolve};

/// Steps round a link.
const ROUND: usize = 14;

/// The head: flat, with a blunt snout.
pub(super) fn head() -> Mesh {
    hull(
        0,
        &[
            [-0.071, 0.021, 0.021, 0.0, 0.0],
            [-0.067, 0.025, 0.0245, 0.0, 0.0],
            [-0.03, 0.0265, 0.0245, 0.0, 0.0],
            [-0.005, 0.03, 0.024, 0.0, 0.0],
            [0.016, 0.028, 0.02, 0.0, -0.002],
            [0.034, 0.02, 0.014, 0.0, -0.005],
            [0.041, 0.011, 0.008, 0.0, -0.006],
        ],
        2.3,
        ROUND,
    )
}

/// Two eyes on the head.
pub(super) fn eyes() -> Mesh {
    let eye = |y: f64| ellipsoid([0.0065, 0.0045, 0.0055], 10).moved([0.014, y, 0.0125]);
    eye(0.0195).with(&eye(-0.0195))
}

/// A link between two joints.
pub(super) fn link() -> Mesh {
    hull(
        0,
        &[
            [-0.071, 0.021, 0.021, 0.0, 0.0],
            [-0.067, 0.025, 0.0245, 0.0, 0.0],
            [-0.013, 0.025, 0.0245, 0.0, 0.0],
            [-0.009, 0.021, 0.021, 0.0, 0.0],
        ],
        2.3,
        ROUND,
    )
}

/// The stripe round a link.
pub(super) fn band() -> Mesh {
    hull(
        0,
        &[
            [-0.053, 0.0245, 0.024, 0.0, 0.0],
            [-0.0515, 0.0262, 0.0256, 0.0, 0.0],
            [-0.0285, 0.0262, 0.0256, 0.0, 0.0],
            [-0.027, 0.0245, 0.024, 0.0, 0.0],
        ],
        2.3,
        ROUND,
    )
}

/// The bellows round a joint.
pub(super) fn bellows() -> Mesh {
    let fold =
        |step: usize| [if step.is_multiple_of(2) { 0.0175 } else { 0.021 }, 0.006 * step as f64 - 0.012];
    revolve(&(0..5).map(fold).collect::<Vec<_>>(), 10).along([1.0, 0.0, 0.0], [0.0; 3])
}

/// The last link, with a fin.
pub(super) fn tail() -> Mesh {
    hull(
        0,
        &[
            [-0.098, 0.0012, 0.02, 0.0, 0.0],
            [-0.08, 0.0035, 0.022, 0.0, 0.0],
            [-0.062, 0.01, 0.0185, 0.0, 0.0],
            [-0.035, 0.021, 0.021, 0.0, 0.0],
            [-0.013, 0.025, 0.0245, 0.0, 0.0],
            [-0.009, 0.021, 0.021, 0.0, 0.0],
        ],
        2.2,
        ROUND,
    )
}
