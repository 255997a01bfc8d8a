//! Rays of rangefinders and nearest points of `fromto` sensors.

use crate::scene::item::Shape;
use crate::scene::sink::{Form, Items, Source, UPRIGHT, element};
use physics::math::{Vec3, add_scaled, column};
use physics::model::{ObjType, RayField, SensorType};
use physics::ray::Ray;
use physics::sensor::pinhole::Pinhole;

/// Width of lines, in units of `visual/global linewidth`.
pub(super) const LINE: f64 = 3.0;

/// Adds what rangefinders and `fromto` sensors measured.
pub(super) fn rays(from: Source<'_>, items: &mut Items<'_>) {
    let Source { m, d, options, .. } = from;
    if !options.show.rangefinders {
        return;
    }
    for i in 0..m.nsensor {
        let first = m.sensor_adr[i] as usize;
        let reading = &d.sensor.sensordata[first..first + m.sensor_dim[i] as usize];
        match SensorType::from_code(m.sensor_type[i]) {
            Some(SensorType::Rangefinder) => rangefinder(from, i, reading, items),
            Some(SensorType::Geomfromto) => {
                if let [a, b, c, x, y, z] = *reading
                    && reading.iter().any(|&x| x != 0.0)
                {
                    let form = Form::connector(Shape::Line, LINE, [a, b, c], [x, y, z]);
                    items.decor(&form, m.vis.rgba.rangefinder, element(ObjType::Sensor, i));
                }
            }
            _ => {}
        }
    }
}

/// Numbers of each field of a ray's reading, in their order.
const FIELDS: [(RayField, usize); 6] = [
    (RayField::Dist, 1),
    (RayField::Dir, 3),
    (RayField::Origin, 3),
    (RayField::Point, 3),
    (RayField::Normal, 3),
    (RayField::Depth, 1),
];

/// The part of a reading that is one field of the ray, where the sensor measures it.
fn field(fields: i32, reading: &[f64], wanted: RayField) -> Option<&[f64]> {
    let mut first = 0;
    for (field, count) in FIELDS.into_iter().filter(|(field, _)| fields & (1 << field.code()) != 0) {
        if field == wanted {
            return reading.get(first..first + count);
        }
        first += count;
    }
    None
}

/// Radius of the balls at the ends of rays, in widths of frame axes: for a single ray, and for the rays of a camera.
const DOTS: [f64; 2] = [1.5, 1.3];

fn rangefinder(from: Source<'_>, i: usize, reading: &[f64], items: &mut Items<'_>) {
    let (m, kin, id) = (from.m, &from.d.kin, from.m.sensor_objid[i] as usize);
    if m.sensor_objtype[i] == ObjType::Site.code() {
        let ray = Ray { origin: kin.site_xpos[id], direction: column(&kin.site_xmat[id], 2) };
        beam(from, i, (ray, DOTS[0]), reading, items);
    } else if m.sensor_objtype[i] == ObjType::Camera.code() {
        let (pinhole, [width, height]) =
            (Pinhole::of_camera(m, id), m.cam_resolution[id].map(|n| n.max(0) as usize));
        let each = reading.len() / (width * height).max(1);
        for pixel in 0..width * height {
            let ray = pinhole.pixel_ray(kin, id, pixel % width, pixel / width);
            beam(from, i, (ray, DOTS[1]), &reading[pixel * each..(pixel + 1) * each], items);
        }
    }
}

/// Adds what is known of one ray: a line as long as the distance, a ball at the point, an arrow along the normal.
fn beam(from: Source<'_>, i: usize, (ray, dot): (Ray, f64), reading: &[f64], items: &mut Items<'_>) {
    let (rgba, object) = (from.m.vis.rgba.rangefinder, element(ObjType::Sensor, i));
    let measured = |wanted| field(from.m.sensor_intprm[i][0], reading, wanted);
    let vector = |wanted| measured(wanted).and_then(|values| Vec3::try_from(values).ok());
    let [width, length] = from.axis_size();
    let mut end = None;
    if let Some(&[distance]) = measured(RayField::Dist)
        && distance >= 0.0
    {
        let point = add_scaled(ray.origin, ray.direction, distance);
        items.decor(&Form::connector(Shape::Line, LINE, ray.origin, point), rgba, object);
        end = Some(point);
    }
    if let Some(point) = vector(RayField::Point).filter(|point| *point != [0.0; 3]) {
        items.decor(&Form::ball(dot * width, point, &UPRIGHT), rgba, object);
        end = Some(point);
    }
    if let (Some(point), Some(normal)) = (end, vector(RayField::Normal)) {
        let tip = add_scaled(point, normal, 2.0 * length);
        items.decor(&Form::connector(Shape::ThinArrow, width, point, tip), rgba, object);
    }
}
