//! Training, and reports of runs, as the command does them.

mod command;

use command::{robohive, scratch, text};

const ID: &str = "hive/myoElbowPose1D6MRandom-v0";

/// What the command says of wrong arguments.
fn refused(arguments: &[&str]) -> String {
    let out = robohive(arguments);
    assert_eq!(out.status.code(), Some(2), "{arguments:?}: {}", text(&out.stderr));
    text(&out.stderr)
}

/// Makes an iteration of four episodes, from the configuration in a folder, with a seed.
fn train(config: &str, seed: &str, out: &str) {
    _ = std::fs::remove_dir_all(out);
    let done = robohive(&["train", config, "--seed", seed, "--iterations", "1", "--out", out, "--quiet"]);
    assert!(done.status.success(), "{}", text(&done.stderr));
}

#[test]
fn a_report_compares_seeds() {
    let [plan, one, two, page] =
        ["plan", "one", "two", "runs.html"].map(|name| scratch(name).display().to_string());
    _ = std::fs::remove_dir_all(&plan);
    let made = robohive(&["train", ID, "--iterations", "0", "--out", &plan, "--quiet"]);
    assert!(made.status.success(), "{}", text(&made.stderr));
    let written = std::fs::read_to_string(format!("{plan}/run.toml")).unwrap();
    let config = format!("{plan}/four.toml");
    std::fs::write(&config, written.replace("episodes = 96", "episodes = 4")).unwrap();
    train(&config, "1", &one);
    train(&config, "2", &two);
    let out = robohive(&["report", &one, &two, "--episodes", "3", "--json", "--html", &page]);
    let report: serde_json::Value = serde_json::from_slice(&out.stdout).unwrap();
    let row = &report["rows"][0];
    assert_eq!((&row["id"], &row["algorithm"]), (&ID.into(), &"npg".into()));
    assert_eq!(row["seeds"], serde_json::json!([1, 2]));
    assert_eq!(row["num_samples"], 800.0, "four episodes to see and four to learn from, of 100 steps");
    let [low, high] = [0, 1].map(|k| row["interval"][k].as_f64().unwrap());
    let mean = row["interquartile_mean"].as_f64().unwrap();
    assert!(low <= mean && mean <= high, "{row}");
    let html = std::fs::read_to_string(&page).unwrap();
    assert!(html.matches("<polyline").count() == 2 && html.contains(ID), "{html}");
    assert!(refused(&["report", &one, &one, "--episodes", "1"]).contains("with seed 1 is here already"));
    std::fs::write(format!("{two}/log.csv"), "iteration\n1\n").unwrap();
    assert!(refused(&["report", &two, "--episodes", "1"]).contains("does not name the columns"));
}

#[test]
fn who_teaches_is_said_where_it_is_needed() {
    let id = "hive/FrankaReach-v0";
    for (arguments, why) in [
        (&["--algo", "bc"][..], "add --teacher NAME|FILE"),
        (&["--teacher", "reach"], "only bc, dagger and dapg learn from a teacher"),
        (
            &["--algo", "dapg", "--demonstrations", "3"],
            "--demonstrations and --demonstration-noise are a teacher's",
        ),
        (&["--algo", "bc", "--teacher", "nobody"], "nobody is no controller"),
        (&["--algo", "bc", "--teacher", "claw_turn"], "claw_turn"),
        (
            &["--algo", "bc", "--teacher", "reach", "--demonstration-noise=-1"],
            "must not be below 0, and is -1",
        ),
    ] {
        let out = scratch("never").display().to_string();
        let said = refused(&[&["train", id, "--quiet", "--out", &out], arguments].concat());
        assert!(said.contains(why), "{said}");
        assert!(!scratch("never").exists());
    }
}
