//! Faces and edges of boxes and meshes near a support feature.

use super::gjk::Vertex;
use super::hull::MeshHull;
use super::support::{ConvexBody, Solid};
use crate::math::{Vec3, dot, mul_mat_t_vec, mul_mat_vec, normalize, scale, sub};

/// Cosine of the angle, about 5.1 degrees, within which two normals count as parallel.
pub const FACE_ALIGNMENT: f64 = 0.996;

/// The distinct vertices of one body among the corners of a face of the Minkowski difference.
#[derive(Clone, Copy, Debug)]
pub struct Feature {
    vertex: [i32; 3],
    point: [Vec3; 3],
    /// How many vertices are distinct: 1 a corner, 2 an edge, 3 a face.
    pub dim: usize,
}

impl Feature {
    /// Feature of the first (`side` 0) or second body.
    pub fn new(face: &[Vertex; 3], side: usize) -> Self {
        let mut vertex = face.map(|v| v.index[side]);
        let mut point = face.map(|v| if side == 0 { v.a } else { v.b });
        let dim = if vertex[0] == vertex[1] {
            if vertex[0] == vertex[2] {
                1
            } else {
                vertex[1] = vertex[2];
                point[1] = point[2];
                2
            }
        } else if vertex[2] == vertex[0] || vertex[2] == vertex[1] {
            2
        } else {
            3
        };
        Feature { vertex, point, dim }
    }

    /// Its first vertex, in the world.
    pub fn corner(&self) -> Vec3 {
        self.point[0]
    }
}

/// Outward unit normal of a face, in the world, and the number of the face.
pub type FaceNormal = (Vec3, i32);

/// An edge from the corner of a feature: unit direction and far end, in the world.
pub type Edge = (Vec3, Vec3);

/// A body bounded by polygons.
#[derive(Clone, Copy, Debug)]
pub struct Polyhedron<'b, 'm> {
    body: &'b ConvexBody<'m>,
    surface: Surface<'b, 'm>,
}

#[derive(Clone, Copy, Debug)]
enum Surface<'b, 'm> {
    Box(Vec3),
    Mesh(&'b MeshHull<'m>),
}

impl<'b, 'm> Polyhedron<'b, 'm> {
    /// `None` for other shapes and for meshes without polygons.
    pub fn new(body: &'b ConvexBody<'m>) -> Option<Self> {
        let surface = match &body.solid {
            Solid::Box(half) => Surface::Box(*half),
            Solid::Mesh(mesh) if mesh.has_polygons() => Surface::Mesh(mesh),
            _ => return None,
        };
        Some(Polyhedron { body, surface })
    }

    /// Lists the faces that meet in a feature. Where a box feature does not tell, its face that looks along
    /// `outward` is taken.
    pub fn faces_at(&self, feature: &Feature, outward: Vec3, out: &mut Vec<FaceNormal>) {
        out.clear();
        match self.surface {
            Surface::Box(_) => self.box_faces(feature, outward, out),
            Surface::Mesh(mesh) => self.mesh_faces(mesh, feature, out),
        }
    }

    fn box_faces(&self, feature: &Feature, outward: Vec3, out: &mut Vec<FaceNormal>) {
        for axis in 0..3 {
            let side = common_side(&feature.vertex[..feature.dim], axis);
            if side != 0.0 {
                out.push(self.box_normal(axis, side));
            }
        }
        if out.len() == 4 - feature.dim {
            return;
        }
        out.clear();
        let local = mul_mat_t_vec(&self.body.mat, outward);
        let local = scale(local, 1.0 / dot(local, local).sqrt());
        let faces = (0..3).flat_map(|axis| [(axis, 1.0), (axis, -1.0)]);
        if let Some((axis, side)) =
            faces.into_iter().find(|&(axis, side)| local[axis] * side > FACE_ALIGNMENT)
        {
            out.push(self.box_normal(axis, side));
        }
    }

    fn box_normal(&self, axis: usize, side: f64) -> FaceNormal {
        let mut local = [0.0; 3];
        local[axis] = side;
        (mul_mat_vec(&self.body.mat, local), 2 * axis as i32 + i32::from(side < 0.0))
    }

