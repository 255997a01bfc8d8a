//! The command line as a user meets it: outputs, messages, exit codes.

mod command;

use command::{ROOT, command, robohive, scratch, text};
use dataset::{Array, NpzReader, NpzWriter};
use std::fs::File;
use std::io::Write;
use std::path::Path;
use std::process::Stdio;

fn write(path: &Path, arrays: &[(&str, Array)]) {
    let mut writer = NpzWriter::create(path).unwrap();
    for (name, array) in arrays {
        writer.add(name, array).unwrap();
    }
    writer.finish().unwrap();
}

/// A file of the repository, from wherever tests run.
fn repository(path: &str) -> std::path::PathBuf {
    std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").join(path)
}

#[test]
fn inspect_writes_every_array_under_its_name() {
    let file = scratch("inspect.npz");
    let out =
        robohive(&["inspect", "assets/franka/franka_table.xml", "--npz", file.to_str().unwrap(), "--json"]);
    assert!(out.status.success(), "{}", text(&out.stderr));
    let summary: serde_json::Value = serde_json::from_slice(&out.stdout).unwrap();
    assert_eq!(summary["sizes"]["nq"], 30);
    assert_eq!(summary["joints"].as_array().unwrap().len(), 12);
    let arrays = NpzReader::open(&file).unwrap();
    let inertia = arrays.require("body_inertia").unwrap();
    assert_eq!(inertia.shape, [summary["sizes"]["nbody"].as_u64().unwrap() as usize, 3]);
    assert!(inertia.values.to_f64()[3..].iter().any(|&i| i > 0.0));
    assert_eq!(arrays.require("opt.timestep").unwrap().values.to_f64(), [0.002]);
    // What MuJoCo recorded of a model is there under the same names, settings of pictures and flags included.
    let recorded = NpzReader::open(&repository("validation/reference/own/franka_table.npz")).unwrap();
    for (recorded_name, name) in [
        ("size.flg_gravcomp", "flg_gravcomp"),
        ("size.flg_surfacevel", "flg_surfacevel"),
        ("size.flg_adhesion", "flg_adhesion"),
        ("vis.global.offwidth", "vis.global.offwidth"),
        ("vis.headlight.diffuse", "vis.headlight.diffuse"),
        ("vis.map.znear", "vis.map.znear"),
        ("vis.quality.shadowsize", "vis.quality.shadowsize"),
        ("vis.rgba.haze", "vis.rgba.haze"),
        ("vis.scale.com", "vis.scale.com"),
    ] {
        let theirs = recorded.require(recorded_name).unwrap();
        let ours = arrays.require(name).unwrap();
        assert_eq!((ours.shape, ours.values.to_f64()), (theirs.shape, theirs.values.to_f64()), "{name}");
    }
}

#[test]
fn a_reader_that_stops_early_is_no_failure() {
    let mut child = command()
        .args(["inspect", "assets/franka/franka_table.xml", "--json"])
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    drop(child.stdout.take());
    let out = child.wait_with_output().unwrap();
    assert_eq!((out.status.code(), text(&out.stderr).as_str()), (Some(0), ""));
}

/// Numbers are numbers, limits that are not given are MuJoCo's -1.
#[test]
fn inspect_prints_json_of_the_right_types() {
    let out = robohive(&["inspect", "assets/elbow/elbow.xml", "--json"]);
    let json: serde_json::Value = serde_json::from_slice(&out.stdout).unwrap();
    assert_eq!((&json["sizes"]["njmax"], &json["sizes"]["nconmax"]), (&(-1).into(), &(-1).into()));
    assert_eq!((&json["options"]["timestep"], &json["options"]["iterations"]), (&0.002.into(), &100.into()));
    assert_eq!(json["options"]["gravity"], serde_json::json!([0.0, 0.0, -9.81]));
    assert!(json["mass"].as_f64().unwrap() > 0.0);
}

#[test]
fn sim_reports_what_happened() {
    let out = robohive(&["sim", "assets/elbow/elbow.xml", "--seconds", "0.1", "-q"]);
    assert!(out.status.success(), "{}", text(&out.stderr));
    for word in ["after 50 steps", "steps/s", "x real time", "potential", "contacts"] {
        assert!(text(&out.stdout).contains(word), "{word} is missing in {}", text(&out.stdout));
    }
}

