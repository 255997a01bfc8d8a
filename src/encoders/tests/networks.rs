//! Networks, most of them of few channels, resizing and preparation, beside what torch, torchvision, timm and Pillow made of the same
//! numbers (`validation/reference/encoders/oracles.py`).

use robohive_encoders::networks::{Network, Resnet, ResnetShape, Transformer, TransformerShape};
use robohive_encoders::prepare::prepare;
use robohive_encoders::resample::{self, Filter, Window};
use robohive_encoders::weights::{Parameter, Parameters};
use robohive_encoders::{Encoder, Encoding, Picture, Profile};
use serde_json::Value;
use std::convert::Infallible;

/// Largest difference of features, in units of the root mean square of torch's.
const FEATURES: f64 = 1e-5;
/// Largest difference of prepared numbers, relative to the largest of them.
const PREPARED: f64 = 1e-6;

/// The number that stands for a network's input.
const INPUT: u64 = 1_000_000;

/// Numbers from -1 to 1 that depend on the tensor and their place in it.
fn number(tensor: u64, count: usize) -> Vec<f32> {
    let one = |place: u64| {
        let x = place
            .wrapping_mul(0x9E37_79B9_7F4A_7C15)
            .wrapping_add((tensor + 1).wrapping_mul(0xD134_2543_DE82_EF95));
        let x = (x ^ (x >> 32)).wrapping_mul(0xD6E8_FEB8_6659_FD93);
        (x >> 40) as f32 / (1u32 << 23) as f32 - 1.0
    };
    (0..count as u64).map(one).collect()
}

fn picture(height: usize, width: usize) -> Vec<u8> {
    let numbers = number((height * 10_000 + width) as u64, height * width * 3);
    numbers.into_iter().map(|x| ((x + 1.0) * 128.0) as u8).collect()
}

fn oracle(part: &str) -> Vec<Value> {
    let text = include_str!("files/oracle.json");
    let mut oracle: Value = serde_json::from_str(text).unwrap();
    serde_json::from_value(oracle[part].take()).unwrap()
}

fn counts(value: &Value) -> Vec<usize> {
    serde_json::from_value(value.clone()).unwrap()
}

fn floats(value: &Value) -> Vec<f64> {
    serde_json::from_value(value.clone()).unwrap()
}

/// The largest difference in units of the root mean square of what is expected.
fn difference(ours: &[f32], expected: &[f64]) -> f64 {
    assert_eq!(ours.len(), expected.len());
    let scale = (expected.iter().map(|x| x * x).sum::<f64>() / expected.len() as f64).sqrt();
    ours.iter().zip(expected).map(|(&a, b)| (f64::from(a) - b).abs()).fold(0.0, f64::max) / scale
}

/// The tensors of a recorded network, for our layout of it, which has to be torch's.
fn parameters(network: &Value, layout: &[Parameter]) -> Parameters {
    let tensors = network["tensors"].as_array().unwrap();
    assert_eq!(tensors.len(), layout.len());
    let values = |parameter: &Parameter| {
        let found = tensors.iter().position(|row| row["name"] == parameter.name.as_str());
        let k = found.unwrap_or_else(|| panic!("torch has no {}", parameter.name));
        assert_eq!(counts(&tensors[k]["shape"]), parameter.shape, "{}", parameter.name);
        let [offset, scale] = ["offset", "scale"].map(|key| tensors[k][key].as_f64().unwrap() as f32);
        let numbers = number(k as u64, parameter.shape.iter().product());
        Ok::<_, Infallible>(numbers.into_iter().map(|x| offset + scale * x).collect())
    };
    Parameters::collect(layout, values).unwrap()
}

#[test]
fn networks_give_the_features_of_torch() {
    let networks = oracle("networks");
    assert_eq!(networks.len(), 4);
    for network in networks {
        let (kind, side) = (network["kind"].as_str().unwrap(), network["side"].as_u64().unwrap() as usize);
        let sizes = counts(&network["sizes"]);
        let input = number(INPUT, 3 * side * side);
        let features = if kind == "transformer" {
            let shape =
                TransformerShape { side, patch: sizes[0], width: sizes[1], depth: sizes[2], heads: sizes[3] };
            let mut parameters = parameters(&network, &shape.layout());
            Transformer::new(shape, &mut parameters).features(&input)
        } else {
            let blocks = [sizes[0], sizes[1], sizes[2], sizes[3]];
            let shape = ResnetShape { blocks, width: sizes[4], bottleneck: kind == "bottleneck" };
            assert_eq!(shape.features(), network["features"].as_array().unwrap().len());
            let mut parameters = parameters(&network, &shape.layout());
            Resnet::new(shape, &mut parameters).features(input, side)
        };
        let off = difference(&features, &floats(&network["features"]));
        assert!(off < FEATURES, "{kind}: {off:e}");
    }
}

