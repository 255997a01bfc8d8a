//! Devices, with RoboHive's sizes and frames \[m\].

use super::rod;
use crate::shape::{Shape, block, hull, side};
use workshop::{Mesh, Profile, Vec3, cylinder, ellipsoid, revolve, rounded_box, sincos};

pub(crate) const MESHES: &[Shape] = &[
    ("binoculars", binoculars),
    ("binoculars_lenses", binoculars_lenses),
    ("camera", camera),
    ("camera_lens", camera_lens),
    ("flashlight", flashlight),
    ("flashlight_lens", flashlight_lens),
    ("gamecontroller", gamecontroller),
    ("gamecontroller_buttons", gamecontroller_buttons),
    ("headphones", headphones),
    ("headphones_pads", headphones_pads),
    ("mouse", mouse),
    ("mouse_wheel", mouse_wheel),
    ("phone", phone),
    ("phone_keys", phone_keys),
];

const Y: Vec3 = [0.0, 1.0, 0.0];

/// Two barrels along z, the wide ends below.
fn binoculars() -> Mesh {
    let line = [
        [0.0, -0.0553],
        [0.0235, -0.0553],
        [0.0247, -0.052],
        [0.0247, -0.035],
        [0.021, -0.018],
        [0.0195, 0.012],
        [0.0165, 0.022],
        [0.0165, 0.036],
        [0.0195, 0.04],
        [0.0195, 0.0553],
        [0.0, 0.0553],
    ];
    let barrel = |x: f64| revolve(&line, 14).moved([x, 0.0, 0.0]);
    let prism = |x: f64| rounded_box([0.02, 0.0215, 0.018], 0.006, 1).moved([x, 0.001, 0.004]);
    let bridge = block([-0.03, -0.006, -0.012], [0.03, 0.008, 0.022], 0.003);
    let wheel = cylinder(0.0095, [-0.006, 0.03], 0.002, 10).moved([0.0, 0.01, 0.0]);
    Mesh::of(&[barrel(0.0469), barrel(-0.0469), prism(0.045), prism(-0.045), bridge, wheel])
}

fn binoculars_lenses() -> Mesh {
    let lens = |x: f64| {
        cylinder(0.0205, [-0.0556, -0.054], 0.0, 8)
            .with(&cylinder(0.014, [0.054, 0.0556], 0.0, 6))
            .moved([x, 0.0, 0.0])
    };
    lens(0.0469).with(&lens(-0.0469))
}

/// A camera, its lens towards -y.
fn camera() -> Mesh {
    let body = block([-0.0584, -0.007, -0.0344], [0.0584, 0.0245, 0.0245], 0.005);
    let grip =
        hull(2, &[[-0.032, 0.012, 0.012, 0.0455, -0.008], [0.0225, 0.0125, 0.0115, 0.0455, -0.008]], 3.0, 10);
    let finder = hull(
        2,
        &[
            [0.023, 0.022, 0.014, -0.002, 0.009],
            [0.0315, 0.016, 0.012, -0.002, 0.009],
            [0.0345, 0.012, 0.01, -0.002, 0.009],
        ],
        4.0,
        12,
    );
    let button = cylinder(0.0055, [0.024, 0.029], 0.001, 8).moved([0.044, 0.002, 0.0]);
    Mesh::of(&[body, grip, finder, button])
}

fn camera_lens() -> Mesh {
    let line = [
        [0.0245, 0.006],
        [0.0245, 0.012],
        [0.0225, 0.0135],
        [0.0225, 0.0222],
        [0.02, 0.0242],
        [0.0172, 0.0235],
        [0.012, 0.0185],
        [0.0, 0.0172],
    ];
    revolve(&line, 16).along([0.0, -1.0, 0.0], [-0.006, 0.0, -0.005])
}

/// Its head at -z.
fn flashlight() -> Mesh {
    let line = [
        [0.0, -0.07],
        [0.0165, -0.07],
        [0.01735, -0.067],
        [0.01735, -0.045],
        [0.0125, -0.03],
        [0.0122, -0.012],
        [0.0128, -0.01],
        [0.0128, 0.048],
        [0.0122, 0.05],
        [0.0135, 0.053],
        [0.0135, 0.064],
        [0.0115, 0.067],
        [0.006, 0.067],
        [0.006, 0.0699],
        [0.0, 0.0699],
    ];
    revolve(&line, 14)
}

fn flashlight_lens() -> Mesh {
    cylinder(0.0145, [-0.0702, -0.0695], 0.0, 10)
}

/// Two grips towards -y, the sticks on top.
fn gamecontroller() -> Mesh {
    let body = hull(
        0,
        &[
            [-0.06, 0.028, 0.012, 0.015, 0.001],
            [-0.035, 0.0315, 0.0158, 0.0155, 0.001],
            [0.035, 0.0315, 0.0158, 0.0155, 0.001],
            [0.06, 0.028, 0.012, 0.015, 0.001],
        ],
        3.0,
        14,
    );
    let grip = |sign: f64| {
        rod(
            &[
                ([sign * 0.052, 0.038, 0.001], [0.0125, 0.01]),
                ([sign * 0.057, 0.018, -0.001], [0.0205, 0.0165]),
                ([sign * 0.0595, -0.01, -0.005], [0.0175, 0.0165]),
                ([sign * 0.062, -0.034, -0.0095], [0.0148, 0.0145]),
                ([sign * 0.0625, -0.0485, -0.0125], [0.0085, 0.009]),
            ],
            12,
        )
    };
    body.with(&grip(1.0)).with(&grip(-1.0))
}

