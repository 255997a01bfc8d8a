//! The peak force of a muscle.

use physics::Model;

/// Where a muscle's parameters hold its peak force \[N\]; negative where it follows from the model.
pub const PEAK_FORCE: usize = 2;
/// Where they hold the scale from which such a peak force follows.
pub const FORCE_SCALE: usize = 3;

/// The force \[N\] that a muscle can exert at most.
pub fn peak_force(model: &Model, actuator: usize) -> f64 {
    let parameters = &model.actuator_gainprm[actuator];
    match parameters[PEAK_FORCE] {
        stated if stated >= 0.0 => stated,
        _ => parameters[FORCE_SCALE] / model.actuator_acc0[model.actuator_outadr[actuator] as usize],
    }
}
