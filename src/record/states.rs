//! The states of a simulation, written while it moves.

use dataset::growing::ColumnId;
use dataset::{Dtype, GrowingNpz};
use physics::Data;
use physics::table::Slice;
use std::io;
use std::path::Path;

/// A trajectory that is being written to a numpy archive. A row is a state, the controls in force from then on, and what the
/// step from that state measures. Rows go to `FILE.npz.part/NAME.npy` first, so that a killed process leaves arrays that
/// numpy loads.
pub struct StateRecording {
    out: GrowingNpz,
    state: [ColumnId; 7],
    measured: [ColumnId; 2],
    rows: u64,
}

impl StateRecording {
    /// Makes the file, for states of the model that `data` is of.
    ///
    /// # Errors
    /// The file cannot be written.
    pub fn create(path: &Path, data: &Data) -> io::Result<Self> {
        let mut out = GrowingNpz::create(path)?;
        let mut column = |name: &str, row: &[usize]| out.column(name, Dtype::F64, row);
        let s = &data.state;
        let state = [
            column("time", &[])?,
            column("qpos", &[s.qpos.len()])?,
            column("qvel", &[s.qvel.len()])?,
            column("act", &[s.act.len()])?,
            column("ctrl", &[s.ctrl.len()])?,
            column("mocap_pos", &[s.mocap_pos.len(), 3])?,
            column("mocap_quat", &[s.mocap_quat.len(), 4])?,
        ];
        let measured = [column("sensordata", &[data.sensor.sensordata.len()])?, column("energy", &[2])?];
        Ok(StateRecording { out, state, measured, rows: 0 })
    }

    /// Appends the state that a step starts from.
    ///
    /// # Errors
    /// Writing fails.
    pub fn state(&mut self, data: &Data) -> io::Result<()> {
        let s = &data.state;
        let values: [&[f64]; 7] = [
            &[s.time],
            &s.qpos,
            &s.qvel,
            &s.act,
            &s.ctrl,
            s.mocap_pos.as_flattened(),
            s.mocap_quat.as_flattened(),
        ];
        self.append(self.state, values)
    }

    /// Appends what the step measured of that state: NaN if it failed.
    ///
    /// # Errors
    /// Writing fails.
    pub fn measurements(&mut self, data: &Data, measured: bool) -> io::Result<()> {
        if measured {
            self.append(self.measured, [&data.sensor.sensordata, &data.energy])?;
        } else {
            self.append(self.measured, [&vec![f64::NAN; data.sensor.sensordata.len()], &[f64::NAN; 2]])?;
        }
        self.rows += 1;
        self.out.sync_if_due()
    }

    /// Rows so far.
    pub fn rows(&self) -> u64 {
        self.rows
    }

    fn append<const N: usize>(&mut self, columns: [ColumnId; N], rows: [&[f64]; N]) -> io::Result<()> {
        for (column, row) in columns.into_iter().zip(rows) {
            let put = |out: &mut dyn FnMut(&[u8])| Slice::F64(row).pieces(out);
            self.out.append(column, 1, put)?;
        }
        Ok(())
    }

    /// Completes the file; the number of rows.
    ///
    /// # Errors
    /// Writing fails.
    pub fn finish(self) -> io::Result<u64> {
        self.out.finish().map(|()| self.rows)
    }
}
