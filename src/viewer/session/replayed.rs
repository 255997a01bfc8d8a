//! Recorded states in a session: in place of its simulation, and beside it.

use super::Session;
use crate::replay::{Reference, Replay};
use record::Trajectory;
use std::fmt;

/// A trajectory whose states are of another model.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ForeignTrajectory(String);

impl fmt::Display for ForeignTrajectory {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} holds states of another model: their arrays have other widths", self.0)
    }
}

impl std::error::Error for ForeignTrajectory {}

impl Session {
    /// The trajectory that is shown instead of a simulation.
    pub fn replay(&self) -> Option<&Replay> {
        self.replay.as_deref()
    }

    /// Shows a trajectory, from its first state on, instead of simulating; `None` simulates from the state that is shown. An
    /// environment that was played ends, and a recording is completed.
    ///
    /// # Errors
    /// Its states are of another model; the session stays as it was.
    pub fn set_replay(&mut self, trajectory: Option<Trajectory>) -> Result<(), ForeignTrajectory> {
        let replay = trajectory.map(|trajectory| self.fitting(trajectory)).transpose()?.map(Replay::new);
        self.running = false;
        self.release();
        self.replay = replay.map(Box::new);
        if self.replay.is_some() {
            let unwritten = self.end_recording();
            self.play = None;
            self.go_to_row(0);
            self.fault = self.fault.take().or(unwritten);
        }
        Ok(())
    }

    /// Shows a trajectory instead of simulating; where one is shown already, draws this one beside it.
    ///
    /// # Errors
    /// Its states are of another model; the session stays as it was.
    pub fn add_trajectory(&mut self, trajectory: Trajectory) -> Result<(), ForeignTrajectory> {
        match self.replay {
            Some(_) => self.set_reference(Some(trajectory)),
            None => self.set_replay(Some(trajectory)),
        }
    }

    /// Goes to a recorded state, or to the last one; the simulation pauses. Without a replay nothing happens.
    pub fn seek(&mut self, row: usize) {
        self.running = false;
        self.go_to_row(row);
    }

    pub(super) fn go_to_row(&mut self, row: usize) {
        let Some(replay) = &mut self.replay else { return };
        replay.go_to(row);
        replay.trajectory().write(replay.row(), &mut self.data);
        self.settle();
    }

    /// Real time went by \[s\] during a replay; how many states it went on.
    pub(super) fn advance_replay(&mut self, seconds: f64) -> usize {
        self.pace.elapse(seconds);
        let began = self.replay.as_ref().map_or(0, |replay| replay.row());
        while let Some(replay) = &mut self.replay {
            let Some(span) = replay.span() else {
                self.running = false;
                break;
            };
            if !self.pace.is_due(span) {
                break;
            }
            replay.go_to(replay.row() + 1);
            self.pace.stepped(span);
        }
        self.pace.settle();
        let Some(replay) = &self.replay else { return 0 };
        let (row, gone) = (replay.row(), replay.row() - began);
        if gone > 0 {
            replay.trajectory().write(row, &mut self.data);
            self.evaluate();
        }
        gone
    }

    /// The trajectory that is drawn beside the state, and how far the two are apart.
    pub fn reference(&self) -> Option<&Reference> {
        self.reference.as_deref()
    }

    /// Draws a trajectory beside the state, translucent, at the same time; `None` draws none.
    ///
    /// # Errors
    /// Its states are of another model; the session stays as it was.
    pub fn set_reference(&mut self, trajectory: Option<Trajectory>) -> Result<(), ForeignTrajectory> {
        let trajectory = trajectory.map(|trajectory| self.fitting(trajectory)).transpose()?;
        self.reference = trajectory.map(|trajectory| Box::new(Reference::new(trajectory, &self.model)));
        self.follow();
        Ok(())
    }

    fn fitting(&self, trajectory: Trajectory) -> Result<Trajectory, ForeignTrajectory> {
        match trajectory.fits(&self.model) {
            true => Ok(trajectory),
            false => Err(ForeignTrajectory(trajectory.name().to_owned())),
        }
    }

    /// Takes the reference to the time of the state.
    pub(super) fn follow(&mut self) {
        if let Some(reference) = &mut self.reference {
            reference.follow(&self.model, &self.data);
            self.revision += 1;
        }
    }
}
