//! Paths that others chose: in archives and in the registry.

use crate::limits::{Exceeded, Limits};

/// Why a path is refused.
#[derive(Debug, PartialEq, Eq)]
pub(crate) enum BadPath {
    /// What is wrong with it.
    Refused(String),
    /// It is too long or too deep.
    Exceeded(Exceeded),
}

/// The path of an archive entry, without `.` and doubled slashes; empty for the top folder.
pub(crate) fn entry(raw: &[u8], limits: &Limits) -> Result<String, BadPath> {
    let refused = |reason: &str| Err(BadPath::Refused(reason.to_owned()));
    let Ok(text) = std::str::from_utf8(raw) else {
        return refused("its path is not UTF-8");
    };
    if text.starts_with('/') {
        return refused("its path is absolute");
    }
    if text.len() as u64 > limits.path {
        return Err(BadPath::Exceeded(Exceeded { limit: "path", value: limits.path }));
    }
    let parts: Vec<&str> = text.split('/').filter(|part| !matches!(*part, "" | ".")).collect();
    if parts.contains(&"..") {
        return refused("its path leads upwards with `..`");
    }
    if parts.len() as u64 > limits.depth {
        return Err(BadPath::Exceeded(Exceeded { limit: "depth", value: limits.depth }));
    }
    Ok(parts.join("/"))
}

/// What keeps a path from being created on every system, if anything.
pub(crate) fn unportable(path: &str) -> Option<String> {
    let bad = |c: char| c.is_control() || r#"\:*?"<>|"#.contains(c);
    if let Some(c) = path.chars().find(|&c| bad(c)) {
        return Some(format!("its path holds {c:?}, which file names cannot have on every system"));
    }
    let part = path.split('/').find(|part| part.len() > 255 || part.ends_with(['.', ' ']))?;
    Some(format!("its path holds {part:?}, which no file can be called on every system"))
}

/// A path of the registry with `.` and `folder/..` folded; it must lie in `envs/` or `simhive/`.
pub(crate) fn fold(path: &str) -> Result<String, &'static str> {
    let mut parts: Vec<&str> = Vec::new();
    for part in path.split('/') {
        match part {
            "" | "." => {}
            ".." => _ = parts.pop().ok_or("it leads out of the store")?,
            part => parts.push(part),
        }
    }
    if path.starts_with('/') || path.contains('\\') {
        return Err("it is absolute or has backslashes");
    }
    match parts[..] {
        ["envs" | "simhive", _, ..] => Ok(parts.join("/")),
        _ => Err("it names no file in these folders"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn entries_are_normalised_or_refused() {
        let limits = Limits::default().with_path(20).with_depth(3);
        let path = |raw: &[u8]| entry(raw, &limits);
        assert_eq!(path(b"./a//b/"), Ok("a/b".into()));
        assert_eq!(path(b"./"), Ok(String::new()));
        assert_eq!(path(b"a..b/...c"), Ok("a..b/...c".into()));
        for raw in [&b"../a"[..], b"a/../b", b"/etc/passwd", b"a/\xff", b".."] {
            assert!(matches!(path(raw), Err(BadPath::Refused(_))), "{raw:?}");
        }
        let limit = |raw: &[u8]| match path(raw) {
            Err(BadPath::Exceeded(exceeded)) => exceeded.limit,
            other => panic!("{other:?}"),
        };
        assert_eq!((limit(b"a/b/c/d"), limit(b"aaaaaaaaaaaaaaaaaaaaa")), ("depth", "path"));
    }

    #[test]
    fn names_that_some_system_cannot_have_are_found() {
        assert_eq!(unportable("simhive/YCB_sim/a b (1).xml"), None);
        for path in ["a\\b", "c:a", "a\u{7}", "a\n", "dir./a", "a ", "a?"] {
            assert!(unportable(path).is_some(), "{path:?}");
        }
        assert!(unportable(&format!("a/{}", "x".repeat(256))).is_some());
    }

    #[test]
    fn registry_paths_are_folded() {
        let path = "envs/multi_task/substeps1/../common/kitchen/franka_kitchen.xml";
        assert_eq!(fold(path), Ok("envs/multi_task/common/kitchen/franka_kitchen.xml".into()));
        for path in ["envs/../../a", "/envs/a", "envs", "other/a", "", "envs/../other/a", "envs\\a"] {
            assert!(fold(path).is_err(), "{path:?}");
        }
    }
}
