//! Contacts in motion: two free bodies push each other with equal forces, and a pile of a hundred comes to rest.

use super::law::{Bound, Law, LawError, compile};
use crate::tolerance::BALANCE;
use physics::acceleration::contact_force::contact_force;
use physics::math::{Vec3, add, cross, mul_mat_vec, norm};
use physics::model::{Cone, Solver};
use physics::{Data, Model};
use std::fmt::Write;

/// How many of the four variants of the pile are run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Piles {
    /// Newton with pyramidal cones.
    One,
    /// Newton and CG with both cones.
    All,
}

/// Bodies of the pile.
const BODIES: usize = 100;
/// Steps until it rests.
const STEPS: usize = 2000;
/// Last steps, over which the largest velocity is watched: soft friction creeps, and now and then a body tips over.
const WATCHED: usize = 400;
/// Median, over those steps, of the largest velocity of a pile at rest \[m/s, rad/s\]; some fall with 30 rad/s.
const REST: f64 = 1.0;
/// Root mean square of all velocities over those steps.
const MEAN: f64 = 0.1;
/// Deepest penetration in those steps \[m\]; the bodies are about 0.1 m across.
const DEPTH: f64 = 5e-3;

/// A bin of five planes and a hundred boxes, spheres, capsules, cylinders and ellipsoids above it.
fn pile() -> String {
    let mut text = String::from(
        r#"<mujoco><option timestep="0.005"/><default><geom condim="4" friction="1 0.03" density="500" solimp="0.99 0.999 0.001"/><joint damping="0.03"/></default>
<worldbody><geom type="plane" size="2 2 1"/>
<geom type="plane" size="2 2 1" pos="0.5 0 0" zaxis="-1 0 0.2"/><geom type="plane" size="2 2 1" pos="-0.5 0 0" zaxis="1 0 0.2"/>
<geom type="plane" size="2 2 1" pos="0 0.5 0" zaxis="0 -1 0.2"/><geom type="plane" size="2 2 1" pos="0 -0.5 0" zaxis="0 1 0.2"/>
"#,
    );
    let shapes = [
        r#"type="box" size="0.05 0.04 0.03""#,
        r#"type="sphere" size="0.045""#,
        r#"type="capsule" size="0.03 0.04""#,
        r#"type="cylinder" size="0.04 0.04""#,
        r#"type="ellipsoid" size="0.06 0.045 0.035""#,
    ];
    for i in 0..BODIES {
        // A grid of thirty-six a layer, turned and shifted by fractions that repeat nowhere near.
        let fraction = |k: usize| (i * k) as f64 * 0.618_033_988_75 % 1.0;
        let (x, y) = ((i % 6) as f64 * 0.15 - 0.375, (i / 6 % 6) as f64 * 0.15 - 0.375);
        let z = (i / 36) as f64 * 0.15 + 0.1;
        let _ = writeln!(
            text,
            r#"<body pos="{} {} {z}" euler="{} {} 0"><joint type="free"/><geom {}/></body>"#,
            x + 0.02 * fraction(1),
            y + 0.02 * fraction(3),
            360.0 * fraction(5),
            180.0 * fraction(7),
            shapes[i % shapes.len()],
        );
    }
    text + "</worldbody></mujoco>"
}

/// Over the last steps: median of the largest velocity, root mean square of all velocities, deepest penetration.
/// Infinite where the pile is not one.
fn settle(m: &Model) -> Result<[f64; 3], LawError> {
    let mut d = Data::new(m);
    let (mut speeds, mut squares, mut depth) = (Vec::new(), 0.0, 0.0_f64);
    for step in 0..STEPS {
        physics::step(m, &mut d)?;
        if step + WATCHED >= STEPS {
            speeds.push(d.state.qvel.iter().fold(0.0, |s: f64, v| s.max(v.abs())));
            squares += d.state.qvel.iter().map(|v| v * v).sum::<f64>();
            depth = d.con.contact.iter().fold(depth, |s, c| s.max(-c.dist));
        }
    }
    speeds.sort_by(f64::total_cmp);
    let lowest = (1..=BODIES).fold(f64::INFINITY, |low: f64, b| low.min(d.kin.xpos[b][2]));
    let piled = lowest > 0.0 && d.con.contact.len() > BODIES;
    let mean = (squares / (WATCHED * m.nv) as f64).sqrt();
    Ok(if piled { [speeds[WATCHED / 2], mean, depth] } else { [f64::INFINITY; 3] })
}

