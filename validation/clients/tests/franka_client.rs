//! A client that somebody else wrote (franka-rs) drives simulated arms and hands over the loopback network.
#![cfg(unix)]

use franka::error::FrankaError;
use franka::{
    ControllerMode, Duration as Period, FciVersion, Gripper, JointPositions, JointVelocities, RealtimeConfig,
    Robot, RobotMode, RobotOptions, RobotState, Torques, motion_finished,
};
use protocol::franka::Version;
use std::io::Read;
use std::net::{SocketAddr, TcpStream};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex};
use std::thread::JoinHandle;
use std::time::Duration;
use wire::franka::{Arm, Hand};
use wire::{Bench, Carries, End, Plant, Shared, serve};

const NAMES: [&str; 7] = ["a", "b", "c", "d", "e", "f", "g"];
const START: [f64; 7] = [0.0, 0.3, 0.0, -2.0, 0.0, 2.2, 0.7];

/// Seven joints side by side and a finger.
fn plant() -> Plant {
    let mut bodies = String::new();
    let mut actuators = String::new();
    for (k, name) in NAMES.into_iter().enumerate() {
        bodies += &format!(
            "<body pos='{k} 0 0'><joint name='{name}' damping='1' armature='.1'/><geom size='.05' mass='.5'/></body>"
        );
        actuators +=
            &format!("<position name='{name}' joint='{name}' kp='600' kv='40' forcerange='-87 87'/>");
    }
    let text = format!(
        "<mujoco><option gravity='0 0 0' timestep='.001' integrator='implicitfast'/><worldbody>{bodies}
           <body pos='0 3 0'><joint name='finger' type='slide' range='0 .04' armature='.1' damping='10'/>
             <geom size='.02' mass='.1'/></body></worldbody>
         <actuator>{actuators}<position name='finger' joint='finger' kp='500'/></actuator></mujoco>"
    );
    let mut plant = Plant::new(mjcf::load_str(&text).expect("a sound model").model).expect("a sound state");
    let mut qpos = START.to_vec();
    qpos.push(0.02);
    plant.place(&qpos, &[0.0; 8]).expect("a sound state");
    plant
}

struct Served {
    arm: String,
    hand: String,
    bench: Shared,
    stop: Arc<AtomicBool>,
    thread: Option<JoinHandle<std::io::Result<()>>>,
}

impl Served {
    fn new(version: Version) -> Served {
        let plant = plant();
        let arm = Arm::new(version, &plant, NAMES).expect("motors").patient();
        let hand = Hand::new(&plant, "finger", 0.08).expect("a motor");
        let mut bench = Bench::new(plant);
        let carries = [Carries::AT_ONCE, Carries::Datagrams];
        let arm = bench.connect_all(Box::new(arm), carries);
        let hand = bench.connect_all(Box::new(hand), carries);
        let free = SocketAddr::from(([127, 0, 0, 1], 0));
        let mut ends = Vec::new();
        for [commands, states] in [arm, hand] {
            ends.push((commands, End::tcp(free).expect("a port")));
            ends.push((states, End::udp(free, None).expect("a port")));
        }
        let (arm, hand) = (ends[0].1.address(), ends[2].1.address());
        let bench = Arc::new(Mutex::new(bench));
        let stop = Arc::new(AtomicBool::new(false));
        let thread = {
            let (bench, stop) = (bench.clone(), stop.clone());
            std::thread::spawn(move || serve(&bench, &mut ends, &stop))
        };
        Served { arm, hand, bench, stop, thread: Some(thread) }
    }

