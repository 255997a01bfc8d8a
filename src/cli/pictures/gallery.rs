//! `gallery`: many environments on one sheet.

use crate::failure::Failure;
use crate::input::library::Making;
use crate::pictures::drawing::frame;
use crate::pictures::look::Size;
use crate::pictures::preview::{Choice, Screen};
use crate::pictures::renderer::RendererArguments;
use crate::pictures::solved::{clip, solve};
use crate::pictures::subject::are_related;
use crate::pictures::thumbnail::thumbnail;
use crate::terminal::{listed, note, show};
use clap::{Args, ValueHint};
use env::{Env, EnvError, Registry, Spec};
use indicatif::{ProgressBar, ProgressStyle};
use render::{Painters, Picture};
use std::path::PathBuf;
use std::sync::atomic::{AtomicUsize, Ordering};
use video::{Sheet, write_png};

/// Draw many environments on one sheet
#[derive(Args)]
#[command(
    after_help = "Every environment is reset with the same seed and drawn from the first camera that it, or an id \
with the same task and model, observes, else from a three-quarter view in which what moves fills the picture; its id \
stands below. Ids that run one task on one model are a family, of which the first is drawn, or all \
with --all. With --solved each is drawn when its controller has solved it, and those without a controller are left out. Environments whose models are not imported are left out, and a note says so. The sheet does not depend on \
the number of threads.

Examples:
  robohive gallery hive --out sheet.png
  robohive gallery KnifeEdge --solved --clips clips --size 160x120 --out solved.png
  robohive gallery Franka --all --columns 4 --size 160x120 --out franka.png"
)]
pub struct Gallery {
    /// A suite, or a part of ids; all suites without one
    #[arg(value_name = "FILTER")]
    filter: Option<String>,
    /// Draw all ids instead of the first of each family
    #[arg(long)]
    all: bool,
    /// Draw each environment when its controller has solved it, and only those that have one
    #[arg(long)]
    solved: bool,
    /// Write a video of each solved episode (.mp4) into this folder, too
    #[arg(long, value_name = "FOLDER", value_hint = ValueHint::DirPath, requires = "solved")]
    clips: Option<PathBuf>,
    /// Pictures in a row [default: about as many as there are rows]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=1024))]
    columns: Option<u32>,
    /// Columns and rows of each picture, or one number for both
    #[arg(long, value_name = "WxH", default_value = "240x180")]
    size: Size,
    /// Write the sheet to this file
    #[arg(long, value_name = "FILE.png", value_hint = ValueHint::FilePath, value_parser = png_file)]
    out: Option<PathBuf>,
    /// Show the sheet in the terminal
    #[arg(long, value_name = "PROTOCOL", num_args = 0..=1, require_equals = true, default_missing_value = "auto")]
    preview: Option<Choice>,
    /// Seed of the resets
    #[arg(long, value_name = "SEED", default_value_t = 0)]
    seed: u64,
    /// What draws
    #[command(flatten)]
    renderer: RendererArguments,
    /// How environments are made
    #[command(flatten)]
    making: Making,
    /// Threads; 0 for as many as there are cores
    #[arg(long, value_name = "N", default_value_t = 0)]
    threads: usize,
    /// Show no progress
    #[arg(long, short)]
    quiet: bool,
}

fn png_file(text: &str) -> Result<PathBuf, String> {
    let path = PathBuf::from(text);
    let is_png = path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("png"));
    if is_png { Ok(path) } else { Err("sheets are .png files".into()) }
}

/// What became of an environment.
enum Outcome {
    Drawn(Picture),
    /// Its files are not there.
    Missing(String),
    /// Its controller does not solve it.
    Unsolved,
    Failed(String),
}

/// Runs the command.
pub fn run(a: &Gallery) -> Result<(), Failure> {
    let screen = match (a.preview, &a.out) {
        (None, Some(_)) => None,
        (choice, _) => {
            Some(Screen::require(choice.unwrap_or(Choice::Auto), "name a file with --out FILE.png")?)
        }
    };
    let specs = chosen(a)?;
    if let Some(folder) = &a.clips {
        std::fs::create_dir_all(folder)
            .map_err(|error| Failure::new(format!("{}: {error}", folder.display())))?;
    }
    let outcomes = draw_all(a, &specs)?;
    let drawn = outcomes.iter().filter(|outcome| matches!(outcome, Outcome::Drawn(_))).count();
    let columns = a.columns.unwrap_or_else(|| (drawn as f64).sqrt().ceil().max(1.0) as u32);
    let cell = (a.size.width as u32, a.size.height as u32);
    let mut sheet = Sheet::new(columns, cell).map_err(Failure::usage)?;
    let (mut missing, mut unsolved, mut failed) = (Vec::new(), Vec::new(), Vec::new());
    for (spec, outcome) in specs.iter().zip(&outcomes) {
        match outcome {
            Outcome::Drawn(picture) => sheet.add(&frame(picture)?, &spec.id).map_err(Failure::usage)?,
            Outcome::Missing(why) => missing.push((&spec.id, why)),
            Outcome::Unsolved => unsolved.push(&spec.id),
            Outcome::Failed(why) => failed.push(format!("{}: {why}", spec.id)),
        }
    }
    if let Some((_, why)) = missing.first() {
        let ids = listed(missing.iter().map(|(id, _)| id), 4);
        note(&format!("left out, since their models are not here: {ids}; {why}"));
    }
    if !unsolved.is_empty() {
        let ids = listed(unsolved.iter(), unsolved.len());
        note(&format!("left out, since their controllers do not solve them from seed {}: {ids}", a.seed));
    }
    if drawn > 0 {
        let image = sheet.image().map_err(Failure::usage)?;
        if let Some(path) = &a.out {
            write_png(path, &image.frame()).map_err(Failure::new)?;
            show!("written      {}, {drawn} environments", path.display());
        }
        if let Some(screen) = screen {
            screen.show(&image.frame());
        }
    }
    match (failed.is_empty(), drawn) {
        (false, _) => Err(Failure::new(format!("not drawn:\n{}", failed.join("\n")))),
        (true, 0) => Err(Failure::new("there is no environment to draw")),
        (true, _) => Ok(()),
    }
}

