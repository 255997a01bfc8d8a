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

use crate::constants::{bending_factor, flex_pattern, flex_reference, reference};
use crate::model::{Arrays, Model, ObjType, SameFrame, SleepPolicy, TrnType, WrapType};
use crate::position::chain::last_dof;
use std::fmt;

/// Why derived quantities cannot be recomputed.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum SetConstError {
    /// A body compiled as simple (inertial frame equal to the body frame) no longer is.
    NotSimple(String),
    /// A tree that the user lets sleep hangs on a tendon that forbids it.
    Sleep(String),
    /// A surface whose vertices are constrained is not in the plane of x and y at the start.
    NotPlanar(String),
    /// Inertia and bending stiffness together are not positive definite.
    Bending,
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
            SetConstError::NotPlanar(flex) => {
                write!(
                    f,
                    "{flex} does not lie in the plane of x and y, which constraints of its vertices need"
                )
            }
            SetConstError::Bending => f.write_str(
                "inertia and bending stiffness are not positive definite: a flex has no mass, or a bad shape",
            ),
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
    body_frames(arrays)?;
    attached_frames(arrays);
    subtree_mass(arrays);
    feature_flags(arrays);
    reflecting_actuators(arrays);
    trees(arrays);
    tendon_trees(arrays);
    sleep_policies(arrays)?;
    tendon_sparsity(arrays);
    flex_pattern::set(m);
    flex_reference::set_metrics(m).map_err(SetConstError::NotPlanar)?;
    reference::set_constants(m);
    if bending_factor::set(m) { Ok(()) } else { Err(SetConstError::Bending) }
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

/// How the inertial frame of each body relates to the body frame.
fn body_frames(m: &mut Arrays) -> Result<(), SetConstError> {
    for b in 1..m.nbody {
        let aligned = alignment(&m.body_ipos[b], &m.body_iquat[b], &[f64::NAN; 3], &[f64::NAN; 4]);
        m.body_sameframe.update_row(b, aligned.code() as u8);
        if m.body_simple[b] > 0 && aligned != SameFrame::Body {
            return Err(SetConstError::NotSimple(m.label_of(ObjType::Body, b)));
        }
    }
    Ok(())
}

/// How the frame of each geom and site relates to the frames of its body.
pub(crate) fn attached_frames(m: &mut Arrays) {
    for g in 0..m.ngeom {
        let b = m.geom_bodyid[g] as usize;
        let aligned = alignment(&m.geom_pos[g], &m.geom_quat[g], &m.body_ipos[b], &m.body_iquat[b]);
        m.geom_sameframe.update_row(g, aligned.code() as u8);
    }
    for s in 0..m.nsite {
        let b = m.site_bodyid[s] as usize;
        let aligned = alignment(&m.site_pos[s], &m.site_quat[s], &m.body_ipos[b], &m.body_iquat[b]);
        m.site_sameframe.update_row(s, aligned.code() as u8);
    }
}

/// Mass of each body with all that hangs on it.
pub(crate) fn subtree_mass(m: &mut Arrays) {
    let mut mass = m.body_mass.to_vec();
    for b in (1..m.nbody).rev() {
        mass[m.body_parentid[b] as usize] += mass[b];
    }
    m.body_subtreemass.update(&mass);
}

/// Which rare features some element uses.
pub(crate) fn feature_flags(m: &mut Arrays) {
    m.ngravcomp = m.body_gravcomp.iter().filter(|&&g| g > 0.0).count();
    m.flg_gravcomp = m.ngravcomp > 0;
    m.flg_surfacevel = m.geom_surfacevel.as_flattened().iter().any(|&v| v != 0.0);
    m.flg_adhesion = m.geom_adhesion.iter().chain(&m.pair_adhesion).any(|&a| a != 0.0);
}

/// The actuator whose damping or armature acts on each joint and tendon: -1 none, -2 several.
fn reflecting_actuators(m: &mut Arrays) {
    let (mut joints, mut tendons) = (vec![-1; m.njnt], vec![-1; m.ntendon]);
    for i in 0..m.nactuator {
        let passive = m.actuator_damping[i] != 0.0
            || m.actuator_dampingpoly[i] != [0.0; 2]
            || m.actuator_armature[i] != 0.0;
        let target = m.actuator_trnid[i][0] as usize;
        let slot = match TrnType::from_code(m.actuator_trntype[i]) {
            Some(TrnType::Joint | TrnType::Jointinparent) if passive => &mut joints[target],
            Some(TrnType::Tendon) if passive => &mut tendons[target],
            _ => continue,
        };
        *slot = if *slot == -1 { i as i32 } else { -2 };
    }
    m.jnt_actuatorid.update(&joints);
    m.tendon_actuatorid.update(&tendons);
}

fn trees(m: &mut Arrays) {
    let trees = Trees::of(m);
    m.body_treeid.update(&trees.body);
    m.tree_bodyadr.update(&trees.bodies.0);
    m.tree_bodynum.update(&trees.bodies.1);
    m.tree_dofadr.update(&trees.dofs.0);
    m.tree_dofnum.update(&trees.dofs.1);
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
pub(crate) fn wrap_body(m: &Arrays, w: usize) -> Option<usize> {
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
        let first = [0, 1].map(|k| trees.get(k).copied().unwrap_or(-1));
        m.tendon_treenum.update_row(i, trees.len() as i32);
        m.tendon_treeid.update_row(i, first);
    }
}

/// Trees with actuators, coupled by a tendon with stiffness or damping, or of a flex without constraints, are never put to
/// sleep automatically.
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
    let slack: Vec<usize> = (0..m.nflex).filter(|&f| m.flex_edgeequality[f] == 0).collect();
    for f in slack {
        let part = |first: i32, count: i32| first.max(0) as usize..(first.max(0) + count) as usize;
        let bodies = match m.flex_interp[f] {
            0 => m.flex_vertbodyid[part(m.flex_vertadr[f], m.flex_vertnum[f])].to_vec(),
            _ => m.flex_nodebodyid[part(m.flex_nodeadr[f], m.flex_nodenum[f])].to_vec(),
        };
        bodies.into_iter().for_each(|body| never(m, m.body_treeid[body as usize]));
    }
    for tree in 0..m.ntree {
        if m.tree_sleep_policy[tree] == SleepPolicy::Auto.code() {
            m.tree_sleep_policy[tree] = SleepPolicy::AutoAllowed.code();
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
    let (mut address, mut count, mut all) = (Vec::new(), Vec::new(), Vec::new());
    for i in 0..m.ntendon {
        let columns = tendon_columns(m, i);
        address.push(all.len() as i32);
        count.push(columns.len() as i32);
        all.extend(columns);
    }
    m.ten_J_rowadr.update(&address);
    m.ten_J_rownnz.update(&count);
    m.ten_J_colind.update(&all);
}
