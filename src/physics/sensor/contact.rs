//! Sensors that read contacts: `touch` and `contact`.

use super::zone::inside_site;
use crate::acceleration::contact_force::contact_force;
use crate::math::{Vec3, add, add_scaled, cross, dot, mul_mat_t_vec, norm, normalize, row, scale, sub};
use crate::model::bounds::MINVAL;
use crate::model::flex::representative;
use crate::model::{ContactField, GeomType, Model, ObjType};
use crate::ray::{Ray, ray_shape};
use crate::stages::{AccelerationInputs, Contact};

/// Ways in which a `contact` sensor chooses among its contacts.
mod reduce {
    pub const MINDIST: i32 = 1;
    pub const MAXFORCE: i32 = 2;
    pub const NETFORCE: i32 = 3;
}

/// A contact that a sensor sees.
#[derive(Clone, Copy, Debug)]
pub(super) struct Match {
    /// Smaller comes first.
    criterion: f64,
    contact: usize,
    /// The normal points from the second object to the first.
    flip: bool,
}

fn bodies(m: &Model, c: &Contact) -> [i32; 2] {
    [0, 1].map(|side| representative(m, c, side) as i32)
}

/// Sum of the normal forces on the body of a site, of contacts in its volume or whose normal passes through it.
pub(super) fn touch(m: &Model, d: &AccelerationInputs, site: usize) -> f64 {
    let Some(shape) = GeomType::from_code(m.site_type[site]) else { return 0.0 };
    let own = m.site_bodyid[site];
    let mut sum = 0.0;
    for c in d.con.contact.iter().filter(|c| c.efc_address >= 0) {
        let between = bodies(m, c);
        if !between.contains(&own) {
            continue;
        }
        let force = contact_force(m, d.efc, c)[0];
        if force <= 0.0 {
            continue;
        }
        let normal = normalize(scale(row(&c.frame, 0), force)).0;
        let direction = if between[1] == own { scale(normal, -1.0) } else { normal };
        let beam = Ray { origin: c.pos, direction };
        if ray_shape(shape, m.site_size[site], d.kin.site_xpos[site], &d.kin.site_xmat[site], beam).is_some()
        {
            sum += force;
        }
    }
    sum
}

/// Fills the slots of `contact` sensor `i`; slots without a contact stay zero.
pub(super) fn contact(
    m: &Model,
    d: &AccelerationInputs,
    i: usize,
    matches: &mut Vec<Match>,
    out: &mut [f64],
) {
    let [fields, reduction, _] = m.sensor_intprm[i];
    matches.clear();
    for (k, c) in d.con.contact.iter().enumerate() {
        if let Some(flip) = direction(m, d, i, c) {
            let criterion = match reduction {
                reduce::MINDIST => c.dist,
                reduce::MAXFORCE => {
                    let force = contact_force(m, d.efc, c);
                    -dot([force[0], force[1], force[2]], [force[0], force[1], force[2]])
                }
                _ => 0.0,
            };
            matches.push(Match { criterion, contact: k, flip });
        }
    }
    let found = matches.len() as f64;
    if reduction == reduce::NETFORCE {
        net(m, d, matches, found).write(fields, out);
        return;
    }
    matches.sort_unstable_by(|a, b| a.criterion.total_cmp(&b.criterion).then(a.contact.cmp(&b.contact)));
    let size = Reading::size(fields);
    if size > 0 {
        for (slot, seen) in out.chunks_exact_mut(size).zip(matches.iter()) {
            Reading::of_contact(m, d, *seen, found).write(fields, slot);
        }
    }
}

/// Whether the sensor sees a contact, and if so, whether its normal must be turned round.
fn direction(m: &Model, d: &AccelerationInputs, i: usize, c: &Contact) -> Option<bool> {
    let objects = [(m.sensor_objtype[i], m.sensor_objid[i]), (m.sensor_reftype[i], m.sensor_refid[i])];
    let given = objects.map(|(kind, _)| kind != ObjType::Unknown.code());
    if objects[0].0 == ObjType::Site.code() && !inside_site(m, d.kin, objects[0].1 as usize, c.pos) {
        return None;
    }
    let between = bodies(m, c);
    let sees = |object: usize, side: usize| is_part(m, between[side], c.geom[side], objects[object]);
    let [first, second] = [[sees(0, 0), sees(0, 1)], [sees(1, 0), sees(1, 1)]];
    if !(first[0] || first[1]) || !(second[0] || second[1]) {
        return None;
    }
    match given {
        [false, false] => Some(false),
        [true, false] => Some(!first[0]),
        [false, true] => Some(!second[1]),
        [true, true] if first[0] && second[1] => Some(false),
        [true, true] if first[1] && second[0] => Some(true),
        [true, true] => None,
    }
}