/// The environments that the filter asks for.
fn chosen(a: &Gallery) -> Result<Vec<&'static Spec>, Failure> {
    let specs = Registry::builtin().specs();
    let filter = a.filter.as_deref().unwrap_or_default();
    let in_suite = specs.iter().any(|spec| spec.suite == filter);
    let wanted = |spec: &&Spec| if in_suite { spec.suite == filter } else { spec.id.contains(filter) };
    let mut found: Vec<&Spec> = Vec::new();
    for spec in specs.iter().filter(wanted) {
        if a.solved && control::serving(spec).next().is_none() {
            continue;
        }
        if a.all || !found.iter().any(|other| are_related(spec, other)) {
            found.push(spec);
        }
    }
    if found.is_empty() && a.solved && specs.iter().any(|spec| wanted(&spec)) {
        return Err(Failure::usage(format!("no controller serves any of {filter:?}")));
    }
    if found.is_empty() {
        return Err(Failure::usage(format!(
            "no suite is named {filter:?} and no id contains it; `robohive list` shows all"
        )));
    }
    Ok(found)
}

/// Draws environments on threads, each environment on one of them; the outcomes are in the order of the environments.
fn draw_all(a: &Gallery, specs: &[&Spec]) -> Result<Vec<Outcome>, Failure> {
    let options = a.making.options()?;
    let assets = a.making.assets()?;
    let painters = a.renderer.painters()?;
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    let threads = if a.threads == 0 { cores } else { a.threads }.min(specs.len());
    let bar = if a.quiet { ProgressBar::hidden() } else { progress(specs.len()) };
    let next = AtomicUsize::new(0);
    let work = || {
        let mut outcomes = Vec::new();
        loop {
            let place = next.fetch_add(1, Ordering::Relaxed);
            let Some(spec) = specs.get(place) else { return outcomes };
            bar.set_message(spec.id.clone());
            let outcome = match Env::make(&spec.id, &assets, &options) {
                Ok(env) => {
                    draw(a, env, &*painters).unwrap_or_else(|failure| Outcome::Failed(failure.to_string()))
                }
                Err(error @ EnvError::MissingFile { .. }) => Outcome::Missing(error.to_string()),
                Err(error) => Outcome::Failed(error.to_string()),
            };
            outcomes.push((place, outcome));
            bar.inc(1);
        }
    };
    let mut outcomes: Vec<_> = std::thread::scope(|scope| {
        let workers: Vec<_> = (0..threads).map(|_| scope.spawn(work)).collect();
        workers.into_iter().flat_map(|worker| worker.join().expect("a panic ends the command")).collect()
    });
    bar.finish_and_clear();
    outcomes.sort_by_key(|(place, _)| *place);
    Ok(outcomes.into_iter().map(|(_, outcome)| outcome).collect())
}

/// The picture of an environment after a reset, or when it is solved.
fn draw(a: &Gallery, mut env: Env, painters: &dyn Painters) -> Result<Outcome, Failure> {
    if !a.solved {
        env.reset(Some(a.seed)).map_err(Failure::new)?;
        return thumbnail(&env, a.size, painters).map(Outcome::Drawn);
    }
    let solved = match &a.clips {
        Some(folder) => clip(folder, &mut env, a.seed, a.size, painters)?,
        None => solve(&mut env, a.seed, |_| Ok(()))?,
    };
    if solved { thumbnail(&env, a.size, painters).map(Outcome::Drawn) } else { Ok(Outcome::Unsolved) }
}

fn progress(environments: usize) -> ProgressBar {
    let style = ProgressStyle::with_template("{bar:30} {pos}/{len} environments, {eta} left, {msg}");
    ProgressBar::new(environments as u64).with_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()))
}
