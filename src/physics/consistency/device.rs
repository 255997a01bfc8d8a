//! Tendon paths, equality constraints, actuators and sensors: references whose kind another array tells.

use super::requirement::{Inconsistent, require};
use crate::arrays::input;
use crate::arrays::{Arrays, DynType, EqType, GainType, JointType, ObjType, SensorType, TrnType, WrapType};

/// Samples a history buffer may hold.
const MAX_SAMPLES: i32 = 1 << 24;

pub(super) fn check(m: &Arrays) -> Result<(), Inconsistent> {
    (0..m.ntendon).try_for_each(|tendon| path(m, tendon))?;
    (0..m.nwrap).try_for_each(|element| path_element(m, element))?;
    (0..m.neq).try_for_each(|eq| equality(m, eq))?;
    actuators(m)?;
    sensors(m)
}

fn refers(id: i32, least: i32, end: usize) -> bool {
    id >= least && (id < 0 || (id as usize) < end)
}

/// A path begins with a site, or consists of joints; a geom stands between two sites.
fn path(m: &Arrays, tendon: usize) -> Result<(), Inconsistent> {
    let (first, n) = (m.tendon_adr[tendon], m.tendon_num[tendon]);
    require(first >= 0 && n > 0, "tendon_num", tendon, "positive")?;
    let kinds = &m.wrap_type[first as usize..(first + n) as usize];
    let is = |i: usize, kind: WrapType| kinds.get(i) == Some(&kind.code());
    let fixed = is(0, WrapType::Joint);
    for i in 0..kinds.len() {
        let between = i > 0 && is(i - 1, WrapType::Site) && is(i + 1, WrapType::Site);
        let fits = match WrapType::from_code(kinds[i]) {
            Some(WrapType::Joint) => fixed,
            Some(WrapType::Site | WrapType::Pulley) => !fixed,
            Some(WrapType::Sphere | WrapType::Cylinder) => between,
            Some(WrapType::None) | None => false,
        };
        require(fits, "wrap_type", first as usize + i, "what may follow in a path")?;
    }
    Ok(())
}

fn path_element(m: &Arrays, w: usize) -> Result<(), Inconsistent> {
    let (id, side) = (m.wrap_objid[w], m.wrap_prm[w]);
    let known = match WrapType::from_code(m.wrap_type[w]) {
        Some(WrapType::Joint) => refers(id, 0, m.njnt),
        Some(WrapType::Site) => refers(id, 0, m.nsite),
        Some(WrapType::Sphere | WrapType::Cylinder) => {
            let beside = side == -1.0 || (side >= 0.0 && side < m.nsite as f64);
            require(beside, "wrap_prm", w, "the site beside a geom")?;
            refers(id, 0, m.ngeom)
        }
        _ => true,
    };
    require(known, "wrap_objid", w, "a reference to an element")
}

fn equality(m: &Arrays, eq: usize) -> Result<(), Inconsistent> {
    let (n, least) = match (EqType::from_code(m.eq_type[eq]), ObjType::from_code(m.eq_objtype[eq])) {
        (Some(EqType::Connect | EqType::Weld), Some(ObjType::Body)) => (m.nbody, 0),
        (Some(EqType::Connect | EqType::Weld), Some(ObjType::Site)) => (m.nsite, 0),
        (Some(EqType::Connect | EqType::Weld), _) => {
            return require(false, "eq_objtype", eq, "a body or a site");
        }
        (Some(EqType::Joint), _) => (m.njnt, -1),
        (Some(EqType::Tendon), _) => (m.ntendon, -1),
        (Some(EqType::Flex | EqType::Flexvert | EqType::Flexstrain), _) => (m.nflex, -1),
        // Refused as not simulated.
        _ => return Ok(()),
    };
    require(refers(m.eq_obj1id[eq], 0, n), "eq_obj1id", eq, "a reference to an element")?;
    require(refers(m.eq_obj2id[eq], least, n), "eq_obj2id", eq, "a reference to an element")
}

