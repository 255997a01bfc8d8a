//! Visual observations on a model of our own: shapes, what they show, when they are drawn, threads, networks, `render`.

use render::painter::Cpu;
use render::raster::Shot;
use render::{Painter, Painters, Profile, RenderError, Settings};
use robohive_env::visual::Encoder;
use robohive_env::{
    Autoreset, Compat, Env, EnvError, Exteroception, Network, NetworkError, Networks, Options, OwnModels,
    Pixels, RenderMode, Rendering, VecEnv,
};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, Mutex};

const ID: &str = "hive/FrankaReach-v0";

fn options(keys: &str) -> Options {
    Options::default().with_changes(format!("visual_keys = [{keys}]").parse().unwrap())
}

fn make(keys: &str) -> Env {
    Env::make(ID, &OwnModels, &options(keys)).unwrap()
}

fn bytes<'a>(seen: &'a Exteroception, name: &str) -> &'a [u8] {
    match seen.get(name).unwrap().pixels() {
        Pixels::Bytes(bytes) => bytes,
        Pixels::Numbers(_) => panic!("{name} has no bytes"),
    }
}

fn numbers<'a>(seen: &'a Exteroception, name: &str) -> &'a [f32] {
    match seen.get(name).unwrap().pixels() {
        Pixels::Numbers(numbers) => numbers,
        Pixels::Bytes(_) => panic!("{name} has no numbers"),
    }
}

fn action(step: usize, len: usize) -> Vec<f64> {
    (0..len).map(|k| (0.7 * step as f64 + 1.3 * k as f64).sin()).collect()
}

#[test]
fn keys_have_their_shapes_and_values() {
    let mut env = make("'rgb:front:20x30:2d', 'd:front:20x30:2d'");
    env.reset(Some(1)).unwrap();
    let seen = env.exteroception().unwrap().clone();
    assert_eq!(seen.get("rgb:front:20x30:2d").unwrap().shape(), [20, 30, 3]);
    assert_eq!(seen.get("d:front:20x30:2d").unwrap().shape(), [1, 20, 30]);
    let (colors, depth) = (bytes(&seen, "rgb:front:20x30:2d"), numbers(&seen, "d:front:20x30:2d"));
    assert_eq!((colors.len(), depth.len()), (20 * 30 * 3, 20 * 30));
    assert!(colors.iter().max() > colors.iter().min());
    let middle = depth[10 * 30 + 15];
    assert!((0.5..3.0).contains(&middle), "the arm stands about a metre and a half away, not {middle}");
    let mut flat = make("'rgb:front:20x30:1d'");
    flat.reset(Some(1)).unwrap();
    let row = flat.exteroception().unwrap();
    assert_eq!(row.get("rgb:front:20x30:1d").unwrap().shape(), [20 * 30 * 3]);
    assert_eq!(bytes(row, "rgb:front:20x30:1d"), colors);
}

#[test]
fn images_are_those_of_the_last_observation() {
    let key = "rgb:front:40x40:2d";
    let mut env = make(&format!("'{key}'"));
    env.reset(Some(1)).unwrap();
    assert!(env.visuals().is_none(), "nothing is drawn before somebody asks");
    let first = bytes(env.exteroception().unwrap(), key).to_vec();
    assert_eq!(env.visuals().unwrap().time(), 0.0);
    env.step(&action(1, 8)).unwrap();
    assert!(env.visuals().is_none(), "images of another state are not those of this one");
    let saved = env.state();
    let second = env.exteroception().unwrap().clone();
    assert_eq!(second.time(), env.scene().data.time());
    assert_ne!(bytes(&second, key), first, "the arm and its target are elsewhere");
    env.reset(Some(1)).unwrap();
    assert_eq!(bytes(env.exteroception().unwrap(), key), first);
    env.set_state(&saved).unwrap();
    assert_eq!(*env.exteroception().unwrap(), second);
    let world = env.world();
    env.reset(Some(2)).unwrap();
    env.set_world(&world).unwrap();
    assert_eq!(*env.exteroception().unwrap(), second);
}

