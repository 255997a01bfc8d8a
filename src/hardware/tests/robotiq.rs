//! A robot over a simulated Robotiq gripper, on both of its lines.

use protocol::Port;
use robohive_hardware::{Services, Setup, Sockets, TendedClock, registry};
use robot::{Clock, Config, Options, Robot, RobotError};
use std::io;
use std::sync::{Arc, Mutex};
use wire::robotiq::{Gateway, Gripper};
use wire::{Bench, Carries, LinkId, Plant, Rates, Shared, VirtualClock, VirtualPort};

/// A finger that slides 0.0425 m from closed to open; a post may stand in its way.
fn model(post: bool) -> physics::Model {
    let post = if post { "<geom type='box' pos='0 0 0' size='.01 .05 .05'/>" } else { "" };
    let text = format!(
        "<mujoco><option gravity='0 0 0' timestep='.002' integrator='implicitfast'/><worldbody>{post}
           <body><joint name='finger' type='slide' axis='1 0 0' range='0 .0425' limited='true' armature='.1' damping='1'/>
             <geom type='box' size='.005 .02 .02' mass='.05' contype='1'/></body></worldbody>
         <actuator><position name='finger' joint='finger' kp='2000' kv='20' forcerange='-50 50'/></actuator>
         <sensor><jointpos name='width' joint='finger'/></sensor></mujoco>"
    );
    robohive_mjcf::load_str(&text).expect("a sound model").model
}

fn config(extra: &str) -> Config {
    let text = format!(
        "[[device]]
         name = 'gripper'
         interface = {{ type = 'robotiq', reset_time = 1, {extra} }}
         sensor = [{{ name = 'width', range = [-1, 1], hdr_id = 0, scale = 0.5, offset = 0 }}]
         actuator = [{{ name = 'finger', pos_range = [0, 0.0425], vel_range = [-5, 5], hdr_id = 0, scale = 2, offset = 0 }}]"
    );
    Config::from_toml(&text, "gripper.toml").expect("a sound config")
}

struct Wires(Shared, LinkId);

impl Sockets for Wires {
    fn connect(&self, _host: &str, port: u16) -> io::Result<Box<dyn Port>> {
        assert_eq!(port, 63352);
        self.0.lock().unwrap().set_connected(self.1, true);
        Ok(Box::new(VirtualPort::new(self.0.clone(), self.1)))
    }

    fn listen(&self, _: &str, _: u16, _: Option<std::net::Ipv4Addr>) -> io::Result<Box<dyn Port>> {
        Err(io::ErrorKind::Unsupported.into())
    }

    fn datagrams(&self, _host: &str, _server: u16) -> io::Result<(Box<dyn Port>, u16)> {
        Err(io::ErrorKind::Unsupported.into())
    }
}

struct Rig {
    model: physics::Model,
    bench: Shared,
    link: LinkId,
    services: Services,
    setup: Setup,
}

impl Rig {
    fn new(gateway: bool, post: bool) -> Rig {
        let model = model(post);
        let mut plant = Plant::new(model.clone()).unwrap();
        plant.place(&[0.03], &[0.0]).unwrap();
        let (bench, link) = if gateway {
            let gripper = Gripper::new(&plant, "finger", [0.0, 0.0425]).unwrap();
            let mut bench = Bench::new(plant);
            let link = bench.connect(Box::new(Gateway::new(gripper)), Carries::AT_ONCE);
            (bench, link)
        } else {
            // As the command makes it of a config.
            let (bench, rigged) = wire::rig(&config("name = '/dev/ttyUSB0'"), plant, false).unwrap();
            assert_eq!((rigged[0].kind.as_str(), rigged[0].address.as_str()), ("robotiq", "/dev/ttyUSB0"));
            (bench, rigged[0].links[0].1)
        };
        let bench: Shared = Arc::new(Mutex::new(bench));
        let (services, clocked, opened) = (Services::default(), bench.clone(), bench.clone());
        let open = move |_: &str, baud: u32| -> io::Result<Box<dyn Port>> {
            assert_eq!(baud, 115_200);
            opened.lock().unwrap().set_connected(link, true);
            Ok(Box::new(VirtualPort::new(opened.clone(), link)))
        };
        let clocks = Arc::new(move || Box::new(VirtualClock::new(clocked.clone())) as _);
        let setup = Setup::default()
            .in_virtual_time(clocks, services.clone(), Arc::new(open))
            .with_sockets(Arc::new(Wires(bench.clone(), link)))
            .with_armed(true);
        Rig { model, bench, link, services, setup }
    }

