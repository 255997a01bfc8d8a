//! The numbers that README.md lists under *Measured* are those of the tables that it names.

use std::path::Path;

fn read(path: &str) -> String {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    std::fs::read_to_string(root.join(path)).unwrap_or_else(|error| panic!("{path}: {error}"))
}

fn results(name: &str) -> String {
    read(&format!("validation/results/{name}.md"))
}

/// Cells of the table rows that begin with a cell for which `picks` says so.
fn rows(text: &str, picks: impl Fn(&str) -> bool) -> Vec<Vec<String>> {
    let cells = |line: &str| line.trim_matches('|').split('|').map(|cell| cell.trim().to_owned()).collect();
    let all = text.lines().filter(|line| line.starts_with("| ")).map(cells);
    all.filter(|cells: &Vec<String>| picks(&cells[0])).collect()
}

/// The number after the first `before` of a text, as it stands there.
fn number(text: &str, before: &str) -> f64 {
    let (_, rest) = text.split_once(before).unwrap_or_else(|| panic!("no {before:?}"));
    let digits = rest.trim_start().split(|c: char| !(c.is_ascii_digit() || c == '.')).next();
    digits.and_then(|digits| digits.trim_end_matches('.').parse().ok()).expect("a number")
}

/// The least and the largest number of a column.
fn range(rows: &[Vec<String>], column: usize) -> [f64; 2] {
    let numbers: Vec<f64> = rows.iter().map(|row| row[column].parse().expect("a number")).collect();
    assert!(numbers.len() >= 5, "{numbers:?}");
    numbers.iter().fold([f64::INFINITY, 0.0], |[low, high], &n| [low.min(n), high.max(n)])
}

/// What README.md says in the row that links to a file of results.
fn said(readme: &str, name: &str) -> String {
    let link = format!("](validation/results/{name}.md)");
    let row = readme.lines().find(|line| line.starts_with("| ") && line.contains(&link));
    let (text, _) = row.and_then(|row| row.split_once(&link)).unwrap_or_else(|| panic!("no row of {name}"));
    text.rsplit_once('[').expect("a link").1.to_owned()
}

#[test]
fn every_table_says_where_it_comes_from() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("results");
    let files = std::fs::read_dir(&folder).unwrap().map(|entry| entry.unwrap().path());
    let tables: Vec<_> = files.filter(|path| path.extension().is_some_and(|end| end == "md")).collect();
    assert!(tables.len() > 25, "{}", tables.len());
    for path in tables {
        let text = std::fs::read_to_string(&path).unwrap();
        let made = text.lines().find_map(|line| line.strip_prefix("Made from commit "));
        let (commit, rest) = made.and_then(|made| made.split_once([' ', ','])).unwrap_or_default();
        let is_commit = (7..=40).contains(&commit.len()) && commit.bytes().all(|b| b.is_ascii_hexdigit());
        assert!(is_commit && rest.contains("on "), "{}: {made:?}; run cargo xtask results", path.display());
    }
}

#[test]
fn physics_and_compilation() {
    let readme = read("README.md");
    let own = results("robohive");
    let expected = "Of 56 models: loaded 56, compiled alike 56, all stages alike 56, forward alike 56, rollout follows 51";
    assert!(own.contains(expected) && said(&readme, "robohive") == "56");
    assert!(readme.contains("[56](validation/results/last_bit.md); [51](validation/results/robohive.md)"));
    let all = rows(&results("collisions"), |name| name == "all");
    let total = |column: usize| all[0][column].parse::<f64>().expect("a number");
    let placements = format!("{} of {:.1} million", total(6), total(1) / 1e6);
    assert_eq!(said(&readme, "collisions"), placements);
    let (steps, compile) = (results("steps"), results("compile"));
    let [one, least] = ["Geometric mean", "; least"].map(|before| number(&steps, before));
    let [other, other_least] = ["mean of", ", the least"].map(|before| number(&steps, before));
    assert_eq!(said(&readme, "steps"), format!("{one:.2} ({least:.2}), {other:.2} ({other_least:.2})"));
    let [cold, cached] = ["ratios, wall (processor): cold", "cached"].map(|before| {
        let (_, sums) = compile.split_once("geometric means of the").expect("a sum");
        number(sums, before)
    });
    assert_eq!(said(&readme, "compile"), format!("{cold:.2}, {cached:.2}"));
}

