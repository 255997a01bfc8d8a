//! Pages: Markdown of the repository, read into what the site shows and the blocks that are checked.

use crate::block::{Block, Marks, shown_and_hidden};
use crate::include::included;
use crate::link::Links;
use std::collections::BTreeMap;
use std::path::Path;

/// Texts that are made from the code, by the names under which pages ask for them: `{{generated NAME}}` on a line.
pub type Generated = BTreeMap<String, String>;

/// A page that was read.
#[derive(Debug)]
pub struct Page {
    /// What the site shows, in Markdown.
    pub text: String,
    /// Its code blocks.
    pub blocks: Vec<Block>,
}

/// A block that is being read.
struct Open {
    fence: String,
    line: usize,
    info: String,
    lines: Vec<String>,
    marks: Marks,
}

/// Reads the file `source` of the repository at `root`. `excuse` is why none of its blocks is run, where none is.
///
/// # Errors
/// What is wrong, with file and line: a link that leads nowhere, an include without a file, a block without a language.
pub fn read(
    root: &Path,
    source: &str,
    excuse: Option<&str>,
    links: &Links,
    generated: &Generated,
) -> Result<Page, String> {
    let text = std::fs::read_to_string(root.join(source)).map_err(|error| format!("{source}: {error}"))?;
    let mut page = Page { text: String::new(), blocks: Vec::new() };
    let (mut open, mut marks): (Option<Open>, Marks) = (None, Marks::default());
    for (number, line) in text.lines().enumerate() {
        let place = |error: String| format!("{source}:{}: {error}", number + 1);
        if let Some(block) = &mut open {
            if line.trim() == block.fence {
                let block = open.take().ok_or("a block is open")?;
                close(root, source, excuse, block, &mut page)?;
            } else {
                block.lines.push(line.to_owned());
            }
        } else if let Some(info) = line.trim_start().strip_prefix("```") {
            let fence = format!("```{}", "`".repeat(info.len() - info.trim_start_matches('`').len()));
            let info = info.trim_start_matches('`').trim().to_owned();
            let marks = std::mem::take(&mut marks);
            open = Some(Open { fence, line: number + 1, info, lines: Vec::new(), marks });
        } else if marks.take(line) {
        } else if let Some(name) = line.strip_prefix("{{generated ").and_then(|rest| rest.strip_suffix("}}"))
        {
            let text =
                generated.get(name).ok_or_else(|| place(format!("nothing generated is called {name:?}")))?;
            page.text += text;
        } else {
            if !line.trim().is_empty() && !marks.are_empty() {
                return Err(place("a mark stands before no block".into()));
            }
            page.text += &links.rewritten(source, line).map_err(place)?;
            page.text.push('\n');
        }
    }
    match open {
        Some(block) => Err(format!("{source}:{}: the block has no end", block.line)),
        None => Ok(page),
    }
}

/// Ends a block: what it includes is put in, and it is written to the page.
fn close(root: &Path, source: &str, excuse: Option<&str>, open: Open, page: &mut Page) -> Result<(), String> {
    let place = format!("{source}:{}", open.line);
    let (text, file) = match &open.lines[..] {
        [line] if line.trim().starts_with("{{#include ") => {
            let (text, file) =
                included(root, source, line.trim()).map_err(|error| format!("{place}: {error}"))?;
            (text, Some(file))
        }
        lines => (lines.join("\n") + "\n", None),
    };
    page.text += &format!("{}{}\n{text}{}\n", open.fence, open.info, open.fence);
    let language = open.info.split([',', ' ']).next().unwrap_or_default().to_owned();
    let mut marks = open.marks;
    if language.is_empty() {
        return Err(format!("{place}: a block without a language: say ```text where it is none"));
    }
    marks.not_run = marks.not_run.or(excuse.map(str::to_owned));
    page.blocks.push(Block { place, language, text: shown_and_hidden(&text), included: file, marks });
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn page(name: &str, text: &str) -> Result<Page, String> {
        let root = std::env::temp_dir().join(format!("robohive-site-{}-{name}", std::process::id()));
        std::fs::create_dir_all(root.join("code")).unwrap();
        std::fs::write(root.join("page.md"), text).unwrap();
        std::fs::write(root.join("code/a.py"), "x = 1\n# ANCHOR: part\n  y = 2\n# ANCHOR_END: part\n")
            .unwrap();
        let generated = Generated::from([("table".to_owned(), "| made |\n".to_owned())]);
        let page = read(&root, "page.md", None, &Links::new(root.clone(), BTreeMap::new()), &generated);
        std::fs::remove_dir_all(root).unwrap();
        page
    }

    #[test]
    fn blocks_are_found_with_marks_and_includes() {
        let text = "# A\n\n<!-- fails -->\n```sh\nfalse\n```\n{{generated table}}\n```python\n{{#include code/a.py:part}}\n```\n";
        let page = page("blocks", text).unwrap();
        assert_eq!(page.text, "# A\n\n```sh\nfalse\n```\n| made |\n```python\ny = 2\n```\n");
        let [shell, python] = &page.blocks[..] else { panic!("{:?}", page.blocks) };
        assert!(shell.marks.fails && shell.place == "page.md:4" && shell.language == "sh");
        assert_eq!((python.included.as_deref(), &*python.text), (Some("code/a.py"), "y = 2\n"));
    }

    #[test]
    fn mistakes_are_named_with_their_lines() {
        for (text, expected) in [
            ("a\n```\nb\n```\n", "page.md:2: a block without a language"),
            ("```sh\n", "page.md:1: the block has no end"),
            ("<!-- fails -->\ntext\n", "page.md:2: a mark stands before no block"),
            ("{{generated nothing}}\n", "page.md:1: nothing generated"),
            ("```sh\n{{#include code/none.py}}\n```\n", "page.md:1: code/none.py"),
            ("```sh\n{{#include code/a.py:none}}\n```\n", "no anchor"),
            ("[a](nowhere.md)\n", "page.md:1: nowhere.md"),
        ] {
            let error = page("mistakes", text).unwrap_err();
            assert!(error.contains(expected), "{error}");
        }
    }
}
