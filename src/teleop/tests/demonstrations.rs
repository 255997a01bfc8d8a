//! The scripted person of the example solves its tasks by the bytes of devices, and what was recorded is replayed to the last bit.

#![cfg(unix)]

#[path = "../examples/demonstrations/person.rs"]
mod person;
#[path = "../examples/demonstrations/scene.rs"]
mod scene;
#[path = "../examples/demonstrations/speaker.rs"]
mod speaker;
#[path = "../examples/demonstrations/trial.rs"]
mod trial;

use scene::TASKS;
use speaker::Speaker;
use trial::demonstrate;

#[test]
fn tasks_are_solved_by_the_bytes_of_keys_and_of_a_pad() {
    for task in TASKS {
        for speaker in [Speaker::Keys, Speaker::Pad] {
            let outcome = demonstrate(task, speaker, 3, &env::Options::default()).unwrap();
            println!("{outcome}");
            assert!(outcome.succeeded >= 2, "{outcome}");
            assert_eq!(outcome.replayed, outcome.succeeded, "{outcome}");
        }
    }
}
