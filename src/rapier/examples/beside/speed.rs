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
        let found = engines.map(|engine| {
            let mut mover = engine.start(&m)?;
            let mut d = Data::new(&m);
            let began = Instant::now();
            (0..steps).try_for_each(|_| mover.step(&m, &mut d))?;
            Ok::<_, Box<dyn Error>>((steps as f64 / began.elapsed().as_secs_f64(), d.con.contact.len()))
        });
        let [own, other, kept] = found;
        let ((own, own_contacts), (other, contacts), (kept, _)) = (own?, other?, kept?);
        let (stock, stock_contacts) = stock_pile(&m, steps);
        println!(
            "| {count} | {own:.1} | {other:.1} | {kept:.1} | {stock} | {own_contacts}, {contacts}, {stock_contacts} |"
        );
    }
    Ok(())
}

/// Steps a second of rapier as it is, and its contacts.
#[cfg(feature = "stock")]
fn stock_pile(m: &Model, steps: usize) -> (String, usize) {
    let mut pile = crate::stock::pile(m);
    let began = Instant::now();
    let contacts = pile(steps);
    (format!("{:.1}", steps as f64 / began.elapsed().as_secs_f64()), contacts)
}

#[cfg(not(feature = "stock"))]
fn stock_pile(_: &Model, _: usize) -> (String, usize) {
    ("not asked".into(), 0)
}
