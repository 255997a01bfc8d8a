//! Images on the command line: recorded, described, checked, measured.

mod command;

use command::{robohive, scratch, text};
use dataset::NpzReader;

const ID: &str = "hive/FrankaReach_v2d-v0";
const KEYS: &str = "visual_keys=['rgb:front:12x16:2d', 'd:front:12x16:2d']";

#[test]
fn episodes_are_recorded_with_their_images_and_look() {
    let path = scratch("images.npz");
    let path = path.to_str().unwrap();
    let light = "visual_randomization.lights=[{ on = 0.5 }]";
    let arguments =
        ["run", ID, "--episodes", "2", "--set", "max_episode_steps=3", "--set", KEYS, "--set", light];
    let run = robohive(&[&arguments[..], &["--record", path, "--visual"]].concat());
    assert!(run.status.success(), "{}", text(&run.stderr));
    let archive = NpzReader::open(path.as_ref()).unwrap();
    let shape = |name: &str| archive.require(name).unwrap().shape;
    assert_eq!(shape("Trial1/env_infos/visual_dict/rgb:front:12x16:2d"), [4, 12, 16, 3]);
    assert_eq!(shape("Trial1/env_infos/visual_dict/d:front:12x16:2d"), [4, 1, 12, 16]);
    assert_eq!(shape("Trial1/env_infos/visual_dict/time"), [4, 1]);
    assert_eq!(shape("Trial0/visual_randomization/light/0/on"), [1]);
    let colors = archive.require("Trial0/env_infos/visual_dict/rgb:front:12x16:2d").unwrap();
    assert_eq!(colors.values.dtype().name(), "uint8");
    let plain = robohive(&[&arguments[..], &["--record", path]].concat());
    assert!(plain.status.success(), "{}", text(&plain.stderr));
    let archive = NpzReader::open(path.as_ref()).unwrap();
    assert!(archive.names().all(|name| !name.contains("visual_dict")), "images are recorded on request");
}

#[test]
fn images_are_described_checked_and_measured() {
    let info = text(&robohive(&["info", ID]).stdout);
    assert!(info.contains("rgb:front:224x224:2d") && info.contains("224 x 224 x 3, colours"), "{info}");
    assert!(info.contains("1 x 224 x 224, depth in metres"), "{info}");
    let check = robohive(&["check-env", ID, "--visual", "--steps", "5", "--set", KEYS]);
    assert!(check.status.success(), "{}", text(&check.stdout));
    let speed = robohive(&["bench-env", ID, "--visual", "--seconds", "0.01", "--set", KEYS, "--json"]);
    let rows: serde_json::Value = serde_json::from_slice(&speed.stdout).unwrap();
    assert_eq!(rows[0]["images"], 2);
    assert!(rows[0]["steps_per_second_with_images"].as_f64().unwrap() > 0.0);
    let none = robohive(&["bench-env", "hive/FrankaReach-v0", "--visual"]);
    assert!(!none.status.success() && text(&none.stderr).contains("no visual keys"));
}

#[test]
fn missing_weights_are_named() {
    let key = "visual_keys=['rgb:front:224x224:r3m18']";
    let info = text(&robohive(&["info", ID, "--set", key]).stdout);
    assert!(info.contains("512, features"), "{info}");
    let check = robohive(&["check-env", ID, "--visual", "--steps", "5", "--set", key]);
    let said = text(&check.stdout);
    assert!(!check.status.success() && said.contains("r3m18") && said.contains("model.pt"), "{said}");
}
