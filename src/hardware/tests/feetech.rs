//! A robot over simulated Feetech servos: the same motion as in simulation, errors by name, seeded faults.

mod rig;

use rig::Rig;
use robot::{Clock, Config};
use wire::Plant;

const ARM: &str = "<mujoco><option timestep='0.002' integrator='implicitfast'/><worldbody>
    <body><joint name='pan' axis='0 0 1' damping='.1' armature='.01'/>
      <geom type='capsule' fromto='0 0 0 .1 0 0' size='.02' mass='.3'/>
      <body pos='.1 0 0'><joint name='lift' axis='0 1 0' damping='.1' armature='.01'/>
        <geom type='capsule' fromto='0 0 0 .2 0 0' size='.02' mass='.2'/></body></body></worldbody>
  <actuator><position name='pan' joint='pan' kp='20' kv='1'/><position name='lift' joint='lift' kp='20' kv='1'/></actuator>
  <sensor><jointpos name='pan_angle' joint='pan'/><jointpos name='lift_angle' joint='lift'/>
    <jointvel name='lift_speed' joint='lift'/></sensor></mujoco>";

fn config(extra: &str) -> Config {
    let half = std::f64::consts::PI;
    let text = format!(
        "[[device]]
         name = 'so'
         interface = {{ type = 'feetech', name = 'bus', reset_time = 1, {extra} }}
         sensor = [{{ name = 'pan_angle', range = [-2, 2], hdr_id = 1, offset = -{half} }},
                   {{ name = 'lift_angle', range = [-2, 2], hdr_id = 2, scale = -1, offset = {half} }},
                   {{ name = 'lift_speed', range = [-9, 9], hdr_id = '2:velocity', scale = -1 }}]
         actuator = [{{ name = 'pan', pos_range = [-1, 1], vel_range = [-2, 2], hdr_id = 1, offset = {half} }},
                     {{ name = 'lift', pos_range = [-1, 1], vel_range = [-2, 2], hdr_id = 2, scale = -1, offset = {half} }}]"
    );
    Config::from_toml(&text, "so.toml").unwrap()
}

fn on_bus(config: &Config, at_once: bool) -> Rig {
    let model = robohive_mjcf::load_str(ARM).unwrap().model;
    let (bench, rigged) = wire::rig(config, Plant::new(model.clone()).unwrap(), at_once).unwrap();
    Rig::new(model, bench, rigged[0].links[0].1)
}

fn action(k: u32) -> [f64; 2] {
    let t = f64::from(k) * 0.1;
    [0.6 * t.sin(), 0.4 * (1.3 * t).cos() - 0.4]
}

#[test]
fn the_same_policy_ends_within_quantisation_of_the_simulation() {
    let config = config("speed = 0, acceleration = 0");
    let [worst, speeds] = on_bus(&config, true).differences(&config, action);
    // A step is 1.5 mrad: half of it for the command, half for the reading that limits the velocity.
    assert!(worst < 1.6e-3 && worst > 1e-5, "{worst}");
    assert!(speeds < 0.02, "{speeds}");
}

#[test]
fn silence_trouble_and_wrong_configs_are_named() {
    let sound = config("");
    let rig = on_bus(&sound, false);
    let (model, mut rng) = (rig.model.clone(), random::Generator::pcg64(1_u64));
    let data = physics::Data::new(&model);
    let mut robot = rig.robot(&sound).unwrap();
    robot.reset(&model, &data, &mut rng).unwrap();
    robot.control(&model, &data, &[0.5, 0.0], 0.5).unwrap();
    rig.clock().wait(0.3);
    let error = robot.control(&model, &data, &[0.5, 0.0], 0.1).unwrap_err().to_string();
    assert!(error.contains("device 'so'") && error.contains("no command came for 0.25 s"), "{error}");
    robot.reset(&model, &data, &mut rng).unwrap();
    rig.bench.lock().unwrap().stop_button(true);
    rig.clock().wait(0.3);
    assert!(robot.control(&model, &data, &[0.0, 0.0], 0.1).unwrap_err().to_string().contains("ms old"));
    let error = robot.reset(&model, &data, &mut rng).unwrap_err().to_string();
    assert!(error.contains("servo 1 does not answer at 1000000 baud on bus"), "{error}");
    for (extra, part) in [
        ("accelleration = 1", "'accelleration' of its interface is not known"),
        ("safe = 'sit'", "there are hold, off"),
        ("baud = 2000000", "it must be from 19200 to 1000000"),
    ] {
        let error = rig.robot(&config(extra)).err().unwrap().to_string();
        assert!(error.contains(part), "{error}");
    }
}

#[test]
fn seeded_faults_end_in_errors_or_in_motion_within_limits() {
    let sound = config("");
    rig::strike(|| on_bus(&sound, false), &sound, action);
}

#[test]
fn the_so101_reads_and_commands_its_servos_in_joint_angles() {
    let text = assets::text("so101/tasks/arm.toml").unwrap();
    let config = Config::from_toml(text, "arm.toml").unwrap();
    let loaded = robohive_mjcf::Loader::default().files(assets::Own).load("so101/robot.xml").unwrap();
    let model = loaded.model;
    let (bench, rigged) = wire::rig(&config, Plant::new(model.clone()).unwrap(), true).unwrap();
    let rig = Rig::new(model.clone(), bench, rigged[0].links[0].1);
    let (mut data, mut rng) = (physics::Data::new(&model), random::Generator::pcg64(1_u64));
    let mut robot = rig.robot(&config).unwrap();
    robot.reset(&model, &data, &mut rng).unwrap();
    let goal = [0.3, -0.2, 0.4, 0.9, -0.5, 1.2];
    let mut clock = rig.clock();
    for _ in 0..30 {
        robot.control(&model, &data, &goal, 0.1).unwrap();
        clock.wait(0.1);
        robot.sense(&model, &data, &mut rng);
        robot.write_readings(&mut data);
    }
    let bench = rig.bench.lock().unwrap();
    for (joint, goal) in goal.into_iter().enumerate() {
        let (found, read) = (bench.plant().position(joint), data.state.qpos[joint]);
        // A servo counts steps of 1.5 mrad, and yields to the weight of the arm by its stiffness.
        assert!((found - read).abs() < 1.6e-3, "joint {joint}: at {found}, reads {read}");
        assert!((found - goal).abs() < 0.06, "joint {joint}: at {found}, told {goal}");
    }
}
