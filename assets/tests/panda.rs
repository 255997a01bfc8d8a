//! The Panda stands where the maker's parameters say, keeps still, follows, and holds what it grips. The numbers of the README are printed by
//! `-- --nocapture`.

mod measure;

use measure::{drift, posed, run, stand, sweep, track};
use physics::math::{Vec3, add, distance, mul_mat_vec};
use physics::{Data, forward};
use std::f64::consts::FRAC_PI_2;

/// Links in the order of the joints, then the flange: length along x and along z \[m\] and twist about x \[rad\] of the modified
/// Denavit-Hartenberg parameters (Franka Control Interface documentation, "Robot and interface specifications").
const PARAMETERS: [[f64; 3]; 8] = [
    [0.0, 0.333, 0.0],
    [0.0, 0.0, -FRAC_PI_2],
    [0.0, 0.316, FRAC_PI_2],
    [0.0825, 0.0, FRAC_PI_2],
    [-0.0825, 0.384, -FRAC_PI_2],
    [0.0, 0.0, FRAC_PI_2],
    [0.088, 0.0, FRAC_PI_2],
    [0.0, 0.107, 0.0],
];
/// A pose in the middle of the table \[rad\], the fingers half open \[m\].
const READY: [f64; 9] = [0.0, -0.3, 0.0, -2.0, 0.0, 1.8, 0.785, 0.02, 0.02];

/// Where the parameters put the flange, in the frame of the base.
fn flange(angles: &[f64]) -> Vec3 {
    let mut place = [0.0; 3];
    for (link, [a, d, twist]) in PARAMETERS.iter().enumerate().rev() {
        let angle = angles.get(link).copied().unwrap_or(0.0);
        let (s, c) = angle.sin_cos();
        let turned = mul_mat_vec(&[c, -s, 0.0, s, c, 0.0, 0.0, 0.0, 1.0], place);
        let (s, c) = twist.sin_cos();
        let tilted = mul_mat_vec(&[1.0, 0.0, 0.0, 0.0, c, -s, 0.0, s, c], add(turned, [0.0, 0.0, *d]));
        place = add(tilted, [*a, 0.0, 0.0]);
    }
    place
}

#[test]
fn its_flange_is_where_the_makers_parameters_put_it() {
    let m = stand("panda/robot.xml", "link0", "", "");
    let mut d = Data::new(&m);
    for pose in 0..20 {
        for joint in 0..7 {
            let [low, high] = m.jnt_range[joint];
            let share = f64::from((pose * 7 + joint as i32 * 3) % 20) / 19.0;
            d.state.qpos[joint] = low + share * (high - low);
        }
        forward(&m, &mut d).unwrap();
        let hand = *d.body(m.body("hand").unwrap()).xpos();
        let off = distance(hand, add(flange(&d.state.qpos[..7]), [0.0, 0.0, 1.0]));
        assert!(off < 1e-12, "pose {pose}: off by {off:e} m");
    }
    let mass: f64 = m.body_mass.iter().sum();
    println!("mass {mass:.3} kg");
    // Links as identified by Gaz et al. (2019), and the hand with its fingers.
    assert!((mass - 16.691 - 0.76).abs() < 1e-3, "{mass}");
}

#[test]
fn it_holds_its_pose_for_ten_seconds() {
    let off = drift("panda/scene.xml", &READY, 0);
    assert!(off < 2e-3, "{off}");
}

#[test]
fn every_joint_moves_through_its_range_and_follows_a_sine() {
    let m = stand("panda/robot.xml", "link0", "timestep='0.002'", "");
    let (short, joint) = sweep(&m, &READY);
    println!("short by {short:.4} of its range (joint {joint})");
    assert!(short < 0.01, "{short}, joint {joint}");
    let (off, slowest) = track(&m, &READY);
    println!("sine off by {off:.3} of its amplitude (joint {slowest})");
    assert!(off < 0.3, "{off}, joint {slowest}");
}

#[test]
fn fingers_hold_a_cube_of_a_kilogram() {
    let m = stand(
        "panda/robot.xml",
        "link0",
        "timestep='0.002' cone='elliptic' impratio='10'",
        "<body name='cube'><freejoint/><geom type='box' size='.02 .02 .02' mass='1' condim='4' friction='1'/></body>",
    );
    let mut d = posed(&m, &READY);
    forward(&m, &mut d).unwrap();
    let tip = m.site("end_effector").unwrap();
    let (place, turn) = (*d.site(tip).xpos(), *d.body(m.body("hand").unwrap()).xquat());
    let start = m.nq - 7;
    d.state.qpos[start..start + 3].copy_from_slice(&place);
    d.state.qpos[start + 3..].copy_from_slice(&turn);
    d.state.ctrl[7..9].copy_from_slice(&[0.0; 2]);
    run(&m, &mut d, 5.0, |_| ());
    let cube = m.body("cube").unwrap();
    let slip = distance(*d.body(cube).xpos(), *d.site(tip).xpos());
    println!("a cube of 1 kg is {:.1} mm from where it was gripped after 5 s", 1e3 * slip);
    assert!(slip < 0.01, "{slip}");
}
