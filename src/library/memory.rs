//! How much memory there is, where the system tells, and whether many environments fit.
//!
//! ```
//! use robohive_library::memory::check_room;
//!
//! assert!(check_room(4, 1 << 20).is_ok());
//! # if robohive_library::memory::free_bytes().is_some() {
//! assert!(check_room(1_000_000_000, 1 << 20).is_err_and(|refused| refused.fitting() < 1_000_000_000));
//! # }
//! ```

use std::fmt;
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

/// More environments than memory has room for.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct NoRoom {
    count: usize,
    /// Of one.
    bytes: usize,
    free: usize,
}

impl NoRoom {
    /// How many there is room for.
    pub fn fitting(&self) -> usize {
        self.free / self.bytes.max(1)
    }
}

impl fmt::Display for NoRoom {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mib = |bytes: usize| bytes.div_ceil(1 << 20);
        let needed = mib(self.count.saturating_mul(self.bytes));
        write!(f, "{} environments need about {needed} MiB, {} MiB are free", self.count, mib(self.free))
    }
}

impl std::error::Error for NoRoom {}

/// Counts before anything is made: what does not fit would be ended by the system, without a word.
///
/// # Errors
/// `count` environments of `bytes` each do not fit in the free memory, where that is known.
pub fn check_room(count: usize, bytes: usize) -> Result<(), NoRoom> {
    match free_bytes() {
        Some(free) if count.saturating_mul(bytes) > free => Err(NoRoom { count, bytes, free }),
        _ => Ok(()),
    }
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

    #[test]
    fn what_does_not_fit_says_how_many_do() {
        let refused = NoRoom { count: 1_000_000_000, bytes: 3 << 20, free: 10 << 20 };
        assert_eq!(refused.fitting(), 3);
        assert_eq!(refused.to_string(), "1000000000 environments need about 3000000000 MiB, 10 MiB are free");
        assert!(free_bytes().is_none_or(|_| check_room(usize::MAX, 1).is_err()));
        assert!(check_room(1, 1).is_ok());
    }
}
