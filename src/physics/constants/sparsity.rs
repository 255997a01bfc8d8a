//! Sparsity patterns: inertia matrix (M lower, D symmetric), subtree dofs (B), and the sizes of tendon Jacobian and
//! actuator moment.
//!
//! The inertia of a tree couples a degree of freedom with its ancestors only (Featherstone, "Rigid Body Dynamics
//! Algorithms", section 8.5); rows of simple bodies are diagonal.

use super::set_const::{tendon_columns, tendon_entries};
use crate::model::{Arrays, JointType, TrnType};

/// Compressed rows without values.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Pattern {
    /// Elements of each row.
    pub count: Vec<i32>,
    /// First element of each row.
    pub address: Vec<i32>,
    /// Column of each element.
    pub column: Vec<i32>,
}

/// Patterns that follow from the tree of degrees of freedom.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Patterns {
    /// Diagonal elements of the inertia matrix in MuJoCo's ancestor order, and the number of all elements.
    pub diagonal: (Vec<i32>, usize),
    /// M: the lower triangle of the inertia matrix.
    pub lower: Pattern,
    /// D: the square pattern.
    pub symmetric: Pattern,
    /// Diagonal elements of D, counted from the starts of their rows.
    pub symmetric_diagonal: Vec<i32>,
    /// B: degrees of freedom by body.
    pub subtree: Pattern,
    /// Ancestor-ordered element of each element of M, element of M of each of D, and of D of each of M.
    pub maps: [Vec<i32>; 3],
}

/// Fills all patterns and their sizes.
pub fn fill(m: &mut Arrays) {
    let p = Patterns::of(m);
    (m.dof_Madr, m.nM) = (p.diagonal.0.into(), p.diagonal.1);
    (m.nC, m.nD, m.nB) = (p.lower.column.len(), p.symmetric.column.len(), p.subtree.column.len());
    (m.M_rownnz, m.M_rowadr) = (p.lower.count.into(), p.lower.address.into());
    (m.D_rownnz, m.D_rowadr) = (p.symmetric.count.into(), p.symmetric.address.into());
    (m.B_rownnz, m.B_rowadr) = (p.subtree.count.into(), p.subtree.address.into());
    (m.M_colind, m.D_colind) = (p.lower.column.into(), p.symmetric.column.into());
    (m.B_colind, m.D_diag) = (p.subtree.column.into(), p.symmetric_diagonal.into());
    let [ancestors, lower, square] = p.maps;
    (m.mapM2M, m.mapM2D, m.mapD2M) = (ancestors.into(), lower.into(), square.into());
    m.nJten = tendon_entries(m);
    m.nJmom = moment_size(m);
}

impl Patterns {
    /// The patterns of the bodies and degrees of freedom of `m`.
    pub fn of(m: &Arrays) -> Self {
        let mut next = 0;
        let address = (0..m.nv).map(|dof| {
            next += 1 + ancestors(m, dof).count() as i32;
            next - 1 - ancestors(m, dof).count() as i32
        });
        let mut p = Patterns { diagonal: (address.collect(), 0), ..Patterns::default() };
        p.diagonal.1 = next as usize;
        p.lower = compress(&lower_rows(m));
        p.symmetric = compress(&symmetric_rows(m));
        let above = |dof: usize| ancestors(m, dof).count() as i32;
        p.symmetric_diagonal = (0..m.nv).map(above).collect();
        p.subtree = compress(&subtree_rows(m));
        p.fill_maps();
        p
    }

    /// Where elements of M are found in D, of D in M, and of compressed M in MuJoCo's ancestor-ordered M.
    fn fill_maps(&mut self) {
        let (low, square) = (&self.lower, &self.symmetric);
        let [to_ancestors, from_lower, from_square] = &mut self.maps;
        for row in 0..low.count.len() {
            for k in square.row(row) {
                let column = square.column[k] as usize;
                from_lower.push(low.find(row.max(column), row.min(column) as i32));
            }
            for k in low.row(row) {
                from_square.push(square.find(row, low.column[k]));
            }
            // From the diagonal up to the root, hence backwards.
            let first = self.diagonal.0[row];
            to_ancestors.extend((first..first + low.count[row]).rev());
        }
    }
}

impl Pattern {
    /// Elements of row `i`.
    fn row(&self, i: usize) -> std::ops::Range<usize> {
        self.address[i] as usize..(self.address[i] + self.count[i]) as usize
    }

    /// Element in row `i` and column `column`, -1 for none.
    fn find(&self, i: usize, column: i32) -> i32 {
        let row = &self.column[self.row(i)];
        row.iter().position(|&c| c == column).map_or(-1, |k| self.address[i] + k as i32)
    }
}

/// Degrees of freedom above `dof`, nearest first.
fn ancestors(m: &Arrays, dof: usize) -> impl Iterator<Item = usize> {
    std::iter::successors(Some(dof), |&d| usize::try_from(m.dof_parentid[d]).ok()).skip(1)
}

fn compress(rows: &[Vec<i32>]) -> Pattern {
    let count: Vec<i32> = rows.iter().map(|row| row.len() as i32).collect();
    let mut next = 0;
    let address = count.iter().map(|count| {
        next += count;
        next - count
    });
    Pattern { address: address.collect(), column: rows.concat(), count }
}

/// M: each row holds the ancestors and the diagonal; a simple row the diagonal only.
fn lower_rows(m: &Arrays) -> Vec<Vec<i32>> {
    (0..m.nv)
        .map(|dof| {
            let mut row = vec![dof as i32];
            if m.dof_simplenum[dof] == 0 {
                row.extend(ancestors(m, dof).map(|d| d as i32));
            }
            row.reverse();
            row
        })
        .collect()
}

/// D: ancestors, diagonal and descendants.
fn symmetric_rows(m: &Arrays) -> Vec<Vec<i32>> {
    let mut rows: Vec<Vec<i32>> = vec![Vec::new(); m.nv];
    for dof in 0..m.nv {
        let mut above: Vec<usize> = ancestors(m, dof).collect();
        above.reverse();
        rows[dof].extend(above.iter().map(|&d| d as i32));
        rows[dof].push(dof as i32);
        above.iter().for_each(|&d| rows[d].push(dof as i32));
    }
    rows
}

/// B: degrees of freedom that move a body or are moved with it.
fn subtree_rows(m: &Arrays) -> Vec<Vec<i32>> {
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
    rows
}

/// Elements that the actuator moment can have.
pub fn moment_size(m: &Arrays) -> usize {
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
fn chain(m: &Arrays, body: i32) -> Vec<usize> {
    let weld = m.body_weldid[body as usize] as usize;
    if m.body_dofnum[weld] == 0 {
        return Vec::new();
    }
    let last = (m.body_dofadr[weld] + m.body_dofnum[weld] - 1) as usize;
    std::iter::once(last).chain(ancestors(m, last)).collect()
}
