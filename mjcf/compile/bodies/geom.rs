//! Geoms: type, size, pose, mass.

use super::fluid;
use crate::compile::assets::Assets;
use crate::compile::frame::{Pose, add, direction, same_frame_in_body, segment};
use crate::compile::log::{Log, title};
use crate::compile::lookup::Lookup;
use crate::compile::nodes::{BodyNode, GeomNode};
use crate::compile::plugins::Plugins;
use crate::compile::values::push_user;
use crate::image::CompiledHfield;
use crate::mesh::{CompiledMesh, Primitive, fit_primitive};
use crate::spec::{Compiler, Geom, resolve};
use crate::vector::{EPS, cross, normalize};
use physics::geometry::shape;
use physics::math::Vec3;
use physics::model::{GeomType, ObjType, Rows};
use physics::plugin::Capability;

/// What a geom's compile needs to know.
pub(super) struct Context<'a> {
    pub settings: &'a Compiler,
    pub assets: &'a Assets,
    pub frame: Option<&'a Pose>,
    /// Mass and inertia are wanted.
    pub infer: bool,
    /// The body does not move by joints.
    pub fixed: bool,
}

/// Compiles one geom.
pub(super) fn compile<'s>(spec: &'s Geom, context: &Context) -> Result<GeomNode<'s>, String> {
    let kind = spec.kind;
    if kind == GeomType::None {
        return Err("invalid type".into());
    }
    if ![1, 3, 4, 6].contains(&spec.condim) {
        return Err(format!("condim must be 1, 3, 4 or 6, is {}", spec.condim));
    }
    if kind == GeomType::Plane && !context.fixed {
        return Err("a plane cannot move: put it into the world, or remove the joints above it".into());
    }
    let mesh = find_mesh(spec, context.assets)?;
    let hfield = find_hfield(spec, context.assets)?;
    let (mut pose, mut size) = placement(spec, context.settings)?;
    let mut surfacevel = spec.surfacevel;
    if let Some((_, mesh)) = mesh {
        let center = match primitive(kind) {
            None if spec.shellinertia => {
                return Err("a mesh geom takes shell inertia from its mesh asset".into());
            }
            None => [0.0; 3],
            Some(primitive) => {
                let (fitted, center) =
                    fit_primitive(mesh, primitive, context.settings.fitaabb, spec.fitscale, size);
                size = fitted;
                center
            }
        };
        let offset = Pose { pos: add(direction(mesh.quat, center), mesh.pos), quat: mesh.quat };
        pose = pose.then(&offset);
        surfacevel = in_mesh_frame(surfacevel, &offset);
    }
    shape::check_size(kind, size).map_err(|error| error.to_string())?;
    let solid = mesh.filter(|_| matches!(kind, GeomType::Mesh | GeomType::Sdf));
    let (aabb, rbound) = match (solid, hfield) {
        (Some((_, mesh)), _) => {
            size = mesh.geom_size();
            (mesh.aabb(), shape::bounding_radius(kind, size))
        }
        (None, Some((_, hfield))) => {
            let s = hfield.size;
            size = [s[0], s[1], 0.25 * s[2] + 0.5 * s[3]];
            (shape::hfield_box(s), shape::hfield_radius(s))
        }
        (None, None) => (shape::bounding_box(kind, size), shape::bounding_radius(kind, size)),
    };
    let (mass, inertia) =
        if context.infer { weigh(spec, size, solid.map(|(_, mesh)| mesh))? } else { (0.0, [0.0; 3]) };
    let fluid = if spec.fluid_ellipsoid > 0.0 {
        fluid::coefficients(kind, size, spec.fluid_ellipsoid, spec.fluid_coefs)
    } else {
        [0.0; 12]
    };
    if let Some(frame) = context.frame {
        pose = frame.then(&pose);
    }
    let dataid = mesh.map(|(id, _)| id).or(hfield.map(|(id, _)| id)).map_or(-1, |id| id as i32);
    let mesh_material = mesh.map_or("", |(id, _)| &context.assets.meshes[id].material);
    let material = if spec.material.is_empty() { mesh_material } else { &spec.material }.to_owned();
    Ok(GeomNode { spec, pose, size, aabb, rbound, mass, inertia, dataid, material, surfacevel, fluid })
}

fn find_mesh<'a>(spec: &Geom, assets: &'a Assets) -> Result<Option<(usize, &'a CompiledMesh)>, String> {
    if spec.meshname.is_empty() {
        return match spec.kind {
            GeomType::Mesh => Err("a mesh geom needs a mesh".into()),
            GeomType::Sdf => Err("a signed distance geom needs a mesh, of its plugin or of a file".into()),
            _ => Ok(None),
        };
    }
    if spec.fromto.is_some() {
        return Err("attribute 'fromto' does not place meshes: use 'pos' and 'quat'".into());
    }
    if matches!(spec.kind, GeomType::Plane | GeomType::Hfield) {
        return Err("a plane or height field cannot be fitted to a mesh".into());
    }
    let id = assets.mesh_id(&spec.meshname)?;
    Ok(Some((id, &assets.meshes[id].compiled)))
}

fn find_hfield<'a>(spec: &Geom, assets: &'a Assets) -> Result<Option<(usize, &'a CompiledHfield)>, String> {
    match (spec.kind == GeomType::Hfield, spec.hfieldname.is_empty()) {
        (false, true) => Ok(None),
        (true, true) => Err("a height field geom needs an hfield".into()),
        (false, false) => Err("hfield is only for geoms of type hfield".into()),
        (true, false) => {
            let id = assets.hfield_id(&spec.hfieldname)?;
            Ok(Some((id, &assets.hfields[id].compiled)))
        }
    }
}

