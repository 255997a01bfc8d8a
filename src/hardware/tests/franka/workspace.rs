//! The box of the end effector: nothing outside of it reaches the wire.

use super::rig::{Rig, START, config};
use protocol::franka::{Version, flange};
use robot::{Clock, Fault, Robot, RobotError};

/// Where the fingertips are with the joints at `q` \[m\].
fn tip(q: &[f64]) -> [f64; 3] {
    let pose = flange(q[..7].try_into().unwrap());
    std::array::from_fn(|axis| pose[12 + axis] + 0.1034 * pose[8 + axis])
}

/// Lets the arm follow an action until an error, for at most `steps` periods of 40 ms.
fn follow(rig: &Rig, robot: &mut Robot, action: &[f64], steps: u32) -> Result<(), RobotError> {
    let data = rig.data();
    for _ in 0..steps {
        robot.control(&rig.model, &data, action, 10.0)?;
        rig.clock().wait(0.04);
        robot.sense(&rig.model, &data, &mut random::Generator::pcg64(1_u64));
    }
    Ok(())
}

/// The largest and smallest coordinate of all that was sent, along an axis.
fn extremes(rig: &Rig, axis: usize) -> [f64; 2] {
    let sent = rig.sent.lock().unwrap();
    sent.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], setpoint| {
        let place = tip(&setpoint.q)[axis];
        [low.min(place), high.max(place)]
    })
}

fn why(error: RobotError) -> String {
    let RobotError::Device { device, fault: Fault::Refused(why) } = error else { panic!("{error:?}") };
    assert_eq!(device, "franka");
    why
}

#[test]
fn a_command_outside_is_refused_before_the_wire_and_a_reset_goes_on() {
    let lowest = tip(&START)[2] - 0.1;
    for version in [Version::V5, Version::V10] {
        let rig = Rig::new(version, |arm| arm);
        let inside = format!("control = 'position', box = [-1, 1, -1, 1, {lowest}, 1.2]");
        let mut robot = rig.robot(&config(&inside)).unwrap();
        let mut rng = random::Generator::pcg64(1_u64);
        robot.reset(&rig.model, &rig.data(), &mut rng).unwrap();
        let mut action = START[..8].to_vec();
        action[1] = 0.1;
        follow(&rig, &mut robot, &action, 50).unwrap();
        let before = extremes(&rig, 2)[0];
        action[1] = 0.5;
        let said = why(follow(&rig, &mut robot, &action, 50).unwrap_err());
        let [x, _, z] = tip(&action);
        let expected = format!(
            "it was commanded to have its end effector at ({x:.3}, 0.000, {z:.3}) m from its base, and its box is \
             z from {lowest} to 1.2 m"
        );
        assert_eq!(said, expected);
        rig.clock().wait(0.5);
        assert_eq!(extremes(&rig, 2)[0], before, "it did not even begin");
        assert!(rig.sent.lock().unwrap().last().unwrap().finished, "it is at rest");
        robot.reset(&rig.model, &rig.data(), &mut rng).unwrap();
        robot.close().unwrap();
        rig.check_commands();
    }
}

#[test]
fn a_way_that_would_lead_outside_ends_inside() {
    // Swinging round its first joint from one side to the other, the hand passes farther in front.
    let [x, _, _] = tip(&START);
    let front = x * (1.0 + 0.18_f64.cos()) / 2.0;
    for version in [Version::V5, Version::V10] {
        let rig = Rig::new(version, |arm| arm);
        let mut robot =
            rig.robot(&config(&format!("control = 'position', box = [-1, {front}, -1, 1, 0, 1.2]"))).unwrap();
        let mut rng = random::Generator::pcg64(1_u64);
        // The arm stands outside, in front: it may stay there, and go into the box.
        robot.reset(&rig.model, &rig.data(), &mut rng).unwrap();
        let mut action = START[..8].to_vec();
        action[0] = 0.18;
        follow(&rig, &mut robot, &action, 50).unwrap();
        assert!(tip(&rig.commanded())[0] < front);
        rig.sent.lock().unwrap().clear();
        action[0] = -0.18;
        let said = why(follow(&rig, &mut robot, &action, 100).unwrap_err());
        assert!(
            said.starts_with("the way to where it is commanded would have its end effector at (")
                && said.ends_with(&format!("its box is x from -1 to {front} m")),
            "{said}"
        );
        rig.clock().wait(0.5);
        let farthest = extremes(&rig, 0)[1];
        println!("{:.6} m of {front:.6} m", farthest);
        assert!(farthest <= front && farthest > front - 1e-3, "{farthest} of {front}");
        assert!(rig.sent.lock().unwrap().last().unwrap().finished, "it is at rest");
        robot.close().unwrap();
        rig.check_commands();
    }
}

#[test]
fn a_dry_run_refuses_it_too() {
    let mut rig = Rig::new(Version::V5, |arm| arm);
    rig.setup.dry_run = true;
    let lowest = tip(&START)[2] - 0.1;
    let mut robot = rig.robot(&config(&format!("box = [-1, 1, -1, 1, {lowest}, 1.2]"))).unwrap();
    let mut rng = random::Generator::pcg64(1_u64);
    robot.reset(&rig.model, &rig.data(), &mut rng).unwrap();
    let mut action = START[..8].to_vec();
    action[1] = 0.5;
    let said = why(follow(&rig, &mut robot, &action, 1).unwrap_err());
    assert!(said.contains("it was commanded to have its end effector"), "{said}");
    assert!(rig.sent.lock().unwrap().is_empty());
    robot.close().unwrap();
}
