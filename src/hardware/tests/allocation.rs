//! A control loop through the driver of servos allocates nothing, with the flight recorder running.

use protocol::Port;
use protocol::dynamixel::{MODELS, instruction};
use robohive_hardware::{Services, Setup, device};
use robot::Config;
use stats_alloc::{INSTRUMENTED_SYSTEM, Region, StatsAlloc};
use std::alloc::System;
use std::io;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex};
use wire::dynamixel::{Bus, Servo};
use wire::{Bench, Carries, Plant, VirtualClock, VirtualPort};

#[global_allocator]
static HEAP: &StatsAlloc<System> = &INSTRUMENTED_SYSTEM;

/// A port that repeats the last answer to a fast sync read, so that nothing but the driver runs while allocations are counted.
struct Repeating {
    port: VirtualPort,
    repeats: Arc<AtomicBool>,
    kept: Vec<u8>,
    given: usize,
    sync_read: bool,
}

impl Port for Repeating {
    fn send(&mut self, bytes: &[u8]) -> io::Result<()> {
        self.sync_read = bytes[7] == instruction::FAST_SYNC_READ;
        if self.repeats.load(Ordering::Relaxed) {
            self.given = if self.sync_read { 0 } else { self.kept.len() };
            return Ok(());
        }
        if self.sync_read {
            self.kept.clear();
        }
        self.port.send(bytes)
    }

    fn receive(&mut self, buffer: &mut [u8], timeout: f64) -> io::Result<usize> {
        if self.repeats.load(Ordering::Relaxed) {
            let count = buffer.len().min(self.kept.len() - self.given);
            buffer[..count].copy_from_slice(&self.kept[self.given..self.given + count]);
            self.given += count;
            return Ok(count);
        }
        let count = self.port.receive(buffer, timeout)?;
        if self.sync_read {
            self.kept.extend_from_slice(&buffer[..count]);
        }
        Ok(count)
    }

    fn discard(&mut self) -> io::Result<()> {
        self.port.discard()
    }

    fn now(&self) -> f64 {
        self.port.now()
    }

    fn wait(&mut self, seconds: f64) {
        self.port.wait(seconds);
    }
}

#[test]
fn reading_and_commanding_servos_allocates_nothing() {
    let model = robohive_mjcf::load_str(
        "<mujoco><worldbody><body><joint name='a'/><geom size='.1'/></body><body pos='1 0 0'><joint name='b'/><geom size='.1'/></body>
         </worldbody><actuator><position name='a' joint='a' kp='9' kv='1'/><position name='b' joint='b' kp='9' kv='1'/></actuator></mujoco>",
    );
    let plant = Plant::new(model.unwrap().model).unwrap();
    let servo = |id, name: &str| {
        let mut servo = Servo::new(&MODELS[0], id);
        servo.mount(plant.motor(name).unwrap(), 1.0, std::f64::consts::PI);
        servo
    };
    let servos = vec![servo(1, "a"), servo(2, "b")];
    let mut bench = Bench::new(plant);
    let link = bench.connect(Box::new(Bus::new(servos)), Carries::AT_ONCE);
    let bench = Arc::new(Mutex::new(bench));
    let seen = bench.clone();
    let repeats = Arc::new(AtomicBool::new(false));
    let (clocked, opened, asked) = (bench.clone(), bench, repeats.clone());
    let open = move |_: &str, _: u32| -> io::Result<Box<dyn Port>> {
        let port = VirtualPort::new(opened.clone(), link);
        let kept = Vec::new();
        Ok(Box::new(Repeating { port, repeats: asked.clone(), kept, given: 0, sync_read: false }))
    };
    let clocks = Arc::new(move || Box::new(VirtualClock::new(clocked.clone())) as _);
    let folder = std::env::temp_dir().join(format!("robohive-allocation-{}", std::process::id()));
    let setup = Setup::default()
        .in_virtual_time(clocks, Services::default(), Arc::new(open))
        .with_armed(true)
        .with_records(Some(folder.clone()));
    let config = "[[device]]
        name = 'pair'
        interface = { type = 'dynamixel', name = 'bus', reset_time = 0.1 }
        sensor = [{ name = 'a', range = [-9, 9], hdr_id = 1 }, { name = 'b', range = [-9, 9], hdr_id = 2 }]
        actuator = [{ name = 'a', pos_range = [0, 6], vel_range = [-9, 9], hdr_id = 1 },
                    { name = 'b', pos_range = [0, 6], vel_range = [-9, 9], hdr_id = 2 }]";
    let config = Config::from_toml(config, "pair.toml").unwrap();
    let mut pair = device(&config.devices[0], &setup).unwrap();
    pair.connect().unwrap();
    pair.reset(&[3.0, 3.2]).unwrap();
    let mut values = [0.0; 2];
    let time = pair.read(&mut values).unwrap();
    pair.apply(time, &[3.0, 3.2]).unwrap();
    repeats.store(true, Ordering::Relaxed);
    // The thread of the test's harness may allocate meanwhile, but not in three rounds.
    let rounds: Vec<_> = (0..3)
        .map(|_| {
            let region = Region::new(HEAP);
            for k in 0..1000 {
                let time = pair.read(&mut values).unwrap();
                pair.apply(time, &[3.0 + 1e-4 * f64::from(k), 3.2]).unwrap();
            }
            let change = region.change();
            [change.allocations, change.reallocations, change.deallocations]
        })
        .collect();
    repeats.store(false, Ordering::Relaxed);
    // The readings are those of the servos where they stood: the answers are decoded, not skipped.
    for (motor, value) in values.iter().enumerate() {
        let angle = seen.lock().unwrap().plant().position(motor) + std::f64::consts::PI;
        assert!((value - angle).abs() < protocol::dynamixel::Model::POSITION_UNIT, "{value} {angle}");
    }
    assert!(rounds.contains(&[0; 3]), "{rounds:?}");
    pair.close().unwrap();
    std::fs::remove_dir_all(folder).unwrap();
}