fn primitive(kind: GeomType) -> Option<Primitive> {
    match kind {
        GeomType::Sphere => Some(Primitive::Sphere),
        GeomType::Capsule => Some(Primitive::Capsule),
        GeomType::Ellipsoid => Some(Primitive::Ellipsoid),
        GeomType::Cylinder => Some(Primitive::Cylinder),
        GeomType::Box => Some(Primitive::Box),
        GeomType::Plane | GeomType::Hfield | GeomType::Mesh | GeomType::Sdf | GeomType::None => None,
    }
}

fn placement(spec: &Geom, settings: &Compiler) -> Result<(Pose, Vec3), String> {
    let mut quat = spec.quat;
    normalize(&mut quat);
    match spec.fromto {
        Some(fromto) => stretched(spec.kind, spec.pos, fromto, spec.size),
        None => Ok((Pose { pos: spec.pos, quat: resolve(quat, spec.alt, settings)? }, spec.size)),
    }
}

/// Pose and size of a shape stretched between two points.
pub(super) fn stretched(
    kind: GeomType,
    pos: Vec3,
    fromto: [f64; 6],
    size: Vec3,
) -> Result<(Pose, Vec3), String> {
    let flat = matches!(kind, GeomType::Ellipsoid | GeomType::Box);
    if !flat && !matches!(kind, GeomType::Capsule | GeomType::Cylinder) {
        return Err("attribute 'fromto' gives a length to a capsule, cylinder, box or ellipsoid: change 'type', or use 'pos'".into());
    }
    if pos != [0.0; 3] {
        return Err("pos and fromto exclude each other".into());
    }
    let (pose, half) = segment(fromto)?;
    let size = if flat { [size[0], size[0], half] } else { [size[0], half, size[2]] };
    Ok((pose, size))
}

/// Surface velocity (linear, angular) re-expressed in a frame at `offset`.
fn in_mesh_frame(velocity: [f64; 6], offset: &Pose) -> [f64; 6] {
    if velocity == [0.0; 6] {
        return velocity;
    }
    let angular = [velocity[3], velocity[4], velocity[5]];
    let linear = add([velocity[0], velocity[1], velocity[2]], cross(angular, offset.pos));
    let back = [offset.quat[0], -offset.quat[1], -offset.quat[2], -offset.quat[3]];
    let (linear, angular) = (direction(back, linear), direction(back, angular));
    [linear[0], linear[1], linear[2], angular[0], angular[1], angular[2]]
}

/// Mass and principal moments, from the mass if given, else from the density.
fn weigh(spec: &Geom, size: Vec3, mesh: Option<&CompiledMesh>) -> Result<(f64, Vec3), String> {
    let volume = mesh.map_or_else(|| shape::volume(spec.kind, size, spec.shellinertia), |mesh| mesh.volume);
    let mass = match spec.mass {
        Some(mass) if mass == 0.0 || volume > EPS => mass,
        Some(_) => 0.0,
        None => spec.density * volume,
    };
    if mass < 0.0 || spec.density < 0.0 {
        return Err("attributes 'mass' and 'density': set each to 0 or more".into());
    }
    let inertia = match mesh {
        _ if mass == 0.0 => [0.0; 3],
        Some(mesh) => mesh.inertia(mass),
        None => shape::inertia(spec.kind, size, mass, spec.shellinertia),
    };
    Ok((mass, inertia))
}

/// Appends the geoms of `body`.
pub(super) fn fill(
    m: &mut Rows,
    body: &BodyNode,
    id: usize,
    (lookup, plugins): (&Lookup, &Plugins),
    log: &mut Log,
) {
    for node in &body.geoms {
        let spec = node.spec;
        let what = title("geom", &spec.name);
        m.geom_type.push(spec.kind.code());
        m.geom_contype.push(spec.contype);
        m.geom_conaffinity.push(spec.conaffinity);
        m.geom_condim.push(spec.condim);
        m.geom_bodyid.push(id as i32);
        m.geom_dataid.push(node.dataid);
        m.geom_matid.push(lookup.reference(ObjType::Material, &node.material, spec.loc, &what, log));
        m.geom_group.push(spec.group);
        m.geom_priority.push(spec.priority);
        m.geom_plugin.push(plugins.id(spec.plugin.as_ref(), (Capability::Sdf, &what), log));
        m.geom_sameframe.push(same_frame_in_body(node.pose, body.inertial).code() as u8);
        m.geom_solmix.push(spec.solmix);
        m.geom_solref.push(spec.solref);
        m.geom_solimp.push(spec.solimp);
        m.geom_size.push(node.size);
        m.geom_aabb.push(node.aabb);
        m.geom_rbound.push(node.rbound);
        m.geom_pos.push(node.pose.pos);
        m.geom_quat.push(node.pose.quat);
        m.geom_friction.push(spec.friction);
        m.geom_margin.push(spec.margin);
        m.geom_gap.push(spec.gap);
        m.geom_surfacevel.push(node.surfacevel);
        m.geom_adhesion.push(spec.adhesion);
        m.geom_fluid.push(node.fluid);
        let user = push_user(&mut m.geom_user, &spec.userdata, m.nuser_geom, "nuser_geom");
        log.check(spec.loc, &what, user);
        m.geom_rgba.push(spec.rgba);
    }
}
