//! Bytes that no device sends: nothing panics, axes stay between their ends, and a session goes on.

use robohive_teleop::{Event, Gamepad, Held, Keyboard, Mapping, Quest, SpaceMouse};

/// Bytes that follow no pattern, the same ever again (Marsaglia, Xorshift RNGs, 2003).
struct Bytes(u64);

impl Bytes {
    fn next(&mut self) -> u64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        self.0
    }

    /// A piece of at most 40 bytes, most of them of those that mean something.
    fn piece(&mut self, meaning: &[u8]) -> Vec<u8> {
        let length = self.next() % 40;
        (0..length)
            .map(|_| match self.next() % 3 {
                0 => self.next() as u8,
                _ => meaning[self.next() as usize % meaning.len()],
            })
            .collect()
    }
}

fn check(events: &[Event]) {
    for event in events {
        if let Event::Move(_, place) = event {
            assert!((-1.0..=1.0).contains(place), "{event:?}");
        }
        if let Event::Hand(hand) = event {
            let length: f64 = hand.orientation.iter().map(|x| x * x).sum();
            assert!((length - 1.0).abs() < 1e-6 && hand.position.iter().all(|x| x.is_finite()), "{hand:?}");
        }
    }
}

#[test]
fn decoders_take_any_bytes() {
    let mut bytes = Bytes(0x9e37_79b9_7f4a_7c15);
    let (mut keyboard, mut gamepad, mut mouse, mut quest) =
        (Keyboard::default(), Gamepad::default(), SpaceMouse::default(), Quest::default());
    let (mut held, mut mapping) = (Held::default(), Mapping::default());
    let mut told = [0; 4];
    for round in 0..20_000 {
        let now = 0.01 * f64::from(round);
        let mut events = [const { Vec::new() }; 4];
        keyboard.feed(&bytes.piece(b"\x1b[O1359;:u~ABCDIdaqz?c"), now, &mut events[0]);
        keyboard.settle(now + 0.05, &mut events[0]);
        gamepad.feed(&bytes.piece(&[0, 1, 3, 0x30, 0x31, 0xff]), &mut events[1]);
        mouse.report(&bytes.piece(&[1, 2, 3, 0x5e, 0xff, 0x80]), &mut events[2]);
        let line = match round % 4 {
            0 => b"I wE9ryARX: r:1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1&".to_vec(),
            _ => bytes.piece(b"wE9ryARX: rl:|&,RG10.-\n"),
        };
        quest.feed(&line, &mut events[3]);
        for (told, events) in told.iter_mut().zip(&events) {
            check(events);
            *told += events.len();
            events.iter().for_each(|event| held.apply(*event, now));
        }
        let motion = mapping.read(&held.sample(now)).motion;
        assert!(motion.arms[0].along.iter().all(|x| (-1.0..=1.0).contains(x)), "{motion:?}");
    }
    assert!(told.iter().all(|&told| told > 100), "{told:?}");
}