    fn mesh_faces(&self, mesh: &MeshHull, feature: &Feature, out: &mut Vec<FaceNormal>) {
        let [v1, v2, v3] = feature.vertex;
        let normal = |p: i32| (mul_mat_vec(&self.body.mat, mesh.polygon_normal(p)), p);
        match feature.dim {
            1 => out.extend(mesh.polygons_at(v1).iter().map(|&p| normal(p))),
            2 => out.extend(common(mesh.polygons_at(v1), mesh.polygons_at(v2)).map(normal)),
            _ => {
                let both = common(mesh.polygons_at(v1), mesh.polygons_at(v2));
                let third = mesh.polygons_at(v3);
                out.extend(both.filter(|p| third.contains(p)).take(1).map(normal));
            }
        }
    }

    /// Lists the edges that a corner or edge feature lies on.
    pub fn edges_at(&self, feature: &Feature, out: &mut Vec<Edge>) {
        out.clear();
        let corner = feature.point[0];
        let edge = |end: Vec3| (normalize(sub(end, corner)).0, end);
        if feature.dim == 2 {
            out.push(edge(feature.point[1]));
            return;
        }
        match self.surface {
            Surface::Box(half) => {
                let local: Vec3 = std::array::from_fn(|i| corner_side(feature.vertex[0], i) * half[i]);
                for axis in 0..3 {
                    let mut end = local;
                    end[axis] = -end[axis];
                    out.push(edge(self.body.to_world(end)));
                }
            }
            Surface::Mesh(mesh) => {
                let v = feature.vertex[0];
                for &p in mesh.polygons_at(v) {
                    let polygon = mesh.polygon(p);
                    let Some(at) = polygon.iter().position(|&u| u == v) else { continue };
                    let previous = polygon[(at + polygon.len() - 1) % polygon.len()];
                    out.push(edge(self.body.to_world(mesh.vertex(previous))));
                }
            }
        }
    }

    /// Corners of a face in the world, clockwise seen from outside.
    pub fn polygon(&self, face: i32, out: &mut Vec<Vec3>) {
        out.clear();
        match self.surface {
            Surface::Box(half) => {
                for s in BOX_FACES[face as usize] {
                    out.push(self.body.to_world([s[0] * half[0], s[1] * half[1], s[2] * half[2]]));
                }
            }
            Surface::Mesh(mesh) => {
                out.extend(mesh.polygon(face).iter().rev().map(|&v| self.body.to_world(mesh.vertex(v))));
            }
        }
    }
}

/// Signs of the corners of the faces +x -x +y -y +z -z.
const BOX_FACES: [[Vec3; 4]; 6] = [
    [[1.0, 1.0, 1.0], [1.0, 1.0, -1.0], [1.0, -1.0, -1.0], [1.0, -1.0, 1.0]],
    [[-1.0, 1.0, -1.0], [-1.0, 1.0, 1.0], [-1.0, -1.0, 1.0], [-1.0, -1.0, -1.0]],
    [[-1.0, 1.0, -1.0], [1.0, 1.0, -1.0], [1.0, 1.0, 1.0], [-1.0, 1.0, 1.0]],
    [[-1.0, -1.0, 1.0], [1.0, -1.0, 1.0], [1.0, -1.0, -1.0], [-1.0, -1.0, -1.0]],
    [[-1.0, 1.0, 1.0], [1.0, 1.0, 1.0], [1.0, -1.0, 1.0], [-1.0, -1.0, 1.0]],
    [[1.0, 1.0, -1.0], [-1.0, 1.0, -1.0], [-1.0, -1.0, -1.0], [1.0, -1.0, -1.0]],
];

/// Side of `axis` on which a box vertex lies.
fn corner_side(vertex: i32, axis: usize) -> f64 {
    if vertex & (1 << axis) != 0 { 1.0 } else { -1.0 }
}

/// Side of `axis` on which all the box vertices lie; 0 when there is none.
fn common_side(vertex: &[i32], axis: usize) -> f64 {
    let side = corner_side(vertex[0], axis);
    if vertex[1..].iter().all(|&v| corner_side(v, axis) == side) { side } else { 0.0 }
}

/// Numbers in both lists, at most two: as many faces as share an edge.
fn common<'l>(first: &'l [i32], second: &'l [i32]) -> impl Iterator<Item = i32> + use<'l> {
    first.iter().copied().filter(|p| second.contains(p)).take(2)
}
