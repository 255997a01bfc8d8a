//! Actuators: transmission, input and output blocks, ranges (XML reference, `actuator`).

use super::log::{Log, title};
use super::lookup::Lookup;
use super::values::{bounded, push_user, resolve_limited};
use crate::spec::{Actuator, Spec};
use physics::model::input::{self, EXPONENTIAL_MAP, FEED_FORWARD, POSITION, QUATERNION, VELOCITY, VOLTAGE};
use physics::model::{Arrays, BiasType, DynType, GainType, JointType, ObjType, TrnType};

/// Inputs, outputs and activations that a type of actuator has.
struct Block {
    ctrlspec: i32,
    ctrlnum: usize,
    outnum: usize,
    actdim: i32,
    so3: bool,
}

/// Appends all actuators.
pub(super) fn fill(m: &mut Arrays, spec: &Spec, lookup: &Lookup, log: &mut Log) {
    let (mut actadr, mut historyadr) = (0, 0);
    for actuator in &spec.actuators {
        let what = title("actuator", &actuator.name);
        let trnid = transmission(actuator, lookup, &what, log);
        if log.diagnostics.has_errors() && trnid[0] < 0 {
            continue;
        }
        let result = fill_actuator(
            m,
            actuator,
            trnid,
            spec.compiler_at(actuator.loc).autolimits,
            &mut actadr,
            &mut historyadr,
        );
        log.check(actuator.loc, &what, result);
    }
    m.nhistory = historyadr as usize;
}

/// Ids of target and reference.
fn transmission(actuator: &Actuator, lookup: &Lookup, what: &str, log: &mut Log) -> [i32; 2] {
    let loc = actuator.loc;
    if actuator.target.is_empty() {
        log.error(loc, format!("{what}: no transmission target"));
        return [-1, -1];
    }
    let mut find = |kind, name: &str| match lookup.require(kind, name, loc, what, log) {
        Some(id) => id as i32,
        None => -1,
    };
    match actuator.trntype {
        TrnType::Joint | TrnType::Jointinparent => [find(ObjType::Joint, &actuator.target), -1],
        TrnType::Tendon => [find(ObjType::Tendon, &actuator.target), -1],
        TrnType::Body => [find(ObjType::Body, &actuator.target), -1],
        TrnType::Site => {
            let reference =
                if actuator.refsite.is_empty() { -1 } else { find(ObjType::Site, &actuator.refsite) };
            [find(ObjType::Site, &actuator.target), reference]
        }
        TrnType::Slidercrank if actuator.slidersite.is_empty() => {
            log.error(loc, format!("{what}: a slider-crank needs slidersite"));
            [-1, -1]
        }
        TrnType::Slidercrank if actuator.cranklength <= 0.0 => {
            log.error(loc, format!("{what}: cranklength must be positive"));
            [-1, -1]
        }
        TrnType::Slidercrank => {
            let slider = find(ObjType::Site, &actuator.slidersite);
            [find(ObjType::Site, &actuator.target), slider]
        }
        TrnType::So3 | TrnType::Undefined => {
            log.error(loc, format!("{what}: no transmission target"));
            [-1, -1]
        }
    }
}

/// Checks the type-specific rules and finds the sizes.
fn block(m: &Arrays, a: &Actuator, trnid: [i32; 2], forcelimited: bool) -> Result<Block, String> {
    let mut block = Block { ctrlspec: 0, ctrlnum: 1, outnum: 1, actdim: a.actdim, so3: false };
    if a.gaintype == GainType::So3 || a.biastype == BiasType::So3 {
        so3_block(m, a, trnid, forcelimited, &mut block)?;
    }
    match a.gaintype {
        GainType::Pid => pid_block(a, &mut block)?,
        GainType::Dcmotor => dcmotor_block(a, &mut block)?,
        _ => {}
    }
    if a.dyntype == DynType::Pid && a.gaintype != GainType::Pid {
        return Err("dyntype 'pid' requires gaintype 'pid'".into());
    }
    if a.ctrlspec != 0 && !matches!(a.gaintype, GainType::So3 | GainType::Pid | GainType::Dcmotor) {
        return Err("input is only for so3, pid and dcmotor actuators".into());
    }
    let stateless = a.dyntype == DynType::None;
    if block.actdim > 1 && !matches!(a.dyntype, DynType::User | DynType::Dcmotor) && !block.so3 {
        // MuJoCo 3.12 applies this rule to pid controllers too.
        return Err("actdim above 1 is only for dyntype 'user' and 'dcmotor'".into());
    }
    bounded(block.actdim.max(0).into(), "actdim")?;
    if block.actdim == 1 && stateless {
        return Err("actdim 1 in a stateless actuator".into());
    }
    if block.actdim == 0 && !stateless && a.dyntype != DynType::Dcmotor {
        return Err("actdim 0 in a stateful actuator".into());
    }
    if block.actdim < 0 {
        block.actdim = i32::from(!stateless && a.dyntype != DynType::Dcmotor);
    }
    if a.dyntype == DynType::Dcmotor && !a.actearly {
        return Err("a dcmotor needs actearly".into());
    }
    Ok(block)
}

