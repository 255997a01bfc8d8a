//! Furniture in the frames of its bodies \[m\]: front is where y is least, up is z.

use std::f64::consts::{FRAC_PI_2, FRAC_PI_3};
use workshop::{Mesh, Profile, Vec3, cylinder, extrude, revolve, rounded_box};

const X: Vec3 = [1.0, 0.0, 0.0];
const Z: Vec3 = [0.0, 0.0, 1.0];

/// A plate that stands, by its outline across and up, between two depths.
fn standing(outline: &Profile, holes: &[Profile], [front, back]: [f64; 2]) -> Mesh {
    extrude(outline, holes, [-back, -front]).turned(X, FRAC_PI_2)
}

fn rectangle([a, b]: [f64; 2]) -> Profile {
    Profile::polygon(&[[-a, -b], [a, -b], [a, b], [-a, b]])
}

/// A frame of a door, as wide as `rim` all round.
fn frame(half: [f64; 2], rim: f64, depth: f64) -> Mesh {
    let opening = Profile::rounded_rectangle(half.map(|half| half - rim), 0.004, 1);
    standing(&Profile::rounded_rectangle(half, 0.006, 1), &[opening], [-depth, depth])
}

/// The housing round the cavity, with its feet.
pub(super) fn micro_shell() -> Mesh {
    let outline = Profile::rounded_rectangle([0.345, 0.1825], 0.018, 3).moved([0.0, 0.1915]);
    let cavity = Profile::rounded_rectangle([0.207, 0.144], 0.012, 2).moved([-0.08, 0.192]);
    let walls = standing(&outline, &[cavity], [-0.174, 0.16]);
    let back = standing(&outline, &[], [0.16, 0.222]);
    let foot = |x: f64, y: f64| cylinder(0.018, [0.0, 0.012], 0.0, 8).moved([x, y, 0.0]);
    let feet = [foot(-0.3, -0.12), foot(0.3, -0.12), foot(-0.3, 0.16), foot(0.3, 0.16)];
    Mesh::of([&walls, &back]).with(&Mesh::of(&feet))
}

/// The panel beside the door, with a frame round its display.
pub(super) fn micro_controls() -> Mesh {
    rounded_box([0.084, 0.023, 0.182], 0.008, 1).moved([0.26, -0.199, 0.191])
}

/// A dial and six buttons.
pub(super) fn micro_knobs() -> Mesh {
    let dial = cylinder(0.032, [0.0, 0.018], 0.004, 24).turned(X, FRAC_PI_2).moved([0.26, -0.221, 0.09]);
    let button = |k: usize| {
        let [x, z] = [0.222 + 0.038 * (k % 3) as f64, 0.185 + 0.05 * (k / 3) as f64];
        standing(&rectangle([0.014, 0.014]).moved([x, z]), &[], [-0.227, -0.22])
    };
    (0..6).fold(dial, |parts, k| parts.with(&button(k)))
}

/// The door about its window, from its hinge.
pub(super) fn micro_door() -> Mesh {
    let outline = Profile::rounded_rectangle([0.258, 0.181], 0.014, 4).moved([0.259, -0.001]);
    let window = Profile::rounded_rectangle([0.17, 0.118], 0.018, 4).moved([0.225, 0.0]);
    standing(&outline, &[window], [-0.049, -0.003])
}

/// The front of the fixed half.
pub(super) fn slide_frame() -> Mesh {
    frame([0.226, 0.2], 0.05, 0.012)
}

pub(super) fn slide_door() -> Mesh {
    frame([0.225, 0.195], 0.055, 0.03)
}

/// A door of the cabinet with hinges.
pub(super) fn hinge_door() -> Mesh {
    frame([0.191, 0.196], 0.055, 0.03)
}

/// The worktop on the left.
pub(super) fn counter_top() -> Mesh {
    rounded_box([0.463, 1.08, 0.03], 0.01, 1)
}

/// A front with a border round a field that lies deeper.
fn front(half: [f64; 2]) -> Mesh {
    let field = rounded_box([half[0] - 0.03, 0.003, half[1] - 0.03], 0.002, 1).moved([0.0, 0.004, 0.0]);
    frame(half, 0.035, 0.009).with(&field)
}

