//! Model quantities derived at `qpos0` (documentation: Computation, "Constraint model", diagonal approximation; API,
//! `mj_setConst`).
//!
//! The compiler calls this last; tasks that edit masses, poses or lengths of a model call it again.
//!
//! ```
//! let text = "<mujoco><worldbody><body name='a'><freejoint/><geom size='.1' mass='2'/></body></worldbody></mujoco>";
//! let mut model = robohive_mjcf::load_str(text)?.model;
//! let before = model.to_bytes();
//! robohive_physics::set_const(&mut model)?;
//! assert!(model.to_bytes() == before, "a compiled model is complete");
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

use crate::actuation::reflected_load::Driven;
use crate::constants::inverse_weight::set_inverse_weights;
use crate::data::{Data, configuration_of};
use crate::math::{add, mul_inertia, mul_mat_t_vec, mul_mat_vec, quat_conj, quat_mul, spatial_dot, sub};
use crate::model::bounds::MINVAL;
use crate::model::{
    Arrays, EqType, GainType, Model, ObjType, SameFrame, SleepPolicy, TrackMode, TrnType, WrapType,
};
use crate::position::chain::last_dof;
use crate::{
    actuation::transmission, constants::statistic, inertia, position::camera, position::com,
    position::kinematics, position::tendon,
};
use std::fmt;

/// Why derived quantities cannot be recomputed.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum SetConstError {
    /// A body compiled as simple (inertial frame equal to the body frame) no longer is.
    NotSimple(String),
    /// A tree that the user lets sleep hangs on a tendon that forbids it.
    Sleep(String),
}

impl fmt::Display for SetConstError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            SetConstError::NotSimple(body) => write!(
                f,
                "{body} was compiled with its inertial frame equal to its body frame, which no longer holds; compile the model again"
            ),
            SetConstError::Sleep(tendon) => {
                write!(f, "{tendon} couples trees, which therefore cannot be allowed to sleep")
            }
        }
    }
}

impl std::error::Error for SetConstError {}

/// Recomputes every derived quantity of `m`: masses of subtrees, tree tables, tendon sparsity, inverse weights,
/// lengths at `qpos0`, statistics, spring lengths.
///
/// # Errors
/// The model was edited into something that its compiled structure cannot represent.
pub fn set_const(m: &mut Model) -> Result<(), SetConstError> {
    let arrays = m.unchecked_mut();
    arrays.npolygonmax = arrays.mesh_polyvertnum.iter().copied().max().unwrap_or(0) as usize;
    arrays.nmeshdegmax = arrays.mesh_polymapnum.iter().copied().max().unwrap_or(0) as usize;
    same_frames(arrays)?;
    subtree_mass(arrays);
    feature_flags(arrays);
    reflecting_actuators(arrays);
    trees(arrays);
    tendon_trees(arrays);
    sleep_policies(arrays)?;
    tendon_sparsity(arrays);
    let mut d = Data::new(m);
    reference_configuration(m, &mut d);
    statistic::set_statistic(m.unchecked_mut(), &d);
    spring_lengths(m, &mut d);
    Ok(())
}

/// Tolerance of frame comparison; the compiler uses the same.
const FRAME_TOLERANCE: f64 = 1e-6;

fn near<const N: usize>(a: &[f64; N], b: &[f64; N]) -> bool {
    a.iter().zip(b).all(|(x, y)| (x - y).abs() < FRAME_TOLERANCE)
}

/// Equal rotations; a quaternion and its negative are the same one.
fn same_rotation(a: &[f64; 4], b: &[f64; 4]) -> bool {
    near(a, b) || near(a, &b.map(|x| -x))
}

/// How a frame fixed in a body relates to the body frame and the inertial frame.
fn alignment(pos: &[f64; 3], quat: &[f64; 4], ipos: &[f64; 3], iquat: &[f64; 4]) -> SameFrame {
    let unit = [1.0, 0.0, 0.0, 0.0];
    if same_rotation(quat, &unit) {
        return if near(pos, &[0.0; 3]) { SameFrame::Body } else { SameFrame::Bodyrot };
    }
    match (same_rotation(quat, iquat), near(pos, ipos)) {
        (true, true) => SameFrame::Inertia,
        (true, false) => SameFrame::Inertiarot,
        (false, _) => SameFrame::None,
    }
}

