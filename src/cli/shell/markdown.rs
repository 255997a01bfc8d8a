//! The help of all commands as one Markdown text, for documentation.

use clap::{Arg, ArgAction, Command};
use std::fmt::Write;

/// What `command` and its subcommands say of themselves: a heading each, usage, arguments, notes and examples.
pub fn markdown(command: &Command) -> String {
    let mut text = String::new();
    // Writing to a String cannot fail.
    for command in command.get_subcommands().flat_map(with_subcommands) {
        let _ = page(&mut text, command);
    }
    text
}

/// A command, its subcommands, and theirs.
pub fn with_subcommands(command: &Command) -> Vec<&Command> {
    std::iter::once(command).chain(command.get_subcommands().flat_map(with_subcommands)).collect()
}

fn page(out: &mut String, command: &Command) -> std::fmt::Result {
    let usage = command.clone().render_usage().to_string();
    let usage = usage.trim_start_matches("Usage: ");
    let name = usage.split_whitespace().take_while(|word| !word.starts_with(['[', '<', '-']));
    writeln!(out, "## {}\n", name.collect::<Vec<_>>().join(" "))?;
    if let Some(about) = command.get_long_about().or(command.get_about()) {
        writeln!(out, "{}.\n", escaped(about.to_string().trim_end_matches('.')))?;
    }
    writeln!(out, "```text\n{usage}\n```\n")?;
    let arguments: Vec<&Arg> =
        command.get_arguments().filter(|a| !a.is_hide_set() && a.get_id() != "help").collect();
    if !arguments.is_empty() {
        writeln!(out, "| argument | meaning |\n|---|---|")?;
        arguments.iter().try_for_each(|argument| row(out, argument))?;
        writeln!(out)?;
    }
    let help = command.get_after_help().map(ToString::to_string).unwrap_or_default();
    let (notes, examples) = help.split_once("Examples:\n").unwrap_or((&help, ""));
    for paragraph in notes.split("\n\n").filter(|text| !text.trim().is_empty()) {
        writeln!(out, "{}\n", escaped(&paragraph.split_whitespace().collect::<Vec<_>>().join(" ")))?;
    }
    if examples.is_empty() {
        return Ok(());
    }
    writeln!(out, "```text\n{}\n```\n", examples.lines().map(str::trim).collect::<Vec<_>>().join("\n"))
}

/// An argument with its meaning, its possible values and its default.
fn row(out: &mut String, argument: &Arg) -> std::fmt::Result {
    let names =
        [argument.get_short().map(|c| format!("-{c}")), argument.get_long().map(|name| format!("--{name}"))];
    let mut words: Vec<String> = names.into_iter().flatten().collect();
    if argument.get_action().takes_values() {
        let names = argument.get_value_names().unwrap_or_default();
        let names = names.iter().map(|name| name.as_str()).collect::<Vec<_>>().join(" ");
        let values = if names.is_empty() { argument.get_id().as_str().to_uppercase() } else { names };
        match words.last_mut() {
            Some(last) => *last = format!("{last} {values}"),
            None => words.push(values),
        }
    }
    let help = argument.get_long_help().or(argument.get_help()).map(ToString::to_string).unwrap_or_default();
    let mut meaning = escaped(&help.split_whitespace().collect::<Vec<_>>().join(" "));
    let possible: Vec<_> =
        argument.get_possible_values().iter().map(|value| format!("`{}`", value.get_name())).collect();
    if !possible.is_empty() && !matches!(argument.get_action(), ArgAction::SetTrue | ArgAction::SetFalse) {
        meaning += &format!(". One of {}", possible.join(", "));
    }
    let defaults: Vec<_> =
        argument.get_default_values().iter().map(|value| format!("`{}`", value.display())).collect();
    if !defaults.is_empty() && argument.get_action().takes_values() {
        meaning += &format!(". Default {}", defaults.join(", "));
    }
    let more = if matches!(argument.get_action(), ArgAction::Append) { "…" } else { "" };
    writeln!(out, "| `{}`{more} | {meaning} |", words.join("`, `").replace('|', "\\|"))
}

/// Text whose marks are no Markdown, but for code between backticks.
fn escaped(text: &str) -> String {
    let (mut out, mut is_code) = (String::new(), false);
    for c in text.chars() {
        is_code ^= c == '`';
        if c == '|' || !is_code && matches!(c, '<' | '*' | '_') {
            out.push('\\');
        }
        out.push(c);
    }
    out
}
