//! `--renderer gpu`, in builds with the feature `gpu`. What needs a GPU, or a driver that stands in for one, says so where
//! there is none.
#![cfg(feature = "gpu")]

mod command;

use command::{ROOT, robohive, scratch, text};
use env::{Autoreset, Env, Options, OwnModels, Pixels, VecEnv};
use render_gpu::{Choice, EitherPainters, adapters};
use std::fs;
use std::sync::Arc;

const KEYS: &str = "visual_keys = ['rgb:front:64x64:2d', 'd:front:64x64:2d']";

/// The name of a GPU. Without a GPU a line is printed, which `cargo xtask gpu` looks for.
fn name() -> Option<String> {
    let found = adapters().into_iter().next();
    if found.is_none() {
        println!("not checked: there is no GPU");
    }
    found.map(|adapter| adapter.name)
}

/// Share of bytes that differ by more than rounding explains.
fn differing(a: &[u8], b: &[u8]) -> f64 {
    assert_eq!(a.len(), b.len());
    a.iter().zip(b).filter(|(a, b)| a.abs_diff(**b) > 8).count() as f64 / a.len() as f64
}

/// Colours of a picture that the command draws, and what it says on standard error.
fn draw(renderer: &str, file: &str) -> (Vec<u8>, String) {
    let path = scratch(file);
    let path = path.to_str().unwrap();
    let model = format!("{ROOT}/assets/franka/franka_table.xml");
    let arguments =
        ["render", &model, "--camera", "front", "--size", "64", "--renderer", renderer, "--out", path];
    let output = robohive(&arguments);
    assert!(output.status.success(), "{}", text(&output.stderr));
    (fs::read(path).unwrap(), text(&output.stderr))
}

#[test]
fn the_cpu_draws_where_there_is_no_such_gpu_and_a_line_says_so() {
    let (cpu, quiet) = draw("cpu", "by-cpu.npy");
    let (other, said) = draw("gpu:no such card", "by-none.npy");
    assert!(cpu == other && quiet.is_empty());
    let lines: Vec<&str> = said.lines().filter(|line| line.contains("no such card")).collect();
    assert!(
        lines.len() == 1 && lines[0].ends_with("The CPU draws instead, with the same pictures"),
        "{said}"
    );
}

#[test]
fn a_gpu_draws_what_the_cpu_draws() {
    let Some(name) = name() else { return };
    let (cpu, _) = draw("cpu", "beside-gpu.npy");
    let (gpu, said) = draw(&format!("gpu:{name}"), "by-gpu.npy");
    assert!(!said.contains("The CPU draws instead"), "{said}");
    let share = differing(&cpu, &gpu);
    assert!(cpu != gpu && share < 0.002, "a share of {share} differs");
}

#[test]
fn a_gpu_draws_the_images_of_all_environments() {
    if name().is_none() {
        return;
    }
    let make = |options: Options| {
        let options = options.with_changes(KEYS.parse().unwrap());
        let env = Env::make("hive/FrankaReach-v0", &OwnModels, &options).unwrap();
        VecEnv::new(&env, 4, Autoreset::NextStep, 2).unwrap()
    };
    let painters = Arc::new(EitherPainters::new(Choice::Any));
    let mut gpu = make(Options::default().with_painters(painters));
    let mut cpu = make(Options::default());
    for step in 0..2_u8 {
        for envs in [&mut gpu, &mut cpu] {
            let actions = [0.3 * f64::from(step); 4 * 8];
            if step == 0 {
                envs.reset(Some(1)).map(drop).unwrap()
            } else {
                envs.step(&actions).map(drop).unwrap()
            }
        }
        let (ours, theirs) = (gpu.exteroception().unwrap(), cpu.exteroception().unwrap());
        for (ours, theirs) in ours.zip(theirs) {
            for (a, b) in ours.images().iter().zip(theirs.images()) {
                match (a.pixels(), b.pixels()) {
                    (Pixels::Bytes(a), Pixels::Bytes(b)) => {
                        assert!(differing(a, b) < 0.002, "{}", differing(a, b))
                    }
                    (Pixels::Numbers(a), Pixels::Numbers(b)) => {
                        let far = a.iter().zip(b).filter(|(a, b)| (*a - *b).abs() > 1e-4 * **b).count();
                        assert!(a.len() == b.len() && far <= 4, "{far} depths");
                    }
                    _ => panic!("images of two kinds"),
                }
            }
        }
    }
}

#[test]
fn times_of_a_gpu_name_it() {
    let Some(name) = name() else { return };
    let model = format!("{ROOT}/assets/elbow/elbow.xml");
    let renderer = format!("gpu:{name}");
    let output = robohive(&[
        "bench-render",
        &model,
        "--size",
        "32",
        "--frames",
        "1",
        "--renderer",
        &renderer,
        "--json",
    ]);
    let said = text(&output.stdout);
    let found: serde_json::Value = serde_json::from_str(&said).unwrap_or_else(|_| panic!("{said}"));
    assert!(
        found["renderer"].as_str().unwrap().contains(&name) && found["batch_rgb_ms"].as_f64().unwrap() > 0.0
    );
}
