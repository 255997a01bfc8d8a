//! Contacts of an infinite plane: with spheres, capsules, cylinders, boxes and convex bodies.
//!
//! The normal is the plane's z axis; the distance is that of surface points from the plane.

use super::{PreContact, Shape};
use crate::math::{
    Vec3, add, add_scaled, column, cross, distance, dot, mul_mat_t_vec, mul_mat_vec, normalize,
};
use crate::math::{scale, sub};
use crate::model::bounds::MINVAL;
use crate::model::{GeomType, Model};

/// Contact at signed distance `dist` from a plane, of surface point `point`.
fn at_point(normal: Vec3, dist: f64, point: Vec3) -> PreContact {
    PreContact { dist, pos: add_scaled(point, normal, -dist * 0.5), normal, tangent: [0.0; 3] }
}

/// A sphere of given centre and radius against the plane through `origin`.
pub(super) fn sphere_on_plane(
    origin: Vec3,
    normal: Vec3,
    centre: Vec3,
    radius: f64,
    margin: f64,
) -> Option<PreContact> {
    let height = dot(sub(centre, origin), normal);
    if height > margin + radius {
        return None;
    }
    let dist = height - radius;
    let pos = add(centre, scale(normal, -dist / 2.0 - radius));
    Some(PreContact { dist, pos, normal, tangent: [0.0; 3] })
}

/// Plane and sphere.
pub fn plane_sphere(plane: &Shape, sphere: &Shape, margin: f64, out: &mut Vec<PreContact>) {
    out.extend(sphere_on_plane(plane.pos, plane.axis(), sphere.pos, sphere.size[0], margin));
}

/// Plane and capsule: the two end spheres, first tangent along the capsule.
pub fn plane_capsule(plane: &Shape, capsule: &Shape, margin: f64, out: &mut Vec<PreContact>) {
    let axis = capsule.axis();
    let half = scale(axis, capsule.size[1]);
    for end in [add(capsule.pos, half), sub(capsule.pos, half)] {
        let contact = sphere_on_plane(plane.pos, plane.axis(), end, capsule.size[0], margin);
        out.extend(contact.map(|c| PreContact { tangent: axis, ..c }));
    }
}

/// Plane and cylinder: the lowest point of each cap, then two more that make an equilateral triangle on the
/// lower cap.
pub fn plane_cylinder(plane: &Shape, cylinder: &Shape, margin: f64, out: &mut Vec<PreContact>) {
    let normal = plane.axis();
    let [radius, half_length, _] = cylinder.size;

    // The axis towards the plane and its height change.
    let mut axis = cylinder.axis();
    let mut axis_height = dot(normal, axis);
    if axis_height > 0.0 {
        axis = scale(axis, -1.0);
        axis_height = -axis_height;
    }
    let centre_height = dot(sub(cylinder.pos, plane.pos), normal);

    // The radial vector that descends fastest; any one when the caps are parallel to the plane.
    let steepest = sub(scale(axis, axis_height), normal);
    let length2 = dot(steepest, steepest);
    let radial = if length2 >= MINVAL * MINVAL {
        scale(steepest, radius / length2.sqrt())
    } else {
        scale(column(&cylinder.mat, 0), radius)
    };
    let radial_height = dot(radial, normal);
    axis = scale(axis, half_length);
    axis_height *= half_length;

    let mut lower = |dist: f64, offset: Vec3, along: Vec3| {
        out.push(at_point(normal, dist, add(add(cylinder.pos, offset), along)));
    };
    let dist = centre_height + axis_height + radial_height;
    if dist > margin {
        return;
    }
    lower(dist, radial, axis);
    let dist = centre_height - axis_height + radial_height;
    if dist <= margin {
        lower(dist, radial, scale(axis, -1.0));
    }
    let dist = centre_height + axis_height - radial_height * 0.5;
    if dist <= margin {
        let sideways = scale(normalize(cross(radial, axis)).0, radius * 3.0f64.sqrt() / 2.0);
        for side in [sideways, scale(sideways, -1.0)] {
            lower(dist, side, add_scaled(axis, radial, -0.5));
        }
    }
}

/// Plane and box: the first four corners that lie below the centre and within the margin.
pub fn plane_box(plane: &Shape, cuboid: &Shape, margin: f64, out: &mut Vec<PreContact>) {
    let normal = plane.axis();
    let height = dot(sub(cuboid.pos, plane.pos), normal);
    let first = out.len();
    for i in 0..8 {
        let side = |k: usize| if i & (1 << k) != 0 { cuboid.size[k] } else { -cuboid.size[k] };
        let corner = mul_mat_vec(&cuboid.mat, [side(0), side(1), side(2)]);
        let below = dot(normal, corner);
        if height + below > margin || below > 0.0 {
            continue;
        }
        out.push(at_point(normal, height + below, add(corner, cuboid.pos)));
        if out.len() == first + 4 {
            return;
        }
    }
}

