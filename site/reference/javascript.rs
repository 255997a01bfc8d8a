//! The JavaScript interface, from the types of the npm package.

use super::plain;
use std::fmt::Write;
use std::path::PathBuf;

/// What only the module's script itself calls.
const INTERNAL: [&str; 8] = [
    "free(",
    "[Symbol.dispose]",
    "private constructor",
    "initSync",
    "__wbg",
    "InitOutput",
    "global {",
    "HTMLElementTagNameMap",
];

/// A declaration with its comment.
struct Declaration {
    comment: String,
    code: String,
}

/// Classes and functions of files of types: a heading for each file, class and function, a row a member.
///
/// # Errors
/// A file cannot be read.
pub fn javascript(files: &[PathBuf]) -> Result<String, String> {
    let mut text = String::new();
    for file in files {
        let content =
            std::fs::read_to_string(file).map_err(|error| format!("{}: {error}", file.display()))?;
        let name =
            file.file_name().map_or(String::new(), |name| name.to_string_lossy().replace(".d.ts", ".js"));
        text += &listed(&name, &content);
    }
    Ok(text)
}

/// One file of types.
fn listed(name: &str, content: &str) -> String {
    let mut text = String::new();
    // Writing to a String cannot fail.
    let _ = writeln!(text, "## `{name}`\n");
    let mut inside = false;
    for Declaration { comment, code } in declarations(content) {
        let code =
            code.trim_start_matches("export ").trim_start_matches("default ").trim_start_matches("declare ");
        if INTERNAL.iter().any(|word| code.contains(word))
            || code.starts_with("import ")
            || code.starts_with("type ")
        {
            continue;
        }
        if code == "}" {
            inside = false;
        } else if let Some(class) = code.strip_suffix('{') {
            inside = true;
            let _ = writeln!(text, "### {}\n\n{}\n", plain(class.trim()), paragraphs(&comment));
        } else if inside {
            let _ = writeln!(text, "```ts\n{code}\n```\n\n{}\n", paragraphs(&comment));
        } else if let Some(function) = code.strip_prefix("function ") {
            let title = function.split(['(', '<']).next().unwrap_or_default();
            let _ =
                writeln!(text, "### function {title}\n\n```ts\n{code}\n```\n\n{}\n", paragraphs(&comment));
        }
    }
    text
}

/// A comment as Markdown: headings of Rust's documentation become words in bold.
fn paragraphs(comment: &str) -> String {
    let line = |line: &str| match line.strip_prefix("# ") {
        Some(title) => format!("**{title}**\n"),
        None => line.replace('<', "&lt;"),
    };
    comment.lines().map(line).collect::<Vec<_>>().join("\n")
}

/// Declarations of a file of types: each a line, or several up to its semicolon, opening or closing brace.
fn declarations(text: &str) -> Vec<Declaration> {
    let (mut found, mut comment, mut code) = (Vec::new(), String::new(), String::new());
    let mut in_comment = false;
    for line in text.lines().map(str::trim) {
        if line.starts_with("/*") || in_comment {
            if line.starts_with("/*") {
                comment.clear();
            }
            in_comment = !line.ends_with("*/");
            let words = line.trim_start_matches("/**").trim_start_matches("/*").trim_end_matches("*/");
            let words = words.strip_prefix('*').unwrap_or(words).trim();
            comment += &format!("{words}\n");
            continue;
        }
        if line.starts_with("//") || line.is_empty() {
            continue;
        }
        code += if code.is_empty() { "" } else { " " };
        code += line;
        if code.ends_with([';', '{', '}']) {
            found.push(Declaration { comment: comment.trim().to_owned(), code: code.clone() });
            comment.clear();
            code.clear();
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn classes_members_and_functions_are_listed() {
        let types = "/* eslint */\n/**\n * A thing.\n *\n * # Errors\n * None.\n */\nexport class Thing {\n  free(): void;\n\
                     \x20 /** Goes. */\n  go(steps: number): void;\n}\n/** Makes it. */\nexport function make(): Thing;\n\
                     export interface InitOutput {\n  memory: Memory;\n}\n";
        let text = listed("a.js", types);
        for part in [
            "### class Thing",
            "A thing.",
            "**Errors**",
            "go(steps: number): void;",
            "Goes.",
            "### function make",
            "Makes it.",
        ] {
            assert!(text.contains(part), "{part} in {text}");
        }
        assert!(!text.contains("free") && !text.contains("eslint"), "{text}");
    }
}
