//! What the own models, and one environment of each task and model, must end in and look like in a page: hashes after a number of steps as `hashes.json`,
//! and pictures of these states as raw bytes, R, G, B, A.
//!
//! `references FOLDER STEPS WIDTH HEIGHT`

use robohive_web::{Simulation, own_environments, own_models};
use std::collections::BTreeSet;
use std::error::Error;
use std::fs;
use std::path::Path;

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
    let mut rows = Vec::new();
    for name in own_models().into_iter().chain(environments) {
        let opened = match name.contains('/') {
            true => Simulation::environment(&name, 3, None),
            false => Simulation::own(&name),
        };
        let mut simulation = opened.map_err(|_| format!("{name} does not open"))?;
        let taken = simulation.step(steps);
        rows.push(format!("{name:?}: \"{taken} {}\"", simulation.hash()));
        let picture = simulation.draw(width, height).map_err(|_| format!("{name} cannot be drawn"))?;
        fs::write(Path::new(folder).join(format!("{}.rgba", name.replace('/', "-"))), picture)?;
    }
    fs::write(Path::new(folder).join("hashes.json"), format!("{{{}}}", rows.join(",\n")))?;
    Ok(())
}
