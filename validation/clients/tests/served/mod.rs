//! Servos on a pseudo-terminal, served in real time.

use std::path::PathBuf;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};
use wire::{Bench, Carries, Device, End, Plant, Shared, Terminal, serve};

/// Three hinges without gravity, each with a motor.
const ARM: &str = "<mujoco><option gravity='0 0 0'/><worldbody>
    <body pos='0 0 0'><joint name='a' damping='.1' armature='.05'/><geom size='.05'/></body>
    <body pos='1 0 0'><joint name='b' damping='.1' armature='.05'/><geom size='.05'/></body>
    <body pos='2 0 0'><joint name='c' damping='.1' armature='.05'/><geom size='.05'/></body></worldbody>
  <actuator><position name='a' joint='a' kp='20' kv='1'/><position name='b' joint='b' kp='20' kv='1'/>
    <position name='c' joint='c' kp='20' kv='1'/></actuator></mujoco>";

/// The arm's motors.
pub const MOTORS: [&str; 3] = ["a", "b", "c"];

/// Servos that are served until this is dropped.
pub struct Served {
    pub path: PathBuf,
    bench: Shared,
    stop: Arc<AtomicBool>,
    thread: Option<JoinHandle<std::io::Result<()>>>,
}

impl Served {
    /// Serves the bus that `make` puts on the arm, at 1 Mbit/s.
    pub fn new(make: impl FnOnce(&Plant) -> Box<dyn Device>) -> Served {
        let plant = Plant::new(mjcf::load_str(ARM).expect("a sound model").model).expect("a sound state");
        let bus = make(&plant);
        let mut bench = Bench::new(plant);
        let link = bench.connect(bus, Carries::serial(1e6));
        let bench = Arc::new(Mutex::new(bench));
        let terminal = Terminal::open().expect("a pseudo-terminal");
        let path = terminal.path().to_owned();
        let stop = Arc::new(AtomicBool::new(false));
        let thread = {
            let (bench, stop) = (bench.clone(), stop.clone());
            std::thread::spawn(move || serve(&bench, &mut [(link, End::Terminal(terminal))], &stop))
        };
        Served { path, bench, stop, thread: Some(thread) }
    }

    /// Waits until the first motors stand where they should, within `tolerance` \[rad\]; tells whether they do.
    pub fn settles(&self, wanted: &[f64], tolerance: f64) -> bool {
        let end = Instant::now() + Duration::from_secs(20);
        while Instant::now() < end {
            let bench = self.bench.lock().unwrap();
            let near = |(k, wanted): (usize, &f64)| (bench.plant().position(k) - wanted).abs() < tolerance;
            if wanted.iter().enumerate().all(near) {
                return true;
            }
            drop(bench);
            std::thread::sleep(Duration::from_millis(10));
        }
        false
    }
}

impl Drop for Served {
    fn drop(&mut self) {
        self.stop.store(true, Ordering::Relaxed);
        if let Some(thread) = self.thread.take() {
            thread.join().expect("no panic").expect("no failure of the system");
        }
    }
}
