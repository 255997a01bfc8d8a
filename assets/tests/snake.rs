//! The snake swims by a travelling wave. The numbers of the README are printed by `-- --nocapture`.

mod measure;

use measure::{drift, own, run};
use physics::{Data, Model};
use std::f64::consts::TAU;

/// Joints.
const JOINTS: usize = 12;
/// Its length, from the snout to the fin \[m\].
const LENGTH: f64 = 0.041 + 12.0 * 0.08 + 0.098;

/// Swims for some periods of a second with waves of an amplitude \[rad\] that travel towards the tail (or the head, where `waves` is
/// negative), `waves` of them along the body, about a bend \[rad\] of each joint. Returns how far the snake comes \[m\], the way that it looked at
/// first, to the left of it, and how far it turns \[rad\].
fn swim(m: &Model, periods: f64, amplitude: f64, waves: f64, bend: f64) -> [f64; 3] {
    let mut d = Data::new(m);
    let middle = |d: &Data| *d.body(m.body("head").unwrap()).subtree_com();
    physics::forward(m, &mut d).unwrap();
    let start = middle(&d);
    run(m, &mut d, periods, |d| {
        let ramp = d.time().min(1.0);
        for joint in 0..JOINTS {
            let phase = TAU * (d.time() - waves * joint as f64 / JOINTS as f64);
            d.state.ctrl[joint] = ramp * (amplitude * phase.sin() + bend);
        }
    });
    let end = middle(&d);
    [end[0] - start[0], end[1] - start[1], d.state.qpos[2]]
}

#[test]
fn it_has_its_mass_and_length() {
    let m = own("snake/scene.xml");
    assert!((m.body_subtreemass[0] - 2.12).abs() < 1e-9, "{}", m.body_subtreemass[0]);
    let mut d = Data::new(&m);
    physics::forward(&m, &mut d).unwrap();
    let along = |site: &str| d.site(m.site(site).unwrap()).xpos()[0];
    assert!((along("head") + 0.001 - along("tail") - LENGTH).abs() < 1e-9);
}

#[test]
fn it_rests_where_nothing_moves_it() {
    assert!(drift("snake/scene.xml", &[0.0; JOINTS], 3) < 1e-9);
}

#[test]
fn a_travelling_wave_moves_it_and_its_direction_decides_where() {
    let m = own("snake/scene.xml");
    let forward = swim(&m, 11.0, 0.4, 1.0, 0.0);
    let back = swim(&m, 11.0, 0.4, -1.0, 0.0);
    let standing = swim(&m, 11.0, 0.4, 0.0, 0.0);
    println!("{forward:.3?} m with waves to the tail, {back:.3?} to the head, {standing:.3?} standing");
    assert!(forward[0] > 2.0 * LENGTH && forward[1].abs() < 0.3);
    assert!(back[0] < -LENGTH);
    assert!(standing[0].abs() < 0.3 * forward[0]);
}

#[test]
fn a_bend_turns_it() {
    let m = own("snake/scene.xml");
    let (left, right) = (swim(&m, 8.0, 0.4, 1.0, -0.08), swim(&m, 8.0, 0.4, 1.0, 0.08));
    println!("turned by {:.3} rad, {:.3} rad", left[2], right[2]);
    assert!(left[2] * right[2] < 0.0 && left[2].abs() > 0.5);
}
