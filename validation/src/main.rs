//! Measures our physics beside MuJoCo's and writes the tables: model by model, or what the first word chooses.

use physics::Model;
use robohive_validation::reference::{Own, Reference, own_models, recorded};
use robohive_validation::status::{Row, measure, open, render};
use robohive_validation::{
    bits, c_library, collide, controllers, demonstrations, draws, environments, episodes,
};
use robohive_validation::{
    hulls, laws, pictures, policies, robots, round_trip, scenes, shipped, solver, wider,
};
use std::ops::Range;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

const USAGE: &str = "usage: robohive-validation --models FOLDER --list FILE --references FOLDER [--only TEXT]
       [--write README.md] [--section NAME] [--brief]
       robohive-validation bits [--models FOLDER --list FILE --references FOLDER] [--only TEXT] [--write README.md]
       robohive-validation solver --problems FOLDER [--references FOLDER] [--only TEXT] [--write README.md]
       robohive-validation collide [--from FILE] [--write README.md] [--section NAME]
       robohive-validation laws [--write README.md]
       robohive-validation laws --episodes N [--suite NAME] [--only TEXT] [--threads N] [--write README.md]
       robohive-validation draws [--write README.md]
       robohive-validation environments --models FOLDER --references FOLDER [--only TEXT] [--write README.md]
       robohive-validation policies --models FOLDER --policies FOLDER [--only TEXT] [--write README.md]
       robohive-validation demonstrations --models FOLDER --from FILE [--write README.md]
       robohive-validation pictures [--models FOLDER] --references FOLDER [--only TEXT] [--compare FOLDER] [--dump FOLDER]
       [--write README.md]
       robohive-validation pictures-gpu [--models FOLDER] --references FOLDER [--only TEXT] [--write README.md]
       robohive-validation scenes --models FOLDER --list FILE --references FOLDER [--only TEXT] [--write README.md]
       robohive-validation wider --models FOLDER --list FILE --references FOLDER [--only TEXT] [--write README.md]
       robohive-validation quirks [--write README.md]
       robohive-validation robots [--write README.md]
       robohive-validation controllers [--suite NAME] [--only TEXT] [--write README.md]
       robohive-validation shipped [--only TEXT] [--write README.md]
       robohive-validation hulls FOLDER... [--record FILE | --compare FILE]
       robohive-validation round-trip FOLDER... [--only TEXT] [--write README.md]

Loads FOLDER/LINE for each LINE of the list, compares it with the archive that record.py made of it, prints a table,
and with --write replaces the text between the table markers of a file; with --section between the markers of that
section. With --brief the written table leaves out the models without a fault; that of bits has sums by source.

