//! `identify`: parameters from logs that `sim` wrote.

mod command;

use command::{robohive, scratch, text};
use std::path::PathBuf;

const PENDULUM: &str = r#"<mujoco model="pendulum">
  <option timestep="0.004"/>
  <default><joint damping="DAMPING"/></default>
  <worldbody>
    <body name="arm"><joint name="hinge" axis="0 1 0"/><geom type="capsule" size=".02" fromto="0 0 0 .3 0 0"/></body>
    <body name="other" pos="1 0 0"><joint name="still" axis="0 0 1"/><geom size=".05"/></body>
  </worldbody>
  <sensor><jointpos name="angle" joint="hinge"/><jointvel name="speed" joint="hinge"/></sensor>
</mujoco>"#;

/// A folder with a robot, a model of it with another damping, and a log of the robot.
fn folder(name: &str) -> PathBuf {
    let folder = scratch(name);
    let _ = std::fs::remove_dir_all(&folder);
    std::fs::create_dir_all(&folder).unwrap();
    let path = |name: &str| folder.join(name).to_str().unwrap().to_owned();
    std::fs::write(path("robot.xml"), PENDULUM.replace("DAMPING", "0.02")).unwrap();
    std::fs::write(path("model.xml"), PENDULUM.replace("DAMPING", "0.1")).unwrap();
    let made = robohive(&["sim", &path("robot.xml"), "--seconds", "2", "--out", &path("log.npz"), "--quiet"]);
    assert!(made.status.success(), "{}", text(&made.stderr));
    folder
}

#[test]
fn a_log_of_sim_gives_the_parameters_back() {
    let folder = folder("identify");
    let path = |name: &str| folder.join(name).to_str().unwrap().to_owned();
    let (log, model, out) = (path("log.npz"), path("model.xml"), path("fitted"));
    let words = ["identify", &log, "--model", &model, "--fit", "damping", "--out", &out];
    let done = robohive(&words);
    let said = text(&done.stdout);
    assert!(done.status.success(), "{said}{}", text(&done.stderr));
    assert!(said.contains("not told     +1.00 still.damping"), "{said}");
    let fitted = mjcf::load(format!("{out}/model.xml")).unwrap().model;
    assert!((fitted.dof_damping[0] - 0.02).abs() < 1e-8, "{}", fitted.dof_damping[0]);
    // What the log does not tell stays as it was.
    assert!((fitted.dof_damping[1] - 0.1).abs() < 1e-3, "{}", fitted.dof_damping[1]);
    let table = std::fs::read_to_string(format!("{out}/parameters.csv")).unwrap();
    assert!(table.lines().nth(1).unwrap().starts_with("\"hinge.damping\",0.1,0.0"), "{table}");
    assert!(
        std::fs::read_to_string(format!("{out}/report.html")).unwrap().contains("What the log cannot tell")
    );
    assert!(
        std::fs::read_to_string(format!("{out}/patch.xml"))
            .unwrap()
            .contains("<joint name=\"hinge\" damping=")
    );
    let again = robohive(&words);
    assert_eq!(again.status.code(), Some(2));
    assert!(text(&again.stderr).contains("--force replaces it"));
    assert!(robohive(&[&words[..], &["--force", "--columns", "angle"]].concat()).status.success());
}

#[test]
fn wrong_words_are_refused_with_the_way_out() {
    let folder = folder("identify_wrong");
    let path = |name: &str| folder.join(name).to_str().unwrap().to_owned();
    let (log, model) = (path("log.npz"), path("model.xml"));
    std::fs::write(
        path("other.xml"),
        PENDULUM.replace("<jointpos name=\"angle\" joint=\"hinge\"/>", "").replace("DAMPING", "0"),
    )
    .unwrap();
    let other = path("other.xml");
    let episodes = robohive(&["identify", &path("episodes.h5"), "--model", &model, "--fit", "damping"]);
    assert_eq!(episodes.status.code(), Some(2));
    assert!(text(&episodes.stderr).contains("episodes.h5: recordings of episodes hold actions"));
    for (words, part) in [
        (vec!["--model", &model, "--fit", "hing.damping"], "did you mean 'hinge'?"),
        (vec!["--model", &model, "--fit", "kv"], "there are none"),
        (
            vec!["--model", &model, "--fit", "damping", "--bounds", "hinge.damping=1"],
            "PARAMETERS=NUMBER,NUMBER",
        ),
        (
            vec!["--model", &model, "--fit", "hinge.damping", "--prior", "still.damping=1,1"],
            "none of them is fitted",
        ),
        (vec!["--model", &model, "--fit", "damping", "--columns", "force"], "there are angle, speed"),
        (vec!["--model", &other, "--fit", "damping"], "log.npz, sensordata: has the shape [501, 2]"),
        (vec!["--model", &model, "--fit", "damping", "--out", &log], "this is a file"),
    ] {
        let out = robohive(&[&["identify", log.as_str()], &words[..]].concat());
        assert_eq!(out.status.code(), Some(2), "{words:?}: {}", text(&out.stdout));
        assert!(text(&out.stderr).contains(part), "{words:?}: {}", text(&out.stderr));
    }
}
