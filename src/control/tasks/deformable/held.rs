//! What is fixed to the hand: where the tool is to be, so that it is somewhere.

use crate::tasks::arms::arm::Arm;
use crate::tasks::arms::frame::Frame;
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
    pub fn new(body: BodyId, env: &Env, arm: &Arm) -> Self {
        let frame = Frame::of_body(&env.scene().data, body);
        Held { frame, tool: arm.tool(env).within(&frame) }
    }

    /// Where the tool is when the body is at `to`.
    pub fn tool(&self, to: Frame) -> Frame {
        to.with(&self.tool)
    }
}
