//! Updates of a scene allocate nothing once the lists have grown.

use physics::{Data, step};
use robohive_render::scene::{Camera, Scene, SceneOptions, Show};
use stats_alloc::{INSTRUMENTED_SYSTEM, Region, StatsAlloc};
use std::alloc::System;

#[global_allocator]
static HEAP: &StatsAlloc<System> = &INSTRUMENTED_SYSTEM;

const WORLD: &str = "<mujoco>
    <asset><texture type='skybox' builtin='flat' width='2' height='12'/></asset>
    <worldbody><light pos='0 0 3'/><geom type='plane' size='0 0 .1'/><site name='a' pos='0 0 1'/>
        <body pos='.5 0 .1'><freejoint/><geom type='box' size='.1 .1 .1'/><site name='b'/></body>
    </worldbody>
    <tendon><spatial limited='true' range='0 2'><site site='a'/><site site='b'/></spatial></tendon>
</mujoco>";

/// Geoms and sites, the stretches of a slack tendon, an inertia, a joint, four contacts with their forces.
const ITEMS: usize = 4 + 28 + 1 + 1 + 2 * 4;

#[test]
fn later_updates_do_not_allocate() {
    let model = robohive_mjcf::load_str(WORLD).unwrap().model;
    let mut data = Data::new(&model);
    let mut scene = Scene::new();
    let decorated =
        Show { joints: true, contact_points: true, contact_forces: true, inertias: true, ..Show::default() };
    let options = SceneOptions::default().with_show(decorated);
    let mut update = |data: &Data| {
        let view = Camera::free(&model).view(&model, data).unwrap();
        scene.update(&model, data, view, &options).unwrap();
        scene.items.len()
    };
    (0..200).for_each(|_| step(&model, &mut data).unwrap());
    assert_eq!(update(&data), ITEMS);
    step(&model, &mut data).unwrap();
    let region = Region::new(HEAP);
    assert_eq!(update(&data), ITEMS);
    assert_eq!(region.change().allocations + region.change().reallocations, 0);
}
