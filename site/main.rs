//! `robohive-site FOLDER [OPTION…]` builds the documentation into a folder, checks its links, and runs the code blocks of its
//! pages; `robohive-site sizes MODELS` records the sizes of environments. `cargo xtask site` prepares what the options name:
//! `--command FOLDER` with the command `robohive`, `--python PROGRAM` with the package, `--package FOLDER` with the npm package,
//! `--api FOLDER` with rustdoc's pages. What is not named is not checked, and said.

mod block;
mod html;
mod include;
mod link;
mod links;
mod own;
mod page;
mod pictures;
mod reference;
mod run;
mod stage;

use block::Block;
use page::Generated;
use run::{Runners, Verdict};
use stage::{Contents, copy, save};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode};
use std::sync::atomic::{AtomicUsize, Ordering};

/// What stands in the place of each page with an engine in a build without it.
const NO_ENGINE: &str = "<!doctype html><html lang=\"en\"><meta charset=\"utf-8\"><title>RoboHive</title>\
                         <p>This build of the site has no engine: <code>cargo xtask web</code> builds one.</p></html>\n";

/// What the command line names.
struct Request {
    /// Where the site goes.
    site: PathBuf,
    /// Where it is prepared, and blocks are run.
    work: PathBuf,
    runners: Runners,
    api: Option<PathBuf>,
}

fn main() -> ExitCode {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let root = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("..");
    let outcome = match &words.iter().map(String::as_str).collect::<Vec<_>>()[..] {
        ["sizes", models] => {
            reference::sizes(&root, Path::new(models)).map(|count| println!("{count} ids recorded"))
        }
        _ => request(&root, &words)
            .and_then(|request| build(&request).and_then(|blocks| check(&request, &blocks))),
    };
    match outcome {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("{error}");
            ExitCode::FAILURE
        }
    }
}

fn request(root: &Path, words: &[String]) -> Result<Request, String> {
    let usage =
        "robohive-site FOLDER WORK [--command FOLDER] [--python PROGRAM] [--package FOLDER] [--api FOLDER]";
    let [site, work, options @ ..] = words else { return Err(format!("usage: {usage}")) };
    let mut named = BTreeMap::new();
    for pair in options.chunks(2) {
        let [name, value] = pair else { return Err(format!("usage: {usage}")) };
        named.insert(name.as_str(), PathBuf::from(value));
    }
    let absolute =
        |path: PathBuf| std::path::absolute(&path).map_err(|error| format!("{}: {error}", path.display()));
    let mut take = |name: &str| named.remove(name).map(absolute).transpose();
    let programs = std::fs::read_to_string(root.join("site/programs.rs"))
        .map_err(|error| format!("site/programs.rs: {error}"))?;
    let root = root.canonicalize().map_err(|error| format!("{}: {error}", root.display()))?;
    let runners = Runners {
        root,
        command: take("--command")?,
        python: take("--python")?,
        package: take("--package")?,
        programs,
    };
    let request =
        Request { site: absolute(site.into())?, work: absolute(work.into())?, runners, api: take("--api")? };
    match named.keys().next() {
        None => Ok(request),
        Some(name) => Err(format!("there is no option {name}; usage: {usage}")),
    }
}

/// Builds the site; the blocks of all pages.
fn build(request: &Request) -> Result<Vec<(String, Vec<Block>)>, String> {
    let Runners { root, command, package, .. } = &request.runners;
    let book = request.work.join("book");
    [&book, &request.site].into_iter().try_for_each(|folder| remove(folder))?;
    let contents = Contents::of(root)?;
    let generated = generated(request, &contents)?;
    let blocks = contents.write(root, &book.join("pages"), &generated)?;
    copy(&root.join("site/theme"), &book.join("theme"), &|_| true)?;
    if package.is_none() {
        without_engine(&book.join("theme/site.js"))?;
    }
    let settings =
        std::fs::read(root.join("site/book.toml")).map_err(|error| format!("site/book.toml: {error}"))?;
    save(&book.join("book.toml"), &settings)?;
    if let Some(programs) = command {
        pictures::draw(root, programs, &book.join("pages/pictures"))?;
    }
    let mut book = mdbook_driver::MDBook::load(&book).map_err(|error| format!("{error:#}"))?;
    book.config.build.build_dir.clone_from(&request.site);
    book.build().map_err(|error| format!("{error:#}"))?;
    match package {
        Some(package) => copy(package, &request.site.join("live"), &|_| true)?,
        None => stage::names(root, "web/page")?
            .iter()
            .filter(|name| name.ends_with(".html"))
            .try_for_each(|name| save(&request.site.join("live").join(name), NO_ENGINE.as_bytes()))?,
    }
    if let Some(api) = &request.api {
        copy(api, &request.site.join("api"), &|path| !path.ends_with("src"))?;
    }
    Ok(blocks)
}

/// Tells the script of the pages that there is no engine, so that it asks no host for one.
fn without_engine(script: &Path) -> Result<(), String> {
    let failed = |error: std::io::Error| format!("{}: {error}", script.display());
    let text = std::fs::read_to_string(script).map_err(failed)?;
    std::fs::write(script, text.replace("HAS_ENGINE = true", "HAS_ENGINE = false")).map_err(failed)
}

