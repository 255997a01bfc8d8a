//! Furniture in the frames of its bodies \[m\]: front is where y is least, up is z.

use std::f64::consts::FRAC_PI_2;
use workshop::{Mesh, Profile, Vec3, cylinder, extrude, revolve, rounded_box};

const X: Vec3 = [1.0, 0.0, 0.0];

/// A plate that stands, by its outline across and up, between two depths.
fn standing(outline: &Profile, holes: &[Profile], [front, back]: [f64; 2]) -> Mesh {
    extrude(outline, holes, [-back, -front]).turned(X, FRAC_PI_2)
}

/// A frame of a door, as wide as `rim` all round.
fn frame(half: [f64; 2], rim: f64, depth: f64) -> Mesh {
    let opening = Profile::rounded_rectangle(half.map(|half| half - rim), 0.004, 1);
    standing(&Profile::rounded_rectangle(half, 0.006, 3), &[opening], [-depth, depth])
}

/// The housing round the cavity, with its feet.
pub(super) fn micro_shell() -> Mesh {
    let outline = Profile::rounded_rectangle([0.345, 0.1825], 0.018, 4).moved([0.0, 0.1915]);
    let cavity = Profile::rounded_rectangle([0.207, 0.144], 0.012, 3).moved([-0.08, 0.192]);
    let walls = standing(&outline, &[cavity], [-0.174, 0.16]);
    let back = standing(&outline, &[], [0.16, 0.222]);
    let foot = |x: f64, y: f64| cylinder(0.018, [0.0, 0.012], 0.003, 12).moved([x, y, 0.0]);
    let feet = [foot(-0.3, -0.12), foot(0.3, -0.12), foot(-0.3, 0.16), foot(0.3, 0.16)];
    Mesh::of([&walls, &back]).with(&Mesh::of(&feet))
}

/// The panel beside the door, with a frame round its display.
pub(super) fn micro_controls() -> Mesh {
    rounded_box([0.084, 0.023, 0.182], 0.008, 2).moved([0.26, -0.199, 0.191])
}

/// A dial and six buttons.
pub(super) fn micro_knobs() -> Mesh {
    let dial = cylinder(0.032, [0.0, 0.018], 0.004, 28).turned(X, FRAC_PI_2).moved([0.26, -0.221, 0.09]);
    let button = |k: usize| {
        let [x, z] = [0.222 + 0.038 * (k % 3) as f64, 0.185 + 0.05 * (k / 3) as f64];
        rounded_box([0.014, 0.004, 0.014], 0.003, 1).moved([x, -0.223, z])
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

/// A stack of bowls on the shelf.
pub(super) fn bowls() -> Mesh {
    let bowl = |height: f64| {
        let line = [
            [0.0, 0.0],
            [0.04, 0.0],
            [0.042, 0.01],
            [0.07, 0.03],
            [0.085, 0.06],
            [0.081, 0.06],
            [0.066, 0.034],
            [0.03, 0.016],
            [0.0, 0.014],
        ];
        revolve(&line, 24).moved([0.0, 0.0, height])
    };
    (1..4).fold(bowl(0.0), |stack, k| stack.with(&bowl(0.03 * k as f64)))
}

#[cfg(test)]
mod tests {
    use super::super::MESHES;

    #[test]
    fn shapes_are_closed_and_of_few_faces() {
        let mut faces = 0;
        for (name, make) in MESHES {
            let mesh = make();
            assert!(mesh.is_closed() && mesh.volume() > 0.0, "{name}");
            faces += mesh.faces().len();
        }
        assert!(faces < 9000, "{faces}");
    }
}
