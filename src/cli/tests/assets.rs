//! `assets`: what a user sees of the store, and what is left of an import that is killed.

mod command;

use command::{command, robohive, scratch, text};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Child, Output, Stdio};
use std::time::Instant;

/// An empty folder for one test.
fn empty(name: &str) -> PathBuf {
    let folder = scratch("assets").join(name);
    _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).unwrap();
    folder
}

/// Writes a source with files of `size` bytes, no two alike.
fn write_source(folder: &Path, repository: &str, files: usize, size: usize) {
    let folder = folder.join("simhive").join(repository);
    fs::create_dir_all(&folder).unwrap();
    fs::write(folder.join("COPYING"), include_str!("../../../LICENSE")).unwrap();
    let mut word = 0x9e37_79b9_u32;
    for i in 0..files {
        let mut bytes = vec![0; size];
        for byte in &mut bytes {
            word = word.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            *byte = (word >> 24) as u8;
        }
        fs::write(folder.join(format!("{i}.stl")), bytes).unwrap();
    }
}

fn assets(store: &Path, words: &[&str]) -> Output {
    command().arg("assets").args(words).env("ROBOHIVE_STORE", store).output().unwrap()
}

/// Standard output of a command that must succeed.
fn shown(store: &Path, words: &[&str]) -> String {
    let out = assets(store, words);
    assert!(out.status.success(), "{words:?}: {}{}", text(&out.stdout), text(&out.stderr));
    text(&out.stdout)
}

#[test]
fn import_list_and_verify_say_what_there_is() {
    let folder = empty("lists");
    let store = folder.join("store");
    assert!(text(&assets(&store, &["list"]).stderr).contains("assets import PATH"));
    write_source(&folder, "Adroit", 2, 10);
    fs::write(folder.join("simhive/setup.py"), "").unwrap();
    let source = folder.join("simhive");
    let source = source.to_str().unwrap();

    let imported = shown(&store, &["import", source, "-q"]);
    for part in
        ["3 files", "3 new, 0 already there, 0 replaced", "skipped      1 .py", store.to_str().unwrap()]
    {
        assert!(imported.contains(part), "{imported}");
    }
    assert!(shown(&store, &["import", source]).contains("0 new, 3 already there"));
    let list = shown(&store, &["list"]);
    assert!(list.starts_with("simhive/Adroit") && list.contains("Apache-2.0"), "{list}");
    let licences = shown(&store, &["list", "--licences"]);
    assert_eq!(licences.lines().count(), 3);
    assert!(licences.lines().all(|line| line.starts_with("Apache-2.0 ")), "{licences}");
    let json: serde_json::Value = serde_json::from_str(&shown(&store, &["list", "--json"])).unwrap();
    assert_eq!(
        (&json["files"][0]["path"], &json["files"][0]["size"]),
        (&"simhive/Adroit/0.stl".into(), &10.into())
    );
    assert_eq!(json["files"][0]["sha256"].as_str().unwrap().len(), 64);
    assert!(shown(&store, &["verify"]).ends_with("3 files, all sound\n"));
    // The option comes before the environment.
    let out = robohive(&["assets", "list", "--store", store.to_str().unwrap()]);
    assert_eq!(text(&out.stdout), list);
}

#[test]
fn verify_names_damage_and_the_command_that_repairs_it() {
    let folder = empty("damage");
    let store = folder.join("store");
    write_source(&folder, "Adroit", 2, 10);
    let source = folder.join("simhive");
    shown(&store, &["import", source.to_str().unwrap()]);
    fs::remove_file(store.join("tree/simhive/Adroit/1.stl")).unwrap();
    fs::write(store.join("tree/simhive/mine.xml"), "").unwrap();
    let out = assets(&store, &["verify"]);
    assert_eq!(out.status.code(), Some(1));
    let report = text(&out.stdout);
    let remedy = format!("repair with: robohive assets import {:?}", fs::canonicalize(&source).unwrap());
    for part in
        ["not in the tree  simhive/Adroit/1.stl", "not imported     simhive/mine.xml", &remedy, "in 2 places"]
    {
        assert!(report.contains(part), "{report} lacks {part}");
    }
    fs::remove_file(store.join("tree/simhive/mine.xml")).unwrap();
    shown(&store, &["import", source.to_str().unwrap()]);
    shown(&store, &["verify"]);
}

