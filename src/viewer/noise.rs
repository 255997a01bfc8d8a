//! Controls that wander, to see what a robot does.

use physics::{Data, Model};
use random::{Generator, Pcg64};

/// Noise on controls: a stationary Ornstein-Uhlenbeck process about the middle of each range.
#[derive(Clone, Debug)]
pub struct Noise {
    /// Standard deviation, in halves of the range; 0 for none.
    pub scale: f64,
    /// Time in which it is forgotten \[s\]; 0 for noise without memory.
    pub rate: f64,
    draws: Generator<Pcg64>,
}

impl Noise {
    /// None; draws will follow from `seed`.
    pub fn new(seed: u64) -> Self {
        Noise { scale: 0.0, rate: 0.0, draws: Generator::pcg64(seed) }
    }

    /// Moves all controls on by one step. `middle` are the controls about which unlimited ones wander.
    pub fn step(&mut self, model: &Model, data: &mut Data, middle: Option<&[f64]>) {
        if self.scale <= 0.0 {
            return;
        }
        let keep = if self.rate > 0.0 { (-model.opt.timestep / self.rate).exp() } else { 0.0 };
        let spread = self.scale * (1.0 - keep * keep).sqrt();
        for (i, control) in data.state.ctrl.iter_mut().enumerate() {
            let [low, high] = model.actuator_ctrlrange[i];
            let limited = model.actuator_ctrllimited[i];
            let (centre, half) = if limited { ((low + high) / 2.0, (high - low) / 2.0) } else { (0.0, 1.0) };
            let centre = middle.map_or(centre, |controls| controls[i]);
            let moved =
                keep * *control + (1.0 - keep) * centre + spread * half * self.draws.standard_normal();
            *control = if limited { moved.clamp(low, high) } else { moved };
        }
    }
}
