//! Files with weights that are cut off, garbled or lie about sizes end in errors or other numbers: nothing panics, and memory is
//! bounded by the file.

use robohive_encoders::EncoderError;
use robohive_encoders::weights::{MAX_HEADER, Naming, Parameter, Parameters, WeightFile};
use std::io::Cursor;
use std::path::Path;

const FORMS: [&str; 3] = ["tensors.pt", "legacy.pt", "tensors.safetensors"];

fn open(bytes: Vec<u8>) -> Result<WeightFile, EncoderError> {
    WeightFile::from_stream(Path::new("memory"), Cursor::new(bytes))
}

fn recorded(name: &str) -> Vec<u8> {
    std::fs::read(Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/files").join(name)).unwrap()
}

/// Opens a file and reads every tensor; whether all of it went well.
fn read_all(bytes: Vec<u8>) -> bool {
    let Ok(mut file) = open(bytes) else { return false };
    let names: Vec<String> = file.names().map(str::to_owned).collect();
    let read: Vec<bool> =
        names.iter().filter(|name| *name != "count").map(|name| file.read(name).is_ok()).collect();
    read.into_iter().all(|good| good)
}

#[test]
fn every_cut_is_noticed() {
    for form in FORMS {
        let bytes = recorded(form);
        assert!(read_all(bytes.clone()), "{form}");
        for length in 0..bytes.len() {
            assert!(!read_all(bytes[..length].to_vec()), "{form} cut to {length} of {} bytes", bytes.len());
        }
    }
}

#[test]
fn no_garbled_byte_makes_a_panic() {
    for form in FORMS {
        let bytes = recorded(form);
        let mut refused = 0;
        for place in 0..bytes.len() {
            for change in [0x01, 0x80, 0xff] {
                let mut garbled = bytes.clone();
                garbled[place] ^= change;
                refused += usize::from(!read_all(garbled));
            }
        }
        assert!(refused > bytes.len() / 4, "{form}: {refused}");
    }
}

#[test]
fn numbers_of_an_archive_are_compared_with_their_checksum() {
    let mut bytes = recorded("tensors.pt");
    let number = 1.375f32.to_le_bytes();
    let place = bytes.windows(4).position(|window| window == number).unwrap();
    bytes[place] ^= 1;
    let mut file = open(bytes).unwrap();
    assert!(file.read("float").unwrap_err().to_string().contains("tensor float"));
}

#[test]
fn headers_that_ask_for_too_much_are_refused() {
    let header = |length: u64, text: &str| [&length.to_le_bytes()[..], text.as_bytes()].concat();
    let told = |text: &str| open(header(text.len() as u64, text)).err().unwrap().to_string();
    assert!(open(header(MAX_HEADER + 1, "{}")).err().unwrap().to_string().contains("larger than"));
    let tensor = |shape: &str, offsets: &str| {
        told(&format!(r#"{{"a":{{"dtype":"F32","shape":{shape},"data_offsets":{offsets}}}}}"#))
    };
    assert!(tensor("[4294967296,4294967296]", "[0,0]").contains("more than"));
    assert!(tensor("[67108864]", "[0,268435456]").contains("cut off"));
    assert!(tensor("[2]", "[0,4]").contains("needs 8 bytes"));
    assert!(tensor("[2]", "[8,0]").contains("ends before it begins"));
    assert!(tensor("[2]", "[18446744073709551607,18446744073709551615]").contains("tensor a"));
    assert!(told(r#"{"a":{"dtype":"F4","shape":[],"data_offsets":[0,0]}}"#).contains("type F4 is not read"));
    assert!(told(r#"{"a":7}"#).contains("tensor a"));
}

#[test]
fn a_header_of_any_length_is_recognised() {
    for length in 100..400 {
        let mut header = r#"{"a":{"dtype":"F32","shape":[1],"data_offsets":[0,4]}}"#.to_owned();
        header.push_str(&" ".repeat(length - header.len()));
        let bytes = [&(length as u64).to_le_bytes()[..], header.as_bytes(), &2.5f32.to_le_bytes()].concat();
        assert_eq!(open(bytes).unwrap().read("a").unwrap(), [2.5], "{length}");
    }
}

#[test]
fn a_negative_variance_is_refused() {
    let header = r#"{"bn1.running_var":{"dtype":"F32","shape":[2],"data_offsets":[0,8]}}"#;
    let numbers = [1f32, -0.5].map(f32::to_le_bytes).concat();
    let bytes = [&(header.len() as u64).to_le_bytes()[..], header.as_bytes(), &numbers].concat();
    let layout = [Parameter::new("bn1.running_var", &[2])];
    let naming = Naming { prefixes: &[""], ignored: |_| false };
    let error = Parameters::read(&mut open(bytes).unwrap(), &layout, &naming).err().unwrap().to_string();
    assert!(error.contains("bn1.running_var") && error.contains("-0.5"), "{error}");
}
