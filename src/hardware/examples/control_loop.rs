//! How regularly a control loop runs through the driver of Dynamixel servos, beside a loop that only sleeps.
//!
//! `cargo run --release -p robohive-hardware --example control_loop -- [SECONDS]`, ten seconds a row without it. The servos are
//! simulated in a process of their own, behind a pseudo-terminal whose answers take as long as on a bus of 4 Mbit/s. Each row
//! runs both loops in turns of a second.

use std::error::Error;

#[cfg(unix)]
fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<_> = std::env::args().skip(1).collect();
    match arguments.first().map(String::as_str) {
        Some("serve") => serving::serve(arguments.get(1).map_or(Ok(6), |servos| servos.parse())?),
        seconds => measuring::measure(seconds.map_or(Ok(10.0), str::parse)?),
    }
}

#[cfg(not(unix))]
fn main() -> Result<(), Box<dyn Error>> {
    Err("pseudo-terminals need Unix".into())
}

/// Bits a second of the bus.
#[cfg(unix)]
const BAUD: f64 = 4e6;

/// The servos.
#[cfg(unix)]
mod serving {
    use super::BAUD;
    use protocol::dynamixel::MODELS;
    use std::error::Error;
    use std::io::Read;
    use std::sync::atomic::{AtomicBool, Ordering};
    use std::sync::{Arc, Mutex};
    use wire::dynamixel::{Bus, Servo};
    use wire::{Bench, Carries, End, Plant, Terminal, serve as serve_links};

    /// Serves flywheels on servos until standard input ends, after it has said where.
    pub fn serve(servos: u8) -> Result<(), Box<dyn Error>> {
        let wheel = |id| {
            format!(
                "<body pos='{id} 0 0'><joint name='{id}' axis='0 1 0' damping='.05' armature='.01'/><geom size='.05' mass='.1'/></body>"
            )
        };
        let motor = |id| format!("<position name='{id}' joint='{id}' kp='10' kv='.5'/>");
        let text = format!(
            "<mujoco><option gravity='0 0 0' timestep='.002'/><worldbody>{}</worldbody><actuator>{}</actuator></mujoco>",
            (1..=servos).map(wheel).collect::<String>(),
            (1..=servos).map(motor).collect::<String>()
        );
        let plant = Plant::new(robohive_mjcf::load_str(&text)?.model)?;
        let mut bus = Vec::new();
        for id in 1..=servos {
            let mut servo = Servo::new(&MODELS[0], id);
            servo.mount(plant.motor(&id.to_string())?, 1.0, std::f64::consts::PI);
            bus.push(servo);
        }
        let mut bench = Bench::new(plant);
        let link = bench.connect(Box::new(Bus::new(bus).with_baud(BAUD)), Carries::serial(BAUD));
        let terminal = Terminal::open()?;
        println!("{}", terminal.path().display());
        let stop = Arc::new(AtomicBool::new(false));
        let ended = stop.clone();
        std::thread::spawn(move || {
            // Whatever ends the input ends the servos.
            std::io::stdin().read_to_end(&mut Vec::new()).unwrap_or_default();
            ended.store(true, Ordering::Relaxed);
        });
        Ok(serve_links(&Arc::new(Mutex::new(bench)), &mut [(link, End::Terminal(terminal))], &stop)?)
    }
}

/// The loops.
#[cfg(unix)]
mod measuring {
    use super::BAUD;
    use protocol::Port;
    use robohive_hardware::{Serial, Setup, device};
    use robot::{Config, Device, Fault};
    use stats_alloc::{INSTRUMENTED_SYSTEM, Region, StatsAlloc};
    use std::alloc::System;
    use std::error::Error;
    use std::io::{self, BufRead, BufReader};
    use std::process::{Child, Command, Stdio};
    use std::sync::Arc;
    use std::sync::atomic::{AtomicU64, Ordering};
    use std::time::{Duration, Instant};

    #[global_allocator]
    static HEAP: &StatsAlloc<System> = &INSTRUMENTED_SYSTEM;

    /// Ends of the histogram's bins \[µs\].
    const BINS: [u32; 7] = [50, 100, 200, 500, 1000, 2000, 5000];
    /// Duration of a turn \[s\].
    const TURN: f64 = 1.0;

    /// A port that knows how long its calls have taken.
    struct Timed {
        port: Serial,
        spent: Arc<AtomicU64>,
    }

