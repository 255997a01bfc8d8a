//! Postures to begin searches for joints with.

use physics::Model;
use physics::elements::JointId;

/// Share of the middle of a joint's range that postures are spread over.
const MIDDLE: f64 = 0.5;
/// The number whose powers give the steps of the sequence in every coordinate: its least discrepancy in two dimensions.
const STEP: f64 = 1.324_717_957_244_746;

/// The posture number `index` of a sequence that is spread evenly over the middle of the ranges of joints \[rad, m\] (Roberts, The unreasonable
/// effectiveness of quasirandom sequences, 2018).
pub fn posture(m: &Model, joints: &[JointId], index: usize) -> Vec<f64> {
    let mut step = 1.0;
    let place = |joint: &JointId| {
        let [low, high] = m.jnt_range[joint.index()];
        // A product of its own has the same bits everywhere.
        step /= STEP;
        let share = (0.5 + index as f64 * step).fract();
        low + (0.5 + MIDDLE * (share - 0.5)) * (high - low)
    };
    joints.iter().map(place).collect()
}
