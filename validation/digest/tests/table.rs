//! The hashes of this build are the recorded ones, on any number of threads.

use robohive_digest::{hash, names, recorded};

#[test]
fn hashes_are_the_recorded_ones() {
    let wrong: Vec<_> = names()
        .enumerate()
        .zip([1, 2, 4].into_iter().cycle())
        .filter_map(|((number, name), threads)| {
            let recorded = recorded(name).unwrap_or_else(|| panic!("no hash of {name}"));
            let hash = hash(number, threads).unwrap_or_else(|error| panic!("{name}: {error}"));
            (hash != recorded).then(|| format!("{name} on {threads} threads"))
        })
        .collect();
    assert!(wrong.is_empty(), "other hashes than in digests.txt: {}", wrong.join(", "));
}

#[test]
fn threads_do_not_change_the_hash() {
    let chosen =
        ["quadruped", "pile", "gallery_colours", "gallery_one_sample", "workbench_colours", "yard_ids"];
    for (number, name) in names().enumerate().filter(|(_, name)| chosen.contains(name)) {
        let hashes = [1, 2, 3, 4].map(|threads| hash(number, threads));
        assert!(hashes[0].is_ok() && hashes.iter().all(|h| *h == hashes[0]), "{name}: {hashes:?}");
    }
}
