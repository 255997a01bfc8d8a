//! Compares encoders with what torch recorded, and prints a row of a table.
//!
//!     cargo run --release -p robohive-encoders --features networks --example compare -- FOLDER ENCODER \[REPEATS\]
//!
//! FOLDER is one that `validation/reference/encoders/record.py` wrote for ENCODER. Fails when an encoding differs from torch's by more
//! than 1e-4 of the root mean square of its numbers, when the files with weights give different bits, or when batches
//! or threads change bits.

use robohive_encoders::prepare::prepare;
use robohive_encoders::weights::WeightFile;
use robohive_encoders::{Encoder, Encoding, Picture, Profile};
use serde_json::Value;
use std::path::Path;
use std::process::ExitCode;
use std::time::Instant;

/// Largest difference, in units of the root mean square of torch's numbers.
const TOLERANCE: f64 = 1e-4;

const PROFILES: [(&str, Profile); 2] = [("fixed", Profile::Fixed), ("robohive", Profile::RoboHive07)];

/// Arrays of a safetensors file, bytes among them.
struct Expected {
    header: Value,
    data: Vec<u8>,
}

impl Expected {
    fn open(path: &Path) -> Result<Self, String> {
        let mut bytes = std::fs::read(path).map_err(|error| format!("{}: {error}", path.display()))?;
        let size =
            bytes.first_chunk::<8>().map(|size| u64::from_le_bytes(*size) as usize).ok_or("no header")?;
        let header = serde_json::from_slice(&bytes[8..8 + size]).map_err(|error| error.to_string())?;
        Ok(Expected { header, data: bytes.split_off(8 + size) })
    }

    fn bytes(&self, name: &str) -> Option<(Vec<usize>, &[u8])> {
        let numbers = |key: &str| -> Option<Vec<usize>> {
            self.header.get(name)?.get(key)?.as_array()?.iter().map(|n| Some(n.as_u64()? as usize)).collect()
        };
        let (shape, place) = (numbers("shape")?, numbers("data_offsets")?);
        Some((shape, &self.data[place[0]..place[1]]))
    }

    fn floats(&self, name: &str) -> Result<Vec<f32>, String> {
        let (_, bytes) = self.bytes(name).ok_or_else(|| format!("there is no {name}"))?;
        Ok(bytes.as_chunks::<4>().0.iter().map(|&number| f32::from_le_bytes(number)).collect())
    }

    fn pictures(&self) -> Result<Vec<Picture<'_>>, String> {
        let found = (0..).map_while(|k| self.bytes(&format!("picture{k}")));
        found
            .map(|(shape, bytes)| Picture::new(shape[0], shape[1], bytes).map_err(|e| e.to_string()))
            .collect()
    }
}

/// The largest difference in units of the root mean square of what is expected.
fn difference(ours: &[f32], expected: &[f32]) -> f64 {
    assert_eq!(ours.len(), expected.len());
    let square: f64 = expected.iter().map(|&x| f64::from(x).powi(2)).sum();
    let scale = (square / expected.len() as f64).sqrt();
    let pairs = ours.iter().zip(expected);
    pairs.map(|(&a, &b)| (f64::from(a) - f64::from(b)).abs()).fold(0.0, f64::max) / scale
}

/// Largest differences of prepared pictures and of encodings.
fn compare(
    encoder: &Encoder,
    (name, profile): (&str, Profile),
    expected: &Expected,
) -> Result<[f64; 2], String> {
    let pictures = expected.pictures()?;
    let mut largest = [0f64; 2];
    for (k, picture) in pictures.iter().enumerate() {
        let prepared = prepare(encoder.encoding(), profile, picture);
        let encoded = encoder.encode(std::slice::from_ref(picture));
        for (stage, ours, what) in [(0, prepared, "prepared"), (1, encoded, "encoded")] {
            let off = difference(&ours, &expected.floats(&format!("{what}.{name}{k}"))?);
            largest[stage] = largest[stage].max(off);
        }
    }
    Ok(largest)
}