/// The pile under each solver and cone.
pub(super) fn piles(which: Piles) -> Result<Vec<Law>, LawError> {
    let mut laws = Vec::new();
    let mut m = compile(&pile())?;
    for solver in [Solver::Newton, Solver::Cg] {
        for cone in [Cone::Pyramidal, Cone::Elliptic] {
            (m.options_mut().solver, m.options_mut().cone) = (solver, cone);
            let on =
                format!("{BODIES} primitives in a bin after {STEPS} steps of 5 ms, {solver:?}, {cone:?}");
            let laws_of = [
                ("a pile comes to rest: root mean square of velocities over 2 s", MEAN),
                ("a pile comes to rest: median of the largest velocity over 2 s", REST),
                ("a pile holds: deepest penetration over 2 s [m]", DEPTH),
            ];
            let [speed, mean, depth] = settle(&m)?;
            for ((law, most), measured) in laws_of.into_iter().zip([mean, speed, depth]) {
                laws.push(Law::new(law, &on, measured, Bound::AtMost(most)));
            }
            if which == Piles::One {
                return Ok(laws);
            }
        }
    }
    Ok(laws)
}

/// Two free bodies in contact, nothing else near.
const PAIR: &str = r#"<mujoco><option gravity="0 0 0"/><default><geom condim="6" friction="0.8 0.02 0.01"/></default><worldbody>
  <body pos="0 0 0" euler="10 20 30"><freejoint/><geom type="box" size="0.1 0.08 0.06" pos="0.01 0.02 0.03"/></body>
  <body pos="0.05 0.1 0.12" euler="50 20 10"><freejoint/><geom type="cylinder" size="0.07 0.05"/></body>
</worldbody></mujoco>"#;

/// Force of a free joint's degrees of freedom on its body: force, and torque about the world's origin.
fn wrench(d: &Data, body: usize) -> [Vec3; 2] {
    let generalized = &d.acc.qfrc_constraint[6 * (body - 1)..6 * body];
    let part = |k: usize| std::array::from_fn(|i| generalized[k + i]);
    let (force, local): (Vec3, Vec3) = (part(0), part(3));
    [force, add(mul_mat_vec(&d.kin.xmat[body], local), cross(d.kin.xpos[body], force))]
}

/// Constraint forces of two bodies sum to nothing.
pub(super) fn action_and_reaction() -> Result<Law, LawError> {
    let mut m = compile(PAIR)?;
    let mut worst = 0.0_f64;
    for cone in [Cone::Pyramidal, Cone::Elliptic] {
        m.options_mut().cone = cone;
        let mut d = Data::new(&m);
        d.state.qvel.copy_from_slice(&[0.5, 0.2, 0.4, 1.0, -2.0, 0.5, -0.3, 0.1, -0.6, 0.7, 1.5, -1.0]);
        physics::forward(&m, &mut d)?;
        let [a, b] = [wrench(&d, 1), wrench(&d, 2)];
        for k in 0..2 {
            worst = worst.max(norm(add(a[k], b[k])) / norm(a[k]));
        }
        let pushes: Vec<[f64; 6]> = d.con.contact.iter().map(|c| contact_force(&m, &d.efc, c)).collect();
        if !pushes.iter().any(|f| f[0] > 1.0 && f[1].abs() > 1e-3) {
            worst = f64::INFINITY;
        }
    }
    let on = "a box and a cylinder that slide and turn on each other, both cones";
    Ok(Law::new("action is reaction: sum of forces and of torques", on, worst, Bound::Within(&BALANCE)))
}
