//! Visual domain randomisation on a model of our own: what changes, what does not, and how it comes back.

use mjcf::Loader;
use mjcf::files::Memory;
use render::Picture;
use render::picture::Channels;
use robohive_env::{AssetError, Assets, Env, EnvError, Options, OwnModels};
use std::path::PathBuf;
use std::sync::Arc;

const ID: &str = "hive/FrankaReach-v0";

const EVERYTHING: &str = "
    [visual_randomization]
    materials = [{ rgba = { low = [0.1, 0.1, 0.1, 1], high = [0.9, 0.9, 0.9, 1] } }]
    lights = [{ pos = { low = [-1, -1, 0], high = [1, 1, 0.5] }, dir = { low = [-0.2, -0.2, 0], high = [0.2, 0.2, 0] }, \
        diffuse = { low = [0.2, 0.2, 0.2], high = [1, 1, 1] }, on = 0.9, shadow = 0.5 }]
    [[visual_randomization.cameras]]
    names = ['fr*']
    pos = { low = [-0.1, -0.1, -0.1], high = [0.1, 0.1, 0.1] }
    turn = { low = [-5, -5, -5], high = [5, 5, 5] }
    fovy = { low = [40], high = [60] }
";

fn make(changes: &str) -> Result<Env, EnvError> {
    Env::make(ID, &OwnModels, &Options::default().with_changes(changes.parse().unwrap()))
}

fn picture(env: &mut Env) -> Vec<u8> {
    let mut picture = Picture::new(48, 48);
    env.draw("front", Channels::RGB, &mut picture).unwrap();
    picture.rgb
}

fn action(step: usize) -> Vec<f64> {
    (0..8).map(|k| (0.7 * step as f64 + 1.3 * k as f64).sin()).collect()
}

#[test]
fn every_episode_looks_different_and_moves_the_same() {
    let play = |env: &mut Env| {
        let (mut pictures, mut seen) = (Vec::new(), env.reset(Some(3)).unwrap().to_vec());
        for _ in 0..2 {
            pictures.push(picture(env));
            for step in 0..5 {
                env.step(&action(step)).unwrap();
                seen.extend_from_slice(env.observation());
            }
            seen.extend_from_slice(env.reset(None).unwrap());
        }
        (pictures, seen)
    };
    let (mut plain, mut varied) = (make("").unwrap(), make(EVERYTHING).unwrap());
    assert!(plain.look().is_none());
    assert_eq!(picture(&mut plain), picture(&mut varied), "nothing is drawn before the first reset");
    let ((plain, motion), (pictures, same)) = (play(&mut plain), play(&mut varied));
    assert_eq!(motion, same);
    assert_ne!(plain, pictures);
    assert_ne!(pictures[0], pictures[1]);
    assert_eq!(play(&mut varied).0, pictures, "the seed decides the look");
    let mut both = make(&format!("{EVERYTHING}\n[physics_randomization]")).unwrap();
    assert_eq!(play(&mut both), (pictures, same), "physics that does not change leaves the look");
}

#[test]
fn a_look_is_recorded_and_comes_back() {
    let mut env = make(EVERYTHING).unwrap();
    env.reset(Some(5)).unwrap();
    let (look, seen) = (env.look().unwrap().clone(), picture(&mut env));
    let fovy = look.get("camera/front/fovy").unwrap()[0];
    assert!((40.0..60.0).contains(&fovy));
    assert_eq!(env.scene().model.cam_fovy[0], fovy);
    assert_eq!(look.get("light/0/pos").unwrap().len(), 3);
    let saved = env.state();
    env.reset(Some(6)).unwrap();
    let next = picture(&mut env);
    assert_ne!((&next, env.look().unwrap()), (&seen, &look));
    env.set_state(&saved).unwrap();
    assert_eq!((picture(&mut env), env.look().unwrap()), (seen.clone(), &look));
    env.reset(None).unwrap();
    let after = picture(&mut env);
    env.set_state(&saved).unwrap();
    env.reset(None).unwrap();
    assert_eq!(picture(&mut env), after, "the draws go on from where they were");

    let mut other = make(EVERYTHING).unwrap();
    other.reset(Some(6)).unwrap();
    env.set_state(&saved).unwrap();
    other.set_world(&env.world()).unwrap();
    assert_ne!(picture(&mut other), seen);
    other.set_look(&look).unwrap();
    assert_eq!(picture(&mut other), seen, "a look that was recorded comes back");
    let error = make("").unwrap().set_look(&look).unwrap_err().to_string();
    assert!(error.contains("visual_randomization"), "{error}");
}

