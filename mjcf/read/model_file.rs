//! `asset/model`: another model, read by itself, that `attach` copies parts of.

use super::reader::{ModelFile, Reader, check_root};
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
        if let Err((loc, message)) = reader.spec.distribute_keys() {
            reader.error(loc, message);
        }
        let Reader { mut spec, authored, .. } = reader;
        if let Some(name) = element.value("name") {
            spec.modelname = name.to_string();
        }
        let name = spec.modelname.clone();
        self.models.push(ModelFile { name, first_file: root.loc.file, spec, authored });
    }
}
