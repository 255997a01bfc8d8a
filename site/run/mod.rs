//! Running the blocks of a page, one after the other, in a folder of its own.

mod command;
mod data;
mod output;
mod python;
mod runners;

pub use runners::Runners;

use crate::block::Block;
use crate::stage::save;
use command::Run;
use output::{agrees, listed};
use python::Interpreter;
use std::path::{Path, PathBuf};

/// Folders of the repository that blocks may read.
const LENT: [&str; 4] = ["assets", "examples", "docs", "validation"];

/// Files that test the programs which pages include.
const TESTED: [(&str, &str); 3] = [
    ("examples/", "tests/examples.rs"),
    ("python/examples/", "python/tests/test_examples.py"),
    ("src/hardware/examples/", "src/hardware/tests/examples.rs"),
];

/// What became of a block.
#[derive(Debug, PartialEq, Eq)]
pub enum Verdict {
    /// It was run or read, and did what it should.
    Checked,
    /// It is run by tests of the repository.
    Elsewhere,
    /// It is not run, for a reason that its page gives.
    NotRun(String),
    /// This machine lacks what runs it.
    Lacking(&'static str),
    /// It did something else than it should.
    Failed(String),
}

/// What is known while the blocks of a page are run.
struct Running<'a> {
    runners: &'a Runners,
    page: &'a str,
    folder: PathBuf,
    python: Option<Interpreter>,
    /// What the last block printed; none where it did not run.
    printed: Option<String>,
}

/// Runs the blocks of `page` in `folder`. A folder of that name is deleted first.
///
/// # Errors
/// The folder cannot be made.
pub fn run(runners: &Runners, page: &str, blocks: &[Block], folder: &Path) -> Result<Vec<Verdict>, String> {
    prepare(runners, folder).map_err(|error| format!("{}: {error}", folder.display()))?;
    let mut running = Running { runners, page, folder: folder.to_owned(), python: None, printed: None };
    blocks.iter().map(|block| running.check(block)).collect()
}

/// Makes the folder of a page: what blocks read, and the npm package by its name.
fn prepare(runners: &Runners, folder: &Path) -> std::io::Result<()> {
    if folder.exists() {
        std::fs::remove_dir_all(folder)?;
    }
    std::fs::create_dir_all(folder.join("node_modules"))?;
    let package =
        runners.package.iter().map(|package| (package.clone(), folder.join("node_modules/robohive")));
    let lent = LENT.iter().map(|name| (runners.root.join(name), folder.join(name)));
    lent.chain(package).try_for_each(|(from, to)| link(&from, &to))
}

#[cfg(unix)]
fn link(from: &Path, to: &Path) -> std::io::Result<()> {
    std::os::unix::fs::symlink(from, to)
}

#[cfg(windows)]
fn link(from: &Path, to: &Path) -> std::io::Result<()> {
    std::os::windows::fs::symlink_dir(from, to)
}

impl Running<'_> {
    fn check(&mut self, block: &Block) -> Result<Verdict, String> {
        if let Some(name) = &block.marks.file {
            save(&self.folder.join(name), block.text.as_bytes())?;
        }
        if block.marks.output {
            return Ok(self.compare(block));
        }
        if let Some(reason) = &block.marks.not_run {
            self.printed = None;
            return Ok(Verdict::NotRun(reason.clone()));
        }
        if let Some(verdict) = self.tested_elsewhere(block) {
            return Ok(verdict);
        }
        let run = match block.language.as_str() {
            "text" => return Ok(Verdict::NotRun("text, not code".into())),
            "rust" => return Ok(self.program()),
            "sh" => command::shell(self.runners, &self.folder, block)?,
            "js" => command::javascript(self.runners, &self.folder, block)?,
            "python" => self.python(block)?,
            "xml" => data::model(&self.folder, block),
            "toml" => data::toml(block),
            "json" => data::json(block),
            "html" => data::element(&self.runners.root, block)?,
            other => Run::failed(format!("nothing runs blocks of {other:?}")),
        };
        let (well, printed) = match run {
            Run::Ended { well, printed } => (well, printed),
            Run::Lacking(what) => {
                self.printed = None;
                return Ok(Verdict::Lacking(what));
            }
        };
        let verdict = match (well, block.marks.fails) {
            (true, true) => Verdict::Failed(format!("it should fail and does not\n{printed}")),
            (false, false) => Verdict::Failed(printed.clone()),
            _ => Verdict::Checked,
        };
        self.printed = Some(printed);
        Ok(verdict)
    }

    /// A block of a file that tests of the repository run; wrong where none does.
    fn tested_elsewhere(&self, block: &Block) -> Option<Verdict> {
        let file = block.included.as_ref()?;
        let (folder, tests) = TESTED.iter().find(|(folder, _)| file.starts_with(folder))?;
        let text = std::fs::read_to_string(self.runners.root.join(tests)).unwrap_or_default();
        let name = file.trim_start_matches(folder);
        let stem = name.rsplit_once('.').map_or(name, |(stem, _)| stem);
        Some(if text.contains(stem) {
            Verdict::Elsewhere
        } else {
            Verdict::Failed(format!("{tests} does not run {file}"))
        })
    }

    fn program(&self) -> Verdict {
        if self.runners.programs.contains(&format!("\"pages/{}\"", self.page)) {
            Verdict::Elsewhere
        } else {
            Verdict::Failed(
                "site/programs.rs does not include this page, so that nothing compiles its Rust".into(),
            )
        }
    }

    fn python(&mut self, block: &Block) -> Result<Run, String> {
        let Some(program) = &self.runners.python else { return Ok(Run::Lacking("the Python package")) };
        if self.python.is_none() {
            self.python = Some(Interpreter::start(program, &self.runners.root, &self.folder)?);
        }
        self.python.as_mut().map_or_else(|| Err("no interpreter".into()), |python| python.run(block))
    }

    /// Whether a block is what the one before printed.
    fn compare(&self, block: &Block) -> Verdict {
        match &self.printed {
            None => Verdict::NotRun("output of a block that is not run".into()),
            Some(printed) => match agrees(&block.text, printed) {
                Ok(()) => Verdict::Checked,
                Err(line) => {
                    Verdict::Failed(format!("nothing was printed like {line:?}, but\n{}", listed(printed)))
                }
            },
        }
    }
}
