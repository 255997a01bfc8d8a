//! Collision detection: from poses of geoms to contacts, in the order MuJoCo lists them
//! (documentation: Computation, "Collision detection").
//!
//! Bodies that may touch come from a sweep (`broad_phase.rs`); their geoms from bounding volumes (`mid_phase.rs`);
//! the points of contact from one function for each pair of geom types ([`pair_function`]); their friction and
//! softness from both geoms ([`mixing`]).
//!
//! ```
//! use robohive_physics::{Data, forward};
//!
//! let model = robohive_mjcf::load_str(
//!     "<mujoco><worldbody><geom name='floor' type='plane' size='1 1 1'/><body name='ball' pos='0 0 .09'><freejoint/><geom name='ball' size='.1' mass='1'/></body></worldbody></mujoco>",
//! )?
//! .model;
//! let mut data = Data::new(&model);
//! forward(&model, &mut data)?;
//! let contact = data.contacts().next().ok_or("no contact")?;
//! assert_eq!(contact.geoms().map(|geom| geom.map(|g| model.geom(g).name())), [Some("floor"), Some("ball")]);
//! assert!((contact.dist() + 0.01).abs() < 1e-12);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

#[doc(hidden)]
pub mod box_box;
pub(crate) mod broad_phase;
pub(crate) mod capsule;
#[doc(hidden)]
pub mod capsule_box;
#[doc(hidden)]
pub mod convex;
pub mod distance;
pub(crate) mod element_sweep;
pub(crate) mod epa;
pub mod filter;
mod flex;
#[doc(hidden)]
pub mod gjk;
pub(crate) mod hfield;
pub(crate) mod hull;
pub(crate) mod mid_phase;
#[doc(hidden)]
pub mod mixing;
#[doc(hidden)]
pub mod mpr;
pub(crate) mod multicontact;
pub(crate) mod plane;
pub(crate) mod polyhedron;
pub(crate) mod polytope;
pub(crate) mod round_normal;
pub(crate) mod scratch;
pub(crate) mod sdf;
mod shape;
pub(crate) mod sphere;
#[doc(hidden)]
pub mod support;
pub(crate) mod thin;

use crate::model::NotSimulated;
use crate::model::{Disable, GeomType, Model, ObjType};
use crate::stages::{Contacts, Demand, Flexes, Kinematics, OverBudget, State, StepBudget};
use broad_phase::{geoms, spheres_apart};
use filter::{ByType, PairFilter, SleepFilter};
#[doc(hidden)]
pub use flex::World;
pub use scratch::CollisionScratch;
pub use shape::{PreContact, Shape};

/// Appends the contacts of two geoms (the first of the lower type) that are nearer than the margin, at most
/// `bounds::MAXCONPAIR` of them. Arguments: model, poses, geoms, margin, working memory, result.
pub type PairFunction =
    fn(&Model, &Kinematics, usize, usize, f64, &mut convex::ConvexScratch, &mut Vec<PreContact>);

/// A pair function from one that sees only the two shapes.
macro_rules! shapes {
    ($function:path) => {
        Some(|m, kin, g1, g2, margin, _, out| {
            $function(&Shape::new(m, kin, g1), &Shape::new(m, kin, g2), margin, out)
        })
    };
}

