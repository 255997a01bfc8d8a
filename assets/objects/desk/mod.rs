//! Small things of a desk and a bathroom, with RoboHive's sizes and frames \[m\].

use super::rod;
use crate::shape::{Shape, block, hull, side};
use workshop::{
    Mesh, Profile, Station, Vec3, capsule, cylinder, ellipsoid, extrude, revolve, rounded_box, sincos, sweep,
};

pub(crate) const MESHES: &[Shape] = &[
    ("alarmclock", alarmclock),
    ("alarmclock_face", alarmclock_face),
    ("alarmclock_hands", alarmclock_hands),
    ("eyeglasses", eyeglasses),
    ("eyeglasses_lenses", eyeglasses_lenses),
    ("hammer_head", hammer_head),
    ("hammer_handle", hammer_handle),
    ("lightbulb", lightbulb),
    ("lightbulb_socket", lightbulb_socket),
    ("scissors_blades", scissors_blades),
    ("scissors_handles", scissors_handles),
    ("stamp", stamp),
    ("stamp_knob", stamp_knob),
    ("stapler", stapler),
    ("stapler_base", stapler_base),
    ("toothbrush", toothbrush),
    ("toothbrush_bristles", toothbrush_bristles),
    ("toothpaste", toothpaste),
    ("toothpaste_cap", toothpaste_cap),
    ("watch_strap", watch_strap),
    ("watch_case", watch_case),
];

const X: Vec3 = [1.0, 0.0, 0.0];
const Y: Vec3 = [0.0, 1.0, 0.0];

/// The drum of an alarm clock, its two bells and its feet.
fn alarmclock() -> Mesh {
    let drum = cylinder(0.0435, [-0.0205, 0.0205], 0.004, 22).along(Y, [0.0, 0.0, -0.0065]);
    let sides = [-1.0, 1.0].map(|sign: f64| {
        let bell =
            revolve(&[[0.0, -0.004], [0.0185, -0.004], [0.0175, 0.004], [0.011, 0.01], [0.0, 0.012]], 14);
        let foot = capsule(0.0055, [sign * 0.026, 0.0, -0.034], [sign * 0.034, 0.0, -0.0486], 8);
        let stay = capsule(0.0025, [sign * 0.022, 0.0, 0.027], [sign * 0.041, 0.0, 0.033], 6);
        bell.along([sign * 0.6, 0.0, 0.8], [sign * 0.0445, 0.0, 0.036]).with(&foot).with(&stay)
    });
    let handle = rod(
        &[
            ([-0.017, 0.0, 0.04], [0.0025; 2]),
            ([-0.014, 0.0, 0.0505], [0.0025; 2]),
            ([0.014, 0.0, 0.0505], [0.0025; 2]),
            ([0.017, 0.0, 0.04], [0.0025; 2]),
        ],
        6,
    );
    Mesh::of(&sides).with(&drum).with(&handle)
}

fn alarmclock_face() -> Mesh {
    cylinder(0.0375, [-0.0216, -0.02], 0.0, 18).along(Y, [0.0, 0.0, -0.0065])
}

fn alarmclock_hands() -> Mesh {
    let hand = |length: f64, turn: f64| {
        block([-0.0015, -0.0225, -0.004], [0.0015, -0.0212, length], 0.0)
            .turned(Y, turn)
            .moved([0.0, 0.0, -0.0065])
    };
    let marks = (0..12).map(|hour| {
        let (sine, cosine) = sincos(std::f64::consts::TAU * f64::from(hour) / 12.0);
        block([-0.001, -0.0222, -0.002], [0.001, -0.0212, 0.002], 0.0).moved([
            0.032 * sine,
            0.0,
            0.032 * cosine - 0.0065,
        ])
    });
    Mesh::of(&marks.collect::<Vec<_>>()).with(&hand(0.027, 1.1)).with(&hand(0.019, -0.9))
}

/// Frames and temples, the lenses in front at +y.
fn eyeglasses() -> Mesh {
    let rim = |sign: f64| {
        let path: Vec<_> = (0..=14)
            .map(|step| {
                let (sine, cosine) = sincos(std::f64::consts::TAU * f64::from(step) / 14.0);
                ([sign * (0.034 + 0.027 * cosine), 0.064, 0.0205 * sine], [0.002, 0.002])
            })
            .collect();
        rod(&path, 6)
    };
    let temple = |sign: f64| {
        let size = [0.0025, 0.0035];
        rod(
            &[
                ([sign * 0.0655, 0.0665, 0.006], size),
                ([sign * 0.0655, 0.03, 0.006], size),
                ([sign * 0.062, -0.03, 0.005], size),
                ([sign * 0.058, -0.0685, -0.0145], size),
            ],
            6,
        )
    };
    let joint = |sign: f64| rounded_box([0.004, 0.003, 0.004], 0.001, 1).moved([sign * 0.062, 0.0645, 0.006]);
    let bridge = rod(
        &[
            ([-0.008, 0.064, 0.004], [0.002; 2]),
            ([0.0, 0.0665, 0.008], [0.002; 2]),
            ([0.008, 0.064, 0.004], [0.002; 2]),
        ],
        6,
    );
    Mesh::of([-1.0, 1.0].map(|sign| rim(sign).with(&temple(sign)).with(&joint(sign))).iter()).with(&bridge)
}

