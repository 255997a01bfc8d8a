//! Seeded faults of the links of the arm and of its hand.

use super::rig::{Rig, START, config};
use protocol::franka::Version;
use robot::{Clock, RobotError};
use wire::{Rates, VirtualClock};

#[test]
fn seeded_faults_end_in_errors_or_in_motion_within_limits() {
    // The network carries thousands of datagrams a second, so that rare faults strike often.
    let rates: Rates =
        "drop=0.01,delay=0.002,reorder=0.002,duplicate=0.01,corrupt=0.0005,truncate=0.001,stall=0.00005,\
                        disconnect=0.0001,stop=0.00005"
            .parse()
            .unwrap();
    let rare: Rates = "drop=0.02,delay=0.05,corrupt=0.02,truncate=0.02,disconnect=0.02".parse().unwrap();
    let (mut struck, mut episodes, mut errors, mut seed) = (0, 0, 0, 0);
    while struck < 1000 {
        seed += 1;
        let version = if seed % 2 == 0 { Version::V5 } else { Version::V10 };
        let rig = Rig::new(version, |arm| arm);
        let control = if seed % 3 == 0 { "impedance" } else { "position" };
        let mut robot = rig.robot(&config(&format!("control = '{control}'"))).unwrap();
        rig.bench.lock().unwrap().inject(rig.arm[0], rare, seed);
        rig.bench.lock().unwrap().inject(rig.arm[1], rates, seed + 1000);
        for link in rig.hand {
            rig.bench.lock().unwrap().inject(link, rare, seed + 2000);
        }
        let mut rng = random::Generator::pcg64(seed);
        let (data, mut clock) = (rig.data(), rig.clock());
        for _ in 0..3 {
            episodes += 1;
            let outcome = robot.reset(&rig.model, &data, &mut rng).map(drop).and_then(|()| {
                for k in 0..20 {
                    let mut action = START[..8].to_vec();
                    action.iter_mut().take(7).for_each(|place| *place += 0.3 * (0.3 * f64::from(k)).sin());
                    robot.control(&rig.model, &data, &action, 0.04)?;
                    clock.wait(0.04);
                    robot.sense(&rig.model, &data, &mut rng);
                }
                Ok(())
            });
            if let Err(error) = outcome {
                errors += 1;
                assert!(
                    matches!(error, RobotError::Device { .. }) && error.to_string().contains("franka"),
                    "{error}"
                );
                rig.bench.lock().unwrap().stop_button(false);
            }
        }
        let hits = |link| rig.bench.lock().unwrap().struck(link);
        struck += rig.arm.into_iter().chain(rig.hand).map(hits).sum::<u64>();
        // Whatever happened, 20 cycles and the way that braking takes later the arm stands still, and nothing that was
        // commanded was beyond its limits.
        robot.close().unwrap_or_default();
        VirtualClock::new(rig.bench.clone()).wait(0.5);
        let held = rig.commanded();
        VirtualClock::new(rig.bench.clone()).wait(0.2);
        assert_eq!(held, rig.commanded(), "seed {seed}");
        rig.check_commands();
        // Without faults a reset brings it back.
        for link in rig.arm.into_iter().chain(rig.hand) {
            rig.bench.lock().unwrap().inject(link, Rates::default(), 0);
        }
        rig.bench.lock().unwrap().stop_button(false);
        let mut robot = rig.robot(&config(&format!("control = '{control}'"))).unwrap();
        robot.reset(&rig.model, &data, &mut rng).unwrap_or_else(|error| panic!("seed {seed}: {error}"));
        robot.close().unwrap();
    }
    println!("{struck} faults in {episodes} episodes, {errors} errors, {seed} seeds");
    assert!(errors > 0 && errors < episodes, "{errors} of {episodes}");
}