fn so3_block(
    m: &Arrays,
    a: &Actuator,
    trnid: [i32; 2],
    limited: bool,
    block: &mut Block,
) -> Result<(), String> {
    if a.gaintype != GainType::So3 || a.biastype != BiasType::So3 {
        return Err("gaintype and biastype must both be 'so3'".into());
    }
    if !matches!(a.dyntype, DynType::None | DynType::Integrator) {
        return Err("so3 requires dyntype 'none' or 'integrator'".into());
    }
    if a.gainprm[0] != -a.biasprm[1] {
        return Err("so3 requires gainprm[0] == -biasprm[1]".into());
    }
    let ball = a.trntype == TrnType::Joint && m.jnt_type[trnid[0] as usize] == JointType::Ball.code();
    let sites = a.trntype == TrnType::Site && trnid[1] >= 0;
    if !ball && !sites {
        return Err("so3 requires a ball joint, or a site with refsite".into());
    }
    if a.dyntype == DynType::Integrator {
        if a.actdim > 0 && a.actdim != 3 {
            return Err("an so3 integrator requires actdim 3".into());
        }
        block.actdim = 3;
    }
    block.ctrlspec = if a.ctrlspec == 0 { EXPONENTIAL_MAP } else { a.ctrlspec };
    block.ctrlnum = match block.ctrlspec {
        EXPONENTIAL_MAP => 3,
        QUATERNION if a.dyntype == DynType::None => 4,
        QUATERNION => return Err("so3 quat input requires dyntype 'none'".into()),
        _ => return Err("so3 input must be expmap or quat".into()),
    };
    if limited && a.forcerange[0] != 0.0 {
        return Err("forcerange bounds the norm of an so3 torque: its lower bound must be 0".into());
    }
    block.outnum = 3;
    block.so3 = true;
    Ok(())
}

fn pid_block(a: &Actuator, block: &mut Block) -> Result<(), String> {
    if a.biastype != BiasType::Affine || !matches!(a.dyntype, DynType::None | DynType::Pid) {
        return Err("pid requires biastype 'affine' and dyntype 'none' or 'pid'".into());
    }
    if a.dyntype == DynType::None && a.gainprm[0] != 0.0 {
        return Err("ki requires dyntype 'pid'".into());
    }
    if a.trntype == TrnType::Body {
        return Err("pid cannot act on a body".into());
    }
    if a.dyntype == DynType::Pid {
        if a.dynprm[0] < 0.0 || a.dynprm[1] < 0.0 {
            return Err("imax and slewmax cannot be negative".into());
        }
        let states = i32::from(a.dynprm[1] > 0.0) + i32::from(a.gainprm[0] > 0.0);
        if a.actdim > 0 && a.actdim != states {
            return Err(format!("actdim must be {states}"));
        }
        block.actdim = states;
    }
    block.ctrlspec = if a.ctrlspec == 0 { POSITION | VELOCITY } else { a.ctrlspec };
    if block.ctrlspec & !(POSITION | VELOCITY | FEED_FORWARD) != 0 {
        return Err("pid inputs are a subset of [pos, vel, ff]".into());
    }
    if a.dyntype == DynType::Pid && block.ctrlspec & POSITION == 0 {
        return Err("pid controller states require the pos input".into());
    }
    block.ctrlnum = block.ctrlspec.count_ones() as usize;
    Ok(())
}