#[test]
fn images_leave_the_episode_as_it_is() {
    let play = |look: bool| {
        let mut env = make("'rgb:front:16x16:2d', 'd:front:16x16:2d'");
        let mut seen = env.reset(Some(3)).unwrap().to_vec();
        for step in 0..10 {
            if look {
                env.exteroception().unwrap();
            }
            env.step(&action(step, 8)).unwrap();
            seen.extend_from_slice(env.observation());
        }
        seen
    };
    assert_eq!(play(true), play(false));
}

#[test]
fn threads_change_no_pixel() {
    let key = "rgb:front:32x32:2d";
    let env = make(&format!("'{key}', 'd:front:32x32:2d'"));
    let run = |threads| {
        let mut envs = VecEnv::new(&env, 5, Autoreset::NextStep, threads).unwrap();
        envs.reset(Some(40)).unwrap();
        let mut seen = Vec::new();
        for step in 0..4 {
            let actions: Vec<f64> = (0..5).flat_map(|k| action(step + 100 * k, 8)).collect();
            envs.step(&actions).unwrap();
            seen.extend(envs.exteroception().unwrap().cloned());
        }
        seen
    };
    let one = run(1);
    assert_eq!(one, run(3));
    let mut alone = env.fork().unwrap();
    alone.reset(Some(42)).unwrap();
    for step in 0..4 {
        alone.step(&action(step + 200, 8)).unwrap();
    }
    assert_eq!(*alone.exteroception().unwrap(), one[3 * 5 + 2]);
    assert_ne!(bytes(&one[15], key), bytes(&one[16], key));
}

/// Draws on the CPU, and counts the shots of each call.
#[derive(Clone, Debug, Default)]
struct Together(Arc<Mutex<Vec<usize>>>);

impl Painters for Together {
    fn painter(&self, settings: &Settings) -> Box<dyn Painter> {
        Box::new(Counting(Cpu.painter(settings), self.clone()))
    }
}

struct Counting(Box<dyn Painter>, Together);