/// The function for geoms of types `type1 <= type2`, if such geoms collide.
pub fn pair_function(type1: i32, type2: i32) -> Option<PairFunction> {
    const N: Option<PairFunction> = None;
    const PS: Option<PairFunction> = shapes!(plane::plane_sphere);
    const PC: Option<PairFunction> = shapes!(plane::plane_capsule);
    const PE: Option<PairFunction> = shapes!(plane::plane_ellipsoid);
    const PY: Option<PairFunction> = shapes!(plane::plane_cylinder);
    const PB: Option<PairFunction> = shapes!(plane::plane_box);
    const PM: Option<PairFunction> = shapes!(plane::plane_mesh);
    const SS: Option<PairFunction> = shapes!(sphere::sphere_sphere);
    const SC: Option<PairFunction> = shapes!(sphere::sphere_capsule);
    const SY: Option<PairFunction> = shapes!(sphere::sphere_cylinder);
    const SB: Option<PairFunction> = shapes!(sphere::sphere_box);
    const CC: Option<PairFunction> = shapes!(capsule::capsule_capsule);
    const CB: Option<PairFunction> = shapes!(capsule_box::capsule_box);
    const BB: Option<PairFunction> = shapes!(box_box::box_box);
    const HF: Option<PairFunction> = Some(hfield::height_field);
    const CX: Option<PairFunction> = Some(convex::convex);
    const DD: Option<PairFunction> = Some(sdf::two_fields);
    const MD: Option<PairFunction> = Some(sdf::mesh_and_field);
    #[rustfmt::skip]
    const TABLE: [[Option<PairFunction>; 9]; 9] = [
        //               plane hfield sphere capsule ellipsoid cylinder box mesh sdf
        /* plane */     [N,    N,     PS,    PC,     PE,       PY,      PB, PM,  PM],
        /* hfield */    [N,    N,     HF,    HF,     HF,       HF,      HF, HF,  N],
        /* sphere */    [N,    N,     SS,    SC,     CX,       SY,      SB, CX,  DD],
        /* capsule */   [N,    N,     N,     CC,     CX,       CX,      CB, CX,  DD],
        /* ellipsoid */ [N,    N,     N,     N,      CX,       CX,      CX, CX,  DD],
        /* cylinder */  [N,    N,     N,     N,      N,        CX,      CX, CX,  DD],
        /* box */       [N,    N,     N,     N,      N,        N,       BB, CX,  DD],
        /* mesh */      [N,    N,     N,     N,      N,        N,       N,  CX,  MD],
        /* sdf */       [N,    N,     N,     N,      N,        N,       N,  N,   DD],
    ];
    *TABLE.get(type1 as usize)?.get(type2 as usize)?
}

/// Checks once that `collide` knows every geom of the model that may collide.
///
/// # Errors
/// The first geom of unknown type, or without a signed distance.
pub fn check(m: &Model) -> Result<(), NotSimulated> {
    let refuse = |g: usize, feature: &str| Err(NotSimulated::of(m.label_of(ObjType::Geom, g), feature));
    for g in 0..m.ngeom {
        match GeomType::from_code(m.geom_type[g]) {
            Some(GeomType::None) | None => return refuse(g, "this type of geom"),
            Some(GeomType::Sdf) if m.geom_plugin[g] < 0 && !has_octree(m, g) => {
                return refuse(g, "a signed distance geom without a plugin, of a mesh without an octree,");
            }
            Some(_) => {}
        }
    }
    Ok(())
}

fn has_octree(m: &Model, g: usize) -> bool {
    usize::try_from(m.geom_dataid[g]).is_ok_and(|mesh| m.mesh_octadr[mesh] >= 0)
}

/// Bytes of a pair of geoms while their list grows.
const PAIR_BYTES: usize = 3 * size_of::<(usize, usize)>();

/// Bytes of a pair of bodies while their list grows.
const BODY_PAIR_BYTES: usize = 3 * size_of::<u32>();

/// Finds all contacts: predefined pairs and geoms of bodies that may touch, ordered by body pair, then by geom pair; flexes
/// follow the bodies, and their contacts with themselves come last.
///
/// # Errors
/// Contacts, or pairs that may touch, do not fit in `budget`.
pub fn collide(
    m: &Model,
    kin: &Kinematics,
    flexes: &Flexes,
    budget: StepBudget,
    scratch: &mut CollisionScratch,
    con: &mut Contacts,
) -> Result<(), OverBudget> {
    let sleep = SleepFilter::none();
    find(World { m, kin, flexes }, (sleep, &mut ByType), budget, scratch, con)
}

