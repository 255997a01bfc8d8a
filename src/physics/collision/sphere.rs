//! Contacts of a sphere: with a sphere, a capsule, a cylinder, a box.

use super::plane::sphere_on_plane;
use super::shape::{PreContact, Shape};
use crate::math::{Mat3, Vec3, add, add_scaled, column, cross, dot, mul_mat_t_vec, mul_mat_vec};
use crate::math::{normalize, scale, sub};
use crate::model::bounds::MINVAL;

/// A ball with the frame that decides the normal of concentric ones.
#[derive(Clone, Copy)]
pub(super) struct Ball<'a> {
    pub centre: Vec3,
    pub radius: f64,
    pub mat: &'a Mat3,
}

/// Two balls. Concentric ones are separated along the common normal of their z axes, or along x.
pub(super) fn balls(a: Ball, b: Ball, margin: f64) -> Option<PreContact> {
    let between = sub(b.centre, a.centre);
    let distance2 = dot(between, between);
    let reach = margin + a.radius + b.radius;
    if distance2 > reach * reach {
        return None;
    }
    let dist = distance2.sqrt() - a.radius - b.radius;
    let (mut normal, length) = normalize(between);
    if length < MINVAL {
        normal = normalize(cross(column(a.mat, 2), column(b.mat, 2))).0;
    }
    let pos = add(scale(normal, a.radius + dist / 2.0), a.centre);
    Some(PreContact { dist, pos, normal, tangent: [0.0; 3] })
}

fn ball<'a>(s: &'a Shape, centre: Vec3) -> Ball<'a> {
    Ball { centre, radius: s.size[0], mat: &s.mat }
}

/// `x` limited to \[-limit, limit\].
pub(super) fn clip(x: f64, limit: f64) -> f64 {
    x.min(limit).max(-limit)
}

/// Two spheres.
pub fn sphere_sphere(a: &Shape, b: &Shape, margin: f64, out: &mut Vec<PreContact>) {
    out.extend(balls(ball(a, a.pos), ball(b, b.pos), margin));
}

/// Sphere and capsule: the ball at the nearest point of the capsule's segment.
pub fn sphere_capsule(sphere: &Shape, capsule: &Shape, margin: f64, out: &mut Vec<PreContact>) {
    let axis = capsule.axis();
    let along = clip(dot(axis, sub(sphere.pos, capsule.pos)), capsule.size[1]);
    let nearest = add(scale(axis, along), capsule.pos);
    out.extend(balls(ball(sphere, sphere.pos), ball(capsule, nearest), margin));
}

/// Sphere and cylinder: against the side, a cap, or the rim.
pub fn sphere_cylinder(sphere: &Shape, cylinder: &Shape, margin: f64, out: &mut Vec<PreContact>) {
    let [radius, half_length, _] = cylinder.size;
    let axis = cylinder.axis();
    let vec = sub(sphere.pos, cylinder.pos);
    let along = dot(axis, vec);
    let axial = scale(axis, along);
    let radial = sub(vec, axial);
    let radial2 = dot(radial, radial);

    let mut beside = along.abs() < half_length;
    let mut above = radial2 < radius * radius;
    if beside && above {
        // The centre is inside: leave by the nearer surface.
        let through_cap = half_length - along.abs() < radius - radial2.sqrt();
        (beside, above) = (!through_cap, through_cap);
    }
    let s = ball(sphere, sphere.pos);
    if beside {
        out.extend(balls(s, ball(cylinder, add(axial, cylinder.pos)), margin));
    } else if above {
        let (normal, height) =
            if along > 0.0 { (axis, half_length) } else { (scale(axis, -1.0), -half_length) };
        let cap = add_scaled(cylinder.pos, axis, height);
        let contact = sphere_on_plane(cap, normal, sphere.pos, sphere.size[0], margin);
        out.extend(contact.map(|c| PreContact { normal: scale(c.normal, -1.0), ..c }));
    } else {
        let rim = scale(radial, radius / radial2.sqrt());
        let end = scale(axis, if along > 0.0 { half_length } else { -half_length });
        let corner = add(add(end, rim), cylinder.pos);
        out.extend(balls(s, Ball { centre: corner, radius: 0.0, mat: &cylinder.mat }, margin));
    }
}

/// Sphere and box.
pub fn sphere_box(sphere: &Shape, cuboid: &Shape, margin: f64, out: &mut Vec<PreContact>) {
    out.extend(ball_box(sphere.pos, sphere.size[0], cuboid, margin));
}

/// A ball and a box: along the line to the nearest point of the box, or through the nearest face when the centre
/// is inside.
pub(super) fn ball_box(centre: Vec3, radius: f64, cuboid: &Shape, margin: f64) -> Option<PreContact> {
    let local = mul_mat_t_vec(&cuboid.mat, sub(centre, cuboid.pos));
    let size = cuboid.size;
    let nearest: Vec3 =
        std::array::from_fn(|i| if size[i] > 0.0 { clip(local[i], size[i]) } else { local[i] });
    let (inward, gap) = normalize(sub(nearest, local));
    if gap - radius > margin {
        return None;
    }
    let (pos, normal, gap) = if gap <= MINVAL {
        let (face, depth) = nearest_face(local, size);
        (add_scaled(local, face, (radius - depth) / 2.0), face, -depth)
    } else {
        let deepest = add_scaled(local, inward, radius);
        (add_scaled(scale(nearest, 0.5), deepest, 0.5), inward, gap)
    };
    Some(PreContact {
        dist: gap - radius,
        pos: add(mul_mat_vec(&cuboid.mat, pos), cuboid.pos),
        normal: mul_mat_vec(&cuboid.mat, normal),
        tangent: [0.0; 3],
    })
}

/// Inward normal of, and distance to, the face of a box nearest to an inner point.
fn nearest_face(point: Vec3, size: Vec3) -> (Vec3, f64) {
    let mut depth = (size[0] + size[1] + size[2]) * 2.0;
    let mut inward = [0.0; 3];
    for i in 0..3 {
        for side in [-1.0, 1.0] {
            let d = (side * size[i] - point[i]).abs();
            if depth > d {
                depth = d;
                inward = [0.0; 3];
                inward[i] = -side;
            }
        }
    }
    (inward, depth)
}
