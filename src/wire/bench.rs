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

/// Times that are no further apart than this are the same \[s\].
const ROUNDING: f64 = 1e-9;

/// Messages under way, each with the time at which it arrives.
type Queue = VecDeque<(f64, Vec<u8>)>;

struct Link {
    /// Its device, and which of that device's links it is.
    device: usize,
    channel: usize,
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
    devices: Vec<Box<dyn Device>>,
    links: Vec<Link>,
    outbox: Outbox,
    stopped: bool,
}

impl Bench {
    /// A bench without devices, at time 0.
    pub fn new(plant: Plant) -> Bench {
        Bench {
            plant,
            time: 0.0,
            devices: Vec::new(),
            links: Vec::new(),
            outbox: Outbox::default(),
            stopped: false,
        }
    }

    /// Connects a device by a link without faults.
    pub fn connect(&mut self, device: Box<dyn Device>, carries: Carries) -> LinkId {
        let [link] = self.connect_all(device, [carries]);
        link
    }

    /// Connects a device by several links without faults: what it calls channel 0, 1 and so on.
    pub fn connect_all<const N: usize>(
        &mut self,
        device: Box<dyn Device>,
        carries: [Carries; N],
    ) -> [LinkId; N] {
        let none = || Injector::new(Rates::default(), 0);
        let (place, first) = (self.devices.len(), self.links.len());
        self.devices.push(device);
        self.links.extend(carries.into_iter().enumerate().map(|(channel, carries)| Link {
            device: place,
            channel,
            carries,
            connected: true,
            to_device: Queue::new(),
            to_host: Queue::new(),
            faults: [none(), none()],
        }));
        std::array::from_fn(|k| LinkId(first + k))
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
        self.devices.iter_mut().for_each(|device| device.stop_button(pressed));
    }

    /// Whether the stop button is pressed.
    pub fn stopped(&self) -> bool {
        self.stopped
    }

    /// Whether a link is connected.
    pub fn connected(&self, link: LinkId) -> bool {
        self.links[link.0].connected
    }

    /// Connects a link again, or cuts it: what was under way is lost, and the device hears of it.
    pub fn set_connected(&mut self, link: LinkId, connected: bool) {
        let Link { device, channel, .. } = self.links[link.0];
        let link = &mut self.links[link.0];
        link.connected = connected;
        link.to_device.clear();
        link.to_host.clear();
        self.at_device(device, |device, moment| device.connected(moment, channel, connected));
    }

    /// Whether a link carries datagrams: these get lost where a connection would end.
    pub fn carries_datagrams(&self, link: LinkId) -> bool {
        self.links[link.0].carries == Carries::Datagrams
    }

    /// Whether two links lead to the same device.
    pub fn same_device(&self, a: LinkId, b: LinkId) -> bool {
        self.links[a.0].device == self.links[b.0].device
    }

    /// The port at which the driver said that it waits for a link's datagrams.
    pub fn announced(&self, link: LinkId) -> Option<u16> {
        let Link { device, channel, .. } = self.links[link.0];
        self.devices[device].announced(channel)
    }

    /// Sends what a driver says to its device.
    pub fn send(&mut self, link: LinkId, bytes: &[u8]) {
        if !self.links[link.0].connected {
            return;
        }
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
        while self.due(link).is_none_or(|due| due > self.time) {
            let due = self.due(link).unwrap_or(f64::INFINITY);
            if !self.advance_to_event(end.min(due)) && self.time >= end {
                return;
            }
        }
    }

    /// Lets time pass until `end`, and everything happen that is due then.
    pub fn advance(&mut self, end: f64) {
        while self.advance_to_event(end) {}
    }

    /// Whether a device waits for its driver, see [`Device::expects`].
    pub fn expects(&self) -> bool {
        self.devices.iter().any(|device| device.expects())
    }

    /// When the next thing happens that a step of the plant is not: an arrival at a device, or what a device does by itself.
    pub fn next_event(&self) -> f64 {
        let arrivals = self.links.iter().filter_map(|link| link.to_device.front()).map(|(due, _)| *due);
        arrivals.chain(self.devices.iter().map(|device| device.due())).fold(f64::INFINITY, f64::min)
    }

    /// Lets time pass until the next thing happens, at most until `end`: an arrival at a device, its own work, or a time
    /// step. Returns whether anything did.
    fn advance_to_event(&mut self, end: f64) -> bool {
        let arrivals = self.links.iter().enumerate();
        let arrival = arrivals
            .filter_map(|(at, link)| link.to_device.front().map(|(due, _)| (*due, at)))
            .min_by(|a, b| a.0.total_cmp(&b.0));
        let works = self.devices.iter().map(|device| device.due()).enumerate();
        let work = works.min_by(|a, b| a.1.total_cmp(&b.1)).filter(|(_, due)| *due < f64::INFINITY);
        let step = self.plant.next();
        match (arrival, work) {
            (Some((due, at)), _)
                if due <= end && due < step && work.is_none_or(|(_, other)| due <= other) =>
            {
                self.time = self.time.max(due);
                let Some((_, bytes)) = self.links[at].to_device.pop_front() else { return false };
                let Link { device, channel, .. } = self.links[at];
                self.at_device(device, |device, moment| device.receive(moment, channel, &bytes));
            }
            // What a device does at the end of a step sees what the step has brought about. Within rounding of `end` it
            // belongs before it, as a step does.
            (_, Some((at, due))) if due <= end + ROUNDING && due < step - ROUNDING => {
                self.time = self.time.max(due.min(end));
                self.at_device(at, |device, moment| device.work(moment));
            }
            _ if step <= end + ROUNDING => {
                for at in 0..self.devices.len() {
                    self.at_device(at, |device, moment| device.tick(moment));
                }
                self.plant.step();
                self.time = self.time.max(step.min(end));
            }
            _ => {
                self.time = self.time.max(end);
                return false;
            }
        }
        true
    }

    /// Lets a device act, and passes on what it says.
    fn at_device(&mut self, at: usize, act: impl FnOnce(&mut dyn Device, &mut Moment<'_>)) {
        let Bench { plant, time, devices, links, outbox, .. } = self;
        act(devices[at].as_mut(), &mut Moment { time: *time, plant, outbox });
        let mut accident = None;
        for (channel, due, bytes) in outbox.drain() {
            let place = links.iter().position(|link| (link.device, link.channel) == (at, channel));
            let Some(place) = place.filter(|place| links[*place].connected) else { continue };
            let Link { carries, to_host, faults: [_, faults], .. } = &mut links[place];
            let due = due + carries.duration(bytes.len());
            let struck = faults.pass(due, bytes, |due, bytes| queue(to_host, due, bytes));
            accident = accident.or(struck.map(|accident| (place, accident)));
        }
        if let Some((place, accident)) = accident {
            self.befall(LinkId(place), Some(accident));
        }
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
