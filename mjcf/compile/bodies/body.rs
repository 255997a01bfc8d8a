//! Bodies: pose, inertia, welds, simplicity and bounding volume hierarchy.

use super::geom;
use super::joint;
use super::viewpoint;
use crate::compile::assets::Assets;
use crate::compile::frame::{Pose, add, direction, same_frame, same_position};
use crate::compile::inertia::{MassPart, combine, principal};
use crate::compile::log::{Log, title};
use crate::compile::nodes::{BodyNode, FormerTrees, Tree};
use crate::compile::values::push_user;
use crate::spec::{AlignFree, Body, Compiler, Geom, InertiaFromGeom, Inertial, Spec, resolve};
use crate::vector::{EPS, compose, normalize, rotate};
use physics::model::bounds::MINVAL;
use physics::model::{JointType, Rows, SameFrame};

/// What a body's compile needs to know.
pub(super) struct Context<'a, 's> {
    /// The bodies before this one, its ancestors among them.
    pub tree: &'a Tree<'s>,
    pub model: &'s Spec,
    pub assets: &'a Assets,
    /// Poses of the model's frames in their bodies.
    pub frames: &'a [Pose],
}

/// Compiles one body, which gets the next id.
pub(super) fn compile<'s>(
    spec: &'s Body,
    parent: usize,
    context: &Context<'_, 's>,
    log: &mut Log,
) -> BodyNode<'s> {
    let &Context { tree, model, assets, frames } = context;
    let id = tree.bodies.len();
    let what = title("body", &spec.name);
    let frame = |index: Option<usize>| index.and_then(|i| frames.get(i));
    let mut joints = Vec::with_capacity(spec.joints.len());
    for j in &spec.joints {
        let node = joint::compile(j, frame(j.frame), model.compiler_at(j.loc));
        joints.extend(log.check(j.loc, &title("joint", &j.name), node));
    }
    let mut node = BodyNode {
        spec,
        parent,
        pose: Pose::IDENTITY,
        world: Pose::IDENTITY,
        inertial: Pose::IDENTITY,
        mass: 0.0,
        inertia: [0.0; 3],
        joints,
        geoms: Vec::new(),
        sites: Vec::new(),
        cameras: Vec::new(),
        lights: Vec::new(),
        former: FormerTrees::default(),
        is_world: id == 0,
    };
    check_joints(&node, parent, log);
    let fixed = !moves(&node, parent, tree);
    for g in &spec.geoms {
        let context = geom::Context {
            settings: model.compiler_at(g.loc),
            assets,
            frame: frame(g.frame),
            infer: id > 0 && infers(spec, g, model),
            fixed,
        };
        node.geoms.extend(log.check(g.loc, &title("geom", &g.name), geom::compile(g, &context)));
    }
    if let Some(pose) = log.check(spec.loc, &what, own_pose(spec, model)) {
        node.pose = pose;
    }
    let result = set_inertia(&mut node, model);
    log.check(spec.inertial.as_ref().map_or(spec.loc, |i| i.loc), &what, result);
    if let Some(frame) = frame(spec.frame) {
        node.pose = frame.then(&node.pose);
    }
    viewpoint::compile(&mut node, model, frames, log);
    if aligns_free_joint(&node, model) {
        align_to_inertia(&mut node, model.compiler.fusestatic);
    }
    if id > 0 {
        let parent = tree.bodies[parent].world;
        let pos = add(rotate(node.pose.pos, parent.quat), parent.pos);
        node.world = Pose { pos, quat: compose(parent.quat, node.pose.quat) };
    }
    node
}

fn check_joints(node: &BodyNode, parent: usize, log: &mut Log) {
    let what = title("body", &node.spec.name);
    let loc = node.spec.loc;
    if node.dofs() > 6 {
        log.error(loc, format!("{what}: more than 6 degrees of freedom"));
    }
    let mut ball = false;
    for joint in &node.joints {
        if ball && matches!(joint.spec.kind, JointType::Ball | JointType::Hinge) {
            log.error(joint.spec.loc, format!("{what}: a rotation follows a ball joint"));
        }
        ball |= joint.spec.kind == JointType::Ball;
    }
    let free = node.joints.iter().filter(|j| j.spec.kind == JointType::Free).count();
    if free > 0 && node.joints.len() > 1 {
        log.error(loc, format!("{what}: a free joint must be the only joint of its body"));
    }
    if node.spec.mocap && (node.dofs() > 0 || parent != 0) {
        log.error(loc, format!("{what}: a mocap body must be a child of the world without joints"));
    }
}

/// Whether joints move the body relative to the world; mocap bodies do not count.
fn moves(node: &BodyNode, parent: usize, tree: &Tree) -> bool {
    let mut node = node;
    let mut parent = parent;
    loop {
        if node.is_weld_root() {
            return !node.is_world && !node.spec.mocap;
        }
        node = &tree.bodies[parent];
        parent = node.parent;
    }
}

