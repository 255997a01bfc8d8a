//! What commands write: never over their input, never under a name that denies the content, never half.

mod command;

use command::{robohive, scratch, text};
use dataset::NpzReader;
use std::path::{Path, PathBuf};

const BALL: &str = "<mujoco><worldbody><body><freejoint/><geom size='.1'/></body></worldbody></mujoco>";
const REACH: &str = "hive/FrankaReach-v0";

/// A folder for one test with `ball.xml` in it.
fn folder(name: &str) -> PathBuf {
    let folder = scratch(name);
    let _ = std::fs::remove_dir_all(&folder);
    std::fs::create_dir_all(&folder).unwrap();
    std::fs::write(folder.join("ball.xml"), BALL).unwrap();
    folder
}

/// The names in a folder.
fn names(folder: &Path) -> Vec<String> {
    let entries = std::fs::read_dir(folder).unwrap();
    let mut names: Vec<_> = entries.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
    names.sort();
    names
}

/// What the command says when it ends with this code.
fn ends(code: i32, arguments: &[&str]) -> String {
    let out = robohive(arguments);
    assert_eq!(out.status.code(), Some(code), "{arguments:?}: {}{}", text(&out.stdout), text(&out.stderr));
    text(&out.stderr)
}

/// What the command says when it refuses its arguments.
fn refused(arguments: &[&str]) -> String {
    ends(2, arguments)
}

#[test]
fn a_model_is_not_converted_onto_what_it_is_read_from() {
    let folder = folder("own_input");
    let path = |name: &str| folder.join(name).to_str().unwrap().to_owned();
    let (ball, whole, out) = (path("ball.xml"), path("whole.xml"), path("out.xml"));
    std::fs::write(&whole, "<mujoco><include file='ball.xml'/></mujoco>").unwrap();
    for words in [["convert", &ball, "--out", &ball], ["convert", &whole, "--out", &ball]] {
        let forced = refused(&[&words[..], &["--force"]].concat());
        assert!(forced.contains("input and output are one file"), "{forced}");
        assert_eq!(std::fs::read_to_string(&ball).unwrap(), BALL);
    }
    let copied = ["convert", &ball, "--out", &out];
    assert!(robohive(&copied).status.success());
    assert!(refused(&copied).contains("the file exists; --force replaces it"));
    assert!(robohive(&[&copied[..], &["--force"]].concat()).status.success());
}

#[test]
fn a_compiled_model_and_an_archive_are_not_written_onto_themselves() {
    let folder = folder("own_archive");
    let path = |name: &str| folder.join(name).to_str().unwrap().to_owned();
    let (ball, compiled, motion) = (path("ball.xml"), path("ball.rhm"), path("motion.npz"));
    assert!(robohive(&["compile", &ball, "--out", &compiled]).status.success());
    assert!(refused(&["compile", &compiled, "--out", &compiled]).contains("one file"));
    assert!(robohive(&["sim", &ball, "--seconds", "0.01", "--out", &motion, "-q"]).status.success());
    let before = std::fs::read(&motion).unwrap();
    assert!(refused(&["trace", &ball, "--in", &motion, "--out", &motion]).contains("one file"));
    assert!(
        refused(&["rollout", REACH, "--actions", &motion, "--out", &motion]).contains("one file"),
        "a rollout replaces its actions"
    );
    assert_eq!(std::fs::read(&motion).unwrap(), before);
}

#[test]
fn no_folder_is_made_for_a_file() {
    let folder = folder("missing_folder");
    let path = |name: &str| folder.join(name).to_str().unwrap().to_owned();
    let ball = path("ball.xml");
    let commands: [(&[&str], &str); 4] = [
        (&["convert", &ball, "--out"], "none/deep/a.xml"),
        (&["compile", &ball, "--out"], "none/a.rhm"),
        (&["sim", &ball, "--out"], "none/a.npz"),
        (&["run", REACH, "--record"], "none/a.h5"),
    ];
    for (words, name) in commands {
        let said = ends(1, &[words, &[&path(name)]].concat());
        assert!(said.contains("there is no folder") && said.contains("make it"), "{said}");
    }
    assert_eq!(names(&folder), ["ball.xml"]);
}

#[test]
fn endings_are_checked_before_the_work_begins() {
    let folder = folder("endings");
    let path = |name: &str| folder.join(name).to_str().unwrap().to_owned();
    // No model is there: what is said of the name is said before anything is read.
    let missing = path("missing.xml");
    let commands: [(&[&str], &str, &str); 8] = [
        (&["convert", &missing, "--out"], "e.rhm", "models are written to .xml files"),
        (&["compile", &missing, "--out"], "e.xml", "compiled models are .rhm files"),
        (&["sim", &missing, "--out"], "x.foo", "numpy archives are .npz files"),
        (&["trace", &missing, "--in", "a.npz", "--out"], "x.h5", "numpy archives are .npz files"),
        (&["rollout", "no/Id-v0", "--actions", "a.npz", "--out"], "x", "numpy archives are .npz files"),
        (&["run", "no/Id-v0", "--record"], "x.txt", "recordings are .h5 or .hdf5 (HDF5), or .npz"),
        (&["data", "convert", "missing.h5"], "x.txt", "recordings are .h5 or .hdf5 (HDF5), or .npz"),
        (&["data", "repair", "missing.h5", "--out"], "x.npz", "repaired recordings are .h5 or .hdf5"),
    ];
    for (words, name, reason) in commands {
        let said = refused(&[words, &[&path(name)]].concat());
        assert!(said.contains(reason), "{said}");
    }
    assert_eq!(names(&folder), ["ball.xml"]);
}

#[test]
fn large_numbers_are_shown_in_powers_of_ten() {
    let said = refused(&["sim", "assets/pile/pile.xml", "--seconds", "1e300"]);
    assert!(said.contains("--seconds 1e300 asks for 5e302 steps") && !said.contains("00000000000"), "{said}");
}

#[test]
fn a_recording_does_not_take_the_place_of_a_folder() {
    let folder = folder("recorded_folder");
    let place = folder.join("episodes.h5");
    std::fs::create_dir(&place).unwrap();
    let said = ends(1, &["run", REACH, "--episodes", "1", "-q", "--record", place.to_str().unwrap()]);
    assert!(said.contains("this is a folder"), "{said}");
    assert_eq!(names(&folder), ["ball.xml", "episodes.h5"]);
}

/// A walk whose reward has a term `done` is recorded like any other; `rwd_dict/done` is written once.
#[test]
fn a_reward_term_may_be_called_as_a_verdict() {
    let path = scratch("walk.npz");
    let name = path.to_str().unwrap();
    let walk = ["run", "hive/myoLegWalk-v0", "--policy", "zero", "--episodes", "1", "--record", name];
    let out = robohive(&walk);
    assert!(out.status.success(), "{}", text(&out.stderr));
    let archive = NpzReader::open(&path).unwrap();
    let [fallen, ended] =
        ["Trial0/env_infos/rwd_dict/done", "Trial0/done"].map(|row| archive.require(row).unwrap());
    assert!(ended.rows() > 5 && fallen.values.to_f64() == ended.values.to_f64());
}
