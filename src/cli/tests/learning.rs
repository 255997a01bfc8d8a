//! Training, sweeps and reports of runs, as the command does them.

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
    let [plan, one, two, other, page] =
        ["plan", "one", "two", "other", "runs.html"].map(|name| scratch(name).display().to_string());
    _ = std::fs::remove_dir_all(&plan);
    let made = robohive(&["train", ID, "--iterations", "0", "--out", &plan, "--quiet"]);
    assert!(made.status.success(), "{}", text(&made.stderr));
    let written = std::fs::read_to_string(format!("{plan}/run.toml")).unwrap();
    let config = format!("{plan}/four.toml");
    std::fs::write(&config, written.replace("episodes = 96", "episodes = 4")).unwrap();
    train(&config, "1", &one);
    train(&config, "2", &two);
    let wide = format!("{plan}/wide.toml");
    std::fs::write(&wide, written.replace("episodes = 96", "episodes = 4").replace("[32, 32]", "[8]"))
        .unwrap();
    train(&wide, "1", &other);
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
    let out = robohive(&["report", &one, &other, "--episodes", "3", "--json"]);
    let report: serde_json::Value = serde_json::from_slice(&out.stdout).unwrap();
    let hidden = [0, 1].map(|row| &report["rows"][row]["settings"]);
    assert_eq!(hidden[0], &serde_json::json!({ "learning.hidden": "[[32, 32], [128, 128]]" }));
    assert_eq!(hidden[1], &serde_json::json!({ "learning.hidden": "[[8], [128, 128]]" }));
    std::fs::write(format!("{two}/log.csv"), "iteration\n1\n").unwrap();
    assert!(refused(&["report", &two, "--episodes", "1"]).contains("does not name the columns"));
}

