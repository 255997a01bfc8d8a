//! How far motions drift apart: rapier here, and rapier as its own loader sets it up, from our own solver, which follows MuJoCo
//! (`validation/results/steps.md`, `robohive.md`).

use crate::scenes::{SCENES, controls, start, steps};
use crate::{Subject, first_line};
use physics::{Engine, Model};
use robohive_rapier::{Options, engine};

/// RoboHive's models whose motion is compared.
const ROBOHIVE: [&str; 12] = [
    "fetch_reach_v0",
    "franka_busbin",
    "franka_ycb",
    "trifinger_reorient",
    "DAPG_door",
    "DAPG_relocate",
    "franka_desk",
    "franka_kitchen",
    "myoelbow_1dof6muscles.xml",
    "myohand_pose",
    "myolegs.xml",
    "dkitty_walk_v0",
];

/// Positions of bodies by name, at every step of a second.
pub type Motion = Vec<Vec<[f64; 3]>>;

/// Names of the bodies that move, with their numbers.
pub fn bodies(m: &Model) -> Vec<(String, usize)> {
    let named = m.body_names().map(|(id, name)| (name.to_owned(), id.index()));
    named.filter(|(name, b)| !name.is_empty() && m.body_weldid[*b] != 0).collect()
}

/// A second of motion, or as much of it as an engine takes.
fn simulate(m: &Model, engine: &Engine) -> Result<Motion, String> {
    let mut mover = engine.start(m).map_err(|refusal| refusal.to_string())?;
    let (mut d, names) = (start(m), bodies(m));
    let mut motion = Motion::new();
    for _ in 0..steps(m) {
        let time = d.time();
        controls(m, time, &mut d.state.ctrl);
        if mover.step(m, &mut d).is_err() {
            break;
        }
        let mut now = d.clone();
        if physics::forward(m, &mut now).is_err() {
            break;
        }
        motion.push(names.iter().map(|(_, b)| now.kin.xpos[*b]).collect());
    }
    Ok(motion)
}

/// Root mean square distance after a tenth of a second and after one \[m\], and when any body is first off by 0.01 m \[s\].
fn drift(own: &Motion, other: &Motion, dt: f64) -> String {
    let distance = |a: &[f64; 3], b: &[f64; 3]| (0..3).map(|k| (a[k] - b[k]).powi(2)).sum::<f64>();
    let at = |time: f64| {
        let step = ((time / dt).round() as usize).clamp(1, own.len().max(1)) - 1;
        let (Some(a), Some(b)) = (own.get(step), other.get(step)) else { return "failed".to_owned() };
        let mean = a.iter().zip(b).map(|(a, b)| distance(a, b)).sum::<f64>() / a.len().max(1) as f64;
        format!("{:.0e}", mean.sqrt())
    };
    let off = |(a, b): (&Vec<[f64; 3]>, &Vec<[f64; 3]>)| a.iter().zip(b).any(|(a, b)| distance(a, b) > 1e-4);
    let first = own.iter().zip(other).position(off);
    let first = first.map_or("-".to_owned(), |step| format!("{:.3}", (step + 1) as f64 * dt));
    format!("{} | {} | {first}", at(0.1), at(1.0))
}

/// Prints a row for each scene and model.
///
/// # Errors
/// A scene cannot be written where stock rapier's loader reads it.
pub fn table(all: &[Subject]) -> std::io::Result<()> {
    println!(
        "| model | here: 0.1 s | 1 s | off by 0.01 m at | stock: 0.1 s | 1 s | off at |\n|---|---|---|---|---|---|---|"
    );
    let folder = std::env::temp_dir();
    for (name, text) in SCENES {
        let path = folder.join(format!("{}.xml", name.replace([' ', ','], "_")));
        std::fs::write(&path, text)?;
        row(&Subject::new(name, path));
    }
    let wanted = |s: &&Subject| s.is_own() || ROBOHIVE.iter().any(|name| s.name.contains(name));
    all.iter().filter(wanted).for_each(row);
    Ok(())
}

fn row(subject: &Subject) {
    let m = match subject.model() {
        Ok(m) => m,
        Err(error) => return println!("| {} | {} | | | | | |", subject.name, first_line(&error)),
    };
    let own = simulate(&m, &Engine::default());
    let (Ok(own), Ok(other)) = (own, simulate(&m, &engine(Options::default()))) else {
        return println!("| {} | refused | | | | | |", subject.name);
    };
    let stock = stock(subject, &m, &own);
    println!("| {} | {} | {stock} |", subject.name, drift(&own, &other, m.opt.timestep));
}

#[cfg(feature = "stock")]
fn stock(subject: &Subject, m: &Model, own: &Motion) -> String {
    match crate::stock::simulate(&subject.path, m, &bodies(m), steps(m)) {
        Ok(motion) => drift(own, &motion, m.opt.timestep),
        Err(error) => format!("{error} | |"),
    }
}

#[cfg(not(feature = "stock"))]
fn stock(_: &Subject, _: &Model, _: &Motion) -> String {
    "not asked | |".into()
}