quirks: what RoboHive does otherwise than it means to, robot and tasks.
environments: sets every state that robohive.py recorded, and compares observations, rewards and the draws of resets;
models are the folder with RoboHive's envs and simhive.
policies: runs the policies of hand_dapg (its folder dapg/policies) in our environments, and fails when they solve fewer
episodes than in RoboHive.
demonstrations: replays those of hand_dapg for the door (dapg/demonstrations/door-v0_demos.pickle).
pictures: draws the scenes of validation/pictures.toml and compares them with what pictures.py recorded; fails when a bar is
missed. Models are the folder with RoboHive's envs and simhive and MuJoCo's model; without it own models alone are drawn. With
--compare another folder of recordings
stands in for our pictures; --dump writes ours, the recorded one and eight times their difference side by side.
pictures-gpu: draws the same scenes on a GPU and compares them with those of the CPU renderer (builds with feature gpu).
scenes: assembles the scenes that items.py recorded and compares items, lights and cameras; fails when any differs.
wider: compares the public models that wider.py gathered and recorded, source by source; fails when a bar is missed. Models
are its folder sources.
draws: makes every recorded random draw with all seeds and compares it with numpy's; fails when any differs.
bits: counts the values that are MuJoCo's to the last bit. Without a list on the own models, where it fails when the table is
not that of results/bits.md. That table needs RUSTFLAGS=\"--cfg system_math\"; with it the exit code is 3 where the C library
is another than that of the recorded MuJoCo.
laws: measures laws of mechanics, on states of the own models and of those in the folder ROBOHIVE_REFERENCES. With --episodes or
--suite it runs episodes of random actions instead, 200 unless --episodes says otherwise, of every id on a model of our own or of one
suite, whose section --write replaces; with --only of ids that contain TEXT, whose rows alone it replaces. It counts episodes that
physics ended, NaN, bodies that were lost, and how far soft things were stretched; fails when a law is broken.
robots: compares our own robots with the numbers that are published of them (published.toml of their folders); fails when one
differs by more than 2 % or 0.02 rad without a reason.
controllers: runs every controller in the environments that it serves, on 20 seeds, beside zero and random actions; fails when a
controller solves less than 80 % of them, or the others 5 %. With --suite of one suite, whose section --write replaces; with
--only of ids that contain TEXT, whose rows alone it replaces.
shipped: plays 200 episodes of every policy that is shipped, beside zero and random actions; fails when one solves less than 80 % of them,
or no more than these do.
hulls: hashes the convex hull of every mesh file (STL, OBJ, MSH) below the folders, one line a mesh; fails when any differs
from the recorded ones.
round-trip: writes every model below the folders as MJCF and reads it again; fails when a bit of an array differs, or the
text of a second round.
solver: solves the constraint problems that solver.py recorded; the models are those that record.py recorded.

collide: compares contacts, distances and rays with the stream of collide.py or flex_pairs.py, from standard input or a file; fails when any
differ on which MuJoCo's own answer is stable.";

/// What stands before and after the generated table of a section.
fn markers(section: &str) -> [String; 2] {
    let name = if section.is_empty() { "table".to_owned() } else { format!("{section} table") };
    ["begins", "ends"].map(|end| format!("<!-- {name} {end} -->"))
}

#[derive(Default)]
struct Arguments {
    models: PathBuf,
    list: PathBuf,
    references: PathBuf,
    problems: PathBuf,
    policies: PathBuf,
    from: Option<PathBuf>,
    only: String,
    write: Option<PathBuf>,
    section: String,
    brief: bool,
    folders: Vec<PathBuf>,
    record: Option<PathBuf>,
    compare: Option<PathBuf>,
    dump: Option<PathBuf>,
    suite: String,
    episodes: Option<u64>,
    threads: usize,
}

impl Arguments {
    /// What pictures are compared.
    fn pictures(&self) -> pictures::Inputs<'_> {
        pictures::Inputs {
            models: Some(self.models.as_path()).filter(|folder| !folder.as_os_str().is_empty()),
            references: &self.references,
            only: &self.only,
            other: self.compare.as_deref(),
            dump: self.dump.as_deref(),
        }
    }
}

/// Exit code when the C library is not the one that the recorded MuJoCo called.
const OTHER_LIBRARY: u8 = 3;

fn main() -> ExitCode {
    if cfg!(system_math) && !c_library::is_recorded() {
        eprintln!("the C library's functions are not those that the recorded MuJoCo called");
        return ExitCode::from(OTHER_LIBRARY);
    }
    match run() {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            eprintln!("{message}");
            ExitCode::FAILURE
        }
    }
}

fn run() -> Result<(), String> {
    let mut words = std::env::args().skip(1).peekable();
    let mode = words.next_if(|word| !word.starts_with("--"));
    let a = parse(words)?;
    if mode.as_deref() == Some("hulls") {
        println!("\n{}", hulls(&a)?);
        return Ok(());
    }
    if let Some(folder) = a.folders.first().filter(|_| mode.as_deref() != Some("round-trip")) {
        return Err(format!("unknown argument {}\n{USAGE}", folder.display()));
    }
    let (section, table, verdict) = measured(mode.as_deref(), &a)?;
    println!("\n{table}");
    a.write.as_deref().map_or(Ok(()), |path| replace(path, &markers(section), &table))?;
    verdict
}