/// Text and compiled models are read from standard input, which messages call by name.
#[test]
fn models_come_from_standard_input() {
    let inspect = |input: &Path| {
        let input = File::open(input).unwrap();
        command().args(["inspect", "-", "--json"]).stdin(input).output().unwrap()
    };
    let elbow = Path::new(ROOT).join("assets/elbow/elbow.xml");
    let direct = text(&robohive(&["inspect", "assets/elbow/elbow.xml", "--json"]).stdout);
    assert_eq!(text(&inspect(&elbow).stdout), direct);
    let compiled = scratch("input.rhm");
    robohive(&["compile", "assets/elbow/elbow.xml", "--out", compiled.to_str().unwrap()]);
    assert_eq!(text(&inspect(&compiled).stdout), direct);
    let bad = scratch("bad_input.xml");
    std::fs::write(&bad, "<mujoco>\n<wordbody/></mujoco>").unwrap();
    let out = inspect(&bad);
    assert_eq!(out.status.code(), Some(2));
    assert!(text(&out.stderr).contains("<stdin>:2:"), "{}", text(&out.stderr));
}

/// A model's text cannot steer the terminal or forge a line.
#[test]
fn control_characters_of_a_model_are_spelt_out() {
    let file = scratch("evil.xml");
    let name = "evil&#x9b;31m&#10;passed&#x202e;";
    let body = format!("<body name=\"{name}\"><geom size=\"1\"/></body>");
    std::fs::write(&file, format!("<mujoco model=\"{name}\"><worldbody>{body}</worldbody></mujoco>"))
        .unwrap();
    let file = file.to_str().unwrap();
    let summary = text(&robohive(&["inspect", file]).stdout);
    assert!(summary.contains("evil\\u{9b}31m\\npassed\\u{202e}"), "{summary}");
    let json = text(&robohive(&["inspect", file, "--json"]).stdout);
    assert!(json.contains("evil\\u009b31m\\npassed\\u202e"), "{json}");
    for output in [&summary, &json] {
        assert!(!output.chars().any(|c| matches!(c, '\u{80}'..='\u{9f}' | '\u{202e}')), "{output:?}");
    }
    let parsed: serde_json::Value = serde_json::from_str(&json).unwrap();
    assert_eq!(parsed["bodies"][1], "evil\u{9b}31m\npassed\u{202e}");
}

/// Colour is for terminals; a pipe gets plain text.
#[test]
fn pipes_get_no_colour() {
    let reference = "validation/reference/own/elbow.npz";
    let check = |variable: &str| {
        let arguments = ["check", "assets/elbow/elbow.xml", reference];
        text(&command().args(arguments).env(variable, "1").output().unwrap().stdout)
    };
    assert!(!check("UNRELATED").contains('\u{1b}'));
    assert!(check("CLICOLOR_FORCE").contains("\u{1b}["), "colour cannot be asked for");
    assert!(!check("NO_COLOR").contains('\u{1b}'));
}

#[test]
fn trace_rolls_out_one_control_row_a_step() {
    let (input, output) = (scratch("rollout_in.npz"), scratch("rollout_out.npz"));
    write(
        &input,
        &[
            ("ctrl", Array::f64(vec![20, 6], vec![0.3; 120])),
            ("qpos", Array::f64(vec![1, 2], vec![1.0, 0.0])),
        ],
    );
    let out = robohive(&[
        "trace",
        "assets/elbow/elbow.xml",
        "--in",
        input.to_str().unwrap(),
        "--out",
        output.to_str().unwrap(),
        "--fields",
        "qpos,sensordata,actuator_force",
    ]);
    assert!(out.status.success(), "{}", text(&out.stderr));
    let arrays = NpzReader::open(&output).unwrap();
    assert_eq!(arrays.require("actuator_force").unwrap().shape, [20, 6]);
    let qpos = arrays.require("qpos").unwrap();
    assert_eq!(qpos.shape, [20, 2]);
    assert!((qpos.values.to_f64()[38] - 1.0).abs() > 1e-6, "the elbow does not move");
}

