//! Arrays of `Data` by address: what a binding of another language finds once by name and then copies at every step.
//!
//! ```
//! use robohive_physics::Data;
//! use robohive_physics::table::SliceMut;
//!
//! let text = "<mujoco><worldbody><body><joint/><geom size='.1'/></body></worldbody></mujoco>";
//! let model = robohive_mjcf::load_str(text)?.model;
//! let mut data = Data::new(&model);
//! let mut found = None;
//! data.visit_arrays(&model, &mut |at, name, _, _| found = found.or((name == "qvel").then_some(at)));
//! if let Some(SliceMut::F64(qvel)) = data.array_mut(found.ok_or("no velocities")?) {
//!     qvel[0] = 2.0;
//! }
//! assert_eq!(data.state.qvel, [2.0]);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

use super::Data;
use crate::model::Model;
use crate::table::{Slice, SliceMut};

/// Where an array stands that is as long as sizes of the model say. The same for all `Data`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct ArrayAddress {
    stage: usize,
    number: usize,
}

/// Address of `energy`, which belongs to no stage struct.
const ENERGY: ArrayAddress = ArrayAddress { stage: usize::MAX, number: 0 };
/// Address of `solver_fwdinv`.
const FWDINV: ArrayAddress = ArrayAddress { stage: usize::MAX, number: 1 };

macro_rules! stages {
    ($($stage:ident)*) => {
        impl Data {
            /// Calls `f(address, name, shape, values)` for every array whose length follows from sizes of the model:
            /// not for contacts, constraint rows and islands.
            pub fn visit_arrays(
                &self,
                m: &Model,
                f: &mut dyn FnMut(ArrayAddress, &'static str, Vec<usize>, Slice<'_>),
            ) {
                let mut next = ArrayAddress { stage: 0, number: 0 };
                $(
                    self.$stage.visit(m, &mut |name, shape, values| {
                        f(next, name, shape, values);
                        next.number += 1;
                    });
                    next = ArrayAddress { stage: next.stage + 1, number: 0 };
                )*
                _ = next;
                f(ENERGY, "energy", vec![2], Slice::F64(&self.energy));
                f(FWDINV, "solver_fwdinv", vec![2], Slice::F64(&self.solver.solver_fwdinv));
            }

            /// The array at `at`.
            pub fn array(&self, at: ArrayAddress) -> Option<Slice<'_>> {
                type Read = for<'a> fn(&'a Data, usize) -> Option<Slice<'a>>;
                const READ: &[Read] = &[$(|d, number| d.$stage.array(number),)*];
                match at {
                    ENERGY => Some(Slice::F64(&self.energy)),
                    FWDINV => Some(Slice::F64(&self.solver.solver_fwdinv)),
                    at => READ.get(at.stage).and_then(|read| read(self, at.number)),
                }
            }

            /// The array at `at`, to write.
            pub fn array_mut(&mut self, at: ArrayAddress) -> Option<SliceMut<'_>> {
                type Write = for<'a> fn(&'a mut Data, usize) -> Option<SliceMut<'a>>;
                const WRITE: &[Write] = &[$(|d, number| d.$stage.array_mut(number),)*];
                match at {
                    ENERGY => Some(SliceMut::F64(&mut self.energy)),
                    FWDINV => Some(SliceMut::F64(&mut self.solver.solver_fwdinv)),
                    at => WRITE.get(at.stage).and_then(|write| write(self, at.number)),
                }
            }
        }
    };
}

stages! { state kin com flex ten trn inertia vel passive actuation acc sensor implicit }
