//! What the tasks of the Adroit hand are about: a pen, a hammer with its nail, a door with its latch, each in the frame of its body
//! \[m\], within the primitives that collide.

use workshop::{Mesh, Profile, Station, Vec3, capsule, cylinder, extrude, loft, revolve, rounded_box, sweep};

const X: Vec3 = [1.0, 0.0, 0.0];
const Y: Vec3 = [0.0, 1.0, 0.0];

/// The barrel, up to its point at z = 0.069.
pub(super) fn pen_barrel() -> Mesh {
    let line = [
        [0.0, -0.03],
        [0.0148, -0.03],
        [0.0148, 0.04],
        [0.0125, 0.052],
        [0.008, 0.062],
        [0.003, 0.068],
        [0.0, 0.069],
    ];
    revolve(&line, 20)
}

/// The cap with its clip, 13 cm of pen long with the barrel.
pub(super) fn pen_cap() -> Mesh {
    let line = [
        [0.0, -0.0655],
        [0.0135, -0.0655],
        [0.016, -0.063],
        [0.0168, -0.057],
        [0.0168, -0.028],
        [0.0162, -0.0255],
        [0.0, -0.0255],
    ];
    let clip = rounded_box([0.0012, 0.0035, 0.026], 0.001, 1).moved([-0.0195, 0.0, -0.036]);
    let bridge = rounded_box([0.003, 0.0035, 0.003], 0.001, 1).moved([-0.0175, 0.0, -0.0595]);
    Mesh::of([&revolve(&line, 20), &clip, &bridge])
}

/// The wooden handle along x, waisted where the hand closes.
pub(super) fn hammer_handle() -> Mesh {
    let path = [
        (0.0755, 0.012),
        (0.073, 0.019),
        (0.066, 0.0245),
        (0.045, 0.0245),
        (0.015, 0.0215),
        (-0.02, 0.0225),
        (-0.05, 0.0245),
        (-0.062, 0.022),
        (-0.07, 0.016),
    ];
    let stations = path.map(|(x, size)| Station { at: [x, 0.0, 0.0], size: [size; 2] });
    sweep(&Profile::circle(1.0, 16), &stations)
}

/// The steel neck, and a head that strikes with either end.
pub(super) fn hammer_head() -> Mesh {
    let neck = capsule(0.007, [-0.06, 0.0, 0.0], [-0.236, 0.0, 0.0], 12);
    let line = [
        [0.0, -0.04],
        [0.018, -0.04],
        [0.02, -0.038],
        [0.02, -0.028],
        [0.0155, -0.02],
        [0.0175, -0.014],
        [0.0175, 0.014],
        [0.0155, 0.02],
        [0.02, 0.028],
        [0.02, 0.038],
        [0.018, 0.04],
        [0.0, 0.04],
    ];
    neck.with(&revolve(&line, 20).moved([-0.24, 0.0, 0.0]))
}

/// A nail with a broad head, driven towards -z.
pub(super) fn nail() -> Mesh {
    let line = [
        [0.0, -0.03],
        [0.0085, -0.004],
        [0.0098, 0.0],
        [0.0098, 0.094],
        [0.03, 0.0955],
        [0.0348, 0.0975],
        [0.0348, 0.103],
        [0.032, 0.105],
        [0.0, 0.105],
    ];
    revolve(&line, 20)
}

/// The leaf of the door, round at both edges.
pub(super) fn door_leaf() -> Mesh {
    let outline = Profile::link([0.05, 0.05], 0.4, 8).moved([-0.2, 0.0]);
    let ring = |inset: f64, z: f64| -> Vec<Vec3> {
        outline.inset(inset).points().iter().map(|[x, y]| [*x, *y, z]).collect()
    };
    loft(&[ring(0.004, -0.25), ring(0.0, -0.246), ring(0.0, 0.246), ring(0.004, 0.25)])
}

/// Fillets of two panels on either side of the leaf.
pub(super) fn door_panels() -> Mesh {
    let frame = |half: [f64; 2], [x, z]: [f64; 2]| {
        let outer = Profile::rounded_rectangle(half, 0.008, 2);
        let inner = Profile::rounded_rectangle([half[0] - 0.01, half[1] - 0.01], 0.005, 2);
        extrude(&outer, &[inner], [-0.0525, 0.0525]).turned(X, std::f64::consts::FRAC_PI_2).moved([x, 0.0, z])
    };
    frame([0.17, 0.07], [0.0, 0.15]).with(&frame([0.13, 0.085], [0.06, -0.135]))
}

/// A post of the frame: round, with a foot and a head.
pub(super) fn door_post() -> Mesh {
    let line = [
        [0.0, -0.25],
        [0.05, -0.25],
        [0.05, -0.225],
        [0.045, -0.215],
        [0.043, -0.19],
        [0.043, 0.19],
        [0.045, 0.215],
        [0.05, 0.225],
        [0.05, 0.25],
        [0.0, 0.25],
    ];
    revolve(&line, 20)
}

/// The latch: a boss on the leaf, the spindle, and the lever; behind the door a knob.
pub(super) fn door_latch() -> Mesh {
    let boss = cylinder(0.05, [-0.07, 0.07], 0.006, 20).along(Y, [0.0; 3]);
    let spindle = cylinder(0.032, [-0.15, 0.15], 0.008, 18).along(Y, [0.0; 3]);
    let lever = capsule(0.02, [0.0, -0.15, 0.0], [0.2, -0.15, 0.0], 12);
    let knob = capsule(0.04, [-0.17, 0.1, 0.0], [-0.03, 0.1, 0.0], 14);
    Mesh::of([&boss, &spindle, &lever, &knob])
}
