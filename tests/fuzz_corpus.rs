//! What fuzzing kept runs through every decoder again, without libFuzzer: nothing may panic.

#[path = "../fuzz/archive.rs"]
mod archive;
#[path = "../fuzz/targets.rs"]
mod targets;

use std::path::PathBuf;

fn corpus() -> PathBuf {
    std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("fuzz/corpus")
}

#[test]
fn every_kept_input_is_read_or_refused() {
    for (name, target) in targets::TARGETS {
        let inputs = archive::open(&corpus().join(name).with_extension("tar")).unwrap();
        assert!(inputs.len() >= 5, "{name} has {} inputs", inputs.len());
        for (input, content) in inputs {
            println!("{name} {input}");
            target(&content);
        }
    }
}

#[test]
fn there_is_one_archive_for_each_target_and_nothing_else() {
    let mut files: Vec<_> = std::fs::read_dir(corpus())
        .unwrap()
        .map(|file| file.unwrap().file_name().into_string().unwrap())
        .collect();
    let mut expected = targets::TARGETS.map(|(name, _)| format!("{name}.tar"));
    files.sort();
    expected.sort();
    assert_eq!(files, expected);
}

#[test]
fn archives_are_what_packing_their_inputs_makes() {
    for (name, _) in targets::TARGETS {
        let path = corpus().join(name).with_extension("tar");
        let bytes = std::fs::read(&path).unwrap();
        let inputs = archive::unpack(&bytes).unwrap();
        assert!(
            archive::pack(&inputs) == bytes,
            "{}: pack it with `cargo xtask fuzz keep {name}`",
            path.display()
        );
    }
}

#[test]
fn damaged_archives_are_refused() {
    let inputs = archive::Inputs::from([("a".into(), vec![1; 600]), ("b".into(), Vec::new())]);
    let bytes = archive::pack(&inputs);
    assert_eq!(archive::unpack(&bytes), Some(inputs));
    for cut in [0, 100, 512, 1000] {
        assert_eq!(archive::unpack(&bytes[..cut]), None, "{cut} bytes");
    }
    let mut other_name = bytes;
    other_name[0] = b'c';
    assert_eq!(archive::unpack(&other_name), None);
}
