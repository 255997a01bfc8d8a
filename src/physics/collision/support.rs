//! Support mappings of convex shapes: the farthest point of a shape in a direction
//! (van den Bergen, Collision Detection in Interactive 3D Environments, section 4.3).

use super::hull::MeshHull;
use super::shape::Shape;
use crate::caches::climb::Farthest;
use crate::math::{Mat3, Vec3, add, add_scaled, dot, mul_mat_t_vec, mul_mat_vec, normalize, scale};
use crate::model::GeomType;
use crate::model::bounds::MINVAL;

const MINVAL2: f64 = MINVAL * MINVAL;

/// What a body is before it is placed and inflated; lengths in metres, axes along z.
#[derive(Clone, Copy, Debug)]
pub enum Solid<'a> {
    /// The centre.
    Point,
    /// Segment of this half length.
    Segment(f64),
    /// Ball of this radius.
    Sphere(f64),
    /// Radius, half length of the axis.
    Capsule(f64, f64),
    /// Half axes.
    Ellipsoid(Vec3),
    /// Radius, half height.
    Cylinder(f64, f64),
    /// Half sides.
    Box(Vec3),
    /// Hull of a mesh.
    Mesh(MeshHull<'a>),
    /// Column of a height field: three corners of the base, three of the surface, already placed.
    Prism(&'a [Vec3; 6]),
    /// Element or vertex of a flex, already placed and inflated.
    Element(&'a Element),
}

/// Corners of an element of a flex. A single vertex counts as an element with one corner.
#[derive(Clone, Copy, Debug)]
pub struct Element {
    /// Corners; the first `count` are in use.
    pub corners: [Vec3; 4],
    /// Number of corners.
    pub count: usize,
    /// Radius plus half of the margin \[m\].
    pub inflation: f64,
}

impl Element {
    /// Its corners.
    pub fn corners(&self) -> &[Vec3] {
        &self.corners[..self.count]
    }

    /// Farthest point in a direction.
    fn support(&self, dir: Vec3) -> Vec3 {
        let mut best = self.corners[0];
        let mut height = dot(best, dir);
        for &corner in &self.corners[1..self.count] {
            let other = dot(corner, dir);
            if other > height {
                (best, height) = (corner, other);
            }
        }
        add_scaled(best, dir, self.inflation)
    }
}

/// A placed convex body and the memory of its last support point.
#[derive(Clone, Copy, Debug)]
pub struct ConvexBody<'a> {
    /// Shape.
    pub solid: Solid<'a>,
    /// Position.
    pub pos: Vec3,
    /// Orientation.
    pub mat: Mat3,
    /// The body is inflated by half of this \[m\].
    pub margin: f64,
    /// Vertex of the last support point of a box or mesh; -1 before and for other shapes.
    vertex: i32,
    /// Where the last search of a mesh ended.
    farthest: Option<Farthest>,
}

impl<'a> ConvexBody<'a> {
    /// The body of a geom; `None` for planes, height fields and distance fields.
    pub fn new(shape: &Shape<'a>, margin: f64) -> Option<Self> {
        let [a, b, _] = shape.size;
        let solid = match shape.kind {
            GeomType::Sphere => Solid::Sphere(a),
            GeomType::Capsule => Solid::Capsule(a, b),
            GeomType::Ellipsoid => Solid::Ellipsoid(shape.size),
            GeomType::Cylinder => Solid::Cylinder(a, b),
            GeomType::Box => Solid::Box(shape.size),
            GeomType::Mesh | GeomType::Sdf => Solid::Mesh(MeshHull::new(shape.m, shape.data()?)),
            GeomType::Plane | GeomType::Hfield | GeomType::None => return None,
        };
        Some(Self::placed(solid, shape.pos, shape.mat, margin))
    }

    /// A solid at a pose.
    pub fn placed(solid: Solid<'a>, pos: Vec3, mat: Mat3, margin: f64) -> Self {
        ConvexBody { solid, pos, mat, margin, vertex: -1, farthest: None }
    }

    /// A column of a height field, corners of the base first.
    pub fn prism(corners: &'a [Vec3; 6]) -> Self {
        let identity = [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0];
        Self::placed(Solid::Prism(corners), [0.0; 3], identity, 0.0)
    }

    /// An element of a flex around `center`; the margin is in its inflation.
    pub fn element(element: &'a Element, center: Vec3) -> Self {
        let identity = [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0];
        Self::placed(Solid::Element(element), center, identity, 0.0)
    }

    /// An interior point.
    pub fn center(&self) -> Vec3 {
        match &self.solid {
            Solid::Prism(corners) => {
                let mut sum = [0.0; 3];
                for &c in *corners {
                    sum = add(sum, c);
                }
                scale(sum, 1.0 / 6.0)
            }
            _ => self.pos,
        }
    }

    /// Point or segment within a sphere or capsule, and the radius around it with half the margin.
    pub fn core(&self) -> Option<(Self, f64)> {
        let (core, radius) = match self.solid {
            Solid::Sphere(radius) => (Solid::Point, radius),
            Solid::Capsule(radius, half) => (Solid::Segment(half), radius),
            _ => return None,
        };
        Some((ConvexBody { solid: core, margin: 0.0, ..*self }, radius + 0.5 * self.margin))
    }

    /// True for polytopes without inflation: their support points form a finite set.
    pub fn is_discrete(&self) -> bool {
        self.margin == 0.0 && matches!(self.solid, Solid::Box(_) | Solid::Mesh(_) | Solid::Prism(_))
    }

    /// Vertex of the last support point of a box or mesh, -1 for other shapes. Bit k of a box vertex is set on the
    /// positive side of axis k.
    pub fn last_vertex(&self) -> i32 {
        self.vertex
    }

    /// A point of the geom frame in the world.
    pub fn to_world(&self, local: Vec3) -> Vec3 {
        add(mul_mat_vec(&self.mat, local), self.pos)
    }

    /// Farthest point of the inflated body in unit direction `dir`.
    // Inlined to keep vectors in registers, see `Polytope::add_face`.
    #[inline(always)]
    pub fn support(&mut self, dir: Vec3) -> Vec3 {
        let mut point = self.support_of_solid(dir);
        if self.margin > 0.0 {
            let half = 0.5 * self.margin;
            for i in 0..3 {
                point[i] += dir[i] * half;
            }
        }
        point
    }

    /// Farthest point of the body itself in direction `dir`.
    // Inlined to keep vectors in registers, see `Polytope::add_face`.
    #[inline(always)]
    pub fn support_of_solid(&mut self, dir: Vec3) -> Vec3 {
        match self.solid {
            Solid::Point => self.pos,
            Solid::Segment(half) => segment(&self.mat, self.pos, half, dir),
            Solid::Sphere(radius) => add(scale(dir, radius), self.pos),
            Solid::Prism(corners) => prism(corners, dir),
            Solid::Element(element) => element.support(dir),
            Solid::Capsule(radius, half) => self.to_world(capsule(radius, half, self.local(dir))),
            Solid::Ellipsoid(axes) => self.to_world(ellipsoid(axes, self.local(dir))),
            Solid::Cylinder(radius, half) => self.to_world(cylinder(radius, half, self.local(dir))),
            Solid::Box(half) => {
                let local = self.local(dir);
                let corner: Vec3 = std::array::from_fn(|i| signed(half[i], local[i]));
                self.vertex = (0..3).map(|i| i32::from(corner[i] > 0.0) << i).sum();
                self.to_world(corner)
            }
            Solid::Mesh(ref mesh) => {
                let found = mesh.farthest(self.local(dir), self.farthest);
                self.farthest = Some(found);
                self.vertex = found.vertex as i32;
                self.to_world(mesh.vertex(self.vertex))
            }
        }
    }

    /// Farthest point of the inflated body in direction `dir` as portal refinement wants it: where an edge or face
    /// is farthest, its middle. Climbs on meshes start where the last one ended.
    pub fn symmetric_support(&mut self, dir: Vec3) -> Vec3 {
        let local = self.local(dir);
        let mut point = match self.solid {
            Solid::Prism(corners) => return prism(corners, dir),
            Solid::Element(element) => return element.support(dir),
            Solid::Point => [0.0; 3],
            Solid::Segment(half) => [0.0, 0.0, sign(local[2]) * half],
            Solid::Sphere(radius) => scale(local, radius),
            Solid::Capsule(radius, half) => {
                let [x, y, z] = scale(local, radius);
                [x, y, z + sign(local[2]) * half]
            }
            Solid::Ellipsoid(axes) => {
                let (n, _) = normalize([local[0] * axes[0], local[1] * axes[1], local[2] * axes[2]]);
                [n[0] * axes[0], n[1] * axes[1], n[2] * axes[2]]
            }
            Solid::Cylinder(radius, half) => {
                let length = (local[0] * local[0] + local[1] * local[1]).sqrt();
                let [x, y] = if length > MINVAL {
                    [local[0] / length * radius, local[1] / length * radius]
                } else {
                    [0.0; 2]
                };
                [x, y, sign(local[2]) * half]
            }
            Solid::Box(half) => std::array::from_fn(|i| sign(local[i]) * half[i]),
            Solid::Mesh(mesh) => {
                let found = mesh.farthest_untabulated(local, self.farthest);
                self.farthest = Some(found);
                mesh.vertex(found.vertex as i32)
            }
        };
        for i in 0..3 {
            point[i] += local[i] * self.margin / 2.0;
        }
        self.to_world(point)
    }

    fn local(&self, dir: Vec3) -> Vec3 {
        mul_mat_t_vec(&self.mat, dir)
    }
}

/// `x` with the sign of `side`; zero counts as positive.
fn signed(x: f64, side: f64) -> f64 {
    if side >= 0.0 { x } else { -x }
}

/// -1, 0 or 1.
fn sign(x: f64) -> f64 {
    if x > 0.0 {
        1.0
    } else if x < 0.0 {
        -1.0
    } else {
        0.0
    }
}

fn segment(mat: &Mat3, pos: Vec3, half: f64, dir: Vec3) -> Vec3 {
    let end = signed(half, mat[2] * dir[0] + mat[5] * dir[1] + mat[8] * dir[2]);
    [mat[2] * end + pos[0], mat[5] * end + pos[1], mat[8] * end + pos[2]]
}

fn capsule(radius: f64, half: f64, dir: Vec3) -> Vec3 {
    let [x, y, z] = scale(dir, radius);
    [x, y, z + signed(half, dir[2])]
}

fn ellipsoid(axes: Vec3, dir: Vec3) -> Vec3 {
    let [x, y, z] = [dir[0] * axes[0], dir[1] * axes[1], dir[2] * axes[2]];
    let norm2 = x * x + y * y + z * z;
    if norm2 < MINVAL2 {
        return [axes[0], 0.0, 0.0];
    }
    let inverse = 1.0 / norm2.sqrt();
    [x * (inverse * axes[0]), y * (inverse * axes[1]), z * (inverse * axes[2])]
}

fn cylinder(radius: f64, half: f64, dir: Vec3) -> Vec3 {
    let norm2 = dir[0] * dir[0] + dir[1] * dir[1];
    let s = if norm2 >= MINVAL2 { radius / norm2.sqrt() } else { 0.0 };
    [s * dir[0], s * dir[1], signed(half, dir[2])]
}

fn prism(corners: &[Vec3; 6], dir: Vec3) -> Vec3 {
    let height = |c: Vec3| c[0] * dir[0] + c[1] * dir[1] + c[2] * dir[2];
    let start = if dir[2] < 0.0 { 0 } else { 3 };
    let mut best = start;
    for i in start + 1..start + 3 {
        if height(corners[i]) > height(corners[best]) {
            best = i;
        }
    }
    corners[best]
}
