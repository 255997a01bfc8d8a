//! One set of compiler settings for all elements: angles in radians, and what attached models were compiled with said by
//! their elements.

use std::f64::consts::PI;

use physics::model::JointType;

use crate::diagnostic::Loc;
use crate::spec::{AlignFree, Body, Compiler, Joint, Limited, Orientation, Spec, UNIT, resolve};

/// A copy of `spec` whose elements mean the same under its own settings, with angles in radians.
///
/// # Errors
/// An attached model has a setting that no element can say; a keyframe of an attached model needs the whole model.
pub(super) fn settled(spec: &Spec) -> Result<Spec, String> {
    if !spec.kept_keys.is_empty() {
        return Err("keyframes of attached models have no place in the file yet: compile the model and call `settle_keys`"
            .into());
    }
    let mut out = spec.clone();
    let uniform = spec.attached.values().all(|c| c.autolimits == spec.compiler.autolimits);
    out.compiler.autolimits |= !uniform;
    out.compiler.degree = false;
    out.attached.clear();
    for attached in spec.attached.values() {
        check_sayable(attached, &spec.compiler)?;
    }
    for frame in &mut out.frames {
        turn(spec, frame.loc, &mut frame.quat, &mut frame.alt)?;
    }
    let mut pending = vec![&mut out.world];
    while let Some(body) = pending.pop() {
        settle_body(spec, body)?;
        pending.extend(body.bodies.iter_mut());
    }
    Ok(out)
}

/// Settings of an attached model that bodies and geoms are compiled with, and that only `compiler` can say.
fn check_sayable(attached: &Compiler, own: &Compiler) -> Result<(), String> {
    let differs = [
        ("boundmass", attached.boundmass != own.boundmass),
        ("boundinertia", attached.boundinertia != own.boundinertia),
        ("balanceinertia", attached.balanceinertia != own.balanceinertia),
        ("fitaabb", attached.fitaabb != own.fitaabb),
        ("inertiafromgeom", attached.inertiafromgeom != own.inertiafromgeom),
        ("inertiagrouprange", attached.inertiagrouprange != own.inertiagrouprange),
    ];
    match differs.iter().find(|(_, differs)| *differs) {
        Some((name, _)) => Err(format!(
            "an attached model has another '{name}' in <compiler>, and one file has room for one: give both models the same"
        )),
        None => Ok(()),
    }
}

fn settle_body(spec: &Spec, body: &mut Body) -> Result<(), String> {
    turn(spec, body.loc, &mut body.quat, &mut body.alt)?;
    if let Some(inertial) = &mut body.inertial {
        // An inertial is compiled with the settings of its body.
        turn(spec, body.loc, &mut inertial.quat, &mut inertial.alt)?;
    }
    let align = spec.compiler_at(body.loc).alignfree;
    for joint in &mut body.joints {
        settle_joint(spec.compiler_at(joint.loc), joint);
        if joint.align == AlignFree::Auto && joint.kind == JointType::Free && align != spec.compiler.alignfree
        {
            joint.align = if align { AlignFree::True } else { AlignFree::False };
        }
    }
    for geom in &mut body.geoms {
        turn(spec, geom.loc, &mut geom.quat, &mut geom.alt)?;
    }
    for site in &mut body.sites {
        turn(spec, site.loc, &mut site.quat, &mut site.alt)?;
    }
    for camera in &mut body.cameras {
        turn(spec, camera.loc, &mut camera.quat, &mut camera.alt)?;
    }
    Ok(())
}

/// The compiler's own conversions, so that the same bits come out.
fn settle_joint(settings: &Compiler, joint: &mut Joint) {
    if !settings.degree {
        return;
    }
    let rotates = matches!(joint.kind, JointType::Hinge | JointType::Ball);
    let limited = match joint.limited {
        Limited::False => false,
        Limited::True => true,
        Limited::Auto => joint.range[0] < joint.range[1],
    };
    // A range that bounds nothing is kept as it is written.
    if rotates && limited {
        joint.range = joint.range.map(|x| x * (PI / 180.0));
    }
    if joint.kind == JointType::Hinge {
        joint.ref_ *= PI / 180.0;
        joint.springref *= PI / 180.0;
    }
}

fn turn(spec: &Spec, loc: Loc, quat: &mut [f64; 4], alt: &mut Option<Orientation>) -> Result<(), String> {
    let settings = spec.compiler_at(loc);
    let Some(orientation) = alt else { return Ok(()) };
    if matches!(orientation, Orientation::Euler(_)) && settings.eulerseq != spec.compiler.eulerseq {
        *quat = resolve(UNIT, *alt, settings)?;
        *alt = None;
        return Ok(());
    }
    if settings.degree {
        let radians = |x: f64| x / 180.0 * PI;
        match orientation {
            Orientation::AxisAngle([.., angle]) => *angle = radians(*angle),
            Orientation::Euler(angles) => *angles = angles.map(radians),
            Orientation::XyAxes(_) | Orientation::ZAxis(_) => {}
        }
    }
    Ok(())
}