fn eyeglasses_lenses() -> Mesh {
    let lens = |x: f64| side(&Profile::ellipse([0.0265, 0.02], 16).moved([x, 0.0]), [0.0635, 0.0645]);
    lens(0.034).with(&lens(-0.034))
}

/// The head at -x, its claw towards -y.
fn hammer_head() -> Mesh {
    let face = cylinder(0.0122, [0.028, 0.0592], 0.002, 12).along(Y, [-0.0885, 0.0, 0.0]);
    let neck = rounded_box([0.0095, 0.016, 0.0095], 0.003, 1).moved([-0.0885, 0.016, 0.0]);
    let eye = block([-0.1031, -0.014, -0.0115], [-0.074, 0.014, 0.0115], 0.004);
    let prong = |z: f64| {
        let claw = Profile::polygon(&[
            [-0.1, -0.01],
            [-0.096, -0.036],
            [-0.084, -0.0588],
            [-0.08, -0.057],
            [-0.085, -0.034],
            [-0.077, -0.01],
        ]);
        extrude(&claw, &[], [z - 0.0045, z + 0.0045])
    };
    Mesh::of(&[face, neck, eye, prong(0.0062), prong(-0.0062)])
}

fn hammer_handle() -> Mesh {
    let sections = [
        [-0.082, 0.0065, 0.009, 0.0, 0.0],
        [-0.05, 0.0075, 0.0085, 0.0, 0.0],
        [0.01, 0.0115, 0.009, 0.0, 0.0],
        [0.06, 0.0125, 0.0105, 0.0, 0.0],
        [0.098, 0.0135, 0.0115, 0.0, 0.0],
        [0.1031, 0.01, 0.009, 0.0, 0.0],
    ];
    hull(0, &sections, 2.6, 12)
}

fn lightbulb() -> Mesh {
    let line = [
        [0.014, -0.026],
        [0.015, -0.012],
        [0.022, 0.003],
        [0.0295, 0.016],
        [0.0315, 0.028],
        [0.0285, 0.042],
        [0.0195, 0.052],
        [0.009, 0.0555],
        [0.0, 0.0558],
    ];
    revolve(&line, 16).along(X, [0.0; 3])
}

fn lightbulb_socket() -> Mesh {
    let thread = (0..9).map(|step: u32| {
        [if step.is_multiple_of(2) { 0.0122 } else { 0.0135 }, -0.05 + 0.003 * f64::from(step)]
    });
    let line: Vec<[f64; 2]> =
        [[0.0, -0.0558], [0.006, -0.0558], [0.0085, -0.052]].into_iter().chain(thread).collect();
    revolve(&line, 12).along(X, [0.0; 3])
}

/// Two blades, points towards -y.
fn scissors_blades() -> Mesh {
    let blade = |sign: f64, z: f64| {
        let outline = [
            [0.005, 0.022],
            [0.0065, -0.005],
            [0.002, -0.0654],
            [-0.002, -0.062],
            [-0.0045, -0.005],
            [-0.004, 0.022],
        ];
        let outline = Profile::polygon(&outline.map(|[x, y]| [sign * x, y]));
        extrude(&outline, &[], [z - 0.001, z + 0.001])
    };
    blade(1.0, 0.0012)
        .with(&blade(-1.0, -0.0012))
        .with(&cylinder(0.0045, [-0.0035, 0.0035], 0.0, 6).moved([0.0, 0.006, 0.0]))
}

fn scissors_handles() -> Mesh {
    let ring = |sign: f64| {
        let path: Vec<_> = (0..=12)
            .map(|step| {
                let (sine, cosine) = sincos(std::f64::consts::TAU * f64::from(step) / 12.0);
                ([sign * (0.0195 + 0.0135 * cosine), 0.0445 + 0.0165 * sine, 0.0], [0.0045, 0.006])
            })
            .collect();
        rod(&path, 8)
    };
    let arm = |sign: f64| {
        rod(&[([sign * 0.001, 0.014, 0.0], [0.0045; 2]), ([sign * 0.01, 0.031, 0.0], [0.0045; 2])], 8)
    };
    Mesh::of([-1.0, 1.0].map(|sign| ring(sign).with(&arm(sign))).iter())
}

/// A hand stamp: its block below, with a long knob.
fn stamp() -> Mesh {
    block([-0.0506, -0.0331, -0.0375], [0.0506, 0.0331, -0.012], 0.004)
}

