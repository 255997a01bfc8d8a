//! Sparsity: what a file says of it must be what follows from its trees, paths and actuators.

use super::requirement::{Inconsistent, require};
use crate::arrays::Arrays;
use crate::constants::set_const::tendon_columns;
use crate::constants::sparsity::{Patterns, moment_size};

pub(super) fn check(m: &Arrays) -> Result<(), Inconsistent> {
    sizes(m)?;
    let p = Patterns::of(m);
    let [ancestors, lower, square] = &p.maps;
    let arrays: [(_, &[i32], _); 14] = [
        ("dof_Madr", &m.dof_Madr, &p.diagonal.0),
        ("M_rownnz", &m.M_rownnz, &p.lower.count),
        ("M_rowadr", &m.M_rowadr, &p.lower.address),
        ("M_colind", &m.M_colind, &p.lower.column),
        ("D_rownnz", &m.D_rownnz, &p.symmetric.count),
        ("D_rowadr", &m.D_rowadr, &p.symmetric.address),
        ("D_colind", &m.D_colind, &p.symmetric.column),
        ("D_diag", &m.D_diag, &p.symmetric_diagonal),
        ("B_rownnz", &m.B_rownnz, &p.subtree.count),
        ("B_rowadr", &m.B_rowadr, &p.subtree.address),
        ("B_colind", &m.B_colind, &p.subtree.column),
        ("mapM2M", &m.mapM2M, ancestors),
        ("mapM2D", &m.mapM2D, lower),
        ("mapD2M", &m.mapD2M, square),
    ];
    for (array, is, expected) in arrays {
        require(is == expected, array, 0, "what follows from the tree")?;
    }
    require(m.nM == p.diagonal.1, "nM", 0, "what follows from the tree")?;
    require(m.nJmom == moment_size(m), "nJmom", 0, "what follows from the actuators")?;
    let mut next = 0;
    for tendon in 0..m.ntendon {
        let columns = tendon_columns(m, tendon);
        let (first, n) = (m.ten_J_rowadr[tendon], m.ten_J_rownnz[tendon]);
        let row = m.ten_J_colind.get(next..next + columns.len());
        let fits = first as usize == next && n as usize == columns.len() && row == Some(&columns);
        require(fits, "ten_J_rowadr", tendon, "what follows from the path")?;
        next += columns.len();
    }
    require(m.nJten == next, "nJten", 0, "what follows from the paths")
}

/// The patterns have as many elements as those to be compared with them, so that no more memory is taken.
fn sizes(m: &Arrays) -> Result<(), Inconsistent> {
    let mut above = vec![0; m.nv];
    for dof in 0..m.nv {
        above[dof] = usize::try_from(m.dof_parentid[dof]).map_or(0, |parent| 1 + above[parent]);
    }
    let square = m.nv + 2 * above.iter().sum::<usize>();
    require(m.nD == square, "nD", 0, "what follows from the tree")?;
    let mut subtree: Vec<usize> = m.body_dofnum.iter().map(|&n| n as usize).collect();
    let mut total = 0;
    for b in (1..m.nbody).rev() {
        subtree[m.body_parentid[b] as usize] += subtree[b];
    }
    let mut above = vec![0; m.nbody];
    for b in 0..m.nbody {
        let parent = m.body_parentid[b] as usize;
        if parent > 0 {
            above[b] = above[parent] + m.body_dofnum[parent] as usize;
        }
        total += subtree[b] + above[b];
    }
    require(m.nB == total, "nB", 0, "what follows from the tree")
}
