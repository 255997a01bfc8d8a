//! Hashes of the own models and environments after a number of steps, as JSON: what the same steps in a page must end in.

use robohive_web::{Simulation, own_environments, own_models};

fn main() {
    let steps = std::env::args().nth(1).and_then(|word| word.parse().ok()).unwrap_or(1000);
    let hash = |mut simulation: Simulation| {
        let taken = simulation.step(steps);
        format!("\"{taken} {}\"", simulation.hash())
    };
    let open = |name: &str| Simulation::own(name).unwrap_or_else(|_| panic!("{name} does not open"));
    let play =
        |id: &str| Simulation::environment(id, 3, None).unwrap_or_else(|_| panic!("{id} does not open"));
    let models = own_models().into_iter().map(|name| format!("\"{name}\": {}", hash(open(&name))));
    let played = own_environments().into_iter().map(|id| format!("\"{id}\": {}", hash(play(&id))));
    println!("{{{}}}", models.chain(played).collect::<Vec<_>>().join(",\n"));
}
