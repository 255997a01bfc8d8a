//! What to write instead of a name that does not exist: the nearest of the names that do.

/// Names compared by one `Suggestions`. Findings beyond it come without advice, so that many of them over many names
/// cannot make a program slow.
const MAX_COMPARED: usize = 1 << 22;

/// Longest misspelt name that is compared, in bytes.
const MAX_WORD: usize = 64;

/// Bytes that a lower-case character takes at most, relative to the character it comes from.
const MAX_BYTES: usize = 4;

/// Finds the nearest names and counts the names compared.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Suggestions {
    compared: usize,
}

impl Suggestions {
    /// The candidate nearest to `word`, the first of several, when near enough to be a misspelling
    /// (Levenshtein distance, letters compared in lower case).
    pub fn nearest<'a>(&mut self, word: &str, candidates: impl Iterator<Item = &'a str>) -> Option<&'a str> {
        if word.len() > MAX_WORD {
            return None;
        }
        let word: Vec<char> = word.chars().collect();
        let mut limit = (word.len() / 3).clamp(1, 3);
        let word: Vec<char> = word.into_iter().flat_map(char::to_lowercase).collect();
        let (mut letters, mut row) = (Vec::new(), Vec::new());
        let mut found = None;
        for candidate in candidates {
            if self.compared == MAX_COMPARED {
                return None;
            }
            self.compared += 1;
            if candidate.len() / MAX_BYTES > word.len() + limit {
                continue;
            }
            letters.clear();
            letters.extend(candidate.chars().flat_map(char::to_lowercase));
            match distance_within(&word, &letters, limit, &mut row) {
                Some(0) => return Some(candidate),
                // From here on only a nearer one counts.
                Some(distance) => (found, limit) = (Some(candidate), distance - 1),
                None => {}
            }
        }
        found
    }
}

/// Insertions, removals and replacements that turn `a` into `b`, if at most `limit`; `row` is working memory.
fn distance_within(a: &[char], b: &[char], limit: usize, row: &mut Vec<usize>) -> Option<usize> {
    if a.len().abs_diff(b.len()) > limit {
        return None;
    }
    row.clear();
    row.extend(0..=b.len());
    for (i, letter) in a.iter().enumerate() {
        let mut diagonal = std::mem::replace(&mut row[0], i + 1);
        let mut least = i + 1;
        for (j, other) in b.iter().enumerate() {
            let replaced = diagonal + usize::from(letter != other);
            diagonal = row[j + 1];
            row[j + 1] = replaced.min(diagonal + 1).min(row[j] + 1);
            least = least.min(row[j + 1]);
        }
        if least > limit {
            return None;
        }
    }
    Some(row[b.len()]).filter(|&distance| distance <= limit)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn nearest<'a>(word: &str, names: &[&'a str]) -> Option<&'a str> {
        Suggestions::default().nearest(word, names.iter().copied())
    }

    #[test]
    fn the_first_of_the_nearest_names_is_suggested() {
        assert_eq!(nearest("elbov", &["shoulder", "elbows", "elbow", "elbox"]), Some("elbow"));
        assert_eq!(nearest("elbov", &["elbows", "elboww"]), None);
        assert_eq!(nearest("ELBOW", &["shoulder", "elbow"]), Some("elbow"));
        assert_eq!(nearest("masss", &["mass", "masse"]), Some("mass"));
        assert_eq!(nearest("", &["a", "ab"]), Some("a"));
        assert_eq!(nearest("über", &["uber", "aber"]), Some("uber"));
        assert_eq!(nearest(&"x".repeat(65), &[&"x".repeat(64)]), None);
    }

    #[test]
    fn names_compared_are_bounded_in_sum() {
        let mut suggestions = Suggestions::default();
        let names = || std::iter::repeat_n("x", MAX_COMPARED - 1).chain(["joint"]);
        assert_eq!(suggestions.nearest("jont", names()), Some("joint"));
        assert_eq!(suggestions.nearest("jont", names()), None);
        assert_eq!(suggestions.compared, MAX_COMPARED);
    }
}
