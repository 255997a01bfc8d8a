//! Code blocks of pages, and what comments before them say of how they are checked.

/// What stands before a block in comments.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Marks {
    /// Why it is not run.
    pub not_run: Option<String>,
    /// It is to fail.
    pub fails: bool,
    /// It is what the block before printed.
    pub output: bool,
    /// It is a file of this name, which later blocks of the page find.
    pub file: Option<String>,
    /// Modules of Python that it imports and that few have.
    pub needs: Vec<String>,
}

impl Marks {
    /// Takes in what a line says, where it is a comment with a mark.
    pub fn take(&mut self, line: &str) -> bool {
        let Some(comment) = line.trim().strip_prefix("<!--").and_then(|rest| rest.strip_suffix("-->")) else {
            return false;
        };
        let (word, rest) = comment.split_once(':').unwrap_or((comment, ""));
        let rest = rest.trim();
        match (word.trim(), rest.is_empty()) {
            ("not run", false) => self.not_run = Some(rest.to_owned()),
            ("file", false) => self.file = Some(rest.to_owned()),
            ("needs", false) => self.needs = rest.split(',').map(|name| name.trim().to_owned()).collect(),
            ("fails", true) => self.fails = true,
            ("output", true) => self.output = true,
            _ => return false,
        }
        true
    }

    /// Whether nothing was said.
    pub fn are_empty(&self) -> bool {
        *self == Marks::default()
    }
}

/// A code block.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Block {
    /// File and line of its first fence, in the repository.
    pub place: String,
    /// The language, as in `python`.
    pub language: String,
    /// What it holds, without marks of lines that pages hide.
    pub text: String,
    /// The file of the repository that it was taken from.
    pub included: Option<String>,
    /// What comments say of it.
    pub marks: Marks,
}

/// The text as it is run: lines that pages hide begin with `~`.
pub fn shown_and_hidden(text: &str) -> String {
    let lines = text
        .lines()
        .map(|line| line.strip_prefix('~').map_or(line, |rest| rest.strip_prefix(' ').unwrap_or(rest)));
    lines.collect::<Vec<_>>().join("\n") + "\n"
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn comments_mark_blocks() {
        let mut marks = Marks::default();
        assert!(
            !marks.take("<!-- a table begins -->") && !marks.take("text") && !marks.take("<!-- not run: -->")
        );
        assert!(marks.are_empty());
        assert!(
            marks.take("<!-- not run: installs a program -->") && marks.take("  <!-- needs: ray, torch -->")
        );
        assert_eq!(marks.not_run.as_deref(), Some("installs a program"));
        assert_eq!(marks.needs, ["ray", "torch"]);
        assert_eq!(shown_and_hidden("~ import a\n~b\nc"), "import a\nb\nc\n");
    }
}
