//! What a simulated device does.

use crate::plant::Plant;

/// A device at the end of a link.
///
/// It hears and speaks only when called: time is the bench's, and what it says goes out when it is due.
pub trait Device: Send {
    /// Takes bytes that arrived; of links that carry datagrams one datagram.
    fn receive(&mut self, moment: &mut Moment<'_>, bytes: &[u8]);

    /// Works, before every time step of the plant.
    fn tick(&mut self, moment: &mut Moment<'_>);

    /// Somebody presses or releases the stop button.
    fn stop_button(&mut self, pressed: bool);
}

/// A moment in the life of a device.
pub struct Moment<'a> {
    /// Seconds since the bench was made.
    pub time: f64,
    /// What it moves and measures.
    pub plant: &'a mut Plant,
    /// What it says.
    pub outbox: &'a mut Outbox,
}

/// Messages that a device has for its driver.
#[derive(Default)]
pub struct Outbox {
    messages: Vec<(f64, Vec<u8>)>,
}

impl Outbox {
    /// Sends a message that has arrived at the driver at `due` \[s\].
    pub fn send(&mut self, due: f64, bytes: Vec<u8>) {
        self.messages.push((due, bytes));
    }

    /// Takes the messages, in the order in which they were sent.
    pub(crate) fn drain(&mut self) -> impl Iterator<Item = (f64, Vec<u8>)> + '_ {
        self.messages.drain(..)
    }
}