/// All texts that are made from the code.
fn generated(request: &Request, contents: &Contents) -> Result<Generated, String> {
    let Runners { root, command, python, package, .. } = &request.runners;
    let mut texts = Generated::new();
    let mut add = |name: &str, text: String| drop(texts.insert(name.to_owned(), text));
    add("format", reference::format());
    add("sensors", reference::sensors());
    add("dropped", reference::dropped());
    add("keys", reference::keys());
    add("environments", reference::environments(root)?);
    add("own models", reference::own_models(root)?);
    add("results", contents.results(root)?);
    let lacking = |what: &str| format!("*Not part of this build, for lack of {what}.*\n");
    let commands = command
        .as_ref()
        .map(|programs| printed(Command::new(programs.join("robohive")).args(["man", "--markdown"])));
    add("commands", commands.transpose()?.unwrap_or_else(|| lacking("the command")));
    let written = stage::names(root, "web/page")?.into_iter().filter(|name| name.ends_with(".d.ts"));
    let mut types: Vec<PathBuf> = written.map(|name| root.join("web/page").join(name)).collect();
    types.extend(package.iter().map(|package| package.join("engine.d.ts")));
    add("javascript", reference::javascript(&types)?);
    for part in
        ["environments", "control", "policy", "training", "pettingzoo", "collect", "data", "ray", "mujoco"]
    {
        let script = root.join("site/reference/python.py");
        let text = python
            .as_ref()
            .map(|python| printed(Command::new(python).arg(script).arg(root.join("python")).arg(part)));
        add(&format!("python {part}"), text.transpose()?.unwrap_or_else(|| lacking("Python")));
    }
    Ok(texts)
}

/// What a program prints.
fn printed(command: &mut Command) -> Result<String, String> {
    let out = command.output().map_err(|error| format!("{command:?}: {error}"))?;
    match out.status.success() {
        true => String::from_utf8(out.stdout).map_err(|error| format!("{command:?}: {error}")),
        false => Err(format!("{command:?}: {}", String::from_utf8_lossy(&out.stderr))),
    }
}

/// Checks links and blocks, and prints what was checked and what was not.
fn check(request: &Request, pages: &[(String, Vec<Block>)]) -> Result<(), String> {
    let counts = links::check(&request.site);
    let verdicts = run_all(request, pages)?;
    let mut failed = Vec::new();
    let (mut by_language, mut reasons, mut lacking) = (BTreeMap::new(), BTreeMap::new(), BTreeMap::new());
    for (block, verdict) in &verdicts {
        let row: &mut [usize; 3] = by_language.entry(block.language.as_str()).or_default();
        match verdict {
            Verdict::Checked => row[0] += 1,
            Verdict::Elsewhere => row[1] += 1,
            Verdict::NotRun(reason) => {
                row[2] += 1;
                *reasons.entry(reason.as_str()).or_insert(0) += 1;
            }
            Verdict::Lacking(what) => {
                row[2] += 1;
                *lacking.entry(*what).or_insert(0) += 1;
            }
            Verdict::Failed(why) => failed.push(format!("{}: {}\n{why}", block.place, block.language)),
        }
    }
    println!("{:10} {:>8} {:>10} {:>8}", "blocks", "checked", "by tests", "not run");
    by_language
        .iter()
        .for_each(|(language, [here, tests, not])| println!("{language:10} {here:>8} {tests:>10} {not:>8}"));
    reasons.iter().for_each(|(reason, count): (_, &usize)| println!("{count:>3} not run: {reason}"));
    lacking.iter().for_each(|(what, count): (_, &usize)| println!("lacking: {what}: {count} blocks"));
    match counts {
        Ok(counts) => println!(
            "{} pages, {} links inside of the site, {} to other hosts, which are not followed",
            counts.pages, counts.inside, counts.outside
        ),
        Err(wrong) => failed.push(wrong),
    }
    if failed.is_empty() { Ok(()) } else { Err(failed.join("\n")) }
}

/// Runs the blocks of all pages, two pages at once.
fn run_all<'a>(
    request: &Request,
    pages: &'a [(String, Vec<Block>)],
) -> Result<Vec<(&'a Block, Verdict)>, String> {
    let next = AtomicUsize::new(0);
    let work = || {
        let mut done = Vec::new();
        while let Some((page, blocks)) = pages.get(next.fetch_add(1, Ordering::Relaxed)) {
            let folder = request.work.join("run").join(page.trim_end_matches(".md"));
            done.push(
                run::run(&request.runners, page, blocks, &folder).map(|verdicts| blocks.iter().zip(verdicts)),
            );
        }
        done
    };
    let done: Vec<_> = std::thread::scope(|scope| {
        let workers = [scope.spawn(work), scope.spawn(work)];
        workers.into_iter().flat_map(|worker| worker.join().expect("a panic ends the program")).collect()
    });
    let done = done.into_iter().collect::<Result<Vec<_>, String>>()?;
    Ok(done.into_iter().flatten().collect())
}

fn remove(folder: &Path) -> Result<(), String> {
    match folder.exists() {
        true => std::fs::remove_dir_all(folder).map_err(|error| format!("{}: {error}", folder.display())),
        false => Ok(()),
    }
}
