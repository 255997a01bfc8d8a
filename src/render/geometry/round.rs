//! Shapes of revolution about z with unit radius: spheres, their halves, cylinders, cones.

use super::builder::{Builder, Corner};
use super::surface::{Surface, unit};
use physics::math::ops;
use std::f64::consts::PI;

/// A circle about z on which vertices lie.
#[derive(Clone, Copy)]
struct Ring {
    radius: f32,
    height: f32,
    /// Radial and axial part of the normals.
    normal: [f32; 2],
    /// Second texture coordinate.
    v: f32,
}

/// How texture coordinates follow from the place on a shape.
#[derive(Clone, Copy, PartialEq)]
enum Wrap {
    /// u around the axis, v of the ring.
    Around,
    /// (u, v) from (x, y).
    Flat,
}

/// Turns rings into triangles.
struct Lathe {
    /// Cosine and sine of the slices' edges.
    edges: Vec<[f32; 2]>,
    wrap: Wrap,
    builder: Builder,
}

impl Lathe {
    fn new(slices: usize) -> Self {
        let edges = (0..slices).map(|j| {
            let angle = (2.0 * PI * j as f64 / slices as f64) as f32;
            let (sin, cos) = ops::sincos(f64::from(angle));
            [cos as f32, sin as f32]
        });
        Lathe { edges: edges.collect(), wrap: Wrap::Around, builder: Builder::default() }
    }

    fn slices(&self) -> usize {
        self.edges.len()
    }

    /// The corner at an edge of a slice; the last edge coincides with the first.
    fn corner(&self, ring: Ring, edge: usize) -> Corner {
        let [cos, sin] = self.edges[edge % self.slices()];
        let position = [cos * ring.radius, sin * ring.radius, ring.height];
        let normal = [cos * ring.normal[0], sin * ring.normal[0], ring.normal[1]];
        let texcoord = match self.wrap {
            Wrap::Around => [edge as f32 / self.slices() as f32, ring.v],
            Wrap::Flat => [0.5 + 0.5 * position[0], 0.5 + 0.5 * position[1]],
        };
        Corner { position, normal, texcoord }
    }

    /// Quadrilaterals between two rings; seen from outside, `upper` is above `lower`.
    fn band(&mut self, lower: Ring, upper: Ring) {
        for j in 0..self.slices() {
            let quad = [(lower, j), (lower, j + 1), (upper, j + 1), (upper, j)];
            self.builder.quad(quad.map(|(ring, edge)| self.corner(ring, edge)));
        }
    }

    /// The apex of a fan over one slice: its normal and u lie halfway between the slice's edges.
    fn apex(&self, apex: Ring, edge: usize) -> Corner {
        let (a, b) = (self.corner(apex, edge), self.corner(apex, edge + 1));
        let normal = match apex.normal[0] == 0.0 {
            true => a.normal,
            false => unit([0, 1, 2].map(|i| a.normal[i] + b.normal[i])),
        };
        let texcoord = [0.5 * (a.texcoord[0] + b.texcoord[0]), a.texcoord[1]];
        Corner { position: [0.0, 0.0, apex.height], normal, texcoord }
    }

    /// Triangles from a ring up to the axis.
    fn fan_up(&mut self, rim: Ring, apex: Ring) {
        for j in 0..self.slices() {
            let triangle = [self.corner(rim, j), self.corner(rim, j + 1), self.apex(apex, j)];
            self.builder.triangle(triangle);
        }
    }

    /// Triangles from a ring down to the axis.
    fn fan_down(&mut self, rim: Ring, apex: Ring) {
        for j in 0..self.slices() {
            let triangle = [self.apex(apex, j), self.corner(rim, j + 1), self.corner(rim, j)];
            self.builder.triangle(triangle);
        }
    }

    /// A disk at `height` that faces up.
    fn disk_up(&mut self, height: f32, rings: usize) {
        self.wrap = Wrap::Flat;
        let ring = |i: usize| Ring { radius: i as f32 / rings as f32, height, normal: [0.0, 1.0], v: 0.0 };
        self.fan_up(ring(1), ring(0));
        for i in 1..rings {
            self.band(ring(i + 1), ring(i));
        }
    }

    /// A disk at `height` that faces down.
    fn disk_down(&mut self, height: f32, rings: usize) {
        self.wrap = Wrap::Flat;
        let ring = |i: usize| Ring { radius: i as f32 / rings as f32, height, normal: [0.0, -1.0], v: 0.0 };
        self.fan_down(ring(1), ring(0));
        for i in 1..rings {
            self.band(ring(i), ring(i + 1));
        }
    }

