//! `convert`: a model as one MJCF file.

use crate::failure::{Failure, unwritable};
use crate::input::loading::{STANDARD_INPUT, loader};
use crate::input::source::ModelSource;
use crate::output::{check_place, keep_existing, keep_input, model_file};
use crate::terminal::{note, show};
use clap::{Args, ValueHint};
use mjcf::Loader;
use mjcf::files::{Disk, FileProvider};
use physics::Model;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use validation::round_trip::differing;

/// Folder beside the file that assets are copied to.
const FOLDER: &str = "assets";

/// Write a model as one MJCF file that compiles to the same arrays
#[derive(Args)]
#[command(
    after_help = "Includes are in place, templates filled in, attached and replicated parts spelled out, angles in \
radians, and every number is the shortest that reads alike. What is written is read again and compared, so that a file \
is left only when all its arrays are those of MODEL, to the last bit; paths of assets may differ. The folder of FILE.xml \
must exist.

Examples:
  robohive convert assets/franka/franka_table.xml --out franka.xml --force
  robohive convert assets/franka/franka_table.xml --out with_assets.xml --copy-assets
  robohive convert robot.urdf --out robot.xml"
)]
pub struct Convert {
    /// The model
    #[command(flatten)]
    pub model: ModelSource,
    /// File to write
    #[arg(long, value_name = "FILE.xml", value_hint = ValueHint::FilePath, value_parser = model_file)]
    pub out: PathBuf,
    /// Replace FILE if it exists; never one that the model is read from
    #[arg(long)]
    pub force: bool,
    /// Keep default classes, shortcuts, units and attached models as their author wrote them
    #[arg(long)]
    pub keep_defaults: bool,
    /// Copy meshes, textures and height fields to the folder `assets` beside the file
    #[arg(long)]
    pub copy_assets: bool,
}

/// Runs the command.
pub fn run(a: &Convert) -> Result<(), Failure> {
    check_place(&a.out)?;
    keep_input(&a.model.path, &a.out)?;
    keep_existing(&a.out, a.force)?;
    let out = std::path::absolute(&a.out).map_err(unwritable(&a.out))?;
    let dir = utf8(out.parent().unwrap_or(Path::new("/")))?;
    let source = match a.model.path == Path::new(STANDARD_INPUT) {
        true => a.model.path.clone(),
        // Assets are named from another folder, so all paths start at the root.
        false => std::path::absolute(&a.model.path).map_err(Failure::usage)?,
    };
    let (loader, path) = loader(&source, &a.model.reading)?;
    let parsed = loader.parse(path).map_err(Failure::usage)?;
    parsed.sources.paths().try_for_each(|read| keep_input(Path::new(read), &out))?;
    let mut spec = parsed.spec.clone();
    let loaded = loader.compile(parsed).map_err(Failure::usage)?;
    loaded.warnings.warnings().for_each(|warning| note(&warning.to_string()));
    let mut copies = Copies::default();
    let text = if a.keep_defaults {
        let placed = |file: &str| mjcf::files::relative(&dir, file).unwrap_or_else(|| file.to_owned());
        match a.copy_assets {
            true => loader.flatten(path, |file| copies.name(file)),
            false => loader.flatten(path, placed),
        }
    } else {
        spec.settle_keys(&loaded.model);
        match a.copy_assets {
            true => spec.name_assets(|file| copies.name(file)),
            false => spec.place_assets(&dir).map_err(Failure::new)?,
        }
        spec.to_xml()
    };
    let text = text.map_err(Failure::new)?;
    copies.write(Path::new(&dir))?;
    write_checked(&out, &text, &loaded.model)?;
    show!("{}: {} bytes, {} files of assets copied", a.out.display(), text.len(), copies.names.len());
    Ok(())
}

fn utf8(path: &Path) -> Result<String, Failure> {
    let text = path.to_str().ok_or_else(|| {
        Failure::usage(format!("the path '{}' is not UTF-8, as paths of models must be", path.display()))
    })?;
    Ok(text.to_owned())
}

/// Writes the text beside `out`, reads it there, and gives it its name when the model is the same.
fn write_checked(out: &Path, text: &str, model: &Model) -> Result<(), Failure> {
    let mut part = out.as_os_str().to_owned();
    part.push(".part");
    let part = PathBuf::from(part);
    std::fs::write(&part, text).map_err(unwritable(&part))?;
    let checked = Loader::default().load(&part).map_err(|e| e.to_string()).and_then(|again| {
        let names: Vec<_> =
            differing(model, &again.model).into_iter().filter(|name| !name.contains("path")).collect();
        if names.is_empty() { Ok(()) } else { Err(format!("the arrays {} would differ", names.join(", "))) }
    });
    if let Err(message) = checked {
        let _ = std::fs::remove_file(&part);
        return Err(Failure::new(format!("{} is not written: {message}", out.display())));
    }
    std::fs::rename(&part, out).map_err(unwritable(out))
}

/// Files to copy, by the path they are read from, with their names in the folder.
#[derive(Default)]
struct Copies {
    names: BTreeMap<String, String>,
}

impl Copies {
    /// How the text names the copy of `file`: two files of one name get different ones.
    fn name(&mut self, file: &str) -> String {
        if let Some(name) = self.names.get(file) {
            return format!("{FOLDER}/{name}");
        }
        let base = file.rsplit('/').next().unwrap_or(file);
        let (stem, extension) = base.rsplit_once('.').unwrap_or((base, ""));
        let taken = |name: &str| self.names.values().any(|known| known.eq_ignore_ascii_case(name));
        let mut name = base.to_owned();
        let mut count = 2;
        while taken(&name) {
            name = format!("{stem}_{count}.{extension}");
            count += 1;
        }
        self.names.insert(file.to_owned(), name.clone());
        format!("{FOLDER}/{name}")
    }

    /// Copies the files; one that is there with another content is an error.
    fn write(&self, dir: &Path) -> Result<(), Failure> {
        if self.names.is_empty() {
            return Ok(());
        }
        let folder = dir.join(FOLDER);
        std::fs::create_dir_all(&folder).map_err(unwritable(&folder))?;
        for (file, name) in &self.names {
            let content =
                Disk::everywhere().read(file).map_err(|e| Failure::usage(format!("{file}: {e}")))?;
            let place = folder.join(name);
            match std::fs::read(&place) {
                Ok(there) if *there == *content => {}
                Ok(_) => {
                    return Err(Failure::usage(format!(
                        "{} is another file than {file}: choose another folder for --out",
                        place.display()
                    )));
                }
                Err(_) => std::fs::write(&place, content).map_err(unwritable(&place))?,
            }
        }
        Ok(())
    }
}
