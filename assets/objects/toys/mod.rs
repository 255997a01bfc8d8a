//! Toys and figures, with RoboHive's sizes and frames \[m\]. What looks somewhere looks along x.

use super::rod;
use crate::shape::{Shape, block, hull, side};
use workshop::{Mesh, Profile, Vec3, capsule, cylinder, ellipsoid, extrude, revolve, rounded_box};

pub(crate) const MESHES: &[Shape] = &[
    ("airplane", airplane),
    ("airplane_trim", airplane_trim),
    ("duck", duck),
    ("duck_beak", duck_beak),
    ("duck_eyes", duck_eyes),
    ("elephant", elephant),
    ("elephant_tusks", elephant_tusks),
    ("flute", flute),
    ("flute_holes", flute_holes),
    ("hand", hand),
    ("piggybank", piggybank),
    ("piggybank_snout", piggybank_snout),
    ("stanfordbunny", bunny),
    ("train", train),
    ("train_wheels", train_wheels),
];

const X: Vec3 = [1.0, 0.0, 0.0];
const Y: Vec3 = [0.0, 1.0, 0.0];

/// Both sides of a part, mirrored at the plane of x and z.
fn both(part: &Mesh) -> Mesh {
    part.clone().with(&part.clone().mirrored(1))
}

/// Its nose at -x, its wings along y.
fn airplane() -> Mesh {
    let body = hull(
        0,
        &[
            [-0.0898, 0.003, 0.003, 0.0, -0.008],
            [-0.083, 0.0085, 0.0085, 0.0, -0.008],
            [-0.066, 0.0128, 0.0128, 0.0, -0.0078],
            [-0.03, 0.014, 0.0138, 0.0, -0.0072],
            [0.025, 0.0132, 0.0128, 0.0, -0.007],
            [0.062, 0.008, 0.0082, 0.0, -0.0035],
            [0.086, 0.003, 0.004, 0.0, 0.0],
        ],
        2.0,
        12,
    );
    let wing = extrude(
        &Profile::polygon(&[[-0.03, 0.006], [0.012, 0.0675], [0.027, 0.0696], [0.019, 0.006]]),
        &[],
        [-0.0135, -0.0095],
    );
    let tail = extrude(
        &Profile::polygon(&[[0.058, 0.003], [0.078, 0.03], [0.0875, 0.031], [0.082, 0.003]]),
        &[],
        [-0.0015, 0.0015],
    );
    let fin = side(
        &Profile::polygon(&[[0.052, 0.002], [0.075, 0.0258], [0.0897, 0.026], [0.081, 0.0]]),
        [-0.0017, 0.0017],
    );
    body.with(&both(&wing)).with(&both(&tail)).with(&fin)
}

/// Engines, windows of the cockpit, and the wheels.
fn airplane_trim() -> Mesh {
    let engine = hull(
        0,
        &[
            [-0.021, 0.0048, 0.0048, 0.032, -0.0185],
            [-0.017, 0.006, 0.006, 0.032, -0.0185],
            [0.006, 0.005, 0.005, 0.032, -0.0185],
        ],
        2.0,
        8,
    );
    let wheel = cylinder(0.0042, [-0.002, 0.002], 0.0, 6).along(Y, [0.004, 0.011, -0.0213]);
    let nose = cylinder(0.0036, [-0.002, 0.002], 0.0, 6).along(Y, [-0.06, 0.0, -0.0219]);
    let glass = ellipsoid([0.009, 0.0085, 0.006], 8).moved([-0.071, 0.0, 0.0005]);
    both(&engine.with(&wheel)).with(&nose).with(&glass)
}