/// A table with textures, a light that follows, and a cup that touches nothing.
const TEXTURED: &str = "<mujoco>
    <asset>
        <texture name='wood' type='2d' builtin='checker' width='64' height='64' rgb1='1 0 0' rgb2='0 1 0'/>
        <texture name='sky' type='skybox' builtin='gradient' width='16' height='16' rgb1='0 0 1' rgb2='1 1 1'/>
        <texture name='box' type='cube' builtin='flat' width='16' height='16' rgb1='1 1 1' rgb2='1 1 1'/>
        <material name='wood' texture='wood'/><material name='box' texture='box'/>
    </asset>
    <worldbody>
        <light mode='track' pos='0 0 3'/>
        <camera name='front' pos='0 -1.5 0.8' xyaxes='1 0 0 0 0.5 1'/>
        <geom type='plane' size='1 1 .1' material='wood'/>
        <body name='cup' pos='0.3 0 0.1'><geom size='.1' contype='0' conaffinity='0'/></body>
        <body name='block' pos='-0.3 0 0.1'><geom type='box' size='.1 .1 .1' material='box'/></body>
        <body name='finger' pos='0 0 0.5'><joint name='slide' type='slide' axis='0 0 1' range='-1 1'/>
            <geom size='.05'/><site name='tip'/></body>
        <site name='target' pos='0 0 0.6'/>
    </worldbody>
    <actuator><position joint='slide' ctrlrange='-1 1' kp='10'/></actuator>
</mujoco>";

struct Textured;

impl Assets for Textured {
    fn model(&self, _: &str) -> Result<(Loader, PathBuf), AssetError> {
        let mut files = Memory::default();
        files.insert("scene.xml", TEXTURED.as_bytes());
        Ok((Loader::default().files(files), "scene.xml".into()))
    }

    fn read(&self, _: &str) -> Result<Arc<[u8]>, AssetError> {
        Err("there is none".into())
    }
}

fn textured(randomization: &str) -> Result<Env, EnvError> {
    let settings = format!(
        "model_path = 'scene.xml'\nrobot_site_name = 'tip'\ntarget_site_name = 'target'\n{randomization}"
    );
    let mut registry = robohive_env::Registry::default();
    let table = format!(
        "suite = 'test'\n['textured-v0']\ntask = 'reach'\nmax_episode_steps = 5\n\
        target_xyz_range = {{ low = [0, 0, 0.5], high = [0, 0, 0.7] }}\n{settings}"
    );
    registry.add_table(&table).unwrap();
    Env::build(registry.spec("textured-v0")?, &Textured, &Options::default())
}

#[test]
fn textures_lights_and_distractors_change() {
    let cases = [
        "textures = [{ names = ['wood'], patterns = ['color'] }]",
        "textures = [{ names = ['wood'], patterns = ['checker'] }]",
        "textures = [{ names = ['sky'], patterns = ['gradient'] }]",
        "textures = [{ names = ['box'], patterns = ['noise'] }]",
        "lights = [{ pos = { low = [1, 1, 0], high = [2, 2, 0] } }]",
        "lights = [{ dir = { low = [0.5, 0.5, 0], high = [0.9, 0.9, 0] } }]",
        "lights = [{ on = 0.0 }]",
        "lights = [{ shadow = 0.0 }]",
        "distractors = [{ names = ['cup'], rgba = { low = [0.5, 0, 0, 1], high = [1, 0, 0, 1] } }]",
        "distractors = [{ names = ['cup'], pos = { low = [0, 0.1, 0.1], high = [0, 0.2, 0.2] } }]",
    ];
    let mut plain = textured("").unwrap();
    plain.reset(Some(1)).unwrap();
    let before = picture(&mut plain);
    for case in cases {
        let mut env = textured(&format!("[textured-v0.visual_randomization]\n{case}")).unwrap();
        env.reset(Some(1)).unwrap();
        let changed = picture(&mut env);
        assert_ne!(changed, before, "{case}");
        assert_eq!(env.observation(), plain.observation(), "{case}");
        let copy = picture(&mut env.fork().unwrap());
        assert_eq!(copy, changed, "{case}: a clone looks the same");
    }
}

#[test]
fn wrong_ranges_and_names_are_refused() {
    for (case, text) in [
        ("textures = [{ names = ['wod'] }]", "did you mean wood"),
        ("textures = [{ patterns = [] }]", "pattern"),
        ("textures = [{ patterns = ['stripes'] }]", "stripes"),
        ("colours = []", "colours"),
        ("materials = [{ rgba = { low = [0, 0, 0, 0], high = [2, 1, 1, 1] } }]", "within 0 and 1"),
        ("lights = [{ on = 1.5 }]", "probability"),
        ("cameras = [{ fovy = { low = [90], high = [40] } }]", "low not above high"),
        ("distractors = [{ names = ['block'] }]", "touches"),
        ("distractors = [{ names = ['finger'] }]", "moves"),
    ] {
        let error = textured(&format!("[textured-v0.visual_randomization]\n{case}")).err();
        let error = error.unwrap_or_else(|| panic!("{case} is accepted")).to_string();
        assert!(error.contains(text), "{case}: {error}");
    }
}
