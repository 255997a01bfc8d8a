//! Recorded states: shown in place of a simulation, or beside it.

use physics::math::{dot, scale, sub};
use physics::model::JointType;
use physics::{Data, Model, forward};
use record::Trajectory;

/// A trajectory that a session shows instead of simulating, and where in it.
#[derive(Clone, Debug)]
pub struct Replay {
    trajectory: Trajectory,
    row: usize,
}

impl Replay {
    /// At the first state.
    pub fn new(trajectory: Trajectory) -> Self {
        Replay { trajectory, row: 0 }
    }

    /// The trajectory.
    pub fn trajectory(&self) -> &Trajectory {
        &self.trajectory
    }

    /// The state that is shown.
    pub fn row(&self) -> usize {
        self.row
    }

    /// Goes to a state, or to the last one.
    pub fn go_to(&mut self, row: usize) {
        self.row = row.min(self.trajectory.len() - 1);
    }

    /// Time until the next state \[s\]; none behind the last.
    pub fn span(&self) -> Option<f64> {
        let next = self.row + 1;
        (next < self.trajectory.len()).then(|| self.trajectory.time(next) - self.trajectory.time(self.row))
    }
}

/// A trajectory that is drawn beside a session's own state, translucent, at the same time.
#[derive(Clone, Debug)]
pub struct Reference {
    trajectory: Trajectory,
    row: usize,
    data: Data,
    difference: Option<f64>,
}

impl Reference {
    /// At the first state of a trajectory of `model`.
    pub fn new(trajectory: Trajectory, model: &Model) -> Self {
        Reference { trajectory, row: 0, data: Data::new(model), difference: None }
    }

    /// The trajectory.
    pub fn trajectory(&self) -> &Trajectory {
        &self.trajectory
    }

    /// The state that is shown.
    pub fn row(&self) -> usize {
        self.row
    }

    /// That state, evaluated.
    pub fn data(&self) -> &Data {
        &self.data
    }

    /// Greatest difference of a position to the session's \[m, rad\]; orientations by the angle between them. None where no
    /// state was recorded at the session's time.
    pub fn difference(&self) -> Option<f64> {
        self.difference
    }

    /// Goes to the state nearest in time to `data`, which is of the same model.
    pub(crate) fn follow(&mut self, model: &Model, data: &Data) {
        let time = data.time();
        self.row = self.trajectory.nearest(time);
        self.trajectory.write(self.row, &mut self.data);
        // A recorded state that physics refuses stays where the one before it was drawn.
        let _ = forward(model, &mut self.data);
        let apart = (self.trajectory.time(self.row) - time).abs();
        let same_time = apart <= 0.25 * model.opt.timestep;
        self.difference =
            same_time.then(|| difference(model, &data.state.qpos, self.trajectory.qpos(self.row)));
    }
}

/// Greatest difference of a position, orientations by the angle between them.
fn difference(model: &Model, a: &[f64], b: &[f64]) -> f64 {
    let mut greatest = 0.0_f64;
    for joint in 0..model.njnt {
        let at = model.jnt_qposadr[joint] as usize;
        let plain = match JointType::from_code(model.jnt_type[joint]) {
            Some(JointType::Free) => 3,
            Some(JointType::Ball) => 0,
            _ => 1,
        };
        let turned =
            matches!(JointType::from_code(model.jnt_type[joint]), Some(JointType::Free | JointType::Ball));
        for k in at..at + plain {
            greatest = greatest.max((a[k] - b[k]).abs());
        }
        if turned {
            let at = at + plain;
            greatest = greatest.max(angle(&a[at..at + 4], &b[at..at + 4]));
        }
    }
    greatest
}

/// Angle between two orientations \[rad\], by the chord between their unit quaternions, which is exact for small angles.
fn angle(a: &[f64], b: &[f64]) -> f64 {
    let unit = |q: &[f64]| {
        let norm = q.iter().map(|x| x * x).sum::<f64>().sqrt();
        [q[0] / norm, q[1] / norm, q[2] / norm, q[3] / norm]
    };
    let (a, b) = (unit(a), unit(b));
    let chord = |sign: f64| {
        let scalar = a[0] - sign * b[0];
        let vector = sub([a[1], a[2], a[3]], scale([b[1], b[2], b[3]], sign));
        (scalar * scalar + dot(vector, vector)).sqrt()
    };
    4.0 * (chord(1.0).min(chord(-1.0)) / 2.0).min(1.0).asin()
}
