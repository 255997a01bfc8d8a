//! Curves as SVG, without scripts.

use std::fmt::Write as _;

/// Size of a plot, and the room for its axes \[pixels\].
const SIZE: [f64; 2] = [640.0, 150.0];
const LEFT: f64 = 66.0;
const BOTTOM: f64 = 20.0;
const MARGIN: f64 = 8.0;
/// Points of a curve at most.
const POINTS: usize = 700;

/// A curve of a plot.
pub struct Curve<'a> {
    /// Its colour, as CSS has it.
    pub colour: &'a str,
    /// Its points.
    pub points: Vec<[f64; 2]>,
}

/// A plot of curves as an `svg` element, which is a file as well; points that are not finite are left out.
pub fn plot(curves: &[Curve<'_>]) -> String {
    let finite = |point: &&[f64; 2]| point[0].is_finite() && point[1].is_finite();
    let all: Vec<[f64; 2]> = curves.iter().flat_map(|c| c.points.iter().filter(finite).copied()).collect();
    if all.is_empty() {
        return "<p>nothing to show</p>".into();
    }
    let span = |axis: usize| {
        let low = all.iter().map(|p| p[axis]).fold(f64::INFINITY, f64::min);
        let high = all.iter().map(|p| p[axis]).fold(f64::NEG_INFINITY, f64::max);
        if high > low { [low, high] } else { [low - 0.5, high + 0.5] }
    };
    let ([left, right], [low, high]) = (span(0), span(1));
    let [width, height] = SIZE;
    let across = |x: f64| LEFT + (x - left) / (right - left) * (width - LEFT - MARGIN);
    let down = |y: f64| MARGIN + (high - y) / (high - low) * (height - MARGIN - BOTTOM);
    let foot = height - BOTTOM;
    let mut text = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" width=\"{width}\" role=\"img\"><path d=\"M{LEFT} {MARGIN}V{foot}H{}\" \
         fill=\"none\" stroke=\"#999\"/>",
        width - MARGIN
    );
    for (x, y, anchor, value) in [
        (LEFT - 5.0, MARGIN + 8.0, "end", high),
        (LEFT - 5.0, foot, "end", low),
        (LEFT, height - 5.0, "start", left),
        (width - MARGIN, height - 5.0, "end", right),
    ] {
        // Writing into a text cannot fail.
        let _ = write!(text, "<text x=\"{x}\" y=\"{y}\" text-anchor=\"{anchor}\">{}</text>", short(value));
    }
    for curve in curves {
        let stride = curve.points.len().div_ceil(POINTS).max(1);
        let shown = curve.points.iter().step_by(stride).filter(finite);
        let points: Vec<String> = shown.map(|p| format!("{:.1},{:.1}", across(p[0]), down(p[1]))).collect();
        let _ = write!(
            text,
            "<polyline points=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"1.2\"/>",
            points.join(" "),
            curve.colour
        );
    }
    text + "</svg>"
}

/// A number in a few letters.
pub(crate) fn short(value: f64) -> String {
    let size = value.abs();
    if value == 0.0 || (1e-3..1e5).contains(&size) {
        let digits = if size >= 100.0 {
            1
        } else if size >= 1.0 {
            3
        } else {
            5
        };
        let text = format!("{value:.digits$}");
        let cut = text.trim_end_matches('0').trim_end_matches('.');
        if cut == "-0" || cut.is_empty() { "0".into() } else { cut.to_owned() }
    } else {
        format!("{value:.3e}")
    }
}
