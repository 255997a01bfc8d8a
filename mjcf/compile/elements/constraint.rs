//! Contact pairs, excluded pairs and equality constraints.

use crate::compile::log::{Log, title};
use crate::compile::lookup::Lookup;
use crate::spec::{Equality, Pair, SOLIMP, SOLREF, Spec};
use physics::model::{EqType, JointType, ObjType, Rows};

/// Appends pairs and excludes, sorted by signature, and equality constraints.
pub(super) fn fill(m: &mut Rows, spec: &Spec, lookup: &Lookup, log: &mut Log) {
    let mut pairs: Vec<PairRow> = spec.pairs.iter().filter_map(|p| pair_row(m, p, lookup, log)).collect();
    pairs.sort_by_key(|row| row.signature);
    pairs.iter().for_each(|row| fill_pair(m, row));
    for exclude in &spec.excludes {
        let what = title("exclude", &exclude.name);
        let first = lookup.require(ObjType::Body, &exclude.bodyname1, exclude.loc, &what, log);
        let second = lookup.require(ObjType::Body, &exclude.bodyname2, exclude.loc, &what, log);
        if let (Some(a), Some(b)) = (first, second) {
            m.exclude_signature.push(signature(a.min(b), a.max(b)));
        }
    }
    m.exclude_signature.sort_unstable();
    for equality in &spec.equalities {
        fill_equality(m, equality, lookup, log);
    }
}

fn signature(body1: usize, body2: usize) -> i32 {
    ((body1 << 16) + body2) as i32
}

/// Order in which pairs and excludes are numbered: stable by signature.
pub(crate) fn sorted_names(spec: &Spec, m: &Rows, kind: ObjType, lookup: &Lookup) -> Vec<String> {
    let body_of = |name: &str| lookup.find(ObjType::Geom, name).map_or(0, |g| m.geom_bodyid[g] as usize);
    let body = |name: &str| lookup.find(ObjType::Body, name).unwrap_or(0);
    let mut keyed: Vec<(i32, &str)> = if kind == ObjType::Pair {
        let bodies = |p: &Pair| (body_of(&p.geomname1), body_of(&p.geomname2));
        spec.pairs
            .iter()
            .map(|p| (bodies(p), &*p.name))
            .map(|((a, b), n)| (signature(a.min(b), a.max(b)), n))
            .collect()
    } else {
        spec.excludes
            .iter()
            .map(|e| ((body(&e.bodyname1), body(&e.bodyname2)), &*e.name))
            .map(|((a, b), n)| (signature(a.min(b), a.max(b)), n))
            .collect()
    };
    keyed.sort_by_key(|(key, _)| *key);
    keyed.into_iter().map(|(_, name)| name.to_owned()).collect()
}

struct PairRow {
    dim: i32,
    geoms: [usize; 2],
    signature: i32,
    solref: [f64; 2],
    solreffriction: [f64; 2],
    solimp: [f64; 5],
    margin: f64,
    gap: f64,
    adhesion: f64,
    friction: [f64; 5],
}

/// The pair of geoms, ordered by body; what the file leaves open has fixed defaults (MuJoCo 3.12 no longer takes
/// it from the geoms).
fn pair_row(m: &Rows, pair: &Pair, lookup: &Lookup, log: &mut Log) -> Option<PairRow> {
    let what = title("contact pair", &pair.name);
    let first = lookup.require(ObjType::Geom, &pair.geomname1, pair.loc, &what, log);
    let second = lookup.require(ObjType::Geom, &pair.geomname2, pair.loc, &what, log);
    let (mut a, mut b) = (first?, second?);
    if m.geom_bodyid[a] > m.geom_bodyid[b] {
        std::mem::swap(&mut a, &mut b);
    }
    let dim = pair.condim.unwrap_or(3);
    if ![1, 3, 4, 6].contains(&dim) {
        log.error(pair.loc, format!("{what}: condim must be 1, 3, 4 or 6, is {dim}"));
    }
    Some(PairRow {
        dim,
        geoms: [a, b],
        signature: signature(m.geom_bodyid[a] as usize, m.geom_bodyid[b] as usize),
        solref: pair.solref.unwrap_or(SOLREF),
        solreffriction: pair.solreffriction.unwrap_or([0.0; 2]),
        solimp: pair.solimp.unwrap_or(SOLIMP),
        margin: pair.margin.unwrap_or(0.0),
        gap: pair.gap.unwrap_or(0.0),
        adhesion: pair.adhesion.unwrap_or(0.0),
        friction: pair.friction.unwrap_or([1.0, 1.0, 0.005, 0.0001, 0.0001]),
    })
}

fn fill_pair(m: &mut Rows, row: &PairRow) {
    m.pair_dim.push(row.dim);
    m.pair_geom1.push(row.geoms[0] as i32);
    m.pair_geom2.push(row.geoms[1] as i32);
    m.pair_signature.push(row.signature);
    m.pair_solref.push(row.solref);
    m.pair_solreffriction.push(row.solreffriction);
    m.pair_solimp.push(row.solimp);
    m.pair_margin.push(row.margin);
    m.pair_gap.push(row.gap);
    m.pair_adhesion.push(row.adhesion);
    m.pair_friction.push(row.friction);
}

fn fill_equality(m: &mut Rows, equality: &Equality, lookup: &Lookup, log: &mut Log) {
    let what = title("equality constraint", &equality.name);
    let loc = equality.loc;
    let kind = match equality.kind {
        EqType::Connect | EqType::Weld if matches!(equality.objtype, ObjType::Site | ObjType::Body) => {
            equality.objtype
        }
        EqType::Connect | EqType::Weld => {
            return log.error(loc, format!("{what}: connect and weld take bodies or sites"));
        }
        EqType::Joint => ObjType::Joint,
        EqType::Tendon => ObjType::Tendon,
        EqType::Flex | EqType::Flexvert | EqType::Flexstrain => ObjType::Flex,
        EqType::Distance => {
            return log.error(loc, format!("{what}: distance constraints are not supported"));
        }
    };
    let Some(first) = lookup.require(kind, &equality.name1, loc, &what, log) else { return };
    let mut second = lookup.reference(kind, &equality.name2, loc, &what, log);
    if kind == ObjType::Body && second == -1 {
        second = 0;
    }
    if first as i32 == second {
        log.error(loc, format!("{what}: '{}' is constrained to itself", equality.name1));
    }
    if kind == ObjType::Flex && m.flex_rigid.get(first) == Some(&true) {
        log.error(
            loc,
            format!("{what}: the flex '{}' is rigid, so that nothing is left to hold", equality.name1),
        );
    }
    if kind == ObjType::Joint {
        let scalar = |id: i32| {
            id < 0 || [JointType::Slide.code(), JointType::Hinge.code()].contains(&m.jnt_type[id as usize])
        };
        if !scalar(first as i32) || !scalar(second) {
            log.error(loc, format!("{what}: only hinge and slide joints can be coupled"));
        }
    }
    m.eq_type.push(equality.kind.code());
    m.eq_obj1id.push(first as i32);
    m.eq_obj2id.push(second);
    let by_name = matches!(equality.kind, EqType::Connect | EqType::Weld);
    m.eq_objtype.push(if by_name { kind } else { ObjType::Unknown }.code());
    m.eq_active0.push(equality.active);
    m.eq_solref.push(equality.solref);
    m.eq_solimp.push(equality.solimp);
    m.eq_data.push(equality.data);
}
