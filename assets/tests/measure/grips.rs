//! A hand that closes on a free body, and how far that slips.

use super::{posed, run};
use physics::Model;
use physics::math::{norm, sub};

/// What becomes of a free body in a grip \[m\].
pub struct Grip {
    /// How far it moves in the second after it is let go.
    pub gives: f64,
    /// How far it moves in the ten seconds after that.
    pub slips: f64,
}

/// Holds the last body of a model, which is free, where the model has it, while the servos go from one pose to another within 0.8 s;
/// then lets it go.
pub fn grip(m: &Model, open: &[f64], closed: &[f64]) -> Grip {
    let (place, speed, body) = (m.nq - 7, m.nv - 6, m.nbody - 1);
    let mut d = posed(m, open);
    let start: [f64; 7] = std::array::from_fn(|i| m.qpos0[place + i]);
    run(m, &mut d, 1.5, |d| {
        let share = (d.time() / 0.8).min(1.0);
        for (actuator, (open, closed)) in open.iter().zip(closed).enumerate() {
            d.state.ctrl[actuator] = open + share * (closed - open);
        }
        d.state.qpos[place..].copy_from_slice(&start);
        d.state.qvel[speed..].fill(0.0);
    });
    let mut after = |seconds: f64| {
        let before: [f64; 3] = std::array::from_fn(|i| d.state.qpos[place + i]);
        run(m, &mut d, seconds, |_| ());
        norm(sub(std::array::from_fn(|i| d.state.qpos[place + i]), before))
    };
    let (gives, slips) = (after(1.0), after(10.0));
    println!(
        "{} gives {:.1} mm, then slips {:.2} mm in 10 s",
        m.body_names().nth(body).map_or("it", |(_, name)| name),
        gives * 1e3,
        slips * 1e3
    );
    Grip { gives, slips }
}
