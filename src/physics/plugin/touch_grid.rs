//! `mujoco.sensor.touch_grid`: contact forces on the body of a site as pictures, by azimuth and elevation seen from the
//! site along its negative z axis. One picture a channel: normal, two tangential forces, then the torques. In pictures of the
//! scene a plate stands in every cell that is touched, as far from the site as the contacts in it are on average.

use crate::acceleration::contact_force::contact_force;
use crate::math::{
    Vec3, add, column, mat_to_quat, mul_mat_t_vec, mul_mat_vec, norm, ops, quat_from_axis_angle, quat_mul,
    quat_to_mat, scale, sub,
};
use crate::model::{
    Appearance, AppearanceInputs, AttributeError, Capability, Config, GeomType, Instance, Mark, Model,
    ObjType, Plugin, SensorInputs, SensorType,
};
use crate::stages::{AccelerationInputs, Contact};
use std::f64::consts::PI;

/// The plugin.
#[derive(Debug)]
pub(super) struct TouchGrid;

impl Plugin for TouchGrid {
    fn name(&self) -> &str {
        "mujoco.sensor.touch_grid"
    }

    fn attributes(&self) -> &[&str] {
        &["nchannel", "size", "fov", "gamma"]
    }

    fn capabilities(&self) -> &[Capability] {
        &[Capability::Sensor]
    }

    fn readings(&self, config: &Config) -> Result<usize, AttributeError> {
        let Format { channels, size } = format(config)?;
        Ok(channels * size[0] * size[1])
    }

    fn instance(&self, config: &Config, m: &Model, id: usize) -> Result<Box<dyn Instance>, AttributeError> {
        let Format { channels, size } = format(config)?;
        let fov = config.numbers("fov")?;
        let fov = match fov[..] {
            [x, y] if x > 0.0 && x <= 180.0 && y > 0.0 && y <= 90.0 => [x, y],
            _ => return Err("attribute 'fov': write two angles in degrees, at most 180 and 90".into()),
        };
        let gamma = config.number("gamma")?.unwrap_or_default();
        if !(0.0..=1.0).contains(&gamma) {
            return Err("attribute 'gamma' must be between 0 and 1".into());
        }
        let mut sensors = (0..m.nsensor)
            .filter(|&i| m.sensor_type[i] == SensorType::Plugin.code() && m.sensor_plugin[i] == id as i32);
        let first = sensors.next();
        if first.into_iter().chain(sensors).any(|i| m.sensor_objtype[i] != ObjType::Site.code()) {
            return Err("its sensor must be at a site: set objtype=\"site\" and 'objname'".into());
        }
        let edges = [0, 1].map(|axis| edges(size[axis], fov[axis], gamma));
        Ok(Box::new(Grid { channels, edges, sensor: first }))
    }
}

/// Number and size of the pictures.
struct Format {
    channels: usize,
    size: [usize; 2],
}

/// Most cells of a picture along one axis.
const MOST: f64 = 4096.0;

fn format(config: &Config) -> Result<Format, AttributeError> {
    let channels = match config.number("nchannel")?.unwrap_or_default().trunc() {
        0.0 => 1.0,
        n if (1.0..=6.0).contains(&n) => n,
        n => return Err(format!("attribute 'nchannel' is {n}: from 1 to 6 channels there are").into()),
    };
    match config.numbers("size")?[..] {
        [x, y] if [x, y].iter().all(|n| (1.0..=MOST).contains(n)) => {
            Ok(Format { channels: channels as usize, size: [x as usize, y as usize] })
        }
        _ => Err(format!("attribute 'size': write two whole numbers from 1 to {MOST}").into()),
    }
}

/// Angles between the cells of one axis \[rad\]; finer in the middle with a positive `gamma`.
fn edges(cells: usize, fov: f64, gamma: f64) -> Vec<f64> {
    let step = 2.0 / cells as f64;
    let scale = fov * PI / 180.0;
    let mut next = -1.0;
    (0..=cells)
        .map(|_| {
            let x = next;
            next += step;
            let deformed = if gamma == 0.0 { x } else { gamma * ops::pow(x, 5.0) + (1.0 - gamma) * x };
            deformed * scale
        })
        .collect()
}

/// An instance.
#[derive(Debug)]
struct Grid {
    channels: usize,
    /// Edges of the cells, of azimuth and elevation.
    edges: [Vec<f64>; 2],
    /// The sensor that is read; further ones of the instance stay at zero, as MuJoCo leaves them.
    sensor: Option<usize>,
}

/// The cell that holds `x`, which may lie on its upper edge.
fn cell(edges: &[f64], x: f64) -> Option<usize> {
    let above = edges.partition_point(|&edge| edge < x);
    (above > 0 && above < edges.len()).then(|| above - 1)
}

/// Normal, then the two tangents.
fn normal_first([x, y, z]: Vec3) -> Vec3 {
    [z, x, y]
}

impl Grid {
    fn fill(&self, m: &Model, inputs: &AccelerationInputs, site: usize, out: &mut [f64]) {
        let body = m.body_weldid[m.site_bodyid[site] as usize];
        let mat = &inputs.kin.site_xmat[site];
        let [width, height] = self.size();
        for (contact, bodies, place) in touches(m, inputs, site) {
            let Some(at) = self.cell_of(place) else { continue };
            let wrench = contact_force(m, inputs.efc, contact);
            // From the smaller to the larger body.
            let sign = if body < bodies[0].max(bodies[1]) { -1.0 } else { 1.0 };
            let at_site = |part: Vec3| {
                let local = mul_mat_t_vec(mat, mul_mat_t_vec(&contact.frame, part));
                normal_first(local.map(|x| sign * x))
            };
            let force = at_site([wrench[0], wrench[1], wrench[2]]);
            let torque = at_site([wrench[3], wrench[4], wrench[5]]);
            for (channel, value) in force.into_iter().chain(torque).take(self.channels).enumerate() {
                out[channel * width * height + at[1] * width + at[0]] += value;
            }
        }
    }