#[test]
fn who_teaches_is_said_where_it_is_needed() {
    let id = "hive/FrankaReach-v0";
    for (arguments, why) in [
        (&["--algo", "bc"][..], "name a controller or the file of a policy (--teacher)"),
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

/// Runs a sweep over two sizes and two seeds.
fn sweep(out: &str, more: &[&str]) -> std::process::Output {
    let own = ["sweep", ID, "--vary", "learning.episodes=4,6", "--seeds", "1,3", "--out", out, "--json"];
    robohive(&[&own, more].concat())
}

#[test]
fn a_sweep_makes_the_runs_of_train() {
    let [out, plan, alone] = ["sweep", "sweep plan", "alone"].map(|name| scratch(name).display().to_string());
    for folder in [&out, &plan] {
        _ = std::fs::remove_dir_all(folder);
    }
    let done = sweep(&out, &["--iterations", "1", "--jobs", "3"]);
    assert!(done.status.success(), "{}", text(&done.stderr));
    let table: serde_json::Value = serde_json::from_slice(&done.stdout).unwrap();
    let success = [0, 1].map(|row| table["rows"][row]["success_percentage"].as_f64().unwrap());
    assert!(success[0] >= success[1] && table["rows"][0]["seeds"] == serde_json::json!([1, 3]), "{table}");
    assert!(robohive(&["train", ID, "--iterations", "0", "--out", &plan, "--quiet"]).status.success());
    let written = std::fs::read_to_string(format!("{plan}/run.toml")).unwrap();
    let config = format!("{plan}/changed.toml");
    for (episodes, seed) in [("4", "1"), ("4", "3"), ("6", "1"), ("6", "3")] {
        std::fs::write(&config, written.replace("episodes = 96", &format!("episodes = {episodes}"))).unwrap();
        train(&config, seed, &alone);
        for file in ["run.toml", "checkpoint.safetensors", "policy.safetensors"] {
            let swept = std::fs::read(format!("{out}/episodes={episodes}-seed{seed}/{file}")).unwrap();
            assert!(swept == std::fs::read(format!("{alone}/{file}")).unwrap(), "{episodes} {seed} {file}");
        }
    }
    let run = |name: &str, iterations: &str| {
        let config = std::fs::read_to_string(format!("{out}/{name}/run.toml")).unwrap();
        assert!(config.contains(&format!("iterations = {iterations}\n")), "{config}");
        let log = std::fs::metadata(format!("{out}/{name}/log.csv")).unwrap();
        (std::fs::read(format!("{out}/{name}/checkpoint.safetensors")).unwrap(), log.modified().unwrap())
    };
    let names = ["episodes=4-seed1", "episodes=4-seed3", "episodes=6-seed1", "episodes=6-seed3"];
    let before = names.map(|name| run(name, "1"));
    std::fs::remove_dir_all(format!("{out}/{}", names[2])).unwrap();
    assert!(sweep(&out, &["--iterations", "1"]).status.success());
    let after = names.map(|name| run(name, "1"));
    for (place, name) in names.iter().enumerate() {
        let ([bytes, again], [then, now]) =
            ([&before[place].0, &after[place].0], [before[place].1, after[place].1]);
        assert!(bytes == again && (then == now) == (place != 2), "{name}");
    }
    assert!(sweep(&out, &["--iterations", "2"]).status.success());
    _ = std::fs::remove_dir_all(&alone);
    let further =
        robohive(&["train", &config, "--seed", "3", "--iterations", "2", "--quiet", "--out", &alone]);
    assert!(further.status.success(), "{}", text(&further.stderr));
    let bytes = std::fs::read(format!("{alone}/checkpoint.safetensors")).unwrap();
    assert!(bytes == run(names[3], "2").0, "a run that went on is one that was made at once");
    let why = text(&sweep(&out, &["--iterations", "1"]).stderr);
    assert!(why.contains("run.toml has 2 for iterations, and 1 is asked for"), "{why}");
    let why = text(&sweep(&out, &["--iterations", "2", "--algo", "ppo"]).stderr);
    assert!(why.contains("episodes=4-seed1: its run.toml has"), "{why}");
}

#[test]
fn a_sweep_says_what_is_wrong_before_it_begins() {
    let out = scratch("unswept").display().to_string();
    for (arguments, why) in [
        (
            &["--vary", "learning.fit.rte=1"][..],
            "the setting learning.fit.rte: there is no \"rte\" among epochs, batch, rate, longest",
        ),
        (&["--vary", "learning.episodes=4,x"], "the setting learning.episodes: invalid type: string \"x\""),
        (&["--vary", "learning.fit.rate=0.1,-1"], "fit.rate must be above 0, and is -1"),
        (&["--vary", "environment.gravity_of=1"], "unknown field `gravity_of`"),
        (&["--vary", "learning.episodes=4,04.0"], "learning.episodes"),
        (&["--vary", "learning.fit.rate=0.1,1e-1"], "fit.rate=0.1 and fit.rate=1e-1 are the same"),
        (&["--vary", "learning.hidden=[[4],[4]"], "not closed"),
        (&["--vary", "learning.episodes=4", "--vary", "learning.episodes=5"], "is there twice"),
        (&["--vary", "learning.episodes=4,5", "--seeds", "501"], "these are 1002 runs"),
        (&["--vary", "seed=1,2"], "--seeds"),
        (&["--seeds", "1,1"], "the seed 1 is there twice"),
        (&["--algo", "bc"], "name a controller or the file of a policy (--teacher)"),
        (&["--algo", "bc", "--teacher", "nobody"], "nobody is no controller"),
    ] {
        let said = refused(&[&["sweep", ID, "--out", &out], arguments].concat());
        assert!(said.contains(why), "{said}");
        assert!(!scratch("unswept").exists());
    }
}

/// A step without bounds makes a policy whose actions are no numbers.
#[test]
fn a_run_that_fails_stops_no_other() {
    let out = scratch("failing").display().to_string();
    _ = std::fs::remove_dir_all(&out);
    let vary = ["--vary", "learning.algorithm.npg.step=1e38,0.1", "--vary", "learning.episodes=2"];
    let own = ["sweep", ID, "--iterations", "3", "--jobs", "1", "--out", &out, "--json"];
    let done = robohive(&[&own[..], &vary].concat());
    let why = text(&done.stderr);
    assert!(done.status.code() == Some(1) && why.contains("1 of 2 runs failed:\n"), "{why}");
    assert!(why.contains("algorithm.npg.step=1e38-episodes=2-seed1: "), "{why}");
    let table: serde_json::Value = serde_json::from_slice(&done.stdout).unwrap();
    assert_eq!(table["rows"][0]["settings"]["learning.algorithm.npg.step"], "0.1");
    assert_eq!(
        (&table["rows"][0]["num_samples"], &table["rows"][1]["seeds"]),
        (&800.0.into(), &[0; 0][..].into())
    );
    assert!(table["failed"][0]["run"].as_str().unwrap().contains("1e38"), "{table}");
}
