//! Files in memory: models in parts, archives, what is missing and what is refused.

use robohive_viewer::{Files, FilesError, is_archive, is_model};
use std::io::{Cursor, Write};
use zip::ZipWriter;
use zip::write::SimpleFileOptions;

const ARM: &str = "<mujoco model='arm'><compiler meshdir='meshes'/><asset><mesh file='link.obj'/><mesh file='hand.obj'/></asset>\
     <worldbody><body><joint/><geom type='mesh' mesh='link'/><geom type='mesh' mesh='hand'/></body></worldbody></mujoco>";
const MESH: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";

fn of(files: &[(&str, &str)]) -> Files {
    let mut all = Files::new();
    files.iter().for_each(|(path, text)| all.insert(path, text.as_bytes().to_vec()).expect("room"));
    all
}

fn archive(entries: &[(&str, &str)]) -> Vec<u8> {
    let mut writer = ZipWriter::new(Cursor::new(Vec::new()));
    for (path, text) in entries {
        writer.start_file(*path, SimpleFileOptions::default()).expect("an entry");
        writer.write_all(text.as_bytes()).expect("its content");
    }
    writer.finish().expect("an archive").into_inner()
}

#[test]
fn all_missing_files_are_listed_and_others_stand_for_them() {
    let mut files = of(&[("robot/arm.xml", ARM), ("robot/meshes/link.obj", MESH)]);
    let error = files.load("robot/arm.xml").expect_err("the hand is missing");
    assert_eq!(error.missing, ["robot/meshes/hand.obj"]);
    assert!(error.to_string().contains("1 file is missing"), "{error}");
    // The only file of its name stands for it, whatever its folder; of several, one that is nearer than all others.
    files.insert("HAND.obj", MESH.into()).unwrap();
    assert!(files.load("robot/arm.xml").is_err(), "a file stands for itself alone, unless it is gathered");
    assert_eq!(files.load_gathered("robot/arm.xml").expect("all is there").model.nmesh, 2);
    files.insert("other/hand.obj", MESH.into()).unwrap();
    assert_eq!(
        files.load_gathered("robot/arm.xml").expect_err("two are as near").missing,
        ["robot/meshes/hand.obj"]
    );
    files.insert("spare/meshes/hand.obj", MESH.into()).unwrap();
    assert_eq!(files.clone().substitute("robot/meshes/hand.obj").as_deref(), Some("spare/meshes/hand.obj"));
    assert_eq!(files.load_gathered("robot/arm.xml").expect("all is there").model.nmesh, 2);
    let error = of(&[("arm.xml", ARM)]).load("arm.xml").expect_err("both are missing");
    assert_eq!(error.missing, ["meshes/hand.obj", "meshes/link.obj"]);
}

#[test]
fn archives_become_folders_and_models_near_the_top_come_first() {
    let packed = archive(&[("parts/deep.xml", "<mujoco/>"), ("scene.xml", "<mujoco/>"), ("a.xml", ARM)]);
    let mut files = Files::new();
    files.add("Robot.ZIP", packed).expect("an archive");
    assert_eq!(files.models(), ["Robot/scene.xml", "Robot/a.xml", "Robot/parts/deep.xml"]);
    assert_eq!((files.len(), files.is_empty()), (3, false));
    assert!(is_archive("x.mjz") && !is_archive("zip") && is_model("a/B.URDF") && !is_model("xml"));
}

#[test]
fn damaged_archives_and_entries_that_lead_out_are_refused() {
    let mut files = Files::new();
    let mut packed = archive(&[("scene.xml", ARM)]);
    packed.truncate(packed.len() / 2);
    assert!(
        matches!(files.add("a.zip", packed), Err(FilesError::Damaged { archive, .. }) if archive == "a.zip")
    );
    let out = files.add("b.zip", archive(&[("../../etc/passwd", "x")]));
    assert!(matches!(out, Err(FilesError::LeadsOut { .. })), "{out:?}");
    let bomb = archive(&[("bomb.xml", &" ".repeat(32 << 20))]);
    assert!(matches!(files.add("c.zip", bomb), Err(FilesError::Bomb { archive, .. }) if archive == "c.zip"));
    assert!(matches!(files.add("d.zip", archive(&[])), Err(FilesError::Empty { .. })));
    assert!(files.is_empty());
}
