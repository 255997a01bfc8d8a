//! Rangefinders: one ray along the z axis of a site, or one for every pixel of a camera.
//!
//! MuJoCo casts the rays of a camera together and skips bodies by spheres that ignore the body's rotation, so
//! that it misses a few surfaces; here every ray ends on the nearest one.

use super::pinhole::Pinhole;
use crate::math::{Vec3, add_scaled, column, dot, sub};
use crate::model::{Model, ObjType, RayField};
use crate::ray::{Hit, Ray, RayFilter, ray};
use crate::stages::Kinematics;

/// Fills `out` with the chosen fields of every ray, row by row.
pub(super) fn rangefinder(m: &Model, kin: &Kinematics, i: usize, out: &mut [f64]) {
    let (id, fields) = (m.sensor_objid[i] as usize, m.sensor_intprm[i][0]);
    let mut writer = Writer { out, next: 0 };
    if m.sensor_objtype[i] == ObjType::Site.code() {
        let beam = Ray { origin: kin.site_xpos[id], direction: column(&kin.site_xmat[id], 2) };
        let hit = cast(m, kin, beam, m.site_bodyid[id]);
        writer.ray(fields, beam, hit, |_, distance| distance);
        return;
    }
    let (pinhole, [width, height]) = (Pinhole::of_camera(m, id), m.cam_resolution[id]);
    let (eye, backward) = (kin.cam_xpos[id], column(&kin.cam_xmat[id], 2));
    for y in 0..height as usize {
        for x in 0..width as usize {
            let beam = pinhole.pixel_ray(kin, id, x, y);
            let hit = cast(m, kin, beam, m.cam_bodyid[id]);
            writer.ray(fields, beam, hit, |point, _| -dot(sub(point, eye), backward));
        }
    }
}

fn cast(m: &Model, kin: &Kinematics, beam: Ray, own_body: i32) -> Option<Hit> {
    let filter = RayFilter { exclude_body: usize::try_from(own_body).ok(), ..RayFilter::default() };
    ray(m, kin, beam, filter).map(|(_, hit)| hit)
}

/// Appends fields to a reading.
struct Writer<'a> {
    out: &'a mut [f64],
    next: usize,
}

impl Writer<'_> {
    fn push(&mut self, values: &[f64]) {
        self.out[self.next..self.next + values.len()].copy_from_slice(values);
        self.next += values.len();
    }

    /// Writes the fields of one ray; a miss has distance and depth -1, its origin, and zeros.
    fn ray(&mut self, fields: i32, beam: Ray, hit: Option<Hit>, depth: impl Fn(Vec3, f64) -> f64) {
        let has = |field: RayField| fields & (1 << field.code()) != 0;
        let point = hit.map(|h| add_scaled(beam.origin, beam.direction, h.distance));
        if has(RayField::Dist) {
            self.push(&[hit.map_or(-1.0, |h| h.distance)]);
        }
        if has(RayField::Dir) {
            self.push(&hit.map_or([0.0; 3], |_| beam.direction));
        }
        if has(RayField::Origin) {
            self.push(&beam.origin);
        }
        if has(RayField::Point) {
            self.push(&point.unwrap_or([0.0; 3]));
        }
        if has(RayField::Normal) {
            self.push(&hit.map_or([0.0; 3], |h| h.normal));
        }
        if has(RayField::Depth) {
            self.push(&[hit.zip(point).map_or(-1.0, |(h, p)| depth(p, h.distance))]);
        }
    }
}
