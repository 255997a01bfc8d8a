//! `data`: recordings looked into, repaired and converted by a user.

mod command;

use command::{command, robohive, scratch, text};
use dataset::NpzReader;
use std::fs::File;

const ROBOHIVE: &str = "validation/reference/traces/robohive.h5";
const ROBOSET: &str = "validation/reference/traces/roboset.h5";

#[test]
fn inspect_names_layout_trials_types_and_success() {
    let out = text(&robohive(&["data", "inspect", ROBOHIVE]).stdout);
    for line in
        ["layout       RoboHive", "trials       3 with 36 rows", "solved       2 of 3 trials (66.7 %)"]
    {
        assert!(out.contains(line), "{out}");
    }
    let actions = out.lines().find(|line| line.starts_with("actions ")).unwrap();
    assert!(
        actions.contains("rows x 8") && actions.contains("float64") && actions.ends_with("24 NaN"),
        "{actions}"
    );
    let each = text(&robohive(&["data", "inspect", ROBOSET, "--trials"]).stdout);
    assert!(each.contains("Trial1 with 9 rows") && each.contains("\"open the drawer\""), "{each}");
    assert!(each.contains("solved       2 of 2 trials (100.0 %)"), "{each}");
}

#[test]
fn inspect_prints_json_also_of_standard_input() {
    let direct = text(&robohive(&["data", "inspect", ROBOHIVE, "--json"]).stdout);
    let input = File::open(std::path::Path::new(command::ROOT).join(ROBOHIVE)).unwrap();
    let piped = command().args(["data", "inspect", "-", "--json"]).stdin(input).output().unwrap();
    assert_eq!(text(&piped.stdout), direct);
    let json: serde_json::Value = serde_json::from_str(&direct).unwrap();
    let trial = &json["trials"][2];
    assert_eq!(
        (&trial["name"], &trial["rows"], &trial["solved"]),
        (&"Trial10".into(), &12.into(), &false.into())
    );
    let column =
        trial["columns"].as_array().unwrap().iter().find(|column| column["key"] == "actions").unwrap();
    assert_eq!(column["shape"], serde_json::json!([12, 8]));
    assert_eq!((&column["dtype"], &column["nan"]), (&"float64".into(), &8.into()));
}

#[test]
fn convert_names_what_has_no_place_and_replaces_nothing_unasked() {
    let (npz, set) = (scratch("trials.npz"), scratch("set.h5"));
    let [npz, set] = [&npz, &set].map(|path| path.to_str().unwrap());
    let out = robohive(&["data", "convert", ROBOSET, npz, "--force"]);
    assert!(out.status.success(), "{}", text(&out.stderr));
    assert!(text(&out.stderr).contains("config/task: numpy archives hold no texts"), "{}", text(&out.stderr));
    let archive = NpzReader::open(npz.as_ref()).unwrap();
    assert_eq!(archive.require("Trial1/data/ctrl_arm").unwrap().shape, [9, 7]);

    let again = robohive(&["data", "convert", ROBOSET, npz]);
    assert_eq!(again.status.code(), Some(2));
    assert!(text(&again.stderr).contains("--force"));
    let same = robohive(&["data", "convert", npz, npz, "--force"]);
    assert!(text(&same.stderr).contains("one file") && NpzReader::open(npz.as_ref()).is_ok());

    let out = robohive(&["data", "convert", ROBOHIVE, set, "--layout", "roboset", "--force"]);
    assert!(
        text(&out.stderr).contains("not written: rewards: no place in RoboSet's layout"),
        "{}",
        text(&out.stderr)
    );
    let shown = text(&robohive(&["data", "inspect", set]).stdout);
    assert!(shown.contains("layout       RoboSet") && shown.contains("data/rgb_left"), "{shown}");
}

#[test]
fn a_number_that_does_not_fit_leaves_no_file() {
    let (full, reduced) = (scratch("large.npz"), scratch("large.h5"));
    let mut writer = dataset::NpzWriter::create(&full).unwrap();
    writer.add("Trial0/rewards", &dataset::Array::f64(vec![2], vec![1.0, 1e5])).unwrap();
    writer.finish().unwrap();
    let words = [
        "data",
        "convert",
        full.to_str().unwrap(),
        reduced.to_str().unwrap(),
        "--precision",
        "reduced",
        "--force",
    ];
    let out = robohive(&words);
    assert_eq!(out.status.code(), Some(1));
    assert!(text(&out.stderr).contains("100000 does not fit into float16"), "{}", text(&out.stderr));
    assert!(!reduced.exists());
}

#[test]
fn repair_puts_the_readable_trials_in_place_and_keeps_the_damaged_file() {
    let path = scratch("damaged.h5");
    let name = path.to_str().unwrap();
    robohive(&["data", "convert", ROBOHIVE, name, "--force"]);
    let sound = robohive(&["data", "repair", name]);
    assert!(text(&sound.stdout).ends_with("nothing to repair\n"), "{}", text(&sound.stdout));

    let bytes = std::fs::read(&path).unwrap();
    let cut = bytes.len() - 600;
    std::fs::write(&path, &bytes[..cut]).unwrap();
    let refused = robohive(&["data", "inspect", name]);
    assert_eq!(refused.status.code(), Some(2));
    assert!(text(&refused.stderr).contains("it is cut off"), "{}", text(&refused.stderr));
    let out = robohive(&["data", "repair", name]);
    assert!(
        text(&out.stdout).contains("saved        2 trials"),
        "{}{}",
        text(&out.stdout),
        text(&out.stderr)
    );
    assert!(text(&robohive(&["data", "inspect", name]).stdout).contains("trials       2 with 24 rows"));
    assert_eq!(std::fs::read(format!("{name}.damaged")).unwrap().len(), cut);
}

#[test]
fn what_is_no_recording_is_refused_with_the_reason() {
    let out = robohive(&["data", "inspect", "Cargo.toml"]);
    assert_eq!(out.status.code(), Some(2));
    assert!(text(&out.stderr).contains("Cargo.toml: this is no HDF5 file"), "{}", text(&out.stderr));
    let out = robohive(&["data", "inspect", "validation/reference/own/elbow.npz"]);
    assert!(text(&out.stderr).contains("no recording"), "{}", text(&out.stderr));
    assert_eq!(robohive(&["data", "repair", "no_such.h5"]).status.code(), Some(2));
}
