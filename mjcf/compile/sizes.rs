//! Sizes of the model, from the arrays that were filled row by row.

use super::flex;
use super::log::Log;
use super::values::bounded;
use crate::diagnostic::Loc;
use crate::spec::{Body, Spec};
use physics::model::{Arrays, EqType, Rows};

/// Widths of user data: as the file says, else the longest row.
pub(super) fn set_user_widths(m: &mut Rows, spec: &Spec, log: &mut Log) {
    let size = &spec.size;
    let (mut longest, mut count) = ([0; 5], [0; 5]);
    let mut pending: Vec<&Body> = vec![&spec.world];
    while let Some(body) = pending.pop() {
        let mut see = |k: usize, len: usize| {
            longest[k] = len.max(longest[k]);
            count[k] += 1;
        };
        see(0, body.userdata.len());
        body.joints.iter().for_each(|e| see(1, e.userdata.len()));
        body.geoms.iter().for_each(|e| see(2, e.userdata.len()));
        body.sites.iter().for_each(|e| see(3, e.userdata.len()));
        body.cameras.iter().for_each(|e| see(4, e.userdata.len()));
        pending.extend(&body.bodies);
    }
    log.check(Loc::NONE, "size", bounded(size.nuserdata.max(0).into(), "nuserdata"));
    let mut width = |given: Option<i32>, longest: usize, count: usize, name: &str| {
        let width = given.and_then(|n| usize::try_from(n).ok()).unwrap_or(longest);
        let numbers = bounded(width.saturating_mul(count) as i64, name);
        log.check(Loc::NONE, "size", numbers).map_or(0, |_| width)
    };
    m.nuser_body = width(size.nuser_body, longest[0], count[0], "room for nuser_body");
    m.nuser_jnt = width(size.nuser_jnt, longest[1], count[1], "room for nuser_jnt");
    m.nuser_geom = width(size.nuser_geom, longest[2], count[2], "room for nuser_geom");
    m.nuser_site = width(size.nuser_site, longest[3], count[3], "room for nuser_site");
    m.nuser_cam = width(size.nuser_cam, longest[4], count[4], "room for nuser_cam");
    let most = |lengths: &mut dyn Iterator<Item = usize>| lengths.max().unwrap_or(0);
    let tendon = most(&mut spec.tendons.iter().map(|e| e.userdata.len()));
    m.nuser_tendon = width(size.nuser_tendon, tendon, spec.tendons.len(), "room for nuser_tendon");
    let actuator = most(&mut spec.actuators.iter().map(|e| e.userdata.len()));
    m.nuser_actuator = width(size.nuser_actuator, actuator, spec.actuators.len(), "room for nuser_actuator");
    let sensor = most(&mut spec.sensors.iter().map(|e| e.userdata.len()));
    m.nuser_sensor = width(size.nuser_sensor, sensor, spec.sensors.len(), "room for nuser_sensor");
}

