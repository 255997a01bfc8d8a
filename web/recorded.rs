//! Recordings of a simulation, as JavaScript begins and ends them.

use crate::recording::Recording;
use crate::simulation::{Simulation, exception};
use wasm_bindgen::prelude::{JsError, wasm_bindgen};

#[wasm_bindgen]
impl Simulation {
    /// Begins to record every step; what was recorded before is dropped.
    pub fn record(&mut self) {
        self.recording = Some(Recording::new(&self.session));
    }

    /// States recorded so far.
    #[wasm_bindgen(getter)]
    pub fn recorded(&self) -> usize {
        self.recording.as_ref().map_or(0, Recording::rows)
    }

    /// Whether every step is recorded.
    #[wasm_bindgen(getter)]
    pub fn recording(&self) -> bool {
        self.recording.is_some()
    }

    /// Whether the recording holds as much as it can: later steps are not in it.
    #[wasm_bindgen(getter, js_name = recordingFull)]
    pub fn recording_full(&self) -> bool {
        self.recording.as_ref().is_some_and(Recording::is_full)
    }

    /// Ends the recording: a numpy archive (`.npz`) with `time`, `qpos`, `qvel`, `act`, `ctrl` and `sensordata`, of an
    /// environment `observation`, `action` and `reward` too, a row for each step.
    ///
    /// # Errors
    /// Nothing is recorded.
    #[wasm_bindgen(js_name = endRecording)]
    pub fn end_recording(&mut self) -> Result<Vec<u8>, JsError> {
        let recording =
            self.recording.take().ok_or_else(|| exception("nothing is recorded: call record()"))?;
        recording.bytes().map_err(exception)
    }
}
