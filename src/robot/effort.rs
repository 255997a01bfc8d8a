//! Torques and forces that actuators put on their joints, and the controls that ask for them.

use crate::interval::clip;
use physics::model::{BiasType, DynType, GainType};
use physics::{Data, Model};

/// An actuator whose joint torque is τ = gear (gain u + b₀ + b₁ length + b₂ velocity): motors and servos without
/// activation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Effort {
    /// Its place among the model's force outputs.
    output: usize,
    gear: f64,
    gain: f64,
    bias: [f64; 3],
}

impl Effort {
    /// The law of actuator `id`, or why its torque does not follow from its control.
    pub(crate) fn new(model: &Model, id: usize) -> Result<Effort, String> {
        if DynType::from_code(model.actuator_dyntype[id]) != Some(DynType::None) {
            return Err("has activation dynamics".to_owned());
        }
        let gain = match GainType::from_code(model.actuator_gaintype[id]) {
            Some(GainType::Fixed) => model.actuator_gainprm[id][0],
            _ => return Err("has a gain that is not constant".to_owned()),
        };
        let [b0, b1, b2, ..] = model.actuator_biasprm[id];
        let bias = match BiasType::from_code(model.actuator_biastype[id]) {
            Some(BiasType::None) => [0.0; 3],
            Some(BiasType::Affine) => [b0, b1, b2],
            _ => return Err("has a bias that is not affine".to_owned()),
        };
        let output = model.actuator_outadr[id].max(0) as usize;
        let gear = model.actuator_gear[output][0];
        if gain == 0.0 || gear == 0.0 {
            return Err("has a gain or gear of 0".to_owned());
        }
        Ok(Effort { output, gear, gain, bias })
    }

    /// Limits of the torque that the model sets: by the force's range, of motors by the control's.
    pub(crate) fn range(&self, model: &Model, id: usize, control: usize) -> Option<[f64; 2]> {
        let (range, factor) = if model.actuator_forcelimited[id] {
            (model.actuator_forcerange[id], self.gear)
        } else if model.actuator_ctrllimited[control] && self.bias == [0.0; 3] {
            (model.actuator_ctrlrange[control], self.gain * self.gear)
        } else {
            return None;
        };
        let ends = range.map(|end| end * factor);
        Some([ends[0].min(ends[1]), ends[0].max(ends[1])])
    }

    /// Force in the actuator's own units that it makes at control 0.
    fn passive(&self, data: &Data) -> f64 {
        let [b0, b1, b2] = self.bias;
        b0 + b1 * data.trn.actuator_length[self.output] + b2 * data.vel.actuator_velocity[self.output]
    }

    /// The control that makes this torque now \[N m, N\].
    pub(crate) fn control(&self, data: &Data, torque: f64) -> f64 {
        (torque / self.gear - self.passive(data)) / self.gain
    }

    /// The control nearest to `control` whose torque lies in `range`.
    pub(crate) fn limit(&self, data: &Data, control: f64, range: [f64; 2]) -> f64 {
        let torque = self.gear * (self.gain * control + self.passive(data));
        let limited = clip(torque, range);
        if limited == torque { control } else { self.control(data, limited) }
    }
}