/// Sets every size that the filled arrays determine.
pub(super) fn set(m: &mut Arrays, spec: &Spec) {
    m.nq = m.qpos0.len();
    m.nv = m.dof_bodyid.len();
    m.nu = m.actuator_ctrllimited.len();
    m.nactuator = m.actuator_trntype.len();
    m.nout = m.actuator_gear.len();
    m.na = m.actuator_actnum.iter().sum::<i32>() as usize;
    m.nbody = m.body_parentid.len();
    m.nbvh = m.bvh_depth.len();
    m.nbvhstatic = m.bvh_aabb.len();
    m.nbvhdynamic = m.nbvh - m.nbvhstatic;
    m.noct = m.oct_depth.len();
    m.njnt = m.jnt_type.len();
    m.ntree = m.dof_parentid.iter().filter(|&&p| p < 0).count();
    m.ngeom = m.geom_type.len();
    m.nsite = m.site_type.len();
    m.ncam = m.cam_mode.len();
    m.nlight = m.light_mode.len();
    m.nmesh = m.mesh_vertadr.len();
    m.nmeshvert = m.mesh_vert.len();
    m.nmeshnormal = m.mesh_normal.len();
    m.nmeshtexcoord = m.mesh_texcoord.len();
    m.nmeshface = m.mesh_face.len();
    m.nmeshgraph = m.mesh_graph.len();
    m.nmeshpoly = m.mesh_polynormal.len();
    m.nmeshpolyvert = m.mesh_polyvert.len();
    m.nmeshpolymap = m.mesh_polymap.len();
    m.nskin = m.skin_matid.len();
    m.nskinvert = m.skin_vert.len();
    m.nskintexvert = m.skin_texcoord.len();
    m.nskinface = m.skin_face.len();
    m.nskinbone = m.skin_bonebodyid.len();
    m.nskinbonevert = m.skin_bonevertid.len();
    flex::set_sizes(m);
    m.nhfield = m.hfield_size.len();
    m.nhfielddata = m.hfield_data.len();
    m.ntex = m.tex_type.len();
    m.ntexdata = m.tex_data.len();
    m.nmat = m.mat_rgba.len();
    m.npair = m.pair_dim.len();
    m.nexclude = m.exclude_signature.len();
    m.neq = m.eq_type.len();
    m.ntendon = m.tendon_adr.len();
    m.nwrap = m.wrap_type.len();
    m.nsensor = m.sensor_type.len();
    m.nnumeric = m.numeric_adr.len();
    m.nnumericdata = m.numeric_data.len();
    m.ntext = m.text_adr.len();
    m.ntextdata = m.text_data.len();
    m.ntuple = m.tuple_adr.len();
    m.ntupledata = m.tuple_objtype.len();
    m.nkey = m.key_time.len();
    m.nmocap = m.body_mocapid.iter().filter(|&&id| id >= 0).count();
    m.nplugin = m.plugin.len();
    m.npluginattr = m.plugin_attr.len();
    m.nnames = m.names.len();
    m.nnames_map = m.names_map.len();
    m.npaths = m.paths.len();
    m.nuserdata = spec.size.nuserdata.max(0) as usize;
    m.njmax = spec.size.njmax.unwrap_or(-1) as usize;
    m.nconmax = spec.size.nconmax.unwrap_or(-1) as usize;
    m.nemax = m.eq_type.iter().map(|&kind| rows(kind)).sum();
}

/// Constraint rows of an equality.
fn rows(kind: i32) -> usize {
    match EqType::from_code(kind) {
        Some(EqType::Connect) => 3,
        Some(EqType::Weld) => 7,
        _ => 1,
    }
}

/// Room for what `set_const` computes.
pub(super) fn allocate_derived(m: &mut Arrays) {
    m.body_subtreemass = vec![0.0; m.nbody].into();
    m.body_treeid = vec![-1; m.nbody].into();
    m.tree_bodyadr = vec![0; m.ntree].into();
    m.tree_bodynum = vec![0; m.ntree].into();
    m.tree_dofadr = vec![0; m.ntree].into();
    m.tree_dofnum = vec![0; m.ntree].into();
    flex::allocate_derived(m);
    m.jnt_actuatorid = vec![-1; m.njnt].into();
    m.tendon_actuatorid = vec![-1; m.ntendon].into();
    m.tendon_treenum = vec![0; m.ntendon].into();
    m.tendon_treeid = vec![[-1; 2]; m.ntendon].into();
    m.ten_J_rownnz = vec![0; m.ntendon].into();
    m.ten_J_rowadr = vec![0; m.ntendon].into();
    m.ten_J_colind = vec![0; m.nJten].into();
    m.body_invweight0 = vec![[0.0; 2]; m.nbody].into();
    m.dof_invweight0 = vec![0.0; m.nv].into();
    m.dof_M0 = vec![0.0; m.nv].into();
    m.dof_length = vec![0.0; m.nv].into();
    m.tendon_length0 = vec![0.0; m.ntendon].into();
    m.tendon_invweight0 = vec![0.0; m.ntendon].into();
    m.actuator_acc0 = vec![0.0; m.nout].into();
    m.actuator_length0 = vec![0.0; m.nout].into();
    m.cam_poscom0 = vec![[0.0; 3]; m.ncam].into();
    m.cam_pos0 = vec![[0.0; 3]; m.ncam].into();
    m.cam_mat0 = vec![[0.0; 9]; m.ncam].into();
    m.light_poscom0 = vec![[0.0; 3]; m.nlight].into();
    m.light_pos0 = vec![[0.0; 3]; m.nlight].into();
    m.light_dir0 = vec![[0.0; 3]; m.nlight].into();
}

/// Every array must have the size that the table of fields says.
pub(super) fn check(m: &Arrays, log: &mut Log) {
    let mut wrong = Vec::new();
    m.visit(&mut |name, shape, values| {
        let expected: usize = shape.iter().product();
        if values.len() != expected {
            wrong.push(format!("{name} has {} values, {expected} expected", values.len()));
        }
    });
    for message in wrong {
        log.error(Loc::NONE, format!("inconsistent model: {message}"));
    }
}
