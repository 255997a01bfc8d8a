//! Steps a second of both solvers on one thread.

use crate::scenes::{controls, start};
use crate::{Subject, first_line};
use physics::{Data, Engine, Model};
use robohive_rapier::{Options, engine};
use std::error::Error;
use std::fmt::Write as _;
use std::time::Instant;

/// Time that a measurement takes \[s\].
const SECONDS: f64 = 1.0;

/// Steps a second, from the first keyframe under sines; after two seconds of motion it begins again.
fn rate(m: &Model, engine: &Engine) -> Result<f64, Box<dyn Error>> {
    let mut mover = engine.start(m)?;
    let start = start(m);
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
            mover.step(m, &mut d)?;
            steps += 1;
        }
    }
    Ok(f64::from(steps) / began.elapsed().as_secs_f64())
}

fn row(name: &str, m: &Model) {
    let [own, other] = [Engine::default(), engine(Options::default())].map(|engine| rate(m, &engine));
    match (own, other) {
        (Ok(own), Ok(other)) => {
            println!("| {name} | {} | {own:.0} | {other:.0} | {:.2} |", m.nv, other / own)
        }
        (Ok(own), Err(error)) => println!("| {name} | {} | {own:.0} | {error} | |", m.nv),
        (Err(error), _) => println!("| {name} | {} | {error} | | |", m.nv),
    }
}

/// Prints a row for each model.
pub fn table(all: &[Subject]) {
    println!(
        "| model | nv | own \\[steps/s\\] | rapier \\[steps/s\\] | rapier / own |\n|---|---|---|---|---|"
    );
    for subject in all {
        match subject.model() {
            Ok(m) => row(&subject.name, &m),
            Err(error) => println!("| {} | | {} | | |", subject.name, first_line(&error)),
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

/// Times that each pile falls, of which the fastest counts: what other work on the machine takes is left out.
const FALLS: usize = 3;

/// Prints a row for each size of a pile: steps a second over the first second and a half of its fall.
///
/// # Errors
/// A pile does not load or move.
pub fn piles() -> Result<(), Box<dyn Error>> {
    println!(
        "| bodies | own \\[steps/s\\] | rapier | contacts kept | stock, single precision | contacts own, rapier, stock |\n\
         |---|---|---|---|---|---|"
    );
    for count in [100, 1000, 10_000] {
        let m = mjcf::load_str(pile(count))?.model;
        let steps = if count == 10_000 { 40 } else { 300 };
        let kept = engine(Options::default().with_recycling(true));
        let engines = [Engine::default(), engine(Options::default()), kept];
        let (mut rates, mut contacts) = ([0.0_f64; 4], [0; 4]);
        for _ in 0..FALLS {
            for k in 0..4 {
                let began = Instant::now();
                contacts[k] = match engines.get(k) {
                    Some(engine) => fall(&m, engine, steps)?,
                    None => stock_fall(&m, steps),
                };
                rates[k] = rates[k].max(steps as f64 / began.elapsed().as_secs_f64());
            }
        }
        let [own, other, kept, stock] = rates.map(|rate| format!("{rate:.1}"));
        let stock = if cfg!(feature = "stock") { &stock } else { "not asked" };
        let [own_contacts, other_contacts, _, stock_contacts] = contacts;
        println!(
            "| {count} | {own} | {other} | {kept} | {stock} | {own_contacts}, {other_contacts}, {stock_contacts} |"
        );
    }
    Ok(())
}

/// Lets a pile fall for some steps, the making of its world included; contacts at the end.
fn fall(m: &Model, engine: &Engine, steps: usize) -> Result<usize, Box<dyn Error>> {
    let mut mover = engine.start(m)?;
    let mut d = Data::new(m);
    (0..steps).try_for_each(|_| mover.step(m, &mut d))?;
    Ok(d.con.contact.len())
}

/// The same of rapier as it is.
#[cfg(feature = "stock")]
fn stock_fall(m: &Model, steps: usize) -> usize {
    crate::stock::pile(m, steps)
}

#[cfg(not(feature = "stock"))]
fn stock_fall(_: &Model, _: usize) -> usize {
    0
}
