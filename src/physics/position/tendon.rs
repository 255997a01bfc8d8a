//! Tendon paths, lengths and Jacobians (documentation: Computation, "Tendon").
//!
//! A fixed tendon is a linear combination of joint positions. A spatial tendon is the shortest path through its
//! sites, around its wrapping geoms; a pulley divides the path into branches whose length counts `1/divisor`.

use crate::math::{Vec3, dot, dot_sparse, norm, rotational, sub, unit};
use crate::model::{Model, WrapType};
use crate::position::chain::{com_offset, last_dof, point_column, site_point};
use crate::position::wrap::{Wrap, WrapShape, wrap};
use crate::sleep::{Awake, object};
use crate::stages::{Com, Kinematics, State, Tendons};

/// Entry of `wrap_obj` for a point on a site.
const ON_SITE: i32 = -1;
/// Entry of `wrap_obj` for a pulley.
const PULLEY: i32 = -2;

/// Computes every tendon's path, length and row of the Jacobian.
pub fn tendon(m: &Model, state: &State, kin: &Kinematics, com: &Com, ten: &mut Tendons) {
    let Tendons { ten_wrapadr, ten_wrapnum, ten_J, ten_length, wrap_obj, wrap_xpos } = ten;
    ten_J.fill(0.0);
    let (points, _) = wrap_xpos.as_flattened_mut().as_chunks_mut();
    let mut path = Path { points, objects: wrap_obj.as_flattened_mut(), count: 0 };
    let awake = Awake::of(m, state);
    for i in 0..m.ntendon {
        if awake.skips(|state| object::tendon(m, state, i)) {
            ten_length[i] = 0.0;
            continue;
        }
        let begin = path.count;
        let at = row(m, i);
        let row = Row { columns: &m.ten_J_colind[at.clone()], values: &mut ten_J[at] };
        ten_wrapadr[i] = begin as i32;
        ten_length[i] = if m.wrap_type[m.tendon_adr[i] as usize] == WrapType::Joint.code() {
            fixed_tendon(m, state, i, row)
        } else {
            spatial_tendon(m, kin, com, i, row, &mut path)
        };
        ten_wrapnum[i] = (path.count - begin) as i32;
    }
}

/// Velocities of all tendons.
pub fn tendon_velocity(m: &Model, state: &State, ten: &Tendons, ten_velocity: &mut [f64]) {
    for (i, velocity) in ten_velocity.iter_mut().enumerate() {
        let at = row(m, i);
        *velocity = dot_sparse(&ten.ten_J[at.clone()], &m.ten_J_colind[at], &state.qvel);
    }
}

/// Positions in `ten_J` of the row of tendon `i`.
pub fn row(m: &Model, i: usize) -> std::ops::Range<usize> {
    let start = m.ten_J_rowadr[i] as usize;
    start..start + m.ten_J_rownnz[i] as usize
}

fn fixed_tendon(m: &Model, state: &State, i: usize, row: Row) -> f64 {
    let adr = m.tendon_adr[i] as usize;
    let mut length = 0.0;
    for w in adr..adr + m.tendon_num[i] as usize {
        let (joint, coefficient) = (m.wrap_objid[w] as usize, m.wrap_prm[w]);
        length += coefficient * state.qpos[m.jnt_qposadr[joint] as usize];
        if let Some(k) = row.columns.iter().position(|&dof| dof == m.jnt_dofadr[joint]) {
            row.values[k] += coefficient;
        }
    }
    length
}

/// Writer of `wrap_xpos` and `wrap_obj`, which hold the paths of all tendons one after the other.
struct Path<'a> {
    points: &'a mut [Vec3],
    objects: &'a mut [i32],
    count: usize,
}

impl Path<'_> {
    fn push(&mut self, point: Vec3, object: i32) {
        self.points[self.count] = point;
        self.objects[self.count] = object;
        self.count += 1;
    }
}

/// A point that moves with a body.
type Anchor = (usize, Vec3);

