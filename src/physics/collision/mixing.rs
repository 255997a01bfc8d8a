//! Contact parameters: how two geoms, or a predefined pair, decide margin, friction and softness of their contacts
//! (documentation: Modeling, "Contact parameters"), and the contact frame.

use super::shape::PreContact;
use crate::math::{Mat3, Vec3, add_scaled, cross, dot, normalize};
use crate::model::bounds::{MINMU, MINVAL};
use crate::model::{Enable, Model};
use crate::stages::Contact;

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

/// True when global contact parameters override the geoms' parameters.
pub(super) fn overridden(m: &Model) -> bool {
    m.opt.enableflags.contains(Enable::OVERRIDE)
}

/// Distance below which a contact makes force: the sum of the geoms' margins, the margin of the predefined pair, or the
/// global margin.
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
        mix.overridden(m)
    }

    fn overridden(mut self, m: &Model) -> Self {
        if overridden(m) {
            self.friction = m.opt.o_friction;
            self.solref = m.opt.o_solref;
            self.solreffriction = m.opt.o_solref;
            self.solimp = m.opt.o_solimp;
        }
        self.friction = self.friction.map(|f| if f > MINMU { f } else { MINMU });
        self
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

    fn of_geoms(m: &Model, g1: usize, g2: usize) -> Self {
        Self::of_surfaces([Surface::geom(m, g1), Surface::geom(m, g2)])
    }

    /// Parameters of two surfaces mixed, at least one of a flex, after global overrides. `margin` is theirs.
    pub fn of_flex(m: &Model, surfaces: [Surface; 2], margin: f64) -> Self {
        Mixture { margin, ..Self::of_surfaces(surfaces) }.overridden(m)
    }

    /// The surface of higher priority alone.
    fn of_surface(s: &Surface) -> Self {
        Mixture {
            dim: s.dim,
            margin: 0.0,
            friction: unpack(*s.friction),
            solref: *s.solref,
            solreffriction: [0.0; 2],
            solimp: *s.solimp,
            adhesion: s.adhesion,
        }
    }

    #[inline(always)]
    fn of_surfaces([a, b]: [Surface; 2]) -> Self {
        if a.priority != b.priority {
            return Self::of_surface(if a.priority > b.priority { &a } else { &b });
        }
        let weight = solver_weight(a.solmix, b.solmix);
        let mixed = |a: f64, b: f64| weight * a + (1.0 - weight) * b;
        // Time constants are mixed; direct stiffness and damping, which are negative, take the stiffer.
        let solref = if a.solref[0] > 0.0 && b.solref[0] > 0.0 {
            std::array::from_fn(|i| mixed(a.solref[i], b.solref[i]))
        } else {
            std::array::from_fn(|i| a.solref[i].min(b.solref[i]))
        };
        Mixture {
            dim: a.dim.max(b.dim),
            margin: 0.0,
            friction: unpack(std::array::from_fn(|i| a.friction[i].max(b.friction[i]))),
            solref,
            solreffriction: [0.0; 2],
            solimp: std::array::from_fn(|i| mixed(a.solimp[i], b.solimp[i])),
            adhesion: a.adhesion + b.adhesion,
        }
    }

    /// Dimension of the contact space: 1, 3, 4 or 6.
    pub fn dim(&self) -> i32 {
        self.dim
    }

    /// Friction coefficients: two tangential, torsional, two rolling.
    pub fn friction(&self) -> [f64; 5] {
        self.friction
    }

    /// Without friction, in touch at distance zero.
    pub fn frictionless(self) -> Self {
        Mixture { dim: 1, margin: 0.0, ..self }
    }

    /// The contact of geoms `geom` at a point the narrow phase found.
    pub fn contact(&self, geom: [usize; 2], point: &PreContact) -> Contact {
        self.of_parts(Parts { geom: geom.map(|g| g as i32), ..Parts::NONE }, point)
    }

    /// The contact of two parts of geoms or flexes at a point. Adhesion acts in the gap, without friction.
    #[inline(always)]
    pub fn of_parts(&self, parts: Parts, point: &PreContact) -> Contact {
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
            geom: parts.geom,
            flex: parts.flex,
            elem: parts.elem,
            vert: parts.vert,
            exclude: i32::from(in_gap && !adhesive),
            efc_address: -1,
        }
    }
}

/// What touches: on each side a geom, or a flex with one of its elements or vertices; -1 for none.
#[derive(Clone, Copy, Debug)]
pub struct Parts {
    /// Geoms.
    pub geom: [i32; 2],
    /// Flexes.
    pub flex: [i32; 2],
    /// Elements, counted within the flex.
    pub elem: [i32; 2],
    /// Vertices, counted within the flex.
    pub vert: [i32; 2],
}

impl Parts {
    /// Nothing on either side.
    pub const NONE: Parts = Parts { geom: [-1; 2], flex: [-1; 2], elem: [-1; 2], vert: [-1; 2] };
}

/// Contact parameters of a geom or flex.
#[derive(Clone, Copy, Debug)]
pub struct Surface<'a> {
    priority: i32,
    dim: i32,
    solmix: f64,
    solref: &'a [f64; 2],
    solimp: &'a [f64; 5],
    friction: &'a [f64; 3],
    adhesion: f64,
}

impl<'a> Surface<'a> {
    /// Parameters of geom `g`.
    #[inline(always)]
    pub fn geom(m: &'a Model, g: usize) -> Self {
        Surface {
            priority: m.geom_priority[g],
            dim: m.geom_condim[g],
            solmix: m.geom_solmix[g],
            solref: &m.geom_solref[g],
            solimp: &m.geom_solimp[g],
            friction: &m.geom_friction[g],
            adhesion: m.geom_adhesion[g],
        }
    }

    /// Parameters of flex `f`.
    pub fn flex(m: &'a Model, f: usize) -> Self {
        Surface {
            priority: m.flex_priority[f],
            dim: m.flex_condim[f],
            solmix: m.flex_solmix[f],
            solref: &m.flex_solref[f],
            solimp: &m.flex_solimp[f],
            friction: &m.flex_friction[f],
            adhesion: 0.0,
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
