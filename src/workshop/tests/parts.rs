//! Parts are closed, face outwards, and have the volumes of the solids that they stand for.

use robohive_workshop::{
    Mesh, Profile, Station, capsule, cylinder, ellipsoid, extrude, revolve, rounded_box, sweep,
};
use std::f64::consts::PI;

/// Whether a mesh is closed and its volume within `share` of `volume`. Inscribed polygons make round solids smaller.
fn solid(mesh: &Mesh, volume: f64, share: f64) {
    assert!(mesh.is_closed());
    let found = mesh.volume();
    assert!((found / volume - 1.0).abs() < share, "{found} instead of {volume}");
}

#[test]
fn round_shapes_have_their_volumes() {
    solid(&cylinder(0.1, [0.0, 0.3], 0.0, 64), PI * 0.01 * 0.3, 0.01);
    solid(&cylinder(0.1, [0.0, 0.3], 0.01, 64), PI * 0.01 * 0.3, 0.02);
    solid(&ellipsoid([0.1, 0.2, 0.3], 64), 4.0 / 3.0 * PI * 0.006, 0.01);
    let (radius, length) = (0.05, 0.2);
    let volume = PI * radius * radius * (length + 4.0 / 3.0 * radius);
    solid(&capsule(radius, [0.1, 0.0, 0.0], [0.1, 0.2, 0.0], 64), volume, 0.01);
    let [low, high] = capsule(radius, [0.1, 0.0, 0.0], [0.1, 0.2, 0.0], 64).bounds();
    assert!((low[1] + 0.05).abs() < 1e-12 && (high[1] - 0.25).abs() < 1e-12);
}

#[test]
fn a_rounded_box_lies_between_the_box_and_its_core() {
    let mesh = rounded_box([0.1, 0.2, 0.3], 0.02, 4);
    let sharp: f64 = 8.0 * 0.1 * 0.2 * 0.3;
    assert!(mesh.is_closed());
    assert!(mesh.volume() < sharp && mesh.volume() > 0.95 * sharp);
    assert_eq!(
        mesh.bounds().map(|corner| corner.map(|x| (x * 1e9).round() / 1e9)),
        [[-0.1, -0.2, -0.3], [0.1, 0.2, 0.3]]
    );
}

#[test]
fn rounded_boxes_of_any_size_are_closed() {
    let millimetres = |count: i32| 0.001 * f64::from(count);
    for (length, width) in (5..40).flat_map(|length| (5..15).map(move |width| (length, width))) {
        for (radius, steps) in [(2, 1), (3, 1), (4, 2), (5, 3)] {
            let half = [length, width, 16].map(millimetres);
            let mesh = rounded_box(half, millimetres(radius), steps);
            assert!(mesh.is_closed(), "{half:?}, {radius} mm in {steps} steps");
        }
    }
}

#[test]
fn a_hole_goes_through_a_plate() {
    let (outline, hole) = (Profile::rounded_rectangle([0.1, 0.05], 0.02, 8), Profile::circle(0.01, 32));
    let holes = [hole.moved([0.05, 0.0]), hole.moved([-0.05, 0.0])];
    let plate = extrude(&outline, &holes, [0.0, 0.01]);
    solid(&plate, (outline.area() - 2.0 * hole.area()) * 0.01, 1e-12);
}

#[test]
fn outlines_that_are_not_convex_are_filled() {
    let bracket =
        Profile::polygon(&[[0.0, 0.0], [0.0, 0.2], [0.05, 0.2], [0.05, 0.05], [0.1, 0.05], [0.1, 0.0]]);
    solid(&extrude(&bracket, &[], [-0.01, 0.01]), bracket.area() * 0.02, 1e-12);
    assert!((bracket.area() - 0.0125).abs() < 1e-12, "{}", bracket.area());
}

#[test]
fn a_ring_has_the_volume_of_pappus() {
    let section: Vec<_> = Profile::circle(0.01, 48).moved([0.1, 0.0]).points().to_vec();
    let ring: Vec<_> = section.iter().chain(&section[..1]).copied().collect();
    solid(&revolve(&ring, 96), 2.0 * PI * 0.1 * PI * 1e-4, 0.01);
    let reversed: Vec<_> = ring.into_iter().rev().collect();
    solid(&revolve(&reversed, 96), 2.0 * PI * 0.1 * PI * 1e-4, 0.01);
}

#[test]
fn a_swept_profile_keeps_across_its_path() {
    let bend = |step: i32| {
        let angle = f64::from(step) * PI / 48.0;
        Station { at: [0.1 * angle.cos(), 0.1 * angle.sin(), 0.0], size: [1.0, 1.0] }
    };
    let path: Vec<_> = (0..=24).map(bend).collect();
    let section = Profile::rounded_rectangle([0.01, 0.005], 0.002, 3);
    solid(&sweep(&section, &path), section.area() * 0.1 * PI / 2.0, 0.01);
}

#[test]
fn mirror_images_and_turns_keep_what_is_inside() {
    let part = extrude(&Profile::link([0.03, 0.02], 0.1, 8), &[], [0.0, 0.01]);
    let volume = part.volume();
    assert!(volume > 0.0);
    for image in [
        part.clone().mirrored(0),
        part.clone().turned([1.0, 2.0, 3.0], 0.7),
        part.clone().along([0.0, 1.0, 0.0], [1.0; 3]),
    ] {
        solid(&image, volume, 1e-9);
    }
    solid(&Mesh::of([&part, &part.clone().mirrored(1)]), 2.0 * volume, 1e-9);
}

#[test]
fn shading_follows_creases() {
    let mesh = cylinder(0.1, [0.0, 0.3], 0.0, 16);
    let normals = |text: &str| text.lines().filter(|line| line.starts_with("vn")).count();
    // Two lids and sixteen directions round; then every face by itself.
    assert_eq!(normals(&mesh.to_obj(0.6)), 18);
    assert_eq!(mesh.to_obj(0.6).lines().filter(|line| line.starts_with("f ")).count(), 16 * 2 + 14 * 2);
    assert_eq!(normals(&mesh.to_obj(3.1)), 32);
}