#[test]
fn trace_takes_an_array_of_the_shape_of_a_field_as_one_row() {
    let (input, output) = (scratch("single_in.npz"), scratch("single_out.npz"));
    write(
        &input,
        &[("qpos", Array::f64(vec![2], vec![1.0, 0.5])), ("ctrl", Array::f64(vec![6], vec![0.3; 6]))],
    );
    let out = |more: &[&str]| {
        let (input, output) = (input.to_str().unwrap(), output.to_str().unwrap());
        let run =
            ["trace", "assets/elbow/elbow.xml", "--in", input, "--out", output, "--fields", "qpos,ctrl"];
        robohive(&[&run, more].concat())
    };
    let forward = out(&["--forward"]);
    assert!(forward.status.success(), "{}", text(&forward.stderr));
    let arrays = NpzReader::open(&output).unwrap();
    assert_eq!(arrays.require("qpos").unwrap(), Array::f64(vec![1, 2], vec![1.0, 0.5]));
    assert_eq!(arrays.require("ctrl").unwrap().shape, [1, 6]);
    let step = out(&[]);
    assert!(step.status.success(), "{}", text(&step.stderr));
    assert_eq!(NpzReader::open(&output).unwrap().require("qpos").unwrap().shape, [1, 2]);
}

/// A run that diverges ends with an error, or is reset as MuJoCo's was.
#[test]
fn trace_resets_bad_values_when_asked() {
    let folder = "validation/reference/details";
    let recorded = NpzReader::open(&repository("validation/reference/details/diverging.npz")).unwrap();
    let (input, output) = (scratch("diverging_in.npz"), scratch("diverging_out.npz"));
    write(&input, &[("ctrl", recorded.require("rollout.ctrl").unwrap())]);
    let (model, input) = (format!("{folder}/diverging.xml"), input.to_str().unwrap());
    let run = ["trace", &model, "--in", input, "--out", output.to_str().unwrap(), "--fields", "qpos"];
    let failed = robohive(&run);
    assert!(!failed.status.success() && text(&failed.stderr).contains("qacc[0]"), "{}", text(&failed.stderr));
    let reset = robohive(&[&run[..], &["--autoreset"]].concat());
    assert!(reset.status.success(), "{}", text(&reset.stderr));
    assert!(text(&reset.stderr).contains("reset 6 times"), "{}", text(&reset.stderr));
    let qpos = NpzReader::open(&output).unwrap().require("qpos").unwrap();
    assert_eq!(qpos, recorded.require("rollout.qpos").unwrap());
}

#[test]
fn trace_forward_concatenates_contacts_and_rows() {
    let (input, output) = (scratch("forward_in.npz"), scratch("forward_out.npz"));
    let mut ready = vec![0.0; 60];
    let key = [
        0., 0.35, 0., -2.2, 0., 2.55, 0.785, 0.04, 0.04, 0.5, 0., 0.02, 1., 0., 0., 0., 0.45, 0.2, 0.04, 1.,
        0., 0., 0., 0.55, -0.2, 0.03, 1., 0., 0., 0.,
    ];
    ready[..30].copy_from_slice(&key);
    ready[30..].copy_from_slice(&key);
    // In the second state the cube hangs in the air: four contacts fewer.
    ready[30 + 11] = 0.5;
    write(&input, &[("qpos", Array::f64(vec![2, 30], ready))]);
    let out = robohive(&[
        "trace",
        "assets/franka/franka_table.xml",
        "--in",
        input.to_str().unwrap(),
        "--out",
        output.to_str().unwrap(),
        "--forward",
        "--fields",
        "contact.dist,contact.frame,efc_J,efc_pos,qacc",
    ]);
    assert!(out.status.success(), "{}", text(&out.stderr));
    let arrays = NpzReader::open(&output).unwrap();
    let ncon = arrays.require("ncon").unwrap().values.to_f64();
    let nefc = arrays.require("nefc").unwrap().values.to_f64();
    assert_eq!(ncon[0] - ncon[1], 4.0);
    let contacts = (ncon[0] + ncon[1]) as usize;
    assert_eq!(arrays.require("contact.frame").unwrap().shape, [contacts, 9]);
    assert_eq!(arrays.require("efc_J").unwrap().shape, [(nefc[0] + nefc[1]) as usize, 27]);
    assert_eq!(arrays.require("qacc").unwrap().shape, [2, 27]);
}