fn same_frames(m: &mut Arrays) -> Result<(), SetConstError> {
    for b in 1..m.nbody {
        let aligned = alignment(&m.body_ipos[b], &m.body_iquat[b], &[f64::NAN; 3], &[f64::NAN; 4]);
        m.body_sameframe[b] = aligned.code() as u8;
        if m.body_simple[b] > 0 && aligned != SameFrame::Body {
            return Err(SetConstError::NotSimple(m.label_of(ObjType::Body, b)));
        }
    }
    for g in 0..m.ngeom {
        let b = m.geom_bodyid[g] as usize;
        m.geom_sameframe[g] =
            alignment(&m.geom_pos[g], &m.geom_quat[g], &m.body_ipos[b], &m.body_iquat[b]).code() as u8;
    }
    for s in 0..m.nsite {
        let b = m.site_bodyid[s] as usize;
        m.site_sameframe[s] =
            alignment(&m.site_pos[s], &m.site_quat[s], &m.body_ipos[b], &m.body_iquat[b]).code() as u8;
    }
    Ok(())
}

fn subtree_mass(m: &mut Arrays) {
    m.body_subtreemass.copy_from_slice(&m.body_mass);
    for b in (1..m.nbody).rev() {
        m.body_subtreemass[m.body_parentid[b] as usize] += m.body_subtreemass[b];
    }
}

fn feature_flags(m: &mut Arrays) {
    m.ngravcomp = m.body_gravcomp.iter().filter(|&&g| g > 0.0).count();
    m.flg_gravcomp = m.ngravcomp > 0;
    m.flg_surfacevel = m.geom_surfacevel.as_flattened().iter().any(|&v| v != 0.0);
    m.flg_adhesion = m.geom_adhesion.iter().chain(&m.pair_adhesion).any(|&a| a != 0.0);
}

/// The actuator whose damping or armature acts on each joint and tendon: -1 none, -2 several.
fn reflecting_actuators(m: &mut Arrays) {
    m.jnt_actuatorid.fill(-1);
    m.tendon_actuatorid.fill(-1);
    for i in 0..m.nactuator {
        let passive = m.actuator_damping[i] != 0.0
            || m.actuator_dampingpoly[i] != [0.0; 2]
            || m.actuator_armature[i] != 0.0;
        let target = m.actuator_trnid[i][0] as usize;
        let slot = match TrnType::from_code(m.actuator_trntype[i]) {
            Some(TrnType::Joint | TrnType::Jointinparent) if passive => &mut m.jnt_actuatorid[target],
            Some(TrnType::Tendon) if passive => &mut m.tendon_actuatorid[target],
            _ => continue,
        };
        *slot = if *slot == -1 { i as i32 } else { -2 };
    }
}

fn trees(m: &mut Arrays) {
    let trees = Trees::of(m);
    m.body_treeid = trees.body;
    (m.tree_bodyadr, m.tree_bodynum) = trees.bodies;
    (m.tree_dofadr, m.tree_dofnum) = trees.dofs;
}

/// Which tree a body belongs to, and the first and the number of the bodies and of the dofs of each tree.
#[derive(PartialEq)]
pub(crate) struct Trees {
    pub body: Vec<i32>,
    pub bodies: (Vec<i32>, Vec<i32>),
    pub dofs: (Vec<i32>, Vec<i32>),
}

impl Trees {
    /// What follows from `body_weldid`, `body_dofadr` and `dof_treeid`.
    pub fn of(m: &Arrays) -> Self {
        let of_body = |b: usize| match usize::try_from(last_dof(m, b)) {
            Ok(dof) => m.dof_treeid[dof],
            Err(_) => -1,
        };
        let body: Vec<i32> = (0..m.nbody).map(of_body).collect();
        let members = |trees: &[i32]| {
            let (mut first, mut number) = (vec![0; m.ntree], vec![0; m.ntree]);
            for (element, &tree) in trees.iter().enumerate().rev() {
                if let Ok(tree) = usize::try_from(tree) {
                    first[tree] = element as i32;
                    number[tree] += 1;
                }
            }
            (first, number)
        };
        Trees { bodies: members(&body), dofs: members(&m.dof_treeid), body }
    }
}