fn dcmotor_block(a: &Actuator, block: &mut Block) -> Result<(), String> {
    block.ctrlspec = if a.ctrlspec == 0 { VOLTAGE } else { a.ctrlspec };
    if block.ctrlspec != input::NONE && block.ctrlspec & !input::ALL != 0 {
        return Err("dcmotor inputs are 'none' or a subset of [pos, vel, ff, voltage]".into());
    }
    let controller = block.ctrlspec & (POSITION | VELOCITY | FEED_FORWARD) != 0;
    if controller && a.gainprm[1] <= 0.0 {
        return Err("dcmotor controller inputs require a positive motor constant".into());
    }
    if !controller && (a.gainprm[4..7].iter().any(|&g| g != 0.0) || a.dynprm[7] > 0.0) {
        return Err("dcmotor controller gains require an input of [pos, vel, ff]".into());
    }
    if a.gainprm[5] > 0.0 && block.ctrlspec & POSITION == 0 {
        return Err("dcmotor integral gain requires the pos input".into());
    }
    block.ctrlnum = (block.ctrlspec & input::ALL).count_ones() as usize;
    Ok(())
}

/// `ctrlrange` and `actrange`, one of them from the target when `inheritrange` is set.
fn ranges(m: &Arrays, a: &Actuator, trnid: [i32; 2]) -> Result<([f64; 2], [f64; 2]), String> {
    let (mut ctrl, mut act) = (a.ctrlrange, a.actrange);
    let position =
        (a.gaintype == GainType::Fixed && a.gainprm[0] == -a.biasprm[1]) || a.gaintype == GainType::Pid;
    if !position || a.biastype != BiasType::Affine || a.inheritrange <= 0.0 {
        return Ok((ctrl, act));
    }
    let id = trnid[0] as usize;
    let target = match a.trntype {
        TrnType::Joint if [JointType::Hinge.code(), JointType::Slide.code()].contains(&m.jnt_type[id]) => {
            m.jnt_range[id]
        }
        TrnType::Tendon => m.tendon_range.get(id).copied().unwrap_or_default(),
        _ => return Err("inheritrange needs a hinge, a slide or a tendon".into()),
    };
    if target[0] == target[1] {
        return Err(format!("inheritrange, but '{}' has no range", a.target));
    }
    let mean = 0.5 * (target[1] + target[0]);
    let radius = 0.5 * (target[1] - target[0]) * a.inheritrange;
    let range = match a.dyntype {
        DynType::None | DynType::Filterexact | DynType::Pid => &mut ctrl,
        DynType::Integrator => &mut act,
        _ => return Err("inheritrange is only for position and intvelocity actuators".into()),
    };
    *range = [mean - radius, mean + radius];
    Ok((ctrl, act))
}

fn check_muscle(prm: &[f64; 10]) -> Result<(), String> {
    if prm[0] >= prm[1] {
        return Err("range[0] < range[1] required in a muscle".into());
    }
    if prm[4] >= 1.0 || prm[5] <= 1.0 {
        return Err("lmin < 1 < lmax required in a muscle".into());
    }
    if prm[3] <= 0.0 || prm[6] <= 0.0 || prm[7] <= 0.0 || prm[8] <= 0.0 {
        return Err("positive scale, vmax, fpmax and fvmax required in a muscle".into());
    }
    Ok(())
}

fn check(a: &Actuator, block: &Block) -> Result<(), String> {
    let chained = matches!(a.trntype, TrnType::Joint | TrnType::Jointinparent | TrnType::Tendon);
    if !chained && (a.damping != [0.0; 3] || a.armature != 0.0) {
        return Err("damping and armature require a joint or tendon".into());
    }
    if a.gaintype == GainType::Muscle {
        check_muscle(&a.gainprm)?;
    }
    if a.biastype == BiasType::Muscle {
        check_muscle(&a.biasprm)?;
    }
    if a.delay > 0.0 && a.nsample <= 0 {
        return Err("delay needs a history buffer (nsample)".into());
    }
    if (a.delay > 0.0 || a.nsample > 0) && block.ctrlnum == 0 {
        return Err("history and delay require an input".into());
    }
    Ok(())
}