#[test]
fn bench_ends_with_a_json_line() {
    let out = robohive(&["bench", "assets/elbow/elbow.xml", "--steps", "50", "--threads", "2", "--json"]);
    let last: serde_json::Value = serde_json::from_str(text(&out.stdout).lines().last().unwrap()).unwrap();
    assert_eq!(last["steps"], 50);
    assert!(last["steps_per_second"].as_f64().unwrap() > 0.0);
}

/// What is measured is the recorded motion, so that both sides of a comparison do the same work.
#[test]
fn bench_answers_requests_with_the_recorded_motion() {
    let reference = "validation/reference/own/humanoid.npz";
    let mut child = command()
        .args(["bench", "assets/humanoid/humanoid.xml", "--requests", "--hold", "1", "--controls", reference])
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .spawn()
        .unwrap();
    child.stdin.take().unwrap().write_all(b"rate 700\nstages 50\njitter 50\n").unwrap();
    let out = child.wait_with_output().unwrap();
    assert!(out.status.success());
    let answers: Vec<serde_json::Value> =
        text(&out.stdout).lines().map(|line| serde_json::from_str(line).unwrap()).collect();
    let recorded = NpzReader::open(&Path::new(ROOT).join(reference))
        .unwrap()
        .require("rollout.qpos")
        .unwrap()
        .values
        .to_f64();
    let qpos = answers[0]["qpos"].as_array().unwrap();
    assert_eq!(qpos.len(), 28);
    for (ours, theirs) in qpos.iter().zip(&recorded[199 * 28..]) {
        assert!((ours.as_f64().unwrap() - theirs).abs() < 1e-9, "{ours} beside {theirs}");
    }
    assert!(answers[1]["solver"].as_f64().unwrap() > 0.0);
    assert!(answers[2]["p99.9"].as_f64().unwrap() >= answers[2]["median"].as_f64().unwrap());
}

#[test]
fn bench_refuses_what_it_cannot_hold() {
    let cases: [(&[&str], &str); 5] = [
        (&["--threads", "5000"], "5000 is not in 1..=1024"),
        (&["--threads", "0"], "0 is not in 1..=1024"),
        (&["--batch", "2000000"], "2000000 is not in 1..=1048576"),
        (&["--jitter", "--steps", "999999999"], "at most 100000000"),
        (&["--steps", "99999999999"], "--steps"),
    ];
    for (arguments, message) in cases {
        let out = robohive(&[&["bench", "assets/elbow/elbow.xml"], arguments].concat());
        assert_eq!(out.status.code(), Some(2), "{arguments:?}: {}", text(&out.stderr));
        assert!(text(&out.stderr).contains(message), "{arguments:?}: {}", text(&out.stderr));
    }
}

#[test]
fn check_agrees_on_the_own_models_and_says_so_in_its_last_line() {
    let out =
        robohive(&["check", "assets/quadruped/quadruped.xml", "validation/reference/own/quadruped.npz"]);
    assert!(out.status.success(), "{}{}", text(&out.stdout), text(&out.stderr));
    let report = text(&out.stdout);
    assert_eq!(report.matches(" agrees ").count(), 4);
    let last = report.lines().last().unwrap();
    assert!(
        last.starts_with("passed: quadruped") && last.contains("qacc:") && last.contains("twin:"),
        "{last}"
    );
}

/// The sizes of another model, with nothing worse than a report.
#[test]
fn check_of_another_model_names_the_mismatch_with_exit_code_1() {
    let out = robohive(&["check", "assets/pile/pile.xml", "validation/reference/own/quadruped.npz"]);
    assert_eq!((out.status.code(), text(&out.stderr).as_str()), (Some(1), ""));
    let report = text(&out.stdout);
    let sizes = report.lines().find(|line| line.starts_with("sizes")).unwrap();
    assert!(sizes.contains("DIFFERS") && sizes.contains("nq 105 (MuJoCo 19)"), "{sizes}");
    assert!(report.lines().last().unwrap().starts_with("failed: "), "{report}");
}