    impl Timed {
        fn time<T>(&mut self, call: impl FnOnce(&mut Serial) -> T) -> T {
            let begun = Instant::now();
            let result = call(&mut self.port);
            self.spent.fetch_add(begun.elapsed().as_nanos() as u64, Ordering::Relaxed);
            result
        }
    }

    impl Port for Timed {
        fn send(&mut self, bytes: &[u8]) -> io::Result<()> {
            self.time(|port| port.send(bytes))
        }

        fn receive(&mut self, buffer: &mut [u8], timeout: f64) -> io::Result<usize> {
            self.time(|port| port.receive(buffer, timeout))
        }

        fn discard(&mut self) -> io::Result<()> {
            self.time(Serial::discard)
        }

        fn now(&self) -> f64 {
            self.port.now()
        }

        fn wait(&mut self, seconds: f64) {
            self.port.wait(seconds);
        }
    }

    /// What a loop did.
    struct Record {
        /// How late each tick began \[µs\].
        lateness: Vec<f64>,
        /// Ticks whose time had passed before the one before them ended.
        missed: u64,
        /// Time of each tick beside the port's \[µs\].
        own: Vec<f64>,
        /// Time of each tick \[µs\].
        whole: Vec<f64>,
        /// Turns that a fault of the device ended.
        faults: u64,
        /// In turns without a fault.
        allocations: usize,
    }

    impl Record {
        fn new(ticks: usize) -> Record {
            let room = || Vec::with_capacity(ticks);
            let (lateness, own, whole) = (room(), room(), room());
            Record { lateness, missed: 0, own, whole, faults: 0, allocations: 0 }
        }

        /// Runs a loop for a turn, or until a fault. `work` returns how long it took beside the port.
        fn run(&mut self, period: f64, mut work: impl FnMut() -> Option<Duration>) {
            let region = Region::new(HEAP);
            let (start, ticks) = (Instant::now(), (TURN / period) as u64);
            let mut k = 1;
            while k <= ticks {
                let due = start + Duration::from_secs_f64(k as f64 * period);
                std::thread::sleep(due.saturating_duration_since(Instant::now()));
                let begun = Instant::now();
                self.lateness.push(micros(begun.saturating_duration_since(due)));
                let Some(own) = work() else {
                    // The device is in its safe state; the next turn arms it again.
                    self.faults += 1;
                    return;
                };
                self.own.push(micros(own));
                self.whole.push(micros(begun.elapsed()));
                k += 1;
                while k <= ticks && start.elapsed().as_secs_f64() > (k + 1) as f64 * period {
                    self.missed += 1;
                    k += 1;
                }
            }
            let change = region.change();
            self.allocations += change.allocations + change.reallocations;
        }

        fn histogram(&self) -> String {
            let mut counts = [0; BINS.len() + 1];
            for late in &self.lateness {
                counts[BINS.partition_point(|end| f64::from(*end) <= *late)] += 1;
            }
            counts.map(|count| count.to_string()).join(" | ")
        }
    }

    fn micros(time: Duration) -> f64 {
        time.as_secs_f64() * 1e6
    }

    fn quantile(values: &mut [f64], share: f64) -> f64 {
        values.sort_by(f64::total_cmp);
        values.get(((values.len().max(1) - 1) as f64 * share).round() as usize).copied().unwrap_or(f64::NAN)
    }

    /// Simulated servos in another process.
    struct Servos(Child);

    impl Drop for Servos {
        fn drop(&mut self) {
            // They end with their input.
            drop(self.0.stdin.take());
            self.0.wait().map(drop).unwrap_or_default();
        }
    }

    fn servos(count: u8) -> Result<(Servos, String), Box<dyn Error>> {
        let mut command = Command::new(std::env::current_exe()?);
        command.args(["serve", &count.to_string()]).stdin(Stdio::piped()).stdout(Stdio::piped());
        let mut child = command.spawn()?;
        let mut path = String::new();
        BufReader::new(child.stdout.take().ok_or("no output")?).read_line(&mut path)?;
        Ok((Servos(child), path.trim().to_owned()))
    }

    fn config(count: u8, path: &str) -> Result<Config, Box<dyn Error>> {
        let mut text = format!(
            "[[device]]\nname = 'servos'\n\
             interface = {{ type = 'dynamixel', name = '{path}', baud = {BAUD}, watchdog = 10, reset_time = 0.1 }}\n"
        );
        let ids = || 1..=count;
        let sensor = |id| format!("{{ name = '{id}', range = [-9, 9], hdr_id = {id} }},");
        let actuator =
            |id| format!("{{ name = '{id}', pos_range = [0, 6], vel_range = [-9, 9], hdr_id = {id} }},");
        text += &format!("sensor = [{}]\n", ids().map(sensor).collect::<String>());
        text += &format!("actuator = [{}]\n", ids().map(actuator).collect::<String>());
        Ok(Config::from_toml(&text, "servos.toml")?)
    }

