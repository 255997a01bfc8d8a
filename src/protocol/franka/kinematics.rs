//! Where the flange is.

/// Parameters of Denavit and Hartenberg as Craig has them, `(a, d, quarter turns of α)` \[m\], and the flange last.
const LINKS: [(f64, f64, i8); 8] = [
    (0.0, 0.333, 0),
    (0.0, 0.0, -1),
    (0.0, 0.316, 1),
    (0.0825, 0.0, 1),
    (-0.0825, 0.384, -1),
    (0.0, 0.0, 1),
    (0.088, 0.0, 1),
    (0.0, 0.107, 0),
];

/// The pose that changes nothing, column by column.
pub const fn identity() -> [f64; 16] {
    [1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0]
}

/// Product of two poses, column by column.
fn times(a: &[f64; 16], b: &[f64; 16]) -> [f64; 16] {
    std::array::from_fn(|at| {
        let (column, row) = (at / 4, at % 4);
        (0..4).map(|k| a[row + 4 * k] * b[k + 4 * column]).sum()
    })
}

/// Pose of the flange in the arm's base, column by column, with its joints at `q` \[rad\].
///
/// ```
/// // Stretched upwards: 0.333 + 0.316 + 0.384 - 0.107 m high, 0.088 m in front.
/// let pose = robohive_protocol::franka::flange(&[0.0; 7]);
/// assert!((pose[12] - 0.088).abs() < 1e-12 && (pose[14] - 0.926).abs() < 1e-12);
/// ```
pub fn flange(q: &[f64; 7]) -> [f64; 16] {
    let mut pose = identity();
    for (k, (a, d, quarters)) in LINKS.into_iter().enumerate() {
        let (sin, cos) = q.get(k).map_or((0.0, 1.0), |angle| angle.sin_cos());
        // Sine and cosine of a quarter turn, exactly.
        let (sa, ca) = (f64::from(quarters), if quarters == 0 { 1.0 } else { 0.0 });
        #[rustfmt::skip]
        let link = [
            cos, sin * ca, sin * sa, 0.0,
            -sin, cos * ca, cos * sa, 0.0,
            0.0, -sa, ca, 0.0,
            a, -d * sa, d * ca, 1.0,
        ];
        pose = times(&pose, &link);
    }
    pose
}
