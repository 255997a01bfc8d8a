//! Visual keys of a robot that is hardware: frames of its cameras, through their encodings, instead of drawings.

use env::{Env, EnvError, Options, OwnModels, Pixels};
use hardware::Setup;
use render::Picture;
use render::picture::Channels;
use robohive_library::Rehearsal;
use robot::Config;
use std::sync::Arc;

const ID: &str = "hive/FrankaReach_v2d-v0";

/// The arm's config with a camera of this interface, or without one.
fn config(interface: Option<&str>) -> Config {
    let robot = include_str!("../../../assets/franka/tasks/hardware.toml");
    let (arm, _) = robot.split_once("[[device]]\nname = \"front\"").unwrap();
    let camera = interface.map_or_else(String::new, |interface| {
        format!(
            "\n[[device]]\nname = 'front'\ninterface = {{ {interface}, width = 224, height = 224 }}\n\
             cam = [{{ name = 'colours', range = [0, 255], hdr_id = 'rgb' }}, \
             {{ name = 'depth', range = [0, 60], hdr_id = 'd' }}]\n"
        )
    });
    Config::from_toml(&(arm.to_owned() + &camera), "arm.toml").unwrap()
}

/// The environment on simulated devices, and the same one simulated.
fn made(config: Config) -> (Result<Env, EnvError>, Env) {
    let mut simulated = Env::make(ID, &OwnModels, &Options::default()).unwrap();
    let rehearsal = Rehearsal::new(&config, &mut simulated).unwrap();
    let mut setup = Setup::default().with_armed(true);
    setup.say = Arc::new(|_| {});
    let hardware = rehearsal.hardware(config, setup, None);
    (Env::make(ID, &OwnModels, &Options::default().with_hardware(Some(hardware))), simulated)
}

fn bytes(env: &mut Env) -> Vec<u8> {
    match env.exteroception().unwrap().images()[0].pixels() {
        Pixels::Bytes(bytes) => bytes.clone(),
        Pixels::Numbers(_) => panic!("colours are bytes"),
    }
}

fn depths(env: &mut Env) -> Vec<f32> {
    match env.exteroception().unwrap().images()[1].pixels() {
        Pixels::Numbers(depths) => depths.clone(),
        Pixels::Bytes(_) => panic!("depths are numbers"),
    }
}

/// Ratio of the largest to the usual error [dB].
fn similarity(a: &[u8], b: &[u8]) -> f64 {
    assert_eq!(a.len(), b.len());
    let square = |(a, b): (&u8, &u8)| (f64::from(*a) - f64::from(*b)).powi(2);
    let mean = a.iter().zip(b).map(square).sum::<f64>() / a.len() as f64;
    10.0 * (255.0f64.powi(2) / mean).log10()
}

#[test]
fn visual_keys_show_frames_of_the_cameras() {
    let (live, mut simulated) = made(config(Some("type = 'realsense', warm_up = 2")));
    let mut live = live.unwrap();
    live.reset(Some(0)).unwrap();
    simulated.reset(Some(0)).unwrap();
    let (seen, drawn) = (bytes(&mut live), bytes(&mut simulated));
    // Two pixels of a frame share their colour, and brightness is rounded once more.
    let first = similarity(&seen, &drawn);
    assert!(first > 30.0 && seen != drawn, "{first} dB");
    // Depth in steps of a millimetre up to 65 m, beyond which there is none.
    for (seen, drawn) in depths(&mut live).into_iter().zip(depths(&mut simulated)) {
        let expected = if drawn > 65.535 { 0.0 } else { drawn };
        assert!((seen - expected).abs() <= 0.000_51, "{seen} instead of {expected}");
    }

    // The arm moves, and so do the pictures: they show what the joints say.
    for _ in 0..10 {
        live.step(&vec![0.4; live.action_len()]).unwrap();
    }
    let moved = bytes(&mut live);
    let mut mirrored = Picture::new(224, 224);
    live.draw("front", Channels::RGB, &mut mirrored).unwrap();
    let [moved_from, mirrors] = [similarity(&moved, &seen), similarity(&moved, &mirrored.rgb)];
    assert!(moved_from < 25.0 && mirrors > 30.0, "{moved_from} dB, {mirrors} dB");
}

#[test]
fn keys_without_a_camera_are_refused_before_anything_moves() {
    let (live, _) = made(config(None));
    let error = live.err().unwrap().to_string();
    assert!(error.contains("rgb:front:224x224:2d") && error.contains("its cameras are: none"), "{error}");
    let (live, _) = made(config(Some("type = 'camera', name = '/dev/video0'")));
    let error = live.err().unwrap().to_string();
    assert!(error.contains("camera 'front'") && error.contains("has no depth"), "{error}");
    let (live, _) = made(config(Some("type = 'realsense', format = 'mjpg'")));
    let error = live.err().unwrap().to_string();
    assert!(error.contains("sends no JPEG"), "{error}");
}
