//! Our own robots beside the numbers that are published of them.

pub mod measured;
pub mod published;

use measured::Ruler;
use physics::Model;
use published::Published;
use std::fmt::Write;

/// Share of the published number by which ours may differ without a reason.
const SHARE: f64 = 0.02;
/// Angle or place by which an end of a range may differ without a reason \[rad or m\].
const END: f64 = 0.02;

/// A quantity of a robot.
#[derive(Clone, Debug)]
pub struct Row {
    robot: String,
    quantity: String,
    published: String,
    ours: String,
    deviation: String,
    /// Whether the deviation is small.
    near: bool,
    why: Option<String>,
    source: String,
}

/// Compares every robot that has a `published.toml`.
///
/// # Errors
/// A text cannot be read, or names what its robot does not have.
pub fn measure() -> Result<Vec<Row>, String> {
    let mut rows = Vec::new();
    for path in assets::paths() {
        let Some(folder) = path.strip_suffix("/published.toml") else { continue };
        let text = assets::text(&path).ok_or_else(|| format!("{path} is no text"))?;
        let published: Published = toml::from_str(text).map_err(|error| format!("{path}: {error}"))?;
        let file = format!("{folder}/{}", published.model);
        let loaded =
            mjcf::Loader::default().files(assets::Own).load(&file).map_err(|error| error.to_string())?;
        let of_robot = Comparison { robot: folder, published: &published, model: &loaded.model };
        rows.extend(of_robot.rows().map_err(|error| format!("{path}: {file} has {error}"))?);
    }
    Ok(rows)
}

struct Comparison<'a> {
    robot: &'a str,
    published: &'a Published,
    model: &'a Model,
}

impl Comparison<'_> {
    fn rows(&self) -> Result<Vec<Row>, String> {
        let (published, model) = (self.published, self.model);
        let mut rows = Vec::new();
        if let Some(mass) = published.mass {
            rows.push(self.number("mass", "kg", mass, measured::mass(model), None));
        }
        if let Some(reach) = &published.reach {
            let ours = Ruler::new(model, &reach.from, &reach.to)?.largest();
            rows.push(self.number("reach", "m", reach.value, ours, reach.source.as_ref()));
        }
        for length in &published.length {
            let ours = Ruler::new(model, &length.from, &length.to)?.at_zero();
            rows.push(self.number(&length.name, "m", length.value, ours, length.source.as_ref()));
        }
        rows.extend(self.ranges()?);
        rows.extend(self.torques()?);
        Ok(rows)
    }

    fn number(&self, quantity: &str, unit: &str, published: f64, ours: f64, source: Option<&String>) -> Row {
        let share = ours / published - 1.0;
        Row {
            published: format!("{published:.4} {unit}"),
            ours: format!("{ours:.4} {unit}"),
            deviation: percent(share),
            ..self.row(quantity, share.abs() <= SHARE, source)
        }
    }

    /// The ranges of all joints, with the end that is furthest from the published one.
    fn ranges(&self) -> Result<Option<Row>, String> {
        let mut worst = (0.0_f64, String::new());
        for (name, published) in &self.published.range {
            let ours = measured::range(self.model, measured::joint(self.model, name)?);
            let ours = ours.ok_or_else(|| format!("no range of the joint '{name}'"))?;
            let off = (0..2).map(|end| (ours[end] - published[end]).abs()).fold(0.0, f64::max);
            if off > worst.0 {
                worst = (off, format!("{name}: {:.3} to {:.3}", ours[0], ours[1]));
            }
        }
        let row = Row {
            published: format!("{} joints", self.published.range.len()),
            ours: if worst.1.is_empty() { "the same".into() } else { worst.1 },
            deviation: format!("{:.3}", worst.0),
            ..self.row("range", worst.0 <= END, None)
        };
        Ok((!self.published.range.is_empty()).then_some(row))
    }

    /// The largest torques of all joints, with the one that is furthest from the published one.
    fn torques(&self) -> Result<Option<Row>, String> {
        let mut worst = (0.0_f64, String::new());
        for (name, &published) in &self.published.torque {
            let ours = measured::torque(self.model, measured::joint(self.model, name)?);
            let share = ours / published - 1.0;
            if share.abs() > worst.0.abs() {
                let ours = if ours.is_finite() { format!("{ours:.2}") } else { "no limit".into() };
                worst = (share, format!("{name}: {ours} for {published:.2}"));
            }
        }
        let row = Row {
            published: format!("{} joints", self.published.torque.len()),
            ours: if worst.1.is_empty() { "the same".into() } else { worst.1 },
            deviation: percent(worst.0),
            ..self.row("torque", worst.0.abs() <= SHARE, None)
        };
        Ok((!self.published.torque.is_empty()).then_some(row))
    }

    fn row(&self, quantity: &str, near: bool, source: Option<&String>) -> Row {
        Row {
            robot: self.robot.to_owned(),
            quantity: quantity.to_owned(),
            published: String::new(),
            ours: String::new(),
            deviation: String::new(),
            near,
            why: self.published.why.get(quantity).cloned(),
            source: source.unwrap_or(&self.published.source).clone(),
        }
    }
}

/// A share as text, without the sign of what is rounded to zero.
fn percent(share: f64) -> String {
    match share {
        share if share.abs() < 5e-4 => "0.0 %".into(),
        share if share.is_finite() => format!("{:+.1} %", 100.0 * share),
        _ => "unbounded".into(),
    }
}

/// The table, and as verdict an error that lists deviations without a reason.
pub fn render(rows: &[Row]) -> (String, Result<(), String>) {
    let mut text = String::from(
        "| robot | quantity | published | ours | deviation | why | source |\n|---|---|---|---|---|---|---|\n",
    );
    for row in rows {
        let Row { robot, quantity, published, ours, deviation, why, source, .. } = row;
        let why = why.as_deref().unwrap_or("");
        let _ = writeln!(
            text,
            "| {robot} | {quantity} | {published} | {ours} | {deviation} | {why} | {source} |"
        );
    }
    let bare = rows.iter().filter(|row| !row.near && row.why.is_none());
    let bare: Vec<_> = bare.map(|row| format!("{}: {} {}", row.robot, row.quantity, row.deviation)).collect();
    let verdict = if bare.is_empty() {
        Ok(())
    } else {
        Err(format!("deviations without a reason in published.toml:\n{}", bare.join("\n")))
    };
    (text, verdict)
}