/// Section, table and verdict of what the first word chooses.
fn measured<'a>(
    mode: Option<&str>,
    a: &'a Arguments,
) -> Result<(&'a str, String, Result<(), String>), String> {
    Ok(match mode {
        None => (a.section.as_str(), status(a)?, Ok(())),
        Some("bits") => {
            let (table, verdict) = bits(a)?;
            ("bits", table, verdict)
        }
        Some("solver") => {
            let (table, verdict) = solver::measure(&a.problems, &a.references, &a.only)?;
            ("solver", table, verdict)
        }
        Some("collide") => {
            let (table, verdict) = collide::table::measure(a.from.as_deref())?;
            (if a.section.is_empty() { "collide" } else { &a.section }, table, verdict)
        }
        Some("draws") => {
            let (table, verdict) = draws::render(&draws::compare(Path::new(draws::RECORDED), usize::MAX)?);
            ("draws", table, verdict)
        }
        Some("quirks") => ("quirks", environments::quirk_table(), Ok(())),
        Some("environments") => {
            let rows = environments::compare(&a.models, &a.references, &a.only)?;
            let (table, verdict) = environments::render(&rows);
            ("environments", table, verdict)
        }
        Some("policies") => {
            let (table, verdict) = policies::render(&policies::run(&a.models, &a.policies, &a.only)?);
            ("policies", table, verdict)
        }
        Some("shipped") => {
            let (table, verdict) = shipped::render(&shipped::measure(&a.only)?);
            ("shipped", table, verdict)
        }
        Some("pictures") => {
            let (table, verdict) = pictures::measure(&a.pictures())?;
            ("pictures", table, verdict)
        }
        #[cfg(feature = "gpu")]
        Some("pictures-gpu") => {
            let (table, verdict) = pictures::gpu::measure(&a.pictures())?;
            ("pictures-gpu", table, verdict)
        }
        #[cfg(not(feature = "gpu"))]
        Some("pictures-gpu") => return Err("pictures-gpu needs a build with --features gpu".into()),
        Some("demonstrations") => {
            let file = a.from.as_deref().ok_or(USAGE)?;
            let replays = demonstrations::replay(&a.models, file)?;
            ("demonstrations", demonstrations::render(&replays), Ok(()))
        }
        Some("robots") => {
            let (table, verdict) = robots::render(&robots::measure()?);
            ("robots", table, verdict)
        }
        Some("controllers") => by_controllers(a)?,
        Some("scenes") => {
            let (table, verdict) = scenes::render(&assembled(a)?);
            ("scenes", table, verdict)
        }
        Some("round-trip") => {
            let (table, verdict) = round_trip::render(&round_trip::measure(&a.folders, &a.only)?);
            ("round-trip", table, verdict)
        }
        Some("wider") => {
            let (table, verdict) = wider_table(a)?;
            ("wider", table, verdict)
        }
        Some("laws") => laws(a)?,
        Some(word) => return Err(format!("unknown command {word}\n{USAGE}")),
    })
}

/// What controllers solve; with `--only`, beside the rows that are written.
fn by_controllers(a: &Arguments) -> Result<(&str, String, Result<(), String>), String> {
    let (table, verdict) = controllers::render(&controllers::measure(&a.suite, &a.only)?);
    let section = if a.suite.is_empty() { "controllers" } else { &a.suite };
    let table = if a.only.is_empty() { table } else { controllers::joined(&written(a, section)?, &table) };
    Ok((section, table, verdict))
}

/// What the file that is written has in a section; nothing without `--write`.
fn written(a: &Arguments, section: &str) -> Result<String, String> {
    a.write.as_ref().map_or(Ok(String::new()), |path| section_of(path, &markers(section)))
}

