//! What is fixed to the hand: where the tool is to be, so that it is somewhere, and work that is done again until it is well.

use crate::error::ControlError;
use crate::tasks::arms::arm::Arm;
use crate::tasks::arms::frame::Frame;
use crate::tasks::arms::moves::{Move, Script};
use env::Env;
use physics::elements::BodyId;

/// A body at the hand.
#[derive(Clone, Copy)]
pub struct Held {
    /// Where the body is.
    pub frame: Frame,
    /// The tool in its frame.
    tool: Frame,
}

impl Held {
    /// How the hand holds a body now.
    fn new(body: BodyId, env: &Env, arm: &Arm) -> Self {
        let frame = Frame::of_body(&env.scene().data, body);
        Held { frame, tool: arm.tool(env).within(&frame) }
    }

    /// Where the tool is when the body is at `to`.
    pub fn tool(&self, to: Frame) -> Frame {
        to.with(&self.tool)
    }
}

/// A way to work with what is held.
pub trait Work: Send {
    /// The body that is held.
    fn body(&self) -> BodyId;

    /// The moves of an attempt, for a body that was held so at the start of the episode.
    fn plan(&self, held: &Held, env: &Env) -> Vec<Move>;
}

/// Attempts, one after the other, while the row `held` says that the task is not done.
pub struct Attempts<W> {
    work: W,
    held: Option<Held>,
    /// What is left to do, the last first.
    left: Vec<Move>,
}

impl<W: Work> Attempts<W> {
    /// The script of this work.
    pub fn new(work: W) -> Self {
        Attempts { work, held: None, left: Vec::new() }
    }

    fn plan(&mut self, held: &Held, env: &Env) {
        self.left = self.work.plan(held, env);
        self.left.reverse();
    }
}

impl<W: Work> Script for Attempts<W> {
    fn begin(&mut self, env: &Env, arm: &Arm) -> Result<(), ControlError> {
        let held = Held::new(self.work.body(), env, arm);
        self.held = Some(held);
        self.plan(&held, env);
        Ok(())
    }

    fn next(&mut self, env: &Env, _: &Arm) -> Result<Option<Move>, ControlError> {
        if let Some(held) = self.held
            && self.left.is_empty()
            && env.rows()["held"][0] == 0.0
        {
            self.plan(&held, env);
        }
        Ok(self.left.pop())
    }
}
