//! What a simulation does, as an archive of arrays.

use dataset::{Array, NpzWriter};
use std::io::Cursor;
use viewer::Session;

/// Most numbers that a recording holds.
const MOST: usize = 1 << 25;

/// Rows so far. A row is a state, what acts from then on, and what the step from it measures.
pub(crate) struct Recording {
    columns: Vec<Column>,
    rows: usize,
    full: bool,
}

struct Column {
    name: &'static str,
    /// Known once the step was taken.
    measured: bool,
    width: usize,
    values: Vec<f64>,
}

impl Recording {
    /// No rows yet.
    pub(crate) fn new(session: &Session) -> Self {
        let mut columns = Vec::new();
        for measured in [false, true] {
            quantities(session, measured, &mut |name, values| {
                columns.push(Column { name, measured, width: values.len(), values: Vec::new() });
            });
        }
        Recording { columns, rows: 0, full: false }
    }

    fn append(&mut self, session: &Session, measured: bool) {
        let mut columns = self.columns.iter_mut().filter(|column| column.measured == measured);
        quantities(session, measured, &mut |_, values| {
            if let Some(column) = columns.next() {
                column.values.extend_from_slice(values);
            }
        });
    }

    /// Takes a step, as `step` does, and a row of it.
    pub(crate) fn around(
        &mut self,
        session: &mut Session,
        step: impl FnOnce(&mut Session) -> usize,
    ) -> usize {
        let width: usize = self.columns.iter().map(|column| column.width).sum();
        self.full |= (self.rows + 1) * width > MOST;
        if self.full {
            return step(session);
        }
        self.append(session, false);
        let steps = step(session);
        if steps == 0 {
            self.columns.iter_mut().for_each(|column| column.values.truncate(self.rows * column.width));
            return 0;
        }
        self.append(session, true);
        self.rows += 1;
        steps
    }

    /// Number of rows.
    pub(crate) fn rows(&self) -> usize {
        self.rows
    }

    /// Whether there is room for no more.
    pub(crate) fn is_full(&self) -> bool {
        self.full
    }

    /// The archive, an array a quantity.
    pub(crate) fn bytes(&self) -> std::io::Result<Vec<u8>> {
        let mut bytes = Cursor::new(Vec::new());
        let mut archive = NpzWriter::new(&mut bytes);
        for column in &self.columns {
            let shape = match column.name {
                "time" | "reward" => vec![self.rows],
                _ => vec![self.rows, column.width],
            };
            archive.add(column.name, &Array::f64(shape, column.values.clone()))?;
        }
        archive.finish()?;
        Ok(bytes.into_inner())
    }
}

/// Calls `f(name, numbers)` for what is recorded before a step, or of what it measured.
fn quantities(session: &Session, measured: bool, f: &mut dyn FnMut(&'static str, &[f64])) {
    let data = session.data();
    let state = &data.state;
    match (measured, session.play()) {
        (false, play) => {
            f("time", &[state.time]);
            f("qpos", &state.qpos);
            f("qvel", &state.qvel);
            f("act", &state.act);
            f("mocap_pos", state.mocap_pos.as_flattened());
            f("mocap_quat", state.mocap_quat.as_flattened());
            if let Some(play) = play {
                f("observation", play.env().observation());
            }
        }
        (true, play) => {
            f("ctrl", &state.ctrl);
            f("sensordata", &data.sensor.sensordata);
            if let Some(play) = play {
                f("action", play.action());
                f("reward", &[play.env().reward()]);
            }
        }
    }
}
