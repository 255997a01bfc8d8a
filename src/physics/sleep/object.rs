//! Whether elements sleep that are made of several bodies.

use super::Activity;
use crate::model::flex::Flex;
use crate::model::{EqType, Model, ObjType, SensorType, TrnType};
use crate::stages::State;

/// Activity of a body.
fn body(state: &State, b: i32) -> Activity {
    match state.body_awake[b as usize] {
        0 => Activity::Asleep,
        1.. => Activity::Awake,
        _ => Activity::Static,
    }
}

fn site(m: &Model, state: &State, s: i32) -> Activity {
    body(state, m.site_bodyid[s as usize])
}

fn joint(m: &Model, state: &State, j: i32) -> Activity {
    body(state, m.jnt_bodyid[j as usize])
}

fn either(a: Activity, b: Activity) -> Activity {
    if a == Activity::Awake || b == Activity::Awake { Activity::Awake } else { Activity::Asleep }
}

/// Activity of a tendon: asleep when all trees that it couples are; with more than two, never.
pub(crate) fn tendon(m: &Model, state: &State, t: usize) -> Activity {
    let awake = |tree: i32| state.tree_awake[tree as usize] != 0;
    let [first, second] = m.tendon_treeid[t];
    let awake = match m.tendon_treenum[t] {
        0 => return Activity::Static,
        1 => awake(first),
        2 => awake(first) || awake(second),
        _ => true,
    };
    if awake { Activity::Awake } else { Activity::Asleep }
}

/// Activity of a flex: the activity of its first body that can move.
pub(crate) fn flex(m: &Model, state: &State, f: usize) -> Activity {
    let mut bodies = Flex { m, id: f }.bodies().iter().filter(|&&b| m.body_treeid[b as usize] >= 0);
    bodies.next().map_or(Activity::Static, |&b| body(state, b))
}

/// Activity of an actuator: the activity of what it acts on.
pub(crate) fn actuator(m: &Model, state: &State, i: usize) -> Activity {
    let [first, second] = m.actuator_trnid[i];
    match TrnType::from_code(m.actuator_trntype[i]) {
        Some(TrnType::Joint | TrnType::Jointinparent) => joint(m, state, first),
        Some(TrnType::Slidercrank) => either(site(m, state, first), site(m, state, second)),
        Some(TrnType::Tendon) => tendon(m, state, first as usize),
        Some(TrnType::Site) => site(m, state, first),
        Some(TrnType::So3) if second < 0 => joint(m, state, first),
        Some(TrnType::So3) => either(site(m, state, first), site(m, state, second)),
        Some(TrnType::Body) => body(state, first),
        Some(TrnType::Undefined) | None => Activity::Awake,
    }
}

/// Activity of an equality constraint: asleep unless one of the two is awake.
pub(crate) fn equality(m: &Model, state: &State, eq: usize) -> Activity {
    let kind = match EqType::from_code(m.eq_type[eq]) {
        Some(EqType::Connect | EqType::Weld) => m.eq_objtype[eq],
        Some(EqType::Joint) => ObjType::Joint.code(),
        Some(EqType::Tendon) => ObjType::Tendon.code(),
        Some(EqType::Flex | EqType::Flexvert | EqType::Flexstrain) => ObjType::Flex.code(),
        _ => return Activity::Awake,
    };
    let of = |id: i32| if id >= 0 { element(m, state, kind, id) } else { Activity::Static };
    either(of(m.eq_obj1id[eq]), of(m.eq_obj2id[eq]))
}

/// Activity of a sensor: asleep when its object and its reference are, or one of them and the other stands still.
pub(crate) fn sensor(m: &Model, state: &State, i: usize) -> Activity {
    let [object, reference] = [m.sensor_objtype[i], m.sensor_reftype[i]];
    let zone = object == ObjType::Site.code() || reference == ObjType::Site.code();
    match SensorType::from_code(m.sensor_type[i]) {
        Some(SensorType::User | SensorType::Plugin | SensorType::Rangefinder) => return Activity::Awake,
        Some(SensorType::Contact) if zone => return Activity::Awake,
        _ => {}
    }
    let unknown = ObjType::Unknown.code();
    let awake_unless = |asleep: bool| if asleep { Activity::Asleep } else { Activity::Awake };
    let [a, b] =
        [element(m, state, object, m.sensor_objid[i]), element(m, state, reference, m.sensor_refid[i])];
    match (object == unknown, reference == unknown) {
        (true, true) => Activity::Awake,
        (true, false) => awake_unless(b == Activity::Asleep),
        (false, true) => awake_unless(a == Activity::Asleep),
        (false, false) => either(a, b),
    }
}

/// Activity of an element of a kind that can sleep; others are awake.
fn element(m: &Model, state: &State, kind: i32, id: i32) -> Activity {
    let at = |bodies: &[i32]| body(state, bodies[id as usize]);
    match ObjType::from_code(kind) {
        Some(ObjType::Body | ObjType::Xbody) => body(state, id),
        Some(ObjType::Joint) => at(&m.jnt_bodyid),
        Some(ObjType::Dof) => at(&m.dof_bodyid),
        Some(ObjType::Geom) => at(&m.geom_bodyid),
        Some(ObjType::Site) => at(&m.site_bodyid),
        Some(ObjType::Camera) => at(&m.cam_bodyid),
        Some(ObjType::Light) => at(&m.light_bodyid),
        Some(ObjType::Flex) => flex(m, state, id as usize),
        Some(ObjType::Tendon) => tendon(m, state, id as usize),
        Some(ObjType::Actuator) => actuator(m, state, id as usize),
        Some(ObjType::Equality) => equality(m, state, id as usize),
        _ => Activity::Awake,
    }
}
