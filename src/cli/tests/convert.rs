//! `convert`: models as MJCF, with assets where the file stands.

mod command;

use command::{robohive, scratch, text};
use std::path::PathBuf;

/// An empty folder for one test.
fn folder(name: &str) -> PathBuf {
    let folder = scratch(name);
    let _ = std::fs::remove_dir_all(&folder);
    std::fs::create_dir_all(&folder).unwrap();
    folder
}

fn convert(arguments: &[&str]) -> (bool, String) {
    let out = robohive(&[&["convert"], arguments].concat());
    (out.status.success(), text(&out.stdout) + &text(&out.stderr))
}

#[test]
fn a_model_is_written_elsewhere_with_its_assets() {
    let folder = folder("convert_copied");
    let file = folder.join("arm.xml");
    let path = file.to_str().unwrap();
    let (done, said) = convert(&["mjcf/tests/urdf/arm.urdf", "--out", path, "--copy-assets"]);
    assert!(done, "{said}");
    assert!(folder.join("assets/wedge.obj").exists());
    let written = std::fs::read_to_string(&file).unwrap();
    assert!(written.starts_with("<mujoco model=\"arm\">") && written.contains("file=\"assets/wedge.obj\""));
    // Once more from there: the same text.
    let again = folder.join("again.xml");
    let (done, said) = convert(&[path, "--out", again.to_str().unwrap()]);
    assert!(done, "{said}");
    assert_eq!(std::fs::read_to_string(&again).unwrap(), written);
    std::fs::write(folder.join("assets/wedge.obj"), "other").unwrap();
    let (done, said) = convert(&["mjcf/tests/urdf/arm.urdf", "--out", path, "--copy-assets", "--force"]);
    assert!(!done && said.contains("is another file than"), "{said}");
}

#[test]
fn classes_may_be_kept_as_they_are() {
    let file = folder("convert_kept").join("franka.xml");
    let path = file.to_str().unwrap();
    let (done, said) = convert(&["assets/franka/franka_table.xml", "--out", path, "--keep-defaults"]);
    assert!(done, "{said}");
    let kept = std::fs::read_to_string(&file).unwrap();
    let (done, said) = convert(&["assets/franka/franka_table.xml", "--out", path, "--force"]);
    assert!(done, "{said}");
    let resolved = std::fs::read_to_string(&file).unwrap();
    assert!(kept.contains("<default") && !resolved.contains("class="));
    let (done, said) = convert(&["mjcf/tests/urdf/arm.urdf", "--out", path, "--keep-defaults", "--force"]);
    assert!(!done && said.contains("URDF"), "{said}");
}

#[test]
fn what_cannot_be_written_leaves_no_file() {
    let folder = folder("convert_refused");
    let model = folder.join("faulty.xml");
    std::fs::write(&model, "<mujoco><worldbody><geom siz='1'/></worldbody></mujoco>").unwrap();
    let out = folder.join("out.xml");
    let (done, said) = convert(&[model.to_str().unwrap(), "--out", out.to_str().unwrap()]);
    assert!(!done && said.contains("did you mean 'size'?"), "{said}");
    assert!(!out.exists());
}
