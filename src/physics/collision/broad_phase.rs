//! Pairs of bodies and flexes that may touch: sweep and prune along the axis of largest spread of the geoms (Baraff 1992),
//! after filters by contact type, weld group and parent (documentation: Computation, "Pair selection").

use super::mixing::overridden;
use crate::math::{
    Mat3, Vec3, add, add_scaled, column, dot, mul_mat, mul_mat_vec, principal_axes, quat_to_mat,
};
use crate::math::{scale, sub};
use crate::model::flex::Flex;
use crate::model::{Disable, GeomType, Model};
use crate::sleep::{Awake, object};
use crate::stages::{Flexes, Kinematics};

/// Working memory and result of the broad phase.
#[derive(Clone, Debug, Default)]
pub struct BroadPhase {
    /// Body pairs as `body1 << 16 | body2` with `body1 < body2`, ascending, each once; flexes follow the bodies.
    pub pairs: Vec<u32>,
    bodies: Vec<usize>,
    boxes: Vec<Bounds>,
    ends: Vec<u64>,
    active: Vec<u32>,
}

/// Extent of a body along three axes.
#[derive(Clone, Copy, Debug)]
struct Bounds {
    min: Vec3,
    max: Vec3,
}

impl BroadPhase {
    /// Finds the pairs of bodies whose geoms may be within their margins; gives up soon after `most` of them.
    pub fn run(&mut self, m: &Model, awake: Awake, kin: &Kinematics, flexes: &Flexes, most: usize) {
        self.pairs.clear();
        self.pair_static_bodies(m, awake, most);
        self.bodies.clear();
        self.bodies.extend((1..m.nbody).filter(|&b| can_collide(m, b)));
        if m.nflex > 0 {
            self.bodies.extend((0..m.nflex).filter(|&f| flex_collides(m, f)).map(|f| m.nbody + f));
        }
        if self.bodies.len() > 1 {
            let frame = spread_frame(m, kin, flexes);
            self.boxes.clear();
            self.boxes.extend(self.bodies.iter().map(|&b| match b.checked_sub(m.nbody) {
                None => body_bounds(m, kin, b, &frame),
                Some(f) => flex_bounds(m, flexes, f, &frame),
            }));
            self.sort_ends();
            self.sweep(m, awake, most);
        }
        self.pairs.sort_unstable();
        self.pairs.dedup();
    }

    fn push(&mut self, b1: usize, b2: usize) {
        self.pairs.push(signature(b1.min(b2), b1.max(b2)));
    }

    /// The world, and static bodies with a plane, meet every body they are not welded to.
    fn pair_static_bodies(&mut self, m: &Model, awake: Awake, most: usize) {
        for b1 in 0..m.nbody {
            if self.pairs.len() > most {
                return;
            }
            let unbounded = || m.body_dofnum[m.body_weldid[b1] as usize] == 0 && has_plane(m, b1);
            if !can_collide(m, b1) || !(b1 == 0 && m.body_geomnum[0] > 0 || unbounded()) {
                continue;
            }
            for b2 in 0..m.nbody {
                if can_collide(m, b2) && bodies_match(m, awake, b1, b2) {
                    self.push(b1, b2);
                }
            }
            if m.nflex > 0 {
                self.pair_with_flexes(m, awake, b1);
            }
        }
    }

    /// A static body meets every flex that does not sleep.
    #[cold]
    fn pair_with_flexes(&mut self, m: &Model, awake: Awake, b: usize) {
        let awakes = |f: &usize| !awake.skips(|state| object::flex(m, state, *f));
        for f in (0..m.nflex).filter(awakes).filter(|&f| types_admit(m, b, m.nbody + f)) {
            self.push(b, m.nbody + f);
        }
    }

    /// Lower and upper ends along the first axis, ascending; equal ends keep the order of bodies. One key holds
    /// the end in single precision (order-preserving bits), then twice the body index, plus one for upper ends.
    fn sort_ends(&mut self) {
        let key = |x: f64, index: usize| (u64::from(ordered_bits(x as f32)) << 32) | index as u64;
        self.ends.clear();
        for (i, b) in self.boxes.iter().enumerate() {
            self.ends.push(key(b.min[0], 2 * i));
            self.ends.push(key(b.max[0], 2 * i + 1));
        }
        self.ends.sort_unstable();
    }

    fn sweep(&mut self, m: &Model, awake: Awake, most: usize) {
        self.active.clear();
        for k in 0..self.ends.len() {
            if self.pairs.len() > most {
                return;
            }
            let index = self.ends[k] as u32;
            let i = index / 2;
            if index % 2 == 1 {
                self.active.retain(|&a| a != i);
                continue;
            }
            for a in 0..self.active.len() {
                let j = self.active[a] as usize;
                if apart(&self.boxes[i as usize], &self.boxes[j]) {
                    continue;
                }
                let (b1, b2) = (self.bodies[i as usize], self.bodies[j]);
                if pair_matches(m, awake, b1, b2) {
                    self.push(b1, b2);
                }
            }
            self.active.push(i);
        }
    }
}

