//! `man`: manual pages, from the same definitions as the help.

use crate::failure::{Failure, unwritable};
use crate::shell::markdown::{markdown, with_subcommands};
use crate::terminal::{show, write_bytes};
use clap::{Args, ValueHint};
use clap_mangen::roff::{Roff, roman};
use std::io::Write;
use std::path::PathBuf;

/// Print or write manual pages
#[derive(Args)]
#[command(after_help = "Without --out the page of `robohive` itself is printed.

Examples:
  robohive man | man -l -
  robohive man --out share/man/man1
  robohive man --markdown > commands.md")]
pub struct Man {
    /// Write the pages of all commands to this folder
    #[arg(long, value_name = "FOLDER", value_hint = ValueHint::DirPath)]
    pub out: Option<PathBuf>,
    /// Print one Markdown text of all commands instead
    #[arg(long, conflicts_with = "out")]
    pub markdown: bool,
}

/// Runs `man` for the pages of `command`.
pub fn run(a: &Man, command: clap::Command) -> Result<(), Failure> {
    let mut main = command.disable_help_subcommand(true);
    main.build();
    if a.markdown {
        write_bytes(markdown(&main).as_bytes());
        return Ok(());
    }
    let Some(folder) = &a.out else {
        write_bytes(&page(&main).map_err(Failure::new)?);
        return Ok(());
    };
    std::fs::create_dir_all(folder).map_err(unwritable(folder))?;
    for command in with_subcommands(&main) {
        let name = command.get_display_name().unwrap_or_else(|| command.get_name());
        let path = folder.join(format!("{name}.1"));
        std::fs::write(&path, page(command).map_err(Failure::new)?).map_err(unwritable(&path))?;
        show!("{}", path.display());
    }
    Ok(())
}

/// The page of a command.
fn page(command: &clap::Command) -> std::io::Result<Vec<u8>> {
    let man = clap_mangen::Man::new(command.clone().version(crate::version::VERSION))
        .source(concat!("robohive ", env!("CARGO_PKG_VERSION")));
    let mut page = Vec::new();
    man.render_title(&mut page)?;
    man.render_name_section(&mut page)?;
    man.render_synopsis_section(&mut page)?;
    man.render_description_section(&mut page)?;
    man.render_options_section(&mut page)?;
    if command.has_subcommands() {
        man.render_subcommands_section(&mut page)?;
    }
    let help = command.get_after_help().map(ToString::to_string).unwrap_or_default();
    let (notes, examples) = help.split_once("Examples:\n").unwrap_or((&help, ""));
    let mut roff = Roff::new();
    if !notes.is_empty() {
        roff.control("SH", ["NOTES"]);
        for paragraph in notes.split("\n\n").filter(|text| !text.trim().is_empty()) {
            roff.control("PP", []);
            roff.text([roman(paragraph.split_whitespace().collect::<Vec<_>>().join(" "))]);
        }
    }
    roff.control("SH", ["EXAMPLES"]);
    roff.control("nf", []);
    examples.lines().for_each(|line| _ = roff.text([roman(line.trim_start())]));
    roff.control("fi", []);
    roff.to_writer(&mut page)?;
    man.render_version_section(&mut page)?;
    page.flush()?;
    Ok(page)
}
