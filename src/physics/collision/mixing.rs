//! Contact parameters: how two geoms, or a predefined pair, decide margin, friction and softness of their contacts
//! (documentation: Modeling, "Contact parameters"), and the contact frame.

use super::PreContact;
use crate::data::Contact;
use crate::math::{Mat3, Vec3, add_scaled, cross, dot, normalize};
use crate::model::bounds::{MINMU, MINVAL};
use crate::model::{Enable, Model};

/// What all contacts of one geom pair share.
#[derive(Clone, Copy, Debug)]
pub struct Mixture {
    dim: i32,
    margin: f64,
    friction: [f64; 5],
    solref: [f64; 2],
    solreffriction: [f64; 2],
    solimp: [f64; 5],
    adhesion: f64,
}

/// True when global contact parameters override those of the geoms.
pub(super) fn overridden(m: &Model) -> bool {
    m.opt.enableflags.contains(Enable::OVERRIDE)
}

/// Distance below which a contact makes force: the sum of the geoms' margins, that of the predefined pair, or the
/// global one.
pub fn margin(m: &Model, g1: usize, g2: usize, pair: Option<usize>) -> f64 {
    if overridden(m) {
        return m.opt.o_margin;
    }
    pair.map_or_else(|| m.geom_margin[g1] + m.geom_margin[g2], |p| m.pair_margin[p])
}

/// Distance beyond the margin in which contacts are found without making force.
pub fn gap(m: &Model, g1: usize, g2: usize, pair: Option<usize>) -> f64 {
    pair.map_or_else(|| m.geom_gap[g1] + m.geom_gap[g2], |p| m.pair_gap[p])
}

impl Mixture {
    /// Parameters of predefined pair `pair`, or of the two geoms mixed, after global overrides.
    pub fn new(m: &Model, g1: usize, g2: usize, pair: Option<usize>) -> Self {
        let mut mix = pair.map_or_else(|| Self::of_geoms(m, g1, g2), |p| Self::of_pair(m, p));
        mix.margin = margin(m, g1, g2, pair);
        if overridden(m) {
            mix.friction = m.opt.o_friction;
            mix.solref = m.opt.o_solref;
            mix.solreffriction = m.opt.o_solref;
            mix.solimp = m.opt.o_solimp;
        }
        mix.friction = mix.friction.map(|f| if f > MINMU { f } else { MINMU });
        mix
    }

    fn of_pair(m: &Model, p: usize) -> Self {
        Mixture {
            dim: m.pair_dim[p],
            margin: 0.0,
            friction: m.pair_friction[p],
            solref: m.pair_solref[p],
            solreffriction: m.pair_solreffriction[p],
            solimp: m.pair_solimp[p],
            adhesion: m.pair_adhesion[p],
        }
    }

    /// The geom of higher priority alone.
    fn of_geom(m: &Model, g: usize) -> Self {
        Mixture {
            dim: m.geom_condim[g],
            margin: 0.0,
            friction: unpack(m.geom_friction[g]),
            solref: m.geom_solref[g],
            solreffriction: [0.0; 2],
            solimp: m.geom_solimp[g],
            adhesion: m.geom_adhesion[g],
        }
    }

    fn of_geoms(m: &Model, g1: usize, g2: usize) -> Self {
        let (p1, p2) = (m.geom_priority[g1], m.geom_priority[g2]);
        if p1 != p2 {
            return Self::of_geom(m, if p1 > p2 { g1 } else { g2 });
        }
        let weight = solver_weight(m.geom_solmix[g1], m.geom_solmix[g2]);
        let mixed = |a: f64, b: f64| weight * a + (1.0 - weight) * b;
        let (ref1, ref2) = (m.geom_solref[g1], m.geom_solref[g2]);
        // Time constants are mixed; direct stiffness and damping, which are negative, take the stiffer.
        let solref = if ref1[0] > 0.0 && ref2[0] > 0.0 {
            std::array::from_fn(|i| mixed(ref1[i], ref2[i]))
        } else {
            std::array::from_fn(|i| ref1[i].min(ref2[i]))
        };
        Mixture {
            dim: m.geom_condim[g1].max(m.geom_condim[g2]),
            margin: 0.0,
            friction: unpack(std::array::from_fn(|i| m.geom_friction[g1][i].max(m.geom_friction[g2][i]))),
            solref,
            solreffriction: [0.0; 2],
            solimp: std::array::from_fn(|i| mixed(m.geom_solimp[g1][i], m.geom_solimp[g2][i])),
            adhesion: m.geom_adhesion[g1] + m.geom_adhesion[g2],
        }
    }

    /// The contact of geoms `geom` at a point the narrow phase found. Adhesion acts in the gap, without friction.
    pub fn contact(&self, geom: [usize; 2], point: &PreContact) -> Contact {
        let in_gap = point.dist >= self.margin;
        let adhesive = self.adhesion != 0.0;
        Contact {
            dist: point.dist,
            pos: point.pos,
            frame: contact_frame(point.normal, point.tangent),
            includemargin: self.margin,
            friction: self.friction,
            solref: self.solref,
            solreffriction: self.solreffriction,
            solimp: self.solimp,
            adhesion: self.adhesion,
            mu: 0.0,
            dim: if adhesive && in_gap { 1 } else { self.dim },
            geom: geom.map(|g| g as i32),
            exclude: i32::from(in_gap && !adhesive),
            efc_address: -1,
        }
    }
}

/// Sliding twice, spinning, rolling twice.
fn unpack(f: [f64; 3]) -> [f64; 5] {
    [f[0], f[0], f[1], f[2], f[2]]
}

/// Share of the first geom; a vanishing weight yields to the other.
fn solver_weight(mix1: f64, mix2: f64) -> f64 {
    match (mix1 >= MINVAL, mix2 >= MINVAL) {
        (true, true) => mix1 / (mix1 + mix2),
        (false, false) => 0.5,
        (false, true) => 0.0,
        (true, false) => 1.0,
    }
}

/// Rows normal, first and second tangent. Without a wanted tangent the first is nearest to world y, or to z when
/// the normal leans towards y.
pub fn contact_frame(normal: Vec3, tangent: Vec3) -> Mat3 {
    let x = normalize(normal).0;
    let wanted = if dot(tangent, tangent) >= 0.25 {
        tangent
    } else if x[1] < 0.5 && x[1] > -0.5 {
        [0.0, 1.0, 0.0]
    } else {
        [0.0, 0.0, 1.0]
    };
    let y = normalize(add_scaled(wanted, x, -dot(x, wanted))).0;
    let z = cross(x, y);
    [x[0], x[1], x[2], y[0], y[1], y[2], z[0], z[1], z[2]]
}
