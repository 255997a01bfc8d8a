//! Keyframes by element: what a part of a model takes along.

use super::{KeptKey, KeyPart, Keyed, Spec, joint_dimensions};
use crate::diagnostic::Loc;

impl Spec {
    /// Gives the numbers of all keyframes to the elements they belong to, so that a part of the model can take
    /// its share along.
    ///
    /// # Errors
    /// A keyframe has more numbers than the elements take.
    pub(crate) fn distribute_keys(&mut self) -> Result<(), (Loc, String)> {
        let mut result = Ok(());
        for key in std::mem::take(&mut self.keys) {
            let index = self.kept_keys.len();
            let mut values: [std::slice::Iter<f64>; 6] =
                [&key.qpos, &key.qvel, &key.mpos, &key.mquat, &key.act, &key.ctrl].map(|v| v.iter());
            let mut share = |part: KeyPart, length: usize, keyed: &mut Vec<Keyed>| {
                let values: Vec<f64> = values[part as usize].by_ref().take(length).copied().collect();
                if values.len() == length && length > 0 {
                    keyed.push(Keyed { key: index, part, values });
                }
            };
            let mut pending = vec![&mut self.world];
            while let Some(body) = pending.pop() {
                for joint in &mut body.joints {
                    let (nq, nv) = joint_dimensions(joint.kind);
                    share(KeyPart::Qpos, nq, &mut joint.keyed);
                    share(KeyPart::Qvel, nv, &mut joint.keyed);
                }
                if body.mocap {
                    share(KeyPart::Mpos, 3, &mut body.keyed);
                    share(KeyPart::Mquat, 4, &mut body.keyed);
                }
                pending.extend(body.bodies.iter_mut().rev());
            }
            for actuator in &mut self.actuators {
                let (states, inputs) = actuator.sizes();
                share(KeyPart::Act, states, &mut actuator.keyed);
                share(KeyPart::Ctrl, inputs, &mut actuator.keyed);
            }
            if let Some(part) = values.iter().position(|rest| rest.len() > 0) {
                let name = ["qpos", "qvel", "mpos", "mquat", "act", "ctrl"][part];
                result = Err((key.loc, format!("keyframe '{}' has too many values in '{name}'", key.name)));
            }
            self.kept_keys.push(KeptKey { name: key.name, loc: key.loc, time: key.time, own: true });
        }
        result
    }
}