    fn robot(&self, config: &Config) -> Result<Robot, RobotError> {
        let options = Options::default().with_hardware(true).with_normalized(false);
        Robot::with_devices(&self.model, Some(config), options, &registry(&self.setup))
    }

    fn finger(&self) -> f64 {
        self.bench.lock().unwrap().plant().position(0)
    }

    fn data(&self) -> physics::Data {
        let mut data = physics::Data::new(&self.model);
        data.state.qpos[0] = 0.03;
        data.state.ctrl[0] = 0.03;
        physics::forward(&self.model, &mut data).unwrap();
        data
    }

    /// Commands a position for some seconds; returns what is read in the end.
    fn hold(&self, robot: &mut Robot, finger: f64, seconds: f64) -> Result<f64, RobotError> {
        let mut clock = TendedClock::new(VirtualClock::new(self.bench.clone()), self.services.clone());
        let (data, mut rng) = (self.data(), random::Generator::pcg64(1_u64));
        let end = clock.now() + seconds;
        let mut read = f64::NAN;
        while clock.now() < end {
            robot.control(&self.model, &data, &[finger], 1.0)?;
            clock.wait(0.04);
            read = robot.sense(&self.model, &data, &mut rng).values[0];
        }
        Ok(read)
    }
}

const PARAMETERS: [(bool, &str); 2] = [(false, "name = '/dev/ttyUSB0'"), (true, "ip_address = '10.0.0.2'")];

#[test]
fn it_is_activated_and_moves_to_a_width_on_both_lines() {
    for (gateway, parameters) in PARAMETERS {
        let rig = Rig::new(gateway, false);
        let mut robot = rig.robot(&config(parameters)).unwrap();
        let mut rng = random::Generator::pcg64(1_u64);
        robot.reset(&rig.model, &rig.data(), &mut rng).unwrap();
        for finger in [0.01, 0.04, 0.0] {
            let read = rig.hold(&mut robot, finger, 1.5).unwrap();
            // A unit of position is 0.37 mm of width, half of that of a finger.
            assert!((rig.finger() - finger).abs() < 0.3e-3, "{finger}: {}", rig.finger());
            assert!((read - finger).abs() < 0.3e-3, "{finger}: {read}");
        }
        robot.close().unwrap();
    }
}

#[test]
fn fingers_stop_at_an_object_and_hold_it_through_silence() {
    let rig = Rig::new(false, true);
    let mut robot = rig.robot(&config("name = '/dev/ttyUSB0'")).unwrap();
    let mut rng = random::Generator::pcg64(1_u64);
    robot.reset(&rig.model, &rig.data(), &mut rng).unwrap();
    rig.hold(&mut robot, 0.0, 2.0).unwrap();
    // The post's face is at 10 mm, the finger's 5 mm before its middle; contacts give way a little.
    let held = rig.finger();
    assert!((held - 0.015).abs() < 1e-3, "{held}");
    // The policy hangs: the fingers stay on what they hold.
    let mut clock = TendedClock::new(VirtualClock::new(rig.bench.clone()), rig.services.clone());
    clock.wait(2.0);
    assert!((rig.finger() - held).abs() < 0.1e-3, "{held} {}", rig.finger());
    let error = rig.hold(&mut robot, 0.01, 0.1).unwrap_err().to_string();
    assert!(error.contains("gripper") && error.contains("no command came for 0.25 s"), "{error}");
    robot.reset(&rig.model, &rig.data(), &mut rng).unwrap();
    rig.hold(&mut robot, 0.02, 1.5).unwrap();
    assert!((rig.finger() - 0.02).abs() < 0.3e-3);
    robot.close().unwrap();
}

