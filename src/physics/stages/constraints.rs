//! Contacts, constraint rows and islands: arrays whose length changes from step to step.

use crate::math::{Mat3, Vec3};
use crate::table::{Field, Slice};

/// One point of contact between two geoms, a geom and a flex, or two flexes (documentation: `mjContact`).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Contact {
    /// Distance between the nearest points; negative in penetration \[m\].
    pub dist: f64,
    /// Midpoint between the surfaces.
    pub pos: Vec3,
    /// Contact frame: rows are the normal, from the first geom to the second, and two tangents.
    pub frame: Mat3,
    /// The contact makes force when `dist` is below this \[m\].
    pub includemargin: f64,
    /// Friction coefficients: two tangential, torsional, two rolling.
    pub friction: [f64; 5],
    /// Solver reference, normal direction.
    pub solref: [f64; 2],
    /// Solver reference, friction directions; zeros take `solref`.
    pub solreffriction: [f64; 2],
    /// Solver impedance.
    pub solimp: [f64; 5],
    /// Adhesive force along the normal \[N\].
    pub adhesion: f64,
    /// Friction of the regularised cone.
    pub mu: f64,
    /// Dimension of the contact space: 1, 3, 4 or 6.
    pub dim: i32,
    /// The two geoms; -1 for a flex.
    pub geom: [i32; 2],
    /// The two flexes; -1 for a geom.
    pub flex: [i32; 2],
    /// Their elements, counted within the flex; -1 for a geom or a vertex.
    pub elem: [i32; 2],
    /// Their vertices, counted within the flex; -1 for a geom or an element.
    pub vert: [i32; 2],
    /// 0 makes force; 1 in the gap; 2 fused; 3 no degrees of freedom; 4 passive.
    pub exclude: i32,
    /// First constraint row; -1 when there is none.
    pub efc_address: i32,
}

/// Output of collision detection, in MuJoCo's order.
#[derive(Clone, Debug, Default)]
pub struct Contacts {
    /// All contacts of this step.
    pub contact: Vec<Contact>,
}

