//! A plant with devices on it, in virtual time.

use crate::device::{Device, Moment, Outbox};
use crate::faults::{Accident, Injector, Rates};
use crate::plant::Plant;
use std::collections::VecDeque;

/// One of a bench's links.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct LinkId(usize);

/// What a link carries.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Carries {
    /// Bytes in a row, each of which takes this long \[s\]; 10 bits a byte on a serial line.
    Bytes {
        /// Seconds a byte.
        each: f64,
    },
    /// Datagrams, at once.
    Datagrams,
}

impl Carries {
    /// A serial line of this many bits a second; without a start and a stop bit nothing passes, so a byte takes ten.
    pub fn serial(baud: f64) -> Carries {
        Carries::Bytes { each: 10.0 / baud }
    }

    /// Bytes that take no time.
    pub const AT_ONCE: Carries = Carries::Bytes { each: 0.0 };
}

/// Messages under way, each with the time at which it arrives.
type Queue = VecDeque<(f64, Vec<u8>)>;

struct Link {
    device: Box<dyn Device>,
    carries: Carries,
    connected: bool,
    to_device: Queue,
    to_host: Queue,
    faults: [Injector; 2],
}

/// A plant with devices on it. Time passes when it is told to, so that a run with the same calls and seeds is the same run.
pub struct Bench {
    plant: Plant,
    time: f64,
    links: Vec<Link>,
    outbox: Outbox,
    stopped: bool,
}

impl Bench {
    /// A bench without devices, at time 0.
    pub fn new(plant: Plant) -> Bench {
        Bench { plant, time: 0.0, links: Vec::new(), outbox: Outbox::default(), stopped: false }
    }

    /// Connects a device by a link without faults.
    pub fn connect(&mut self, device: Box<dyn Device>, carries: Carries) -> LinkId {
        let none = || Injector::new(Rates::default(), 0);
        self.links.push(Link {
            device,
            carries,
            connected: true,
            to_device: Queue::new(),
            to_host: Queue::new(),
            faults: [none(), none()],
        });
        LinkId(self.links.len() - 1)
    }

    /// Lets faults strike a link from now on, in both directions.
    pub fn inject(&mut self, link: LinkId, rates: Rates, seed: u64) {
        let injector = |direction| Injector::new(rates, seed.wrapping_mul(2).wrapping_add(direction));
        self.links[link.0].faults = [injector(0), injector(1)];
    }

    /// Faults that struck a link since [`Bench::inject`].
    pub fn struck(&self, link: LinkId) -> u64 {
        self.links[link.0].faults.iter().map(Injector::struck).sum()
    }

    /// What moves.
    pub fn plant(&self) -> &Plant {
        &self.plant
    }

    /// What moves, to be put elsewhere.
    pub fn plant_mut(&mut self) -> &mut Plant {
        &mut self.plant
    }

    /// Seconds since it was made.
    pub fn time(&self) -> f64 {
        self.time
    }

    /// Presses or releases the stop button.
    pub fn stop_button(&mut self, pressed: bool) {
        self.stopped = pressed;
        self.links.iter_mut().for_each(|link| link.device.stop_button(pressed));
    }

    /// Whether the stop button is pressed.
    pub fn stopped(&self) -> bool {
        self.stopped
    }

    /// Whether a link is connected.
    pub fn connected(&self, link: LinkId) -> bool {
        self.links[link.0].connected
    }

    /// Connects a link again, or cuts it: what was under way is lost.
    pub fn set_connected(&mut self, link: LinkId, connected: bool) {
        let link = &mut self.links[link.0];
        link.connected = connected;
        link.to_device.clear();
        link.to_host.clear();
    }

    /// Sends what a driver says to its device.
    pub fn send(&mut self, link: LinkId, bytes: &[u8]) {
        let Link { carries, to_device, faults: [faults, _], .. } = &mut self.links[link.0];
        let due = self.time + carries.duration(bytes.len());
        let accident = faults.pass(due, bytes.to_vec(), |due, bytes| queue(to_device, due, bytes));
        self.befall(link, accident);
    }