impl Painter for Counting {
    fn paint(&mut self, settings: &Settings, shots: &mut [Shot<'_>]) -> Result<(), RenderError> {
        self.1.0.lock().unwrap().push(shots.len());
        self.0.paint(settings, shots)
    }

    fn draws_batches(&self) -> bool {
        true
    }

    fn name(&self) -> String {
        "counting".into()
    }
}

#[test]
fn painters_of_batches_draw_all_images_of_all_environments_at_once() {
    let keys = "'rgb:front:16x16:2d', 'd:front:16x16:2d'";
    let together = Together::default();
    let options = options(keys).with_painters(Arc::new(together.clone()));
    let mut one = Env::make(ID, &OwnModels, &options).unwrap();
    let mut batch = VecEnv::new(&one, 5, Autoreset::NextStep, 2).unwrap();
    let mut plain = VecEnv::new(&make(keys), 5, Autoreset::NextStep, 2).unwrap();
    for step in 0..3 {
        let rows: Vec<f64> = (0..5).flat_map(|k| action(step + 7 * k, 8)).collect();
        for envs in [&mut batch, &mut plain] {
            if step == 0 {
                envs.reset(Some(1)).map(drop).unwrap()
            } else {
                envs.step(&rows).map(drop).unwrap()
            }
        }
        let drawn: Vec<_> = batch.exteroception().unwrap().cloned().collect();
        assert_eq!(drawn, plain.exteroception().unwrap().cloned().collect::<Vec<_>>(), "step {step}");
        assert_eq!(batch.exteroception().unwrap().cloned().collect::<Vec<_>>(), drawn, "drawn once");
    }
    assert_eq!(*together.0.lock().unwrap(), [5; 3], "five environments, a drawing of each");
    one.reset(Some(1)).unwrap();
    let seen = one.exteroception().unwrap().clone();
    let mut other = make(keys);
    other.reset(Some(1)).unwrap();
    assert_eq!(seen, *other.exteroception().unwrap());
    assert_eq!(together.0.lock().unwrap().last(), Some(&1));
}

/// A network that says how bright a picture is.
struct Brightness;

impl Network for Brightness {
    fn encode(
        &self,
        [height, width]: [usize; 2],
        rgb: &[u8],
        features: &mut Vec<f32>,
    ) -> Result<(), NetworkError> {
        let sum: u64 = rgb.iter().map(|&byte| u64::from(byte)).sum();
        features.extend([sum as f32 / (height * width) as f32; 512]);
        Ok(())
    }
}

#[derive(Default)]
struct Counted(AtomicUsize);

impl Networks for Counted {
    fn load(&self, encoder: Encoder, compat: Compat) -> Result<Arc<dyn Network>, NetworkError> {
        assert_eq!((encoder, compat), (Encoder::R3m(18), Compat::Fixed));
        self.0.fetch_add(1, Ordering::Relaxed);
        Ok(Arc::new(Brightness))
    }
}

#[test]
fn networks_are_loaded_once_and_only_if_needed() {
    let (key, depth) = ("rgb:front:16x16:r3m18", "d:front:16x16:r3m18");
    let networks = Arc::new(Counted::default());
    let options = options(&format!("'{key}', '{depth}'")).with_networks(networks.clone());
    let mut env = Env::make(ID, &OwnModels, &options).unwrap();
    env.reset(Some(1)).unwrap();
    assert_eq!(networks.0.load(Ordering::Relaxed), 0);
    let mut other = env.fork().unwrap();
    let seen = env.exteroception().unwrap();
    assert_eq!(seen.get(key).unwrap().shape(), [512]);
    assert!(numbers(seen, key)[0] > 1.0);
    assert_eq!((numbers(seen, key).len(), numbers(seen, depth).len()), (512, 256));
    other.exteroception().unwrap();
    assert_eq!(networks.0.load(Ordering::Relaxed), 1);
    let mut none = make(&format!("'{key}'"));
    none.reset(None).unwrap();
    let error = none.exteroception().unwrap_err();
    assert!(matches!(error, EnvError::Network { .. }) && error.to_string().contains("r3m18"), "{error}");
}

#[test]
fn the_profile_follows_whose_behaviour_it_is() {
    let profile = |compat| {
        let options = Options::default().with_compat(compat);
        Env::make(ID, &OwnModels, &options).unwrap().profile()
    };
    assert_eq!(profile(Compat::RoboHive07), Profile::Mujoco313);
    assert_eq!(profile(Compat::Fixed), Profile::Mujoco312);
}

#[test]
fn render_returns_what_its_mode_says() {
    let make = |mode: Option<RenderMode>, camera: &str| {
        let rendering = Rendering { mode, camera: camera.into(), width: 24, height: 16 };
        Env::make(ID, &OwnModels, &Options::default().with_rendering(rendering))
    };
    // A wrong name fails when the environment is made, not at the first picture.
    for mode in [None, Some(RenderMode::RgbArray)] {
        let error = make(mode, "fornt").err().unwrap().to_string();
        assert!(error.contains("fornt") && error.contains("front"), "{error}");
    }
    let make = |mode, camera| make(mode, camera).unwrap();
    assert!(make(None, "front").render().unwrap().is_none());
    let mut env = make(Some(RenderMode::RgbArray), "front");
    let front = env.render().unwrap().unwrap().clone();
    assert_eq!((front.rgb.len(), front.depth.len()), (24 * 16 * 3, 0));
    let mut env = make(Some(RenderMode::RgbArray), "free");
    assert_ne!(env.render().unwrap().unwrap().rgb, front.rgb);
    let mut env = make(Some(RenderMode::DepthArray), "front");
    assert_eq!(env.render().unwrap().unwrap().depth.len(), 24 * 16);
    let human = "human".parse::<RenderMode>().unwrap_err().to_string();
    assert!(human.contains("window") && human.contains("rgb_array"), "{human}");
    assert_eq!("depth_array".parse(), Ok(RenderMode::DepthArray));
}
