//! How the text names the files of assets.

use crate::diagnostic::Diagnostics;
use crate::files::{base_name, join, relative};
use crate::spec::{Compiler, Spec, asset_name};

/// One file of an asset: what is opened, how the text names it.
struct Named<'a> {
    file: &'a str,
    path: &'a mut String,
    texture: bool,
}

impl Spec {
    /// Names the files of assets as a text in folder `dir` finds them. Names that lead to the right file stay as they
    /// are, with `meshdir`, `texturedir` and `strippath`; when one does not, all are named from `dir`.
    ///
    /// # Errors
    /// A file that has no name seen from `dir`: one of them starts at a root, the other where the program runs.
    pub fn place_assets(&mut self, dir: &str) -> Result<(), Diagnostics> {
        let compiler = self.compiler.clone();
        let mut stays = true;
        self.each_file(&mut |named| stays &= found_from(dir, &named, &compiler));
        if stays {
            return Ok(());
        }
        let mut lost = None;
        self.name_assets(|file| {
            relative(dir, file).unwrap_or_else(|| {
                lost.get_or_insert_with(|| file.to_owned());
                file.to_owned()
            })
        });
        match lost {
            None => Ok(()),
            Some(file) => Err(Diagnostics::of_error(format!(
                "'{file}' has no name seen from '{dir}': load the model by its full path"
            ))),
        }
    }

    /// Names every file of an asset by what `name` makes of its path, without `meshdir`, `texturedir` and `strippath`.
    /// Assets that are called by their file keep what they are called.
    pub fn name_assets(&mut self, mut name: impl FnMut(&str) -> String) {
        macro_rules! keep_names {
            ($($list:ident)*) => {
                $(for asset in self.$list.iter_mut().filter(|a| !a.path.is_empty()) {
                    let called = asset_name(&asset.name, &asset.path);
                    if asset.name.is_empty() && asset_name("", &name(&asset.file)) != called {
                        asset.name = called;
                    }
                })*
            };
        }
        keep_names!(meshes skins hfields textures);
        self.each_file(&mut |named| *named.path = name(named.file));
        self.compiler.meshdir.clear();
        self.compiler.texturedir.clear();
        self.compiler.strippath = false;
    }

    /// The files that the assets are read from, as a file provider opens them; each once, in the order of the text.
    pub fn asset_files(&self) -> Vec<String> {
        let mut files: Vec<String> = Vec::new();
        // Naming lends the elements for writing; a copy takes that.
        self.clone().each_file(&mut |named| {
            if !files.iter().any(|known| known == named.file) {
                files.push(named.file.to_owned());
            }
        });
        files
    }

    fn each_file(&mut self, visit: &mut dyn FnMut(Named<'_>)) {
        let mut see = |file: &str, path: &mut String, texture| {
            if !file.is_empty() {
                visit(Named { file, path, texture });
            }
        };
        for texture in &mut self.textures {
            see(&texture.file, &mut texture.path, true);
            for (file, path) in texture.cubefiles.iter().zip(&mut texture.cubepaths) {
                see(file, path, true);
            }
        }
        self.meshes.iter_mut().for_each(|mesh| see(&mesh.file, &mut mesh.path, false));
        self.skins.iter_mut().for_each(|skin| see(&skin.file, &mut skin.path, false));
        self.hfields.iter_mut().for_each(|hfield| see(&hfield.file, &mut hfield.path, false));
    }
}

/// Whether a text in `dir` that names the asset as it does now means the same file.
fn found_from(dir: &str, named: &Named<'_>, compiler: &Compiler) -> bool {
    let assets = if named.texture { &compiler.texturedir } else { &compiler.meshdir };
    let path: &str = if compiler.strippath { base_name(named.path) } else { named.path };
    join(dir, &join(assets, path)) == join("", named.file)
}
