//! The `robohive` command.
fn main() {}
