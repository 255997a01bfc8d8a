//! What the car and its trailer look like \[m\]: a pick-up truck on a scale of about 1 to 10. The car's frame is on the ground in the
//! middle of its rear axle, forward along x; the trailer's on the ground below its hitch, its axle behind it.

use crate::shape::{block, hull, side};
use workshop::{Mesh, Profile, Vec3, cylinder, extrude, revolve, rounded_box};

const Y: Vec3 = [0.0, 1.0, 0.0];

/// A body of horizontal sections: height, its ends along x, half its width.
fn tower(sections: &[[f64; 4]], exponent: f64) -> Mesh {
    let section =
        |[z, rear, front, width]: &[f64; 4]| [*z, (front - rear) / 2.0, *width, (front + rear) / 2.0, 0.0];
    hull(2, &sections.iter().map(section).collect::<Vec<_>>(), exponent, 32)
}

/// The painted body: a side with arches over the wheels, the pillars and roof of the cab, and the walls of the bed.
pub(super) fn body() -> Mesh {
    let arch = |middle: f64| {
        (0..=6).map(move |step| {
            let (sine, cosine) = workshop::sincos(std::f64::consts::PI * f64::from(step) / 6.0);
            [middle - 0.043 * cosine, 0.038 + 0.043 * sine]
        })
    };
    let mut outline = vec![[-0.095, 0.03], [-0.045, 0.03]];
    outline.extend(arch(0.0));
    outline.extend([[0.045, 0.028], [0.215, 0.028]]);
    outline.extend(arch(0.26));
    outline.extend([
        [0.305, 0.03],
        [0.335, 0.032],
        [0.338, 0.06],
        [0.33, 0.086],
        [0.235, 0.098],
        [-0.095, 0.098],
    ]);
    let flank = Profile::polygon(&outline);
    let panel = |low: f64, high: f64| side(&flank, [low, high]);
    let floor = block([-0.093, -0.072, 0.05], [0.235, 0.072, 0.066], 0.003);
    let bonnet = tower(
        &[
            [0.05, 0.2, 0.336, 0.078],
            [0.07, 0.2, 0.338, 0.08],
            [0.088, 0.2, 0.328, 0.078],
            [0.097, 0.21, 0.3, 0.07],
        ],
        8.0,
    );
    let tailgate = block([-0.098, -0.08, 0.05], [-0.09, 0.08, 0.098], 0.002);
    let wall = block([0.062, -0.08, 0.05], [0.072, 0.08, 0.105], 0.002);
    let roof = tower(&[[0.148, 0.085, 0.178, 0.064], [0.154, 0.09, 0.17, 0.06]], 8.0);
    let pillars = [-1.0, 1.0].map(|sign: f64| {
        let post = |from: f64, to: f64| {
            let foot = [[from, 0.095], [from + 0.008, 0.095], [to + 0.006, 0.15], [to, 0.15]];
            let [a, b] = [sign * 0.0655, sign * 0.0715];
            side(&Profile::polygon(&foot), [a.min(b), a.max(b)])
        };
        post(0.072, 0.084).with(&post(0.138, 0.134)).with(&post(0.212, 0.172))
    });
    let housings = [-1.0, 1.0].map(|sign: f64| {
        let [a, b] = [sign * 0.056, sign * 0.074];
        block([-0.046, a.min(b), 0.06], [0.046, a.max(b), 0.084], 0.003)
    });
    let parts = [panel(0.073, 0.083), panel(-0.083, -0.073), floor, bonnet, tailgate, wall, roof];
    Mesh::of(parts.iter().chain(&pillars).chain(&housings))
}

/// The glass of the cab.
pub(super) fn glass() -> Mesh {
    tower(&[[0.09, 0.073, 0.218, 0.072], [0.15, 0.086, 0.175, 0.063]], 8.0)
}