fn fill_actuator(
    m: &mut Arrays,
    a: &Actuator,
    trnid: [i32; 2],
    autolimits: bool,
    actadr: &mut i32,
    historyadr: &mut i32,
) -> Result<(), String> {
    let forcelimited = resolve_limited(a.forcelimited, a.forcerange, autolimits, "force")?;
    let block = block(m, a, trnid, forcelimited)?;
    let (ctrlrange, actrange) = ranges(m, a, trnid)?;
    let ctrllimited = resolve_limited(a.ctrllimited, ctrlrange, autolimits, "ctrl")?;
    let mut actlimited = resolve_limited(a.actlimited, actrange, autolimits, "act")?;
    if block.so3 && a.dyntype == DynType::Integrator && actrange == [0.0, 0.0] {
        actlimited = false;
    }
    for (limited, range, name) in [
        (forcelimited, a.forcerange, "force"),
        (ctrllimited, ctrlrange, "ctrl"),
        (actlimited, actrange, "act"),
    ] {
        if limited && range[0] >= range[1] {
            return Err(format!("{name}range[0] must be smaller than {name}range[1]"));
        }
    }
    if actlimited && a.dyntype == DynType::None {
        return Err("actrange, but dyntype is 'none'".into());
    }
    check(a, &block)?;
    let samples = if a.nsample > 0 { 2 + 2 * i64::from(a.nsample) } else { 0 };
    bounded(i64::from(*historyadr) + samples, "the history of all actuators")?;
    bounded(i64::from(*actadr) + i64::from(block.actdim), "actdim of all actuators")?;
    m.actuator_trntype.push(if block.so3 { TrnType::So3 } else { a.trntype }.code());
    m.actuator_dyntype.push(a.dyntype.code());
    m.actuator_gaintype.push(a.gaintype.code());
    m.actuator_biastype.push(a.biastype.code());
    m.actuator_ctrladr.push(m.actuator_ctrllimited.len() as i32);
    m.actuator_ctrlnum.push(block.ctrlnum as i32);
    m.actuator_ctrlspec.push(block.ctrlspec);
    m.actuator_outadr.push(m.actuator_gear.len() as i32);
    m.actuator_outnum.push(block.outnum as i32);
    m.actuator_actadr.push(if block.actdim > 0 { *actadr } else { -1 });
    m.actuator_actnum.push(block.actdim);
    *actadr += block.actdim;
    m.actuator_trnid.push(trnid);
    m.actuator_cranklength.push(a.cranklength);
    m.actuator_dynprm.push(a.dynprm);
    m.actuator_gainprm.push(a.gainprm);
    m.actuator_biasprm.push(a.biasprm);
    m.actuator_actlimited.push(actlimited);
    m.actuator_actrange.push(actrange);
    m.actuator_actearly.push(a.actearly);
    m.actuator_history.push([a.nsample, a.interp]);
    m.actuator_historyadr.push(if a.nsample > 0 { *historyadr } else { -1 });
    *historyadr += samples as i32;
    m.actuator_delay.push(a.delay);
    m.actuator_damping.push(a.damping[0]);
    m.actuator_dampingpoly.push([a.damping[1], a.damping[2]]);
    m.actuator_armature.push(a.armature);
    m.actuator_group.push(a.group);
    m.actuator_forcelimited.push(forcelimited);
    m.actuator_forcerange.push(a.forcerange);
    fill_inputs(m, a, &block, ctrllimited, ctrlrange);
    for _ in 0..block.outnum {
        m.actuator_gear.push(a.gear);
        m.actuator_lengthrange.push(a.lengthrange);
    }
    push_user(&mut m.actuator_user, &a.userdata, m.nuser_actuator, "nuser_actuator")
}

/// One control range an input; pid servos bound velocity and feedforward apart.
fn fill_inputs(m: &mut Arrays, a: &Actuator, block: &Block, limited: bool, range: [f64; 2]) {
    let mut inputs = vec![(limited, range); block.ctrlnum];
    if a.gaintype == GainType::Pid {
        inputs.clear();
        for (bit, entry) in [
            (POSITION, (limited, range)),
            (VELOCITY, (a.velrange[0] < a.velrange[1], a.velrange)),
            (FEED_FORWARD, (a.ffrange[0] < a.ffrange[1], a.ffrange)),
        ] {
            inputs.extend((block.ctrlspec & bit != 0).then_some(entry));
        }
    }
    for (limited, range) in inputs {
        m.actuator_ctrllimited.push(limited);
        m.actuator_ctrlrange.push(range);
    }
}
