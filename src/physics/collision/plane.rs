//! Contacts of an infinite plane: with spheres, capsules, cylinders, boxes and convex bodies.
//!
//! The normal is the plane's z axis; distances are measured from the plane to points of the surface.

use super::hull::MeshHull;
use super::shape::{PreContact, Shape};
use crate::math::{
    Vec3, add, add_scaled, column, cross, distance, dot, mul_mat_t_vec, mul_mat_vec, normalize,
};
use crate::math::{scale, sub};
use crate::model::bounds::MINVAL;

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

    let cap_point = |offset: Vec3, along: Vec3| add(add(cylinder.pos, offset), along);
    let dist = centre_height + axis_height + radial_height;
    if dist > margin {
        return;
    }
    out.push(at_point(normal, dist, cap_point(radial, axis)));
    let dist = centre_height - axis_height + radial_height;
    if dist <= margin {
        out.push(at_point(normal, dist, cap_point(radial, scale(axis, -1.0))));
    }
    let dist = centre_height + axis_height - radial_height * 0.5;
    if dist <= margin {
        let sideways = scale(normalize(cross(radial, axis)).0, radius * 3.0f64.sqrt() / 2.0);
        for side in [sideways, scale(sideways, -1.0)] {
            out.push(at_point(normal, dist, add_scaled(cap_point(side, axis), radial, -0.5)));
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
/// Plane and convex hull of a mesh: the deepest vertex, then its neighbours below the margin.
pub fn plane_mesh(plane: &Shape, mesh: &Shape, margin: f64, out: &mut Vec<PreContact>) {
    let Some(hull) = mesh.data().map(|id| MeshHull::new(mesh.m, id)) else { return };
    let normal = plane.axis();
    let down = mul_mat_t_vec(&mesh.mat, scale(normal, -1.0));
    let world = |v: usize| add(mul_mat_vec(&mesh.mat, hull.vertex(v as i32)), mesh.pos);

    let deepest = hull.farthest_untabulated(down, None);
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
    let mut add_deep = |v: usize| {
        if hull.height(v, down) > threshold {
            let point = world(v);
            if distance(point, first.pos) >= spacing {
                out.push(at_point(normal, dot(normal, sub(point, plane.pos)), point));
                count += 1;
            }
        }
        count < MAX_PLANE_MESH
    };
    // `all` stops when there are enough.
    let _ = if hull.has_graph() {
        hull.around(deepest).filter(|&v| v < hull.vertices()).all(&mut add_deep)
    } else {
        (0..hull.vertices()).filter(|&v| v != deepest.vertex).all(&mut add_deep)
    };
}
