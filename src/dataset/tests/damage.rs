//! Recordings that are cut off or have wrong bytes: errors that say so, whatever the damage is.

use robohive_dataset::trace::{
    EntryType, Layout, Precision, Recorder, TraceError, TraceReader, repair, summarise,
};
use std::path::{Path, PathBuf};

/// Damaged copies of each file.
const COPIES: u32 = 400;

fn scratch(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("damage");
    std::fs::create_dir_all(&folder).unwrap();
    folder.join(name)
}

/// A recording of ours: trials of one chunk and of several, a dataset without numbers, a text.
fn own(name: &str) -> PathBuf {
    let path = scratch(name);
    let mut recorder = Recorder::create(&path, Layout::RoboHive, Precision::Full).unwrap();
    for number in 0..70u32 {
        let mut trial = recorder.begin(&format!("Trial{number}")).unwrap();
        for row in 0..5 {
            let x = f64::from(100 * number + row);
            trial.push("time", &[], &[x]).unwrap();
            trial.push("env_infos/obs_dict/qp", &[3], &[x, -x, 0.5 * x]).unwrap();
            trial.push("env_infos/state/act", &[0], &[0f64; 0]).unwrap();
            if number < 2 {
                trial.push("image", &[100, 100, 3], &vec![row as u8; 30_000]).unwrap();
            }
        }
        trial.set_text("config/task", &[], &["open the drawer".to_owned()]).unwrap();
        trial.finish().unwrap();
    }
    recorder.close().unwrap();
    path
}

fn files() -> Vec<(String, Vec<u8>)> {
    let fixtures = concat!(env!("CARGO_MANIFEST_DIR"), "/../../validation/reference/traces");
    let mut files: Vec<_> =
        ["robohive.h5", "roboset.h5"].iter().map(|name| Path::new(fixtures).join(name)).collect();
    files.push(own("whole.h5"));
    files.into_iter().map(|path| (path.display().to_string(), std::fs::read(&path).unwrap())).collect()
}

/// Reads everything; what is read has as many numbers as its shape says.
fn read(bytes: Vec<u8>) -> Result<usize, TraceError> {
    let trace = TraceReader::memory("damaged.h5", bytes)?;
    summarise(&trace)?;
    let mut datasets = 0;
    for trial in trace.trials() {
        for entry in trace.entries(trial)? {
            datasets += 1;
            if matches!(entry.kind, EntryType::Number(_)) {
                let array = trace.read(&entry)?;
                assert_eq!(array.values.len(), array.shape.iter().product::<usize>(), "{}", entry.path());
            }
        }
    }
    Ok(datasets)
}

#[test]
fn a_file_that_is_cut_off_is_an_error_wherever() {
    for (name, bytes) in files() {
        assert!(read(bytes.clone()).unwrap() > 10, "{name}");
        for part in 0..64 {
            let length = bytes.len() * part / 64;
            let error = read(bytes[..length].to_vec()).expect_err(&name).to_string();
            let told = ["cut off", "no HDF5 file"].iter().any(|text| error.contains(text));
            assert!(told && error.contains("damaged.h5"), "{name} cut at {length}: {error}");
        }
    }
}

#[test]
fn wrong_bytes_end_in_an_error_or_in_numbers() {
    let mut state = 1u64;
    let mut random = || {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        state
    };
    for (name, bytes) in files() {
        let mut errors = 0;
        for _ in 0..COPIES {
            let mut copy = bytes.clone();
            for _ in 0..1 + random() % 4 {
                let at = random() as usize % copy.len();
                copy[at] = if random().is_multiple_of(3) { u8::MAX } else { random() as u8 };
            }
            errors += u32::from(read(copy).is_err());
        }
        assert!(errors > COPIES / 20, "{name}: {errors} of {COPIES} damaged copies are noticed");
    }
}

/// Metadata of ours has checksums, and so have compressed numbers: no changed byte goes unnoticed that is read at all.
#[test]
fn of_our_own_files_a_wrong_byte_never_changes_a_number() {
    let bytes = std::fs::read(own("sums.h5")).unwrap();
    let values = |bytes: Vec<u8>| -> Result<Vec<Vec<u64>>, TraceError> {
        let trace = TraceReader::memory("sums.h5", bytes)?;
        let mut out = Vec::new();
        for trial in trace.trials() {
            for key in ["time", "env_infos/obs_dict/qp"] {
                let values = trace.read(&trace.entry(trial, key)?)?.values.to_f64();
                out.push(values.iter().map(|x| x.to_bits()).collect());
            }
        }
        Ok(out)
    };
    let whole = values(bytes.clone()).unwrap();
    let mut noticed = 0;
    for at in (0..bytes.len()).step_by(601) {
        let mut copy = bytes.clone();
        copy[at] ^= 0x40;
        match values(copy) {
            Ok(found) => assert!(found == whole, "byte {at}"),
            Err(_) => noticed += 1,
        }
    }
    assert!(noticed > 20, "{noticed} changes are noticed");
}

/// The lists of trials that were current before the end are still in the file.
#[test]
fn repair_finds_the_trials_of_a_file_that_is_cut_off() {
    let path = own("cut.h5");
    let bytes = std::fs::read(&path).unwrap();
    std::fs::write(&path, &bytes[..bytes.len() * 3 / 4]).unwrap();
    let error = TraceReader::open(&path).err().unwrap().to_string();
    assert!(error.contains("robohive data repair"), "{error}");
    let out = scratch("cut_repaired.h5");
    let report = repair(&path, &out).unwrap();
    assert!(report.damage.is_some() && report.saved.len() > 20, "{report:?}");
    let trace = TraceReader::open(&out).unwrap();
    assert_eq!(trace.trials().len(), report.saved.len());
    for (number, name) in trace.trials().iter().enumerate() {
        assert_eq!(*name, format!("Trial{number}"));
        let time = trace.read(&trace.entry(name, "time").unwrap()).unwrap().values.to_f64();
        assert_eq!(time, (0..5).map(|row| (100 * number + row) as f64).collect::<Vec<_>>());
        let task = trace.entry(name, "config/task").unwrap();
        assert_eq!(trace.texts(&task).unwrap(), ["open the drawer"]);
    }
}

#[test]
fn repair_saves_the_trials_beside_a_damaged_one() {
    let path = scratch("beside.h5");
    let fixture = concat!(env!("CARGO_MANIFEST_DIR"), "/../../validation/reference/traces/robohive.h5");
    let mut bytes = std::fs::read(fixture).unwrap();
    // A compressed chunk of the second trial: the fixture's trials stand one after another.
    let trace = TraceReader::open(Path::new(fixture)).unwrap();
    assert_eq!(trace.trials(), ["Trial0", "Trial1", "Trial10"]);
    let middle = bytes.len() / 2;
    let chunk = bytes[middle..].windows(2).position(|pair| pair == [0x78, 0x5e]).unwrap() + middle;
    bytes[chunk + 20..chunk + 40].fill(0x55);
    std::fs::write(&path, bytes).unwrap();
    let report = repair(&path, &scratch("beside_repaired.h5")).unwrap();
    assert_eq!(report.saved, ["Trial0", "Trial10"]);
    let [(lost, why)] = &report.lost[..] else { panic!("{report:?}") };
    assert!(lost == "Trial1" && why.contains("damaged"), "{why}");
}
