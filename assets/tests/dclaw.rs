//! The D'Claw weighs and does what the robot does. The numbers of the README are printed by `-- --nocapture`.

mod measure;

use measure::{drift, mobility, own, posed, run, slip, stand};

const STRAIGHT: [f64; 9] = [0.0; 9];
/// How ROBEL's valve tasks start.
const OPEN: [f64; 9] = [0.0, -1.05, 1.05, 0.0, -1.05, 1.05, 0.0, -1.05, 1.05];
/// Around a cylinder of 30 mm.
const AROUND: [f64; 9] = [0.0, -0.5, 1.27, 0.0, -0.5, 1.27, 0.0, -0.5, 1.27];

#[test]
fn it_has_the_robots_mass_and_length() {
    let m = own("dclaw/scene.xml");
    let mass: f64 = m.body_mass.iter().sum();
    assert!((mass - 1.115).abs() < 1e-9, "{mass}");
    let mut d = posed(&m, &STRAIGHT);
    physics::forward(&m, &mut d).unwrap();
    for tip in ["FFtip", "MFtip", "THtip"] {
        let [x, y, z] = *d.site(m.site(tip).unwrap()).xpos();
        let around = (x * x + y * y).sqrt();
        assert!((around - 0.06).abs() < 1e-3, "{tip}: {around} m from the middle");
        assert!((0.335 - z - 0.22875).abs() < 1e-9, "{tip}: {z}");
    }
}

#[test]
fn every_joint_moves_through_its_range_and_follows_a_sine() {
    let m = stand("dclaw/robot.xml", "dClaw", "timestep='0.0025' cone='elliptic'", "");
    assert_eq!((m.nv, m.nu), (9, 9));
    let (short, off) = mobility(&m, &OPEN);
    assert!(short < 0.05);
    // Damping of 0.1 N m s/rad against 2 N m/rad lags by 0.05 s: 0.16 of a sine of 0.5 Hz; weight adds to it.
    assert!(off < 0.3);
}

#[test]
fn it_holds_its_pose_for_ten_seconds() {
    let off = drift("dclaw/scene.xml", &OPEN, 0);
    assert!(off < 0.1);
}

#[test]
fn fingers_hold_a_cylinder_of_300_grams_by_friction() {
    let cylinder = "<body name='cylinder' pos='0 0 0.79'><freejoint/>
        <geom type='cylinder' size='0.03 0.05' mass='0.3' condim='4' friction='1'/></body>";
    let m = stand("dclaw/robot.xml", "dClaw", "timestep='0.0025' cone='elliptic' impratio='10'", cylinder);
    let mut d = posed(&m, &AROUND);
    for tip in [2, 5, 8] {
        d.state.ctrl[tip] = 1.57;
    }
    let slip = slip(&m, &mut d, 0.79, 1.0);
    assert!(slip < 0.01, "{slip}");
}

#[test]
fn fingers_sweeping_sideways_turn_the_valve() {
    let m = own("dclaw/tasks/valve.xml");
    let joint = m.joint(m.joint("valve_OBJRx").unwrap()).qpos_range().start;
    let start = 0.5;
    let sideways = |angle: f64| [angle, -0.15, 0.3, angle, -0.15, 0.3, angle, -0.15, 0.3];
    let mut d = posed(&m, &sideways(-0.45));
    d.state.qpos[joint] = start;
    run(&m, &mut d, 3.0, |d| {
        let share = (d.time() / 1.5).min(1.0);
        d.state.ctrl.copy_from_slice(&sideways(-0.45 + 0.93 * share));
    });
    let turned = d.state.qpos[joint] - start;
    println!("one sweep turns the valve by {turned:.3} rad");
    assert!(turned > 1.0);
}