fn infers(body: &Body, geom: &Geom, model: &Spec) -> bool {
    let settings = model.compiler_at(body.loc);
    let [low, high] = settings.inertiagrouprange;
    (body.inertial.is_none() || settings.inertiafromgeom == InertiaFromGeom::True)
        && (low..=high).contains(&geom.group)
}

fn own_pose(spec: &Body, model: &Spec) -> Result<Pose, String> {
    let mut quat = spec.quat;
    normalize(&mut quat);
    Ok(Pose { pos: spec.pos, quat: resolve(quat, spec.alt, model.compiler_at(spec.loc))? })
}

/// Inertia from the `inertial` element, or from the geoms.
fn set_inertia(node: &mut BodyNode, model: &Spec) -> Result<(), String> {
    let settings = model.compiler_at(node.spec.loc);
    let mut defined = false;
    if let Some(inertial) = &node.spec.inertial {
        let part = explicit(inertial, settings)?;
        (node.mass, node.inertia, node.inertial) = (part.mass, part.inertia, part.pose);
        defined = true;
    }
    let from_geoms = match settings.inertiafromgeom {
        InertiaFromGeom::False => false,
        InertiaFromGeom::True => true,
        InertiaFromGeom::Auto => !defined,
    };
    if !node.is_world
        && from_geoms
        && let Some(part) = of_geoms(node, settings.inertiagrouprange)?
    {
        (node.mass, node.inertia, node.inertial) = (part.mass, part.inertia, part.pose);
        defined = true;
    }
    if !defined {
        node.inertial = node.pose;
    }
    if node.is_world {
        return Ok(());
    }
    node.mass = node.mass.max(settings.boundmass);
    node.inertia = node.inertia.map(|x| x.max(settings.boundinertia));
    let [a, b, c] = node.inertia;
    if node.mass < 0.0 || a < 0.0 || b < 0.0 || c < 0.0 {
        return Err(format!(
            "mass {} or inertia {a} {b} {c} is negative: set 'mass' and the inertia to 0 or more",
            node.mass
        ));
    }
    if a + b < c || a + c < b || b + c < a {
        if !settings.balanceinertia {
            return Err(
                "one moment of inertia exceeds the sum of the others, which no solid has: correct it, or set \
                 balanceinertia=\"true\" in <compiler>"
                    .into()
            );
        }
        node.inertia = [(a + b + c) / 3.0; 3];
    }
    Ok(())
}

fn explicit(inertial: &Inertial, settings: &Compiler) -> Result<MassPart, String> {
    let mut quat = inertial.quat;
    normalize(&mut quat);
    let mut inertia = inertial.inertia;
    if let Some(full) = inertial.fullinertia {
        if inertial.alt.is_some() {
            return Err("fullinertia and an orientation exclude each other".into());
        }
        if inertia != [0.0; 3] {
            return Err("fullinertia and diaginertia exclude each other".into());
        }
        (inertia, quat) = principal(full)?;
    }
    quat = resolve(quat, inertial.alt, settings)?;
    Ok(MassPart { mass: inertial.mass, inertia, pose: Pose { pos: inertial.pos, quat } })
}

fn of_geoms(node: &BodyNode, groups: [i32; 2]) -> Result<Option<MassPart>, String> {
    let parts: Vec<MassPart> = node
        .geoms
        .iter()
        .filter(|g| (groups[0]..=groups[1]).contains(&g.spec.group) && g.mass > EPS)
        .map(|g| MassPart { mass: g.mass, inertia: g.inertia, pose: g.pose })
        .collect();
    if parts.len() == 1 { Ok(Some(parts[0])) } else { combine(&parts) }
}

fn aligns_free_joint(node: &BodyNode, model: &Spec) -> bool {
    let [joint] = &node.joints[..] else { return false };
    let wanted = match joint.spec.align {
        AlignFree::False => false,
        AlignFree::True => true,
        AlignFree::Auto => model.compiler_at(node.spec.loc).alignfree,
    };
    joint.spec.kind == JointType::Free && node.spec.bodies.is_empty() && wanted
}

/// Moves the body frame to the inertial frame; everything in the body stays where it is.
fn align_to_inertia(node: &mut BodyNode, recompiled: bool) {
    node.pose = node.pose.then(&node.inertial);
    let back = node.inertial.inverse();
    node.inertial = Pose::IDENTITY;
    for geom in &mut node.geoms {
        geom.pose = back.then(&geom.pose);
    }
    for site in &mut node.sites {
        site.pose = back.then(&site.pose);
    }
    // With fusestatic MuJoCo compiles cameras and lights once more, from the file.
    if recompiled {
        return;
    }
    for camera in &mut node.cameras {
        camera.pose = back.then(&camera.pose);
    }
    for light in &mut node.lights {
        light.pos = back.point(light.pos);
        light.dir = direction(back.quat, light.dir);
    }
}

