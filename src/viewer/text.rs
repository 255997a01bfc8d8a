//! States and cameras as MJCF, to be pasted into a model.

use physics::math::{Vec3, cross};
use physics::table::Slice;
use physics::{Data, Model};
use render::View;
use std::fmt::Write;

/// The present state as an element of `<keyframe>`. With `exact`, every number is read back as the same bits.
pub fn key(model: &Model, data: &Data, exact: bool) -> String {
    let state = &data.state;
    let mut text = format!("<key time=\"{}\"", number(state.time, exact));
    let mut attribute = |name: &str, values: &[f64]| {
        if !values.is_empty() {
            let numbers: Vec<String> = values.iter().map(|&x| number(x, exact)).collect();
            let _ = write!(text, " {name}=\"{}\"", numbers.join(" "));
        }
    };
    attribute("qpos", &state.qpos);
    attribute("qvel", &state.qvel);
    attribute("act", &state.act);
    attribute("ctrl", &state.ctrl);
    if model.nmocap > 0 {
        attribute("mpos", state.mocap_pos.as_flattened());
        attribute("mquat", state.mocap_quat.as_flattened());
    }
    text + "/>"
}

/// What a view shows as an element `<camera>` of the world.
pub fn camera(view: &View) -> String {
    let right = cross(view.forward, view.up);
    let join = |v: Vec3| v.map(|x| number(x, false)).join(" ");
    format!("<camera pos=\"{}\" xyaxes=\"{} {}\"/>", join(view.eye), join(right), join(view.up))
}

/// A number in six digits.
pub fn short(x: f64) -> String {
    number(x, false)
}

/// A number in six digits, or in as many as it takes.
fn number(x: f64, exact: bool) -> String {
    if exact || x == 0.0 {
        return format!("{}", x + 0.0);
    }
    let magnitude = x.abs().log10().floor();
    if !(-5.0..6.0).contains(&magnitude) {
        let text = format!("{x:.5e}");
        let (mantissa, exponent) = text.split_once('e').unwrap_or((&text, "0"));
        return format!("{}e{exponent}", trimmed(mantissa));
    }
    trimmed(&format!("{x:.*}", (5.0 - magnitude) as usize)).to_owned()
}

/// Without the zeros that end a fraction.
fn trimmed(text: &str) -> &str {
    if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.') } else { text }
}

/// Every array of a simulation by its name, row by row, for people to read: what a file is written with.
pub fn arrays(model: &Model, data: Option<&Data>) -> String {
    let mut text = String::new();
    let mut add = |name: &str, shape: Vec<usize>, values: Slice<'_>| {
        let axes: Vec<String> = shape.iter().map(usize::to_string).collect();
        let _ = writeln!(text, "{name} [{}]", axes.join(" x "));
        let width = shape.iter().skip(1).product::<usize>().max(1);
        for row in values.to_f64().chunks(width) {
            let numbers: Vec<String> = row.iter().map(|&x| number(x, false)).collect();
            let _ = writeln!(text, "  {}", numbers.join(" "));
        }
    };
    match data {
        Some(data) => data.visit(model, &mut add),
        None => model.visit(&mut add),
    }
    text
}
