//! What a tree of elements keeps of the text that they were read from.

use mjcf::spec::{Compiler, Spec};
use std::collections::{BTreeMap, HashMap};

/// Where the elements of a tree come from.
#[derive(Default)]
pub struct Origin {
    /// Settings of attached models by the index of their first text.
    pub attached: BTreeMap<u32, Compiler>,
    /// Folder of the text, with its closing slash.
    pub folder: String,
    /// What is opened for the file of an asset: by directory, whether paths are stripped, and name.
    pub opened: HashMap<(String, bool, String), String>,
}

impl Origin {
    /// Of a text in `folder` that was read as `spec`.
    pub fn of(spec: &Spec, folder: &str) -> Self {
        let mut opened = HashMap::new();
        let compiler = &spec.compiler;
        let mut see = |dir: &str, path: &str, file: &str| {
            opened.insert((dir.to_owned(), compiler.strippath, path.to_owned()), file.to_owned());
        };
        spec.meshes.iter().for_each(|x| see(&compiler.meshdir, &x.path, &x.file));
        spec.skins.iter().for_each(|x| see(&compiler.meshdir, &x.path, &x.file));
        spec.hfields.iter().for_each(|x| see(&compiler.meshdir, &x.path, &x.file));
        for texture in &spec.textures {
            see(&compiler.texturedir, &texture.path, &texture.file);
            for (path, file) in texture.cubepaths.iter().zip(&texture.cubefiles) {
                see(&compiler.texturedir, path, file);
            }
        }
        Origin { attached: spec.attached.clone(), folder: folder.to_owned(), opened }
    }
}