/// A moving body needs mass and inertia, its own or from a body welded to it.
pub(super) fn check_moving_mass(tree: &Tree, log: &mut Log) {
    let children: Vec<Vec<usize>> = {
        let mut lists = vec![Vec::new(); tree.bodies.len()];
        for (id, body) in tree.bodies.iter().enumerate().skip(1) {
            lists[body.parent].push(id);
        }
        lists
    };
    for (id, body) in tree.bodies.iter().enumerate().skip(1) {
        if body.joints.is_empty() {
            continue;
        }
        let mut pending = vec![id];
        let mut found = false;
        while let (Some(b), false) = (pending.pop(), found) {
            let part = &tree.bodies[b];
            found = part.mass >= MINVAL && part.inertia.iter().all(|&i| i >= MINVAL);
            pending.extend(children[b].iter().filter(|&&c| tree.bodies[c].joints.is_empty()));
        }
        if !found {
            let what = title("body", body.name());
            log.error(
                body.spec.loc,
                format!(
                    "{what}: a body that moves needs mass and inertia: add <inertial>, or a geom with mass"
                ),
            );
        }
    }
}

/// Appends the row of a body.
pub(super) fn fill(m: &mut Rows, node: &BodyNode, id: usize, tree: &Tree, log: &mut Log) {
    let parent = node.parent;
    let dofs = node.dofs();
    let root = if id == 0 || parent == 0 { id as i32 } else { m.body_rootid[parent] };
    let weld = if id == 0 || node.is_weld_root() { id as i32 } else { m.body_weldid[parent] };
    m.body_parentid.push(parent as i32);
    m.body_rootid.push(root);
    m.body_weldid.push(weld);
    let mocap = tree.bodies[..id].iter().filter(|b| b.spec.mocap).count();
    m.body_mocapid.push(if node.spec.mocap { mocap as i32 } else { -1 });
    m.body_jntnum.push(node.joints.len() as i32);
    m.body_jntadr.push(if node.joints.is_empty() { -1 } else { m.jnt_type.len() as i32 });
    m.body_dofnum.push(dofs as i32);
    m.body_dofadr.push(if dofs == 0 { -1 } else { m.dof_bodyid.len() as i32 });
    m.body_geomnum.push(node.geoms.len() as i32);
    m.body_geomadr.push(if node.geoms.is_empty() { -1 } else { m.geom_type.len() as i32 });
    m.body_pos.push(node.pose.pos);
    m.body_quat.push(node.pose.quat);
    m.body_ipos.push(node.inertial.pos);
    m.body_iquat.push(node.inertial.quat);
    m.body_mass.push(node.mass);
    m.body_inertia.push(node.inertia);
    m.body_gravcomp.push(node.spec.gravcomp);
    let user = push_user(&mut m.body_user, &node.spec.userdata, m.nuser_body, "nuser_body");
    log.check(node.spec.loc, &title("body", node.name()), user);
    m.body_contype.push(node.geoms.iter().fold(0, |bits, g| bits | g.spec.contype));
    m.body_conaffinity.push(node.geoms.iter().fold(0, |bits, g| bits | g.spec.conaffinity));
    m.body_margin.push(node.geoms.iter().fold(0.0, |most: f64, g| most.max(g.spec.margin + g.spec.gap)));
    let free = node.joints.iter().any(|j| j.spec.kind == JointType::Free);
    if free && parent != 0 {
        let what = title("body", node.name());
        log.error(node.spec.loc, format!("{what}: a free joint is only allowed in a child of the world"));
    }
    let same = same_frame(node.inertial);
    m.body_sameframe.push(same.code() as u8);
    let near_root = root == id as i32 || (m.body_parentid[parent] == 0 && m.body_dofnum[parent] == 0);
    m.body_simple.push(u8::from(same == SameFrame::Body && near_root && node.spec.simple));
    if parent > 0 {
        m.body_simple[parent] = 0;
    }
}

/// Takes back simplicity that the joints forbid; level 2 is for sliders only.
pub(super) fn settle_simple(m: &mut Rows, node: &BodyNode, id: usize) {
    let mut rotates = false;
    for joint in &node.joints {
        let aligned = joint.axis.iter().filter(|x| x.abs() > EPS).count() == 1;
        let scalar = matches!(joint.spec.kind, JointType::Hinge | JointType::Slide);
        if rotates || !same_position(joint.pos, [0.0; 3]) || (scalar && !aligned) {
            m.body_simple[id] = 0;
        }
        rotates |= matches!(joint.spec.kind, JointType::Ball | JointType::Hinge);
    }
    if m.body_simple[id] != 0 && !node.joints.is_empty() {
        let slides = node.joints.iter().all(|j| j.spec.kind == JointType::Slide);
        m.body_simple[id] = if slides { 2 } else { 1 };
    }
}

/// Scales masses and inertias to the given total.
pub(super) fn scale_mass(m: &mut Rows, total: f64) {
    let now: f64 = m.body_mass.iter().skip(1).fold(0.0, |sum, mass| sum + mass);
    let scale = (total / now.max(MINVAL)).max(MINVAL);
    for b in 1..m.body_mass.len() {
        m.body_mass[b] *= scale;
        m.body_inertia[b] = m.body_inertia[b].map(|i| i * scale);
    }
}
