//! Models written as MJCF and read again: every array to the last bit, and the text of the second round beside that of
//! the first.

use std::fmt::Write;
use std::path::{Path, PathBuf};

use mjcf::Loader;
use mjcf::files::{Disk, Overlay};
use physics::Model;
use physics::table::Slice;

/// What became of the models of one folder.
#[derive(Debug, Default)]
pub struct Outcome {
    /// The folder.
    pub name: String,
    /// Files that are whole models and load.
    pub loaded: usize,
    /// Files that are none, or do not load: parts that others include, faulty inputs of tests.
    pub skipped: usize,
    /// Models whose arrays come back to the last bit, paths of assets included.
    pub equal: usize,
    /// Models in which only the recorded paths of assets differ: files that an attached model names from elsewhere.
    pub paths: usize,
    /// Models whose text stays in the second round.
    pub stable: usize,
    /// The models that fall short, and why.
    pub faults: Vec<(String, String)>,
}

/// Writes and reads every model in `folders`, which may also be single files.
///
/// # Errors
/// A folder cannot be read.
pub fn measure(folders: &[PathBuf], only: &str) -> Result<Vec<Outcome>, String> {
    let mut outcomes = Vec::new();
    for folder in folders {
        let mut outcome = Outcome { name: label(folder), ..Outcome::default() };
        let top = folder.canonicalize().map_err(|e| format!("{}: {e}", folder.display()))?;
        for path in models(&top)? {
            let name = path.strip_prefix(&top).unwrap_or(&path).display().to_string();
            if name.contains(only) {
                outcome.take(&name, &path);
            }
        }
        println!("{}", outcome.line());
        outcomes.push(outcome);
    }
    Ok(outcomes)
}

fn label(folder: &Path) -> String {
    folder.file_name().unwrap_or(folder.as_os_str()).to_string_lossy().into_owned()
}

/// XML files in a folder and below, by name.
fn models(folder: &Path) -> Result<Vec<PathBuf>, String> {
    let (mut found, mut pending) = (Vec::new(), vec![folder.to_path_buf()]);
    while let Some(path) = pending.pop() {
        if !path.is_dir() {
            found.extend(Some(path).filter(|p| p.extension().is_some_and(|e| e == "xml" || e == "urdf")));
            continue;
        }
        let entries = std::fs::read_dir(&path).map_err(|e| format!("{}: {e}", path.display()))?;
        pending.extend(entries.filter_map(|entry| entry.ok().map(|entry| entry.path())));
    }
    found.sort();
    Ok(found)
}

impl Outcome {
    fn take(&mut self, name: &str, path: &Path) {
        let Some(path) = path.to_str() else { return };
        let loader = Loader::default();
        let Ok(parsed) = loader.parse(path) else {
            self.skipped += 1;
            return;
        };
        let spec = parsed.spec.clone();
        let Ok(loaded) = loader.compile(parsed) else {
            self.skipped += 1;
            return;
        };
        self.loaded += 1;
        match go_round(path, spec, &loaded.model) {
            Err(message) => self.faults.push((name.to_owned(), message)),
            Ok(Round { differing, stable }) => {
                self.stable += usize::from(stable);
                let only_paths = differing.iter().all(|name| name.contains("path"));
                self.equal += usize::from(differing.is_empty());
                self.paths += usize::from(!differing.is_empty() && only_paths);
                if !only_paths || !stable {
                    let text = if stable { "" } else { "; the text changes" };
                    self.faults.push((name.to_owned(), format!("differ: {}{text}", differing.join(", "))));
                }
            }
        }
    }

    fn line(&self) -> String {
        let Outcome { name, loaded, skipped, equal, paths, stable, .. } = self;
        format!("| {name} | {skipped} | {loaded} | {equal} | {paths} | {stable} |")
    }
}

/// What a round changes.
struct Round {
    differing: Vec<String>,
    stable: bool,
}

fn go_round(path: &str, mut spec: mjcf::spec::Spec, model: &Model) -> Result<Round, String> {
    let dir = path.rsplit_once('/').map_or("", |(dir, _)| dir);
    let text = written(&mut spec, dir, model)?;
    let place = format!("{dir}/written by the round trip.xml");
    let loader = Loader::default().files(Overlay::new(Disk::everywhere(), &place, text.as_bytes()));
    let parsed = loader.parse(&place).map_err(|e| e.to_string())?;
    let mut again = parsed.spec.clone();
    let second = loader.compile(parsed).map_err(|e| e.to_string())?.model;
    let stable = written(&mut again, dir, &second)? == text;
    Ok(Round { differing: differing(model, &second), stable })
}

fn written(spec: &mut mjcf::spec::Spec, dir: &str, model: &Model) -> Result<String, String> {
    spec.settle_keys(model);
    spec.place_assets(dir).map_err(|e| e.to_string())?;
    spec.to_xml().map_err(|e| e.to_string())
}

/// Names of the arrays, sizes and settings in which two models differ by a bit.
pub fn differing(a: &Model, b: &Model) -> Vec<String> {
    let (a_bits, b_bits) = (bits(a), bits(b));
    let arrays = a_bits.iter().zip(&b_bits).filter(|(a, b)| a != b).map(|(a, _)| a.0.clone());
    let mut names: Vec<String> = arrays.collect();
    let mut sizes = [Vec::new(), Vec::new()];
    a.visit_sizes(&mut |name, n| sizes[0].push((name, n)));
    b.visit_sizes(&mut |name, n| sizes[1].push((name, n)));
    let unequal = sizes[0].iter().zip(&sizes[1]).filter(|(a, b)| a != b);
    names.extend(unequal.map(|(a, _)| a.0.to_owned()));
    if a.vis != b.vis {
        names.push("vis".into());
    }
    names
}

fn bits(m: &Model) -> Vec<(String, Vec<u64>)> {
    let mut all = Vec::new();
    let of = |values: &Slice<'_>| -> Vec<u64> {
        match values {
            Slice::F64(x) => x.iter().map(|x| x.to_bits()).collect(),
            Slice::F32(x) => x.iter().map(|x| u64::from(x.to_bits())).collect(),
            Slice::I64(x) => x.iter().map(|&x| x as u64).collect(),
            other => other.to_f64().iter().map(|x| x.to_bits()).collect(),
        }
    };
    m.visit(&mut |name, _, values| all.push((name.to_owned(), of(&values))));
    m.opt.visit(&mut |name, values| all.push((format!("opt.{name}"), of(&values))));
    m.stat.visit(&mut |name, values| all.push((format!("stat.{name}"), of(&values))));
    all
}

/// The table, and a verdict: an error when a model falls short.
pub fn render(outcomes: &[Outcome]) -> (String, Result<(), String>) {
    let mut out = String::from(
        "| models | parts, or refused | loaded | all arrays equal | all but asset paths | text stays |\n|---|---|---|---|---|---|\n",
    );
    let mut faults = 0;
    for outcome in outcomes {
        // Writing to a String cannot fail.
        let _ = writeln!(out, "{}", outcome.line());
        faults += outcome.faults.len();
    }
    for outcome in outcomes {
        for (name, why) in &outcome.faults {
            let _ = writeln!(out, "\n- {}/{name}: {why}", outcome.name);
        }
    }
    let verdict = if faults == 0 { Ok(()) } else { Err(format!("{faults} models do not come back")) };
    (out, verdict)
}
