//! How much memory there is, where the system tells, and how much of it simulations take.

use physics::{Data, Model};
use std::fs::read_to_string;

/// Memory of this process that is in use (Linux).
pub fn resident_bytes() -> Option<usize> {
    kib(&read_to_string("/proc/self/status").ok()?, "VmRSS:")
}

/// Memory that new data can take before the system runs short (Linux), or the group of processes meets its limit.
pub fn free_bytes() -> Option<usize> {
    let free = kib(&read_to_string("/proc/meminfo").ok()?, "MemAvailable:")?;
    let number =
        |name: &str| read_to_string(format!("/sys/fs/cgroup/memory.{name}")).ok()?.trim().parse().ok();
    let group =
        number("max").zip(number("current")).map(|(most, now): (usize, usize)| most.saturating_sub(now));
    Some(free.min(group.unwrap_or(usize::MAX)))
}

/// The number of KiB behind a label, in bytes.
fn kib(text: &str, label: &str) -> Option<usize> {
    let line = text.lines().find_map(|line| line.strip_prefix(label))?;
    line.trim().strip_suffix(" kB")?.parse::<usize>().ok()?.checked_mul(1024)
}

/// Bytes of one simulation: its arrays, and as much again for contacts, their rows and working memory.
pub fn environment_bytes(m: &Model, d: &Data) -> usize {
    let mut bytes = size_of::<Data>();
    d.visit(m, &mut |_, _, values| values.pieces(&mut |piece| bytes += piece.len()));
    2 * bytes
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn labels_are_found_with_their_unit() {
        let text = "MemTotal:       16 kB\nMemAvailable:    3 kB\n";
        assert_eq!(kib(text, "MemAvailable:"), Some(3072));
        assert_eq!(kib(text, "Missing:"), None);
    }
}
