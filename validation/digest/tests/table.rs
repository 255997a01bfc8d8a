//! The hashes of this build are the recorded ones, on any number of threads.

use robohive_digest::{MODELS, digest, recorded};

#[test]
fn final_states_are_the_recorded_ones() {
    let wrong: Vec<_> = MODELS
        .iter()
        .zip([1, 2, 4].into_iter().cycle())
        .filter_map(|(case, threads)| {
            let recorded = recorded(case.name).unwrap_or_else(|| panic!("no hash of {}", case.name));
            let hash = digest(case, threads).unwrap_or_else(|error| panic!("{error}"));
            (hash != recorded).then(|| format!("{} on {threads} threads", case.name))
        })
        .collect();
    assert!(wrong.is_empty(), "other hashes than in digests.txt: {}", wrong.join(", "));
}

#[test]
fn threads_do_not_change_the_hash() {
    for case in [&MODELS[2], &MODELS[4]] {
        let hashes = [1, 2, 4].map(|threads| digest(case, threads));
        assert!(hashes[0].is_ok() && hashes.iter().all(|h| *h == hashes[0]), "{}: {hashes:?}", case.name);
    }
}
