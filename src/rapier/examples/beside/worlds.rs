//! Which models become a world, and how close it is to the model.

use crate::{Subject, first_line};
use physics::Data;
use robohive_rapier::{Options, World};

/// Prints a row for each model.
pub fn table(all: &[Subject]) {
    println!("| model | nq, nv | mass | axes | inertia | rapier's own loader |");
    println!("|---|---|---|---|---|---|");
    let (mut built, mut exact, mut own_stock, mut stock) = (0, 0, 0, 0);
    let mut largest = [0.0_f64; 3];
    for subject in all {
        let theirs = stock_world(subject);
        let loads = usize::from(theirs == "loads");
        stock += loads;
        own_stock += if subject.is_own() { loads } else { 0 };
        let ours = match &subject.model {
            Err(error) => format!("| {} | | | ", first_line(error)),
            Ok(m) => match World::new(m, Options::default()) {
                Err(refusal) => format!("| {refusal} | | | "),
                Ok(world) => {
                    built += 1;
                    let found = world.measure(m);
                    let moving: f64 =
                        (1..m.nbody).filter(|&b| m.body_treeid[b] >= 0).map(|b| m.body_mass[b]).sum();
                    let mass = if moving > 0.0 { (found.mass / moving - 1.0).abs() } else { found.mass };
                    let axes = axes_off(m, &found.axes);
                    let same = (found.nq, found.nv) == (m.nq, m.nv);
                    let off = [mass, axes, found.inertia];
                    exact += usize::from(same && off.iter().all(|x| *x < 1e-9));
                    largest = [0, 1, 2].map(|k| off[k].max(largest[k]));
                    let (sizes, inertia) = (if same { "equal" } else { "differ" }, found.inertia);
                    format!("| {}, {} {sizes} | {mass:.0e} | {axes:.0e} | {inertia:.0e} ", m.nq, m.nv)
                }
            },
        };
        println!("| {} {ours}| {theirs} |", subject.name);
    }
    let [mass, axes, inertia] = largest;
    println!(
        "\nOf {} models: {built} become a world, {exact} with the model's nq and nv, and mass, axes and inertia within 1e-9; the largest \
         differences are {mass:.0e}, {axes:.0e} and {inertia:.0e}. rapier3d-mjcf loads {stock}, {own_stock} of them own models.",
        all.len()
    );
}

/// Largest difference of a joint's axis in the world.
fn axes_off(m: &physics::Model, found: &[[f64; 3]]) -> f64 {
    let mut d = Data::new(m);
    if physics::forward(m, &mut d).is_err() {
        return f64::NAN;
    }
    let has_axis = |j: &usize| found[*j] != [0.0; 3];
    let off = |j: usize| (0..3).map(move |k| (j, k));
    let differences = (0..m.njnt).filter(has_axis).flat_map(off);
    differences.map(|(j, k)| (found[j][k] - d.kin.xaxis[j][k]).abs()).fold(0.0, f64::max)
}

#[cfg(feature = "stock")]
fn stock_world(subject: &Subject) -> String {
    crate::stock::load(&subject.path).map_or_else(|error| error, |_| "loads".into())
}

#[cfg(not(feature = "stock"))]
fn stock_world(_: &Subject) -> String {
    "not asked".into()
}
