//! A headset and a glove on nobody, which move by themselves.

use std::f64::consts::TAU;
use wire::adb::{Server, Shown};
use wire::cyberglove::Glove;

/// How long a motion takes, which then begins again \[s\].
const PERIOD: f64 = 4.0;
/// Frames a second of the headset.
const FRAMES: u32 = 72;
/// Radius of the controller's circle \[m\], and how far it is in front of the head.
const RADIUS: f64 = 0.1;
const AHEAD: f64 = 0.4;

/// A headset whose right controller is gripped and goes round a circle in the plane of the face, x right and y up.
pub fn headset(serial: &str) -> Server {
    const UPRIGHT: [f64; 9] = [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0];
    let frame = |k: u32| {
        let time = f64::from(k) / f64::from(FRAMES);
        let (sin, cos) = (TAU * time / PERIOD).sin_cos();
        let at = [RADIUS * cos, RADIUS * sin, -AHEAD];
        Shown { time, hands: [None, Some((at, UPRIGHT))], buttons: "R,RG,rightGrip 1".to_owned() }
    };
    let frames = (PERIOD * f64::from(FRAMES)) as u32;
    Server::new(serial, (0..frames).map(frame).collect()).with_period(PERIOD)
}

/// A glove with 18 or 22 sensors, in which all fingers close and open.
pub fn glove(sensors: u8) -> Glove {
    Glove::new(
        sensors,
        Box::new(move |time| {
            let closed = 0.5 - 0.5 * (TAU * time / PERIOD).cos();
            vec![(60.0 + 140.0 * closed).round() as u8; usize::from(sensors)]
        }),
    )
}
