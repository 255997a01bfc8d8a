//! Recorded states: shown in place of a simulation, or beside it.

use crate::simulation::{Simulation, exception};
use dataset::NpzReader;
use record::Trajectory;
use std::io::Cursor;
use viewer::Session;
use wasm_bindgen::prelude::{JsError, wasm_bindgen};

/// Shows the states in a numpy archive instead of simulating, from the first one on; beside those that are shown already, it
/// draws them translucent, at the same time. `name` is what messages call the archive.
///
/// # Errors
/// The archive is damaged, or holds no states of the session's model.
pub fn replay(session: &mut Session, name: &str, archive: &[u8]) -> Result<(), JsError> {
    let archive =
        NpzReader::read(Cursor::new(archive)).map_err(|error| exception(format!("{name}: {error}")))?;
    let states = Trajectory::of_archive(name, &archive, session.model()).map_err(exception)?;
    session.add_trajectory(states).map_err(exception)
}

#[wasm_bindgen]
impl Simulation {
    /// Shows the states in a numpy archive instead of simulating, from the first one on; beside those that are shown already, it
    /// draws them translucent, at the same time. `name` is what messages call the archive: `qpos`, and where they are there
    /// `time`, `qvel`, `act`, `ctrl`, `mocap_pos` and `mocap_quat`, a row a state, as recordings have them.
    ///
    /// # Errors
    /// The archive is damaged, or holds no states of this model; states are being recorded.
    pub fn replay(&mut self, name: &str, archive: &[u8]) -> Result<(), JsError> {
        if self.recording.is_some() {
            return Err(exception("states are being recorded: end the recording first"));
        }
        replay(&mut self.session, name, archive)
    }

    /// Simulates on from the state that is shown, without recorded ones.
    #[wasm_bindgen(js_name = endReplay)]
    pub fn end_replay(&mut self) {
        // Only trajectories of other models are refused.
        let _ = self.session.set_replay(None);
        let _ = self.session.set_reference(None);
    }

    /// Number of recorded states that are shown; 0 where it simulates.
    #[wasm_bindgen(getter)]
    pub fn states(&self) -> usize {
        self.session.replay().map_or(0, |replay| replay.trajectory().len())
    }

    /// Which of them is shown.
    #[wasm_bindgen(getter)]
    pub fn state(&self) -> usize {
        self.session.replay().map_or(0, |replay| replay.row())
    }

    /// Shows a recorded state, or the last one; time stands still. While it simulates nothing happens.
    pub fn seek(&mut self, state: usize) {
        if self.session.replay().is_some() {
            self.session.seek(state);
        }
    }

    /// Greatest difference of a position to that of the states beside, at the same time \[m, rad\]; nothing where there is none.
    #[wasm_bindgen(getter)]
    pub fn difference(&self) -> Option<f64> {
        self.session.reference().and_then(|reference| reference.difference())
    }
}