    /// Makes sure that the device follows commands: it may have been made safe since it last did.
    fn arm(device: &mut dyn Device, values: &mut [f64], targets: &[f64]) -> Result<(), Fault> {
        let mut outcome = device.read(values).and_then(|time| device.apply(time, targets));
        for _ in 0..5 {
            if outcome.is_ok() {
                break;
            }
            outcome = device.reset(targets);
        }
        outcome
    }

    /// Runs both loops at this rate for so long.
    fn loops(rate: f64, count: u8, seconds: f64) -> Result<[Record; 2], Box<dyn Error>> {
        let (_servos, path) = servos(count)?;
        let spent = Arc::new(AtomicU64::new(0));
        let counted = spent.clone();
        let mut setup = Setup::default().with_armed(true);
        setup.serial = Arc::new(move |path, baud| {
            Ok(Box::new(Timed { port: Serial::open(path, baud)?, spent: counted.clone() }))
        });
        let mut device: Box<dyn Device> = device(&config(count, &path)?.devices[0], &setup)?;
        device.connect()?;
        let n = usize::from(count);
        let (mut values, mut commands) = (vec![0.0; n], vec![std::f64::consts::PI; n]);
        device.reset(&commands)?;
        let mut bare = Record::new((seconds * rate) as usize + 1);
        let mut driven = Record::new((seconds * rate) as usize + 1);
        let targets = commands.clone();
        for turn in 0..(seconds / TURN).ceil().max(1.0) as u32 {
            bare.run(1.0 / rate, || Some(Duration::ZERO));
            arm(device.as_mut(), &mut values, &targets)?;
            let mut tick = 0_u32;
            driven.run(1.0 / rate, || {
                let (begun, before) = (Instant::now(), spent.load(Ordering::Relaxed));
                tick += 1;
                commands.fill(std::f64::consts::PI + 0.3 * (0.01 * f64::from(tick)).sin());
                let outcome = device.read(&mut values).and_then(|time| device.apply(time, &commands));
                let port = Duration::from_nanos(spent.load(Ordering::Relaxed) - before);
                if let Err(fault) = &outcome {
                    eprintln!("turn {turn}, tick {tick}: {fault}");
                }
                outcome.ok().map(|()| begun.elapsed().saturating_sub(port))
            });
        }
        device.close()?;
        Ok([bare, driven])
    }

    /// Prints the tables.
    pub fn measure(seconds: f64) -> Result<(), Box<dyn Error>> {
        let mut histograms = String::new();
        println!(
            "| loop | ticks | missed | lateness at the median [µs] | at 99 % | a tick at the median [µs] | of that the driver | turns ended by a fault | allocations |"
        );
        println!("|---|---|---|---|---|---|---|---|---|");
        for (rate, count) in [(1000.0, 6), (500.0, 12)] {
            let names =
                [format!("{rate} Hz, sleeping"), format!("{rate} Hz, {count} servos through the driver")];
            for (name, mut record) in names.into_iter().zip(loops(rate, count, seconds)?) {
                histograms += &format!("| {name} | {} |\n", record.histogram());
                let late = [0.5, 0.99].map(|share| quantile(&mut record.lateness, share));
                let (whole, own) = (quantile(&mut record.whole, 0.5), quantile(&mut record.own, 0.5));
                // While it sleeps the watchdog may make the servos safe, which is not what is counted.
                let sleeps = record.own.iter().all(|time| *time == 0.0);
                let heap = if sleeps { "–".to_owned() } else { record.allocations.to_string() };
                println!(
                    "| {name} | {} | {} | {:.0} | {:.0} | {whole:.0} | {own:.1} | {} | {heap} |",
                    record.lateness.len(),
                    record.missed,
                    late[0],
                    late[1],
                    record.faults
                );
            }
        }
        let ends = BINS.map(|end| format!("< {end} µs")).join(" | ");
        println!("\n| lateness | {ends} | more |\n|---|{}", "---|".repeat(BINS.len() + 1));
        print!("{histograms}");
        Ok(())
    }
}
