//! A driver of one's own: a turntable that understands lines of text. `cargo run -p robohive-hardware --example own_driver`

use physics::Data;
use protocol::Port;
use random::Generator;
use robohive_hardware::{
    Driver, Guarded, Limits, Opener, Parameters, Services, Setup, TendedClock, Timeouts,
};
use robot::{Clock, Config, DeviceConfig, Fault, Options, Registry, Robot};
use std::error::Error;
use std::io;
use std::sync::{Arc, Mutex, PoisonError};

// ANCHOR: driver
/// A turntable: `go 1.5` turns it to an angle [rad], `on` and `off` switch its motor, `?` is answered with where it is.
struct Turntable {
    path: String,
    opener: Opener,
    port: Option<Box<dyn Port>>,
}

impl Turntable {
    fn new(config: &DeviceConfig, opener: Opener) -> Result<Turntable, Fault> {
        let mut parameters = Parameters::new(config);
        let path = parameters.text("name")?.ok_or_else(|| Fault::Refused("its port has no 'name'".into()))?;
        parameters.finish()?;
        Ok(Turntable { path, opener, port: None })
    }

    fn say(&mut self, line: &str) -> Result<(), Fault> {
        let port = self.port.as_mut().ok_or(Fault::NotConnected)?;
        port.send(line.as_bytes()).map_err(|error| Fault::Unreachable(error.to_string()))
    }

    fn angle(&mut self) -> Result<f64, Fault> {
        self.say("?\n")?;
        let port = self.port.as_mut().ok_or(Fault::NotConnected)?;
        let mut line = [0; 32];
        let count = port.receive(&mut line, 0.02).map_err(|error| Fault::Unreachable(error.to_string()))?;
        let text = std::str::from_utf8(&line[..count]).unwrap_or_default();
        // No answer, or half of one; the watchdog decides when that has lasted for too long.
        text.trim().parse().map_err(|_| Fault::Stale(20))
    }
}

impl Driver for Turntable {
    fn connect(&mut self) -> Result<(), Fault> {
        let opened = (self.opener)(&self.path, 115_200);
        self.port = Some(opened.map_err(|error| Fault::Unreachable(error.to_string()))?);
        self.angle().map(drop)
    }

    fn read(&mut self, values: &mut [f64]) -> Result<(), Fault> {
        values[0] = self.angle()?;
        Ok(())
    }

    fn present(&mut self, commands: &mut [f64]) -> Result<(), Fault> {
        self.read(commands)
    }

    fn arm(&mut self, present: &[f64]) -> Result<(), Fault> {
        // The goal first: with torque it would leap to an old one.
        self.command(present)?;
        self.say("on\n")
    }

    fn command(&mut self, commands: &[f64]) -> Result<(), Fault> {
        self.say(&format!("go {}\n", commands[0]))
    }

    fn make_safe(&mut self) -> Result<bool, Fault> {
        self.say("off\n").map(|()| true)
    }

    fn disconnect(&mut self) {
        self.port = None;
    }

    fn limits(&self) -> Vec<Limits> {
        vec![Limits { rate: 2.0, ..Limits::of_value([-3.0, 3.0]) }]
    }

    fn timeouts(&self) -> Timeouts {
        Timeouts { command: 0.25, reading: 0.1, heartbeat: 0.03 }
    }

    fn resource(&self) -> String {
        self.path.clone()
    }
}
// ANCHOR_END: driver

// ANCHOR: registry
/// What robots find the driver in, with what makes it safe around it.
fn registry(setup: &Setup) -> Registry {
    let mut registry = robohive_hardware::registry(setup);
    let setup = setup.clone();
    registry.register("turntable", move |config| {
        let driver = Box::new(Turntable::new(config, setup.serial.clone())?);
        let (sensors, actuators) = (config.sensors.len(), config.actuators.len());
        Ok(Box::new(Guarded::new(&config.name, driver, sensors, actuators, &setup)))
    });
    registry
}
// ANCHOR_END: registry

/// The device, so that the example runs without one: it turns at 3 rad/s while its motor is on.
#[derive(Default)]
struct Simulated {
    time: f64,
    angle: f64,
    goal: f64,
    on: bool,
    answer: Vec<u8>,
}