fn duck() -> Mesh {
    let body = hull(
        0,
        &[
            [-0.0464, 0.004, 0.003, 0.0, -0.006],
            [-0.04, 0.014, 0.0115, 0.0, -0.0135],
            [-0.026, 0.027, 0.0225, 0.0, -0.0245],
            [-0.004, 0.0335, 0.027, 0.0, -0.0215],
            [0.016, 0.0315, 0.0265, 0.0, -0.022],
            [0.03, 0.0195, 0.019, 0.0, -0.0225],
            [0.0355, 0.006, 0.007, 0.0, -0.021],
        ],
        2.2,
        12,
    );
    let neck = hull(2, &[[-0.008, 0.024, 0.0235, 0.006, 0.0], [0.01, 0.0165, 0.016, 0.01, 0.0]], 2.0, 12);
    let wing = ellipsoid([0.02, 0.006, 0.0115], 8).moved([-0.008, 0.0285, -0.0145]);
    body.with(&neck)
        .with(&ellipsoid([0.0235, 0.0225, 0.0225], 12).moved([0.013, 0.0, 0.0262]))
        .with(&both(&wing))
}

fn duck_beak() -> Mesh {
    ellipsoid([0.0125, 0.0125, 0.0035], 8)
        .moved([0.034, 0.0, 0.0225])
        .with(&ellipsoid([0.0105, 0.0105, 0.003], 8).moved([0.033, 0.0, 0.018]))
}

fn duck_eyes() -> Mesh {
    both(&ellipsoid([0.0035, 0.0025, 0.0042], 6).moved([0.0285, 0.0145, 0.0335]))
}

fn elephant() -> Mesh {
    let body = hull(
        0,
        &[
            [-0.064, 0.012, 0.014, 0.0, 0.008],
            [-0.056, 0.024, 0.026, 0.0, 0.01],
            [-0.03, 0.0325, 0.033, 0.0, 0.012],
            [0.0, 0.032, 0.0325, 0.0, 0.012],
            [0.022, 0.025, 0.027, 0.0, 0.014],
        ],
        2.1,
        12,
    );
    let head = ellipsoid([0.0265, 0.0245, 0.0275], 12).moved([0.0345, 0.0, 0.0228]);
    let trunk = rod(
        &[
            ([0.05, 0.0, 0.017], [0.0115, 0.0115]),
            ([0.06, 0.0, -0.002], [0.0085, 0.0085]),
            ([0.0625, 0.0, -0.022], [0.007, 0.007]),
            ([0.0635, 0.0, -0.039], [0.0055, 0.0055]),
        ],
        10,
    );
    let leg = |x: f64| {
        hull(
            2,
            &[
                [-0.0505, 0.0125, 0.0115, x, 0.0175],
                [-0.044, 0.0118, 0.011, x, 0.0175],
                [0.0, 0.0135, 0.0125, x, 0.0165],
            ],
            2.0,
            8,
        )
    };
    let ear =
        ellipsoid([0.0155, 0.003, 0.019], 8).turned([0.0, 0.0, 1.0], 0.5).moved([0.021, 0.0305, 0.0222]);
    let tail = capsule(0.0022, [-0.063, 0.0, 0.016], [-0.066, 0.0, -0.014], 6);
    body.with(&head).with(&trunk).with(&both(&leg(-0.04).with(&leg(0.012)).with(&ear))).with(&tail)
}

fn elephant_tusks() -> Mesh {
    let tusk = rod(
        &[
            ([0.05, 0.0125, 0.006], [0.0035; 2]),
            ([0.06, 0.0145, -0.003], [0.003; 2]),
            ([0.0675, 0.0145, -0.003], [0.0012; 2]),
        ],
        8,
    );
    let eye = ellipsoid([0.002, 0.0018, 0.0024], 6).moved([0.0545, 0.0165, 0.028]);
    both(&tusk.with(&eye))
}

fn flute() -> Mesh {
    let line = [
        [0.0, -0.1054],
        [0.0075, -0.1054],
        [0.0086, -0.102],
        [0.0086, -0.06],
        [0.0078, -0.056],
        [0.0072, 0.06],
        [0.0082, 0.068],
        [0.0082, 0.1035],
        [0.0065, 0.1054],
        [0.0, 0.1054],
    ];
    revolve(&line, 12).along(X, [0.0; 3])
}