    /// The wall of a cylinder from z = -1 to 1.
    fn wall(&mut self, stacks: usize) {
        self.wrap = Wrap::Around;
        let ring = |i: usize| {
            let height = (2 * i) as f32 / stacks as f32 - 1.0;
            Ring { radius: 1.0, height, normal: [1.0, 0.0], v: (1.0 - height) / 2.0 }
        };
        for i in 0..stacks {
            self.band(ring(i), ring(i + 1));
        }
    }

    /// The rings of half a sphere, from its equator to its pole.
    fn half_rings(side: Side, stacks: usize, shift: f32, v: impl Fn(usize) -> f32) -> Vec<Ring> {
        let sign = side.sign();
        let ring = |i: usize| {
            let elevation = (0.5 * PI * f64::from(sign) * i as f64 / stacks as f64) as f32;
            let (sin, cos) = ops::sincos(f64::from(elevation));
            let (sin, cos) = if i == stacks { (sign, 0.0) } else { (sin as f32, cos as f32) };
            Ring { radius: cos, height: shift + sin, normal: [cos, sin], v: v(i) }
        };
        (0..=stacks).map(ring).collect()
    }

    fn half(&mut self, side: Side, rings: &[Ring]) {
        self.wrap = Wrap::Around;
        let [.., rim, pole] = *rings else { return };
        match side {
            Side::Top => self.fan_up(rim, pole),
            Side::Bottom => self.fan_down(rim, pole),
        }
        for pair in rings[..rings.len() - 1].windows(2) {
            match side {
                Side::Top => self.band(pair[0], pair[1]),
                Side::Bottom => self.band(pair[1], pair[0]),
            }
        }
    }
}

/// One of the halves of a sphere.
#[derive(Clone, Copy)]
pub(super) enum Side {
    Top,
    Bottom,
}

impl Side {
    fn sign(self) -> f32 {
        match self {
            Side::Top => 1.0,
            Side::Bottom => -1.0,
        }
    }
}

/// The unit sphere; `stacks` must be at least 2.
pub(super) fn sphere(slices: usize, stacks: usize) -> Surface {
    let mut lathe = Lathe::new(slices);
    for side in [Side::Bottom, Side::Top] {
        let v = |i: usize| match i == stacks / 2 {
            true => 0.5 - 0.5 * side.sign(),
            false => 0.5 - side.sign() * i as f32 / stacks as f32,
        };
        lathe.half(side, &Lathe::half_rings(side, stacks / 2, 0.0, v));
    }
    lathe.builder.finish()
}

/// Half a unit sphere, moved away from the origin by 1, so that its rim lies at z = 1 or z = -1.
pub(super) fn cap(side: Side, slices: usize, stacks: usize) -> Surface {
    let mut lathe = Lathe::new(slices);
    let v = |i: usize| match side {
        Side::Top => 1.0 - i as f32 / stacks as f32,
        Side::Bottom => i as f32 / stacks as f32,
    };
    lathe.half(side, &Lathe::half_rings(side, stacks, side.sign(), v));
    lathe.builder.finish()
}

/// The wall of a cylinder of radius 1 from z = -1 to 1.
pub(super) fn tube(slices: usize, stacks: usize) -> Surface {
    let mut lathe = Lathe::new(slices);
    lathe.wall(stacks);
    lathe.builder.finish()
}

/// A cylinder of radius 1 from z = -1 to 1; its disks have half as many rings as its wall.
pub(super) fn cylinder(slices: usize, stacks: usize) -> Surface {
    let mut lathe = Lathe::new(slices);
    lathe.disk_down(-1.0, stacks / 2);
    lathe.wall(stacks);
    lathe.disk_up(1.0, stacks / 2);
    lathe.builder.finish()
}

/// A cone with its base of radius 1 at z = 0 and its tip at z = 1.
pub(super) fn cone(slices: usize, stacks: usize) -> Surface {
    let mut lathe = Lathe::new(slices);
    let slope = 1.0 / 2f32.sqrt();
    let ring = |i: usize| {
        let radius = i as f32 / stacks as f32;
        Ring { radius, height: 1.0 - radius, normal: [slope; 2], v: radius }
    };
    lathe.fan_up(ring(1), ring(0));
    for i in 1..stacks {
        lathe.band(ring(i + 1), ring(i));
    }
    lathe.disk_down(0.0, stacks);
    lathe.builder.finish()
}