/// Whether one thread and two, one picture and many, give the same bits.
fn is_batch_invariant(encoder: &Encoder, pictures: &[Picture<'_>]) -> Result<bool, String> {
    let single: Vec<f32> = pictures.iter().flat_map(|picture| encoder.encode(&[*picture])).collect();
    let mut same = true;
    for threads in [1, 2, 3] {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().map_err(|e| e.to_string())?;
        let batch = pool.install(|| encoder.encode(pictures));
        same &= batch.iter().zip(&single).all(|(a, b)| a.to_bits() == b.to_bits());
    }
    Ok(same)
}

/// The shortest time of an encoding.
fn milliseconds(encoder: &Encoder, picture: Picture<'_>, repeats: usize) -> f64 {
    let time = |_| {
        let start = Instant::now();
        std::hint::black_box(encoder.encode(&[picture]));
        1e3 * start.elapsed().as_secs_f64()
    };
    (0..repeats).map(time).fold(f64::INFINITY, f64::min)
}

const HEADER: &str = "\
| encoder | tensors | features | RoboHive: prepared | encoded | fixed: prepared | encoded | files alike | batches alike | loading [s] | ours [ms] | torch [ms] | ratio |
|---|---|---|---|---|---|---|---|---|---|---|---|---|";

fn run() -> Result<(), String> {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let [folder, name, rest @ ..] = words.as_slice() else {
        return Err("usage: compare FOLDER ENCODER [REPEATS]".into());
    };
    let repeats = rest.first().map_or(Ok(9), |text| text.parse()).map_err(|e| format!("REPEATS: {e}"))?;
    let (folder, encoding) = (Path::new(folder), Encoding::parse(name).map_err(|e| e.to_string())?);
    let expected = Expected::open(&folder.join("expected.safetensors"))?;
    let pictures = expected.pictures()?;
    let load = |file: &str, profile| {
        Encoder::load(encoding, &folder.join(file), profile).map_err(|error| error.to_string())
    };
    let started = Instant::now();
    let encoder = load("weights.pt", Profile::RoboHive07)?;
    let loading = started.elapsed().as_secs_f64();
    let mut largest = [compare(&encoder, PROFILES[1], &expected)?, [0.0; 2]];
    let invariant = is_batch_invariant(&encoder, &pictures)?;
    let ours = milliseconds(&encoder, pictures[0], repeats);
    let reference = encoder.encode(&pictures[..1]);
    drop(encoder);
    let encoder = load("weights.safetensors", Profile::Fixed)?;
    largest[1] = compare(&encoder, PROFILES[0], &expected)?;
    drop(encoder);
    let (mut files, mut same) = (1, true);
    for file in ["weights.safetensors", "legacy.pt"].into_iter().filter(|file| folder.join(file).exists()) {
        same &= load(file, Profile::RoboHive07)?.encode(&pictures[..1]) == reference;
        files += 1;
    }
    let theirs = f64::from(expected.floats("milliseconds")?[0]);
    let tensors =
        WeightFile::open(&folder.join("weights.safetensors")).map_err(|e| e.to_string())?.names().count();
    println!("{HEADER}");
    let [[a, b], [c, d]] = largest;
    let times = format!("{loading:.2} | {ours:.1} | {theirs:.1} | {:.2}", ours / theirs);
    let alike = if same { format!("{files} of {files}") } else { "no".into() };
    println!(
        "| {name} | {tensors} | {} | {a:.0e} | {b:.0e} | {c:.0e} | {d:.0e} | {alike} | {} | {times} |",
        reference.len(),
        if invariant { "yes" } else { "no" }
    );
    if !same || !invariant || largest.iter().flatten().any(|&off| off > TOLERANCE || off.is_nan()) {
        return Err(format!("{name} differs"));
    }
    Ok(())
}

fn main() -> ExitCode {
    match run() {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            eprintln!("{message}");
            ExitCode::FAILURE
        }
    }
}