/// Length of tendon `i`, whose path goes to `path` and whose row of the Jacobian is added to `row`.
fn spatial_tendon(m: &Model, kin: &Kinematics, com: &Com, i: usize, mut row: Row, path: &mut Path) -> f64 {
    let adr = m.tendon_adr[i] as usize;
    let end = adr + m.tendon_num[i] as usize;
    let is_pulley = |w: usize| m.wrap_type[w] == WrapType::Pulley.code();
    let (mut divisor, mut length, mut w) = (1.0, 0.0, adr);
    while w + 1 < end {
        if is_pulley(w) {
            divisor = m.wrap_prm[w];
            path.push([0.0; 3], PULLEY);
        }
        if is_pulley(w) || is_pulley(w + 1) {
            w += 1;
            continue;
        }
        let shape = wrapping_shape(m.wrap_type[w + 1]);
        let next = if shape.is_some() { w + 2 } else { w + 1 };
        let first = site_point(m, kin, m.wrap_objid[w] as usize);
        let last = site_point(m, kin, m.wrap_objid[next] as usize);
        let mut pull = |from: Anchor, to: Anchor| row.add_segment(m, com, from, to, 1.0 / divisor);
        path.push(first.1, ON_SITE);
        match shape.and_then(|shape| wrap_around(m, kin, shape, w + 1, [first.1, last.1])) {
            Some(touch) => {
                let geom = m.wrap_objid[w + 1];
                let [enter, leave] = touch.points.map(|p| (m.geom_bodyid[geom as usize] as usize, p));
                length += (pull(first, enter) + touch.length + pull(leave, last)) / divisor;
                path.push(enter.1, geom);
                path.push(leave.1, geom);
            }
            None => length += pull(first, last) / divisor,
        }
        w = next;
        if w + 1 == end || is_pulley(w + 1) {
            path.push(last.1, ON_SITE);
        }
    }
    length
}

fn wrapping_shape(code: i32) -> Option<WrapShape> {
    match WrapType::from_code(code) {
        Some(WrapType::Sphere) => Some(WrapShape::Sphere),
        Some(WrapType::Cylinder) => Some(WrapShape::Cylinder),
        _ => None,
    }
}

/// Wraps the segment between two sites around the geom of path element `w`, whose parameter is the side site.
fn wrap_around(m: &Model, kin: &Kinematics, shape: WrapShape, w: usize, ends: [Vec3; 2]) -> Option<Wrap> {
    let geom = m.wrap_objid[w] as usize;
    let side = (m.wrap_prm[w] >= 0.0).then(|| kin.site_xpos[m.wrap_prm[w].round() as usize]);
    wrap(shape, m.geom_size[geom][0], kin.geom_xpos[geom], &kin.geom_xmat[geom], ends, side)
}

/// Row of the Jacobian of one tendon: columns in increasing order, and their values.
struct Row<'a> {
    columns: &'a [i32],
    values: &'a mut [f64],
}

impl Row<'_> {
    /// Adds the rate of change of the distance between two points, times `scale`; returns the distance. The
    /// columns hold the chains of both bodies, so one walk down meets both.
    // A call passes the points through memory, where they are stored by halves and read whole, which stalls: a step of the muscle models
    // takes 5 to 30 % longer then.
    #[inline(always)]
    fn add_segment(&mut self, m: &Model, com: &Com, from: Anchor, to: Anchor, scale: f64) -> f64 {
        let span = sub(to.1, from.1);
        let distance = norm(span);
        if from.0 == to.0 {
            return distance;
        }
        let direction = unit(span, distance);
        let offsets = [com_offset(m, com, from.0, from.1), com_offset(m, com, to.0, to.1)];
        let [mut tail, mut head] = [last_dof(m, from.0), last_dof(m, to.0)];
        for (&dof, value) in self.columns.iter().zip(&mut *self.values).rev() {
            let column = |end: usize| point_column(com, dof as usize, offsets[end]);
            let translates = || rotational(&com.cdof[dof as usize]) == [0.0; 3];
            let rate = match (dof == tail, dof == head) {
                // Both ends alike: the distance stays.
                (true, true) if translates() => 0.0,
                (true, true) => dot(sub(column(1), column(0)), direction),
                (true, false) => -dot(column(0), direction),
                (false, true) => dot(column(1), direction),
                (false, false) => continue,
            };
            *value += scale * rate;
            let parent = m.dof_parentid[dof as usize];
            tail = if dof == tail { parent } else { tail };
            head = if dof == head { parent } else { head };
        }
        distance
    }
}
