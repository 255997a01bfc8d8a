//! Tendon paths, lengths and Jacobians (documentation: Computation, "Tendon").
//!
//! A fixed tendon is a linear combination of joint positions. A spatial tendon is the shortest path through its
//! sites, around its wrapping geoms; a pulley divides the path into branches whose length counts `1/divisor`.

use crate::chain::{MergedChain, com_offset, point_column, site_point};
use crate::data::{Com, Kinematics, State, Tendons};
use crate::math::{Vec3, distance, dot, dot_sparse, normalize, sub};
use crate::model::{Model, WrapType};
use crate::wrap::{Wrap, WrapShape, wrap};

/// Entry of `wrap_obj` for a point on a site.
const ON_SITE: i32 = -1;
/// Entry of `wrap_obj` for a pulley.
const PULLEY: i32 = -2;

/// Computes every tendon's path, length and row of the Jacobian.
pub fn tendon(m: &Model, state: &State, kin: &Kinematics, com: &Com, ten: &mut Tendons) {
    ten.ten_J.fill(0.0);
    let mut path = Path { count: 0 };
    for i in 0..m.ntendon {
        let begin = path.count;
        let adr = m.tendon_adr[i] as usize;
        ten.ten_wrapadr[i] = begin as i32;
        ten.ten_length[i] = if m.wrap_type[adr] == WrapType::Joint.code() {
            fixed_tendon(m, state, i, ten)
        } else {
            spatial_tendon(m, kin, com, i, ten, &mut path)
        };
        ten.ten_wrapnum[i] = (path.count - begin) as i32;
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

fn fixed_tendon(m: &Model, state: &State, i: usize, ten: &mut Tendons) -> f64 {
    let adr = m.tendon_adr[i] as usize;
    let mut length = 0.0;
    for w in adr..adr + m.tendon_num[i] as usize {
        let (joint, coefficient) = (m.wrap_objid[w] as usize, m.wrap_prm[w]);
        length += coefficient * state.qpos[m.jnt_qposadr[joint] as usize];
        let at = row(m, i).find(|&k| m.ten_J_colind[k] == m.jnt_dofadr[joint]);
        if let Some(k) = at {
            ten.ten_J[k] += coefficient;
        }
    }
    length
}

/// Writer of `wrap_xpos` and `wrap_obj`, which hold the paths of all tendons one after the other.
struct Path {
    count: usize,
}

impl Path {
    fn push(&mut self, ten: &mut Tendons, point: Vec3, object: i32) {
        ten.wrap_xpos.as_flattened_mut()[3 * self.count..3 * self.count + 3].copy_from_slice(&point);
        ten.wrap_obj.as_flattened_mut()[self.count] = object;
        self.count += 1;
    }
}

/// A point that moves with a body.
type Anchor = (usize, Vec3);

fn spatial_tendon(
    m: &Model,
    kin: &Kinematics,
    com: &Com,
    i: usize,
    ten: &mut Tendons,
    path: &mut Path,
) -> f64 {
    let adr = m.tendon_adr[i] as usize;
    let end = adr + m.tendon_num[i] as usize;
    let is_pulley = |w: usize| m.wrap_type[w] == WrapType::Pulley.code();
    let (mut divisor, mut length, mut w) = (1.0, 0.0, adr);
    while w + 1 < end {
        if is_pulley(w) {
            divisor = m.wrap_prm[w];
            path.push(ten, [0.0; 3], PULLEY);
        }
        if is_pulley(w) || is_pulley(w + 1) {
            w += 1;
            continue;
        }
        let shape = wrapping_shape(m.wrap_type[w + 1]);
        let next = if shape.is_some() { w + 2 } else { w + 1 };
        let first = site_point(m, kin, m.wrap_objid[w] as usize);
        let last = site_point(m, kin, m.wrap_objid[next] as usize);
        let pull =
            |a: Anchor, b: Anchor, j: &mut [f64]| add_segment(m, com, row(m, i), a, b, 1.0 / divisor, j);
        path.push(ten, first.1, ON_SITE);
        match shape.and_then(|shape| wrap_around(m, kin, shape, w + 1, [first.1, last.1])) {
            Some(touch) => {
                let geom = m.wrap_objid[w + 1];
                let [enter, leave] = touch.points.map(|p| (m.geom_bodyid[geom as usize] as usize, p));
                length += (distance(first.1, enter.1) + touch.length + distance(leave.1, last.1)) / divisor;
                pull(first, enter, &mut ten.ten_J);
                pull(leave, last, &mut ten.ten_J);
                path.push(ten, enter.1, geom);
                path.push(ten, leave.1, geom);
            }
            None => {
                length += distance(first.1, last.1) / divisor;
                pull(first, last, &mut ten.ten_J);
            }
        }
        w = next;
        if w + 1 == end || is_pulley(w + 1) {
            path.push(ten, last.1, ON_SITE);
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

/// Adds to one row of the Jacobian, at `entries` of `jacobian`, the rate of change of the distance between two
/// points, times `scale`. Both the columns of the row and the chain of the two bodies are sorted.
fn add_segment(
    m: &Model,
    com: &Com,
    entries: std::ops::Range<usize>,
    from: Anchor,
    to: Anchor,
    scale: f64,
    jacobian: &mut [f64],
) {
    if from.0 == to.0 {
        return;
    }
    let direction = normalize(sub(to.1, from.1)).0;
    let offsets = [com_offset(m, com, from.0, from.1), com_offset(m, com, to.0, to.1)];
    let mut entries = entries.rev();
    for (dof, moves) in MergedChain::new(m, from.0, to.0) {
        let column = |end: usize| if moves[end] { point_column(com, dof, offsets[end]) } else { [0.0; 3] };
        let rate = dot(sub(column(1), column(0)), direction);
        if let Some(k) = entries.find(|&k| m.ten_J_colind[k] <= dof as i32) {
            jacobian[k] += scale * rate;
        }
    }
}
