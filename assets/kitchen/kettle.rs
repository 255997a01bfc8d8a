//! Crockery and a kettle \[m\]: each stands on z = 0.

use workshop::{Mesh, Profile, Station, capsule, ellipsoid, revolve, rounded_box, sweep};

/// The belly and the spout, which points against x.
pub(super) fn kettle() -> Mesh {
    let line = [
        [0.0, 0.0],
        [0.108, 0.0],
        [0.122, 0.02],
        [0.121, 0.045],
        [0.113, 0.075],
        [0.098, 0.098],
        [0.075, 0.113],
        [0.06, 0.118],
        [0.0, 0.119],
    ];
    let spout = [
        ([-0.09, 0.0, 0.05], 0.03),
        ([-0.125, 0.0, 0.068], 0.026),
        ([-0.148, 0.0, 0.09], 0.021),
        ([-0.163, 0.0, 0.115], 0.018),
        ([-0.172, 0.0, 0.13], 0.019),
    ];
    let stations = spout.map(|(at, size)| Station { at, size: [size; 2] });
    revolve(&line, 24).with(&sweep(&Profile::circle(1.0, 10), &stations))
}

/// The lid with its button.
pub(super) fn kettle_lid() -> Mesh {
    let line = [[0.0, 0.115], [0.062, 0.117], [0.062, 0.122], [0.05, 0.128], [0.02, 0.133], [0.0, 0.134]];
    revolve(&line, 20).with(&ellipsoid([0.015, 0.015, 0.012], 8).moved([0.0, 0.0, 0.143]))
}

/// What the grip hangs on.
pub(super) fn kettle_bow() -> Mesh {
    let bow = [
        ([-0.098, 0.0, 0.09], 0.012),
        ([-0.1, 0.0, 0.18], 0.011),
        ([-0.096, 0.0, 0.235], 0.011),
        ([-0.075, 0.0, 0.259], 0.011),
        ([0.075, 0.0, 0.259], 0.011),
        ([0.096, 0.0, 0.235], 0.011),
        ([0.1, 0.0, 0.18], 0.011),
        ([0.098, 0.0, 0.09], 0.012),
    ];
    sweep(&Profile::circle(1.0, 8), &bow.map(|(at, size)| Station { at, size: [size; 2] }))
}

pub(super) fn kettle_grip() -> Mesh {
    capsule(0.026, [-0.055, 0.0, 0.259], [0.055, 0.0, 0.259], 12)
}

/// A mug with its handle towards x.
pub(super) fn mug() -> Mesh {
    let line =
        [[0.0, 0.0], [0.036, 0.0], [0.04, 0.004], [0.04, 0.1], [0.036, 0.1], [0.036, 0.008], [0.0, 0.007]];
    let bar = |half, at| rounded_box(half, 0.004, 1).moved(at);
    let handle = [
        bar([0.014, 0.006, 0.006], [0.05, 0.0, 0.08]),
        bar([0.014, 0.006, 0.006], [0.05, 0.0, 0.03]),
        bar([0.006, 0.006, 0.031], [0.064, 0.0, 0.055]),
    ];
    revolve(&line, 14).with(&Mesh::of(&handle))
}

/// A stack of bowls on the shelf.
pub(super) fn bowls() -> Mesh {
    let outside = [[0.0, 0.0], [0.042, 0.0], [0.07, 0.03], [0.085, 0.06]];
    let inside = [[0.081, 0.06], [0.066, 0.034], [0.03, 0.016], [0.0, 0.014]];
    let filled = revolve(&[&outside[..], &[[0.0, 0.06]]].concat(), 16);
    let top = revolve(&[outside, inside].concat(), 16).moved([0.0, 0.0, 0.09]);
    (0..3).fold(top, |stack, k| stack.with(&filled.clone().moved([0.0, 0.0, 0.03 * f64::from(k)])))
}
