//! Support mappings of convex shapes: the farthest point of a shape in a direction
//! (van den Bergen, Collision Detection in Interactive 3D Environments, section 4.3).
//!
//! A mesh is the convex hull of its vertices. Small ones are searched in full; larger ones by hill climbing on the
//! graph of the hull, from the better of the last answer and a vertex tabulated for the direction's octant.

use super::Shape;
use crate::math::{Mat3, Vec3, add, mul_mat_t_vec, mul_mat_vec, scale};
use crate::model::bounds::MINVAL;
use crate::model::{GeomType, Model};

/// Meshes with fewer vertices are searched in full.
const HILL_CLIMB_MIN: usize = 10;
/// A component of a unit direction beyond this leaves the middle cell of the table of extremal vertices.
const EXTREMA_CELL: f64 = 0.4;
const MINVAL2: f64 = MINVAL * MINVAL;

/// The mesh of a geom: vertices, the graph of their hull, and its polygons.
#[derive(Clone, Copy, Debug)]
pub struct MeshHull<'a> {
    /// Vertices in the geom frame [m].
    vert: &'a [[f32; 3]],
    graph: Option<HullGraph<'a>>,
    /// Index of the mesh.
    mesh: usize,
    m: &'a Model,
}

/// Hull vertices, which have numbers of their own, and their neighbours in lists ended by -1.
#[derive(Clone, Copy, Debug)]
struct HullGraph<'a> {
    edge_start: &'a [i32],
    vertex: &'a [i32],
    neighbour: &'a [i32],
    extrema: &'a [i32; 27],
}

impl<'a> HullGraph<'a> {
    fn new(m: &'a Model, mesh: usize) -> Option<Self> {
        let start = usize::try_from(m.mesh_graphadr[mesh]).ok()?;
        let graph = &m.mesh_graph[start..];
        let n = graph[0] as usize;
        Some(HullGraph {
            edge_start: &graph[2..2 + n],
            vertex: &graph[2 + n..2 + 2 * n],
            neighbour: &graph[2 + 2 * n..],
            extrema: &m.mesh_extrema[mesh],
        })
    }
}

impl<'a> MeshHull<'a> {
    fn new(m: &'a Model, mesh: usize) -> Self {
        let (start, count) = (m.mesh_vertadr[mesh] as usize, m.mesh_vertnum[mesh] as usize);
        let graph = if count < HILL_CLIMB_MIN { None } else { HullGraph::new(m, mesh) };
        MeshHull { vert: &m.mesh_vert[start..start + count], graph, mesh, m }
    }

    /// True when the polygons of the hull are known.
    pub fn has_polygons(&self) -> bool {
        self.m.mesh_polynum[self.mesh] > 0
    }

    /// Vertex `v` in the geom frame.
    pub fn vertex(&self, v: i32) -> Vec3 {
        self.vert[v as usize].map(f64::from)
    }

