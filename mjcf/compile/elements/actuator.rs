//! Actuators: transmission, input and output blocks, ranges (XML reference, `actuator`).

use crate::compile::log::{Log, title};
use crate::compile::lookup::Lookup;
use crate::compile::plugins::Plugins;
use crate::compile::values::{bounded, push_user, resolve_limited, rising};
use crate::spec::{Actuator, Spec};
use physics::math::Legible;
use physics::model::input::{self, EXPONENTIAL_MAP, FEED_FORWARD, POSITION, QUATERNION, VELOCITY, VOLTAGE};
use physics::model::{BiasType, DynType, GainType, JointType, ObjType, Rows, TrnType};
use physics::plugin::Capability;

/// What is wrong with an actuator that names nothing to act on.
const NO_TARGET: &str =
    "it acts on nothing: set joint, jointinparent, tendon, site, body, or cranksite and slidersite";

/// Inputs, outputs and activations that a type of actuator has.
struct Block {
    ctrlspec: i32,
    ctrlnum: usize,
    outnum: usize,
    actdim: i32,
    so3: bool,
}

/// Appends all actuators.
pub(super) fn fill(m: &mut Rows, (spec, plugins): (&Spec, &Plugins), lookup: &Lookup, log: &mut Log) {
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
        m.actuator_plugin.push(plugins.id(actuator.plugin.as_ref(), (Capability::Actuator, &what), log));
    }
    m.nhistory = historyadr as usize;
}

/// Ids of target and reference.
fn transmission(actuator: &Actuator, lookup: &Lookup, what: &str, log: &mut Log) -> [i32; 2] {
    let loc = actuator.loc;
    if actuator.target.is_empty() {
        log.error(loc, format!("{what}: {NO_TARGET}"));
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
            log.error(loc, format!("{what}: 'cranksite' moves a crank along a slide: set 'slidersite' too"));
            [-1, -1]
        }
        TrnType::Slidercrank if actuator.cranklength <= 0.0 => {
            log.error(
                loc,
                format!(
                    "{what}: attribute 'cranklength' is {}: set a length above 0",
                    Legible(actuator.cranklength)
                ),
            );
            [-1, -1]
        }
        TrnType::Slidercrank => {
            let slider = find(ObjType::Site, &actuator.slidersite);
            [find(ObjType::Site, &actuator.target), slider]
        }
        TrnType::So3 | TrnType::Undefined => {
            log.error(loc, format!("{what}: {NO_TARGET}"));
            [-1, -1]
        }
    }
}

/// Checks the type-specific rules and finds the sizes.
fn block(m: &Rows, a: &Actuator, trnid: [i32; 2], forcelimited: bool) -> Result<Block, String> {
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
        return Err("dyntype=\"pid\" works only with gaintype=\"pid\": set both, or another dyntype".into());
    }
    if a.ctrlspec != 0 && !matches!(a.gaintype, GainType::So3 | GainType::Pid | GainType::Dcmotor) {
        return Err(
            "attribute 'input' means something to so3, pid and dcmotor actuators alone: remove it".into()
        );
    }
    let stateless = a.dyntype == DynType::None;
    if a.plugin.is_some() {
        bounded(block.actdim.max(0).into(), "actdim")?;
        if block.actdim < 0 {
            block.actdim = i32::from(!stateless && a.dyntype != DynType::Dcmotor);
        }
        return Ok(block);
    }
    if block.actdim > 1 && !matches!(a.dyntype, DynType::User | DynType::Dcmotor) && !block.so3 {
        // MuJoCo 3.12 applies this rule to pid controllers too.
        return Err(format!(
            "attribute 'actdim' is {}: dyntypes other than 'user' and 'dcmotor' have at most one activation",
            block.actdim
        ));
    }
    bounded(block.actdim.max(0).into(), "actdim")?;
    if block.actdim == 1 && stateless {
        return Err(
            "attribute 'actdim' is 1, but dyntype=\"none\" has no activation: remove it, or set a dyntype"
                .into(),
        );
    }
    if block.actdim == 0 && !stateless && a.dyntype != DynType::Dcmotor {
        return Err("attribute 'actdim' is 0, but this dyntype has an activation: remove it".into());
    }
    if block.actdim < 0 {
        block.actdim = i32::from(!stateless && a.dyntype != DynType::Dcmotor);
    }
    if a.dyntype == DynType::Dcmotor && !a.actearly {
        return Err("attribute 'actearly' must be true for a dcmotor: remove it, or set it to true".into());
    }
    Ok(block)
}