/// [`collide`] without what sleeps: of two that meet, one is awake, and not a fixed one where the other sleeps.
///
/// # Errors
/// As [`collide`].
#[doc(hidden)]
#[inline]
pub fn collide_awake(
    at: World,
    state: &State,
    budget: StepBudget,
    scratch: &mut CollisionScratch,
    con: &mut Contacts,
) -> Result<(), OverBudget> {
    collide_filtered(at, state, &mut ByType, budget, scratch, con)
}

/// [`collide_awake`] of the pairs of geoms that `filter` admits.
///
/// # Errors
/// As [`collide`].
#[doc(hidden)]
pub fn collide_filtered(
    at: World,
    state: &State,
    filter: &mut impl PairFilter,
    budget: StepBudget,
    scratch: &mut CollisionScratch,
    con: &mut Contacts,
) -> Result<(), OverBudget> {
    let sleep = SleepFilter::of(at.m, state);
    if !sleep.awake.is_everything() && !state.body_awake.contains(&1) {
        con.contact.clear();
        return Ok(());
    }
    find(at, (sleep, filter), budget, scratch, con)
}

fn find<F: PairFilter>(
    at: World,
    (sleep, filter): (SleepFilter, &mut F),
    budget: StepBudget,
    scratch: &mut CollisionScratch,
    con: &mut Contacts,
) -> Result<(), OverBudget> {
    let World { m, kin, flexes } = at;
    con.contact.clear();
    if m.opt.disableflags.intersects(Disable::CONSTRAINT | Disable::CONTACT) || m.nbody + m.nflex < 2 {
        return Ok(());
    }
    scratch.budget = budget;
    let mut broad = std::mem::take(&mut scratch.broad);
    let most = budget.count(BODY_PAIR_BYTES);
    broad.run(m, sleep.awake, kin, flexes, most);
    let result = if broad.pairs.len() > most {
        Err(budget.exceeded(Demand::BodyPairs, broad.pairs.len(), BODY_PAIR_BYTES))
    } else {
        touch(at, (sleep, filter), &broad.pairs, scratch, con)
    };
    scratch.broad = broad;
    result
}

/// Contacts of the pairs of bodies and of all predefined pairs.
fn touch<F: PairFilter>(
    at: World,
    (sleep, filter): (SleepFilter, &mut F),
    pairs: &[u32],
    scratch: &mut CollisionScratch,
    con: &mut Contacts,
) -> Result<(), OverBudget> {
    let World { m, kin, .. } = at;
    let mut next = 0;
    for &signature in pairs {
        // Predefined pairs of this and earlier body pairs come first and hide the same geoms.
        let start = next;
        let mut merged = false;
        while next < m.npair && m.pair_signature[next] as u32 <= signature {
            merged = m.pair_signature[next] as u32 == signature;
            if !sleep.drops(m, next) {
                predefined(m, kin, next, scratch, con);
            }
            scratch.check(con)?;
            next += 1;
        }
        if m.exclude_signature.binary_search_by_key(&signature, |&s| s as u32).is_ok() {
            continue;
        }
        let hidden = if merged { start..next } else { 0..0 };
        let (b1, b2) = ((signature >> 16) as usize, (signature & 0xffff) as usize);
        match [b1, b2].map(|b| b.checked_sub(m.nbody)) {
            [_, None] => body_pair(at, [b1, b2], hidden, filter, scratch, con)?,
            [None, Some(f)] => flex::body_flex(at, b1, f, scratch, con),
            [Some(f1), Some(f2)] => flex::two_flexes(at, [f1, f2], scratch, con),
        }
        scratch.check(con)?;
    }
    for pair in (next..m.npair).filter(|&pair| !sleep.drops(m, pair)) {
        predefined(m, kin, pair, scratch, con);
        scratch.check(con)?;
    }
    if m.nflex > 0 {
        flex::self_contacts(at, sleep.awake, scratch, con);
        scratch.check(con)?;
    }
    Ok(())
}