#[test]
fn environments_and_python() {
    let readme = read("README.md");
    let compared = rows(&results("environments"), |id| id.starts_with('`')).len();
    assert_eq!(said(&readme, "environments"), format!("521 of 521; {compared} of {compared}"));
    let speed = results("environments_speed");
    let [original, c] = ["Geometric means:", "x RoboHive,"].map(|before| number(&speed, before));
    assert_eq!(said(&readme, "environments_speed"), format!("{original:.1} ({c:.1})"));
    let mut visual = rows(&results("environments_visual"), |id| id.contains("_v2d-"));
    visual.retain(|row| row.len() == 8);
    let visual = range(&visual, 4);
    assert_eq!(said(&readme, "environments_visual"), format!("{:.0} to {:.0}", visual[0], visual[1]));
    assert!(results("standin").contains(&format!("{} environments agree", said(&readme, "standin"))));
    assert!(results("standin_suite").contains(&format!("{} tasks run", said(&readme, "standin_suite"))));
    let tests = rows(&results("standin_tests"), |first| first == "all");
    let passing = tests[0][2].split(',').next();
    assert_eq!(
        passing.map(|passing| format!("{passing} of {}", tests[0][1])),
        Some(said(&readme, "standin_tests"))
    );
    let muscles = results("standin_myosuite");
    let [run, on_ours] = ["ids; ", "run on MuJoCo, "].map(|before| number(&muscles, before));
    assert_eq!(said(&readme, "standin_myosuite"), format!("{on_ours} of {run}"));
    let python = results("python_speed");
    let on_one = |picks: &dyn Fn(&str) -> bool| {
        let rows = rows(&python, |id| picks(id));
        let one: Vec<_> = rows.into_iter().filter(|row| row[1] == "1").collect();
        range(&one, 7)
    };
    let [muscle, gymnasium] = [on_one(&|id| id.starts_with("myo")), on_one(&|id| id.ends_with("-v5"))];
    let text = format!("{:.1} to {:.1}; {:.1} to {:.1}", muscle[0], muscle[1], gymnasium[0], gymnasium[1]);
    assert_eq!(said(&readme, "python_speed"), text);
}

#[test]
fn pictures() {
    let (readme, table) = (read("README.md"), results("pictures"));
    let line = table.lines().find(|line| line.starts_with("- 224 x 224, 16 scenes:")).expect("a summary");
    let [shadows, plain] = ["PSNR", "PSNR without shadows"].map(|before| number(line, before));
    assert!(said(&readme, "pictures").starts_with(&format!("{shadows:.1} dB, {plain:.1} dB;")));
}

/// The table of ids by suite, RoboHive's own and those on our models.
fn counts() -> String {
    let registry = env::Registry::builtin();
    let mut suites: Vec<(&str, [usize; 2])> = Vec::new();
    for spec in registry.specs() {
        // A twin belongs to the suite of the id that it is a twin of.
        let named = spec.id.strip_prefix("hive/").unwrap_or(&spec.id);
        let suite = registry.spec(named).map_or(spec.suite.as_str(), |original| original.suite.as_str());
        let own = usize::from(spec.id.starts_with("hive/"));
        match suites.iter_mut().find(|(name, _)| *name == suite) {
            Some((_, counts)) => counts[own] += 1,
            None => suites.push((suite, [1 - own, own])),
        }
    }
    let row = |(name, [theirs, ours]): &(&str, [usize; 2])| format!("| {name} | {theirs} | {ours} |\n");
    let rows: String = suites.iter().map(row).collect();
    let [theirs, ours] = [0, 1].map(|own| suites.iter().map(|(_, counts)| counts[own]).sum::<usize>());
    format!(
        "| suite | on models to import | on our own |\n|---|---|---|\n{rows}| all | {theirs} | {ours} |\n"
    )
}

#[test]
fn counts_of_ids_are_those_of_the_registry() {
    let readme = read("README.md");
    let (_, rest) = readme.split_once("<!-- counts of ids begin -->\n").expect("a table of ids");
    let (said, _) = rest.split_once("<!-- counts of ids end -->").expect("its end");
    let counts = counts();
    assert!(
        said == counts,
        "README.md has other counts of ids than the registry; write between the marks:\n{counts}"
    );
}
