//! `assets`: the user's store of model files that belong to others.

use crate::failure::{Failure, unwritable};
use crate::terminal::{note, show, show_json, show_verdict};
use clap::{Args, Subcommand, ValueHint};
use indicatif::{HumanBytes, ProgressBar, ProgressStyle};
use mjcf::Loader;
use serde_json::{Value, json};
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};
use std::time::Instant;
use store::{
    Damage, Entry, Fault, ImportOptions, Imported, Licence, Limits, Progress, Store, StoreError,
    default_folder,
};

/// Most names of one sort that the summary of an import lists.
const LISTED: usize = 10;

/// Keep the model files of RoboHive: import, list and verify them
#[derive(Args)]
#[command(
    after_help = "The ids of RoboHive stand on RoboHive's own model files. Import them once, from a RoboHive checkout \
or wheel or an archive of them; then nothing asks for the network. Environments look into the store first, then into the \
folders of the environment variable ROBOHIVE_ASSETS (separated as in PATH), each with envs/ and simhive/ or robohive/envs \
and robohive/simhive.

Examples:
  robohive assets import simhive
  robohive assets list --licences
  robohive assets verify"
)]
pub struct Assets {
    #[command(subcommand)]
    action: Action,
}

#[derive(Subcommand)]
enum Action {
    /// Take models from a folder or an archive into the store
    Import(Import),
    /// List what the store holds
    List(List),
    /// Read everything again and name what is damaged
    Verify(Verify),
    /// Write our own models, with the meshes that they name, into a folder
    Own(Own),
}

/// Write our own models, with the meshes that they name, into a folder
#[derive(Args)]
#[command(
    after_help = "The models of hive/ are part of this program, and their meshes are made when they are needed: `robohive sim hive/panda/scene.xml`. \
As files they open in MuJoCo and in modelling programs, and can be changed. Files of the same names in FOLDER are replaced.

Examples:
  robohive assets own models
  robohive render hive/panda/scene.xml --out panda.png"
)]
struct Own {
    /// Where to write them
    #[arg(value_name = "FOLDER", value_hint = ValueHint::DirPath)]
    folder: PathBuf,
}

/// Where the store is.
#[derive(Args)]
struct Place {
    /// Folder of the store [default: the environment variable ROBOHIVE_STORE, else robohive in the user's data folder]
    #[arg(long, value_name = "FOLDER", value_hint = ValueHint::DirPath)]
    store: Option<PathBuf>,
}

/// Take models from a folder or an archive into the store
#[derive(Args)]
#[command(
    after_help = "PATH is a folder or a .tar, .tar.xz, .tar.gz, .zip or .whl: a RoboHive checkout or its wheel, a simhive \
folder or one of the folders in it, a MyoSuite wheel (of which only simhive counts), or an archive of any of them. Models, \
meshes, textures, motions, robot configs and licence texts are taken; code is not, and what is skipped is counted. A file is \
under the licence of the nearest LICENSE or COPYING upwards in the source.

Several imports merge. One that contradicts a stored file is refused, unless --replace is given. An import that is killed \
leaves nothing half-written.

Limits keep a hostile source from filling the disk: bytes=4294967296 unpacked in all, files=200000, ratio=250 unpacked bytes \
a byte of the archive, path=512 bytes, depth=32 folders. Unpacking takes at most 128 MiB of memory. Links and devices in \
archives are refused; links in a folder are followed only inside of it.

Examples:
  robohive assets import simhive
  robohive assets import simhive --replace --limit files=1000000"
)]
struct Import {
    /// Folder or archive
    #[arg(value_name = "PATH", value_hint = ValueHint::AnyPath)]
    path: PathBuf,
    /// Replace stored files that differ
    #[arg(long)]
    replace: bool,
    /// Raise or lower a limit: bytes, files, ratio, path or depth
    #[arg(long = "limit", value_name = "NAME=NUMBER")]
    limits: Vec<String>,
    #[command(flatten)]
    place: Place,
    /// No progress on standard error
    #[arg(long, short)]
    quiet: bool,
}

/// List what the store holds
#[derive(Args)]
#[command(after_help = "Examples:
  robohive assets list               a line a folder
  robohive assets list --licences    a line a file, with its licence
  robohive assets list --json | jq .files[0]")]