fn so3_block(
    m: &Rows,
    a: &Actuator,
    trnid: [i32; 2],
    limited: bool,
    block: &mut Block,
) -> Result<(), String> {
    if a.gaintype != GainType::So3 || a.biastype != BiasType::So3 {
        return Err("gaintype=\"so3\" and biastype=\"so3\" go together: set both or neither".into());
    }
    if !matches!(a.dyntype, DynType::None | DynType::Integrator) {
        return Err("attribute 'dyntype' of an so3 actuator: choose 'none' or 'integrator'".into());
    }
    if a.gainprm[0] != -a.biasprm[1] {
        return Err("an so3 actuator has one stiffness: the second number of 'biasprm' must be minus the first of 'gainprm'".into());
    }
    let ball = a.trntype == TrnType::Joint && m.jnt_type[trnid[0] as usize] == JointType::Ball.code();
    let sites = a.trntype == TrnType::Site && trnid[1] >= 0;
    if !ball && !sites {
        return Err("an so3 actuator turns a ball joint, or a site against another: set 'joint', or 'site' and 'refsite'".into());
    }
    if a.dyntype == DynType::Integrator {
        if a.actdim > 0 && a.actdim != 3 {
            return Err(format!(
                "attribute 'actdim' is {}, but an so3 integrator has 3 activations: remove it",
                a.actdim
            ));
        }
        block.actdim = 3;
    }
    block.ctrlspec = if a.ctrlspec == 0 { EXPONENTIAL_MAP } else { a.ctrlspec };
    block.ctrlnum = match block.ctrlspec {
        EXPONENTIAL_MAP => 3,
        QUATERNION if a.dyntype == DynType::None => 4,
        QUATERNION => {
            return Err(
                "input=\"quat\" cannot be integrated: set dyntype=\"none\", or input=\"expmap\"".into()
            );
        }
        _ => return Err("attribute 'input' of an so3 actuator: choose expmap or quat".into()),
    };
    if limited && a.forcerange[0] != 0.0 {
        return Err("attribute 'forcerange' of an so3 actuator bounds the size of a torque: its first number must be 0".into());
    }
    block.outnum = 3;
    block.so3 = true;
    Ok(())
}

fn pid_block(a: &Actuator, block: &mut Block) -> Result<(), String> {
    if a.biastype != BiasType::Affine || !matches!(a.dyntype, DynType::None | DynType::Pid) {
        return Err(
            "gaintype=\"pid\" goes with biastype=\"affine\", and dyntype 'none' or 'pid': set these".into()
        );
    }
    if a.dyntype == DynType::None && a.gainprm[0] != 0.0 {
        return Err(
            "the integral gain (first number of 'gainprm') needs an activation: set dyntype=\"pid\"".into()
        );
    }
    if a.trntype == TrnType::Body {
        return Err("a pid actuator cannot act on a body: set joint, tendon or site".into());
    }
    if a.dyntype == DynType::Pid {
        if a.dynprm[0] < 0.0 || a.dynprm[1] < 0.0 {
            return Err(
                "the first two numbers of 'dynprm' (imax and slewmax) are bounds: set them to 0 or more"
                    .into(),
            );
        }
        let states = i32::from(a.dynprm[1] > 0.0) + i32::from(a.gainprm[0] > 0.0);
        if a.actdim > 0 && a.actdim != states {
            return Err(format!(
                "attribute 'actdim' is {}, but the gains make it {states}: remove it",
                a.actdim
            ));
        }
        block.actdim = states;
    }
    block.ctrlspec = if a.ctrlspec == 0 { POSITION | VELOCITY } else { a.ctrlspec };
    if block.ctrlspec & !(POSITION | VELOCITY | FEED_FORWARD) != 0 {
        return Err("attribute 'input' of a pid actuator: use only the words pos, vel and ff".into());
    }
    if a.dyntype == DynType::Pid && block.ctrlspec & POSITION == 0 {
        return Err("integral and slew rate follow a commanded position: add pos to attribute 'input'".into());
    }
    block.ctrlnum = block.ctrlspec.count_ones() as usize;
    Ok(())
}

