//! Files of few tensors that torch and safetensors wrote (`validation/reference/encoders/oracles.py`).

use robohive_encoders::weights::{Naming, Parameter, Parameters, WeightFile};
use robohive_encoders::{Encoder, EncoderError, Encoding, Profile};
use std::path::PathBuf;

fn file(name: &str) -> PathBuf {
    [env!("CARGO_MANIFEST_DIR"), "tests", "files", name].iter().collect()
}

fn open(name: &str) -> WeightFile {
    WeightFile::open(&file(name)).unwrap_or_else(|error| panic!("{error}"))
}

fn error(name: &str) -> String {
    WeightFile::open(&file(name)).err().unwrap().to_string()
}

/// The number at a row and column of the recorded matrix.
fn at(row: usize, column: usize) -> f32 {
    (row * 6 + column) as f32 / 8.0
}

#[test]
fn every_form_of_file_gives_the_same_tensors() {
    let base: Vec<f32> = (0..24).map(|k| k as f32 / 8.0).collect();
    let transposed: Vec<f32> = (0..24).map(|k| at(k % 4, k / 4)).collect();
    let part: Vec<f32> = (0..6).map(|k| at(1 + k / 3, 2 + k % 3)).collect();
    for name in ["tensors.pt", "legacy.pt", "tensors.safetensors", "checkpoint.pt"] {
        let mut file = open(name);
        assert_eq!(file.names().count(), 10, "{name}");
        for tensor in ["float", "half", "brain", "double"] {
            assert_eq!(file.shape(tensor), Some(&[4, 6][..]), "{name}");
            assert_eq!(file.read(tensor).unwrap(), base, "{name}: {tensor}");
        }
        assert_eq!(file.shape("transposed"), Some(&[6, 4][..]), "{name}");
        assert_eq!(file.read("transposed").unwrap(), transposed, "{name}");
        assert_eq!(file.read("part").unwrap(), part, "{name}");
        assert_eq!(file.read("parameter").unwrap(), base[..6], "{name}");
        assert_eq!(file.read("empty").unwrap(), [0f32; 0], "{name}");
        assert_eq!(file.shape("scalar"), Some(&[][..]), "{name}");
        assert_eq!(file.read("scalar").unwrap(), [2.5], "{name}");
        let message = file.read("count").unwrap_err().to_string();
        assert!(message.contains("tensor count") && message.contains("no floats"), "{message}");
        assert!(file.read("other").is_err());
    }
}

#[test]
fn pickles_that_would_run_something_are_named_and_not_run() {
    let message = error("hostile.pt");
    assert!(message.contains("tensor bad") && message.contains("system"), "{message}");
    let message = error("quantised.pt");
    assert!(message.contains("_rebuild_qtensor"), "{message}");
}

#[test]
fn numbers_that_are_not_finite_are_refused() {
    let message = open("not_finite.pt").read("float").unwrap_err().to_string();
    assert!(message.contains("tensor float") && message.contains("NaN"), "{message}");
}

#[test]
fn files_of_other_kinds_are_refused() {
    assert!(error("oracle.json").contains("neither a safetensors file nor"));
    assert!(error("none.pt").contains("none.pt"));
}

const NAMING: Naming = Naming { prefixes: &["module.", ""], ignored: |name| name == "count" };

#[test]
fn tensors_of_another_network_are_listed() {
    let layout = [
        Parameter::new("float", &[4, 6]),
        Parameter::new("half", &[6, 4]),
        Parameter::new("gain", &[4]),
        Parameter::new("part", &[2, 3]),
    ];
    let error = Parameters::read(&mut open("tensors.pt"), &layout, &NAMING).err().unwrap();
    let EncoderError::Mismatch { missing, unexpected, misshaped, .. } = &error else { panic!("{error}") };
    assert_eq!(missing, &["gain"]);
    assert_eq!(misshaped, &["half ([4, 6] instead of [6, 4])"]);
    assert_eq!(unexpected, &["brain", "double", "empty", "parameter", "scalar", "transposed"]);
    let message = error.to_string();
    assert!(message.contains("missing: gain; unexpected: brain, double"), "{message}");
}

#[test]
fn an_encoder_names_what_its_file_lacks() {
    for name in ["rrl18", "vc1s"] {
        let encoding = Encoding::parse(name).unwrap();
        let error = Encoder::load(encoding, &file("tensors.pt"), Profile::Fixed).err().unwrap();
        let message = error.to_string();
        let first = if name == "vc1s" { "cls_token" } else { "conv1.weight" };
        assert!(message.contains(first) && message.contains("more; unexpected: brain"), "{message}");
    }
}