struct List {
    /// Every file with its licence
    #[arg(long, visible_alias = "licenses")]
    licences: bool,
    /// Print one JSON object
    #[arg(long, conflicts_with = "licences")]
    json: bool,
    #[command(flatten)]
    place: Place,
}

/// Read everything again and name what is damaged
#[derive(Args)]
#[command(after_help = "The exit code is 1 when a file is damaged, missing or foreign. Of sound models it \
says, on standard error, what is ignored or assumed in them; other commands do not repeat it.

Examples:
  robohive assets verify")]
struct Verify {
    #[command(flatten)]
    place: Place,
    /// No progress on standard error
    #[arg(long, short)]
    quiet: bool,
}

/// Runs the command.
pub fn run(a: &Assets) -> Result<(), Failure> {
    match &a.action {
        Action::Import(a) => import(a),
        Action::List(a) => list(a),
        Action::Verify(a) => verify(a),
        Action::Own(a) => own(a),
    }
}

fn own(a: &Own) -> Result<(), Failure> {
    let count = ::assets::write(&a.folder).map_err(unwritable(&a.folder))?;
    show!("{count} files in {}", a.folder.display());
    Ok(())
}

fn open(place: &Place) -> Result<Store, Failure> {
    let folder = place.store.clone().map_or_else(default_folder, Ok).map_err(failure)?;
    Store::open(folder).map_err(failure)
}

/// Exit code 1 where the machine is at fault, 2 where the input is.
fn failure(error: StoreError) -> Failure {
    match error {
        StoreError::Io { .. }
        | StoreError::Busy { .. }
        | StoreError::Gone { .. }
        | StoreError::Manifest { .. } => Failure::new(error),
        error => Failure::usage(error),
    }
}

fn limits(texts: &[String]) -> Result<Limits, Failure> {
    let mut limits = Limits::default();
    for text in texts {
        let pair = text.split_once('=').and_then(|(name, value)| Some((name, value.parse().ok()?)));
        if !pair.is_some_and(|(name, value)| limits.set(name, value)) {
            let message = "is not NAME=NUMBER with bytes, files, ratio, path or depth as NAME";
            return Err(Failure::usage(format!("--limit {text:?} {message}")));
        }
    }
    Ok(limits)
}

fn progress(quiet: bool) -> ProgressBar {
    let style = ProgressStyle::with_template("{wide_bar} {bytes}/{total_bytes}, {eta} left")
        .unwrap_or_else(|_| ProgressStyle::default_bar());
    if quiet { ProgressBar::hidden() } else { ProgressBar::new(0).with_style(style) }
}

fn watch(bar: &ProgressBar) -> impl FnMut(Progress) {
    |Progress { done, total }| {
        bar.set_length(total);
        bar.set_position(done);
    }
}

fn import(a: &Import) -> Result<(), Failure> {
    let options = ImportOptions::default().with_limits(limits(&a.limits)?).with_replace(a.replace);
    let mut store = open(&a.place)?;
    let began = Instant::now();
    let bar = progress(a.quiet);
    let imported = store.import(&a.path, &options, &mut watch(&bar));
    bar.finish_and_clear();
    show_import(&store, &imported.map_err(failure)?, began.elapsed().as_secs_f64());
    Ok(())
}

fn show_import(store: &Store, imported: &Imported, seconds: f64) {
    let Imported { added, unchanged, replaced, bytes, skipped } = imported;
    let files = added + unchanged + replaced.len();
    show!("imported     {files} files, {} in {seconds:.1} s", HumanBytes(*bytes));
    show!("             {added} new, {unchanged} already there, {} replaced", replaced.len());
    replaced.iter().take(LISTED).for_each(|path| show!("replaced     {path}"));
    if replaced.len() > LISTED {
        show!("             and {} more", replaced.len() - LISTED);
    }
    let kinds: Vec<_> = skipped.kinds.iter().map(|(kind, n)| format!("{n} {kind}")).collect();
    if !kinds.is_empty() {
        show!("skipped      {}", kinds.join(", "));
    }
    show!("store        {}, {} files", store.folder().display(), store.entries().len());
    for link in skipped.links.iter().take(LISTED) {
        note(&format!(
            "robohive: skipped {link}, a link out of the folder or to nothing; import what it leads to"
        ));
    }
    if skipped.links.len() > LISTED {
        note(&format!("robohive: skipped {} more such links", skipped.links.len() - LISTED));
    }
}

