//! Written tables with a row for each id, which a measurement of some ids replaces in part.

use env::Registry;

/// A Markdown table in which the rows of `newer` replace or join those of `older`, in the order of the registry. Rows of ids that are no
/// longer registered go.
pub fn joined(older: &str, newer: &str) -> String {
    let (kept, measured) = (rows(older), rows(newer));
    let row = |id: &str| measured.iter().chain(&kept).find(|(of, _)| *of == id).map(|(_, line)| *line);
    let specs = Registry::builtin().specs().iter();
    newer.trim().lines().take(2).chain(specs.filter_map(|spec| row(&spec.id))).collect::<Vec<_>>().join("\n")
}

/// Rows of a Markdown table, each with its first cell.
fn rows(table: &str) -> Vec<(&str, &str)> {
    let rows = table.trim().lines().skip(2);
    rows.filter_map(|line| Some((line.strip_prefix("| ")?.split(" |").next()?, line))).collect()
}

#[cfg(test)]
mod tests {
    #[test]
    fn measured_rows_replace_written_ones_and_others_stay() {
        let table = |rows: &[&str]| {
            ["| id | x |", "|---|---|"].into_iter().chain(rows.iter().copied()).collect::<Vec<_>>().join("\n")
        };
        let [acrobot, furuta] = ["| hive/Acrobot-v0 | 1 |", "| hive/FurutaPendulum-v0 | 2 |"];
        let written = table(&[furuta, "| hive/Gone-v0 | 3 |"]);
        assert_eq!(super::joined(&written, &table(&[acrobot])), table(&[acrobot, furuta]));
        let again = "| hive/FurutaPendulum-v0 | 4 |";
        assert_eq!(super::joined(&table(&[acrobot, furuta]), &table(&[again])), table(&[acrobot, again]));
        assert_eq!(super::joined("", &table(&[furuta, acrobot])), table(&[acrobot, furuta]));
    }
}
