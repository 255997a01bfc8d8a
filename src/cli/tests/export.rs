//! `data export`: recordings made into datasets by a user.

mod command;

use command::{robohive, scratch, text};
use exchange::lerobot::{Cells, LeRobotReader};

const ROBOHIVE: &str = "validation/reference/traces/robohive.h5";

#[test]
fn a_dataset_of_minari_has_its_files() {
    let root = scratch("minari");
    _ = std::fs::remove_dir_all(&root);
    let args = ["data", "export", "minari", ROBOHIVE, "robohive/franka/random-v0", "--root"];
    let export = || robohive(&[&args[..], &[root.to_str().unwrap()]].concat());
    let out = export();
    assert!(out.status.success(), "{}", text(&out.stderr));
    assert!(text(&out.stdout).contains("3 episodes, 33 steps"), "{}", text(&out.stdout));
    let folder = root.join("robohive/franka/random-v0/data");
    let metadata = std::fs::read_to_string(folder.join("metadata.json")).unwrap();
    let metadata: serde_json::Value = serde_json::from_str(&metadata).unwrap();
    assert_eq!(metadata["total_steps"], 33);
    assert!(root.join("robohive/franka/namespace_metadata.json").is_file());
    let trace = dataset::trace::TraceReader::open(&folder.join("main_data.hdf5")).unwrap();
    assert_eq!(trace.integers("episode_2").unwrap(), [("id".into(), 2), ("total_steps".into(), 11)]);
    assert_eq!(trace.entry("episode_2", "observations").unwrap().shape, [12, 18]);
    assert_eq!(trace.entry("episode_2", "infos/solved").unwrap().shape, [12]);
    let again = export();
    assert_eq!(again.status.code(), Some(2));
    assert!(text(&again.stderr).contains("the dataset exists"), "{}", text(&again.stderr));
}

#[test]
fn a_dataset_of_lerobot_holds_the_steps() {
    let root = scratch("lerobot");
    _ = std::fs::remove_dir_all(&root);
    let args = [
        "data",
        "export",
        "lerobot",
        ROBOHIVE,
        root.to_str().unwrap(),
        "--task",
        "reach",
        "--pictures",
        "png",
    ];
    let out = robohive(&args);
    assert!(out.status.success(), "{}", text(&out.stderr));
    let frames = LeRobotReader::open(&root).unwrap();
    assert_eq!((frames.episodes(), frames.task(0)), (3, Some("reach")));
    let columns = frames.read(2).unwrap();
    let trace =
        dataset::trace::TraceReader::open(&std::path::Path::new(command::ROOT).join(ROBOHIVE)).unwrap();
    let expected = trace.read(&trace.entry("Trial10", "observations").unwrap()).unwrap().values.to_f64();
    let state = columns.iter().find(|column| column.name == "observation.state").unwrap();
    let Cells::F32(state_cells) = &state.cells else { panic!("{state:?}") };
    let single: Vec<f32> = expected[..11 * 18].iter().map(|&x| x as f32).collect();
    assert_eq!(state_cells, &single);
    assert!(columns.iter().any(|column| column.name == "observation.images.left_cam"));
}

#[test]
fn wrong_arguments_are_named() {
    let id = robohive(&["data", "export", "minari", ROBOHIVE, "door"]);
    assert_eq!(id.status.code(), Some(2));
    assert!(text(&id.stderr).contains("no dataset id"), "{}", text(&id.stderr));
    let root = scratch("roboset");
    let out = robohive(&[
        "data",
        "export",
        "lerobot",
        "validation/reference/traces/roboset.h5",
        root.to_str().unwrap(),
    ]);
    assert_eq!(out.status.code(), Some(2));
    assert!(text(&out.stderr).contains("RoboHive's layout") && !root.exists(), "{}", text(&out.stderr));
}