/// Numbers that all history buffers take.
pub(super) fn history_length(m: &Arrays) -> i64 {
    let length = |n: i32, dim: i64| if n > 0 { 2 + i64::from(n) * (1 + dim) } else { 0 };
    let controls: i64 = m.actuator_history.iter().map(|&[n, _]| length(n, 1)).sum();
    let readings = m.sensor_history.iter().zip(&m.sensor_dim);
    readings.map(|(&[n, _], &dim)| length(n, dim.into())).fold(controls, i64::saturating_add)
}

/// Inputs, outputs, states and histories follow each other in the order of actuators.
pub(super) fn actuators(m: &Arrays) -> Result<(), Inconsistent> {
    let (mut ctrl, mut out, mut act, mut history) = (0, 0, 0, 0);
    for i in 0..m.nactuator {
        let (inputs, outputs, states) = block(m, i)?;
        require(m.actuator_ctrladr[i] == ctrl, "actuator_ctrladr", i, "behind the actuator before")?;
        require(m.actuator_outadr[i] == out, "actuator_outadr", i, "behind the actuator before")?;
        let first = if states > 0 { act } else { -1 };
        require(m.actuator_actadr[i] == first, "actuator_actadr", i, "behind the actuator before")?;
        let n = m.actuator_history[i][0];
        let buffered = n <= 0 || (n <= MAX_SAMPLES && inputs > 0 && m.actuator_historyadr[i] == history);
        require(buffered, "actuator_historyadr", i, "behind the actuator before")?;
        (ctrl, out, act) = (ctrl + inputs, out + outputs, act + states);
        history += if n > 0 { 2 + 2 * n } else { 0 };
        require(history <= MAX_SAMPLES * 4, "actuator_history", i, "of a length that can be kept")?;
    }
    let sums = ctrl as usize == m.nu && out as usize == m.nout;
    require(sums, "nu", 0, "the number of all inputs")
}

/// How many inputs, outputs and states actuator `i` has, as its types ask for.
fn block(m: &Arrays, i: usize) -> Result<(i32, i32, i32), Inconsistent> {
    let (inputs, outputs, states) = (m.actuator_ctrlnum[i], m.actuator_outnum[i], m.actuator_actnum[i]);
    let (dynamics, gain) =
        (DynType::from_code(m.actuator_dyntype[i]), GainType::from_code(m.actuator_gaintype[i]));
    let so3 = m.actuator_trntype[i] == TrnType::So3.code();
    require(so3 == (gain == Some(GainType::So3)), "actuator_trntype", i, "that of its gain")?;
    require(outputs == if so3 { 3 } else { 1 }, "actuator_outnum", i, "that of its transmission")?;
    let spec = m.actuator_ctrlspec[i];
    let expected = match gain {
        Some(GainType::So3) => 3 + i32::from(spec == input::QUATERNION),
        Some(GainType::Pid | GainType::Dcmotor) => (spec & input::ALL).count_ones() as i32,
        _ => 1,
    };
    require(inputs == expected, "actuator_ctrlnum", i, "what its inputs add up to")?;
    let (gainprm, dynprm) = (&m.actuator_gainprm[i], &m.actuator_dynprm[i]);
    let fits = match dynamics {
        _ if m.actuator_plugin[i] >= 0 && !so3 => (0..=MAX_SAMPLES).contains(&states) && dynamics.is_some(),
        Some(DynType::Pid) => {
            let wanted = i32::from(dynprm[1] > 0.0) + i32::from(gainprm[0] > 0.0);
            gain == Some(GainType::Pid) && states == wanted && inputs > 0
        }
        // The number of states is compared with the parameters by `check_model`.
        Some(DynType::Dcmotor) => (0..=5).contains(&states) && (dynprm[7] <= 0.0 || inputs > 0),
        Some(DynType::None) => states == 0,
        Some(DynType::Integrator) if so3 => states == 3 && inputs == 3,
        _ => (1..=MAX_SAMPLES).contains(&states) && !so3,
    };
    require(fits, "actuator_actnum", i, "what its dynamics asks for")?;
    transmission(m, i)?;
    Ok((inputs, outputs, states))
}

