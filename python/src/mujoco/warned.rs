//! Warnings as MuJoCo shows them: counts since the last reset of the data, by kind, and what programs are told.

use physics::Data as Simulation;
use physics::data::{Warning, Warnings};
use pyo3::prelude::*;

/// Place and number of each kind of warning, in MuJoCo's order. What the first three would warn of is an error here.
#[derive(Default)]
pub struct Warned {
    arrays: [[i32; Warned::KINDS]; 2],
}

impl Warned {
    /// Kinds of warnings.
    pub const KINDS: usize = 7;
    /// Names of the two arrays: the place of the last warning of a kind, the number of them.
    pub const NAMES: [&'static str; 2] = ["warning.lastinfo", "warning.number"];
    /// Kinds that are never counted here: inertia, contacts, constraints.
    const ERRORS: usize = 3;

    pub fn array(&self, which: usize) -> &[i32] {
        &self.arrays[which.min(1)]
    }

    pub fn array_mut(&mut self, which: usize) -> &mut [i32] {
        &mut self.arrays[which.min(1)]
    }

    /// Shows these counts.
    pub fn show(&mut self, counts: &Warnings) {
        for (kind, warning) in kinds(counts).into_iter().enumerate() {
            self.arrays[0][Self::ERRORS + kind] = warning.last as i32;
            self.arrays[1][Self::ERRORS + kind] = warning.count as i32;
        }
    }

    /// The counts that are shown.
    pub fn counts(&self) -> Warnings {
        let [bad_qpos, bad_qvel, bad_qacc, bad_ctrl] = std::array::from_fn(|kind| Warning {
            last: usize::try_from(self.arrays[0][Self::ERRORS + kind]).unwrap_or(0),
            count: usize::try_from(self.arrays[1][Self::ERRORS + kind]).unwrap_or(0),
        });
        Warnings { bad_qpos, bad_qvel, bad_qacc, bad_ctrl }
    }
}

fn kinds(counts: &Warnings) -> [Warning; 4] {
    [counts.bad_qpos, counts.bad_qvel, counts.bad_qacc, counts.bad_ctrl]
}

/// The first warning of a kind: the kind, the place in the array, the time at which the step began [s].
pub type Notice = (usize, usize, f64);

/// Whether the step that it is of has been reset: all but refused controls are.
pub fn is_reset((kind, ..): Notice) -> bool {
    (Warned::ERRORS..Warned::ERRORS + 3).contains(&kind)
}

/// Counts warnings since the last reset; a step that resets is the first that counts. Notes, with the time, which kinds are
/// new since `before`.
pub fn settle(simulation: &mut Simulation, before: &Warnings, time: f64, notices: &mut Vec<Notice>) {
    let (old, new) = (kinds(before), kinds(&simulation.warnings));
    for (kind, (old, new)) in old.into_iter().zip(new).enumerate() {
        if old.count == 0 && new.count > 0 {
            notices.push((Warned::ERRORS + kind, new.last, time));
        }
    }
    if simulation.warnings.resets() == before.resets() {
        return;
    }
    // Of several resets in a step, that for accelerations is the last, and one for positions is not followed by another.
    let mut since = Warnings { bad_ctrl: simulation.warnings.bad_ctrl, ..Warnings::default() };
    let once = |warning: Warning| Warning { count: 1, ..warning };
    match [0, 1, 2].map(|kind| new[kind].count > old[kind].count) {
        [_, _, true] => since.bad_qacc = once(new[2]),
        [_, true, _] => since.bad_qvel = once(new[1]),
        _ => since.bad_qpos = once(new[0]),
    }
    simulation.warnings = since;
}

/// Tells programs of warnings, by the handler that they set or as Python's warnings.
pub fn tell(py: Python<'_>, notices: &[Notice]) -> PyResult<()> {
    if notices.is_empty() {
        return Ok(());
    }
    let teller = py.import("robohive.mujoco.callbacks")?.getattr("_tell")?;
    notices.iter().try_for_each(|&notice| teller.call1(notice).map(drop))
}