/// Body that carries a point of a tendon path; `None` for pulleys.
fn wrap_body(m: &Arrays, w: usize) -> Option<usize> {
    let object = m.wrap_objid[w] as usize;
    match WrapType::from_code(m.wrap_type[w])? {
        WrapType::Joint => Some(m.jnt_bodyid[object] as usize),
        WrapType::Site => Some(m.site_bodyid[object] as usize),
        WrapType::Sphere | WrapType::Cylinder => Some(m.geom_bodyid[object] as usize),
        WrapType::None | WrapType::Pulley => None,
    }
}

fn path(m: &Arrays, tendon: usize) -> std::ops::Range<usize> {
    let start = m.tendon_adr[tendon] as usize;
    start..start + m.tendon_num[tendon] as usize
}

/// Trees that a tendon touches, in order of first appearance.
fn trees_of(m: &Arrays, tendon: usize) -> Vec<i32> {
    let mut trees = Vec::new();
    for body in path(m, tendon).filter_map(|w| wrap_body(m, w)) {
        let tree = m.body_treeid[body];
        if tree >= 0 && !trees.contains(&tree) {
            trees.push(tree);
        }
    }
    trees
}

fn tendon_trees(m: &mut Arrays) {
    for i in 0..m.ntendon {
        let trees = trees_of(m, i);
        m.tendon_treenum[i] = trees.len() as i32;
        m.tendon_treeid[i] = [trees.first().copied().unwrap_or(-1), trees.get(1).copied().unwrap_or(-1)];
    }
}

/// Trees with actuators, or coupled by a tendon with stiffness or damping, are never put to sleep automatically.
fn sleep_policies(m: &mut Arrays) -> Result<(), SetConstError> {
    let never = |m: &mut Arrays, tree: i32| {
        if let Ok(t) = usize::try_from(tree)
            && m.tree_sleep_policy[t] == SleepPolicy::Auto.code()
        {
            m.tree_sleep_policy[t] = SleepPolicy::AutoNever.code();
        }
    };
    for i in 0..m.nactuator {
        let [target, second] = m.actuator_trnid[i];
        let target = target.max(0) as usize;
        let body = match TrnType::from_code(m.actuator_trntype[i]) {
            Some(TrnType::Joint | TrnType::Jointinparent) => m.jnt_bodyid[target],
            Some(TrnType::So3) if second < 0 => m.jnt_bodyid[target],
            Some(TrnType::Site | TrnType::Slidercrank | TrnType::So3) => m.site_bodyid[target],
            Some(TrnType::Body) => target as i32,
            Some(TrnType::Tendon) => {
                trees_of(m, target).into_iter().for_each(|tree| never(m, tree));
                continue;
            }
            Some(TrnType::Undefined) | None => continue,
        };
        never(m, m.body_treeid[body as usize]);
    }
    for i in 0..m.ntendon {
        let slack = m.tendon_stiffness[i] == 0.0
            && m.tendon_stiffnesspoly[i] == [0.0; 2]
            && m.tendon_damping[i] == 0.0
            && m.tendon_dampingpoly[i] == [0.0; 2]
            && m.tendon_actuatorid[i] == -1;
        if m.tendon_treenum[i] < 2 || (m.tendon_treenum[i] == 2 && slack) {
            continue;
        }
        for tree in trees_of(m, i) {
            never(m, tree);
            let policy = SleepPolicy::from_code(m.tree_sleep_policy[tree as usize]);
            if matches!(policy, Some(SleepPolicy::Allowed | SleepPolicy::Init)) {
                return Err(SetConstError::Sleep(m.label_of(ObjType::Tendon, i)));
            }
        }
    }
    for policy in &mut m.tree_sleep_policy {
        if *policy == SleepPolicy::Auto.code() {
            *policy = SleepPolicy::AutoAllowed.code();
        }
    }
    Ok(())
}

