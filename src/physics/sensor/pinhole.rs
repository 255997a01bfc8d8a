//! Camera geometry: intrinsic parameters in pixels, projection of points, rays of pixels.

use crate::math::{Vec3, add, column, mul_mat_t_vec, mul_mat_vec, normalize, ops, scale, sub};
use crate::model::bounds::MINVAL;
use crate::model::{Model, Projection};
use crate::ray::Ray;
use crate::stages::Kinematics;
use std::f64::consts::PI;

/// Focal lengths of a perspective camera, from its sensor if it has one, else from its field of view \[pixel\].
fn focal_lengths(m: &Model, camera: usize) -> [f64; 2] {
    if has_sensor(m, camera) {
        [on_sensor(m, camera, 0, 0), on_sensor(m, camera, 1, 1)]
    } else {
        [0.5 / ops::tan(m.cam_fovy[camera] * PI / 360.0) * f64::from(m.cam_resolution[camera][1]); 2]
    }
}

fn has_sensor(m: &Model, camera: usize) -> bool {
    m.cam_sensorsize[camera].iter().all(|&side| side != 0.0)
}

/// Intrinsic parameter `k`, a length along `side` of the sensor, in pixels; MuJoCo computes it in single precision.
fn on_sensor(m: &Model, camera: usize, k: usize, side: usize) -> f64 {
    f64::from(
        m.cam_intrinsic[camera][k] / m.cam_sensorsize[camera][side] * m.cam_resolution[camera][side] as f32,
    )
}

/// Image coordinates of `point` in a camera, as if its principal point were the centre of the image \[pixel\].
pub(super) fn project(m: &Model, kin: &Kinematics, camera: usize, point: Vec3) -> [f64; 2] {
    let ([width, height], focal) = (m.cam_resolution[camera].map(f64::from), focal_lengths(m, camera));
    let p = mul_mat_t_vec(&kin.cam_xmat[camera], sub(point, kin.cam_xpos[camera]));
    let depth = if p[2].abs() < MINVAL { MINVAL.copysign(p[2]) } else { p[2] };
    [-focal[0] * (p[0] / depth) + 0.5 * width, focal[1] * (p[1] / depth) + 0.5 * height]
}

/// What turns pixels of a camera into rays.
#[derive(Clone, Copy, Debug)]
pub struct Pinhole {
    focal: [f64; 2],
    center: [f64; 2],
    /// Height of the view of an orthographic camera \[m\]; `None` for a perspective one.
    extent: Option<f64>,
}

impl Pinhole {
    /// The pinhole of a camera of the model.
    pub fn of_camera(m: &Model, camera: usize) -> Self {
        let size = m.cam_resolution[camera].map(f64::from);
        let half = [size[0] / 2.0, size[1] / 2.0];
        if m.cam_projection[camera] == Projection::Orthographic.code() {
            return Pinhole { focal: half, center: half, extent: Some(m.cam_fovy[camera]) };
        }
        let center = if has_sensor(m, camera) {
            [on_sensor(m, camera, 2, 0), on_sensor(m, camera, 3, 1)]
        } else {
            half
        };
        Pinhole { focal: focal_lengths(m, camera), center, extent: None }
    }

    /// Ray of the pixel in column `x` and row `y`, counted from the top left.
    pub fn pixel_ray(&self, kin: &Kinematics, camera: usize, x: usize, y: usize) -> Ray {
        let (pos, mat) = (kin.cam_xpos[camera], &kin.cam_xmat[camera]);
        let across = (x as f64 + 0.5 - self.center[0]) / self.focal[0];
        let down = (y as f64 + 0.5 - self.center[1]) / self.focal[1];
        match self.extent {
            None => Ray { origin: pos, direction: normalize(mul_mat_vec(mat, [across, -down, -1.0])).0 },
            Some(extent) => {
                let half = extent / 2.0;
                let offset = mul_mat_vec(mat, [across * half, -down * half, 0.0]);
                Ray { origin: add(pos, offset), direction: scale(column(mat, 2), -1.0) }
            }
        }
    }
}
