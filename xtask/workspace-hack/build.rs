//! Does nothing: without it cargo resolves no dependencies of build scripts, whose features count as well.

fn main() {}