/// Bumpers, frame, mirrors and the ball of the hitch.
pub(super) fn trim() -> Mesh {
    let frame = block([-0.09, -0.045, 0.034], [0.31, 0.045, 0.052], 0.004);
    let front = block([0.326, -0.076, 0.03], [0.345, 0.076, 0.048], 0.006);
    let rear = block([-0.104, -0.07, 0.034], [-0.092, 0.07, 0.05], 0.004);
    let grille = block([0.33, -0.045, 0.055], [0.3405, 0.045, 0.08], 0.003);
    let ball = block([-0.122, -0.008, 0.036], [-0.1, 0.008, 0.042], 0.002);
    let knob = workshop::ellipsoid([0.006; 3], 10).moved([-0.12, 0.0, 0.047]);
    let mirrors = [-1.0, 1.0]
        .map(|sign: f64| rounded_box([0.004, 0.009, 0.007], 0.002, 1).moved([0.2, sign * 0.085, 0.108]));
    let axles = [0.0, 0.26].map(|x| cylinder(0.006, [-0.08, 0.08], 0.0, 10).along(Y, [x, 0.0, 0.035]));
    Mesh::of(&[frame, front, rear, grille, ball, knob]).with(&Mesh::of(mirrors.iter().chain(&axles)))
}

/// Headlamps.
pub(super) fn lamps() -> Mesh {
    let lamp = |y: f64| rounded_box([0.004, 0.011, 0.008], 0.003, 2).moved([0.3365, y, 0.07]);
    lamp(0.062).with(&lamp(-0.062))
}

/// A tyre about y, 70 mm high, 26 mm wide.
pub(super) fn tyre() -> Mesh {
    let line = [
        [0.0, -0.0115],
        [0.03, -0.013],
        [0.035, -0.004],
        [0.035, 0.004],
        [0.03, 0.013],
        [0.0215, 0.0115],
        [0.0215, 0.0],
        [0.0, 0.0],
    ];
    revolve(&line, 20).along(Y, [0.0; 3])
}

/// A rim with five spokes.
pub(super) fn rim() -> Mesh {
    let line =
        [[0.0, -0.001], [0.0222, -0.001], [0.0222, 0.0113], [0.0195, 0.0113], [0.0188, 0.002], [0.0, 0.002]];
    let ring = revolve(&line, 16);
    let spokes = (0..5).map(|spoke| {
        let turn = std::f64::consts::TAU * f64::from(spoke) / 5.0;
        extrude(&Profile::rounded_rectangle([0.0085, 0.0035], 0.0, 1), &[], [-0.003, 0.003])
            .moved([0.0115, 0.0, 0.006])
            .turned([0.0, 0.0, 1.0], turn)
    });
    let hub = cylinder(0.006, [0.0, 0.0105], 0.0, 8);
    let spokes: Vec<Mesh> = spokes.collect();
    ring.with(&Mesh::of(&spokes)).with(&hub).along(Y, [0.0; 3])
}

/// The open box of the trailer.
pub(super) fn trailer() -> Mesh {
    let floor = block([-0.34, -0.073, 0.05], [-0.1, 0.073, 0.058], 0.002);
    let sides = [-1.0, 1.0].map(|sign: f64| {
        let [a, b] = [sign * 0.068, sign * 0.074];
        block([-0.34, a.min(b), 0.05], [-0.1, a.max(b), 0.1], 0.002)
    });
    let ends = [-0.34, -0.106].map(|x| block([x, -0.073, 0.05], [x + 0.006, 0.073, 0.1], 0.002));
    let guards = [-1.0, 1.0].map(|sign: f64| {
        block([-0.262, sign * 0.09 - 0.014, 0.073], [-0.178, sign * 0.09 + 0.014, 0.079], 0.003)
    });
    Mesh::of(sides.iter().chain(&ends).chain(&guards)).with(&floor)
}

/// The drawbar from the hitch to the box, and the axle.
pub(super) fn drawbar() -> Mesh {
    let bar = block([-0.115, -0.006, 0.043], [0.004, 0.006, 0.052], 0.002);
    let arms = [-1.0, 1.0].map(|sign: f64| {
        let outline = Profile::polygon(&[
            [-0.05, 0.0],
            [-0.05, sign * 0.006],
            [-0.16, sign * 0.062],
            [-0.16, sign * 0.05],
        ]);
        extrude(&outline, &[], [0.043, 0.051])
    });
    let cup = cylinder(0.01, [0.043, 0.056], 0.003, 12);
    let axle = cylinder(0.005, [-0.08, 0.08], 0.0, 10).along(Y, [-0.22, 0.0, 0.035]);
    let beam = block([-0.33, -0.03, 0.042], [-0.11, 0.03, 0.051], 0.002);
    Mesh::of(&arms).with(&Mesh::of(&[bar, cup, axle, beam]))
}