fn dcmotor_block(a: &Actuator, block: &mut Block) -> Result<(), String> {
    block.ctrlspec = if a.ctrlspec == 0 { VOLTAGE } else { a.ctrlspec };
    if block.ctrlspec != input::NONE && block.ctrlspec & !input::ALL != 0 {
        return Err(
            "attribute 'input' of a dcmotor: write none, or words among pos, vel, ff and voltage".into()
        );
    }
    let controller = block.ctrlspec & (POSITION | VELOCITY | FEED_FORWARD) != 0;
    if controller && a.gainprm[1] <= 0.0 {
        return Err(
            "the inputs pos, vel and ff are turned into a voltage by 'motorconst': set it above 0".into()
        );
    }
    if !controller && (a.gainprm[4..7].iter().any(|&g| g != 0.0) || a.dynprm[7] > 0.0) {
        return Err(
            "attribute 'controller' has no input to act on: add pos, vel or ff to 'input', or remove it"
                .into(),
        );
    }
    if a.gainprm[5] > 0.0 && block.ctrlspec & POSITION == 0 {
        return Err(
            "the integral gain in 'controller' acts on a commanded position: add pos to 'input'".into()
        );
    }
    block.ctrlnum = (block.ctrlspec & input::ALL).count_ones() as usize;
    Ok(())
}

/// `ctrlrange` and `actrange`, one of them from the target when `inheritrange` is set.
fn ranges(m: &Rows, a: &Actuator, trnid: [i32; 2]) -> Result<([f64; 2], [f64; 2]), String> {
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
        _ => return Err("attribute 'inheritrange' takes the range of a hinge, a slide or a tendon: act on one, or remove it".into()),
    };
    if target[0] == target[1] {
        return Err(format!(
            "attribute 'inheritrange' finds no range: give '{}' one, or remove it",
            a.target
        ));
    }
    let mean = 0.5 * (target[1] + target[0]);
    let radius = 0.5 * (target[1] - target[0]) * a.inheritrange;
    let range = match a.dyntype {
        DynType::None | DynType::Filterexact | DynType::Pid => &mut ctrl,
        DynType::Integrator => &mut act,
        _ => return Err("attribute 'inheritrange' fits no actuator of this dyntype: set 'ctrlrange' or 'actrange' instead".into()),
    };
    *range = [mean - radius, mean + radius];
    Ok((ctrl, act))
}

fn check_muscle(prm: &[f64; 10]) -> Result<(), String> {
    if prm[0] >= prm[1] {
        return Err(rising("range", [prm[0], prm[1]]));
    }
    if prm[4] >= 1.0 || prm[5] <= 1.0 {
        return Err(format!(
            "a muscle works around length 1: 'lmin' is {}, set it below; 'lmax' is {}, set it above",
            Legible(prm[4]),
            Legible(prm[5])
        ));
    }
    if prm[3] <= 0.0 || prm[6] <= 0.0 || prm[7] <= 0.0 || prm[8] <= 0.0 {
        return Err("attributes 'scale', 'vmax', 'fpmax' and 'fvmax' of a muscle: set each above 0".into());
    }
    Ok(())
}

fn check(a: &Actuator, block: &Block) -> Result<(), String> {
    let chained = matches!(a.trntype, TrnType::Joint | TrnType::Jointinparent | TrnType::Tendon);
    if !chained && (a.damping != [0.0; 3] || a.armature != 0.0) {
        return Err("attributes 'damping' and 'armature' belong to a joint or tendon: remove them".into());
    }
    if a.gaintype == GainType::Muscle {
        check_muscle(&a.gainprm)?;
    }
    if a.biastype == BiasType::Muscle {
        check_muscle(&a.biasprm)?;
    }
    if a.delay > 0.0 && a.nsample <= 0 {
        return Err("attribute 'delay' reads past inputs: set 'nsample' to the number that is kept".into());
    }
    if (a.delay > 0.0 || a.nsample > 0) && block.ctrlnum == 0 {
        return Err(
            "attributes 'delay' and 'nsample' keep past inputs, and this actuator has none: remove them"
                .into(),
        );
    }
    Ok(())
}

fn fill_actuator(
    m: &mut Rows,
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
            return Err(rising(&format!("{name}range"), range));
        }
    }
    if actlimited && a.dyntype == DynType::None {
        return Err(
            "attribute 'actrange' bounds an activation, and dyntype=\"none\" has none: remove it".into()
        );
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
fn fill_inputs(m: &mut Rows, a: &Actuator, block: &Block, limited: bool, range: [f64; 2]) {
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
