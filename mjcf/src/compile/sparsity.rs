//! Sparsity patterns: inertia matrix (M lower, D symmetric), subtree dofs (B), and the sizes of tendon Jacobian and
//! actuator moment.
//!
//! The inertia of a tree couples a degree of freedom with its ancestors only (Featherstone, "Rigid Body Dynamics
//! Algorithms", section 8.5); rows of simple bodies are diagonal.

use physics::Model;
use physics::model::{JointType, TrnType};
use physics::set_const::{tendon_columns, tendon_entries};

/// Fills all patterns and their sizes.
pub(super) fn fill(m: &mut Model) {
    let mut address = 0;
    for dof in 0..m.nv {
        m.dof_Madr.push(address);
        address += 1 + ancestors(m, dof).count() as i32;
    }
    m.nM = address as usize;
    lower_rows(m);
    symmetric_rows(m);
    subtree_rows(m);
    maps(m);
    m.nJten = tendon_entries(m);
    m.nJmom = moment_size(m);
}

/// Degrees of freedom above `dof`, nearest first.
fn ancestors(m: &Model, dof: usize) -> impl Iterator<Item = usize> {
    std::iter::successors(Some(dof), |&d| usize::try_from(m.dof_parentid[d]).ok()).skip(1)
}

/// Compressed rows: counts, addresses and columns.
fn compress(rows: &[Vec<i32>]) -> (Vec<i32>, Vec<i32>, Vec<i32>) {
    let counts: Vec<i32> = rows.iter().map(|row| row.len() as i32).collect();
    let mut next = 0;
    let addresses = counts
        .iter()
        .map(|count| {
            next += count;
            next - count
        })
        .collect();
    (counts, addresses, rows.concat())
}

/// M: each row holds the ancestors and the diagonal; a simple row the diagonal only.
fn lower_rows(m: &mut Model) {
    let rows: Vec<Vec<i32>> = (0..m.nv)
        .map(|dof| {
            let mut row = vec![dof as i32];
            if m.dof_simplenum[dof] == 0 {
                row.extend(ancestors(m, dof).map(|d| d as i32));
            }
            row.reverse();
            row
        })
        .collect();
    (m.M_rownnz, m.M_rowadr, m.M_colind) = compress(&rows);
    m.nC = m.M_colind.len();
}

/// D: ancestors, diagonal and descendants.
fn symmetric_rows(m: &mut Model) {
    let mut rows: Vec<Vec<i32>> = vec![Vec::new(); m.nv];
    for dof in 0..m.nv {
        let mut above: Vec<usize> = ancestors(m, dof).collect();
        above.reverse();
        rows[dof].extend(above.iter().map(|&d| d as i32));
        rows[dof].push(dof as i32);
        above.iter().for_each(|&d| rows[d].push(dof as i32));
    }
    m.D_diag = rows
        .iter()
        .enumerate()
        .map(|(dof, row)| row.iter().filter(|&&d| d < dof as i32).count() as i32)
        .collect();
    (m.D_rownnz, m.D_rowadr, m.D_colind) = compress(&rows);
    m.nD = m.D_colind.len();
}

/// B: degrees of freedom that move a body or are moved with it.
fn subtree_rows(m: &mut Model) {
    let own = |body: usize| {
        let first = m.body_dofadr[body];
        first..first + m.body_dofnum[body]
    };
    let mut rows: Vec<Vec<i32>> =
        (0..m.nbody).map(|b| if m.body_dofnum[b] > 0 { own(b).collect() } else { Vec::new() }).collect();
    for body in (1..m.nbody).rev() {
        let row = rows[body].clone();
        rows[m.body_parentid[body] as usize].extend(row);
    }
    for body in 1..m.nbody {
        let mut above = m.body_parentid[body] as usize;
        while above > 0 {
            if m.body_dofnum[above] > 0 {
                rows[body].extend(own(above));
            }
            above = m.body_parentid[above] as usize;
        }
    }
    rows.iter_mut().for_each(|row| row.sort_unstable());
    if m.nv == 0 {
        rows.iter_mut().for_each(Vec::clear);
    }
    (m.B_rownnz, m.B_rowadr, m.B_colind) = compress(&rows);
    m.nB = m.B_colind.len();
}

/// Where elements of M are found in D, of D in M, and of compressed M in MuJoCo's ancestor-ordered M.
fn maps(m: &mut Model) {
    let find = |columns: &[i32], address: i32, count: i32, column: i32| {
        let row = &columns[address as usize..(address + count) as usize];
        row.iter().position(|&c| c == column).map_or(-1, |k| address + k as i32)
    };
    for row in 0..m.nv {
        for k in entries(m.D_rowadr[row], m.D_rownnz[row]) {
            let column = m.D_colind[k] as usize;
            let (low, high) = (row.min(column), row.max(column));
            m.mapM2D.push(find(&m.M_colind, m.M_rowadr[high], m.M_rownnz[high], low as i32));
        }
        for k in entries(m.M_rowadr[row], m.M_rownnz[row]) {
            m.mapD2M.push(find(&m.D_colind, m.D_rowadr[row], m.D_rownnz[row], m.M_colind[k]));
        }
        // From the diagonal up to the root, hence backwards.
        let first = m.dof_Madr[row];
        m.mapM2M.extend((first..first + m.M_rownnz[row]).rev());
    }
}

fn entries(address: i32, count: i32) -> std::ops::Range<usize> {
    address as usize..(address + count) as usize
}

/// Elements that the actuator moment can have.
fn moment_size(m: &Model) -> usize {
    (0..m.nactuator)
        .map(|a| {
            let [target, reference] = m.actuator_trnid[a];
            let id = target as usize;
            match TrnType::from_code(m.actuator_trntype[a]) {
                Some(TrnType::So3) if reference >= 0 => 3 * m.nv,
                Some(TrnType::So3) => 3,
                Some(TrnType::Joint | TrnType::Jointinparent) => match JointType::from_code(m.jnt_type[id]) {
                    Some(JointType::Free) => 6,
                    Some(JointType::Ball) => 3,
                    Some(JointType::Slide | JointType::Hinge) | None => 1,
                },
                Some(TrnType::Tendon) => tendon_columns(m, id).len(),
                Some(TrnType::Slidercrank) => {
                    let (a, b) = (chain(m, m.site_bodyid[id]), chain(m, m.site_bodyid[reference as usize]));
                    a.len() + b.iter().filter(|dof| !a.contains(dof)).count()
                }
                Some(TrnType::Site) => {
                    let a = chain(m, m.site_bodyid[id]);
                    let b =
                        if reference < 0 { Vec::new() } else { chain(m, m.site_bodyid[reference as usize]) };
                    let common = a.iter().filter(|dof| b.contains(dof)).count();
                    a.len() + b.len() - 2 * common
                }
                Some(TrnType::Body) => m.nv,
                Some(TrnType::Undefined) | None => 0,
            }
        })
        .sum()
}

/// Degrees of freedom that move a body.
fn chain(m: &Model, body: i32) -> Vec<usize> {
    let weld = m.body_weldid[body as usize] as usize;
    if m.body_dofnum[weld] == 0 {
        return Vec::new();
    }
    let last = (m.body_dofadr[weld] + m.body_dofnum[weld] - 1) as usize;
    std::iter::once(last).chain(ancestors(m, last)).collect()
}