#[test]
fn a_cut_of_its_supply_is_named_and_a_reset_activates_it_again() {
    let rig = Rig::new(false, false);
    let mut robot = rig.robot(&config("name = '/dev/ttyUSB0'")).unwrap();
    let mut rng = random::Generator::pcg64(1_u64);
    robot.reset(&rig.model, &rig.data(), &mut rng).unwrap();
    rig.hold(&mut robot, 0.02, 0.5).unwrap();
    rig.bench.lock().unwrap().stop_button(true);
    let error = rig.hold(&mut robot, 0.01, 1.0).unwrap_err().to_string();
    assert!(error.contains("ms old"), "{error}");
    let error = robot.reset(&rig.model, &rig.data(), &mut rng).unwrap_err().to_string();
    assert!(error.contains("no gripper answers at address 9 and 115200 baud on /dev/ttyUSB0"), "{error}");
    rig.bench.lock().unwrap().stop_button(false);
    robot.reset(&rig.model, &rig.data(), &mut rng).unwrap();
    rig.hold(&mut robot, 0.04, 1.5).unwrap();
    assert!((rig.finger() - 0.04).abs() < 0.3e-3);
    robot.close().unwrap();
}

#[test]
fn what_a_config_says_wrongly_is_named() {
    let rig = Rig::new(false, false);
    for (parameters, part) in [
        ("speed = 0.1", "either a 'name', the path of a serial port"),
        (
            "name = 'a', sped = 1",
            "'sped' of its interface is not known; there are name, ip_address, baud, slave",
        ),
        ("name = 'a', force = 500", "'force' of its interface is 500; it must be from 20 to 235"),
        ("name = 'a', slave = 8", "no gripper answers at address 8"),
    ] {
        let error = rig.robot(&config(parameters)).err().expect(parameters).to_string();
        assert!(error.contains(part), "{error}");
    }
}

#[test]
fn seeded_faults_of_the_line_end_in_errors_or_in_widths_within_the_stroke() {
    let rates: Rates =
        "drop=0.02,delay=0.01,reorder=0.01,duplicate=0.02,corrupt=0.03,truncate=0.02,stall=0.001,disconnect=0.001"
            .parse()
            .unwrap();
    let (mut struck, mut episodes, mut errors, mut seed) = (0, 0, 0, 0_u64);
    while struck < 500 {
        seed += 1;
        let (gateway, parameters) = PARAMETERS[usize::from(seed.is_multiple_of(2))];
        let rig = Rig::new(gateway, false);
        let mut robot = rig.robot(&config(parameters)).unwrap();
        rig.bench.lock().unwrap().inject(rig.link, rates, seed);
        let mut rng = random::Generator::pcg64(seed);
        for _ in 0..3 {
            episodes += 1;
            let outcome = robot.reset(&rig.model, &rig.data(), &mut rng).map(drop);
            let outcome = outcome.and_then(|()| {
                (0..20)
                    .try_for_each(|k| rig.hold(&mut robot, 0.02 + 0.015 * f64::from(k).sin(), 0.08).map(drop))
            });
            if let Err(error) = outcome {
                errors += 1;
                assert!(
                    matches!(error, RobotError::Device { .. }) && error.to_string().contains("gripper"),
                    "{error}"
                );
            }
            assert!((-1e-3..0.0435).contains(&rig.finger()), "{}", rig.finger());
        }
        struck += rig.bench.lock().unwrap().struck(rig.link);
        rig.bench.lock().unwrap().inject(rig.link, Rates::default(), 0);
        robot.reset(&rig.model, &rig.data(), &mut rng).unwrap_or_else(|error| panic!("seed {seed}: {error}"));
        robot.close().unwrap();
    }
    assert!(errors > 0 && errors < episodes, "{errors} of {episodes}");
}
