//! What the own models, and one environment of each task and model, must end in and look like in a page: numbers of steps and hashes after them as
//! `hashes.json`, and pictures of these states as raw bytes, R, G, B, A. Of an environment it is at most an episode.
//!
//! `references FOLDER STEPS WIDTH HEIGHT`

use robohive_web::{Simulation, own_environments, own_models};
use std::collections::BTreeSet;
use std::error::Error;
use std::fs;
use std::path::Path;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread;

fn main() -> Result<(), Box<dyn Error>> {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let [folder, numbers @ ..] = &words[..] else {
        return Err("references FOLDER STEPS WIDTH HEIGHT".into());
    };
    let numbers: Vec<usize> = numbers.iter().map(|word| word.parse()).collect::<Result<_, _>>()?;
    let [steps, width, height] = numbers[..] else {
        return Err("references FOLDER STEPS WIDTH HEIGHT".into());
    };
    let mut kinds = BTreeSet::new();
    let mut is_first = |id: &String| {
        let spec = env::Registry::builtin().spec(id);
        spec.is_ok_and(|spec| kinds.insert((spec.task.clone(), spec.args.get::<String>("model_path"))))
    };
    let environments: Vec<String> = own_environments().into_iter().filter(&mut is_first).collect();
    let names: Vec<String> = own_models().into_iter().chain(environments).collect();
    let (next, threads) = (AtomicUsize::new(0), thread::available_parallelism().map_or(1, usize::from));
    let work = || -> Result<Vec<(usize, String)>, String> {
        let mut rows = Vec::new();
        while let (place, Some(name)) = take(&next, &names) {
            rows.push((place, reference(name, Path::new(folder), steps, [width, height])?));
        }
        Ok(rows)
    };
    let parts: Vec<_> = thread::scope(|scope| {
        let running: Vec<_> = (0..threads).map(|_| scope.spawn(work)).collect();
        running.into_iter().map(|thread| thread.join().expect("a panic ends the program")).collect()
    });
    let mut rows = parts.into_iter().collect::<Result<Vec<_>, _>>()?.concat();
    rows.sort();
    let rows: Vec<String> = rows.into_iter().map(|(_, row)| row).collect();
    fs::write(Path::new(folder).join("hashes.json"), format!("{{{}}}", rows.join(",\n")))?;
    Ok(())
}

/// The next name, with its place.
fn take<'a>(next: &AtomicUsize, names: &'a [String]) -> (usize, Option<&'a String>) {
    let place = next.fetch_add(1, Ordering::Relaxed);
    (place, names.get(place))
}

/// Steps a model or an environment, keeps its picture, and gives its row.
fn reference(name: &str, folder: &Path, steps: usize, [width, height]: [usize; 2]) -> Result<String, String> {
    let (opened, steps) = match env::Registry::builtin().spec(name) {
        Ok(spec) => (Simulation::environment(name, 3, None), steps.min(spec.max_episode_steps)),
        Err(_) => (Simulation::own(name), steps),
    };
    let mut simulation = opened.map_err(|_| format!("{name} does not open"))?;
    let taken = simulation.step(steps);
    if taken != steps {
        return Err(format!("{name} ends after {taken} steps of {steps}"));
    }
    let picture = simulation.draw(width, height).map_err(|_| format!("{name} cannot be drawn"))?;
    let file = folder.join(format!("{}.rgba", name.replace('/', "-")));
    fs::write(&file, picture).map_err(|error| format!("{}: {error}", file.display()))?;
    Ok(format!("{name:?}: \"{taken} {}\"", simulation.hash()))
}