macro_rules! rows {
    ($(#[$meta:meta])* $name:ident { $($(#[$doc:meta])* $field:ident : $ty:ty,)* } scalars { $($(#[$sdoc:meta])* $scalar:ident,)* }) => {
        $(#[$meta])*
        #[derive(Clone, Debug, Default)]
        #[allow(non_snake_case)]
        pub struct $name {
            $($(#[$doc])* pub $field: $ty,)*
            $($(#[$sdoc])* pub $scalar: usize,)*
        }

        impl $name {
            /// Calls `f(name, shape, values)` for every array, in declaration order.
            pub fn visit(&self, f: &mut dyn FnMut(&'static str, Vec<usize>, Slice<'_>)) {
                $({
                    let columns = <$ty as Field>::COLUMNS;
                    let shape = if columns == 1 { vec![self.$field.len()] } else { vec![self.$field.len(), columns] };
                    f(stringify!($field), shape, Field::scalars(&self.$field));
                })*
            }

            /// Calls `f(name, value)` for every count.
            pub fn visit_counts(&self, f: &mut dyn FnMut(&'static str, usize)) {
                $(f(stringify!($scalar), self.$scalar);)*
            }

            /// Replaces the array called `name`, changing its length; `None` when there is none.
            pub fn assign(&mut self, name: &str, values: &[f64]) -> Option<bool> {
                match name {
                    $(stringify!($field) => Some(Field::assign(&mut self.$field, values)),)*
                    _ => None,
                }
            }

            /// Sets a count by name; false when there is none.
            pub fn set_count(&mut self, name: &str, value: usize) -> bool {
                match name {
                    $(stringify!($scalar) => self.$scalar = value,)*
                    _ => return false,
                }
                true
            }
        }
    };
}

rows! {
    /// Constraint rows (`make_constraint`): equality, friction loss, limits, contacts, in that order.
    /// The Jacobian is kept in compressed rows on every path. After a step of another engine
    /// (`pipeline::stepper`) rows of contacts have a force but no Jacobian entries (`constraint::push_applied`).
    Constraints {
        /// Kind of row (`ConstraintType`).
        efc_type: Vec<i32>,
        /// Element that made the row.
        efc_id: Vec<i32>,
        /// Non-zeros of each Jacobian row.
        efc_J_rownnz: Vec<i32>,
        /// Start of each Jacobian row.
        efc_J_rowadr: Vec<i32>,
        /// Columns of Jacobian entries.
        efc_J_colind: Vec<i32>,
        /// Jacobian entries.
        efc_J: Vec<f64>,
        /// Violation of the constraint \[m, rad\].
        efc_pos: Vec<f64>,
        /// Inclusion margin.
        efc_margin: Vec<f64>,
        /// Friction loss \[N, N m\].
        efc_frictionloss: Vec<f64>,
        /// Diagonal of the inverse inertia in constraint space, approximate.
        efc_diagA: Vec<f64>,
        /// Stiffness, damping, impedance and its derivative.
        efc_KBIP: Vec<[f64; 4]>,
        /// Constraint mass.
        efc_D: Vec<f64>,
        /// Inverse constraint mass.
        efc_R: Vec<f64>,
        /// First row of each tendon; -1 when there is none.
        tendon_efcadr: Vec<i32>,
        /// Velocity in constraint space.
        efc_vel: Vec<f64>,
        /// Reference acceleration.
        efc_aref: Vec<f64>,
        /// Linear term of the dual cost: `J qacc_smooth - aref`.
        efc_b: Vec<f64>,
        /// State of each row (`ConstraintState`).
        efc_state: Vec<i32>,
        /// Force of each row.
        efc_force: Vec<f64>,
    } scalars {
        /// Equality rows.
        ne,
        /// Friction-loss rows.
        nf,
        /// Limit rows.
        nl,
        /// All rows.
        nefc,
    }
}

rows! {
    /// Islands: sets of trees that constraints couple (`find_islands`).
    Islands {
        /// Island of each tree; -1 when it is free.
        tree_island: Vec<i32>,
        /// Trees of each island.
        island_ntree: Vec<i32>,
        /// First tree of each island in `map_itree2tree`.
        island_itreeadr: Vec<i32>,
        /// Trees sorted by island.
        map_itree2tree: Vec<i32>,
        /// Island of each degree of freedom; -1 when it is free.
        dof_island: Vec<i32>,
        /// Degrees of freedom of each island.
        island_nv: Vec<i32>,
        /// First sorted degree of freedom of each island.
        island_idofadr: Vec<i32>,
        /// First degree of freedom of each island.
        island_dofadr: Vec<i32>,
        /// Sorted index of each degree of freedom.
        map_dof2idof: Vec<i32>,
        /// Degrees of freedom sorted by island, free ones last.
        map_idof2dof: Vec<i32>,
        /// Island of each row.
        efc_island: Vec<i32>,
        /// Equality rows of each island.
        island_ne: Vec<i32>,
        /// Friction-loss rows of each island.
        island_nf: Vec<i32>,
        /// Rows of each island.
        island_nefc: Vec<i32>,
        /// First sorted row of each island.
        island_iefcadr: Vec<i32>,
        /// Sorted index of each row.
        map_efc2iefc: Vec<i32>,
        /// Rows sorted by island.
        map_iefc2efc: Vec<i32>,
    } scalars {
        /// Number of islands.
        nisland,
        /// Degrees of freedom in islands.
        nidof,
    }
}

impl Constraints {
    /// The Jacobian as a dense `nefc * nv` matrix.
    pub fn dense_jacobian(&self, nv: usize) -> Vec<f64> {
        let mut dense = vec![0.0; self.nefc * nv];
        for row in 0..self.nefc {
            let start = self.efc_J_rowadr[row] as usize;
            for k in start..start + self.efc_J_rownnz[row] as usize {
                dense[row * nv + self.efc_J_colind[k] as usize] = self.efc_J[k];
            }
        }
        dense
    }

    /// Takes over a dense Jacobian, `nefc * nv`: in place while no entries are there but those of the present pattern.
    /// Otherwise all rows get an entry for every column, and the return is true: rows may couple more than their islands.
    pub fn set_dense_jacobian(&mut self, nv: usize, dense: &[f64]) -> bool {
        let mut kept = vec![0.0; dense.len()];
        for row in 0..self.nefc {
            let start = self.efc_J_rowadr[row] as usize;
            for k in start..start + self.efc_J_rownnz[row] as usize {
                let at = row * nv + self.efc_J_colind[k] as usize;
                self.efc_J[k] = dense[at];
                kept[at] = dense[at];
            }
        }
        if kept == dense {
            return false;
        }
        self.efc_J = dense.to_vec();
        self.efc_J_colind = (0..dense.len()).map(|k| (k % nv) as i32).collect();
        self.efc_J_rowadr = (0..self.nefc).map(|row| (row * nv) as i32).collect();
        self.efc_J_rownnz = vec![nv as i32; self.nefc];
        true
    }
}

/// One iteration of the constraint solver, or one sweep of the removal of slip (documentation: `mjSolverStat`).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SolverStat {
    /// Reduction of cost, scaled.
    pub improvement: f64,
    /// Length of the gradient, scaled; zero for dual solvers.
    pub gradient: f64,
    /// Slope at the end of the line search, scaled; zero for dual solvers.
    pub lineslope: f64,
    /// Rows that make force.
    pub nactive: i32,
    /// Rows that changed state.
    pub nchange: i32,
    /// Evaluations of the line search.
    pub neval: i32,
    /// Updates of the Hessian's factor.
    pub nupdate: i32,
}

/// What the constraint solver did, per island.
#[derive(Clone, Debug, Default)]
pub struct SolverStatistics {
    /// Every iteration, island after island.
    pub solver: Vec<SolverStat>,
    /// Iterations of each island (one entry when islands are off).
    pub solver_niter: Vec<i32>,
    /// Non-zeros of each island's solver matrix.
    pub solver_nnz: Vec<i32>,
    /// Differences of forward and inverse dynamics, with the flag `fwdinv`: constraint force, applied force.
    pub solver_fwdinv: [f64; 2],
}

macro_rules! contact_fields {
    ($($name:literal $field:ident $kind:ident $width:literal,)*) => {
        impl Contacts {
            /// Calls `f(name, shape, values)` with one array per contact field, named `contact.dist` and so on.
            pub fn visit(&self, f: &mut dyn FnMut(&'static str, Vec<usize>, Slice<'_>)) {
                let n = self.contact.len();
                f("ncon", vec![], Slice::I32(&[n as i32]));
                $({
                    let flat: Vec<_> = self.contact.iter().flat_map(|c| ContactScalars::list(&c.$field).to_vec()).collect();
                    f($name, if $width == 1 { vec![n] } else { vec![n, $width] }, Slice::$kind(&flat));
                })*
            }

            /// Overwrites one field of all contacts; the first assignment after `clear` sets their number.
            pub fn assign(&mut self, name: &str, values: &[f64]) -> Option<bool> {
                match name {
                    $($name => {
                        if self.contact.is_empty() {
                            self.contact.resize(values.len() / $width, Contact::default());
                        }
                        if self.contact.len() * $width != values.len() {
                            return Some(false);
                        }
                        for (c, row) in self.contact.iter_mut().zip(values.chunks_exact($width)) {
                            ContactScalars::set(&mut c.$field, row);
                        }
                        Some(true)
                    })*
                    _ => None,
                }
            }
        }
    };
}

/// A contact field seen as a row of scalars.
trait ContactScalars {
    type Scalar;
    fn list(&self) -> &[Self::Scalar];
    fn set(&mut self, row: &[f64]);
}

macro_rules! contact_scalars {
    ($t:ty) => {
        impl ContactScalars for $t {
            type Scalar = $t;
            fn list(&self) -> &[$t] {
                std::slice::from_ref(self)
            }
            fn set(&mut self, row: &[f64]) {
                *self = row[0] as $t;
            }
        }
        impl<const N: usize> ContactScalars for [$t; N] {
            type Scalar = $t;
            fn list(&self) -> &[$t] {
                self
            }
            fn set(&mut self, row: &[f64]) {
                *self = std::array::from_fn(|i| row[i] as $t);
            }
        }
    };
}
contact_scalars!(f64);
contact_scalars!(i32);

contact_fields! {
    "contact.dist" dist F64 1,
    "contact.pos" pos F64 3,
    "contact.frame" frame F64 9,
    "contact.includemargin" includemargin F64 1,
    "contact.friction" friction F64 5,
    "contact.solref" solref F64 2,
    "contact.solreffriction" solreffriction F64 2,
    "contact.solimp" solimp F64 5,
    "contact.adhesion" adhesion F64 1,
    "contact.mu" mu F64 1,
    "contact.dim" dim I32 1,
    "contact.geom" geom I32 2,
    "contact.flex" flex I32 2,
    "contact.elem" elem I32 2,
    "contact.vert" vert I32 2,
    "contact.exclude" exclude I32 1,
    "contact.efc_address" efc_address I32 1,
}
