//! Derivative of smooth forces with respect to velocity: `qDeriv = d(qfrc_passive + qfrc_actuator - qfrc_bias) /
//! d qvel` (MuJoCo documentation, Computation, "Numerical integration", implicit in velocity).
//!
//! Kept in compressed rows (`D_rownnz`, `D_rowadr`, `D_colind`) over pairs of degrees of freedom on one chain of a
//! tree. What couples others, such as a damped tendon between two trees, is left out of the integrator's matrix.
//!
//! ```
//! use robohive_physics::pipeline::transition::transition;
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
mod inputs;
mod passive;

pub use bias::BiasScratch;
pub use fluid::FluidScratch;
pub use free_body::FreeBodySlope;
pub(crate) use inputs::inputs_of;
pub use inputs::{DerivativeInputs, is_free_body, row};

use crate::model::Model;

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
