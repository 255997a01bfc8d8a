//! The examples run, and stay small.

#[path = "../examples/embed.rs"]
mod embed;

#[test]
fn the_embedded_engine_runs_in_sixty_lines() {
    embed::main().unwrap();
    assert!(include_str!("../examples/embed.rs").lines().count() <= 60);
}
