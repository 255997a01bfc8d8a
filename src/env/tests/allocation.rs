//! A step of an environment, and the images of its visual keys, allocate nothing once their buffers have grown in an earlier
//! episode: heap traffic would make their duration unpredictable. The first images of an episode are not counted: what a reset
//! edited of the model is then prepared for the pictures that follow, in vectors of its own.
//!
//! RoboHive's ids need its models. Over all of them, with models that were imported:
//!
//! ```text
//! ROBOHIVE_STORE=FOLDER cargo test --profile ci -p robohive-env --test allocation
//! ROBOHIVE_IDS=FrankaPush names a part of the ids.
//! ```

use mjcf::Loader;
use robohive_env::{Arguments, AssetError, Assets, Env, Options, Registry, Rng, Spec};
use stats_alloc::{INSTRUMENTED_SYSTEM, Region, StatsAlloc};
use std::alloc::System;
use std::collections::BTreeSet;
use std::path::PathBuf;
use std::sync::Arc;
use store::Search;
use toml::Value;

#[global_allocator]
static HEAP: &StatsAlloc<System> = &INSTRUMENTED_SYSTEM;

/// Longest part of an episode that is looked at.
const STEPS: usize = 60;

/// Steps of an episode whose images are drawn.
const DRAWN: usize = 4;
/// Images before that: a renderer keeps 16 views, and every image of a camera that moves is another; twice as many, so that the memory
/// of each has held several.
const WARM: usize = 32;

/// Models that were imported, or that stand in the folders of `ROBOHIVE_ASSETS`.
struct Imported(Search);

impl Assets for Imported {
    fn model(&self, path: &str) -> Result<(Loader, PathBuf), AssetError> {
        let file = self.0.resolve(path).map_err(|error| error.to_string())?;
        Ok((Loader::default(), file))
    }

    fn read(&self, path: &str) -> Result<Arc<[u8]>, AssetError> {
        let file = self.0.resolve(path).map_err(|error| error.to_string())?;
        std::fs::read(file).map(Into::into).map_err(|error| error.to_string().into())
    }
}

/// Whether images are made anew each time, so that they are not counted: the surfaces of flexes, and features.
fn makes_images(env: &Env) -> bool {
    env.scene().model.nflex > 0 || env.visual_keys().iter().any(|key| key.is_encoded())
}

/// Settings that make the images of an id small: their pixels take the time, and make no difference to what is allocated when. What a network
/// encodes keeps its size.
fn small_images(spec: &Spec) -> Arguments {
    let small = |key: &String| match key.ends_with("d") {
        true => key.replace(":224x224:", ":32x32:"),
        false => key.clone(),
    };
    match spec.args.get::<Vec<String>>("visual_keys") {
        Some(keys) => {
            let keys: Vec<_> = keys.iter().map(small).collect();
            Arguments::default().with("visual_keys", keys).unwrap()
        }
        None => Arguments::default(),
    }
}

/// Plays the same seeded episode and draws `images` images; how many allocations its steps and images made.
fn allocations(env: &mut Env, images: usize) -> usize {
    let (mut rng, mut action) = (Rng::pcg64(7_u64), vec![0.0; env.action_len()]);
    env.reset(Some(3)).unwrap();
    let drawn = if makes_images(env) { 0 } else { images };
    if drawn > 0 {
        env.exteroception().unwrap();
    }
    let mut found = 0;
    for index in 0..STEPS {
        env.random_action(&mut rng, &mut action).unwrap();
        let region = Region::new(HEAP);
        let step = env.step(&action).unwrap();
        if index < drawn {
            env.exteroception().unwrap();
        }
        let change = region.change();
        // The report of a step that physics refuses is text.
        if step.fault.is_none() {
            found += change.allocations + change.reallocations;
        }
        if step.terminated || step.truncated {
            break;
        }
    }
    found
}

/// No harness, whose thread would be counted too. `cargo test -- --list` asks for the tests of one, and there are none.
fn main() {
    if std::env::args().any(|argument| argument == "--list") {
        return;
    }
    let named = |name: &str| std::env::var_os(name).is_some_and(|value| !value.is_empty());
    let imported = named("ROBOHIVE_STORE") || named("ROBOHIVE_ASSETS");
    let search = if imported { Search::from_environment().unwrap() } else { Search::new(None, Vec::new()) };
    let assets = Imported(search);
    let part = std::env::var("ROBOHIVE_IDS").unwrap_or_default();
    let (mut checked, mut left, mut wrong) = (0, 0, Vec::new());
    let (mut kinds, mut bare) = (BTreeSet::new(), BTreeSet::new());
    for spec in Registry::builtin().specs() {
        let setting = |name: &str| format!("{:?}", spec.args.get::<Value>(name));
        let kind = (spec.task.clone(), setting("model_path"));
        // On models of our own, one id of each task, model and list of images.
        let own = spec.id.starts_with("hive/") && kinds.insert((kind.clone(), setting("visual_keys")));
        if !spec.id.contains(&part) || !imported && !own {
            left += 1;
            continue;
        }
        let options = Options::default().with_changes(small_images(spec));
        let mut env = Env::make(&spec.id, &assets, &options).unwrap();
        // Where no images are counted, an id on a model of our own makes the steps of the one without images.
        if own && !imported && makes_images(&env) && !bare.insert(kind) {
            left += 1;
            continue;
        }
        allocations(&mut env, WARM);
        let found = allocations(&mut env, DRAWN);
        if found > 0 {
            wrong.push(format!("{}: {found}", spec.id));
        }
        checked += 1;
    }
    println!(
        "steps of {checked} environments counted; {left} left out, which are in no ROBOHIVE_STORE or ROBOHIVE_ASSETS, like one that is counted, or not named"
    );
    assert!(checked > 0 && wrong.is_empty(), "allocations in steps:\n{}", wrong.join("\n"));
}
