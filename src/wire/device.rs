//! What a simulated device does.

use crate::plant::Plant;

/// A device at the end of a link, or of several: its channels, which it counts from 0.
///
/// It hears and speaks only when called: time is the bench's, and what it says goes out when it is due.
pub trait Device: Send {
    /// Takes bytes that arrived on a channel; of links that carry datagrams one datagram.
    fn receive(&mut self, moment: &mut Moment<'_>, channel: usize, bytes: &[u8]);

    /// Works, before every time step of the plant.
    fn tick(&mut self, moment: &mut Moment<'_>);

    /// Somebody presses or releases the stop button.
    fn stop_button(&mut self, pressed: bool);

    /// When it works by itself next, beside the plant's steps \[s\].
    fn due(&self) -> f64 {
        f64::INFINITY
    }

    /// Works by itself, when that is due.
    fn work(&mut self, _moment: &mut Moment<'_>) {}

    /// Whether it waits for its driver, and time that is served in real time may wait with it.
    fn expects(&self) -> bool {
        false
    }

    /// A channel was connected, or cut.
    fn connected(&mut self, _moment: &mut Moment<'_>, _channel: usize, _connected: bool) {}

    /// The port at which its driver said that it waits for the datagrams of a channel.
    fn announced(&self, _channel: usize) -> Option<u16> {
        None
    }
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
    messages: Vec<(usize, f64, Vec<u8>)>,
}

impl Outbox {
    /// Sends a message on a channel, which has arrived at the driver at `due` \[s\].
    pub fn send(&mut self, channel: usize, due: f64, bytes: Vec<u8>) {
        self.messages.push((channel, due, bytes));
    }

    /// Takes the messages, in the order in which they were sent.
    pub(crate) fn drain(&mut self) -> impl Iterator<Item = (usize, f64, Vec<u8>)> + '_ {
        self.messages.drain(..)
    }
}