/// Key that sorts body pairs.
pub fn signature(b1: usize, b2: usize) -> u32 {
    ((b1 as u32) << 16) + b2 as u32
}

/// Bits of `x` that order as unsigned integers; both zeros are equal.
pub(super) fn ordered_bits(x: f32) -> u32 {
    let bits = (x + 0.0).to_bits();
    if bits >> 31 == 1 { !bits } else { bits | 1 << 31 }
}

/// No overlap along the second or third axis.
fn apart(a: &Bounds, b: &Bounds) -> bool {
    (1..3).any(|k| a.min[k] > b.max[k] || b.min[k] > a.max[k])
}

fn can_collide(m: &Model, b: usize) -> bool {
    m.body_contype[b] != 0 || m.body_conaffinity[b] != 0
}

fn flex_collides(m: &Model, f: usize) -> bool {
    m.flex_contype[f] != 0 || m.flex_conaffinity[f] != 0
}

fn has_plane(m: &Model, b: usize) -> bool {
    geoms(m, b).any(|g| m.geom_type[g] == GeomType::Plane.code())
}

/// Geoms of body `b`.
pub fn geoms(m: &Model, b: usize) -> std::ops::Range<usize> {
    let start = m.body_geomadr[b].max(0) as usize;
    start..start + m.body_geomnum[b] as usize
}

/// Contact types admit each other.
pub fn types_match(contype1: i32, conaffinity1: i32, contype2: i32, conaffinity2: i32) -> bool {
    contype1 & conaffinity2 != 0 || contype2 & conaffinity1 != 0
}

/// Two bodies may touch: not welded together, not both immobile, not parent and child, of matching types; neither do both
/// sleep, nor one where the other is fixed to the world.
pub(crate) fn bodies_match(m: &Model, awake: Awake, b1: usize, b2: usize) -> bool {
    let weld = [m.body_weldid[b1], m.body_weldid[b2]];
    let [w1, w2] = weld.map(|w| w as usize);
    if w1 == w2 || (m.body_dofnum[w1] == 0 && m.body_dofnum[w2] == 0) {
        return false;
    }
    let parent = |w: usize| m.body_weldid[m.body_parentid[w] as usize] as usize;
    let related = w1 != 0 && w2 != 0 && (w1 == parent(w2) || w2 == parent(w1));
    if related && !m.opt.disableflags.contains(Disable::FILTERPARENT) {
        return false;
    }
    let types =
        types_match(m.body_contype[b1], m.body_conaffinity[b1], m.body_contype[b2], m.body_conaffinity[b2]);
    types && (awake.is_everything() || are_awake(awake, [b1, b2], [w1, w2]))
}

/// Two bodies that do not both sleep, neither one where the other is fixed to the world.
#[cold]
fn are_awake(awake: Awake, bodies: [usize; 2], weld: [usize; 2]) -> bool {
    let [first, second] = bodies.map(|b| awake.sleeps(b));
    !(first && (second || weld[1] == 0)) && !(second && weld[0] == 0)
}

/// [`bodies_match`], where flexes follow the bodies; those touch whatever their contact types admit, while one moves.
fn pair_matches(m: &Model, awake: Awake, b1: usize, b2: usize) -> bool {
    if b1 < m.nbody && b2 < m.nbody {
        return bodies_match(m, awake, b1, b2);
    }
    let moves = |b: usize| match b.checked_sub(m.nbody) {
        None => m.body_treeid[b] >= 0 && awake.moves(b),
        Some(f) => awake.has_awake(|state| object::flex(m, state, f)),
    };
    (awake.is_everything() || moves(b1) || moves(b2)) && types_admit(m, b1, b2)
}

/// The contact types of two bodies or flexes admit each other.
fn types_admit(m: &Model, b1: usize, b2: usize) -> bool {
    let types = |b: usize| match b.checked_sub(m.nbody) {
        None => (m.body_contype[b], m.body_conaffinity[b]),
        Some(f) => (m.flex_contype[f], m.flex_conaffinity[f]),
    };
    let ((contype1, conaffinity1), (contype2, conaffinity2)) = (types(b1), types(b2));
    types_match(contype1, conaffinity1, contype2, conaffinity2)
}

