//! Public models of many sources, gathered and recorded by `reference/wider.py`: how many load, compile, accelerate and
//! move as MuJoCo's do, source by source, and what remains.

use crate::compile::compare_compiled;
use crate::motion::{compare_forward, compare_rollout};
use crate::status::open;
use std::collections::BTreeMap;
use std::fmt::Write;
use std::path::Path;

/// Share of all models that must load, compile, accelerate and move alike.
const BARS: [f64; 4] = [0.99, 0.995, 0.995, 0.98];

const PARTS: [&str; 4] = ["loads", "compiles alike", "forward alike", "rollout follows"];

/// One model beside its reference.
pub struct Compared {
    source: String,
    model: String,
    /// What is wrong with each of the parts, if anything.
    faults: [Option<String>; 4],
}

impl Compared {
    /// The model as a line of progress.
    pub fn line(&self) -> String {
        let faults = PARTS.iter().zip(&self.faults).filter_map(|(part, fault)| Some((part, fault.as_ref()?)));
        let faults: Vec<_> = faults.map(|(part, fault)| format!("not {part}: {fault}")).collect();
        format!("{}\t{}", self.model, if faults.is_empty() { "alike".to_owned() } else { faults.join("; ") })
    }
}

/// Compares one model; `name` is its path below the folder of sources.
pub fn measure(name: &str, model: &Path, reference: &Path) -> Compared {
    let source = name.split('/').next().unwrap_or_default().replace('+', "/");
    let faults = faults(model, reference).unwrap_or_else(|failure| {
        let first = failure.lines().next().unwrap_or_default().to_owned();
        [Some(first), Some("not loaded".into()), Some("not loaded".into()), Some("not loaded".into())]
    });
    Compared { source, model: name.to_owned(), faults }
}

fn faults(model: &Path, reference: &Path) -> Result<[Option<String>; 4], String> {
    let (m, reference) = open(model, reference)?;
    let text = |e: crate::reference::ReferenceError| e.to_string();
    let compile = compare_compiled(&m, &reference).map_err(text)?;
    let compiled = compile.differences.first().map(ToString::to_string);
    let forward = compare_forward(&m, &reference).map(|report| match (&report.failure, &report.worst) {
        _ if report.agrees() => None,
        (Some(failure), _) => Some(failure.clone()),
        (None, Some((state, worst))) => Some(format!("{worst}, state {state}, error {:.0e}", worst.error)),
        (None, None) => Some("no state".into()),
    });
    let rollout =
        compare_rollout(&m, &reference).map(|report| match (&report.failure, report.first_outside) {
            (Some((step, failure)), _) => Some(format!("step {step}: {failure}")),
            (None, Some(step)) => Some(format!(
                "leaves the bound at step {step}, by the end {:.0e} (twin {:.0e})",
                report.divergence, report.twin
            )),
            (None, None) => None,
        });
    // Arrays of other lengths cannot be compared: that is a fault of the part.
    let fault = |outcome: Result<Option<String>, _>| outcome.unwrap_or_else(|e| Some(text(e)));
    Ok([None, compiled, fault(forward), fault(rollout)])
}

/// Models of one source, and how many of them have no fault in each part.
#[derive(Default)]
struct Total {
    models: usize,
    alike: [usize; 4],
    too_large: usize,
}

impl Total {
    fn add(&mut self, row: &Compared) {
        self.models += 1;
        for (alike, fault) in self.alike.iter_mut().zip(&row.faults) {
            *alike += usize::from(fault.is_none());
        }
    }

    fn line(&self, name: &str) -> String {
        let [loads, compiled, forward, rollout] = self.alike;
        format!(
            "| {name} | {} | {loads} | {compiled} | {forward} | {rollout} | {} |",
            self.models, self.too_large
        )
    }
}

/// Whether a file in `left_out.tsv` is a model that is too large; the other reasons there leave no model out.
fn is_too_large(reason: &str) -> bool {
    reason.ends_with("too long to record")
}

/// One line a source, the totals, and what remains; an error when a bar is missed. `left_out` is the text of
/// `left_out.tsv`.
pub fn render(rows: &[Compared], left_out: &str) -> (String, Result<(), String>) {
    let (mut sources, mut all) = (BTreeMap::<&str, Total>::new(), Total::default());
    for row in rows {
        sources.entry(&row.source).or_default().add(row);
        all.add(row);
    }
    let large = left_out.lines().filter_map(|line| {
        let mut columns = line.split('\t');
        let (source, reason) = (columns.next()?.replace('+', "/"), columns.nth(1)?);
        is_too_large(reason).then_some(source)
    });
    for source in large {
        all.too_large += 1;
        if let Some(total) = sources.get_mut(source.as_str()) {
            total.too_large += 1;
        }
    }
    let mut text = String::from(
        "| source | models | load | compiled alike | forward alike | rollout follows | left out: too large |\n|---|---|---|---|---|---|---|\n",
    );
    for (name, total) in &sources {
        let _ = writeln!(text, "{}", total.line(name));
    }
    let _ = writeln!(text, "{}\n", all.line("**all**"));
    text.push_str("What remains:\n\n| model | part | difference |\n|---|---|---|\n");
    for row in rows {
        let first = PARTS.iter().zip(&row.faults).find_map(|(part, fault)| Some((part, fault.as_ref()?)));
        if let Some((part, fault)) = first {
            let _ = writeln!(text, "| {} | not {part} | {} |", row.model, fault.replace('|', "/"));
        }
    }
    (text, verdict(&all))
}

fn verdict(all: &Total) -> Result<(), String> {
    let missed: Vec<String> = (0..PARTS.len())
        .filter(|&k| (all.alike[k] as f64) < BARS[k] * all.models as f64)
        .map(|k| {
            format!("{}: {} of {}, the bar is {} %", PARTS[k], all.alike[k], all.models, 100.0 * BARS[k])
        })
        .collect();
    if missed.is_empty() { Ok(()) } else { Err(missed.join("\n")) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sources_are_counted_and_missed_bars_are_errors() {
        let row = |model: &str, fault: Option<&str>| Compared {
            source: model.split('/').next().unwrap().into(),
            model: model.into(),
            faults: [None, None, None, fault.map(str::to_owned)],
        };
        let rows = [row("a/x.xml", None), row("a/y.xml", Some("leaves")), row("b/z.xml", None)];
        let (text, verdict) = render(
            &rows,
            "a\ta/s.xml\t2700 degrees of freedom: too long to record\nb\tb/t.xml\trefused: no\n",
        );
        assert!(text.contains("| a | 2 | 2 | 2 | 2 | 1 | 1 |\n| b | 1 | 1 | 1 | 1 | 1 | 0 |\n"), "{text}");
        assert!(text.contains("| a/y.xml | not rollout follows | leaves |"), "{text}");
        assert_eq!(verdict.unwrap_err(), "rollout follows: 2 of 3, the bar is 98 %");
        assert_eq!(render(&rows[..1], "").1, Ok(()));
    }
}