    /// Polygons around vertex `v`.
    pub fn polygons_at(&self, v: i32) -> &'a [i32] {
        let k = self.m.mesh_vertadr[self.mesh] as usize + v as usize;
        let start = self.m.mesh_polymapadr[k] as usize;
        &self.m.mesh_polymap[start..start + self.m.mesh_polymapnum[k] as usize]
    }

    /// Vertices of polygon `p`, counter-clockwise seen from outside.
    pub fn polygon(&self, p: i32) -> &'a [i32] {
        let k = self.m.mesh_polyadr[self.mesh] as usize + p as usize;
        let start = self.m.mesh_polyvertadr[k] as usize;
        &self.m.mesh_polyvert[start..start + self.m.mesh_polyvertnum[k] as usize]
    }

    /// Outward normal of polygon `p` in the geom frame.
    pub fn polygon_normal(&self, p: i32) -> Vec3 {
        self.m.mesh_polynormal[self.m.mesh_polyadr[self.mesh] as usize + p as usize]
    }

    fn height(&self, v: usize, dir: Vec3) -> f64 {
        let [x, y, z] = self.vert[v];
        dir[0] * f64::from(x) + dir[1] * f64::from(y) + dir[2] * f64::from(z)
    }

    /// Farthest of all vertices; the last answer wins ties.
    fn search(&self, dir: Vec3, last: Option<usize>) -> usize {
        let (mut best, mut top) = match last {
            Some(v) => (v, self.height(v, dir)),
            None => (0, -f64::from(f32::MAX)),
        };
        for v in 0..self.vert.len() {
            let h = self.height(v, dir);
            if h > top {
                (best, top) = (v, h);
            }
        }
        best
    }

    /// Farthest hull vertex, in the numbering of the graph.
    fn climb(&self, graph: &HullGraph, dir: Vec3, last: Option<usize>) -> usize {
        let height = |h: usize| self.height(graph.vertex[h] as usize, dir);
        let cell = |x: f64| 1 + usize::from(x > EXTREMA_CELL) - usize::from(x < -EXTREMA_CELL);
        let seed = graph.extrema[9 * cell(dir[0]) + 3 * cell(dir[1]) + cell(dir[2])] as usize;
        let mut best = match last {
            Some(v) if height(seed) > height(v) => seed,
            Some(v) => v,
            None => seed,
        };
        let mut top = height(best);
        loop {
            let from = best;
            for &next in &graph.neighbour[graph.edge_start[from] as usize..] {
                let Ok(next) = usize::try_from(next) else { break };
                let h = height(next);
                if h > top {
                    (best, top) = (next, h);
                }
            }
            if best == from {
                return best;
            }
        }
    }
}

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
    Prism([Vec3; 6]),
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
    /// The body is inflated by half of this [m].
    pub margin: f64,
    /// Vertex of the last support point of a box or mesh; -1 before and for other shapes.
    vertex: i32,
    /// The same in the numbering of the hull graph.
    hull_vertex: Option<usize>,
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
            GeomType::Mesh => Solid::Mesh(MeshHull::new(shape.m, shape.data()?)),
            GeomType::Plane | GeomType::Hfield | GeomType::Sdf | GeomType::None => return None,
        };
        Some(Self::placed(solid, shape.pos, shape.mat, margin))
    }

    /// A solid at a pose.
    pub fn placed(solid: Solid<'a>, pos: Vec3, mat: Mat3, margin: f64) -> Self {
        ConvexBody { solid, pos, mat, margin, vertex: -1, hull_vertex: None }
    }

    /// A column of a height field, corners of the base first.
    pub fn prism(corners: [Vec3; 6]) -> Self {
        let identity = [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0];
        Self::placed(Solid::Prism(corners), [0.0; 3], identity, 0.0)
    }

    /// An interior point.
    pub fn center(&self) -> Vec3 {
        match &self.solid {
            Solid::Prism(corners) => {
                let mut sum = [0.0; 3];
                for &c in corners {
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
    pub fn support_of_solid(&mut self, dir: Vec3) -> Vec3 {
        match self.solid {
            Solid::Point => self.pos,
            Solid::Segment(half) => segment(&self.mat, self.pos, half, dir),
            Solid::Sphere(radius) => add(scale(dir, radius), self.pos),
            Solid::Prism(ref corners) => prism(corners, dir),
            Solid::Capsule(radius, half) => self.to_world(capsule(radius, half, self.local(dir))),
            Solid::Ellipsoid(axes) => self.to_world(ellipsoid(axes, self.local(dir))),
            Solid::Cylinder(radius, half) => self.to_world(cylinder(radius, half, self.local(dir))),
            Solid::Box(half) => {
                let local = self.local(dir);
                let corner: Vec3 = std::array::from_fn(|i| signed(half[i], local[i]));
                self.vertex = (0..3).map(|i| i32::from(corner[i] > 0.0) << i).sum();
                self.to_world(corner)
            }
            Solid::Mesh(mesh) => {
                self.vertex = self.mesh_support(&mesh, self.local(dir));
                self.to_world(mesh.vertex(self.vertex))
            }
        }
    }

    /// Farthest vertex of a mesh; remembers where a climb ended.
    fn mesh_support(&mut self, mesh: &MeshHull, dir: Vec3) -> i32 {
        match &mesh.graph {
            None => mesh.search(dir, usize::try_from(self.vertex).ok()) as i32,
            Some(graph) => {
                let v = mesh.climb(graph, dir, self.hull_vertex);
                self.hull_vertex = Some(v);
                graph.vertex[v]
            }
        }
    }

    fn local(&self, dir: Vec3) -> Vec3 {
        mul_mat_t_vec(&self.mat, dir)
    }
}

/// `x` with the sign of `side`; zero counts as positive.
fn signed(x: f64, side: f64) -> f64 {
    if side >= 0.0 { x } else { -x }
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
