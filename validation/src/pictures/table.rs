//! The table of pictures: likeness by scene and size, the bars, and what misses them.

use super::items::Differences;
use super::measures::{Colours, Shapes, median};
use super::plan::{Bars, Held, Plan};
use std::fmt::Write;

/// One scene at one size.
#[derive(Clone, Debug)]
pub struct Row {
    /// The scene.
    pub scene: String,
    /// Columns and rows.
    pub side: usize,
    /// Colours.
    pub colours: Colours,
    /// Colours without shadows.
    pub no_shadow: Colours,
    /// Depth and segmentation.
    pub shapes: Shapes,
    /// Which bars it is held to.
    pub held: Held,
    /// These bars.
    pub bars: Bars,
}

/// What is said of a scene beside its pictures.
#[derive(Clone, Debug, Default)]
pub struct Remark {
    /// The scene.
    pub scene: String,
    /// How the list of what is drawn differs from MuJoCo's; none where it was not compared.
    pub differences: Option<Differences>,
    /// Why there is no picture.
    pub failure: Option<String>,
    /// Why the picture differs as it does.
    pub note: Option<String>,
}

impl Remark {
    fn line(&self) -> String {
        let items = self.differences.as_ref().map_or_else(String::new, Differences::summary);
        let note = self.failure.as_ref().or(self.note.as_ref()).map_or("", String::as_str);
        format!("| {} | {items} | {note} |", self.scene)
    }

    fn miss(&self) -> Option<String> {
        let differs = self.differences.as_ref().filter(|found| !found.none()).map(Differences::summary);
        self.failure.clone().or(differs).map(|why| format!("{}: {why}", self.scene))
    }
}

impl Row {
    /// The measured numbers: name, value, bar, and how they are shown.
    fn numbers(&self) -> [(&'static str, f64, f64, Format); 8] {
        let (colours, plain, shapes, bars) = (&self.colours, &self.no_shadow, &self.shapes, &self.bars);
        [
            ("PSNR", colours.psnr, bars.psnr, Format::Decibels),
            ("SSIM", colours.ssim, bars.ssim, Format::Share),
            ("PSNR without shadows", plain.psnr, bars.psnr_no_shadow, Format::Decibels),
            ("equal ids", shapes.ids, bars.ids, Format::Share),
            ("equal ids inside", shapes.ids_interior, bars.ids_interior, Format::Share),
            ("IoU", shapes.iou, bars.iou, Format::Share),
            ("depth p99", shapes.depth_p99, bars.depth_p99, Format::Error),
            ("depth median", shapes.depth_median, bars.depth_median, Format::Error),
        ]
    }

    /// Every bar that the picture does not reach.
    fn misses(&self) -> impl Iterator<Item = String> {
        self.numbers().into_iter().filter(|(_, value, bar, format)| !format.holds(*value, *bar)).map(
            |(name, value, bar, format)| {
                let [value, bar] = [value, bar].map(|x| format.text(x));
                format!("{} {}: {name} {value}, bar {bar}", self.scene, self.side)
            },
        )
    }

    fn line(&self) -> String {
        let mut line = format!("| {} | {} | {:.1} |", self.scene, self.side, self.colours.psnr_interior);
        for (_, value, bar, format) in self.numbers() {
            let [text, bar_text] = [value, bar].map(|x| format.text(x));
            let _ = match format {
                _ if !format.holds(value, bar) => write!(line, " **{text}** ({bar_text}) |"),
                Format::Decibels => write!(line, " {text} ({bar_text}) |"),
                Format::Share | Format::Error => write!(line, " {text} |"),
            };
        }
        line
    }
}

/// How a number is shown, and on which side of its bar it holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Format {
    Decibels,
    Share,
    Error,
}

impl Format {
    fn text(self, value: f64) -> String {
        match self {
            Format::Decibels => format!("{value:.1}"),
            Format::Share => format!("{value:.4}"),
            Format::Error => format!("{value:.1e}"),
        }
    }

    /// NaN never holds.
    fn holds(self, value: f64, bar: f64) -> bool {
        if self == Format::Error { value <= bar } else { value >= bar }
    }
}

const HEADER: &str = "| scene | side | PSNR inside | PSNR | SSIM | without shadows | equal ids | inside | IoU | depth p99 | median |
|---|---|---|---|---|---|---|---|---|---|---|
";

/// The tables, and as verdict every bar that is missed.
pub fn render(plan: &Plan, rows: &[Row], remarks: &[Remark]) -> (String, Result<(), String>) {
    let mut text = String::from(HEADER);
    for row in rows {
        let _ = writeln!(text, "{}", row.line());
    }
    let mut misses: Vec<String> = rows.iter().flat_map(Row::misses).collect();
    let _ = writeln!(text, "\nMedians over the listed scenes, and their bars:\n");
    for &side in &plan.sizes {
        let (line, missed) = medians(plan, rows, side);
        text += &line;
        misses.extend(missed);
    }
    text += "\n| scene | items, lights and camera beside MuJoCo's | note |\n|---|---|---|\n";
    for remark in remarks {
        let _ = writeln!(text, "{}", remark.line());
    }
    misses.extend(remarks.iter().filter_map(Remark::miss));
    let _ = write!(
        text,
        "\nMissed: {}",
        if misses.is_empty() { "none.".into() } else { misses.join("; ") + "." }
    );
    let verdict = if misses.is_empty() { Ok(()) } else { Err(format!("{} bars are missed", misses.len())) };
    (text, verdict)
}

/// The medians of one size as a line, and those that miss their bar.
fn medians(plan: &Plan, rows: &[Row], side: usize) -> (String, Vec<String>) {
    let listed: Vec<&Row> = rows.iter().filter(|row| row.side == side && row.held == Held::Listed).collect();
    if listed.is_empty() {
        return (String::new(), Vec::new());
    }
    let of = |number: fn(&Row) -> f64| median(&listed.iter().map(|row| number(row)).collect::<Vec<_>>());
    let found = [
        ("PSNR", of(|row| row.colours.psnr), plan.medians.psnr, Format::Decibels),
        ("SSIM", of(|row| row.colours.ssim), plan.medians.ssim, Format::Share),
        ("PSNR without shadows", of(|row| row.no_shadow.psnr), plan.medians.psnr_no_shadow, Format::Decibels),
    ];
    let texts = found
        .map(|(name, value, bar, format)| format!("{name} {} ({})", format.text(value), format.text(bar)));
    let missed = found.iter().zip(&texts).filter(|((_, value, bar, format), _)| !format.holds(*value, *bar));
    let missed = missed.map(|(_, text)| format!("median at {side}: {text}")).collect();
    (format!("- {side} x {side}, {} scenes: {}\n", listed.len(), texts.join(", ")), missed)
}