fn flute_holes() -> Mesh {
    let hole = |place: f64| cylinder(0.0027, [0.006, 0.0077], 0.0, 6).moved([place, 0.0, 0.0]);
    let holes: Vec<Mesh> = (0..7).map(|hole_number| hole(-0.045 + 0.0155 * f64::from(hole_number))).collect();
    Mesh::of(&holes).with(&block([-0.09, -0.004, 0.0075], [-0.078, 0.004, 0.0087], 0.0))
}

/// A hand that stands on its wrist, fingers up, the thumb towards -x.
fn hand() -> Mesh {
    let palm = hull(
        2,
        &[
            [-0.0696, 0.025, 0.0215, -0.008, 0.0165],
            [-0.05, 0.0225, 0.019, -0.008, 0.0145],
            [-0.03, 0.0285, 0.0175, -0.006, 0.0095],
            [0.0, 0.034, 0.0135, 0.0, 0.006],
            [0.02, 0.034, 0.0105, 0.002, 0.004],
        ],
        2.6,
        12,
    );
    let finger = |x: f64, top: f64, bend: f64| {
        rod(
            &[
                ([x, 0.003, 0.012], [0.0088; 2]),
                ([x * 1.08, 0.0, 0.012 + 0.55 * (top - 0.012)], [0.008; 2]),
                ([x * 1.14, -bend, top - 0.006], [0.0068; 2]),
                ([x * 1.15, -bend - 0.001, top], [0.0032; 2]),
            ],
            10,
        )
    };
    let thumb = rod(
        &[
            ([-0.022, 0.004, -0.022], [0.012; 2]),
            ([-0.033, -0.02, -0.004], [0.0095; 2]),
            ([-0.0375, -0.0365, 0.011], [0.0072; 2]),
            ([-0.0375, -0.041, 0.0145], [0.003; 2]),
        ],
        10,
    );
    Mesh::of(&[
        palm,
        finger(-0.0235, 0.061, 0.008),
        finger(-0.0065, 0.0696, 0.006),
        finger(0.0115, 0.064, 0.009),
        finger(0.0315, 0.048, 0.012),
        thumb,
    ])
}

fn piggybank() -> Mesh {
    let body = hull(
        0,
        &[
            [-0.087, 0.014, 0.016, 0.0, 0.006],
            [-0.076, 0.034, 0.036, 0.0, 0.004],
            [-0.045, 0.0545, 0.0535, 0.0, 0.002],
            [-0.005, 0.0595, 0.058, 0.0, 0.001],
            [0.035, 0.053, 0.052, 0.0, 0.003],
            [0.062, 0.039, 0.039, 0.0, 0.006],
            [0.079, 0.0215, 0.0215, 0.0, 0.006],
        ],
        2.0,
        16,
    );
    let leg = |x: f64| {
        hull(
            2,
            &[
                [-0.0688, 0.0135, 0.0135, x, 0.03],
                [-0.062, 0.0145, 0.0145, x, 0.03],
                [-0.025, 0.018, 0.018, x, 0.028],
            ],
            2.0,
            8,
        )
    };
    let ear = ellipsoid([0.007, 0.0135, 0.0175], 8).turned(X, -0.5).moved([0.041, 0.031, 0.0535]);
    let tail = rod(
        &[
            ([-0.083, 0.0, 0.012], [0.004; 2]),
            ([-0.0915, 0.004, 0.018], [0.003; 2]),
            ([-0.0905, -0.003, 0.026], [0.002; 2]),
        ],
        8,
    );
    body.with(&both(&leg(-0.045).with(&leg(0.035)).with(&ear))).with(&tail)
}