    /// Cells along azimuth and elevation.
    fn size(&self) -> [usize; 2] {
        [0, 1].map(|axis| self.edges[axis].len() - 1)
    }

    /// The cells with contacts, along azimuth first, and the mean distance of their contacts \[m\].
    fn touched(&self, m: &Model, inputs: &AccelerationInputs, site: usize) -> Vec<([usize; 2], f64)> {
        let mut found: Vec<([usize; 2], f64)> = touches(m, inputs, site)
            .filter_map(|(.., place)| Some((self.cell_of(place)?, norm(place))))
            .collect();
        found.sort_by_key(|&(cell, _)| cell);
        let mean = |same: &[([usize; 2], f64)]| {
            (same[0].0, same.iter().map(|(_, distance)| distance).sum::<f64>() / same.len() as f64)
        };
        found.chunk_by(|(cell, _), (next, _)| cell == next).map(mean).collect()
    }

    /// The plate in a cell, `distance` from the site.
    fn plate(&self, inputs: &AppearanceInputs, sensor: usize, cell: [usize; 2], distance: f64) -> Mark {
        let site = inputs.m.sensor_objid[sensor] as usize;
        let (pos, mat) = (inputs.at.kin.site_xpos[site], &inputs.at.kin.site_xmat[site]);
        let ends = |axis: usize| [self.edges[axis][cell[axis]], self.edges[axis][cell[axis] + 1]];
        let [azimuth, elevation] = [0, 1].map(|axis| 0.5 * (ends(axis)[0] + ends(axis)[1]));
        let half = |axis: usize| 0.5 * distance * (ends(axis)[1] - ends(axis)[0]);
        let away = distance * (1.0 - THICKNESS);
        let (level, height) = (away * ops::cos(elevation), away * ops::sin(elevation));
        let local = [level * ops::sin(azimuth), height, -level * ops::cos(azimuth)];
        let turned = quat_mul(
            quat_from_axis_angle(scale(column(mat, 1), -1.0), azimuth),
            quat_mul(quat_from_axis_angle(column(mat, 0), elevation), mat_to_quat(mat)),
        );
        Mark {
            shape: GeomType::Box,
            size: [half(0), half(1), distance * THICKNESS],
            pos: add(mul_mat_vec(mat, local), pos),
            mat: quat_to_mat(turned),
            rgba: [1.0; 4],
            id: sensor,
        }
    }

    /// The cell in whose direction `p` is seen.
    fn cell_of(&self, [x, y, z]: Vec3) -> Option<[usize; 2]> {
        let azimuth = ops::atan2(x, -z);
        let elevation = ops::atan2(y, ops::sqrt(x * x + z * z));
        Some([cell(&self.edges[0], azimuth)?, cell(&self.edges[1], elevation)?])
    }
}

/// Half thickness of a plate, in its distances.
const THICKNESS: f64 = 0.02;

/// The contacts on the body of a site, with the bodies of both and where they are in the site's frame \[m\].
fn touches<'a>(
    m: &'a Model,
    inputs: &'a AccelerationInputs,
    site: usize,
) -> impl Iterator<Item = (&'a Contact, [i32; 2], Vec3)> {
    let body = m.body_weldid[m.site_bodyid[site] as usize];
    let (pos, mat) = (inputs.kin.site_xpos[site], &inputs.kin.site_xmat[site]);
    inputs.con.contact.iter().filter_map(move |contact| {
        let bodies = bodies(m, contact.geom)?;
        let touches = bodies.iter().any(|&b| m.body_weldid[b as usize] == body);
        touches.then(|| (contact, bodies, mul_mat_t_vec(mat, sub(contact.pos, pos))))
    })
}

/// The bodies of two geoms; `None` where one is no geom.
fn bodies(m: &Model, geoms: [i32; 2]) -> Option<[i32; 2]> {
    let [a, b] = geoms.map(|g| usize::try_from(g).ok().map(|g| m.geom_bodyid[g]));
    Some([a?, b?])
}

impl Instance for Grid {
    fn appearance(&self, inputs: &AppearanceInputs, out: &mut Appearance) {
        let Some(sensor) = self.sensor else { return };
        let (m, [width, height]) = (inputs.m, self.size());
        let first = m.sensor_adr[sensor] as usize;
        let readings = &inputs.readings[first..];
        let cells = width * height;
        let strongest = readings[..cells].iter().fold(0.0_f64, |most, x| most.max(x.abs()));
        if strongest == 0.0 {
            return;
        }
        let site = m.sensor_objid[sensor] as usize;
        for (cell, distance) in self.touched(m, &inputs.at, site) {
            if distance == 0.0 {
                continue;
            }
            let mut plate = self.plate(inputs, sensor, cell, distance);
            for (channel, part) in plate.rgba[..self.channels.min(3)].iter_mut().enumerate() {
                *part = (readings[channel * cells + cell[1] * width + cell[0]].abs() / strongest) as f32;
            }
            out.add_mark(plate);
        }
    }

    fn read(&self, m: &Model, inputs: &SensorInputs, sensor: usize, out: &mut [f64]) {
        if let (SensorInputs::Acceleration(inputs), true) = (inputs, self.sensor == Some(sensor)) {
            self.fill(m, inputs, m.sensor_objid[sensor] as usize, out);
        }
    }
}
