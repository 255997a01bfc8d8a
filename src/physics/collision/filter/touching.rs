//! Whether two geoms may touch, regardless of their positions, and with which parameters.

use crate::collision::broad_phase::{bodies_match, signature, types_match};
use crate::model::Model;
use crate::sleep::Awake;

/// How two geoms may touch.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Touching {
    /// Never.
    Never,
    /// With their own contact parameters, mixed.
    Mixed,
    /// With the parameters of this predefined pair.
    Named(usize),
}

/// How geoms `g1` and `g2` may touch: by a predefined pair, or by the contact types of geoms whose bodies are neither welded
/// together nor parent and child nor excluded (documentation: Computation, "Collision detection", selection).
pub fn touching(m: &Model, g1: usize, g2: usize) -> Touching {
    let [b1, b2] = [g1, g2].map(|g| m.geom_bodyid[g] as usize);
    let bodies = signature(b1.min(b2), b1.max(b2));
    let first = m.pair_signature.partition_point(|&s| (s as u32) < bodies);
    let of_these = (first..m.npair).take_while(|&p| m.pair_signature[p] as u32 == bodies);
    let ids = (g1.min(g2) as i32, g1.max(g2) as i32);
    for p in of_these {
        let (a, b) = (m.pair_geom1[p], m.pair_geom2[p]);
        if (a.min(b), a.max(b)) == ids {
            return Touching::Named(p);
        }
    }
    let types =
        types_match(m.geom_contype[g1], m.geom_conaffinity[g1], m.geom_contype[g2], m.geom_conaffinity[g2]);
    let excluded = || m.exclude_signature.binary_search_by_key(&bodies, |&s| s as u32).is_ok();
    let may = types && bodies_match(m, Awake::EVERYTHING, b1, b2) && !excluded();
    if may { Touching::Mixed } else { Touching::Never }
}
