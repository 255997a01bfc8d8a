//! The shader is sound, with or without a GPU.

use wgpu::naga::front::wgsl;
use wgpu::naga::valid::{Capabilities, ValidationFlags, Validator};

#[test]
fn the_shader_is_valid() {
    let text = include_str!("../shader.wgsl");
    let module = wgsl::parse_str(text).unwrap_or_else(|error| panic!("{}", error.emit_to_string(text)));
    // What every GPU offers, without optional features.
    let mut validator = Validator::new(ValidationFlags::all(), Capabilities::empty());
    validator.validate(&module).unwrap_or_else(|error| panic!("{}", error.emit_to_string(text)));
    assert!(module.entry_points.len() >= 16, "entry points: {}", module.entry_points.len());
}
