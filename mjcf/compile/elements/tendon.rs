//! Tendons and their paths.

use crate::compile::log::{Log, title};
use crate::compile::lookup::Lookup;
use crate::compile::values::{push_user, resolve_limited, rising};
use crate::spec::{Spec, Tendon, Wrap, WrapKind};
use physics::math::Legible;
use physics::model::{GeomType, ObjType, Rows, WrapType};

/// Appends all tendons.
pub(super) fn fill(m: &mut Rows, spec: &Spec, lookup: &Lookup, log: &mut Log) {
    for tendon in &spec.tendons {
        let what = title("tendon", &tendon.name);
        m.tendon_adr.push(m.wrap_type.len() as i32);
        m.tendon_num.push(tendon.path.len() as i32);
        for wrap in &tendon.path {
            fill_wrap(m, wrap, &what, lookup, log);
        }
        let path = check_path(m, tendon);
        log.check(tendon.loc, &what, path);
        let result = fill_tendon(m, tendon, spec.compiler_at(tendon.loc).autolimits);
        log.check(tendon.loc, &what, result);
        m.tendon_matid.push(lookup.reference(ObjType::Material, &tendon.material, tendon.loc, &what, log));
    }
}

fn fill_wrap(m: &mut Rows, wrap: &Wrap, what: &str, lookup: &Lookup, log: &mut Log) {
    let mut find = |kind, name: &str| match lookup.require(kind, name, wrap.loc, what, log) {
        Some(id) => id as i32,
        None => -1,
    };
    let (kind, id, parameter) = match &wrap.kind {
        WrapKind::Joint { joint, coef } => (WrapType::Joint, find(ObjType::Joint, joint), *coef),
        WrapKind::Site { site } => (WrapType::Site, find(ObjType::Site, site), 0.0),
        WrapKind::Pulley { divisor } => (WrapType::Pulley, -1, *divisor),
        WrapKind::Geom { geom, sidesite } => {
            let id = find(ObjType::Geom, geom);
            let side = if sidesite.is_empty() { -1 } else { find(ObjType::Site, sidesite) };
            let shape = m.geom_type.get(id as usize).copied().and_then(GeomType::from_code);
            let kind = match shape {
                Some(GeomType::Cylinder) => WrapType::Cylinder,
                Some(GeomType::Sphere) | None => WrapType::Sphere,
                Some(_) => {
                    log.error(wrap.loc, format!("{what}: geom '{geom}' is neither a sphere nor a cylinder"));
                    WrapType::Sphere
                }
            };
            (kind, id, f64::from(side))
        }
    };
    if kind == WrapType::Pulley && parameter < 0.0 {
        log.error(wrap.loc, format!("{what}: the divisor of a pulley cannot be negative"));
    }
    m.wrap_type.push(kind.code());
    m.wrap_objid.push(id);
    m.wrap_prm.push(parameter);
}

/// What may follow what (XML reference, `tendon/spatial`).
fn check_path(m: &Rows, tendon: &Tendon) -> Result<(), String> {
    let count = tendon.path.len();
    let first = m.wrap_type.len() - count;
    let kinds = &m.wrap_type[first..];
    let is = |i: usize, kind: WrapType| kinds.get(i) == Some(&kind.code());
    if count == 0 {
        return Err("the path is empty".into());
    }
    if is(0, WrapType::Joint) {
        let fixed = (0..count).all(|i| is(i, WrapType::Joint));
        return if fixed { Ok(()) } else { Err("a fixed tendon takes joints only".into()) };
    }
    if count < 2 {
        return Err("a spatial tendon needs at least two path elements".into());
    }
    if tendon.width <= 0.0 {
        return Err(format!("attribute 'width' is {}: set it above 0", Legible(tendon.width)));
    }
    if tendon.armature < 0.0 {
        return Err(format!("attribute 'armature' is {}: set it to 0 or more", Legible(tendon.armature)));
    }
    for i in 0..count {
        let open = |at: Option<usize>| at.is_none_or(|k| k >= count || is(k, WrapType::Pulley));
        let (before, after) = (i.checked_sub(1), Some(i + 1));
        if is(i, WrapType::Joint) {
            return Err("a spatial tendon takes no joints".into());
        }
        if is(i, WrapType::Pulley) && (i + 1 == count || before.is_some_and(|k| is(k, WrapType::Pulley))) {
            return Err("a pulley must stand between other path elements".into());
        }
        if is(i, WrapType::Site) {
            if open(before) && open(after) {
                return Err("a site with nothing but pulleys and ends beside it has no segment: add a site next to it".into());
            }
            if is(i + 1, WrapType::Site) && m.wrap_objid[first + i] == m.wrap_objid[first + i + 1] {
                return Err("a site follows itself".into());
            }
        }
        if is(i, WrapType::Sphere) || is(i, WrapType::Cylinder) {
            if !(before.is_some_and(|k| is(k, WrapType::Site)) && is(i + 1, WrapType::Site)) {
                return Err("a geom must stand between two sites".into());
            }
            if tendon.armature > 0.0 {
                return Err("a tendon with armature cannot wrap around geoms".into());
            }
        }
    }
    Ok(())
}

fn fill_tendon(m: &mut Rows, tendon: &Tendon, autolimits: bool) -> Result<(), String> {
    let limited = resolve_limited(tendon.limited, tendon.range, autolimits, "")?;
    let force_limited = resolve_limited(tendon.actfrclimited, tendon.actfrcrange, autolimits, "actuatorfrc")?;
    if limited && tendon.range[0] >= tendon.range[1] {
        return Err(rising("range", tendon.range));
    }
    let [low, high] = tendon.actfrcrange;
    if force_limited && (low >= high || low > 0.0 || high < 0.0) {
        return Err("actuatorfrcrange must be an interval that contains 0".into());
    }
    if tendon.springlength[0] > tendon.springlength[1] {
        return Err("springlength[0] must not exceed springlength[1]".into());
    }
    m.tendon_group.push(tendon.group);
    m.tendon_limited.push(limited);
    m.tendon_actfrclimited.push(force_limited);
    m.tendon_width.push(tendon.width);
    m.tendon_solref_lim.push(tendon.solref_limit);
    m.tendon_solimp_lim.push(tendon.solimp_limit);
    m.tendon_solref_fri.push(tendon.solref_friction);
    m.tendon_solimp_fri.push(tendon.solimp_friction);
    m.tendon_range.push(tendon.range);
    m.tendon_actfrcrange.push(tendon.actfrcrange);
    m.tendon_margin.push(tendon.margin);
    m.tendon_stiffness.push(tendon.stiffness[0]);
    m.tendon_stiffnesspoly.push([tendon.stiffness[1], tendon.stiffness[2]]);
    m.tendon_damping.push(tendon.damping[0]);
    m.tendon_dampingpoly.push([tendon.damping[1], tendon.damping[2]]);
    m.tendon_armature.push(tendon.armature);
    m.tendon_frictionloss.push(tendon.frictionloss);
    m.tendon_lengthspring.push(tendon.springlength);
    m.tendon_rgba.push(tendon.rgba);
    push_user(&mut m.tendon_user, &tendon.userdata, m.nuser_tendon, "nuser_tendon")
}