/// A model of the same sizes that moves otherwise.
#[test]
fn check_of_an_edited_model_names_the_array_with_exit_code_1() {
    let text_of = std::fs::read_to_string(Path::new(ROOT).join("assets/elbow/elbow.xml")).unwrap();
    let edited = scratch("heavy.xml");
    let (before, after) = text_of.split_once("<option ").unwrap();
    std::fs::write(&edited, format!("{before}<option gravity=\"0 0 -9.9\" {after}")).unwrap();
    let out = robohive(&["check", edited.to_str().unwrap(), "validation/reference/own/elbow.npz"]);
    let report = text(&out.stdout);
    assert_eq!((out.status.code(), text(&out.stderr).as_str()), (Some(1), ""), "{report}");
    assert!(report.contains("opt.gravity[2] -9.9e0 (MuJoCo -9.81e0)"), "{report}");
    let last = report.lines().last().unwrap();
    assert!(last.starts_with("failed: ") && last.contains("compile, forward, step, rollout"), "{last}");
}

#[test]
fn a_damaged_reference_names_the_array() {
    let file = scratch("reference.npz");
    write(&file, &[("size.nq", Array::scalar_i64(2))]);
    let out = robohive(&["check", "assets/elbow/elbow.xml", file.to_str().unwrap()]);
    assert_eq!(out.status.code(), Some(2));
    assert!(text(&out.stderr).contains("reference.npz, array \"size.n"), "{}", text(&out.stderr));
}

#[test]
fn wrong_input_names_the_fault_with_exit_code_2() {
    let bad = scratch("bad.xml");
    std::fs::write(&bad, "<mujoco>\n  <worldbody>\n    <geom sise=\"1\"/>\n  </worldbody>\n</mujoco>\n")
        .unwrap();
    let bad = bad.to_str().unwrap();
    let elbow = "assets/elbow/elbow.xml";
    let franka = "assets/franka/franka_table.xml";
    let run = ["trace", elbow, "--in", "validation/reference/own/elbow.npz", "--out", "out.npz"];
    let cases: [(&[&str], &str); 10] = [
        (&["inspect", "no_such_model.xml"], "no_such_model.xml"),
        (&["inspect", bad], "bad.xml:3:11"),
        (&["sim", elbow, "--keyframe", "nowhere"], "no keyframe \"nowhere\""),
        (&["sim", elbow, "--keyframe", "7"], "its keyframes, 0 to 0, include \"bent\""),
        (&["sim", franka, "--keyframe", "redy"], "did you mean \"ready\"?"),
        (&["sim", "assets/pile/pile.xml", "--keyframe", "0"], "it has no keyframes"),
        (&["sim", elbow, "--define", "ELBOW=knee"], "no file of the model contains 'ELBOW'"),
        (&run, "inputs are time, qpos"),
        (&["sim", elbow, "--seconds", "-1"], "--seconds -1"),
        (&["trace", elbow, "--in", "no.npz", "--out", "out.npz"], "no.npz"),
    ];
    for (arguments, message) in cases {
        let out = robohive(arguments);
        assert_eq!(out.status.code(), Some(2), "{arguments:?}: {}", text(&out.stderr));
        assert!(text(&out.stderr).contains(message), "{arguments:?}: {}", text(&out.stderr));
    }
}

#[test]
fn template_text_is_replaced() {
    let file = scratch("template.xml");
    std::fs::write(&file, "<mujoco model=\"a THING\"><worldbody><geom size=\"SIZE\"/></worldbody></mujoco>")
        .unwrap();
    let file = file.to_str().unwrap();
    let out = robohive(&["inspect", file, "--define", "THING=ball", "--define", "SIZE=0.1"]);
    assert!(text(&out.stdout).contains("a ball"), "{}{}", text(&out.stdout), text(&out.stderr));
    assert_eq!(robohive(&["inspect", file, "--define", "THING"]).status.code(), Some(2));
}

