//! The own models.

use super::Shot;
use render::scene::SceneOptions;
use std::path::Path;

fn measure(file: &str, camera: &str) -> Option<super::Measures> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../assets").join(file);
    let model = mjcf::load(&path).expect("an own model").model;
    Shot::of(&model, camera, &SceneOptions::default()).measure([160, 120])
}

#[test]
fn a_robot_at_a_table() {
    measure("franka/franka_table.xml", "front").iter().for_each(|found| found.check("franka_table"));
}

#[test]
fn a_humanoid() {
    measure("humanoid/humanoid.xml", "side").iter().for_each(|found| found.check("humanoid"));
}

#[test]
fn a_quadruped() {
    measure("quadruped/quadruped.xml", "track").iter().for_each(|found| found.check("quadruped"));
}

#[test]
fn a_yard() {
    measure("yard/yard.xml", "free").iter().for_each(|found| found.check("yard"));
}

#[test]
fn a_workbench_with_lines() {
    measure("workbench/workbench.xml", "overview").iter().for_each(|found| found.check("workbench"));
}

#[test]
fn tendons() {
    measure("elbow/elbow.xml", "free").iter().for_each(|found| found.check("elbow"));
}

/// Walls of the bin share the upper sides of its corners, where rounding decides which is seen.
#[test]
fn a_pile_in_a_bin() {
    let Some(found) = measure("pile/pile.xml", "free") else { return };
    assert!(
        found.psnr >= 45.0 && found.other < 100 && found.other_inside < 20 && found.depth < 1e-4,
        "{found:?}"
    );
}