fn piggybank_snout() -> Mesh {
    let snout = cylinder(0.0185, [0.07, 0.0945], 0.004, 12).along(X, [0.0, 0.0, 0.004]);
    let eye = ellipsoid([0.003, 0.0035, 0.0045], 6).moved([0.0625, 0.0215, 0.032]);
    snout.with(&both(&eye)).with(&block([-0.022, -0.0022, 0.052], [0.015, 0.0022, 0.0605], 0.0))
}

/// A sitting rabbit, its head towards -x.
fn bunny() -> Mesh {
    let body = hull(
        2,
        &[
            [-0.0641, 0.05, 0.038, 0.008, -0.01],
            [-0.0575, 0.0565, 0.043, 0.006, -0.01],
            [-0.035, 0.0575, 0.0455, 0.004, -0.01],
            [-0.01, 0.046, 0.0395, 0.002, -0.009],
            [0.01, 0.029, 0.028, -0.008, -0.008],
            [0.022, 0.016, 0.018, -0.016, -0.006],
        ],
        2.2,
        16,
    );
    let head = ellipsoid([0.0285, 0.0235, 0.0225], 12).moved([-0.0335, 0.0, 0.0195]);
    let ear = |y: f64, lean: f64| {
        ellipsoid([0.0085, 0.0055, 0.0295], 8).turned(Y, 0.25).turned(X, lean).moved([-0.0125, y, 0.0352])
    };
    let haunch = ellipsoid([0.028, 0.0125, 0.026], 10).moved([0.026, 0.0295, -0.036]);
    let far = ellipsoid([0.028, 0.0125, 0.026], 10).moved([0.026, -0.0388, -0.036]);
    let paw = |y: f64| ellipsoid([0.0155, 0.009, 0.0085], 8).moved([-0.0425, y, -0.0555]);
    let tail = ellipsoid([0.0125; 3], 8).moved([0.0535, -0.008, -0.044]);
    let parts =
        [body, head, ear(0.0105, -0.18), ear(-0.0105, 0.18), haunch, far, paw(0.014), paw(-0.022), tail];
    Mesh::of(&parts).scaled([1.03, 1.06, 1.0]).moved([-0.002, 0.007, 0.0])
}

/// A locomotive, its chimney at +x.
fn train() -> Mesh {
    let boiler = cylinder(0.0205, [-0.012, 0.0455], 0.003, 12).along(X, [0.0, 0.0, 0.0012]);
    let cab = block([-0.0445, -0.0265, -0.022], [-0.01, 0.0265, 0.0315], 0.003);
    let roof = block([-0.0485, -0.0299, 0.031], [-0.006, 0.0299, 0.0375], 0.002);
    let frame = block([-0.0455, -0.023, -0.0275], [0.0465, 0.023, -0.019], 0.002);
    let chimney = revolve(&[[0.0065, 0.018], [0.0065, 0.031], [0.0105, 0.042], [0.0, 0.042]], 14)
        .moved([0.0315, 0.0, 0.0]);
    let dome = revolve(&[[0.0075, 0.018], [0.0075, 0.026], [0.0045, 0.03], [0.0, 0.031]], 12)
        .moved([0.0105, 0.0, 0.0]);
    Mesh::of(&[boiler, cab, roof, frame, chimney, dome])
}

fn train_wheels() -> Mesh {
    let wheel = |x: f64, radius: f64| {
        cylinder(radius, [0.0, 0.006], 0.001, 12).along(Y, [x, 0.0225, radius - 0.0421])
    };
    let wheels = both(&wheel(0.0315, 0.0125).with(&wheel(0.0035, 0.0125)).with(&wheel(-0.0275, 0.0165)));
    let buffer = rounded_box([0.002, 0.023, 0.006], 0.001, 1).moved([0.0465, 0.0, -0.023]);
    wheels.with(&buffer).with(&cylinder(0.012, [0.0455, 0.047], 0.0, 8).along(X, [0.0, 0.0, 0.0012]))
}