/// Degrees of freedom that each tendon length can depend on, ascending.
pub fn tendon_columns(m: &Arrays, tendon: usize) -> Vec<i32> {
    let mut columns = Vec::new();
    for w in path(m, tendon) {
        if m.wrap_type[w] == WrapType::Joint.code() {
            columns.push(m.jnt_dofadr[m.wrap_objid[w] as usize]);
            continue;
        }
        let mut body = wrap_body(m, w).unwrap_or(0);
        while body > 0 {
            let start = m.body_dofadr[body];
            for dof in start..start + m.body_dofnum[body] {
                if !columns.contains(&dof) {
                    columns.push(dof);
                }
            }
            body = m.body_parentid[body] as usize;
        }
    }
    columns.sort_unstable();
    columns
}

/// Number of entries that the tendon Jacobian needs.
pub fn tendon_entries(m: &Arrays) -> usize {
    (0..m.ntendon).map(|i| tendon_columns(m, i).len()).sum()
}

fn tendon_sparsity(m: &mut Arrays) {
    let mut next = 0;
    for i in 0..m.ntendon {
        let columns = tendon_columns(m, i);
        m.ten_J_rowadr[i] = next as i32;
        m.ten_J_rownnz[i] = columns.len() as i32;
        m.ten_J_colind[next..next + columns.len()].copy_from_slice(&columns);
        next += columns.len();
    }
}

/// Everything that is evaluated at `qpos0`.
fn reference_configuration(m: &mut Model, d: &mut Data) {
    // Tracking cameras and lights need the fixed pose that is computed here.
    let modes = (m.cam_mode.clone(), m.light_mode.clone());
    let arrays = m.unchecked_mut();
    arrays.cam_mode.fill(TrackMode::Fixed.code());
    arrays.light_mode.fill(TrackMode::Fixed.code());
    d.state.qpos.copy_from_slice(&m.qpos0);
    kinematics::kinematics(m, &d.state, &mut d.kin);
    com::com_pos(m, &d.kin, &mut d.com);
    camera::cameras_and_lights(m, &d.com, &mut d.kin);
    joint_inertia(m.unchecked_mut(), d);
    tendon::tendon(m, &d.state, &d.kin, &d.com, &mut d.ten);
    inertia::make_inertia(m, &d.com, &d.ten, &mut d.inertia);
    inertia::factor_inertia(m, &mut d.inertia);
    transmission::transmission(m, &configuration_of!(d), &d.con, &d.efc, &mut d.trn);
    set_inverse_weights(m, d);
    let arrays = m.unchecked_mut();
    (arrays.cam_mode, arrays.light_mode) = modes;
    arrays.tendon_length0.copy_from_slice(&d.ten.ten_length);
    arrays.actuator_length0.copy_from_slice(&d.trn.actuator_length);
    equality_anchors(arrays, d);
    camera_and_light_offsets(arrays, d);
    damping_ratios(arrays, d);
}

/// `dof_M0`: diagonal of the joint-space inertia without tendon armature.
fn joint_inertia(m: &mut Arrays, d: &mut Data) {
    let mut crb = d.com.cinert.clone();
    for b in (1..m.nbody).rev() {
        let parent = m.body_parentid[b] as usize;
        if parent > 0 {
            for k in 0..10 {
                crb[parent][k] += crb[b][k];
            }
        }
    }
    for v in 0..m.nv {
        let momentum = mul_inertia(&crb[m.dof_bodyid[v] as usize], &d.com.cdof[v]);
        let armature = m.dof_armature[v] + Driven::Joint(m.dof_jntid[v] as usize).armature(m);
        m.dof_M0[v] = armature + spatial_dot(&d.com.cdof[v], &momentum);
    }
}