/// Its port, and its time.
#[derive(Clone, Default)]
struct Bench(Arc<Mutex<Simulated>>);

impl Bench {
    fn with<T>(&self, act: impl FnOnce(&mut Simulated) -> T) -> T {
        act(&mut self.0.lock().unwrap_or_else(PoisonError::into_inner))
    }

    fn pass(&self, seconds: f64) {
        self.with(|table| {
            table.time += seconds;
            if table.on {
                let most = 3.0 * seconds;
                table.angle += (table.goal - table.angle).clamp(-most, most);
            }
        });
    }
}

impl Port for Bench {
    fn send(&mut self, bytes: &[u8]) -> io::Result<()> {
        let line = String::from_utf8_lossy(bytes);
        self.with(|table| match line.trim().split_once(' ') {
            Some(("go", angle)) => table.goal = angle.parse().unwrap_or(table.goal),
            _ if line == "?\n" => table.answer = format!("{:.6}\n", table.angle).into_bytes(),
            _ => table.on = line == "on\n",
        });
        Ok(())
    }

    fn receive(&mut self, buffer: &mut [u8], _: f64) -> io::Result<usize> {
        self.pass(1e-3);
        let answer = self.with(|table| std::mem::take(&mut table.answer));
        buffer[..answer.len()].copy_from_slice(&answer);
        Ok(answer.len())
    }

    fn discard(&mut self) -> io::Result<()> {
        self.with(|table| table.answer.clear());
        Ok(())
    }

    fn now(&self) -> f64 {
        self.with(|table| table.time)
    }

    fn wait(&mut self, seconds: f64) {
        self.pass(seconds);
    }
}

impl Clock for Bench {
    fn now(&mut self) -> f64 {
        Port::now(self)
    }

    fn wait(&mut self, seconds: f64) {
        self.pass(seconds);
    }
}

const MODEL: &str =
    "<mujoco><worldbody><body><joint name='turn' axis='0 0 1'/><geom size='.1'/></body></worldbody>
  <actuator><position name='motor' joint='turn'/></actuator>
  <sensor><jointpos name='angle' joint='turn'/></sensor></mujoco>";

const CONFIG: &str = "[[device]]
name = 'table'
interface = { type = 'turntable', name = '/dev/ttyUSB0' }
sensor = [{ name = 'angle', range = [-3, 3] }]
actuator = [{ name = 'motor', pos_range = [-3, 3], vel_range = [-9, 9] }]";

/// Turns the table to 1 rad, lets it alone, and sees that it was made safe.
pub fn main() -> Result<(), Box<dyn Error>> {
    let (bench, services) = (Bench::default(), Services::default());
    let (clocked, opened) = (bench.clone(), bench.clone());
    let setup = Setup::default()
        .in_virtual_time(
            Arc::new(move || Box::new(clocked.clone())),
            services.clone(),
            Arc::new(move |_, _| Ok(Box::new(opened.clone()))),
        )
        .with_armed(true);
    let model = robohive_mjcf::load_str(MODEL)?.model;
    let config = Config::from_toml(CONFIG, "table.toml")?;
    let options = Options::default().with_hardware(true).with_normalized(false);
    let mut robot = Robot::with_devices(&model, Some(&config), options, &registry(&setup))?;
    let (mut data, mut rng) = (Data::new(&model), Generator::pcg64(0_u64));
    let mut clock = TendedClock::new(bench.clone(), services);
    robot.reset(&model, &data, &mut rng)?;
    for _ in 0..20 {
        robot.control(&model, &data, &[1.0], 0.05)?;
        clock.wait(0.05);
        robot.sense(&model, &data, &mut rng);
        robot.write_readings(&mut data);
    }
    println!("the table stands at {:.2} rad, its motor {}", data.state.qpos[0], bench.with(|table| table.on));
    if (data.state.qpos[0] - 1.0).abs() > 0.01 {
        return Err("it did not arrive".into());
    }
    clock.wait(0.5);
    match robot.control(&model, &data, &[1.0], 0.05) {
        Err(fault) if !bench.with(|table| table.on) => println!("left alone, it is without torque: {fault}"),
        _ => return Err("its watchdog slept".into()),
    }
    Ok(())
}
