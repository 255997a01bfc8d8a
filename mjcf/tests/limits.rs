//! What a text may cost: hostile ones are refused before they take memory, which is counted.

use std::alloc::System;
use std::sync::{Mutex, MutexGuard, PoisonError};

use robohive_mjcf::diagnostic::Diagnostics;
use robohive_mjcf::{Limits, Loaded, Loader};
use stats_alloc::{INSTRUMENTED_SYSTEM, Region, StatsAlloc};

#[global_allocator]
static HEAP: &StatsAlloc<System> = &INSTRUMENTED_SYSTEM;

/// One test runs at a time: all share the heap of the process.
fn alone() -> MutexGuard<'static, ()> {
    static RUNNING: Mutex<()> = Mutex::new(());
    RUNNING.lock().unwrap_or_else(PoisonError::into_inner)
}

/// The outcome of a load and the bytes that it allocated in sum, given back or not.
fn counted(loader: &Loader, text: &str) -> (Result<Loaded, Diagnostics>, usize) {
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
    let _alone = alone();
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
    let _alone = alone();
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

/// A few words may not ask for all memory: each text is refused where the budget is passed, before it is taken.
#[test]
fn memory_is_counted_before_it_is_taken() {
    let _alone = alone();
    let bodies = |count: usize| {
        let body = "<body><freejoint/><geom size='1'/></body>";
        format!("<worldbody><replicate count='{count}' offset='3 0 0'>{body}</replicate></worldbody>")
    };
    let model = |content: &str| format!("<mujoco>\n{content}\n</mujoco>");
    let assets = |asset: &str| model(&format!("<asset>\n{}</asset>", asset.repeat(10)));
    let keys = format!("{}\n<keyframe>{}</keyframe>", bodies(1000), "<key/>".repeat(38_000));
    let sensors = "<clock/><framepos objtype='site' objname='s'/>".repeat(100);
    let sites = "<worldbody><replicate count='100000'><site name='s'/></replicate></worldbody>";
    // Every leaf moves with every joint of the chain.
    let joints = "<joint axis='1 0 0'/><joint axis='0 1 0'/><joint axis='0 0 1'/><geom size='.1'/>";
    let leaves = format!("<replicate count='20000' offset='1 0 0'><body>{joints}</body></replicate>");
    let chain = format!("<body>{joints}").repeat(150) + &leaves + &"</body>".repeat(150);
    let cases = [
        (model(&keys), "<text>:3:121145: ", "38000 keyframes: needs 3953 MB"),
        (model("<size nkey='2000000000'/>"), "<text>:2:1: ", "2000000000 keyframes: needs "),
        (
            model("<asset><hfield name='h' nrow='32000' ncol='32000' size='1 1 1 1'/></asset>"),
            "<text>:2:8: ",
            "height field of 32000 x 32000 points: needs 8192 MB",
        ),
        (assets("<hfield nrow='10000' ncol='10000' size='1 1 1 1'/>"), "<text>:3:101: ", "needs 800 MB"),
        (
            assets("<texture type='2d' builtin='flat' width='9000' height='9000'/>"),
            "<text>:3:",
            "needs 486 MB",
        ),
        (
            assets("<mesh builtin='plate' params='9999 9999'/>"),
            "<text>:3:1: ",
            "built-in mesh: needs 99981 MB",
        ),
        (
            model(&format!("{sites}<sensor>{sensors}</sensor>")),
            "<text>:2:12: ",
            "refers into <replicate>: needs",
        ),
        (
            model(&format!("<worldbody>{}</worldbody>", "<geom size='1'/>".repeat(2_000_000))),
            "<text>:2:",
            "elements of the text",
        ),
        (
            model(&format!("<worldbody>{chain}</worldbody>")),
            "",
            "patterns of the inertia, tendons and actuators: needs",
        ),
    ];
    for (text, place, expected) in cases {
        let (found, bytes) = refused(&text);
        let first = found.lines().next().unwrap_or_default();
        assert!(first.starts_with(place) && first.contains(expected), "{expected}: {first}");
        assert!(
            first.contains("more than the budget of 2147 MB") && first.contains("raise `memory`"),
            "{first}"
        );
        assert!(bytes < 1 << 30, "{expected}: {bytes} bytes");
    }
}

#[test]
fn the_budget_can_be_raised_and_lowered() {
    let _alone = alone();
    let text = "<mujoco><worldbody><replicate count='2000' offset='3 0 0'><geom size='1'/></replicate></worldbody></mujoco>";
    let within = |memory: usize| {
        let limits = Limits::default().with_memory(memory);
        counted(&Loader::default().limits(limits), text)
    };
    let (refusal, bytes) = within(1_000_000);
    let found = refusal.map(|loaded| loaded.model.ngeom).expect_err("refused").to_string();
    let expected = "<text>:1:20: error: 2000 copies of <replicate>: needs 5 MB of memory, 5 MB with what stands before, \
                    more than the budget of 1 MB; if it is meant, raise `memory` in the limits of the `Loader`, or give \
                    the command `--memory`";
    assert_eq!(found, expected);
    assert!(bytes < 200_000, "{bytes} bytes");
    let (refusal, _) = within(5_000_000);
    let found = refusal.map(|loaded| loaded.model.ngeom).expect_err("refused").to_string();
    assert!(found.starts_with("<text>:1:59: error: 2000 geoms: needs 2 MB"), "{found}");
    assert_eq!(within(20_000_000).0.map(|loaded| loaded.model.ngeom).ok(), Some(2000));
}
