//! A simulated headset and a simulated glove that repeat a motion.

use std::f64::consts::TAU;
use wire::adb::{Server, Shown};
use wire::cyberglove::Glove;

/// Period of the motion \[s\].
const PERIOD: f64 = 4.0;
/// Frames a second of the headset.
const FRAMES: u32 = 72;
/// Radius of the controller's circle, and its distance in front of the head \[m\].
const RADIUS: f64 = 0.1;
const AHEAD: f64 = 0.4;

/// A headset whose right controller is gripped and moves on a circle in the plane of the face, x right and y up.
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