    /// What a device has said and has arrived by now; of a link of bytes at most `room` of them.
    pub fn receive(&mut self, link: LinkId, room: usize) -> Option<Vec<u8>> {
        let Link { carries, to_host, .. } = &mut self.links[link.0];
        let (due, bytes) = to_host.front_mut()?;
        if *due > self.time {
            return None;
        }
        if matches!(carries, Carries::Bytes { .. }) && bytes.len() > room {
            return Some(bytes.drain(..room).collect());
        }
        to_host.pop_front().map(|(_, bytes)| bytes)
    }

    /// Drops what has arrived at the driver by now.
    pub fn discard(&mut self, link: LinkId) {
        let now = self.time;
        self.links[link.0].to_host.retain(|(due, _)| *due > now);
    }

    /// When the next message of a link arrives at its driver.
    pub fn due(&self, link: LinkId) -> Option<f64> {
        self.links[link.0].to_host.front().map(|(due, _)| *due)
    }

    /// Lets time pass until `end`, or until a message for the driver of `link` arrives.
    pub fn advance_until(&mut self, link: LinkId, end: f64) {
        while self.time < end && self.due(link).is_none_or(|due| due > self.time) {
            let due = self.due(link).unwrap_or(f64::INFINITY);
            self.advance_to_event(end.min(due));
        }
    }

    /// Lets time pass until `end`.
    pub fn advance(&mut self, end: f64) {
        while self.time < end {
            self.advance_to_event(end);
        }
    }

    /// Lets time pass until the next thing happens, at most until `end`: an arrival at a device or a time step.
    fn advance_to_event(&mut self, end: f64) {
        let arrivals = self.links.iter().enumerate();
        let arrival = arrivals
            .filter_map(|(at, link)| link.to_device.front().map(|(due, _)| (*due, at)))
            .min_by(|a, b| a.0.total_cmp(&b.0));
        let step = self.plant.next();
        match arrival {
            Some((due, at)) if due <= end && due < step => {
                self.time = self.time.max(due);
                let Some((_, bytes)) = self.links[at].to_device.pop_front() else { return };
                self.at_device(at, |device, moment| device.receive(moment, &bytes));
            }
            // A step that ends within rounding of `end` belongs before it.
            _ if step <= end + 1e-9 => {
                for at in 0..self.links.len() {
                    self.at_device(at, |device, moment| device.tick(moment));
                }
                self.plant.step();
                self.time = self.time.max(step.min(end));
            }
            _ => self.time = end,
        }
    }

    /// Lets a device act, and passes on what it says.
    fn at_device(&mut self, at: usize, act: impl FnOnce(&mut dyn Device, &mut Moment<'_>)) {
        let Bench { plant, time, links, outbox, .. } = self;
        let link = &mut links[at];
        act(link.device.as_mut(), &mut Moment { time: *time, plant, outbox });
        let mut accident = None;
        for (due, bytes) in outbox.drain() {
            let due = due + link.carries.duration(bytes.len());
            let to_host = &mut link.to_host;
            accident = accident.or(link.faults[1].pass(due, bytes, |due, bytes| queue(to_host, due, bytes)));
        }
        self.befall(LinkId(at), accident);
    }

    fn befall(&mut self, link: LinkId, accident: Option<Accident>) {
        match accident {
            Some(Accident::Disconnected) => self.set_connected(link, false),
            Some(Accident::StopPressed) => self.stop_button(true),
            None => {}
        }
    }
}

impl Carries {
    fn duration(self, bytes: usize) -> f64 {
        match self {
            Carries::Bytes { each } => each * bytes as f64,
            Carries::Datagrams => 0.0,
        }
    }
}

/// Puts a message where its time has it; of equal times the one that came first goes first.
fn queue(queue: &mut Queue, due: f64, bytes: Vec<u8>) {
    let place = queue.partition_point(|(other, _)| *other <= due);
    queue.insert(place, (due, bytes));
}
