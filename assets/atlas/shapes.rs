//! What the Atlas-like humanoid looks like, each part in the frame of its body \[m\]: a bulky torso with a pack and bars that guard a small
//! head, thick arms of round drives, and slender shins. Outlines are judged from photographs. Arms are those of the left side, and equal
//! in front and behind, so that half a turn makes them right ones.

use workshop::{Mesh, Profile, Station, Vec3, cylinder, extrude, loft, rounded_box, sweep};

const X: Vec3 = [1.0, 0.0, 0.0];
const Y: Vec3 = [0.0, 1.0, 0.0];

/// A shell about z over sections: height, middle along x, half sizes along x and y.
fn shell(sections: &[(f64, f64, [f64; 2])], exponent: f64, count: usize) -> Mesh {
    let ring = |(z, x, half): &(f64, f64, [f64; 2])| -> Vec<Vec3> {
        let outline = Profile::superellipse(*half, exponent, count);
        outline.points().iter().map(|[a, b]| [x + a, *b, *z]).collect()
    };
    loft(&sections.iter().map(ring).collect::<Vec<_>>())
}

/// A rod between points.
fn rod(radius: f64, path: &[Vec3], count: usize) -> Mesh {
    let stations: Vec<_> = path.iter().map(|at| Station { at: *at, size: [radius; 2] }).collect();
    sweep(&Profile::circle(1.0, count), &stations)
}

/// A round drive about y, from `low` to `high`.
fn drive(radius: f64, [low, high]: [f64; 2]) -> Mesh {
    cylinder(radius, [low, high], 0.0, 10).along(Y, [0.0; 3])
}

/// A box with sharp edges, by its half sizes.
fn block([x, y, z]: Vec3) -> Mesh {
    extrude(&Profile::polygon(&[[x, y], [-x, y], [-x, -y], [x, -y]]), &[], [-z, z])
}

/// A part and its mirror image on the other side of the body.
fn pair(part: &Mesh) -> Mesh {
    part.clone().with(&part.clone().mirrored(1))
}

/// The pelvis, with the housings of the hips.
pub(super) fn hips() -> Mesh {
    let sections = [
        (-0.03, -0.02, [0.06, 0.05]),
        (0.0, -0.02, [0.09, 0.12]),
        (0.06, -0.02, [0.1, 0.14]),
        (0.1, -0.015, [0.075, 0.1]),
    ];
    let hip = cylinder(0.055, [-0.035, 0.05], 0.0, 10).moved([0.0, 0.089, 0.0]);
    shell(&sections, 3.5, 10).with(&pair(&hip))
}

/// The waist between pelvis and chest.
pub(super) fn waist() -> Mesh {
    cylinder(0.07, [0.08, 0.24], 0.0, 8)
}

/// The torso: broad over the shoulders, narrow at the waist, with the pack behind.
pub(super) fn chest() -> Mesh {
    let sections = [
        (-0.005, -0.02, [0.09, 0.1]),
        (0.06, -0.03, [0.13, 0.15]),
        (0.17, -0.03, [0.17, 0.19]),
        (0.33, -0.02, [0.19, 0.215]),
        (0.48, -0.03, [0.18, 0.21]),
        (0.57, -0.05, [0.15, 0.17]),
        (0.6, -0.06, [0.11, 0.12]),
    ];
    let pack = rounded_box([0.09, 0.17, 0.24], 0.03, 1).moved([-0.23, 0.0, 0.36]);
    shell(&sections, 3.2, 14).with(&pack)
}

/// Light plates on the chest, and the blocks that carry the shoulders.
pub(super) fn plates() -> Mesh {
    let breast = rounded_box([0.03, 0.085, 0.11], 0.02, 1).turned(Y, -0.12).moved([0.152, 0.098, 0.38]);
    let belly = rounded_box([0.03, 0.08, 0.055], 0.02, 1).turned(Y, 0.25).moved([0.105, 0.0, 0.15]);
    let shoulder = rounded_box([0.075, 0.05, 0.055], 0.015, 1).moved([0.12, 0.215, 0.53]);
    belly.with(&pair(&breast.with(&shoulder)))
}

/// The bars that guard the head, and handles on the pack.
pub(super) fn cage() -> Mesh {
    let bar = [
        [0.11, 0.15, 0.57],
        [0.17, 0.14, 0.69],
        [0.14, 0.12, 0.765],
        [0.02, 0.11, 0.775],
        [-0.14, 0.12, 0.71],
        [-0.2, 0.13, 0.58],
    ];
    let across = rod(0.013, &[[0.02, -0.115, 0.775], [0.02, 0.115, 0.775]], 5);
    let neck = block([0.05, 0.05, 0.05]).moved([0.16, 0.0, 0.6]);
    Mesh::of(&[pair(&rod(0.014, &bar, 5)), across, neck])
}

/// The lamp on the chest.
pub(super) fn lamp() -> Mesh {
    let outline = Profile::circle(0.042, 12);
    let ring = extrude(&outline, &[outline.inset(0.011)], [0.0, 0.02]);
    ring.mapped(|[y, z, x]| [x, y, z]).moved([0.176, 0.0, 0.33])
}

/// The head: a box of stereo cameras on a yoke.
pub(super) fn head() -> Mesh {
    let case = rounded_box([0.05, 0.085, 0.035], 0.012, 1).moved([-0.02, 0.0, 0.045]);
    let yoke = block([0.035, 0.055, 0.02]).moved([-0.07, 0.0, 0.0]);
    let eye = |y: f64| cylinder(0.022, [0.0, 0.012], 0.0, 8).along(X, [0.028, y, 0.045]);
    Mesh::of(&[case, yoke, eye(0.05), eye(-0.05)])
}

