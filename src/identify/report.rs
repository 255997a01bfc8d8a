//! The report of a fit: one page of HTML, without scripts.

use crate::fit::{Curves, Found};
use crate::svg::{Curve, plot, short};
use std::fmt::Write as _;

const STYLE: &str = "body{font:15px/1.45 system-ui,sans-serif;max-width:62em;margin:2em auto;padding:0 1em;color:#222;\
background:#fff}table{border-collapse:collapse;font-variant-numeric:tabular-nums}td,th{padding:.2em .7em;border-bottom:1px \
solid #ddd;text-align:right}td:first-child,th:first-child{text-align:left}svg text{font-size:11px;fill:#555}.unsure{background:\
#fff2cc}h3{margin:1em 0 0}";
/// Colours of what was measured, of before and of after (Okabe and Ito, "Color universal design", 2008).
const COLOURS: [(&str, &str); 3] = [("measured", "#000"), ("before", "#d55e00"), ("after", "#0072b2")];
/// Correlation of successive residuals from which on the page warns.
const CORRELATED: f64 = 0.5;

/// The page: parameters, what the log cannot tell, columns with their noise, the course of the fit, readings before and after.
pub fn report(title: &str, found: &Found) -> String {
    let title = escaped(title);
    let mut page = format!(
        "<!DOCTYPE html><html lang=en><head><meta charset=utf-8><title>{title}</title><style>{STYLE}</style></head><body>\
         <h1>{title}</h1>"
    );
    page += &parameters(found);
    page += &unknown(found);
    page += &columns(found);
    page += "<h2>Course of the fit</h2><p>Decimal logarithm of half the sum of squares over iterations, round by round; each \
             round weighs readings by the noise that the one before left.</p>";
    for round in &found.rounds {
        let log =
            |value: f64| physics::math::ops::log(value.max(f64::MIN_POSITIVE)) / std::f64::consts::LN_10;
        let points = round.iter().enumerate().map(|(i, step)| [i as f64, log(step.objective)]);
        page += &plot(&[Curve { colour: COLOURS[2].1, points: points.collect() }]);
    }
    for curves in &found.curves {
        let _ = write!(page, "<h2>{}</h2><p>", escaped(&curves.name));
        for (name, colour) in COLOURS {
            let _ = write!(page, "<span style=\"color:{colour}\">&#9644; {name}</span> ");
        }
        page += "over time [s]</p>";
        page += &readings(found, curves);
    }
    page + "</body></html>\n"
}

fn parameters(found: &Found) -> String {
    let mut text = String::from(
        "<h2>Parameters</h2><table><tr><th>parameter</th><th>before</th><th>after</th><th>standard deviation</th><th>lower\
         </th><th>upper</th></tr>",
    );
    for ((p, &value), &deviation) in found.parameters.iter().zip(&found.values).zip(&found.deviations) {
        let at_bound = value <= p.lower || value >= p.upper;
        let class = if deviation.is_finite() && !at_bound { "" } else { " class=unsure" };
        let certain = if deviation.is_finite() { short(deviation) } else { "not told".into() };
        let bound = if at_bound { " (at a bound)" } else { "" };
        let cells = [short(p.start), short(value) + bound, certain, short(p.lower), short(p.upper)];
        let cells: String = cells.iter().map(|cell| format!("<td>{cell}</td>")).collect();
        let _ = write!(text, "<tr{class}><td>{}</td>{cells}</tr>", escaped(&p.name));
    }
    text + "</table>"
}

fn unknown(found: &Found) -> String {
    if found.unknown.is_empty() {
        return "<p>The log tells all of them.</p>".into();
    }
    let mut text = String::from(
        "<h2>What the log cannot tell</h2><p>Readings hardly change when values move along these:</p><ul>",
    );
    for direction in &found.unknown {
        let parts: Vec<_> =
            direction.parts.iter().map(|(name, share)| format!("{share:+.2} {}", escaped(name))).collect();
        let how = if direction.deviation.is_finite() {
            format!("known to {:.0} % of their values", 100.0 * direction.deviation)
        } else {
            "no reading changes".to_owned()
        };
        let _ = write!(text, "<li>{}: {how}</li>", parts.join(", "));
    }
    text + "</ul><p>Leave such parameters out, give them a prior, or record a log in which they matter.</p>"
}

fn columns(found: &Found) -> String {
    let mut text = String::from(
        "<h2>Readings</h2><table><tr><th>column</th><th>left before</th><th>left after</th><th>correlation of successive \
         residuals</th></tr>",
    );
    for (i, name) in found.columns.iter().enumerate() {
        let class = if found.correlation[i] > CORRELATED { " class=unsure" } else { "" };
        let _ = write!(
            text,
            "<tr{class}><td>{}</td><td>{}</td><td>{}</td><td>{:.2}</td></tr>",
            escaped(name),
            short(found.before[i]),
            short(found.noise[i]),
            found.correlation[i]
        );
    }
    text +=
        "</table><p>What is left is the root of the mean square of residuals, in the unit of the column.</p>";
    if found.correlation.iter().any(|&c| c > CORRELATED) {
        text += "<p>Highlighted: residuals follow each other: the model lacks something that the robot has, or the fit ended \
                 in a local minimum. Standard deviations are too small then.</p>";
    }
    text
}

fn readings(found: &Found, curves: &Curves) -> String {
    let width = found.columns.len();
    let mut text = String::new();
    for (column, name) in found.columns.iter().enumerate() {
        let series = [&curves.measured, &curves.before, &curves.after];
        let shown: Vec<_> = series
            .iter()
            .zip(COLOURS)
            .map(|(values, (_, colour))| {
                let points =
                    curves.times.iter().enumerate().map(|(row, &t)| [t, values[row * width + column]]);
                Curve { colour, points: points.collect() }
            })
            .collect();
        let _ = write!(text, "<h3>{}</h3>{}", escaped(name), plot(&shown));
    }
    text
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}
