//! Cameras as things, with their frustums.

use super::ray::LINE;
use crate::scene::item::Shape;
use crate::scene::options::{FrameChoice, LabelChoice};
use crate::scene::sink::{Form, Items, Source, element};
use physics::math::{Vec3, add, add_scaled, column, cross, mul_mat_vec, norm, ops, scale, sub};
use physics::model::{ObjType, Projection};

/// Opacity of a camera whose frustum is shown.
const FAINT: f32 = 0.3;

/// Adds every camera: body, lens, and the frustum of one with a resolution.
pub(super) fn cameras(from: Source<'_>, items: &mut Items<'_>) {
    let Source { m, d, options, .. } = from;
    if !options.show.cameras {
        return;
    }
    let (size, [width, length]) = (from.size(m.vis.scale.camera), from.axis_size());
    for i in 0..m.ncam {
        let (mut rgba, object) = (m.vis.rgba.camera, element(ObjType::Camera, i));
        if m.cam_resolution[i].iter().any(|&n| n > 1) {
            rgba[3] = FAINT;
            add_frustum(from, i, items);
        }
        let (pos, mat) = (d.kin.cam_xpos[i], d.kin.cam_xmat[i]);
        let body = Form { shape: Shape::Box, size: [size, size * 0.8, size * 0.4], pos, mat };
        let item = items.decor(&body, rgba, object);
        if options.label == LabelChoice::Camera {
            item.label = from.label(ObjType::Camera, i);
        }
        let lens = Form {
            shape: Shape::Cylinder,
            size: [size * 0.4, size * 0.4, size * 0.3],
            pos: add_scaled(pos, column(&mat, 2), -0.6 * size),
            mat,
        };
        let [r, g, b, a] = rgba;
        items.decor(&lens, [0.5 * r, 0.5 * g, 0.5 * b, a], object);
        if options.frame == FrameChoice::Camera {
            items.axes(width, length, pos, &mat, i);
        }
    }
}

/// Left, right, lower and upper reach of a window, and its distance \[m\].
struct Window {
    reach: [f64; 4],
    distance: f64,
}

impl Window {
    /// The corners, counter-clockwise from the lower left.
    fn corners(&self, from: Source<'_>, camera: usize) -> [Vec3; 4] {
        let (kin, [left, right, below, above]) = (&from.d.kin, self.reach);
        [[-left, -below], [right, -below], [right, above], [-left, above]].map(|[x, y]| {
            add(mul_mat_vec(&kin.cam_xmat[camera], [x, y, -self.distance]), kin.cam_xpos[camera])
        })
    }
}

/// The near and the far end of the frustum that is shown. The far end of parallel rays is as far as the window is large.
fn windows(from: Source<'_>, i: usize) -> [Window; 2] {
    let m = from.m;
    let near = f64::from(m.vis.map.znear) * m.stat.extent;
    let far = from.size(m.vis.scale.frustum);
    let [columns, rows] = m.cam_resolution[i].map(f64::from);
    if m.cam_projection[i] == Projection::Orthographic.code() {
        let (high, wide) = (m.cam_fovy[i] / 2.0, m.cam_fovy[i] * (columns / rows) / 2.0);
        return [near, (high + wide) / 2.0]
            .map(|distance| Window { reach: [wide, wide, high, high], distance });
    }
    let ([sx, sy], [fx, fy, cx, cy]) =
        (m.cam_sensorsize[i].map(f64::from), m.cam_intrinsic[i].map(f64::from));
    let tangent = if sx != 0.0 && sy != 0.0 {
        [(sx / 2.0 - cx) / fx, (sx / 2.0 + cx) / fx, (sy / 2.0 - cy) / fy, (sy / 2.0 + cy) / fy]
    } else {
        let high = ops::tan(m.cam_fovy[i].to_radians() / 2.0);
        [high * (columns / rows), high * (columns / rows), high, high]
    };
    [near, far].map(|distance| Window { reach: tangent.map(|t| t * distance), distance })
}

/// Adds the four sides of a frustum, two triangles and three edges each.
fn add_frustum(from: Source<'_>, i: usize, items: &mut Items<'_>) {
    let (rgba, object) = (from.m.vis.rgba.frustum, element(ObjType::Camera, i));
    let [near, far] = windows(from, i).map(|window| window.corners(from, i));
    for (a, b) in [(0, 1), (1, 2), (2, 3), (3, 0)] {
        items.decor(&triangle([near[a], far[a], near[b]]), rgba, object);
        items.decor(&triangle([far[a], far[b], near[b]]), rgba, object);
        for [start, end] in [[near[a], near[b]], [far[a], far[b]], [near[a], far[a]]] {
            items.decor(&Form::connector(Shape::Line, LINE, start, end), rgba, object);
        }
    }
}

/// A triangle: its frame has the directions of two sides and the normal as columns, its sizes are their lengths.
fn triangle([corner, first, second]: [Vec3; 3]) -> Form {
    let (a, b) = (sub(first, corner), sub(second, corner));
    let normal = cross(a, b);
    let size = [a, b, normal].map(norm);
    let unit = |v: Vec3, length: f64| if length > 0.0 { scale(v, 1.0 / length) } else { [0.0; 3] };
    let (x, y, z) = (unit(a, size[0]), unit(b, size[1]), unit(normal, size[2]));
    let mat = [x[0], y[0], z[0], x[1], y[1], z[1], x[2], y[2], z[2]];
    Form { shape: Shape::Triangle, size, pos: corner, mat }
}