/// Plane and ellipsoid: the deepest point.
pub fn plane_ellipsoid(plane: &Shape, ellipsoid: &Shape, margin: f64, out: &mut Vec<PreContact>) {
    let normal = plane.axis();
    let size = ellipsoid.size;
    let down = mul_mat_t_vec(&ellipsoid.mat, scale(normal, -1.0));
    let (unit, _) = normalize([down[0] * size[0], down[1] * size[1], down[2] * size[2]]);
    let local = [unit[0] * size[0], unit[1] * size[1], unit[2] * size[2]];
    let point = add(mul_mat_vec(&ellipsoid.mat, local), ellipsoid.pos);
    let dist = dot(normal, sub(point, plane.pos));
    if dist <= margin {
        out.push(at_point(normal, dist, point));
    }
}

/// Most contacts of a plane and a mesh.
const MAX_PLANE_MESH: usize = 3;
/// Further contacts keep this distance from the first, in units of the bounding radius.
const PLANE_MESH_SPACING: f64 = 0.3;
/// Meshes with fewer vertices are searched one by one (documentation: `mjMESH_HILLCLIMB_MIN`).
const HILL_CLIMB_MIN: usize = 10;

/// Plane and convex hull of a mesh: the deepest vertex, then its neighbours below the margin.
pub fn plane_mesh(plane: &Shape, mesh: &Shape, margin: f64, out: &mut Vec<PreContact>) {
    let Some(hull) = Hull::new(mesh) else { return };
    let normal = plane.axis();
    let down = mul_mat_t_vec(&mesh.mat, scale(normal, -1.0));
    let world = |v: usize| add(mul_mat_vec(&mesh.mat, hull.vertex(v)), mesh.pos);

    let deepest = hull.deepest(down);
    let point = world(deepest.vertex);
    let dist = dot(normal, sub(point, plane.pos));
    if dist > margin {
        return;
    }
    let first = at_point(normal, dist, point);
    out.push(first);
    let spacing = PLANE_MESH_SPACING * mesh.m.geom_rbound[mesh.geom];

    // Depth along `down` that reaches the margin, measured from the centre of the mesh.
    let threshold = dot(normal, sub(mesh.pos, plane.pos)) - margin;
    let mut count = 1;
    let mut consider = |v: usize| {
        if dot(down, hull.vertex(v)) > threshold {
            let point = world(v);
            if distance(point, first.pos) >= spacing {
                out.push(at_point(normal, dot(normal, sub(point, plane.pos)), point));
                count += 1;
            }
        }
        count < MAX_PLANE_MESH
    };
    match hull.graph {
        None => {
            let _ = (0..hull.vertices.len()).filter(|&v| v != deepest.vertex).all(&mut consider);
        }
        Some(graph) => {
            let _ = graph.neighbours(deepest.index).map(|v| graph.global(v)).all(&mut consider);
        }
    }
}

/// Vertices of a mesh and the edge graph of its convex hull, if it was built.
struct Hull<'a> {
    vertices: &'a [[f32; 3]],
    graph: Option<HullGraph<'a>>,
}

/// A vertex that a search found.
struct Found {
    /// Index among the vertices of the mesh.
    vertex: usize,
    /// Index the neighbourhood search starts from: in the hull, or in the mesh when that has few vertices.
    index: usize,
}

impl<'a> Hull<'a> {
    fn new(mesh: &Shape<'a>) -> Option<Self> {
        let (m, id): (&Model, usize) = (mesh.m, mesh.data()?);
        debug_assert!(mesh.kind == GeomType::Mesh);
        let start = m.mesh_vertadr[id] as usize;
        let vertices = &m.mesh_vert[start..start + m.mesh_vertnum[id] as usize];
        let graph = usize::try_from(m.mesh_graphadr[id]).ok().map(|adr| HullGraph(&m.mesh_graph[adr..]));
        Some(Hull { vertices, graph })
    }

    fn vertex(&self, v: usize) -> Vec3 {
        self.vertices[v].map(f64::from)
    }

    /// The vertex farthest along `dir`: by hill climbing on the graph from the first hull vertex, or by search.
    fn deepest(&self, dir: Vec3) -> Found {
        let Some(graph) = self.graph.filter(|_| self.vertices.len() >= HILL_CLIMB_MIN) else {
            let mut best = (0, -1e10);
            for v in 0..self.vertices.len() {
                let along = dot(dir, self.vertex(v));
                if along > best.1 {
                    best = (v, along);
                }
            }
            return Found { vertex: best.0, index: best.0 };
        };
        let along = |local: usize| dot(dir, self.vertex(graph.global(local)));
        let (mut best, mut farthest) = (0, along(0));
        loop {
            let start = best;
            for v in graph.neighbours(start) {
                let reach = along(v);
                if reach > farthest {
                    (best, farthest) = (v, reach);
                }
            }
            if best == start {
                return Found { vertex: graph.global(best), index: best };
            }
        }
    }
}

/// The integers of `mesh_graph` for one mesh: number of hull vertices, number of faces, start of each vertex's
/// edge list, mesh index of each hull vertex, edge lists ended by -1.
#[derive(Clone, Copy)]
struct HullGraph<'a>(&'a [i32]);

impl<'a> HullGraph<'a> {
    fn global(self, local: usize) -> usize {
        self.0[2 + self.0[0] as usize + local] as usize
    }

    fn neighbours(self, local: usize) -> impl Iterator<Item = usize> + 'a {
        let edges = 2 + 2 * self.0[0] as usize + self.0[2 + local] as usize;
        self.0[edges..].iter().take_while(|&&v| v >= 0).map(|&v| v as usize)
    }
}
