//! Things that tasks move, open and fill. Frames are below their middle, on what they stand on \[m\].

use super::rod;
use crate::shape::{Shape, block, side};
use workshop::{Mesh, Profile, cylinder, revolve, rounded_box};

pub(crate) const MESHES: &[Shape] = &[
    ("block", stud_block),
    ("bottle", bottle),
    ("bottle_cap", bottle_cap),
    ("handle", handle),
    ("zip_teeth", zip_teeth),
    ("zip_slider", zip_slider),
    ("zip_pull", zip_pull),
];

/// A toy brick of 50 x 25 x 20 mm with two studs.
fn stud_block() -> Mesh {
    let stud = |x: f64| cylinder(0.0075, [0.0195, 0.0235], 0.0008, 14).moved([x, 0.0, 0.0]);
    block([-0.025, -0.0125, 0.0], [0.025, 0.0125, 0.02], 0.0012).with(&stud(0.0125)).with(&stud(-0.0125))
}

/// A bottle of half a litre, up to the thread of its cap.
fn bottle() -> Mesh {
    let line = [
        [0.0, 0.0],
        [0.026, 0.0],
        [0.0325, 0.005],
        [0.0325, 0.045],
        [0.03, 0.052],
        [0.03, 0.085],
        [0.0325, 0.092],
        [0.0325, 0.13],
        [0.0285, 0.152],
        [0.0135, 0.178],
        [0.0135, 0.184],
        [0.016, 0.1845],
        [0.016, 0.187],
        [0.0115, 0.1875],
        [0.0115, 0.205],
        [0.0, 0.205],
    ];
    revolve(&line, 22)
}

/// Its cap, with ribs; its frame at the lower rim.
fn bottle_cap() -> Mesh {
    let ribs: Vec<Mesh> = (0..16)
        .map(|rib| {
            rounded_box([0.0008, 0.001, 0.0075], 0.0, 1)
                .moved([0.015, 0.0, 0.0085])
                .turned([0.0, 0.0, 1.0], std::f64::consts::TAU * f64::from(rib) / 16.0)
        })
        .collect();
    cylinder(0.015, [0.0, 0.018], 0.0015, 20).with(&Mesh::of(&ribs))
}

/// A handle of 120 mm along y, 30 mm before a door at x = 0.
fn handle() -> Mesh {
    let size = [0.005; 2];
    rod(
        &[
            ([0.0, -0.055, 0.0], size),
            ([-0.022, -0.055, 0.0], size),
            ([-0.03, -0.047, 0.0], size),
            ([-0.03, 0.047, 0.0], size),
            ([-0.022, 0.055, 0.0], size),
            ([0.0, 0.055, 0.0], size),
        ],
        10,
    )
}

/// Two rows of forty teeth along x, which mesh.
fn zip_teeth() -> Mesh {
    let tooth = |row: u32, number: u32| {
        let [low, high] = if row == 0 { [-0.0045, 0.0008] } else { [-0.0008, 0.0045] };
        let x = -0.1 + 0.005 * f64::from(number) + 0.0025 * f64::from(row);
        block([x - 0.0009, low, 0.0015], [x + 0.0009, high, 0.0045], 0.0)
    };
    let teeth: Vec<Mesh> = (0..2).flat_map(|row| (0..40).map(move |number| tooth(row, number))).collect();
    Mesh::of(&teeth)
}

/// The slider over the teeth, narrow where they are closed, at -x.
fn zip_slider() -> Mesh {
    let plate = Profile::polygon(&[
        [-0.007, -0.0055],
        [0.0, -0.0065],
        [0.0085, -0.009],
        [0.0085, 0.009],
        [0.0, 0.0065],
        [-0.007, 0.0055],
    ]);
    let top = workshop::extrude(&plate, &[], [0.0055, 0.0075]);
    let bow = side(
        &Profile::polygon(&[
            [-0.005, 0.007],
            [-0.003, 0.0115],
            [0.004, 0.0115],
            [0.006, 0.007],
            [0.004, 0.007],
            [0.003, 0.0095],
            [-0.002, 0.0095],
            [-0.003, 0.007],
        ]),
        [-0.0012, 0.0012],
    );
    top.with(&bow)
}

/// The pull on the slider's bow, hanging towards +x: a leaf.
fn zip_pull() -> Mesh {
    let leaf = Profile::link([0.0035, 0.006], 0.026, 8);
    workshop::extrude(&leaf, &[Profile::circle(0.0018, 8)], [-0.0009, 0.0009])
}