#[test]
fn bytes_are_resized_as_pillow_does() {
    let cases = oracle("resized");
    assert_eq!(cases.len(), 10);
    for case in cases {
        let filter = if case["filter"] == "bilinear" { Filter::Bilinear } else { Filter::Bicubic };
        let ([height, width], [rows, columns]) = (pair(&case["input"]), pair(&case["output"]));
        let pixels = picture(height, width);
        let picture = Picture::new(height, width, &pixels).unwrap();
        let whole = |length| Window { whole: length, first: 0, count: length };
        let out = resample::bytes(&picture, filter, whole(rows), whole(columns));
        let digest = out.iter().fold(0xcbf2_9ce4_8422_2325u64, |digest, &byte| {
            (digest ^ u64::from(byte)).wrapping_mul(0x100_0000_01b3)
        });
        assert_eq!(format!("{digest:016x}"), case["digest"].as_str().unwrap(), "{case}");
        let inner = |length| Window { whole: length, first: length / 3, count: length / 2 };
        let part = resample::bytes(&picture, filter, inner(rows), inner(columns));
        let (rows, columns, across) = (inner(rows), inner(columns), columns);
        let crop = (0..rows.count).flat_map(|row| {
            let start = ((rows.first + row) * across + columns.first) * 3;
            out[start..start + columns.count * 3].iter().copied()
        });
        assert_eq!(part, crop.collect::<Vec<u8>>(), "{case}");
    }
}

fn pair(value: &Value) -> [usize; 2] {
    serde_json::from_value(value.clone()).unwrap()
}

#[test]
fn pictures_are_prepared_as_torchvision_does() {
    let cases = oracle("prepared");
    assert_eq!(cases.len(), 18);
    for case in cases {
        let encoding = Encoding::parse(case["encoder"].as_str().unwrap()).unwrap();
        let profile = if case["profile"] == "fixed" { Profile::Fixed } else { Profile::RoboHive07 };
        let [height, width] = pair(&case["size"]);
        let pixels = picture(height, width);
        let prepared = prepare(encoding, profile, &Picture::new(height, width, &pixels).unwrap());
        let expected = floats(&case["values"]);
        let largest = expected.iter().fold(0f64, |largest, x| largest.max(x.abs()));
        for (place, expected) in counts(&case["places"]).into_iter().zip(expected) {
            let off = (f64::from(prepared[place]) - expected).abs() / largest;
            assert!(off < PREPARED, "{encoding} {profile:?} {height} x {width}: {off:e} at {place}");
        }
    }
}

#[test]
fn features_depend_neither_on_the_batch_nor_on_threads() {
    let encoding = Encoding::parse("rrl18").unwrap();
    let network = oracle("networks").swap_remove(2);
    let mut parameters = parameters(&network, &Network::layout(encoding).unwrap());
    let network = Network::new(encoding, &mut parameters).unwrap();
    let encoder = Encoder::with_network(encoding, network, Profile::RoboHive07);
    let sizes = [(224, 224), (60, 80), (300, 257)];
    let pixels = sizes.map(|(height, width)| picture(height, width));
    let pictures: Vec<Picture<'_>> = sizes
        .iter()
        .zip(&pixels)
        .map(|(&(height, width), pixels)| Picture::new(height, width, pixels).unwrap())
        .collect();
    let bits = |features: Vec<f32>| features.into_iter().map(f32::to_bits).collect::<Vec<u32>>();
    let single = bits(pictures.iter().flat_map(|picture| encoder.encode(&[*picture])).collect());
    assert_eq!(single.len(), 3 * encoding.output_len(224, 224));
    for threads in [1, 2, 3] {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        assert!(bits(pool.install(|| encoder.encode(&pictures))) == single, "{threads} threads");
    }
}