/// The models of DAPG share a file with an option that MuJoCo no longer has.
#[test]
fn verify_says_once_what_is_ignored_in_several_models() {
    let folder = empty("ignored");
    let store = folder.join("store");
    let models = folder.join("simhive/Adroit");
    fs::create_dir_all(&models).unwrap();
    fs::write(
        models.join("shared.xml"),
        "<mujocoinclude><size njmax='500'/>\n<option apirate='200'/></mujocoinclude>",
    )
    .unwrap();
    for name in ["door.xml", "hammer.xml", "pen.xml"] {
        let text = "<mujoco><include file='shared.xml'/><worldbody><geom size='1'/></worldbody></mujoco>";
        fs::write(models.join(name), text).unwrap();
    }
    shown(&store, &["import", folder.join("simhive").to_str().unwrap(), "-q"]);
    let out = assets(&store, &["verify", "-q"]);
    assert!(out.status.success(), "{}", text(&out.stdout));
    let said = text(&out.stderr);
    assert_eq!(said.matches("'apirate'").count(), 1, "{said}");
    assert!(said.contains("shared.xml:2:"), "{said}");
}

/// Half of a description looks like the whole.
#[test]
fn an_environment_without_its_model_is_described_by_an_error_alone() {
    let folder = empty("nothing_imported");
    for words in [&["info", "door-v1"][..], &["info", "door-v1", "--json"]] {
        let out = command().args(words).env("ROBOHIVE_STORE", folder.join("store")).output().unwrap();
        assert_eq!((out.status.success(), text(&out.stdout).as_str()), (false, ""), "{words:?}");
        assert!(text(&out.stderr).contains("robohive assets import"), "{}", text(&out.stderr));
    }
}

#[test]
fn wrong_input_is_named() {
    let folder = empty("wrong");
    let store = folder.join("store");
    fs::write(folder.join("page.zip"), "<html>").unwrap();
    let page = folder.join("page.zip");
    let cases: [(&[&str], i32, &str); 4] = [
        (&["import", page.to_str().unwrap()], 2, "neither a folder nor a tar"),
        (&["import", "/no/such/file"], 1, "/no/such/file"),
        (&["import", ".", "--limit", "time=3"], 2, "bytes, files, ratio, path or depth"),
        (&["import", ".", "--limit", "files=many"], 2, "NAME=NUMBER"),
    ];
    for (words, code, part) in cases {
        let out = assets(&store, words);
        assert_eq!(out.status.code(), Some(code), "{words:?}");
        assert!(text(&out.stderr).contains(part), "{words:?}: {}", text(&out.stderr));
    }
    assert!(!store.join("manifest").exists());
}

/// Starts an import and waits until it works in the store.
fn start(store: &Path, source: &Path) -> Child {
    let mut command = command();
    command.args(["assets", "import", "-q"]).arg(source).env("ROBOHIVE_STORE", store);
    let mut child = command.stdout(Stdio::null()).stderr(Stdio::null()).spawn().unwrap();
    while !store.join("staging").exists() && child.try_wait().unwrap().is_none() {
        std::thread::yield_now();
    }
    child
}

/// Killed at any moment, an import has happened whole or not at all, and the next one starts from there.
#[test]
fn a_killed_import_leaves_nothing_half_written() {
    let folder = empty("killed");
    let (store, first, second) = (folder.join("store"), folder.join("first"), folder.join("second"));
    write_source(&first, "Adroit", 3, 100);
    write_source(&second, "myo_sim", 300, 20_000);
    let began = Instant::now();
    shown(&folder.join("other"), &["import", second.to_str().unwrap()]);
    let whole = began.elapsed();

    let mut struck = 0;
    for round in 0..24 {
        shown(&store, &["import", first.to_str().unwrap()]);
        let mut child = start(&store, &second);
        // Moments over the whole import, in an order that mixes early and late ones.
        std::thread::sleep(whole * (round * 7 % 24) / 24);
        child.kill().unwrap();
        child.wait().unwrap();
        struck += i32::from(store.join("staging").exists());
        let report = shown(&store, &["verify", "-q"]);
        let files = shown(&store, &["list", "--licences"]).lines().count();
        assert!([4, 4 + 301].contains(&files), "round {round}: {files} files: {report}");
        if files > 4 {
            fs::remove_dir_all(&store).unwrap();
        }
    }
    assert!(struck > 0, "no import was killed at work");
    shown(&store, &["import", first.to_str().unwrap()]);
    shown(&store, &["import", second.to_str().unwrap()]);
    assert!(shown(&store, &["verify"]).contains("305 files, all sound"));
    assert!(!store.join("staging").exists());
}
