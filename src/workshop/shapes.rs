//! Shapes that machines consist of.

use crate::{Mesh, Profile, Vec3, lofts};
use physics::math::ops::sincos;
use physics::math::{dot, sub};
use std::f64::consts::{FRAC_PI_2, PI};

/// A box by its half sizes, every edge an arc of `radius` in `steps` pieces, its centre at the origin.
pub fn rounded_box(half: Vec3, radius: f64, steps: usize) -> Mesh {
    let radius = half.into_iter().fold(radius, f64::min);
    let section = |sign: f64, step: usize| {
        // Exact at the end, where the corners of the flat face are points.
        let (sine, cosine) =
            if step == steps { (1.0, 0.0) } else { sincos(FRAC_PI_2 * step as f64 / steps as f64) };
        let inset = radius * (1.0 - cosine);
        let outline = Profile::rounded_rectangle([half[0] - inset, half[1] - inset], radius - inset, steps);
        let height = sign * (half[2] - radius + radius * sine);
        outline.points().iter().map(|[x, y]| [*x, *y, height]).collect::<Vec<_>>()
    };
    let below = (0..=steps).rev().map(|step| section(-1.0, step));
    let above = (0..=steps).map(|step| section(1.0, step));
    lofts::loft(&below.chain(above).collect::<Vec<_>>())
}

/// A cylinder about the z axis between two heights, its rims cut at 45 degrees by `bevel`, in `count` steps round.
pub fn cylinder(radius: f64, [low, high]: [f64; 2], bevel: f64, count: usize) -> Mesh {
    let rim = radius - bevel;
    let line = [[rim, low], [radius, low + bevel], [radius, high - bevel], [rim, high]];
    let line = if bevel > 0.0 { &line[..] } else { &line[1..3] };
    lofts::revolve(line, count)
}

/// A capsule between two points, in `count` steps round.
pub fn capsule(radius: f64, from: Vec3, to: Vec3, count: usize) -> Mesh {
    let axis = sub(to, from);
    let length = dot(axis, axis).sqrt();
    let half = count.div_ceil(4);
    let arc = |centre: f64, from: f64| {
        (0..=half).map(move |step| {
            let (sine, cosine) = sincos(from + FRAC_PI_2 * step as f64 / half as f64);
            [radius * cosine.max(0.0), centre + radius * sine]
        })
    };
    let mut line: Vec<_> = arc(0.0, -FRAC_PI_2).chain(arc(length, 0.0)).collect();
    let last = line.len() - 1;
    (line[0][0], line[last][0]) = (0.0, 0.0);
    let direction = if length > 0.0 { axis } else { [0.0, 0.0, 1.0] };
    lofts::revolve(&line, count).along(direction, from)
}

/// An ellipsoid by its half axes, its centre at the origin, in `count` steps round and half as many from pole to pole.
pub fn ellipsoid(half: Vec3, count: usize) -> Mesh {
    let rings = count.div_ceil(2);
    let point = |step: usize| {
        let (sine, cosine) = sincos(PI * step as f64 / rings as f64 - FRAC_PI_2);
        let inside = (1..rings).contains(&step);
        [if inside { cosine } else { 0.0 }, sine]
    };
    lofts::revolve(&(0..=rings).map(point).collect::<Vec<_>>(), count).scaled(half)
}
