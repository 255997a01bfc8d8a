//! `asset/model`: another model, read by itself, that `attach` copies parts of.

use super::reader::{ModelFile, Reader, check_root};
use crate::spec::{KeptKey, KeyPart, Keyed, joint_dimensions};
use crate::xml::Element;

/// Models inside models.
const MAX_DEPTH: usize = 64;

impl Reader<'_> {
    pub(super) fn model_file(&mut self, element: &Element) {
        if let Some(kind) =
            element.attribute("content_type").filter(|a| !matches!(a.value.as_str(), "" | "text/xml"))
        {
            let message = format!("content type '{}' is not supported: only MJCF is read", kind.value);
            return self.error(kind.value_loc, message);
        }
        let Some(file) = element.attribute("file") else { return };
        let (path, _) = self.asset_file(file, "");
        if self.open_files.contains(&path) {
            return self.error(file.value_loc, format!("model '{path}' is an asset of itself"));
        }
        let (files, bytes) = (self.expansion.sources.iter().count(), self.expansion.sources.bytes());
        let limits = self.expansion.limits;
        if self.open_files.len() > MAX_DEPTH || files > limits.includes || bytes > limits.total_bytes {
            return self.error(file.value_loc, "model files exceed the limit on depth, number or size");
        }
        let text = match self.expansion.files.read(&path) {
            Ok(text) => text,
            Err(e) => return self.error(file.value_loc, format!("cannot read model '{path}': {e}")),
        };
        let Some(root) = self.expansion.expand(&path, &text) else { return };
        let mut expansion = self.expansion.lend();
        if check_root(&root, &mut expansion).is_none() {
            return;
        }
        let open_files = self.open_files.iter().cloned().chain([path]).collect();
        let mut reader = Reader::new(&root, expansion, open_files);
        reader.model(&root);
        reader.distribute_keys();
        let Reader { mut spec, classes, authored, .. } = reader;
        if let Some(name) = element.value("name") {
            spec.modelname = name.to_string();
        }
        let name = spec.modelname.clone();
        self.models.push(ModelFile { name, first_file: root.loc.file, spec, classes, authored });
    }

    /// Gives the numbers of all keyframes to the elements they belong to, so that a part of the model can take
    /// its share along.
    fn distribute_keys(&mut self) {
        for key in std::mem::take(&mut self.spec.keys) {
            let index = self.spec.kept_keys.len();
            let mut values: [std::slice::Iter<f64>; 6] =
                [&key.qpos, &key.qvel, &key.mpos, &key.mquat, &key.act, &key.ctrl].map(|v| v.iter());
            let mut share = |part: KeyPart, length: usize, keyed: &mut Vec<Keyed>| {
                let values: Vec<f64> = values[part as usize].by_ref().take(length).copied().collect();
                if values.len() == length && length > 0 {
                    keyed.push(Keyed { key: index, part, values });
                }
            };
            let mut pending = vec![&mut self.spec.world];
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
            for actuator in &mut self.spec.actuators {
                let (states, inputs) = actuator.sizes();
                share(KeyPart::Act, states, &mut actuator.keyed);
                share(KeyPart::Ctrl, inputs, &mut actuator.keyed);
            }
            if let Some(part) = values.iter().position(|rest| rest.len() > 0) {
                let name = ["qpos", "qvel", "mpos", "mquat", "act", "ctrl"][part];
                self.error(key.loc, format!("keyframe '{}' has too many values in '{name}'", key.name));
            }
            self.spec.kept_keys.push(KeptKey { name: key.name, loc: key.loc, time: key.time, own: true });
        }
    }
}