fn transmission(m: &Arrays, i: usize) -> Result<(), Inconsistent> {
    let [target, reference] = m.actuator_trnid[i];
    let kind = TrnType::from_code(m.actuator_trntype[i]);
    let known = match kind {
        Some(TrnType::Joint | TrnType::Jointinparent) => refers(target, 0, m.njnt),
        Some(TrnType::So3) if reference < 0 => {
            refers(target, 0, m.njnt) && m.jnt_type[target as usize] == JointType::Ball.code()
        }
        Some(TrnType::Tendon) => refers(target, 0, m.ntendon),
        Some(TrnType::Body) => refers(target, 0, m.nbody),
        Some(TrnType::Slidercrank) => refers(target, 0, m.nsite) && refers(reference, 0, m.nsite),
        Some(TrnType::Site | TrnType::So3) => refers(target, 0, m.nsite) && refers(reference, -1, m.nsite),
        // Refused as not simulated.
        Some(TrnType::Undefined) | None => true,
    };
    require(known, "actuator_trnid", 2 * i, "a reference to an element")
}

/// Readings and histories follow each other in the order of sensors.
fn sensors(m: &Arrays) -> Result<(), Inconsistent> {
    let mut next = 0;
    let mut history =
        m.actuator_history.iter().map(|&[n, _]| if n > 0 { 2 + 2 * i64::from(n) } else { 0 }).sum::<i64>();
    for i in 0..m.nsensor {
        let (dim, n) = (m.sensor_dim[i], m.sensor_history[i][0]);
        require((0..=MAX_SAMPLES).contains(&dim), "sensor_dim", i, "a number of readings")?;
        require(m.sensor_adr[i] == next, "sensor_adr", i, "behind the sensor before")?;
        let buffered = n <= 0 || (n <= MAX_SAMPLES && i64::from(m.sensor_historyadr[i]) == history);
        require(buffered, "sensor_historyadr", i, "behind the sensor before")?;
        let (known, size) = reading(m, i);
        require(known, "sensor_objid", i, "a reference to an element")?;
        require(size.is_none_or(|size| size == i64::from(dim)), "sensor_dim", i, "that of its type")?;
        next = next.saturating_add(dim);
        history += if n > 0 { 2 + i64::from(n) * (1 + i64::from(dim)) } else { 0 };
    }
    Ok(())
}

/// Whether what a sensor reads exists, and how many numbers it makes.
fn reading(m: &Arrays, i: usize) -> (bool, Option<i64>) {
    use SensorType::*;
    let (object, reference) =
        ((m.sensor_objtype[i], m.sensor_objid[i]), (m.sensor_reftype[i], m.sensor_refid[i]));
    let of = |kind: ObjType| object.0 == kind.code() && refers(object.1, 0, count(m, object.0));
    let one_of = |(kind, id): (i32, i32), kinds: &[ObjType]| {
        kinds.iter().any(|k| k.code() == kind) && refers(id, 0, count(m, kind))
    };
    let frames = [ObjType::Body, ObjType::Xbody, ObjType::Geom, ObjType::Site, ObjType::Camera];
    let frame = one_of(object, &frames) && (reference.1 < 0 || one_of(reference, &frames));
    let Some(kind) = SensorType::from_code(m.sensor_type[i]) else { return (true, None) };
    match kind {
        Touch => (of(ObjType::Site), Some(1)),
        Accelerometer | Velocimeter | Gyro | Force | Torque | Magnetometer => (of(ObjType::Site), Some(3)),
        Camprojection => (of(ObjType::Site) && one_of(reference, &[ObjType::Camera]), Some(2)),
        Rangefinder => {
            let known = one_of(object, &[ObjType::Site, ObjType::Camera]);
            let rays = if known { rays(m, object) } else { None };
            (rays.is_some(), rays.map(|n| n * fields_size(m.sensor_intprm[i][0], &[1, 3, 3, 3, 3, 1])))
        }
        Jointpos | Jointvel | Jointactfrc | Jointlimitpos | Jointlimitvel | Jointlimitfrc => {
            (of(ObjType::Joint), Some(1))
        }
        Tendonpos | Tendonvel | Tendonactfrc | Tendonlimitpos | Tendonlimitvel | Tendonlimitfrc => {
            (of(ObjType::Tendon), Some(1))
        }
        Actuatorpos | Actuatorvel | Actuatorfrc => {
            let known = of(ObjType::Actuator);
            (known, known.then(|| m.actuator_outnum[object.1 as usize].into()))
        }
        Ballquat | Ballangvel => {
            let known = of(ObjType::Joint) && m.jnt_type[object.1 as usize] == JointType::Ball.code();
            (known, Some(if kind == Ballquat { 4 } else { 3 }))
        }
        Framequat => (frame, Some(4)),
        Framepos | Framexaxis | Frameyaxis | Framezaxis | Framelinvel | Frameangvel | Framelinacc
        | Frameangacc => (frame, Some(3)),
        Subtreecom | Subtreelinvel | Subtreeangmom => (of(ObjType::Body), Some(3)),
        Insidesite => (one_of(object, &frames) && refers(reference.1, 0, m.nsite), Some(1)),
        Geomdist | Geomnormal | Geomfromto => {
            let solids = [ObjType::Body, ObjType::Geom];
            let size = [(Geomdist, 1), (Geomnormal, 3), (Geomfromto, 6)].iter().find(|(k, _)| *k == kind);
            (one_of(object, &solids) && one_of(reference, &solids), size.map(|(_, size)| *size))
        }
        Contact => {
            let parts = [ObjType::Site, ObjType::Geom, ObjType::Body, ObjType::Xbody];
            let known = |object: (i32, i32)| object.0 == ObjType::Unknown.code() || one_of(object, &parts);
            let [fields, _, slots] = m.sensor_intprm[i];
            let size = fields_size(fields, &[1, 3, 3, 1, 3, 3, 3]) * i64::from(slots.max(1));
            (known(object) && known(reference), Some(size))
        }
        EPotential | EKinetic | Clock => (true, Some(1)),
        Tactile => {
            let known = of(ObjType::Mesh) && one_of(reference, &[ObjType::Geom]);
            (known, known.then(|| 3 * i64::from(m.mesh_vertnum[object.1 as usize])))
        }
        // Lengths are the plugin's, or the user's.
        Plugin | User => (true, None),
    }
}