fn gamecontroller_buttons() -> Mesh {
    let stick = |x: f64| {
        cylinder(0.0045, [0.012, 0.019], 0.0, 6)
            .with(&cylinder(0.0085, [0.0185, 0.0243], 0.0015, 10))
            .moved([x, 0.001, 0.0])
    };
    let button = |x: f64, y: f64| cylinder(0.0042, [0.0155, 0.0188], 0.001, 8).moved([x, y, 0.0]);
    let cross = block([-0.0615, 0.0195, 0.015], [-0.0425, 0.0255, 0.0185], 0.001).with(&block(
        [-0.055, 0.013, 0.015],
        [-0.049, 0.032, 0.0185],
        0.001,
    ));
    let shoulders = [-1.0, 1.0]
        .map(|sign: f64| rounded_box([0.0145, 0.006, 0.006], 0.002, 1).moved([sign * 0.052, 0.043, 0.001]));
    let parts = [
        stick(0.024),
        stick(-0.024),
        button(0.052, 0.0325),
        button(0.052, 0.0125),
        button(0.042, 0.0225),
        button(0.062, 0.0225),
        cross,
    ];
    Mesh::of(parts.iter().chain(&shoulders))
}

/// They lie flat: the band a bow towards +y, the cups at -y.
fn headphones() -> Mesh {
    let path: Vec<_> = (0..=14)
        .map(|step| {
            let (sine, cosine) = sincos(-0.35 + (std::f64::consts::PI + 0.7) * f64::from(step) / 14.0);
            ([0.0575 * cosine, 0.005 + 0.0575 * sine, 0.0], [0.004, 0.0075])
        })
        .collect();
    let cup = |sign: f64| {
        cylinder(0.0294, [0.0, 0.014], 0.005, 16).along([sign, 0.0, 0.0], [sign * 0.0485, -0.0367, 0.0])
    };
    rod(&path, 8).with(&cup(1.0)).with(&cup(-1.0))
}

fn headphones_pads() -> Mesh {
    let pad = |sign: f64| {
        let line = [[0.013, -0.0125], [0.019, -0.016], [0.0265, -0.0125], [0.028, 0.0005], [0.013, 0.0005]];
        revolve(&line, 14).along([sign, 0.0, 0.0], [sign * 0.0485, -0.0367, 0.0])
    };
    pad(1.0).with(&pad(-1.0))
}

/// Its buttons at +x.
fn mouse() -> Mesh {
    let sections = [
        [-0.0195, 0.052, 0.0265, 0.0, 0.0],
        [-0.0145, 0.0582, 0.0308, 0.0, 0.0],
        [-0.003, 0.0585, 0.0313, 0.0, 0.0],
        [0.007, 0.052, 0.028, -0.003, 0.0],
        [0.0145, 0.038, 0.022, -0.009, 0.0],
        [0.0185, 0.02, 0.013, -0.014, 0.0],
        [0.0195, 0.007, 0.005, -0.015, 0.0],
    ];
    hull(2, &sections, 2.4, 16)
}

fn mouse_wheel() -> Mesh {
    let gap = side(
        &Profile::polygon(&[
            [0.012, 0.0135],
            [0.03, 0.0095],
            [0.045, 0.003],
            [0.0575, -0.004],
            [0.0575, -0.006],
            [0.012, 0.0],
        ]),
        [-0.0007, 0.0007],
    );
    cylinder(0.0085, [-0.0032, 0.0032], 0.001, 12).along(Y, [0.031, 0.0, 0.0065]).with(&gap)
}

/// A cordless handset: long along x, the keys towards -y.
fn phone() -> Mesh {
    let sections = [
        [-0.0746, 0.0075, 0.02, 0.003, 0.0],
        [-0.069, 0.011, 0.0243, 0.001, 0.0],
        [-0.02, 0.0105, 0.0251, 0.0015, 0.0],
        [0.03, 0.0105, 0.0225, 0.0015, 0.0],
        [0.06, 0.012, 0.0228, 0.0, 0.0],
        [0.071, 0.0105, 0.0205, -0.001, 0.0],
        [0.0746, 0.006, 0.016, -0.0005, 0.0],
    ];
    hull(0, &sections, 3.6, 14)
}

fn phone_keys() -> Mesh {
    let key = |row: u32, column: u32| {
        rounded_box([0.0048, 0.0012, 0.0048], 0.0, 1).moved([
            -0.063 + 0.0128 * f64::from(row),
            -0.0096,
            0.013 * (f64::from(column) - 1.0),
        ])
    };
    let keys: Vec<Mesh> = (0..5).flat_map(|row| (0..3).map(move |column| key(row, column))).collect();
    let screen = block([0.005, -0.0104, -0.0165], [0.043, -0.0085, 0.0165], 0.001);
    let speaker = ellipsoid([0.003, 0.001, 0.009], 8).moved([0.062, -0.0116, 0.0]);
    Mesh::of(&keys).with(&screen).with(&speaker)
}
