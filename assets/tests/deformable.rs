//! Soft things beside the numbers that their README names.

use physics::{Data, Model, step};

fn load(task: &str) -> Model {
    let file = format!("deformable/tasks/{task}.xml");
    mjcf::Loader::default().files(robohive_assets::Own).load(file).unwrap().model
}

/// Mass of the bodies whose names begin with `name` \[kg\], and how many there are.
fn mass(m: &Model, name: &str) -> (f64, usize) {
    let named: Vec<_> = m.body_names().filter(|(_, own)| own.starts_with(name)).collect();
    (named.iter().map(|(body, _)| m.body_mass[body.index()]).sum(), named.len())
}

#[test]
fn masses_and_counts_are_those_written_down() {
    let (rope, links) = mass(&load("rope_straighten"), "rope_");
    assert!((rope - 0.0384).abs() < 1e-12 && links == 24, "{rope} {links}");
    let (sponge, nodes) = mass(&load("sponge_press"), "sponge_");
    assert!((sponge - 0.12).abs() < 1e-12 && nodes == 8, "{sponge} {nodes}");
    let (cloth, points) = mass(&load("cloth_fold"), "cloth_");
    assert!((cloth - 0.03).abs() < 1e-12 && points == 49, "{cloth} {points}");
    let (rods, count) = mass(&load("cloth_fold"), "rod_");
    assert!((rods - 0.04).abs() < 1e-12 && count == 2, "{rods} {count}");
    let (grains, count) = mass(&load("grain_pour"), "grain");
    let one = 1200.0 * 4.0 / 3.0 * std::f64::consts::PI * 0.006_f64.powi(3);
    assert!((grains - 100.0 * one).abs() < 1e-12 && count == 100, "{grains} {count}");
}

/// A hanging rope swings slowest in 2 pi / 1.2024 sqrt(l / g), half the first zero of the Bessel function of order zero (Bernoulli). Here it hangs
/// along the table. Of links it swings a little slower.
#[test]
fn a_hanging_rope_swings_as_bernoulli_says() {
    let mut m = load("rope_straighten");
    m.options_mut().gravity = [9.81, 0.0, 0.0];
    let mut data = Data::new(&m);
    let first = m.joint("rope_0").unwrap();
    let (place, dof) = (m.joint(first).qpos_range().start, m.joint(first).dof_range().start);
    let (sine, cosine) = 0.02_f64.sin_cos();
    data.state.qpos[place..place + 4].copy_from_slice(&[cosine, 0.0, 0.0, sine]);
    let end = m.site("rope_end").unwrap();
    let mut crossings = Vec::new();
    let mut before = f64::INFINITY;
    while crossings.len() < 4 && data.time() < 10.0 {
        step(&m, &mut data).unwrap();
        let aside = data.site(end).xpos()[1] - 0.5;
        if before > 0.0 && aside <= 0.0 {
            crossings.push(data.time());
        }
        before = aside;
    }
    assert!(
        data.state.qvel[dof..dof + 2].iter().all(|rate| rate.abs() < 1e-6),
        "it swings in the plane of the table"
    );
    let period = (crossings[3] - crossings[1]) / 2.0;
    let expected = std::f64::consts::TAU / 1.2024 * (0.48_f64 / 9.81).sqrt();
    assert!((period / expected - 1.0).abs() < 0.03, "{period} s, expected {expected} s");
}
