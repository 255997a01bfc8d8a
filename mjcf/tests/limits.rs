//! What a text may cost: hostile ones are refused before they take memory, which is counted.

use std::alloc::System;
use std::sync::{Mutex, PoisonError};

use robohive_mjcf::diagnostic::Diagnostics;
use robohive_mjcf::{Loaded, Loader};
use stats_alloc::{INSTRUMENTED_SYSTEM, Region, StatsAlloc};

#[global_allocator]
static HEAP: &StatsAlloc<System> = &INSTRUMENTED_SYSTEM;

/// One test counts at a time: the heap is that of the process.
static COUNTING: Mutex<()> = Mutex::new(());

/// The outcome of a load and the bytes that it allocated in sum, given back or not.
fn counted(loader: &Loader, text: &str) -> (Result<Loaded, Diagnostics>, usize) {
    let _alone = COUNTING.lock().unwrap_or_else(PoisonError::into_inner);
    let region = Region::new(HEAP);
    let result = loader.load_str(text);
    let bytes = region.change().bytes_allocated;
    (result, bytes)
}

/// The findings about a text that is refused, and the bytes that the refusal allocated.
fn refused(text: &str) -> (String, usize) {
    let (result, bytes) = counted(&Loader::default(), text);
    let found = result.err().unwrap_or_else(|| panic!("accepted: {}", &text[..text.len().min(200)]));
    (found.to_string(), bytes)
}

#[test]
fn broken_texts_are_refused_before_a_tree_is_built() {
    let deep = format!("<mujoco>{}{}</mujoco>", "<body>".repeat(200_000), "</body>".repeat(200_000));
    let open = "<a>".repeat(200_000);
    let bomb = concat!(
        "<!DOCTYPE m [<!ENTITY a 'aaaaaaaaaa'><!ENTITY b '&a;&a;&a;&a;&a;&a;&a;&a;&a;&a;'>",
        "<!ENTITY c '&b;&b;&b;&b;&b;&b;&b;&b;&b;&b;'>]><mujoco model='&c;'/>"
    );
    let wide = format!("<mujoco {}/>", (0..100_000).map(|i| format!("a{i}='' ")).collect::<String>());
    let cases = [
        (deep.as_str(), "elements are nested more than 200 deep"),
        (open.as_str(), "elements are nested more than 200 deep"),
        (bomb, "entity declarations are not supported"),
        (wide.as_str(), "attributes, more than the limit of 128"),
    ];
    for (text, expected) in cases {
        let (found, bytes) = refused(text);
        assert!(found.contains(expected), "{found}");
        // Copies of the text, and little else.
        assert!(bytes < 4 * text.len() + (1 << 20), "{expected}: {bytes} bytes");
    }
}

/// Names are compared only for the findings that are kept, up to a limit.
#[test]
fn many_misspelt_references_cost_no_more_than_few() {
    let count = 8000;
    let joint = |i| format!("<body><joint name='joint_{i:05}_elbow'/><geom size='1'/></body>");
    let motor = |i| format!("<motor joint='jiont_{i:05}_elbow'/>");
    let bodies: String = (0..count).map(joint).collect();
    let motors: String = (0..count).map(motor).collect();
    let text = format!("<mujoco><worldbody>{bodies}</worldbody><actuator>{motors}</actuator></mujoco>");
    let (found, _) = refused(&text);
    let first = "error: no joint is named 'jiont_00000_elbow'; did you mean 'joint_00000_elbow'?";
    assert!(found.lines().next().is_some_and(|line| line.ends_with(first)), "{found}");
    assert!(found.ends_with("7800 more not shown"), "{found}");
}