fn stamp_knob() -> Mesh {
    revolve(
        &[
            [0.016, -0.013],
            [0.0135, -0.004],
            [0.0095, 0.008],
            [0.012, 0.018],
            [0.0185, 0.026],
            [0.0165, 0.034],
            [0.008, 0.0375],
            [0.0, 0.0375],
        ],
        18,
    )
}

fn stapler() -> Mesh {
    let sections = [
        [-0.061, 0.0125, 0.007, 0.0, 0.0115],
        [-0.05, 0.0145, 0.01, 0.0, 0.0108],
        [0.0, 0.0135, 0.0075, 0.0, 0.006],
        [0.045, 0.0135, 0.0065, 0.0, 0.0005],
        [0.0612, 0.0115, 0.005, 0.0, -0.0015],
    ];
    hull(0, &sections, 3.5, 12)
}

fn stapler_base() -> Mesh {
    let plate = block([-0.062, -0.0155, -0.0208], [0.062, 0.0155, -0.0155], 0.002);
    let rail = block([-0.05, -0.0085, -0.012], [0.057, 0.0085, -0.004], 0.001);
    let hinge = block([-0.058, -0.0125, -0.017], [-0.036, 0.0125, 0.0095], 0.003);
    Mesh::of(&[plate, rail, hinge])
}

/// Its bristles at -x, towards +z.
fn toothbrush() -> Mesh {
    let sections = [
        [-0.0828, 0.0045, 0.0015, 0.0012, -0.003],
        [-0.079, 0.0065, 0.0024, 0.0012, -0.003],
        [-0.058, 0.0062, 0.0024, 0.0012, -0.003],
        [-0.048, 0.003, 0.0026, 0.0012, -0.0026],
        [-0.015, 0.004, 0.0035, 0.0012, -0.0025],
        [0.015, 0.0072, 0.0045, 0.0012, -0.002],
        [0.05, 0.0062, 0.004, 0.0, -0.0024],
        [0.079, 0.006, 0.0035, 0.0, -0.003],
        [0.0828, 0.004, 0.0018, 0.0, -0.0035],
    ];
    hull(0, &sections, 2.5, 10)
}

fn toothbrush_bristles() -> Mesh {
    let tuft = |row: u32, column: u32| {
        let [x, y] = [-0.0775 + 0.0045 * f64::from(row), 0.0012 + 0.0038 * (f64::from(column) - 1.0)];
        block([x - 0.0016, y - 0.0014, -0.002], [x + 0.0016, y + 0.0014, 0.0066], 0.0)
    };
    Mesh::of((0..5).flat_map(|row| (0..3).map(move |column| tuft(row, column))).collect::<Vec<_>>().iter())
}

/// A tube that stands on its cap: flat at the top.
fn toothpaste() -> Mesh {
    let sections = [
        [-0.083, 0.0165, 0.0165, 0.0, 0.0],
        [-0.079, 0.0182, 0.0185, 0.0, 0.0],
        [-0.03, 0.0172, 0.021, 0.0, 0.0],
        [0.03, 0.0125, 0.0238, 0.0, 0.0],
        [0.085, 0.0035, 0.0267, 0.0, 0.0],
        [0.1016, 0.0012, 0.027, 0.0, 0.0],
    ];
    hull(2, &sections, 2.3, 16)
}

fn toothpaste_cap() -> Mesh {
    cylinder(0.0168, [-0.1016, -0.082], 0.0015, 14)
}

/// A strap that stands as a ring round y; the watch at +x.
fn watch_strap() -> Mesh {
    let place = |step: u32| {
        let (sine, cosine) = sincos(0.5 + (std::f64::consts::TAU - 1.0) * f64::from(step) / 20.0);
        Station { at: [0.0345 * cosine, 0.0, 0.0395 * sine], size: [1.0; 2] }
    };
    // Seen along the path, the section's first axis points away from the arm.
    let section =
        Profile::polygon(&[[0.0018, 0.0105], [-0.0018, 0.0105], [-0.0018, -0.0105], [0.0018, -0.0105]]);
    let clasp = block([-0.0383, -0.0125, -0.006], [-0.0335, 0.0125, 0.006], 0.001);
    sweep(&section, &(0..=20).map(place).collect::<Vec<_>>()).with(&clasp)
}

fn watch_case() -> Mesh {
    let case = cylinder(0.0235, [0.0255, 0.0358], 0.002, 18).along(X, [0.0; 3]);
    let glass = cylinder(0.02, [0.0357, 0.0378], 0.001, 18).along(X, [0.0; 3]);
    let crown = ellipsoid([0.0022, 0.0028, 0.0028], 6).moved([0.0305, 0.0235, 0.0]);
    Mesh::of(&[case, glass, crown])
}
