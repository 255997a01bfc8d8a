//! The car drives where it is steered, and its trailer follows. The numbers of the README are printed by `-- --nocapture`.

mod measure;

use measure::{own, run};
use physics::{Data, Model};

/// From the rear axle to the front axle, and from the trailer's hitch to its axle \[m\].
const WHEELBASE: f64 = 0.26;
const DRAWBAR: f64 = 0.22;
/// Between the wheels of an axle \[m\].
const TRACK: f64 = 0.17;
/// From the rear axle back to the hitch \[m\].
const OVERHANG: f64 = 0.12;

/// Where the middle of the rear axle is on the ground \[m\].
fn place(m: &Model, d: &Data) -> [f64; 2] {
    let [x, y, _] = *d.site(m.site("car").unwrap()).xpos();
    [x, y]
}

/// Drives from rest at a speed \[m/s\] round circles of a radius \[m\]: its state after some seconds.
fn drive(m: &Model, speed: f64, radius: f64, seconds: f64, seen: impl FnMut(&mut Data)) -> Data {
    let mut d = Data::new(m);
    let [left, right] = [-0.5, 0.5].map(|side| (WHEELBASE / (radius + side * TRACK)).atan());
    d.state.ctrl.copy_from_slice(&[speed, (left + right) / 2.0]);
    run(m, &mut d, seconds, seen);
    d
}

#[test]
fn it_weighs_what_its_parts_do_and_stands_still() {
    let m = own("car/scene.xml");
    let mass = m.body_subtreemass[m.body("car").unwrap().index()];
    assert!((mass - 2.63).abs() < 1e-9, "{mass}");
    let mut d = Data::new(&m);
    let mut moved = 0.0_f64;
    run(&m, &mut d, 5.0, |d| {
        moved = moved.max(place(&m, d).into_iter().fold(0.0, |far, x| far.max(x.abs())))
    });
    println!("{mass} kg, moved by {:.3} mm in 5 s", moved * 1e3);
    assert!(moved < 1e-3);
}

#[test]
fn it_drives_the_circle_that_it_is_steered_on() {
    let m = own("car/scene.xml");
    for (speed, radius) in [(0.5, 0.8_f64), (0.5, -0.6), (1.0, 1.5)] {
        let mut path = Vec::new();
        let turn = std::f64::consts::TAU * radius.abs() / speed;
        let d = drive(&m, speed, radius, 2.0 + turn, |d| {
            if d.time() > 1.0 {
                path.push(place(&m, d));
            }
        });
        let found = circle(&path);
        let (off, slow) = (found / radius.abs() - 1.0, d.state.qvel[0].hypot(d.state.qvel[1]) / speed - 1.0);
        println!("{speed} m/s, {radius} m: radius off by {off:.4}, speed by {slow:.4}");
        assert!(off.abs() < 0.02 && slow.abs() < 0.02);
    }
}

/// Radius of the circle through three places of a path.
fn circle(path: &[[f64; 2]]) -> f64 {
    let [a, b, c] = [path[0], path[path.len() / 3], path[path.len() * 2 / 3]];
    let square = |p: [f64; 2]| p[0] * p[0] + p[1] * p[1];
    let double = 2.0 * (a[0] * (b[1] - c[1]) + b[0] * (c[1] - a[1]) + c[0] * (a[1] - b[1]));
    let x = (square(a) * (b[1] - c[1]) + square(b) * (c[1] - a[1]) + square(c) * (a[1] - b[1])) / double;
    let y = (square(a) * (c[0] - b[0]) + square(b) * (a[0] - c[0]) + square(c) * (b[0] - a[0])) / double;
    (a[0] - x).hypot(a[1] - y)
}

#[test]
fn its_trailer_follows_the_circle() {
    let m = own("car/scene.xml");
    let radius = 0.8_f64;
    let d = drive(&m, 0.5, radius, 15.0, |_| ());
    let angle = d.state.qpos[m.jnt_qposadr[m.joint("hitch").unwrap().index()] as usize];
    // All axles point to the middle of the circle.
    let far = radius.hypot(OVERHANG);
    let expected = -((OVERHANG / radius).atan() + (DRAWBAR / far).asin());
    println!("hitch at {angle:.4} rad, expected {expected:.4}");
    assert!((angle - expected).abs() < 0.02, "{angle} {expected}");
}

#[test]
fn a_trailer_folds_behind_a_car_that_backs_up() {
    let m = own("car/scene.xml");
    let hitch = m.jnt_qposadr[m.joint("hitch").unwrap().index()] as usize;
    let mut d = Data::new(&m);
    d.state.qpos[hitch] = 0.05;
    d.state.ctrl[0] = -0.3;
    run(&m, &mut d, 4.0, |_| ());
    println!("hitch from 0.05 to {:.3} rad in 4 s backwards", d.state.qpos[hitch]);
    assert!(d.state.qpos[hitch] > 0.3);
}