/// The second anchor of connects, and anchor and relative pose of welds that give none.
fn equality_anchors(m: &mut Arrays, d: &Data) {
    let kin = &d.kin;
    for i in 0..m.neq {
        let (first, second) = (m.eq_obj1id[i] as usize, m.eq_obj2id[i].max(0) as usize);
        let by_site = m.eq_objtype[i] == ObjType::Site.code();
        let data = &mut m.eq_data[i];
        let anchor = [data[0], data[1], data[2]];
        match EqType::from_code(m.eq_type[i]) {
            Some(EqType::Connect) if by_site => *data = [0.0; 11],
            Some(EqType::Connect) => {
                let world = add(mul_mat_vec(&kin.xmat[first], anchor), kin.xpos[first]);
                let local = mul_mat_t_vec(&kin.xmat[second], sub(world, kin.xpos[second]));
                data[3..6].copy_from_slice(&local);
            }
            Some(EqType::Weld) if !by_site => {
                let given = [data[6], data[7], data[8], data[9]];
                if given != [0.0; 4] {
                    data[6..10].copy_from_slice(&crate::math::quat_normalize(given));
                    continue;
                }
                let world = add(mul_mat_vec(&kin.xmat[second], anchor), kin.xpos[second]);
                let local = mul_mat_t_vec(&kin.xmat[first], sub(world, kin.xpos[first]));
                data[3..6].copy_from_slice(&local);
                data[6..10].copy_from_slice(&quat_mul(quat_conj(kin.xquat[first]), kin.xquat[second]));
            }
            _ => continue,
        }
    }
}

fn camera_and_light_offsets(m: &mut Arrays, d: &Data) {
    let (kin, com) = (&d.kin, &d.com.subtree_com);
    let tracked = |body: i32, target: i32| if target >= 0 { target as usize } else { body as usize };
    for i in 0..m.ncam {
        m.cam_pos0[i] = sub(kin.cam_xpos[i], kin.xpos[m.cam_bodyid[i] as usize]);
        m.cam_poscom0[i] = sub(kin.cam_xpos[i], com[tracked(m.cam_bodyid[i], m.cam_targetbodyid[i])]);
        m.cam_mat0[i] = kin.cam_xmat[i];
    }
    for i in 0..m.nlight {
        m.light_pos0[i] = sub(kin.light_xpos[i], kin.xpos[m.light_bodyid[i] as usize]);
        m.light_poscom0[i] = sub(kin.light_xpos[i], com[tracked(m.light_bodyid[i], m.light_targetbodyid[i])]);
        m.light_dir0[i] = kin.light_xdir[i];
    }
}

/// A positive damping term of a position servo is a damping ratio: it becomes the matching damping
/// (XML reference, `position/dampratio`).
fn damping_ratios(m: &mut Arrays, d: &Data) {
    for i in 0..m.nactuator {
        let pid = m.actuator_gaintype[i] == GainType::Pid.code();
        let (kp, bias) = (m.actuator_gainprm[i][0], m.actuator_biasprm[i]);
        if (!pid && kp != -bias[1]) || bias[2] <= 0.0 {
            continue;
        }
        let mut mass = 0.0;
        for (dof, moment) in transmission::moment(&d.trn, m.actuator_outadr[i] as usize) {
            if moment * moment > MINVAL {
                mass += m.dof_M0[dof] / (moment * moment);
            }
        }
        let stiffness = if pid { -bias[1] } else { kp };
        m.actuator_biasprm[i][2] = -(bias[2] * 2.0 * (stiffness * mass).sqrt());
    }
}

/// Tendon rest lengths given as -1 take the length at `qpos_spring`.
fn spring_lengths(m: &mut Model, d: &mut Data) {
    d.state.qpos.copy_from_slice(&m.qpos_spring);
    kinematics::kinematics(m, &d.state, &mut d.kin);
    com::com_pos(m, &d.kin, &mut d.com);
    tendon::tendon(m, &d.state, &d.kin, &d.com, &mut d.ten);
    let m = m.unchecked_mut();
    for i in 0..m.ntendon {
        if m.tendon_lengthspring[i] == [-1.0; 2] {
            m.tendon_lengthspring[i] = [d.ten.ten_length[i]; 2];
        }
    }
}
