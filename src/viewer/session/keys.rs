//! States that a person keeps, beside the keyframes of the model.

use super::Session;
use crate::text;
use mjcf::edit::carry_state;
use physics::{Model, Snapshot};

/// Most states that are kept: what is more is a recording.
pub const KEPT_KEYS: usize = 100;

impl Session {
    /// Keeps the present state; false when [`KEPT_KEYS`] are kept already.
    pub fn keep_key(&mut self) -> bool {
        let room = self.kept.len() < KEPT_KEYS;
        if room {
            let mut snapshot = Snapshot::default();
            self.data.save(&mut snapshot);
            self.kept.push(snapshot);
        }
        room
    }

    /// The states that were kept, the oldest first.
    pub fn kept_keys(&self) -> &[Snapshot] {
        &self.kept
    }

    /// Returns to a kept state; the simulation pauses. Environments and replays have states of their own and stay as they are.
    pub fn load_key(&mut self, number: usize) {
        let simulates = self.play.is_none() && self.replay.is_none();
        if let Some(snapshot) = self.kept.get(number).filter(|_| simulates).cloned() {
            self.running = false;
            // Kept states are of this model.
            let _ = self.restore(&snapshot);
        }
    }

    /// The kept states in another model, by the names of elements.
    pub(super) fn kept_in(&self, model: &Model) -> Vec<Snapshot> {
        let carried = |kept: &Snapshot| {
            let (mut data, mut snapshot) = (self.data.clone(), Snapshot::default());
            // Kept states are of the present model.
            let _ = data.restore(kept);
            carry_state(&self.model, &data, model).save(&mut snapshot);
            snapshot
        };
        self.kept.iter().map(carried).collect()
    }

    /// The kept states as an element `<keyframe>`, every number exact.
    pub fn keys_text(&self) -> String {
        let mut lines = String::from("<keyframe>\n");
        let mut data = self.data.clone();
        for snapshot in &self.kept {
            // Kept states are of this model.
            let _ = data.restore(snapshot);
            lines += &format!("  {}\n", text::key(&self.model, &data, true));
        }
        lines + "</keyframe>\n"
    }
}