#[test]
fn unknown_fields_are_answered_with_those_like_them() {
    let input = scratch("fields_in.npz");
    write(&input, &[("ctrl", Array::f64(vec![1, 6], vec![0.0; 6]))]);
    let message = |field: &str| {
        let arguments = ["trace", "assets/elbow/elbow.xml", "--out", "out.npz", "--fields", field, "--in"];
        let out = command().args(arguments).arg(&input).output().unwrap();
        assert_eq!(out.status.code(), Some(2));
        text(&out.stderr)
    };
    assert!(message("qpoz").contains("did you mean \"qpos\"?"), "{}", message("qpoz"));
    assert!(message("length").contains("\"ten_length\""), "{}", message("length"));
    assert!(message("colour").contains("the fields are time, "), "{}", message("colour"));
}

/// Every command takes a compiled model, which is the one that the text makes; a damaged or foreign one is refused.
#[test]
fn compiled_models_stand_for_their_text() {
    let (file, damaged, stale) = (scratch("elbow.rhm"), scratch("damaged.rhm"), scratch("stale.rhm"));
    let (file, damaged, stale) = (file.to_str().unwrap(), damaged.to_str().unwrap(), stale.to_str().unwrap());
    let out = robohive(&["compile", "assets/elbow/elbow.xml", "--out", file]);
    assert!(out.status.success(), "{}", text(&out.stderr));
    let (compiled, again) = (robohive(&["inspect", file, "--json"]), "assets/elbow/elbow.xml");
    assert_eq!(text(&compiled.stdout), text(&robohive(&["inspect", again, "--json"]).stdout));
    let out = robohive(&["check", file, "validation/reference/own/elbow.npz"]);
    assert!(out.status.success(), "{}{}", text(&out.stdout), text(&out.stderr));
    let bytes = std::fs::read(file).unwrap();
    let changed = |at: usize| {
        let mut bytes = bytes.clone();
        bytes[at] ^= 4;
        bytes
    };
    std::fs::write(damaged, changed(bytes.len() / 2)).unwrap();
    std::fs::write(stale, changed(9)).unwrap();
    for (arguments, message) in [
        (vec!["sim", damaged], "damaged.rhm: the compiled model is damaged"),
        (vec!["sim", stale], "compile it again: robohive compile MODEL.xml"),
        (vec!["inspect", file, "--define", "A=B"], "cannot be edited"),
    ] {
        let out = robohive(&arguments);
        assert_eq!(out.status.code(), Some(2), "{arguments:?}: {}", text(&out.stderr));
        assert!(text(&out.stderr).contains(message), "{arguments:?}: {}", text(&out.stderr));
    }
}

/// The second load takes the model from the folder, with the same warnings and the same numbers.
#[test]
fn models_are_cached_in_a_folder() {
    let folder = scratch("models");
    _ = std::fs::remove_dir_all(&folder);
    let arguments = ["inspect", "assets/pile/pile.xml", "--json", "--cache", folder.to_str().unwrap()];
    let first = robohive(&arguments);
    assert!(first.status.success(), "{}", text(&first.stderr));
    let entries =
        || std::fs::read_dir(&folder).unwrap().map(|entry| entry.unwrap().path()).collect::<Vec<_>>();
    let [entry] = &entries()[..] else { panic!("{:?}", entries()) };
    let second = robohive(&arguments);
    assert_eq!((text(&second.stdout), text(&second.stderr)), (text(&first.stdout), text(&first.stderr)));
    std::fs::write(entry, "").unwrap();
    let third = robohive(&arguments);
    assert_eq!(text(&third.stdout), text(&first.stdout));
    assert!(text(&third.stderr).contains("damaged; it was compiled again"), "{}", text(&third.stderr));
}

#[test]
fn memory_of_a_model_is_bounded_as_asked() {
    let file = scratch("field.xml");
    let field = "<mujoco>\n<asset><hfield name='h' nrow='1000' ncol='1000' size='1 1 1 1'/></asset></mujoco>";
    std::fs::write(&file, field).unwrap();
    let file = file.to_str().unwrap();
    let refused = robohive(&["inspect", file, "--memory", "1"]);
    assert_eq!(refused.status.code(), Some(2));
    let message = text(&refused.stderr);
    assert!(message.contains("field.xml:2:8: error: ") && message.contains("`--memory`"), "{message}");
    assert!(robohive(&["inspect", file, "--memory", "64"]).status.success());
}
