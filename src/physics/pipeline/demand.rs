//! What contacts and constraint rows ask of the step's budget, counted before they are stored.

use crate::data::{Constraints, Contact, Contacts, Demand, Islands, OverBudget, StepBudget};
use crate::model::flex::representative;
use crate::model::{Cone, Enable, Model, Solver};
use crate::position::chain::last_dof;

/// Rows of one contact at most: five friction directions, two edges each.
const CONTACT_ROWS: usize = 10;

/// Bytes of a row in `Constraints`, `Islands` and the solver's copies, Jacobian aside.
const ROW_BYTES: usize = 384;

/// Bytes of an entry of the Jacobian in compressed rows and the solver's copies: two values, two columns, its place.
const ENTRY_BYTES: usize = 40;

impl StepBudget {
    /// Checks the rows that contacts and other constraints will make, before they are made.
    ///
    /// # Errors
    /// They need more than the budget.
    pub fn check_rows(self, m: &Model, con: &Contacts) -> Result<(), OverBudget> {
        // Equalities, friction of joints and tendons, limits on both sides.
        let others = m.nemax + m.nv + 3 * m.ntendon + 2 * m.njnt;
        let contacts = con.contact.len();
        let all = others + CONTACT_ROWS * contacts;
        if self.bytes_of_rows(m, all, all.saturating_mul(m.nv)) <= self.bytes {
            return Ok(());
        }
        let (mut rows, mut entries) = (others, entries_without_contacts(m));
        for c in con.contact.iter().filter(|c| c.exclude == 0) {
            let own = contact_rows(m, c);
            rows += own;
            entries =
                entries.saturating_add(own * (0..2).map(|side| chain_length(m, c, side)).sum::<usize>());
        }
        self.check(
            rows,
            contacts,
            self.bytes_of_rows(m, rows, entries).saturating_add(contacts * size_of::<Contact>()),
        )
    }

    /// Checks the matrices that the solver makes of the rows, before it makes them.
    ///
    /// # Errors
    /// They need more than the budget.
    pub(crate) fn check_solver(
        self,
        m: &Model,
        con: &Contacts,
        efc: &Constraints,
        island: &Islands,
    ) -> Result<(), OverBudget> {
        if self.bytes_of_solver(m, efc.nefc, efc.nefc, m.nv) <= self.bytes {
            return Ok(());
        }
        let largest = |sizes: &[i32], all: usize| sizes.iter().max().map_or(all, |&n| n as usize);
        let (rows, dofs) = (largest(&island.island_nefc, efc.nefc), largest(&island.island_nv, m.nv));
        self.check(efc.nefc, con.contact.len(), self.bytes_of_solver(m, efc.nefc, rows, dofs))
    }

    fn check(self, rows: usize, contacts: usize, bytes: usize) -> Result<(), OverBudget> {
        if bytes <= self.bytes {
            return Ok(());
        }
        Err(OverBudget { demand: Demand::Rows, count: rows, contacts, bytes, budget: self.bytes })
    }

    /// Bytes of rows with `entries` in their Jacobian; `diagexact` multiplies them by the half inverse inertia.
    fn bytes_of_rows(self, m: &Model, rows: usize, entries: usize) -> usize {
        let half = if m.opt.enableflags.contains(Enable::DIAGEXACT) { half_bytes(m, rows) } else { 0 };
        (rows * ROW_BYTES).saturating_add(entries.saturating_mul(ENTRY_BYTES)).saturating_add(half)
    }

    /// Bytes of the solver's matrices for `nefc` rows, when the largest island has `rows` rows and `dofs` degrees
    /// of freedom.
    fn bytes_of_solver(self, m: &Model, nefc: usize, rows: usize, dofs: usize) -> usize {
        let square = |n: usize| n.saturating_mul(n);
        let dual = if m.opt.solver == Solver::Pgs || m.opt.noslip_iterations > 0 {
            // With the columns of compressed rows, and the sets that they follow from.
            let [entry, sets] = if m.is_sparse() { [12, nefc.saturating_mul(m.nv / 8 + 8)] } else { [8, 0] };
            square(nefc + 8).saturating_mul(entry).saturating_add(half_bytes(m, nefc)).saturating_add(sets)
        } else {
            0
        };
        let primal = match m.opt.solver {
            Solver::Pgs => 0,
            // Full rows, their scaled copies, and two factors.
            _ if !m.is_sparse() => {
                rows.saturating_mul(dofs).saturating_mul(16).saturating_add(square(dofs).saturating_mul(16))
            }
            // A bit for each entry that the factor may have.
            Solver::Newton => square(dofs) / 8,
            Solver::Cg => 0,
        };
        dual.saturating_add(primal)
    }
}

/// Bytes of `J M^(-1/2)` in blocks, and of the sets of ancestors.
fn half_bytes(m: &Model, rows: usize) -> usize {
    (rows + 8).saturating_mul(m.nv).saturating_mul(8).saturating_add(m.nv.saturating_mul(m.nv) / 8)
}

/// Entries of the Jacobian rows of equalities, friction and limits, at most.
fn entries_without_contacts(m: &Model) -> usize {
    let longest_chain = m.D_diag.iter().max().map_or(0, |&above| 1 + above as usize);
    let longest_tendon = m.ten_J_rownnz.iter().max().map_or(0, |&n| n as usize);
    let equality = 2 * longest_chain.max(longest_tendon);
    m.nemax.saturating_mul(equality) + m.nv + 3 * m.nJten + 6 * m.njnt
}

fn contact_rows(m: &Model, c: &Contact) -> usize {
    match c.dim {
        ..=1 => 1,
        dim if m.opt.cone == Cone::Pyramidal => 2 * (dim as usize - 1),
        dim => dim as usize,
    }
}

/// Degrees of freedom that move a geom, or at most those that move a point of a flex.
fn chain_length(m: &Model, c: &Contact, side: usize) -> usize {
    let body = representative(m, c, side);
    let length = usize::try_from(last_dof(m, body)).map_or(0, |dof| 1 + m.D_diag[dof] as usize);
    let longest = || m.D_diag.iter().max().map_or(0, |&above| 1 + above as usize);
    if c.geom[side] >= 0 { length } else { longest().saturating_mul(MOST_SUPPORTS) }
}

/// Bodies that a point of a flex belongs to, at most: the nodes of a quadratic cell.
const MOST_SUPPORTS: usize = 27;
