//! Steps a second of both solvers on one thread.

use crate::Subject;
use crate::motion::controls;
use physics::{Data, Engine, Model};
use robohive_rapier::{Options, engine};
use std::fmt::Write as _;
use std::time::Instant;

/// Time that a measurement takes \[s\], after as many steps as a second of motion has at most.
const SECONDS: f64 = 1.0;

/// Steps a second, from the first keyframe under sines; after two seconds of motion it begins again.
fn rate(m: &Model, engine: &Engine) -> Option<f64> {
    let mut mover = engine.start(m).ok()?;
    let mut start = Data::new(m);
    if m.nkey > 0 {
        start.reset_to_key(m, 0).ok()?;
    }
    let mut d = start.clone();
    let (mut steps, began) = (0, Instant::now());
    while began.elapsed().as_secs_f64() < SECONDS {
        for _ in 0..10 {
            if d.time() > start.time() + 2.0 {
                d.state.clone_from(&start.state);
                mover.reset();
            }
            let time = d.time();
            controls(m, time, &mut d.state.ctrl);
            mover.step(m, &mut d).ok()?;
            steps += 1;
        }
    }
    Some(f64::from(steps) / began.elapsed().as_secs_f64())
}

fn row(name: &str, m: &Model) {
    let [own, other] = [Engine::default(), engine(Options::default())].map(|engine| rate(m, &engine));
    match (own, other) {
        (Some(own), Some(other)) => {
            println!("| {name} | {} | {own:.0} | {other:.0} | {:.2} |", m.nv, other / own)
        }
        (Some(own), None) => println!("| {name} | {} | {own:.0} | refused or unstable | |", m.nv),
        _ => println!("| {name} | {} | unstable | | |", m.nv),
    }
}

/// Prints a row for each model.
pub fn table(all: &[Subject]) {
    println!(
        "| model | nv | own \\[steps/s\\] | rapier \\[steps/s\\] | rapier / own |\n|---|---|---|---|---|"
    );
    for subject in all {
        if let Ok(m) = &subject.model {
            row(&subject.name, m);
        }
    }
}

/// A heap of boxes, spheres and capsules that fall onto each other.
fn pile(count: usize) -> String {
    let side = (count as f64).cbrt().ceil() as usize;
    let mut text =
        String::from("<mujoco><option timestep='.005'/><worldbody><geom type='plane' size='50 50 1'/>");
    for i in 0..count {
        let (x, y, z) = (i % side, i / side % side, i / side / side);
        let shape = ["type='box' size='.05 .05 .05'", "size='.05'", "type='capsule' size='.04 .03'"][i % 3];
        let at = |k: usize, by: f64| k as f64 * 0.13 + by * ((i * 7) % 5) as f64;
        let _ = write!(
            text,
            "<body pos='{} {} {}'><freejoint/><geom {shape}/></body>",
            at(x, 0.004),
            at(y, 0.003),
            0.1 + at(z, 0.0)
        );
    }
    text + "</worldbody></mujoco>"
}

/// Prints a row for each size of a pile: steps a second over the first second and a half of its fall.
pub fn piles() {
    println!(
        "| bodies | own \\[steps/s\\] | rapier | rapier, contacts kept | contacts own, rapier |\n|---|---|---|---|---|"
    );
    for count in [100, 1000, 10_000] {
        let loaded = match mjcf::load_str(pile(count)) {
            Ok(loaded) => loaded,
            Err(error) => {
                println!("| {count} | {error} | | | |");
                continue;
            }
        };
        let m = loaded.model;
        let steps = if count == 10_000 { 40 } else { 300 };
        let kept = engine(Options::default().with_recycling(true));
        let engines = [Engine::default(), engine(Options::default()), kept];
        let found = engines.map(|engine| {
            let mut mover = engine.start(&m).ok()?;
            let mut d = Data::new(&m);
            let began = Instant::now();
            (0..steps).try_for_each(|_| mover.step(&m, &mut d)).ok()?;
            Some((f64::from(steps) / began.elapsed().as_secs_f64(), d.con.contact.len()))
        });
        let [rates, contacts] = [0, 1].map(|part| {
            found.map(|found| match (found, part) {
                (None, _) => "fails".to_owned(),
                (Some((rate, _)), 0) => format!("{rate:.1}"),
                (Some((_, contacts)), _) => contacts.to_string(),
            })
        });
        println!(
            "| {count} | {} | {} | {} | {}, {} |",
            rates[0], rates[1], rates[2], contacts[0], contacts[1]
        );
    }
}