/// What holds of own and recorded models; or of episodes, where those are asked for.
fn laws(a: &Arguments) -> Result<(&str, String, Result<(), String>), String> {
    if !a.suite.is_empty() || a.episodes.is_some() {
        let section = if a.suite.is_empty() { "episodes" } else { &a.suite };
        let older = if a.only.is_empty() { String::new() } else { written(a, section)? };
        // Before what takes hours, and not after it.
        let kept = episodes::kept(&older)?;
        let count = a.episodes.unwrap_or(episodes::EPISODES);
        let (table, verdict) = episodes::render(&episodes::measure(&a.suite, &a.only, count, a.threads)?);
        return Ok((section, episodes::joined(kept, &table), verdict));
    }
    let recorded = recorded().map_err(|e| e.to_string())?;
    let references: Vec<_> = recorded.into_iter().map(|(_, reference)| reference).collect();
    let laws = laws::measure("models", &references, laws::Piles::All).map_err(|e| e.to_string())?;
    let (table, verdict) = laws::render(&laws);
    Ok(("laws", table, verdict))
}

/// Path in the list, model and reference of every chosen model.
fn chosen(a: &Arguments) -> Result<Vec<(String, PathBuf, PathBuf)>, String> {
    if a.list.as_os_str().is_empty() || a.references.as_os_str().is_empty() {
        return Err(USAGE.into());
    }
    let list = std::fs::read_to_string(&a.list).map_err(|e| format!("{}: {e}", a.list.display()))?;
    let files = |line: &str| {
        let name = line.trim_end_matches(".xml").replace('/', "__");
        (line.to_owned(), a.models.join(line), a.references.join(name + ".npz"))
    };
    Ok(list.lines().filter(|line| !line.is_empty() && line.contains(&a.only)).map(files).collect())
}

/// The table of the listed public models.
fn wider_table(a: &Arguments) -> Result<(String, Result<(), String>), String> {
    let rows = wider_rows(a)?;
    let left_out = a.list.with_file_name("left_out.tsv");
    let left_out = std::fs::read_to_string(&left_out).map_err(|e| format!("{}: {e}", left_out.display()))?;
    Ok(wider::render(&rows, &left_out))
}

/// How the listed public models compare.
fn wider_rows(a: &Arguments) -> Result<Vec<wider::Compared>, String> {
    let row = |(line, model, reference): (String, PathBuf, PathBuf)| {
        let row = wider::measure(&line, &model, &reference);
        println!("{}", row.line());
        row
    };
    Ok(chosen(a)?.into_iter().map(row).collect())
}

/// How the scenes of every listed model compare.
fn assembled(a: &Arguments) -> Result<Vec<scenes::Compared>, String> {
    let mut rows = Vec::new();
    for (line, model, reference) in chosen(a)? {
        let row = scenes::measure(&model, &reference);
        match &row {
            Ok(report) => println!("{}\n{}", report.line(&line), report.notes.join("\n")),
            Err(error) => println!("{line}: {error}"),
        }
        rows.push((line, row));
    }
    Ok(rows)
}

/// The summary of the hulls of all mesh files below the folders.
fn hulls(a: &Arguments) -> Result<String, String> {
    let purpose = match (&a.record, &a.compare) {
        (None, None) => hulls::Purpose::Print,
        (Some(path), None) => hulls::Purpose::Record(path),
        (None, Some(path)) => hulls::Purpose::Compare(path),
        (Some(_), Some(_)) => return Err(format!("--record or --compare, not both\n{USAGE}")),
    };
    hulls::measure(&a.folders, purpose)
}

/// The recorded table of the own models.
const OWN_BITS: &str = include_str!("../results/bits.md");

