//! Energies and momenta, which the step computes only when a sensor or a flag asks for them.

#[doc(hidden)]
pub mod energy;
#[doc(hidden)]
pub mod momentum;