/// Frame whose axes (rows) follow the covariance of the positions of geoms and vertices outside the world body.
fn spread_frame(m: &Model, kin: &Kinematics, flexes: &Flexes) -> Mat3 {
    let geoms = || m.geom_bodyid.iter().zip(&kin.geom_xpos);
    let placed = || geoms().chain(m.flex_vertbodyid.iter().zip(&flexes.flexvert_xpos));
    let moving = || placed().filter(|&(&body, _)| body != 0).map(|(_, &pos)| pos);
    let count = moving().count();
    let centre = scale(moving().fold([0.0; 3], add), 1.0 / count as f64);
    let mut cov = [0.0; 9];
    for pos in moving() {
        let [x, y, z] = sub(pos, centre);
        for (c, product) in
            cov.iter_mut().zip([x * x, x * y, x * z, x * y, y * y, y * z, x * z, y * z, z * z])
        {
            *c += product;
        }
    }
    let (_, quat) = principal_axes(&cov.map(|c| c * (1.0 / count as f64)));
    quat_to_mat(quat)
}

/// Extent of the colliding geoms of body `b` with their margins along the rows of `frame`: each lies in its box
/// and in its bounding sphere.
fn body_bounds(m: &Model, kin: &Kinematics, b: usize, frame: &Mat3) -> Bounds {
    let global = if overridden(m) { 0.5 * m.opt.o_margin } else { 0.0 };
    let mut bounds = Bounds { min: [f64::INFINITY; 3], max: [f64::NEG_INFINITY; 3] };
    for g in geoms(m, b).filter(|&g| m.geom_contype[g] != 0 || m.geom_conaffinity[g] != 0) {
        let margin = if global != 0.0 { global } else { m.geom_margin[g] + m.geom_gap[g] };
        let (pos, mat, radius) = (kin.geom_xpos[g], &kin.geom_xmat[g], m.geom_rbound[g]);
        let sphere = mul_mat_vec(frame, pos);
        let [cx, cy, cz, sx, sy, sz] = m.geom_aabb[g];
        let centred = cx == 0.0 && cy == 0.0 && cz == 0.0;
        let centre =
            if centred { sphere } else { mul_mat_vec(frame, add(mul_mat_vec(mat, [cx, cy, cz]), pos)) };
        let axes = mul_mat(frame, mat);
        for j in 0..3 {
            let half = (sx * axes[3 * j]).abs() + (sy * axes[3 * j + 1]).abs() + (sz * axes[3 * j + 2]).abs();
            bounds.min[j] = min(bounds.min[j], max(sphere[j] - radius, centre[j] - half) - margin);
            bounds.max[j] = max(bounds.max[j], min(sphere[j] + radius, centre[j] + half) + margin);
        }
    }
    bounds
}

/// Extent of the vertices of flex `f` with its radius and margin along the rows of `frame`.
fn flex_bounds(m: &Model, flexes: &Flexes, f: usize, frame: &Mat3) -> Bounds {
    let flex = Flex { m, id: f };
    let global = if overridden(m) { 0.5 * m.opt.o_margin } else { 0.0 };
    let margin = if global != 0.0 { global } else { m.flex_margin[f] + m.flex_gap[f] };
    let bound = flex.radius() + margin;
    let mut bounds = Bounds { min: [f64::INFINITY; 3], max: [f64::NEG_INFINITY; 3] };
    for &point in &flexes.flexvert_xpos[flex.vertices()] {
        let along = mul_mat_vec(frame, point);
        for j in 0..3 {
            bounds.min[j] = min(bounds.min[j], along[j]);
            bounds.max[j] = max(bounds.max[j], along[j]);
        }
    }
    Bounds { min: bounds.min.map(|x| x - bound), max: bounds.max.map(|x| x + bound) }
}

/// The smaller of two numbers; unlike `f64::min` a single instruction.
fn min(a: f64, b: f64) -> f64 {
    if a < b { a } else { b }
}

/// The larger of two numbers.
fn max(a: f64, b: f64) -> f64 {
    if a > b { a } else { b }
}

/// Bounding spheres (or a plane and a bounding sphere) are farther apart than `margin`.
pub fn spheres_apart(m: &Model, kin: &Kinematics, g1: usize, g2: usize, margin: f64) -> bool {
    let (r1, r2) = (m.geom_rbound[g1], m.geom_rbound[g2]);
    let between = sub(kin.geom_xpos[g2], kin.geom_xpos[g1]);
    if r1 > 0.0 && r2 > 0.0 {
        let bound = r1 + r2 + margin;
        return dot(between, between) > bound * bound;
    }
    let above = |plane: usize, way: Vec3, radius: f64| {
        m.geom_type[plane] == GeomType::Plane.code()
            && radius > 0.0
            && dot(way, column(&kin.geom_xmat[plane], 2)) > margin + radius
    };
    above(g1, between, r2) || above(g2, add_scaled([0.0; 3], between, -1.0), r1)
}
