//! A robot whose one device is at the end of a simulated serial line, in virtual time, and what is tried with every make of
//! servos: the same motion as in simulation, and seeded faults.

use protocol::Port;
use robohive_hardware::{Services, Setup, TendedClock, registry};
use robot::{Clock, Config, Options, Robot, RobotError};
use std::io;
use std::sync::{Arc, Mutex};
use wire::{Bench, LinkId, Rates, Shared, VirtualClock, VirtualPort};

pub struct Rig {
    pub model: physics::Model,
    pub bench: Shared,
    pub link: LinkId,
    pub services: Services,
    /// Armed.
    pub setup: Setup,
    /// What the driver had to say to a person.
    pub said: Arc<Mutex<Vec<String>>>,
}

impl Rig {
    pub fn new(model: physics::Model, bench: Bench, link: LinkId) -> Rig {
        let bench: Shared = Arc::new(Mutex::new(bench));
        let (services, said) = (Services::default(), Arc::new(Mutex::new(Vec::new())));
        let (clocked, opened, heard) = (bench.clone(), bench.clone(), said.clone());
        let open = move |_: &str, _: u32| -> io::Result<Box<dyn Port>> {
            opened.lock().unwrap().set_connected(link, true);
            Ok(Box::new(VirtualPort::new(opened.clone(), link)))
        };
        let clocks = Arc::new(move || Box::new(VirtualClock::new(clocked.clone())) as _);
        let mut setup =
            Setup::default().in_virtual_time(clocks, services.clone(), Arc::new(open)).with_armed(true);
        setup.say = Arc::new(move |line| heard.lock().unwrap().push(line.to_owned()));
        Rig { model, bench, link, services, setup, said }
    }

    pub fn robot(&self, config: &Config) -> Result<Robot, RobotError> {
        let options = Options::default().with_hardware(true).with_normalized(false);
        Robot::with_devices(&self.model, Some(config), options, &registry(&self.setup))
    }

    pub fn clock(&self) -> TendedClock<VirtualClock> {
        TendedClock::new(VirtualClock::new(self.bench.clone()), self.services.clone())
    }

    /// Where the first two motors stand.
    pub fn positions(&self) -> [f64; 2] {
        let bench = self.bench.lock().unwrap();
        [bench.plant().position(0), bench.plant().position(1)]
    }

    /// Lets a policy act on the robot and on its simulation. Returns the largest differences: of positions \[rad\], and of the
    /// third sensor, a velocity of the second joint, from the simulated velocity \[rad/s\].
    pub fn differences(&self, config: &Config, action: fn(u32) -> [f64; 2]) -> [f64; 2] {
        let (model, mut rng) = (&self.model, random::Generator::pcg64(1_u64));
        let options = Options::default().with_normalized(false);
        let mut simulated = Robot::new(model, Some(config), options).unwrap();
        let mut truth = physics::Data::new(model);
        physics::forward(model, &mut truth).unwrap();
        simulated.reset(model, &truth, &mut rng).unwrap();
        let mut hardware = self.robot(config).unwrap();
        let mut mirror = truth.clone();
        hardware.reset(model, &mirror, &mut rng).unwrap();
        self.bench.lock().unwrap().plant_mut().place(&[0.0; 2], &[0.0; 2]).unwrap();
        hardware.sense(model, &mirror, &mut rng);
        hardware.write_readings(&mut mirror);
        let mut clock = self.clock();
        let mut worst = [0.0_f64; 2];
        for k in 0..100 {
            let controls = simulated.control(model, &truth, &action(k), 0.1).unwrap();
            truth.state.ctrl.copy_from_slice(controls);
            (0..50).try_for_each(|_| physics::step(model, &mut truth)).unwrap();
            physics::forward(model, &mut truth).unwrap();
            simulated.sense(model, &truth, &mut rng);
            hardware.control(model, &mirror, &action(k), 0.1).unwrap();
            clock.wait(0.1);
            let speed = hardware.sense(model, &mirror, &mut rng).values[2];
            hardware.write_readings(&mut mirror);
            let [first, second] = self.positions();
            let qpos = &truth.state.qpos;
            let away =
                [(qpos[0] - first).abs().max((qpos[1] - second).abs()), (speed - truth.state.qvel[1]).abs()];
            assert!(first.is_finite() && second.is_finite() && speed.is_finite());
            worst = std::array::from_fn(|which| worst[which].max(away[which]));
        }
        hardware.close().unwrap();
        assert!(self.said.lock().unwrap().is_empty(), "all went well");
        assert!(truth.state.qpos[0].abs() > 0.05, "it moved");
        worst
    }
}

/// Lets a policy act on robots whose line has seeded faults, until a thousand have struck: each ends in an error or in motion
/// within limits, and the robot comes to rest.
pub fn strike(make: impl Fn() -> Rig, config: &Config, action: fn(u32) -> [f64; 2]) {
    let rates: Rates =
        "drop=0.01,delay=0.01,reorder=0.01,duplicate=0.01,corrupt=0.02,truncate=0.01,stall=0.0005,disconnect=0.0005"
            .parse()
            .unwrap();
    let (mut struck, mut episodes, mut errors, mut seed) = (0, 0, 0, 0);
    while struck < 1000 {
        seed += 1;
        let rig = make();
        let (model, mut rng) = (&rig.model, random::Generator::pcg64(seed));
        let data = physics::Data::new(model);
        let mut robot = rig.robot(config).unwrap();
        rig.bench.lock().unwrap().inject(rig.link, rates, seed);
        let mut clock = rig.clock();
        for _ in 0..3 {
            episodes += 1;
            if robot.reset(model, &data, &mut rng).is_err() {
                errors += 1;
                continue;
            }
            for k in 0..20 {
                if robot.control(model, &data, &action(k), 0.1).is_err() {
                    errors += 1;
                    break;
                }
                clock.wait(0.1);
                robot.sense(model, &data, &mut rng);
                let positions = rig.positions();
                assert!(positions.iter().all(|position| position.abs() < 1.3), "seed {seed}: {positions:?}");
            }
        }
        struck += rig.bench.lock().unwrap().struck(rig.link);
        rig.bench.lock().unwrap().inject(rig.link, Rates::default(), 0);
        // A link that was struck may fail once more.
        robot.close().unwrap_or_default();
        // Whatever happened, the arm comes to rest: held, or hanging where it never got torque.
        VirtualClock::new(rig.bench.clone()).wait(10.0);
        let before = rig.positions();
        VirtualClock::new(rig.bench.clone()).wait(0.5);
        let after = rig.positions();
        let moved = before.iter().zip(after).any(|(before, after)| (before - after).abs() >= 0.01);
        assert!(!moved, "seed {seed}: {before:?} {after:?}");
    }
    assert!(errors > 0 && errors < episodes, "{errors} of {episodes}");
}
