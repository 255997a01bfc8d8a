//! Keyframes of attached models, whose numbers stand at the elements, as keyframes of the whole model.

use physics::Model;
use physics::model::ObjType;

use crate::spec::{Body, Key, Spec};

impl Spec {
    /// Turns keyframes of attached models into keyframes of this one, with the numbers that `model`, compiled of this
    /// spec, has for them. Without such keyframes nothing changes.
    pub fn settle_keys(&mut self, model: &Model) {
        if self.kept_keys.is_empty() {
            return;
        }
        let row = |values: &[f64], k: usize, width: usize| values[k * width..(k + 1) * width].to_vec();
        for k in self.keys.len()..model.nkey {
            self.keys.push(Key {
                name: model.name_of(ObjType::Key, k).to_owned(),
                time: model.key_time[k],
                qpos: row(&model.key_qpos, k, model.nq),
                qvel: row(&model.key_qvel, k, model.nv),
                act: row(&model.key_act, k, model.na),
                mpos: row(&model.key_mpos, k, 3 * model.nmocap),
                mquat: row(&model.key_mquat, k, 4 * model.nmocap),
                ctrl: row(&model.key_ctrl, k, model.nu),
                ..Key::default()
            });
        }
        self.kept_keys.clear();
        forget(&mut self.world);
        self.actuators.iter_mut().for_each(|actuator| actuator.keyed.clear());
    }
}

fn forget(body: &mut Body) {
    body.keyed.clear();
    body.joints.iter_mut().for_each(|joint| joint.keyed.clear());
    body.bodies.iter_mut().for_each(forget);
}
