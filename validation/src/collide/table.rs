//! The tables of a compared stream of placements and rays.

use super::compare_stream;
use super::report::{RayTally, Report, SCENE, TOGETHER, Tally};
use std::collections::BTreeMap;
use std::fmt::Write;
use std::io::BufReader;
use std::path::Path;

const TYPES: [&str; 8] = ["plane", "hfield", "sphere", "capsule", "ellipsoid", "cylinder", "box", "mesh"];

const HEAD: &str = "placements | touching | deep | unstable | excepted | different | worst dist | pos | frame | distances: unstable | excepted | different | worst distance | points |";

/// Compares the stream in a file, or in standard input. Returns the tables and whether everything agrees.
///
/// # Errors
/// The stream cannot be read or is damaged.
pub fn measure(from: Option<&Path>) -> Result<(String, Result<(), String>), String> {
    let report = match from {
        None => compare_stream(&mut std::io::stdin().lock()),
        Some(path) => {
            let file = std::fs::File::open(path).map_err(|e| format!("{}: {e}", path.display()))?;
            compare_stream(&mut BufReader::new(file))
        }
    }
    .map_err(|e| e.to_string())?;
    report.differences.iter().for_each(|difference| println!("{difference}"));
    let verdict = match report.different() {
        0 => Ok(()),
        n => Err(format!("{n} comparisons differ")),
    };
    Ok((render(&report), verdict))
}

/// All tables, as Markdown.
fn render(report: &Report) -> String {
    let mut text = String::new();
    if !report.pairs.is_empty() {
        pairs(&mut text, report);
    }
    if !report.flexes.is_empty() {
        flexes(&mut text, report);
    }
    if !report.rays.is_empty() {
        text.push('\n');
        head(
            &mut text,
            "rays against",
            "rays | hits | unstable | excepted | different | worst distance | normal |",
        );
    }
    for (&target, tally) in &report.rays {
        ray_line(&mut text, target, tally);
    }
    text
}

/// Pairs of geoms, and the sum of each other variant.
fn pairs(text: &mut String, report: &Report) {
    head(text, "pair", HEAD);
    let mut total = Tally::default();
    for ((_, [a, b]), tally) in report.pairs.iter().filter(|((variant, _), _)| *variant == 0) {
        line(text, &format!("{}–{}", TYPES[*a], TYPES[*b]), tally);
        add(&mut total, tally);
    }
    line(text, "all", &total);
    if report.variants.len() > 1 {
        text.push('\n');
        head(text, "variant, all pairs", HEAD);
    }
    for (number, name) in report.variants.iter().enumerate().skip(1) {
        let mut sum = Tally::default();
        report
            .pairs
            .iter()
            .filter(|((variant, _), _)| *variant == number)
            .for_each(|(_, t)| add(&mut sum, t));
        line(text, name, &sum);
    }
}

/// Pairs in the order of their names, and the sum of each other variant.
fn flexes(text: &mut String, report: &Report) {
    const HEAD: &str =
        "placements | touching | deep | unstable | excepted | different | worst dist | pos | frame |";
    const DEFAULT: &str = "default";
    head(text, "elements of flexes", HEAD);
    let mut sums = BTreeMap::<&str, Tally>::new();
    for ((variant, pair), tally) in &report.flexes {
        add(sums.entry(variant).or_default(), tally);
        if variant == DEFAULT {
            flex_line(text, pair, tally);
        }
    }
    for (variant, sum) in sums {
        flex_line(text, if variant == DEFAULT { "all" } else { variant }, &sum);
    }
}

fn flex_line(text: &mut String, name: &str, t: &Tally) {
    let share = |n: usize| 100.0 * n as f64 / t.placements.max(1) as f64;
    let [dist, pos, frame] = t.worst;
    let _ = writeln!(
        text,
        "| {name} | {} | {:.0} % | {:.0} % | {} | {} | {} | {dist:.0e} | {pos:.0e} | {frame:.0e} |",
        t.placements,
        share(t.touching),
        share(t.deep),
        t.unstable,
        t.excepted,
        t.different
    );
}

fn head(text: &mut String, first: &str, columns: &str) {
    let rule = "---|".repeat(columns.matches('|').count() + 1);
    let _ = writeln!(text, "| {first} | {columns}\n|{rule}");
}

fn line(text: &mut String, name: &str, t: &Tally) {
    let share = |n: usize| 100.0 * n as f64 / t.placements.max(1) as f64;
    let [dist, pos, frame] = t.worst;
    let [distance, points] = t.distance_worst;
    let _ = writeln!(
        text,
        "| {name} | {} | {:.0} % | {:.0} % | {} | {} | {} | {dist:.0e} | {pos:.0e} | {frame:.0e} | {} | {} | {} | {distance:.0e} | {points:.0e} |",
        t.placements,
        share(t.touching),
        share(t.deep),
        t.unstable,
        t.excepted,
        t.different,
        t.distance_unstable,
        t.distance_excepted,
        t.distance_different,
    );
}

fn ray_line(text: &mut String, target: usize, t: &RayTally) {
    let name = match target {
        SCENE => "scenes, one ray at a time",
        TOGETHER => "scenes, rays together",
        kind => TYPES[kind],
    };
    let [distance, normal] = t.worst;
    let _ = writeln!(
        text,
        "| {name} | {} | {} | {} | {} | {} | {distance:.0e} | {normal:.0e} |",
        t.rays, t.hits, t.unstable, t.excepted, t.different
    );
}

fn add(sum: &mut Tally, t: &Tally) {
    sum.placements += t.placements;
    sum.touching += t.touching;
    sum.deep += t.deep;
    sum.unstable += t.unstable;
    sum.excepted += t.excepted;
    sum.different += t.different;
    sum.worst = std::array::from_fn(|k| sum.worst[k].max(t.worst[k]));
    sum.distance_unstable += t.distance_unstable;
    sum.distance_excepted += t.distance_excepted;
    sum.distance_different += t.distance_different;
    sum.distance_worst = std::array::from_fn(|k| sum.distance_worst[k].max(t.distance_worst[k]));
}