/// The spinning laser scanner on the head.
pub(super) fn lidar() -> Mesh {
    cylinder(0.045, [-0.02, 0.03], 0.0, 10).along(X, [-0.045, 0.0, 0.1])
}

/// The drive of the shoulder about z, which hangs from the chest's block.
pub(super) fn clav() -> Mesh {
    let drum = cylinder(0.058, [-0.19, 0.03], 0.0, 10);
    let arm = rounded_box([0.045, 0.06, 0.05], 0.015, 1).moved([0.0, 0.045, -0.235]);
    drum.with(&arm)
}

/// The drive of the shoulder about x, and the first part of the upper arm.
pub(super) fn scap() -> Mesh {
    let drum = cylinder(0.066, [-0.07, 0.07], 0.0, 12).along(X, [0.0; 3]);
    drum.with(&drive(0.058, [0.04, 0.172]).moved([0.0, 0.0, -0.012]))
}

/// The second part of the upper arm.
pub(super) fn uarm() -> Mesh {
    drive(0.055, [0.0, 0.075])
}

/// A dark ring where one drive turns in another.
pub(super) fn bands() -> Mesh {
    cylinder(0.05, [-0.018, 0.004], 0.0, 8).along(Y, [0.0; 3])
}

/// The elbow's drive about x.
pub(super) fn elbow() -> Mesh {
    cylinder(0.054, [-0.062, 0.062], 0.0, 10).along(X, [0.0; 3])
}

/// The forearm.
pub(super) fn farm() -> Mesh {
    let path = [
        ([0.0, 0.02, 0.0], [0.042, 0.042]),
        ([0.0, 0.06, 0.0], [0.052, 0.05]),
        ([0.0, 0.15, -0.003], [0.055, 0.052]),
        ([0.0, 0.24, -0.006], [0.046, 0.044]),
        ([0.0, 0.282, -0.009], [0.044, 0.042]),
    ];
    let stations: Vec<_> = path.iter().map(|(at, size)| Station { at: *at, size: *size }).collect();
    sweep(&Profile::superellipse([1.0, 1.0], 2.6, 10), &stations)
}

/// The wrist's drive about x.
pub(super) fn wrist() -> Mesh {
    cylinder(0.038, [-0.05, 0.05], 0.0, 8).along(X, [0.0; 3])
}

/// The hand: a palm and three blunt fingers.
pub(super) fn fist() -> Mesh {
    let palm = rounded_box([0.036, 0.035, 0.04], 0.01, 1).moved([0.0, 0.07, 0.0]);
    let finger = |x: f64, z: f64| block([0.012, 0.032, 0.012]).moved([x, 0.132, z]);
    Mesh::of(&[palm, finger(0.0, 0.026), finger(0.02, -0.022), finger(-0.02, -0.022)])
}

/// The hip's drive about x.
pub(super) fn glut() -> Mesh {
    cylinder(0.045, [-0.07, 0.07], 0.0, 10).along(X, [0.0, 0.0, -0.02])
}

/// The thigh's shell, round at the hip and narrow at the knee.
pub(super) fn thigh() -> Mesh {
    let sections = [
        (-0.36, -0.046, [0.048, 0.045]),
        (-0.29, -0.03, [0.06, 0.056]),
        (-0.16, -0.006, [0.083, 0.074]),
        (-0.05, 0.0, [0.08, 0.072]),
        (0.01, 0.0, [0.058, 0.06]),
        (0.04, 0.0, [0.03, 0.045]),
    ];
    shell(&sections, 2.8, 10)
}

/// The hydraulic cylinder behind a thigh, and the axes of hip and knee.
pub(super) fn struts() -> Mesh {
    let cylinder_of = rod(0.02, &[[-0.085, 0.0, -0.06], [-0.1, 0.0, -0.33]], 8);
    let hip = cylinder(0.04, [-0.078, 0.078], 0.0, 10).along(Y, [0.0; 3]);
    cylinder_of.with(&hip)
}

/// The shin's shell.
pub(super) fn shin() -> Mesh {
    let sections = [
        (-0.4, 0.0, [0.03, 0.034]),
        (-0.34, 0.0, [0.036, 0.038]),
        (-0.2, 0.004, [0.052, 0.05]),
        (-0.09, 0.006, [0.06, 0.056]),
        (-0.03, 0.004, [0.04, 0.046]),
    ];
    shell(&sections, 2.8, 10)
}

/// The axes of knee and ankle, and the rod behind the shin.
pub(super) fn knee() -> Mesh {
    let axis =
        |radius: f64, half: f64, z: f64| cylinder(radius, [-half, half], 0.0, 8).along(Y, [0.0, 0.0, z]);
    let rod = rod(0.013, &[[-0.055, 0.0, -0.1], [-0.05, 0.0, -0.4]], 6);
    Mesh::of(&[axis(0.05, 0.06, 0.0), axis(0.032, 0.046, -0.422), rod])
}

/// The foot.
pub(super) fn foot() -> Mesh {
    let sections = [
        (-0.068, 0.0426, [0.128, 0.062]),
        (-0.052, 0.0426, [0.126, 0.06]),
        (-0.03, 0.012, [0.07, 0.045]),
        (0.01, 0.0, [0.035, 0.032]),
    ];
    shell(&sections, 5.0, 10)
}

/// The sole.
pub(super) fn sole() -> Mesh {
    extrude(&Profile::rounded_rectangle([0.1302, 0.0643], 0.015, 1), &[], [-0.0765, -0.0655])
        .moved([0.0426, 0.0, 0.0])
}
