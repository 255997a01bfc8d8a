//! Where the time of steps goes.

use physics::Data;
use physics::pipeline::watch::{Stage, Watch};
use std::collections::VecDeque;
use web_time::{Duration, Instant};

/// Frames that are kept.
pub const FRAMES_KEPT: usize = 200;

/// What stages of steps took, frame by frame, and how large the problems were.
#[derive(Clone, Debug, Default)]
pub struct Profile {
    frames: VecDeque<Frame>,
    clock: Option<Clock>,
}

/// The steps of a frame.
#[derive(Clone, Copy, Debug, Default)]
pub struct Frame {
    /// Steps that were taken.
    pub steps: usize,
    /// Mean time of each stage in a step \[s\], in the order of [`Stage::ALL`].
    pub stages: [f64; Stage::ALL.len()],
    /// Contacts after the last step.
    pub contacts: usize,
    /// Constraint rows of it.
    pub rows: usize,
    /// Iterations of the constraint solver in it, over all islands.
    pub iterations: usize,
    /// Islands of it.
    pub islands: usize,
}

impl Frame {
    /// What a step took \[s\].
    pub fn whole(&self) -> f64 {
        self.stages.iter().sum()
    }
}

impl Profile {
    /// The frames so far, the oldest first; at most [`FRAMES_KEPT`].
    pub fn frames(&self) -> impl ExactSizeIterator<Item = &Frame> {
        self.frames.iter()
    }

    /// The mean of all frames, weighted by their steps.
    pub fn mean(&self) -> Frame {
        let steps: usize = self.frames.iter().map(|frame| frame.steps).sum();
        let mut mean = Frame { steps, ..self.frames.back().copied().unwrap_or_default() };
        for (stage, seconds) in mean.stages.iter_mut().enumerate() {
            let all = self.frames.iter().map(|frame| frame.stages[stage] * frame.steps as f64);
            *seconds = all.sum::<f64>() / steps.max(1) as f64;
        }
        mean
    }

    /// The clock that the steps of a frame are watched with.
    pub(crate) fn clock(&mut self) -> &mut Clock {
        self.clock.get_or_insert_with(Clock::new)
    }

    /// The steps of a frame are taken.
    pub(crate) fn end_frame(&mut self, data: &Data) {
        let Some(clock) = self.clock.take().filter(|clock| clock.steps > 0) else { return };
        if self.frames.len() == FRAMES_KEPT {
            self.frames.pop_front();
        }
        self.frames.push_back(Frame {
            steps: clock.steps,
            stages: clock.spent.map(|spent| spent.as_secs_f64() / clock.steps as f64),
            contacts: data.con.contact.len(),
            rows: data.efc.nefc,
            iterations: data.solver.solver_niter.iter().map(|&n| n.max(0) as usize).sum(),
            islands: data.island.nisland,
        });
    }
}

/// Reads the time at the end of every stage.
#[derive(Clone, Debug)]
pub(crate) struct Clock {
    last: Instant,
    spent: [Duration; Stage::ALL.len()],
    steps: usize,
}

impl Clock {
    fn new() -> Self {
        Clock { last: Instant::now(), spent: [Duration::ZERO; Stage::ALL.len()], steps: 0 }
    }

    /// A step begins now.
    pub(crate) fn begin(&mut self) {
        self.last = Instant::now();
        self.steps += 1;
    }
}

impl Watch for Clock {
    fn ended(&mut self, stage: Stage) {
        let now = Instant::now();
        self.spent[stage as usize] += now - self.last;
        self.last = now;
    }
}

/// What the constraint solver gained in each iteration of the last step: the logarithm (base 10) of the improvement and of the
/// gradient, islands one after the other.
pub fn convergence(data: &Data) -> Vec<[f64; 2]> {
    let log = |x: f64| x.max(1e-15).log10();
    let done: usize = data.solver.solver_niter.iter().map(|&n| n.max(0) as usize).sum();
    let iterations = data.solver.solver.iter().take(done);
    iterations.map(|iteration| [log(iteration.improvement), log(iteration.gradient)]).collect()
}
