//! Joints and their degrees of freedom.

use crate::compile::frame::{Pose, direction};
use crate::compile::log::{Log, title};
use crate::compile::nodes::{BodyNode, JointNode};
use crate::compile::values::{push_user, resolve_limited, rising};
use crate::spec::{Compiler, Joint, joint_dimensions};
use crate::vector::{EPS, normalize};
use physics::model::bounds::MINVAL;
use physics::model::{Arrays, JointType, Rows};
use std::f64::consts::PI;

/// Compiles a joint that stands in `frame`.
pub(super) fn compile<'s>(
    spec: &'s Joint,
    frame: Option<&Pose>,
    settings: &Compiler,
) -> Result<JointNode<'s>, String> {
    let kind = spec.kind;
    let [timeconst, dampratio] = spec.springdamper;
    if (timeconst != 0.0 || dampratio != 0.0) && (timeconst <= 0.0 || dampratio <= 0.0) {
        return Err(
            "attribute 'springdamper' is a time constant and a damping ratio: set both above 0".into()
        );
    }
    let limited =
        kind != JointType::Free && resolve_limited(spec.limited, spec.range, settings.autolimits, "")?;
    let mut range = spec.range;
    if limited {
        check_range(kind, range)?;
        if settings.degree && matches!(kind, JointType::Hinge | JointType::Ball) {
            range = range.map(|x| x * (PI / 180.0));
        }
    }
    let scalar = matches!(kind, JointType::Hinge | JointType::Slide);
    let actfrclimited =
        scalar && resolve_limited(spec.actfrclimited, spec.actfrcrange, settings.autolimits, "actuatorfrc")?;
    if actfrclimited && spec.actfrcrange[0] >= spec.actfrcrange[1] {
        return Err(rising("actuatorfrcrange", spec.actfrcrange));
    }
    let mut axis = match frame {
        _ if !scalar => [0.0, 0.0, 1.0],
        Some(frame) => direction(frame.quat, spec.axis),
        None => spec.axis,
    };
    if normalize(&mut axis) < EPS {
        return Err("axis has no length".into());
    }
    let pos = match frame {
        _ if kind == JointType::Free => [0.0; 3],
        Some(frame) => frame.point(spec.pos),
        None => spec.pos,
    };
    let unit = if kind == JointType::Hinge && settings.degree { PI / 180.0 } else { 1.0 };
    let (reference, springref) = (spec.ref_ * unit, spec.springref * unit);
    Ok(JointNode { spec, pos, axis, limited, range, actfrclimited, reference, springref })
}

fn check_range(kind: JointType, range: [f64; 2]) -> Result<(), String> {
    if kind == JointType::Ball {
        return if range[0] == 0.0 {
            Ok(())
        } else {
            Err("attribute 'range' of a ball joint bounds an angle: its first number must be 0".into())
        };
    }
    if range[0] >= range[1] { Err(rising("range", range)) } else { Ok(()) }
}

/// Appends the joints of `body` and their degrees of freedom.
pub(super) fn fill(m: &mut Rows, body: &BodyNode, id: usize, log: &mut Log) {
    let mut parent_dof = last_dof_above(m, id);
    for node in &body.joints {
        let spec = node.spec;
        let joint = m.jnt_type.len();
        let (nq, nv) = joint_dimensions(spec.kind);
        m.jnt_type.push(spec.kind.code());
        m.jnt_group.push(spec.group);
        m.jnt_limited.push(node.limited);
        m.jnt_actfrclimited.push(node.actfrclimited);
        m.jnt_actgravcomp.push(spec.actgravcomp);
        m.jnt_qposadr.push(m.qpos0.len() as i32);
        m.jnt_dofadr.push(m.dof_bodyid.len() as i32);
        m.jnt_bodyid.push(id as i32);
        m.jnt_pos.push(node.pos);
        m.jnt_axis.push(node.axis);
        m.jnt_stiffness.push(spec.stiffness[0]);
        m.jnt_stiffnesspoly.push([spec.stiffness[1], spec.stiffness[2]]);
        m.jnt_range.push(node.range);
        m.jnt_actfrcrange.push(spec.actfrcrange);
        m.jnt_solref.push(spec.solref_limit);
        m.jnt_solimp.push(spec.solimp_limit);
        m.jnt_margin.push(spec.margin);
        let user = push_user(&mut m.jnt_user, &spec.userdata, m.nuser_jnt, "nuser_jnt");
        log.check(spec.loc, &title("joint", &spec.name), user);
        fill_reference(m, body, node);
        for _ in 0..nv {
            m.dof_parentid.push(parent_dof);
            parent_dof = m.dof_bodyid.len() as i32;
            m.dof_bodyid.push(id as i32);
            m.dof_jntid.push(joint as i32);
            m.dof_solref.push(spec.solref_friction);
            m.dof_solimp.push(spec.solimp_friction);
            m.dof_frictionloss.push(spec.frictionloss);
            m.dof_armature.push(spec.armature);
            m.dof_damping.push(spec.damping[0]);
            m.dof_dampingpoly.push([spec.damping[1], spec.damping[2]]);
        }
        debug_assert_eq!(m.qpos0.len(), m.jnt_qposadr[joint] as usize + nq);
    }
}

/// Stiffness and damping of joints that give a time constant and damping ratio instead, from their mean inertia at
/// `qpos0` (XML reference, `joint/springdamper`).
pub(crate) fn set_springdampers(m: &mut Arrays, springdampers: &[[f64; 2]]) {
    for (joint, &[timeconst, dampratio]) in springdampers.iter().enumerate() {
        if timeconst <= 0.0 || dampratio <= 0.0 {
            continue;
        }
        let nv = JointType::from_code(m.jnt_type[joint]).map_or(0, |kind| joint_dimensions(kind).1);
        let first = m.jnt_dofadr[joint] as usize;
        let inverse = m.dof_invweight0[first..first + nv].iter().fold(0.0, |sum, w| sum + w);
        let inertia = nv as f64 / inverse.max(MINVAL);
        m.jnt_stiffness[joint] = inertia / (timeconst * timeconst * dampratio * dampratio).max(MINVAL);
        m.dof_damping[first..first + nv].fill(2.0 * inertia / timeconst.max(MINVAL));
    }
}

/// Positions of the joint at the reference and at the spring's rest.
fn fill_reference(m: &mut Rows, body: &BodyNode, node: &JointNode) {
    match node.spec.kind {
        JointType::Free => {
            m.qpos0.extend(body.pose.pos);
            m.qpos0.extend(body.pose.quat);
            m.qpos_spring.extend(body.pose.pos);
            m.qpos_spring.extend(body.pose.quat);
        }
        JointType::Ball => {
            m.qpos0.extend([1.0, 0.0, 0.0, 0.0]);
            m.qpos_spring.extend([1.0, 0.0, 0.0, 0.0]);
        }
        JointType::Slide | JointType::Hinge => {
            m.qpos0.push(node.reference);
            m.qpos_spring.push(node.springref);
        }
    }
}

/// The last degree of freedom of the nearest ancestor that has any, -1 for none.
fn last_dof_above(m: &Rows, id: usize) -> i32 {
    let mut b = id;
    while b > 0 {
        b = m.body_parentid[b] as usize;
        if m.body_dofnum[b] > 0 {
            return m.body_dofadr[b] + m.body_dofnum[b] - 1;
        }
    }
    -1
}