/// True when a geom or its body is, or belongs to, a sensor's object; anything belongs to no object and to a site.
fn is_part(m: &Model, body: i32, geom: i32, (kind, id): (i32, i32)) -> bool {
    match ObjType::from_code(kind) {
        Some(ObjType::Unknown | ObjType::Site) => true,
        Some(ObjType::Geom) => geom == id,
        Some(ObjType::Body) => body == id,
        Some(ObjType::Xbody) => {
            let mut ancestor = body;
            while ancestor > id {
                ancestor = m.body_parentid[ancestor as usize];
            }
            ancestor == id
        }
        _ => false,
    }
}

/// The data of one slot.
struct Reading {
    found: f64,
    force: Vec3,
    torque: Vec3,
    dist: f64,
    pos: Vec3,
    normal: Vec3,
    tangent: Vec3,
}

impl Reading {
    /// Data of one contact, force and torque in its frame. A turned frame is rotated half a turn about its third
    /// axis.
    fn of_contact(m: &Model, d: &AccelerationInputs, seen: Match, found: f64) -> Self {
        let c = &d.con.contact[seen.contact];
        let w = contact_force(m, d.efc, c);
        let sign = if seen.flip { -1.0 } else { 1.0 };
        Reading {
            found,
            force: [w[0], w[1], sign * w[2]],
            torque: [w[3], w[4], sign * w[5]],
            dist: c.dist,
            pos: c.pos,
            normal: scale(row(&c.frame, 0), sign),
            tangent: scale(row(&c.frame, 1), sign),
        }
    }

    fn fields(&self) -> [(ContactField, &[f64]); 7] {
        [
            (ContactField::Found, std::slice::from_ref(&self.found)),
            (ContactField::Force, &self.force),
            (ContactField::Torque, &self.torque),
            (ContactField::Dist, std::slice::from_ref(&self.dist)),
            (ContactField::Pos, &self.pos),
            (ContactField::Normal, &self.normal),
            (ContactField::Tangent, &self.tangent),
        ]
    }

    fn write(&self, fields: i32, out: &mut [f64]) {
        let mut next = 0;
        for (field, values) in self.fields() {
            if fields & (1 << field.code()) != 0 {
                out[next..next + values.len()].copy_from_slice(values);
                next += values.len();
            }
        }
    }

    /// Number of scalars in one slot.
    fn size(fields: i32) -> usize {
        let nothing = Reading {
            found: 0.0,
            force: [0.0; 3],
            torque: [0.0; 3],
            dist: 0.0,
            pos: [0.0; 3],
            normal: [0.0; 3],
            tangent: [0.0; 3],
        };
        nothing.fields().iter().filter(|(f, _)| fields & (1 << f.code()) != 0).map(|(_, v)| v.len()).sum()
    }
}

/// Total wrench of all contacts in the world frame, about the centroid of their positions weighted by force.
fn net(m: &Model, d: &AccelerationInputs, matches: &[Match], found: f64) -> Reading {
    let wrench = |seen: &Match| {
        let c = &d.con.contact[seen.contact];
        let sign = if seen.flip { -1.0 } else { 1.0 };
        let w = contact_force(m, d.efc, c).map(|x| x * sign);
        (c, [w[0], w[1], w[2]], [w[3], w[4], w[5]])
    };
    let (mut pos, mut total) = ([0.0; 3], 0.0);
    for seen in matches {
        let (c, force, _) = wrench(seen);
        let weight = norm(force);
        pos = add_scaled(pos, c.pos, weight);
        total += weight;
    }
    pos = scale(pos, 1.0 / f64::max(total, MINVAL));
    let (mut force, mut torque) = ([0.0; 3], [0.0; 3]);
    for seen in matches {
        let (c, f, t) = wrench(seen);
        let f = mul_mat_t_vec(&c.frame, f);
        force = add(force, f);
        torque = add(add(torque, mul_mat_t_vec(&c.frame, t)), cross(sub(c.pos, pos), f));
    }
    Reading { found, force, torque, dist: 0.0, pos, normal: [1.0, 0.0, 0.0], tangent: [0.0, 1.0, 0.0] }
}
