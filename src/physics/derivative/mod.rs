//! Derivative of smooth forces with respect to velocity: `qDeriv = d(qfrc_passive + qfrc_actuator - qfrc_bias) /
//! d qvel` (MuJoCo documentation, Computation, "Numerical integration", implicit in velocity).
//!
//! Kept in compressed rows (`D_rownnz`, `D_rowadr`, `D_colind`) over pairs of degrees of freedom on one chain of a
//! tree. What couples others, such as a damped tendon between two trees, is left out of the integrator's matrix.
//!
//! ```
//! use robohive_physics::derivative::transition::transition;
//! use robohive_physics::Data;
//!
//! let model = robohive_mjcf::load_str(
//!     "<mujoco><worldbody><body><joint axis='0 1 0'/><geom size='.1' pos='1 0 0'/></body></worldbody></mujoco>",
//! )?
//! .model;
//! // One step adds the velocity, times its duration, to the position.
//! let linear = transition(&model, &mut Data::new(&model), 1e-6, true)?;
//! assert!((linear.a[1] - model.opt.timestep).abs() < 1e-5);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod actuation;
mod bias;
mod fluid;
mod free_body;
mod passive;
pub mod transition;

pub use bias::BiasScratch;
pub use fluid::FluidScratch;
pub use free_body::FreeBodySlope;

use crate::data::{
    Actuation, Com, Data, Flexes, Inertia, Kinematics, State, Tendons, Transmission, Velocity,
};
use crate::model::{JointType, Model};
use std::ops::Range;

/// Stage outputs that the derivative reads.
#[derive(Clone, Copy)]
#[allow(missing_docs)]
pub struct DerivativeInputs<'a> {
    pub state: &'a State,
    pub kin: &'a Kinematics,
    pub com: &'a Com,
    pub flex: &'a Flexes,
    pub ten: &'a Tendons,
    pub trn: &'a Transmission,
    pub inertia: &'a Inertia,
    pub vel: &'a Velocity,
    pub actuation: &'a Actuation,
}

/// The inputs in `d`. The caller may borrow other parts of `d` at the same time.
macro_rules! inputs_of {
    ($d:expr) => {
        $crate::derivative::DerivativeInputs {
            state: &$d.state,
            kin: &$d.kin,
            com: &$d.com,
            flex: &$d.flex,
            ten: &$d.ten,
            trn: &$d.trn,
            inertia: &$d.inertia,
            vel: &$d.vel,
            actuation: &$d.actuation,
        }
    };
}
pub(crate) use inputs_of;

impl<'a> From<&'a Data> for DerivativeInputs<'a> {
    fn from(d: &'a Data) -> Self {
        inputs_of!(d)
    }
}

/// Whether Coriolis and centrifugal forces are differentiated too.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum BiasSlope {
    /// All smooth forces.
    Included,
    /// Passive and actuator forces only, whose derivative is nearly symmetric.
    LeftOut,
}

/// Working memory of the derivative.
#[derive(Clone, Debug, Default)]
pub struct DerivativeScratch {
    fluid: FluidScratch,
    bias: BiasScratch,
}

/// Computes `qDeriv`.
pub fn smooth_force_slope(
    m: &Model,
    inputs: &DerivativeInputs,
    with: BiasSlope,
    scratch: &mut DerivativeScratch,
    out: &mut [f64],
) {
    out.fill(0.0);
    actuation::add_actuators(m, inputs, out);
    passive::add_passive(m, inputs, &mut scratch.fluid, out);
    if with == BiasSlope::Included {
        bias::subtract_bias(m, inputs, &mut scratch.bias, out);
    }
}

/// True for a body that is a tree of its own, with a free joint and all the mass.
pub fn is_free_body(m: &Model, body: usize) -> bool {
    let joint = m.body_jntadr[body] as usize;
    m.body_jntnum[body] == 1
        && m.jnt_type[joint] == JointType::Free.code()
        && m.tree_dofnum[m.dof_treeid[m.jnt_dofadr[joint] as usize] as usize] == 6
        && m.body_subtreemass[body] == m.body_mass[body]
}

/// Entries of row `dof` of the derivative.
pub fn row(m: &Model, dof: usize) -> Range<usize> {
    let start = m.D_rowadr[dof] as usize;
    start..start + m.D_rownnz[dof] as usize
}

/// Adds `value(p)` to entry `(dof, columns[p])` where the pattern has one. Both lists of columns increase.
fn add_to_row(m: &Model, dof: usize, columns: &[i32], value: impl Fn(usize) -> f64, out: &mut [f64]) {
    let at = row(m, dof);
    let mut p = 0;
    for (entry, &column) in out[at.clone()].iter_mut().zip(&m.D_colind[at]) {
        while p < columns.len() && columns[p] < column {
            p += 1;
        }
        if p == columns.len() {
            break;
        }
        if columns[p] == column {
            *entry += value(p);
        }
    }
}

/// `out += slope J'J` for one sparse row `J`.
fn add_square(m: &Model, columns: &[i32], values: &[f64], slope: f64, out: &mut [f64]) {
    for (&dof, &value) in columns.iter().zip(values) {
        let factor = value * slope;
        add_to_row(m, dof as usize, columns, |p| factor * values[p], out);
    }
}
