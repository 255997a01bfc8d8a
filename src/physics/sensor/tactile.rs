//! Touch over the points of a mesh (documentation: XML reference, `sensor/tactile`): how deep each lies inside what touches
//! the body, and how fast that slides past along the two tangents of the point.

use crate::collision::sdf::Distance;
use crate::math::{Vec3, add, dot, linear, mul_mat_t_vec, mul_mat_vec, quat_rotate, quat_to_mat, sub};
use crate::model::flex::representative;
use crate::model::{GeomType, Model};
use crate::position::frame::{Frame, geom_frame};
use crate::stages::AccelerationInputs;

/// The points of a sensor, fixed to its geom.
struct Skin<'a> {
    m: &'a Model,
    d: &'a AccelerationInputs<'a>,
    mesh: usize,
    geom: usize,
    /// The body that carries the geom, or the one that it is welded to.
    carrier: i32,
}

/// Writes three rows of one number a point into zeroed `out`: depth of penetration \[m\], then the speeds along the first
/// and the second tangent \[m/s\], summed over all geoms that a point lies in. Points have tangents where the mesh has
/// three normals a vertex; without, speeds are zero. `touched` is working memory.
///
/// Felt are geoms that the body is in contact with and that have signed distances: primitives, plugins, and meshes that
/// some geom of type `sdf` uses. As in MuJoCo, tangents are turned by the mesh's pose in its file only, not by the geom's
/// pose, and the other geom's velocity is taken at its centre.
///
/// Not inlined, so that models without such sensors do not pay for it.
#[inline(never)]
pub(super) fn tactile(
    m: &Model,
    d: &AccelerationInputs,
    i: usize,
    touched: &mut Vec<usize>,
    out: &mut [f64],
) {
    let [mesh, geom] = [m.sensor_objid[i] as usize, m.sensor_refid[i] as usize];
    let carrier = m.body_weldid[m.geom_bodyid[geom] as usize];
    let skin = Skin { m, d, mesh, geom, carrier };
    skin.find_touched(touched);
    for &other in touched.iter() {
        if let Some(distance) = Distance::of(m, other) {
            skin.feel(other, &distance, out);
        }
    }
}

impl Skin<'_> {
    /// Geoms in contact with the carrier, each once, in the order of contacts.
    fn find_touched(&self, touched: &mut Vec<usize>) {
        touched.clear();
        for contact in &self.d.con.contact {
            for side in [0, 1] {
                let body = representative(self.m, contact, side);
                let Ok(other) = usize::try_from(contact.geom[1 - side]) else { continue };
                if self.m.body_weldid[body] == self.carrier && !touched.contains(&other) {
                    touched.push(other);
                }
            }
        }
    }

    /// Adds what the points feel of geom `other`.
    fn feel(&self, other: usize, distance: &Distance, out: &mut [f64]) {
        let (m, d) = (self.m, self.d);
        let base = geom_frame(m, d.kin, other);
        let base_velocity = linear(&base.velocity(m, d.com, &d.vel.cvel));
        let own = geom_frame(m, d.kin, self.geom);
        let first = m.mesh_vertadr[self.mesh] as usize;
        let count = m.mesh_vertnum[self.mesh] as usize;
        let (depths, speeds) = out.split_at_mut(count);
        for (k, vertex) in m.mesh_vert[first..first + count].iter().enumerate() {
            let point = add(mul_mat_vec(&own.mat, vertex.map(f64::from)), own.pos);
            let seen = in_field(m, other, mul_mat_t_vec(&base.mat, sub(point, base.pos)));
            let depth = -distance.at(seen);
            if depth > 0.0 {
                depths[k] = depths[k].max(depth);
                let at = Frame { body: self.carrier as usize, pos: point, mat: own.mat };
                let slip = sub(linear(&at.velocity(m, d.com, &d.vel.cvel)), base_velocity);
                let tangents = self.tangents(k).into_iter().flatten();
                for (speed, tangent) in speeds.chunks_exact_mut(count).zip(tangents) {
                    speed[k] += dot(slip, tangent).abs();
                }
            }
        }
    }

    /// The two tangents at a point; `None` where the mesh has one normal a vertex.
    fn tangents(&self, point: usize) -> Option<[Vec3; 2]> {
        let (m, mesh) = (self.m, self.mesh);
        if m.mesh_normalnum[mesh] != 3 * m.mesh_vertnum[mesh] {
            return None;
        }
        let first = m.mesh_normaladr[mesh] as usize + 3 * point;
        let turned = |row: usize| quat_rotate(m.mesh_quat[mesh], m.mesh_normal[row].map(f64::from));
        Some([turned(first + 1), turned(first + 2)])
    }
}

/// A point in a geom's frame, where the field of its plugin is given: in the frame that its mesh had before it was centred.
fn in_field(m: &Model, geom: usize, p: Vec3) -> Vec3 {
    let field = m.geom_type[geom] == GeomType::Sdf.code() && m.geom_plugin[geom] >= 0;
    match usize::try_from(m.geom_dataid[geom]) {
        Ok(mesh) if field => add(mul_mat_vec(&quat_to_mat(m.mesh_quat[mesh]), p), m.mesh_pos[mesh]),
        _ => p,
    }
}