/// The table of values that are equal to the last bit; for the own models an error as verdict when it is not the
/// recorded one.
fn bits(a: &Arguments) -> Result<(String, Result<(), String>), String> {
    let mut rows = Vec::new();
    let mut take = |name: &str, m: &Model, reference: &Reference| {
        let row = bits::count_bits(name, m, reference).map_err(|e| e.to_string())?;
        print!("{}\n{}", row.line(), row.differences());
        rows.push(row);
        Ok::<(), String>(())
    };
    if !a.list.as_os_str().is_empty() {
        let mut unread = Vec::new();
        for (line, model, reference) in chosen(a)? {
            let taken = open(&model, &reference).and_then(|(m, reference)| take(&line, &m, &reference));
            unread.extend(taken.err().map(|why| (line, why)));
        }
        let table = if a.brief { bits::render_sources(&rows, &unread) } else { bits::render(&rows) };
        let verdict = match unread.first() {
            None => Ok(()),
            Some((model, why)) => Err(format!("{} models cannot be compared: {model}: {why}", unread.len())),
        };
        return Ok((table, verdict));
    }
    for Own { name, model, reference } in own_models().map_err(|e| e.to_string())? {
        take(name, &model, &reference)?;
    }
    let table = bits::render(&rows);
    let as_recorded = a.write.is_some() || OWN_BITS.contains(&table);
    let verdict = if as_recorded { Ok(()) } else { Err("not as recorded in results/bits.md".into()) };
    Ok((table, verdict))
}

/// The table of all listed models.
fn status(a: &Arguments) -> Result<String, String> {
    let mut rows: Vec<Row> = Vec::new();
    for (line, model, reference) in chosen(a)? {
        let row = measure(&line, &model, &reference);
        println!("{}", row.line());
        rows.push(row);
    }
    Ok(render(&rows, |row| !a.brief || row.falls_short()))
}

fn parse(mut words: impl Iterator<Item = String>) -> Result<Arguments, String> {
    let mut a = Arguments::default();
    while let Some(word) = words.next() {
        let mut value = || words.next().ok_or_else(|| format!("{word} needs a value\n{USAGE}"));
        match word.as_str() {
            "--models" => a.models = value()?.into(),
            "--list" => a.list = value()?.into(),
            "--references" => a.references = value()?.into(),
            "--problems" => a.problems = value()?.into(),
            "--policies" => a.policies = value()?.into(),
            "--from" => a.from = Some(value()?.into()),
            "--only" => a.only = value()?,
            "--write" => a.write = Some(value()?.into()),
            "--section" => a.section = value()?,
            "--brief" => a.brief = true,
            "--record" => a.record = Some(value()?.into()),
            "--dump" => a.dump = Some(value()?.into()),
            "--suite" => a.suite = value()?,
            "--episodes" => a.episodes = Some(number(&word, &value()?)?),
            "--threads" => a.threads = number(&word, &value()?)?,
            "--compare" => a.compare = Some(value()?.into()),
            folder if !folder.starts_with("--") => a.folders.push(folder.into()),
            _ => return Err(format!("unknown argument {word}\n{USAGE}")),
        }
    }
    Ok(a)
}

fn number<T: std::str::FromStr>(word: &str, value: &str) -> Result<T, String> {
    value.parse().map_err(|_| format!("{word} {value}: a whole number is expected\n{USAGE}"))
}

/// Replaces what stands between the markers of `path`.
fn replace(path: &Path, markers: &[String; 2], table: &str) -> Result<(), String> {
    let (text, place) = marked(path, markers)?;
    let new = format!("{}\n{table}{}", &text[..place.start], &text[place.end..]);
    std::fs::write(path, new).map_err(|e| format!("{}: {e}", path.display()))
}

/// What stands between the markers of a file.
fn section_of(path: &Path, markers: &[String; 2]) -> Result<String, String> {
    marked(path, markers).map(|(text, place)| text[place].to_owned())
}

/// The text of a file, and where in it the text between the markers is.
fn marked(path: &Path, markers: &[String; 2]) -> Result<(String, Range<usize>), String> {
    let text = std::fs::read_to_string(path).map_err(|e| format!("{}: {e}", path.display()))?;
    let [begin, end] = [0, 1].map(|k| text.find(&markers[k]));
    match (begin, end) {
        (Some(begin), Some(end)) if begin < end => Ok((text, begin + markers[0].len()..end)),
        _ => Err(format!("{}: the markers {markers:?} are missing", path.display())),
    }
}