/// Contacts of a predefined pair: no filter but the bounding spheres.
fn predefined(m: &Model, kin: &Kinematics, pair: usize, scratch: &mut CollisionScratch, con: &mut Contacts) {
    let (g1, g2) = (m.pair_geom1[pair] as usize, m.pair_geom2[pair] as usize);
    let reach = mixing::margin(m, g1, g2, Some(pair)) + mixing::gap(m, g1, g2, Some(pair));
    if !spheres_apart(m, kin, g1, g2, reach) {
        narrow(m, kin, ordered(m, g1, g2), Some(pair), reach, scratch, con);
    }
}

/// Contacts of the geoms of two bodies, except those `hidden` by predefined pairs.
fn body_pair(
    World { m, kin, .. }: World,
    [b1, b2]: [usize; 2],
    hidden: std::ops::Range<usize>,
    filter: &mut impl PairFilter,
    scratch: &mut CollisionScratch,
    con: &mut Contacts,
) -> Result<(), OverBudget> {
    let (most, most_contacts) = (scratch.budget.count(PAIR_BYTES), scratch.most_contacts());
    let mut candidates = std::mem::take(&mut scratch.candidates);
    candidates.clear();
    let single = m.body_geomnum[b1] == 1 && m.body_geomnum[b2] == 1;
    let trees = m.body_bvhadr[b1] >= 0 && m.body_bvhadr[b2] >= 0;
    if !single && trees && !m.opt.disableflags.contains(Disable::MIDPHASE) {
        let found = |g1, g2| {
            candidates.push(ordered(m, g1, g2));
            candidates.len() <= most
        };
        mid_phase::descend(m, kin, b1, b2, &mut scratch.stack, found);
        candidates.sort_unstable();
    } else {
        for g1 in geoms(m, b1) {
            if candidates.len() > most {
                break;
            }
            candidates.extend(geoms(m, b2).map(|g2| ordered(m, g1, g2)));
        }
    }
    let found = candidates.len();
    for &(g1, g2) in if found > most { &[] } else { &candidates[..] } {
        if con.contact.len() > most_contacts {
            break;
        }
        let reach = mixing::margin(m, g1, g2, None) + mixing::gap(m, g1, g2, None);
        let named = || is_named(m, g1, g2, hidden.clone());
        if filter.admits(m, g1, g2, named) && !spheres_apart(m, kin, g1, g2, reach) {
            narrow(m, kin, (g1, g2), None, reach, scratch, con);
        }
    }
    scratch.candidates = candidates;
    if found > most { Err(scratch.budget.exceeded(Demand::GeomPairs, found, PAIR_BYTES)) } else { Ok(()) }
}

/// The two geoms, the lower type first.
fn ordered(m: &Model, g1: usize, g2: usize) -> (usize, usize) {
    if m.geom_type[g1] > m.geom_type[g2] { (g2, g1) } else { (g1, g2) }
}

/// Whether a predefined pair in `hidden` names the same geoms.
fn is_named(m: &Model, g1: usize, g2: usize, mut hidden: std::ops::Range<usize>) -> bool {
    hidden.any(|k| {
        let pair = (m.pair_geom1[k] as usize, m.pair_geom2[k] as usize);
        pair == (g1, g2) || pair == (g2, g1)
    })
}

/// Appends the contacts of one pair of geoms.
fn narrow(
    m: &Model,
    kin: &Kinematics,
    (g1, g2): (usize, usize),
    pair: Option<usize>,
    reach: f64,
    scratch: &mut CollisionScratch,
    con: &mut Contacts,
) {
    let Some(function) = pair_function(m.geom_type[g1], m.geom_type[g2]) else { return };
    scratch.points.clear();
    function(m, kin, g1, g2, reach, &mut scratch.convex, &mut scratch.points);
    if !scratch.points.is_empty() {
        let mixture = mixing::Mixture::new(m, g1, g2, pair);
        con.contact.extend(scratch.points.iter().map(|p| mixture.contact([g1, g2], p)));
    }
}
