//! The classical mechanisms beside the numbers that their README names.

use physics::{Data, Model, step};

fn load(task: &str) -> Model {
    let file = format!("classical/tasks/{task}.xml");
    mjcf::Loader::default().files(robohive_assets::Own).load(file).unwrap().model
}

/// Mass of everything that moves \[kg\].
fn mass(m: &Model) -> f64 {
    m.body_mass.iter().sum()
}

#[test]
fn masses_are_those_published() {
    assert!((mass(&load("acrobot")) - 2.0).abs() < 1e-12);
    assert!((mass(&load("double_pole")) - 1.11).abs() < 1e-12);
    assert!((mass(&load("furuta")) - 0.119).abs() < 1e-12);
}

/// A slender rod of 0.129 m swings in 2 pi sqrt(2 l / 3 g), and the arm hardly moves when it is heavy.
#[test]
fn the_furuta_pendulum_swings_as_a_slender_rod() {
    let mut m = load("furuta");
    m.edit(|m| m.dof_armature[0] = 1.0).unwrap();
    let mut data = Data::new(&m);
    data.state.qpos[1] = 0.05;
    let mut crossings = Vec::new();
    for _ in 0..2000 {
        let before = data.state.qpos[1];
        step(&m, &mut data).unwrap();
        if before > 0.0 && data.state.qpos[1] <= 0.0 {
            crossings.push(data.time());
        }
    }
    let period = (crossings[3] - crossings[0]) / 3.0;
    let published = std::f64::consts::TAU * (2.0_f64 * 0.129 / (3.0 * 9.81)).sqrt();
    assert!((period / published - 1.0).abs() < 0.02, "{period} {published}");
}

/// The ball rolls: along a tilted beam it accelerates less than a point that slides, and more than one that cannot.
#[test]
fn the_ball_rolls_down_the_beam() {
    let m = load("ball_on_beam");
    let mut data = Data::new(&m);
    data.state.ctrl[0] = 0.1;
    while data.time() < 1.0 {
        step(&m, &mut data).unwrap();
    }
    let (fallen, tilted) = (-data.state.qpos[1], data.state.qpos[0]);
    assert!((tilted - 0.1).abs() < 0.01, "{tilted}");
    // Five sevenths of g sin(angle) for a second from rest on the largest circle; less on rails, and less while the beam turns.
    let most = 0.5 * 5.0 / 7.0 * 9.81 * 0.1;
    assert!(fallen > 0.5 * most && fallen < most, "{fallen} {most}");
}