pub(super) fn counter_door() -> Mesh {
    front([0.138, 0.45])
}

pub(super) fn counter_drawer() -> Mesh {
    front([0.138, 0.12])
}

pub(super) fn sink_drawer() -> Mesh {
    front([0.285, 0.112])
}

/// The outline of the counter with the sink, `more` wider all round, and of the basin in it.
fn sink_outlines(more: f64) -> [Profile; 2] {
    let counter = Profile::rounded_rectangle([0.304 + more, 0.606 + more], 0.008, 2).moved([0.907, -0.045]);
    [counter, Profile::rounded_rectangle([0.202, 0.407], 0.05, 3).moved([0.907, -0.172])]
}

pub(super) fn sink_body() -> Mesh {
    let [counter, basin] = sink_outlines(0.0);
    extrude(&counter, &[basin], [0.0, 1.54])
}

pub(super) fn sink_top() -> Mesh {
    let [counter, basin] = sink_outlines(0.006);
    extrude(&counter, &[basin], [1.54, 1.6])
}

/// The basin with its rim and drain.
pub(super) fn sink() -> Mesh {
    let [_, basin] = sink_outlines(0.0);
    let wall = extrude(&basin.inset(0.001), &[basin.inset(0.009)], [1.421, 1.6]);
    let rim = extrude(&basin.inset(-0.014), &[basin.inset(0.009)], [1.6, 1.604]);
    let bottom = extrude(&basin.inset(0.001), &[], [1.41, 1.422]);
    let drain = cylinder(0.04, [1.42, 1.426], 0.0, 16).moved([0.907, -0.172, 0.0]);
    Mesh::of([&wall, &rim, &bottom, &drain])
}

/// The stove without its fronts, as high as the glass.
pub(super) fn stove_body() -> Mesh {
    rounded_box([0.5, 0.622, 0.8], 0.008, 1).moved([-0.017, 0.28, -0.185])
}

/// The door about its window, and the drawer below.
pub(super) fn stove_fronts() -> Mesh {
    let outline = Profile::rounded_rectangle([0.47, 0.46], 0.014, 2).moved([-0.017, -0.09]);
    let window = Profile::rounded_rectangle([0.35, 0.22], 0.03, 3).moved([-0.017, -0.08]);
    let door = standing(&outline, &[window], [-0.362, -0.34]);
    let strip = rounded_box([0.47, 0.011, 0.1], 0.006, 1).moved([-0.017, -0.351, 0.49]);
    let drawer = rounded_box([0.47, 0.011, 0.185], 0.006, 1).moved([-0.017, -0.351, -0.755]);
    Mesh::of([&door, &strip, &drawer])
}

/// What carries pots above a burner: a ring and six arms; its top is at zero.
pub(super) fn grate() -> Mesh {
    let line = [[0.108, -0.012], [0.12, -0.012], [0.12, 0.0], [0.108, 0.0]];
    let ring = revolve(&[&line[..], &line[..1]].concat(), 24);
    let arm = extrude(&rectangle([0.036, 0.005]).moved([0.075, 0.0]), &[], [-0.008, 0.0]);
    (0..6).fold(ring, |parts, k| parts.with(&arm.clone().turned(Z, FRAC_PI_3 * f64::from(k))))
}

/// A knob that points along y, its face along z.
pub(super) fn knob() -> Mesh {
    let grip = rounded_box([0.013, 0.047, 0.019], 0.008, 1).moved([0.0, 0.0, 0.037]);
    cylinder(0.05, [0.004, 0.022], 0.005, 24).with(&grip)
}

/// The hood, open below.
pub(super) fn hood() -> Mesh {
    let outline = Profile::rounded_rectangle([0.5, 0.334], 0.03, 3).moved([0.0, 0.073]);
    let walls = extrude(&outline, &[outline.inset(0.012)], [-0.166, -0.08]);
    let middle = extrude(&outline, &[], [-0.08, 0.04]);
    let top = extrude(&outline.inset(0.02), &[], [0.04, 0.072]);
    let rim = extrude(&outline.inset(-0.004), &[outline.inset(0.016)], [-0.17, -0.15]);
    Mesh::of([&walls, &middle, &top, &rim])
}
