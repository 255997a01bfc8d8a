//! Actuators in general form; one that takes its range from its target keeps the shortcut, which alone can say so.

use physics::model::{BiasType, DynType, GainType, TrnType, input};

use super::plugin;
use super::rows::put_rows;
use super::text::{element, number};
use crate::schema::Row;
use crate::schema::actuator::{
    ALONE, BLOCKS, DYNAMICS_ROWS, GENERAL_ROWS, POSITION_RANGE, SETPOINT_RANGES, TOGETHER,
};
use crate::spec::{Actuator, Spec};
use crate::xml::Element;

/// All actuators.
///
/// # Errors
/// An actuator inherits a range and is no position servo.
pub(super) fn actuators(spec: &Spec) -> Result<Element, String> {
    let mut out = element("actuator");
    for one in &spec.actuators {
        out.children.push(actuator(one)?);
    }
    Ok(out)
}

/// One actuator.
///
/// # Errors
/// It inherits a range and is no position servo.
pub(crate) fn actuator(actuator: &Actuator) -> Result<Element, String> {
    let driven = actuator.plugin.is_some();
    let inherits = actuator.inheritrange > 0.0 && !driven;
    let mut out = match inherits {
        true => servo(actuator)?,
        false if actuator.plugin.is_some() => element("plugin"),
        false => element("general"),
    };
    let general = std::mem::take(&mut out.attributes);
    let base = Actuator::default();
    let stated = |block: &[Row<Actuator>]| match () {
        _ if same(block, &POSITION_RANGE) => true,
        _ if inherits => same(block, &GENERAL_ROWS) || same(block, &DYNAMICS_ROWS),
        _ => driven && (same(block, &GENERAL_ROWS) || same(block, &SETPOINT_RANGES)),
    };
    for block in BLOCKS.iter().filter(|block| !stated(block)) {
        put_rows(&mut out, block, actuator, &base);
    }
    out.attributes.extend(general);
    put_transmission(&mut out, actuator);
    if let Some(used) = &actuator.plugin {
        plugin::put_use(&mut out, used);
        return Ok(out);
    }
    if actuator.ctrlspec != 0 {
        out.put("input", input_words(actuator.ctrlspec));
    }
    Ok(out)
}

fn same(a: &[Row<Actuator>], b: &[Row<Actuator>]) -> bool {
    std::ptr::eq(a.as_ptr(), b.as_ptr())
}

fn put_transmission(out: &mut Element, actuator: &Actuator) {
    let attribute = match actuator.trntype {
        TrnType::Joint => Some("joint"),
        TrnType::Jointinparent => Some("jointinparent"),
        TrnType::Tendon => Some("tendon"),
        TrnType::Slidercrank => Some("cranksite"),
        TrnType::Site => Some("site"),
        TrnType::Body => Some("body"),
        _ => None,
    };
    let named = [
        (attribute, &actuator.target),
        (Some("slidersite"), &actuator.slidersite),
        (Some("refsite"), &actuator.refsite),
    ];
    for (attribute, name) in named {
        if let Some(attribute) = attribute.filter(|_| !name.is_empty()) {
            out.put(attribute, name);
        }
    }
}

fn input_words(code: i32) -> String {
    if let Some((word, _)) = ALONE.iter().find(|(_, alone)| *alone == code) {
        return (*word).to_owned();
    }
    let set = TOGETHER.iter().filter(|(_, bit)| code & input::ALL & bit != 0);
    set.map(|(word, _)| *word).collect::<Vec<_>>().join(" ")
}

/// The shortcut for a servo whose range is its target's, with its gains.
fn servo(a: &Actuator) -> Result<Element, String> {
    let what = match a.name.is_empty() {
        true => format!("the actuator of '{}'", a.target),
        false => format!("actuator '{}'", a.name),
    };
    let mut out = element(match (a.gaintype, a.biastype, a.dyntype) {
        (GainType::Fixed, BiasType::Affine, DynType::None | DynType::Filterexact) => "position",
        (GainType::Fixed, BiasType::Affine, DynType::Integrator) => "intvelocity",
        (GainType::Pid, BiasType::Affine, DynType::None | DynType::Pid) => "pid",
        _ => return Err(format!("{what} inherits a range and is no position servo: set its range instead")),
    });
    out.put("kp", number(-a.biasprm[1]));
    match a.biasprm[2] > 0.0 {
        true => out.put("dampratio", number(a.biasprm[2])),
        false => out.put("kv", number(-a.biasprm[2])),
    }
    if a.gaintype == GainType::Pid {
        out.put("ki", number(a.gainprm[0]));
        out.put("imax", number(a.dynprm[0]));
        out.put("slewmax", number(a.dynprm[1]));
    } else if a.dyntype == DynType::Filterexact {
        out.put("timeconst", number(a.dynprm[0]));
    }
    out.put("inheritrange", number(a.inheritrange));
    Ok(out)
}