/// Rays of a rangefinder; `None` where its camera has no number of pixels, or too many.
fn rays(m: &Arrays, (kind, id): (i32, i32)) -> Option<i64> {
    if kind != ObjType::Camera.code() {
        return Some(1);
    }
    let [width, height] = m.cam_resolution[id as usize].map(i64::from);
    let most = i64::from(MAX_SAMPLES);
    ((0..=most).contains(&width) && (0..=most).contains(&height) && width * height <= most)
        .then_some(width * height)
}

/// Numbers in the data fields selected by the bits of `fields`.
fn fields_size(fields: i32, sizes: &[i64]) -> i64 {
    sizes.iter().enumerate().filter(|(bit, _)| fields >> bit & 1 == 1).map(|(_, size)| size).sum()
}

/// How many elements of a kind there are.
fn count(m: &Arrays, kind: i32) -> usize {
    match ObjType::from_code(kind) {
        Some(ObjType::Body | ObjType::Xbody) => m.nbody,
        Some(ObjType::Joint) => m.njnt,
        Some(ObjType::Dof) => m.nv,
        Some(ObjType::Geom) => m.ngeom,
        Some(ObjType::Site) => m.nsite,
        Some(ObjType::Camera) => m.ncam,
        Some(ObjType::Light) => m.nlight,
        Some(ObjType::Flex) => m.nflex,
        Some(ObjType::Mesh) => m.nmesh,
        Some(ObjType::Skin) => m.nskin,
        Some(ObjType::Hfield) => m.nhfield,
        Some(ObjType::Texture) => m.ntex,
        Some(ObjType::Material) => m.nmat,
        Some(ObjType::Pair) => m.npair,
        Some(ObjType::Exclude) => m.nexclude,
        Some(ObjType::Equality) => m.neq,
        Some(ObjType::Tendon) => m.ntendon,
        Some(ObjType::Actuator) => m.nactuator,
        Some(ObjType::Sensor) => m.nsensor,
        Some(ObjType::Numeric) => m.nnumeric,
        Some(ObjType::Text) => m.ntext,
        Some(ObjType::Tuple) => m.ntuple,
        Some(ObjType::Key) => m.nkey,
        Some(ObjType::Plugin) => m.nplugin,
        _ => 0,
    }
}
