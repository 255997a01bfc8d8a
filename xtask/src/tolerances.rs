//! Every tolerance of the comparisons with MuJoCo beside what is measured: a bound that is hardly kept breaks at the next
//! change of an order of operations, and one that is never approached notices nothing.

use std::collections::BTreeMap;

/// Bounds are between these multiples of the largest difference measured.
const MARGIN: [f64; 2] = [10.0, 100.0];

/// Collects what the tests measured from what they printed, prints the table, and refuses bounds that are too tight or too
/// loose.
pub fn check<'a>(printed: impl Iterator<Item = &'a str>) -> Result<(), String> {
    let mut measured = BTreeMap::new();
    printed.for_each(|text| collect(text, &mut measured));
    if measured.is_empty() {
        return Err("no comparison printed what it measured".into());
    }
    let mut wrong = Vec::new();
    println!("{:24} {:>9} {:>9} {:>6}", "tolerance", "measured", "bound", "ratio");
    for (name, [largest, bound]) in measured {
        let ratio = bound / largest;
        println!("{name:24} {largest:>9.1e} {bound:>9.0e} {ratio:>6.0}");
        if !(MARGIN[0]..=MARGIN[1]).contains(&ratio) {
            wrong.push(name);
        }
    }
    if wrong.is_empty() {
        return Ok(());
    }
    Err(format!("not {} to {} times what is measured: {}", MARGIN[0], MARGIN[1], wrong.join(", ")))
}

/// Adds the largest difference and the bound by name, from lines as in `measured STAGE 7.4e-15 of 2e-13`.
fn collect<'a>(text: &'a str, found: &mut BTreeMap<&'a str, [f64; 2]>) {
    for line in text.lines().filter_map(|line| line.split_once("measured ").map(|(_, rest)| rest)) {
        if let [name, largest, "of", bound] = line.split_whitespace().collect::<Vec<_>>()[..]
            && let (Ok(largest), Ok(bound)) = (largest.parse::<f64>(), bound.parse())
        {
            let row = found.entry(name).or_insert([0.0, bound]);
            row[0] = row[0].max(largest);
        }
    }
}
