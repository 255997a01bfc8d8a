//! Controllers of the command `run`.

mod command;

use command::{robohive, text};

const ID: &str = "hive/FrankaReach-v0";

#[test]
fn a_controller_is_listed_and_solves_the_task() {
    let listed = robohive(&["run", ID, "--controller", "list"]);
    assert!(
        listed.status.success() && text(&listed.stdout).starts_with("reach "),
        "{}",
        text(&listed.stdout)
    );
    let run = robohive(&["run", ID, "--controller", "reach", "--episodes", "2", "--quiet"]);
    let said = text(&run.stdout);
    assert!(said.contains("controller reach") && said.contains("success      100.0 %"), "{said}");
}

#[test]
fn what_serves_the_id_is_said() {
    let none = robohive(&["run", "hive/QuadrupedWalk-v0", "--controller", "list"]);
    assert!(
        text(&none.stdout).contains("no controller is made for hive/QuadrupedWalk-v0"),
        "{}",
        text(&none.stdout)
    );
    let error = |words: &[&str]| {
        let out = robohive(&[&["run"], words].concat());
        assert_eq!(out.status.code(), Some(2));
        text(&out.stderr)
    };
    assert!(error(&[ID, "--controller", "rech"]).contains("is served by reach"));
    assert!(error(&["hive/QuadrupedWalk-v0", "--controller", "reach"]).contains("serves reach, not"));
    assert!(error(&[ID, "--controller", "reach", "--policy", "zero"]).contains("cannot be used with"));
}
