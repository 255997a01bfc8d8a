//! Bolt and nut, with one thread.

use super::{Field, fields, intersection, length, subtraction, union};
use crate::math::{Vec3, ops};
use std::f64::consts::PI;

fields! {
    /// `mujoco.sdf.bolt`: a hexagonal head on a threaded shaft along negative z.
    Bolt = "mujoco.sdf.bolt" { radius = 0.26, } Screw;
    /// `mujoco.sdf.nut`: the hexagonal head with a threaded hole.
    Nut = "mujoco.sdf.nut" { radius = 0.26, } Hole;
}

/// Turns of the thread per metre.
const TURNS: f64 = 12.0;

/// What bolt and nut have in common.
struct Shape {
    /// Distance from the cylinder of the radius.
    from_cylinder: f64,
    /// Distance from the thread.
    thread: f64,
    /// Distance from the cone that cuts its end.
    cone: f64,
    /// Sine and cosine of 45 degrees.
    diagonal: f64,
}

impl Shape {
    fn at([x, y, z]: Vec3, radius: f64) -> Self {
        let from_cylinder = length(x, y) - radius;
        let diagonal = 2.0_f64.sqrt() / 2.0;
        let turn = z * TURNS - ops::angle(y, x) / PI / 2.0;
        let wave = (turn - turn.floor() - 0.5).abs();
        Shape {
            from_cylinder,
            thread: (from_cylinder - wave / TURNS) * diagonal,
            cone: (z - from_cylinder) * diagonal,
            diagonal,
        }
    }

    /// Distance from the head: a hexagon with a rounded top.
    fn head(&self, [x, y, z]: Vec3) -> f64 {
        let sides = 6.0 / PI / 2.0;
        let angle = -(ops::angle(y, x) * sides + 0.5).floor() / sides;
        let (sin, cos) = (ops::sin(angle), ops::sin(angle + PI * 0.5));
        let across = cos * x + -sin * y;
        let flats = intersection(across - 0.5, (z + 0.25).abs() - 0.25);
        intersection(flats, (z + self.from_cylinder - 0.22) * self.diagonal)
    }
}

/// A box around both.
const BOUNDS: [f64; 6] = [0.0, 0.0, 0.0, 0.6, 0.6, 1.0];

#[derive(Debug)]
struct Screw {
    radius: f64,
}

impl Field for Screw {
    fn distance(&self, point: Vec3) -> f64 {
        let shape = Shape::at(point, self.radius);
        let shaft = subtraction(shape.thread, 0.5 - (point[2] + 0.5).abs());
        let shaft = subtraction(shaft, shape.cone + shape.diagonal);
        union(shaft, shape.head(point))
    }

    fn bounds(&self) -> [f64; 6] {
        BOUNDS
    }
}

#[derive(Debug)]
struct Hole {
    radius: f64,
}

impl Field for Hole {
    fn distance(&self, point: Vec3) -> f64 {
        let shape = Shape::at(point, self.radius);
        let hole = subtraction(shape.thread, shape.cone + 0.5 * shape.diagonal);
        let hole = union(hole, -shape.cone - 0.05 * shape.diagonal);
        subtraction(shape.head(point), hole)
    }

    fn bounds(&self) -> [f64; 6] {
        BOUNDS
    }
}