    fn robot(&self) -> Robot {
        Robot::with_options(&self.arm, RobotOptions::new(RealtimeConfig::Ignore)).expect("a connection")
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

/// Joint 1 and joint 7 by `reach` within `duration`, as a cosine.
fn sway(robot: &Robot, reach: f64, duration: f64) -> Result<(), FrankaError> {
    let start = robot.read_once()?.q_d;
    let mut time = 0.0;
    robot.control_joint_positions(
        |_: &RobotState, period: Period| {
            time += period.as_secs_f64();
            let share = (1.0 - (std::f64::consts::PI * (time / duration).min(1.0)).cos()) / 2.0;
            let mut q = start;
            q[0] += reach * share;
            q[6] += reach * share;
            if time >= duration { motion_finished(JointPositions::new(q)) } else { JointPositions::new(q) }
        },
        ControllerMode::JointImpedance,
        true,
        franka::MAX_CUTOFF_FREQUENCY,
    )
}

fn holds(state: &RobotState, reach: f64) {
    for (k, start) in START.into_iter().enumerate() {
        let wanted = start + if k == 0 || k == 6 { reach } else { 0.0 };
        assert!((state.q[k] - wanted).abs() < 5e-3, "joint {k}: {} instead of {wanted}", state.q[k]);
    }
}

/// Whether the arm gets into a mode; the states that wait to be read are older than the reply to a command.
fn reaches(robot: &Robot, mode: RobotMode) -> bool {
    (0..200).any(|_| robot.read_once().unwrap().robot_mode == mode)
}

#[test]
fn a_panda_moves_reflexes_recovers_and_stops() {
    let served = Served::new(Version::V5);
    let robot = served.robot();
    assert_eq!(robot.fci_version(), FciVersion::V5);
    robot
        .set_collision_behavior_simple([40.0; 7], [40.0; 7], [40.0; 6], [40.0; 6])
        .expect("thresholds of collisions");
    let state = robot.read_once().unwrap();
    assert_eq!((state.robot_mode, state.q), (RobotMode::Idle, START));
    assert_eq!(state.O_T_EE[..], protocol::franka::flange(&START)[..]);
    sway(&robot, 0.1, 1.0).unwrap();
    for _ in 0..200 {
        robot.read_once().unwrap();
    }
    holds(&robot.read_once().unwrap(), 0.1);

    // A command that leaps ends in a reflex, which stays until it is recovered from.
    let start = robot.read_once().unwrap().q_d;
    let mut count = 0;
    let leap = |_: &RobotState, _: Period| {
        count += 1;
        let mut q = start;
        q[3] += if count > 5 { 0.1 } else { 0.0 };
        JointPositions::new(q)
    };
    let error = robot.control_joint_positions(
        leap,
        ControllerMode::JointImpedance,
        false,
        franka::MAX_CUTOFF_FREQUENCY,
    );
    let error = error.unwrap_err().to_string();
    assert!(error.contains("joint_motion_generator_velocity_limits_violation"), "{error}");
    assert!(reaches(&robot, RobotMode::Reflex));
    assert!(sway(&robot, 0.0, 0.1).is_err());
    robot.automatic_error_recovery().unwrap();
    assert!(reaches(&robot, RobotMode::Idle));
    sway(&robot, -0.1, 1.0).unwrap();
    robot.stop().unwrap();
    assert!(robot.set_joint_impedance([-1.0; 7]).is_err());

    served.bench.lock().unwrap().stop_button(true);
    let error = sway(&robot, 0.1, 1.0).unwrap_err().to_string();
    assert!(error.to_lowercase().contains("stop") || error.contains("not possible"), "{error}");
    served.bench.lock().unwrap().stop_button(false);
    for _ in 0..300 {
        robot.read_once().unwrap();
    }
    holds(&robot.read_once().unwrap(), 0.0);
}

#[test]
fn an_fr3_gives_its_model_and_follows_positions_velocities_and_torques() {
    let served = Served::new(Version::V10);
    let robot = served.robot();
    assert_eq!(robot.fci_version(), FciVersion::V10);
    let fastest = robot.upper_joint_velocity_limits(&START);
    assert!((fastest[0] - 2.62).abs() < 0.01, "{fastest:?}");
    sway(&robot, 0.1, 1.0).unwrap();

    let mut time = 0.0;
    robot
        .control_joint_velocities(
            |_: &RobotState, period: Period| {
                time += period.as_secs_f64();
                let mut dq = [0.0; 7];
                dq[1] = 0.1 * (1.0 - (std::f64::consts::TAU * time / 0.5).cos());
                if time >= 0.5 {
                    motion_finished(JointVelocities::new([0.0; 7]))
                } else {
                    JointVelocities::new(dq)
                }
            },
            ControllerMode::JointImpedance,
            true,
            franka::MAX_CUTOFF_FREQUENCY,
        )
        .unwrap();
    for _ in 0..200 {
        robot.read_once().unwrap();
    }
    let state = robot.read_once().unwrap();
    // Half a second at 0.1 rad/s on average.
    assert!((state.q[1] - START[1] - 0.05).abs() < 5e-3, "{:?}", state.q);

    let held = state.q;
    let mut cycles = 0;
    robot
        .control_torques(
            |state: &RobotState, _: Period| {
                cycles += 1;
                let torques = std::array::from_fn(|k| 60.0 * (held[k] - state.q[k]) - 6.0 * state.dq[k]);
                if cycles > 300 { motion_finished(Torques::new(torques)) } else { Torques::new(torques) }
            },
            true,
            franka::MAX_CUTOFF_FREQUENCY,
        )
        .unwrap();
    let state = robot.read_once().unwrap();
    assert!((0..7).all(|k| (state.q[k] - held[k]).abs() < 0.02), "{:?}", state.q);
}

#[test]
fn a_second_client_is_refused_and_the_first_goes_on() {
    let served = Served::new(Version::V5);
    let robot = served.robot();
    robot.read_once().unwrap();
    let mut second = TcpStream::connect(&served.arm).unwrap();
    second.set_read_timeout(Some(Duration::from_secs(20))).unwrap();
    // It is closed, without a byte.
    assert!(matches!(second.read(&mut [0; 16]), Ok(0) | Err(_)));
    robot.read_once().unwrap();
    // When the first has gone, the next may come.
    drop(robot);
    drop(second);
    let again = (0..50).find_map(|_| {
        std::thread::sleep(Duration::from_millis(20));
        Robot::with_options(&served.arm, RobotOptions::new(RealtimeConfig::Ignore)).ok()
    });
    again.expect("a connection").read_once().unwrap();
}

#[test]
fn a_hand_homes_moves_and_grasps_nothing() {
    let served = Served::new(Version::V5);
    let hand = Gripper::new(&served.hand).unwrap();
    assert!(hand.homing().unwrap());
    assert!(hand.move_gripper(0.03, 0.1).unwrap());
    let state = hand.read_once().unwrap();
    assert!((state.width - 0.03).abs() < 2e-3 && state.max_width == 0.08, "{state:?}");
    assert!(hand.move_gripper(0.5, 0.1).is_err());
    // There is nothing between the fingers.
    assert!(!hand.grasp(0.03, 0.1, 20.0, 0.005, 0.005).unwrap());
    assert!(hand.stop().unwrap());
}