fn list(a: &List) -> Result<(), Failure> {
    let store = open(&a.place)?;
    if a.json {
        show_json(&as_json(&store));
    } else if a.licences {
        for (path, Entry { size, licence, .. }) in store.entries() {
            show!("{licence:<12} {size:>10} {path}");
        }
    } else {
        for (folder, Group { files, bytes, licences }) in groups(&store) {
            let licences: Vec<_> = licences.iter().map(Licence::to_string).collect();
            let size = HumanBytes(bytes).to_string();
            show!("{folder:<24} {files:>5} files {size:>12}  {}", licences.join(", "));
        }
        let bytes = store.entries().map(|(_, entry)| entry.size).sum();
        show!("{}: {} files, {}", store.folder().display(), store.entries().len(), HumanBytes(bytes));
    }
    if store.entries().len() == 0 {
        note("robohive: the store is empty; `robohive assets import PATH` fills it");
    }
    Ok(())
}

/// Files of one folder.
#[derive(Default)]
struct Group {
    files: usize,
    bytes: u64,
    licences: BTreeSet<Licence>,
}

/// The files by the first two folders of their paths.
fn groups(store: &Store) -> BTreeMap<String, Group> {
    let mut groups: BTreeMap<String, Group> = BTreeMap::new();
    for (path, entry) in store.entries() {
        let (folder, _) = path.rsplit_once('/').unwrap_or(("", path));
        let name = folder.splitn(3, '/').take(2).collect::<Vec<_>>().join("/");
        let group = groups.entry(name).or_default();
        group.files += 1;
        group.bytes += entry.size;
        group.licences.insert(entry.licence);
    }
    groups
}

fn as_json(store: &Store) -> Value {
    let file = |(path, entry): (&str, &Entry)| {
        json!({
            "path": path,
            "size": entry.size,
            "sha256": entry.digest.to_string(),
            "licence": entry.licence.id(),
            "source": entry.source,
        })
    };
    json!({
        "store": store.folder().to_string_lossy(),
        "bytes": store.entries().map(|(_, entry)| entry.size).sum::<u64>(),
        "files": store.entries().map(file).collect::<Vec<_>>(),
    })
}

fn verify(a: &Verify) -> Result<(), Failure> {
    let store = open(&a.place)?;
    let bar = progress(a.quiet);
    let damages = store.verify(&mut watch(&bar));
    bar.finish_and_clear();
    let damages = damages.map_err(failure)?;
    damages.iter().for_each(|Damage { path, fault, .. }| show!("{fault:<16} {path}"));
    show_remedies(&store, &damages);
    if damages.is_empty() {
        show_warnings(&store);
    }
    let (files, folder) = (store.entries().len(), store.folder().display());
    show_verdict(
        damages.is_empty(),
        &format!("{folder}: {files} files, "),
        if damages.is_empty() { "all sound" } else { "damaged" },
        &if damages.is_empty() { String::new() } else { format!(" in {} places", damages.len()) },
    );
    if damages.is_empty() { Ok(()) } else { Err(Failure::silent(1)) }
}

/// Says what is ignored or assumed in imported models, each finding once: environments of them do not repeat it.
fn show_warnings(store: &Store) {
    let tree = store.tree();
    let mut said = BTreeSet::new();
    for (path, _) in store.entries().filter(|(path, _)| path.ends_with(".xml")) {
        // Parts of models, and templates, are no models by themselves; they are read where they are included.
        let Ok(parsed) = Loader::default().parse(tree.join(path)) else { continue };
        for warning in parsed.warnings.warnings() {
            let place = warning.position.as_ref().map_or(String::new(), |position| format!("{position}: "));
            said.insert(format!("{place}warning: {}", warning.message));
        }
    }
    said.iter().for_each(|warning| note(warning));
}

/// Says which commands repair the damage.
fn show_remedies(store: &Store, damages: &[Damage]) {
    let foreign = |damage: &&Damage| damage.fault == Fault::Foreign;
    let sources: BTreeSet<_> = damages.iter().filter(|d| !foreign(d)).map(|d| d.source.as_str()).collect();
    for source in sources {
        show!("repair with: robohive assets import {source:?} --store {:?}", store.folder());
    }
    if damages.iter().any(|damage| foreign(&damage)) {
        show!("delete what is not imported from {}", Path::join(store.folder(), "tree").display());
    }
}
