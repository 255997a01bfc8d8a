//! What the combinations of a sweep reached, side by side.

use crate::terminal::{note, show, show_json};
use agents::run::Row;
use agents::sweep::Combination;
use serde_json::{Value, json};
use std::path::Path;

/// A combination, and what its runs came to.
pub struct Compared<'a> {
    /// Its settings.
    pub combination: &'a Combination,
    /// Number of its runs.
    pub runs: usize,
    /// Seeds of those that are finished, and what their last iteration was like.
    pub finished: Vec<(u64, Row)>,
}

impl Compared<'_> {
    fn numbers(&self, column: &str) -> Vec<f64> {
        self.finished.iter().map(|(_, row)| row.get(column)).collect()
    }

    /// The mean of a column over seeds; none where no run is finished.
    fn mean(&self, column: &str) -> Option<f64> {
        let numbers = self.numbers(column);
        (!numbers.is_empty()).then(|| numbers.iter().sum::<f64>() / numbers.len() as f64)
    }

    /// Mean success and return, to order combinations by.
    fn rank(&self) -> [f64; 2] {
        ["success_percentage", "stoc_pol_mean"].map(|name| self.mean(name).unwrap_or(f64::NEG_INFINITY))
    }

    fn samples(&self) -> f64 {
        self.numbers("num_samples").into_iter().fold(0.0, f64::max)
    }

    fn line(&self) -> String {
        let settings = self.combination.described();
        let seeds = match self.finished.len() {
            all if all == self.runs => all.to_string(),
            some => format!("{some} of {}", self.runs),
        };
        let (Some(success), Some(reward)) = (self.mean("success_percentage"), self.mean("stoc_pol_mean"))
        else {
            return format!("{:>9}  {:>12}  {:>10}  {:>10}  {seeds:>7}  {settings}", "-", "-", "-", "-");
        };
        let scores = self.numbers("success_percentage");
        let [least, most] =
            [scores.iter().copied().fold(success, f64::min), scores.iter().copied().fold(success, f64::max)];
        let range = format!("{least:.0} to {most:.0} %");
        let samples = self.samples();
        format!("{success:>7.1} %  {range:>12}  {reward:>10.2}  {samples:>10}  {seeds:>7}  {settings}")
    }

    fn as_json(&self) -> Value {
        let settings = self.combination.settings.iter().map(|(key, value)| (key.clone(), json!(value)));
        json!({
            "settings": settings.collect::<serde_json::Map<_, _>>(),
            "runs": self.runs,
            "seeds": self.finished.iter().map(|(seed, _)| seed).collect::<Vec<_>>(),
            "success_percentages": self.numbers("success_percentage"),
            "success_percentage": self.mean("success_percentage"),
            "returns": self.numbers("stoc_pol_mean"),
            "return": self.mean("stoc_pol_mean"),
            "num_samples": self.samples(),
        })
    }
}

/// Shows what combinations reached, the best first; and as JSON the runs that failed, with the reasons.
pub fn show_compared(folder: &Path, mut rows: Vec<Compared<'_>>, failed: &[(String, String)], as_json: bool) {
    rows.sort_by(|a, b| {
        let [a, b] = [a.rank(), b.rank()];
        b[0].total_cmp(&a[0]).then(b[1].total_cmp(&a[1]))
    });
    if as_json {
        let failed: Vec<_> =
            failed.iter().map(|(run, message)| json!({ "run": run, "message": message })).collect();
        let rows: Vec<_> = rows.iter().map(Compared::as_json).collect();
        return show_json(&json!({ "folder": folder.to_string_lossy(), "rows": rows, "failed": failed }));
    }
    show!(
        "{:>9}  {:>12}  {:>10}  {:>10}  {:>7}  settings",
        "success",
        "of seeds",
        "return",
        "steps",
        "seeds"
    );
    rows.iter().for_each(|row| show!("{}", row.line()));
    note(&format!(
        "these are the last iterations' episodes, whose actions are drawn; `robohive report {}` plays the same episodes for every run",
        folder.join("*").display()
    ));
}
