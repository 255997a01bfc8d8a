//! Measures steps on one thread. Reads lines `MODEL STEPS` from standard input and prints the elapsed seconds of each. A model is
//! loaded once; later lines continue from its last state. `benches/web.mjs` compares WebAssembly with it.

use physics::{Data, Model, forward, step};
use robohive_mjcf as mjcf;
use std::collections::BTreeMap;
use std::error::Error;
use std::io::{Write, stdin, stdout};
use std::time::Instant;

fn main() -> Result<(), Box<dyn Error>> {
    let mut open: BTreeMap<String, (Model, Data)> = BTreeMap::new();
    for line in stdin().lines() {
        let line = line?;
        let (path, steps) = line.split_once(' ').ok_or("a line is MODEL STEPS")?;
        let steps: usize = steps.parse()?;
        if !open.contains_key(path) {
            let model = mjcf::load(path)?.model;
            let mut data = Data::new(&model);
            if model.nkey > 0 {
                data.reset_to_key(&model, 0)?;
            }
            forward(&model, &mut data)?;
            open.insert(path.to_owned(), (model, data));
        }
        let (model, data) = open.get_mut(path).ok_or("just opened")?;
        let began = Instant::now();
        for _ in 0..steps {
            step(model, data)?;
        }
        println!("{}", began.elapsed().as_secs_f64());
        stdout().flush()?;
    }
    Ok(())
}
