//! Domain randomisation of physics on a model of our own: what is drawn is what the compiler makes of those numbers, comes back, and
//! is refused where it means nothing.

use mjcf::Loader;
use mjcf::files::Memory;
use physics::Model;
use robohive_env::{AssetError, Assets, Autoreset, Env, EnvError, Options, Registry, VecEnv};
use std::path::PathBuf;
use std::sync::Arc;

/// Numbers of the scene that are varied.
#[derive(Clone, Copy)]
struct Numbers {
    /// Mass of the arm \[kg\], friction of the table, damping, friction loss and armature of the elbow.
    mass: f64,
    friction: f64,
    joint: [f64; 3],
    /// Gear of the motor's gain, stiffness and damping of the servo, peak force of the muscle.
    motor: f64,
    servo: [f64; 2],
    muscle: f64,
    delays: [f64; 2],
    gravity: f64,
    /// Factors of the sizes of the ball and of the hammer.
    ball: f64,
    hammer: f64,
    stand: [f64; 2],
}

const PLAIN: Numbers = Numbers {
    mass: 1.0,
    friction: 0.8,
    joint: [0.5, 0.1, 0.02],
    motor: 2.0,
    servo: [10.0, 1.0],
    muscle: 100.0,
    delays: [0.004, 0.006],
    gravity: -9.81,
    ball: 1.0,
    hammer: 1.0,
    stand: [0.5, 0.1],
};

const CHANGED: Numbers = Numbers {
    mass: 2.0,
    friction: 0.8 * 0.5,
    joint: [0.5 * 4.0, 0.1 * 2.0, 0.02 * 3.0],
    motor: 2.0 * 1.5,
    servo: [10.0 * 1.5, 1.0 * 1.5],
    muscle: 100.0 * 1.5,
    delays: [0.01, 0.008],
    gravity: -5.0,
    ball: 1.25,
    hammer: 1.5,
    stand: [0.7, -0.2],
};

const CHANGES: &str = "
masses = [{ names = ['arm'], factor = { low = [2], high = [2] } }]
friction = [{ names = ['table'], factor = { low = [0.5], high = [0.5] } }]
joints = [{ names = ['elb*'], damping = { low = [4], high = [4] }, frictionloss = { low = [2], high = [2] }, \
    armature = { low = [3], high = [3] } }]
actuators = [{ gain = { low = [1.5], high = [1.5] } }, \
    { names = ['motor'], gain = { low = [1.5], high = [1.5] }, delay = { low = [0.01], high = [0.01] } }]
sensors = [{ names = ['late'], delay = { low = [0.008], high = [0.008] } }]
gravity = { low = [0, 0, -5], high = [0, 0, -5] }
sizes = [{ names = ['ball'], factor = { low = [1.25], high = [1.25] } }, \
    { bodies = ['hammer'], factor = { low = [1.5], high = [1.5] } }]
layouts = [{ names = ['stand'], pos = { low = [0.7, -0.2], high = [0.7, -0.2] } }]
";

fn scene(n: &Numbers) -> String {
    let [damping, loss, armature] = n.joint;
    let [kp, kv] = n.servo;
    let [control, sensor] = n.delays;
    let h = |length: f64| n.hammer * length;
    format!(
        "<mujoco>
    <option gravity='0 0 {gravity}' timestep='0.002'/>
    <worldbody>
        <geom name='table' type='plane' size='2 2 .1' friction='{friction} {torsion} {rolling}'/>
        <body name='stand' pos='{sx} {sy} 0.2'><geom type='box' size='.05 .05 .2'/></body>
        <body name='arm' pos='0 0 0.6'><inertial mass='{mass}' pos='.1 0 0' diaginertia='{i} {i} {j}'/>
            <joint name='elbow' axis='0 0 1' range='-90 90' damping='{damping}' frictionloss='{loss}' armature='{armature}'/>
            <geom type='capsule' fromto='0 0 0 .2 0 0' size='.02'/>
            <body name='finger' pos='.25 0 0'><joint name='slide' type='slide' axis='1 0 0' range='-0.1 0.1'/>
                <geom size='.02'/><site name='tip'/></body></body>
        <body name='ball' pos='0.3 0.3 .1'><freejoint/>
            <geom name='ball' type='ellipsoid' size='{a} {b} {c}' density='700' fluidshape='ellipsoid'/></body>
        <body name='hammer' pos='-0.3 0.3 {rest}'><freejoint/>
            <geom type='box' size='{hx} {hx} {hy}' pos='{hz} 0 0'/><geom type='cylinder' size='{r} {l}' euler='0 90 0' density='300'/>
            <site name='grip' pos='{grip} 0 0' size='{r} {r} {r}'/></body>
        <site name='target' pos='0 0 0.6'/>
    </worldbody>
    <tendon><spatial name='pull'><site site='tip'/><site site='target'/></spatial></tendon>
    <actuator>
        <general name='motor' joint='elbow' ctrlrange='-1 1' gainprm='{motor}' delay='{control}' nsample='10'/>
        <position name='servo' joint='slide' ctrlrange='-0.1 0.1' kp='{kp}' kv='{kv}'/>
        <muscle name='muscle' tendon='pull' ctrlrange='0 1' force='{muscle}' lengthrange='0.1 0.6'/>
    </actuator>
    <sensor><jointpos name='late' joint='elbow' delay='{sensor}' nsample='10'/><jointpos name='now' joint='elbow'/></sensor>
</mujoco>",
        gravity = n.gravity,
        friction = n.friction,
        torsion = n.friction * 0.00625,
        rolling = n.friction * 0.000125,
        sx = n.stand[0],
        sy = n.stand[1],
        mass = n.mass,
        i = n.mass * 0.01,
        j = n.mass * 0.02,
        a = n.ball * 0.04,
        b = n.ball * 0.03,
        c = n.ball * 0.05,
        rest = 0.02,
        hx = h(0.02),
        hy = h(0.03),
        hz = h(0.1),
        r = h(0.01),
        l = h(0.1),
        grip = h(-0.05),
        motor = n.motor,
        muscle = n.muscle,
    )
}

struct Scene;

impl Assets for Scene {
    fn model(&self, _: &str) -> Result<(Loader, PathBuf), AssetError> {
        let mut files = Memory::default();
        files.insert("scene.xml", scene(&PLAIN).into_bytes());
        Ok((Loader::default().files(files), "scene.xml".into()))
    }

    fn read(&self, _: &str) -> Result<Arc<[u8]>, AssetError> {
        Err("there is none".into())
    }
}

fn make(randomization: &str) -> Result<Env, EnvError> {
    let mut registry = Registry::default();
    let table = format!(
        "suite = 'test'\n['varied-v0']\ntask = 'reach'\nmax_episode_steps = 5\nmodel_path = 'scene.xml'\n\
        robot_site_name = 'tip'\ntarget_site_name = 'target'\n\
        target_xyz_range = {{ low = [0.1, 0, 0.5], high = [0.1, 0, 0.5] }}\n{randomization}"
    );
    registry.add_table(&table).unwrap();
    Env::build(registry.spec("varied-v0")?, &Scene, &Options::default())
}

fn varied(entries: &str) -> Result<Env, EnvError> {
    make(&format!("[varied-v0.physics_randomization]\n{entries}"))
}

fn numbers(model: &Model) -> Vec<(String, Vec<f64>)> {
    let mut all = Vec::new();
    model.visit(&mut |name, _, values| all.push((name.to_string(), values.to_f64())));
    model.stat.visit(&mut |name, values| all.push((format!("stat.{name}"), values.to_f64())));
    model.opt.visit(&mut |name, values| all.push((format!("opt.{name}"), values.to_f64())));
    all
}

#[test]
fn a_drawn_model_is_the_one_that_the_compiler_makes_of_its_numbers() {
    let mut env = varied(CHANGES).unwrap();
    env.reset(Some(3)).unwrap();
    let mut compiled = mjcf::load_str(scene(&CHANGED)).unwrap().model;
    // What the compiler alone knows: the pose that the text gives a free body, and the target that the task moves.
    let site = compiled.site("target").unwrap();
    compiled.edit(|m| m.site_pos[site] = env.scene().model.site_pos[site]).unwrap();
    let mut compared = 0;
    for ((name, drawn), (_, compiled)) in numbers(&env.scene().model).into_iter().zip(numbers(&compiled)) {
        let far = |(a, b): (&f64, &f64)| (a - b).abs() > 1e-12 * (1.0 + a.abs().max(b.abs()));
        let wrong = drawn.iter().zip(&compiled).position(far);
        assert!(wrong.is_none() && drawn.len() == compiled.len(), "{name}: {drawn:?}, compiled {compiled:?}");
        compared += drawn.len();
    }
    assert!(compared > 1000);
    let plain = mjcf::load_str(scene(&PLAIN)).unwrap().model;
    for name in
        ["body_subtreemass", "dof_invweight0", "body_invweight0", "geom_rbound", "geom_aabb", "dof_M0"]
    {
        let of = |model: &Model| numbers(model).into_iter().find(|(known, _)| known == name).unwrap().1;
        assert_ne!(of(&env.scene().model), of(&plain), "{name} follows");
    }
}

#[test]
fn a_grown_body_starts_as_high_as_its_lowest_point_needs() {
    let start = |entries: &str, body: &str| {
        let mut env = varied(entries).unwrap();
        env.reset(Some(1)).unwrap();
        let model = &env.scene().model;
        let joint = model.body_jntadr[model.body(body).unwrap()];
        env.scene().data.state.qpos[model.jnt_qposadr[joint as usize] as usize + 2]
    };
    let (plain, grown) = (start("", "ball"), start(CHANGES, "ball"));
    assert!((grown - plain - 0.25 * 0.05).abs() < 1e-12, "{plain} {grown}");
    let (plain, grown) = (start("", "hammer"), start(CHANGES, "hammer"));
    assert!((grown - plain - 0.5 * 0.03).abs() < 1e-12, "{plain} {grown}");
}

const RANGES: &str = "
masses = [{ factor = { low = [0.5], high = [2] } }]
friction = [{ factor = { low = [0.5], high = [2] } }]
joints = [{ damping = { low = [0.5], high = [2] } }]
actuators = [{ gain = { low = [0.5], high = [2] }, delay = { low = [0], high = [0.02] } }]
gravity = { low = [-1, -1, -12], high = [1, 1, -8] }
readings = { low = [0], high = [3] }
sizes = [{ bodies = ['ball', 'hammer'], factor = { low = [0.8], high = [1.2] }, keeps = 'mass' }]
layouts = [{ names = ['ball', 'hammer', 'stand'], pos = { low = [-0.5, 0.2], high = [0.5, 0.6] }, distance = 0.25, \
    yaw = { low = [-180], high = [180] } }]
";

fn play(env: &mut Env) -> Vec<f64> {
    let mut seen = Vec::new();
    for step in 0..5 {
        let action: Vec<f64> = (0..3).map(|k| (0.7 * f64::from(step) + f64::from(k)).sin()).collect();
        assert!(env.step(&action).unwrap().fault.is_none());
        seen.extend_from_slice(env.observation());
        seen.extend_from_slice(&env.scene().data.state.qpos);
    }
    seen
}

#[test]
fn every_episode_is_drawn_and_comes_back() {
    let (mut env, made) = (varied(RANGES).unwrap(), varied(RANGES).unwrap());
    assert!(env.mechanics().unwrap().rows().is_empty(), "nothing is drawn before the first reset");
    env.reset(Some(5)).unwrap();
    let (drawn, saved) = (env.mechanics().unwrap().clone(), env.state());
    let memory = env.memory(&made);
    let mut fork = env.fork().unwrap();
    let motion = play(&mut env);
    assert_eq!(play(&mut fork), motion, "a clone moves the same");
    env.reset(None).unwrap();
    assert_ne!(env.mechanics().unwrap(), &drawn);
    let next = (env.mechanics().unwrap().clone(), play(&mut env));
    assert_ne!(next.1, motion);
    env.reset(Some(5)).unwrap();
    assert_eq!(
        (env.mechanics().unwrap().clone(), play(&mut env)),
        (drawn.clone(), motion.clone()),
        "the seed decides"
    );
    env.set_state(&saved).unwrap();
    assert_eq!((env.mechanics().unwrap().clone(), play(&mut env)), (drawn.clone(), motion.clone()));
    env.reset(None).unwrap();
    assert_eq!((env.mechanics().unwrap().clone(), play(&mut env)), next, "draws go on from where they were");
    let mut other = varied(RANGES).unwrap();
    other.set_memory(memory).unwrap();
    assert_eq!((other.mechanics().unwrap().clone(), play(&mut other)), (drawn.clone(), motion.clone()));
    other.reset(None).unwrap();
    assert_eq!((other.mechanics().unwrap().clone(), play(&mut other)), next);

    env.set_state(&saved).unwrap();
    let model = numbers(&env.scene().model);
    other.set_mechanics(&drawn).unwrap();
    other.set_world(&env.world()).unwrap();
    for ((name, shown), (_, recorded)) in numbers(&other.scene().model).into_iter().zip(model) {
        assert_eq!(shown, recorded, "{name} comes back");
    }
    let error = make("").unwrap().set_mechanics(&drawn).unwrap_err().to_string();
    assert!(error.contains("physics_randomization"), "{error}");
}

#[test]
fn environments_of_a_batch_draw_as_single_ones_do() {
    let env = varied(RANGES).unwrap();
    for threads in [1, 2] {
        let mut envs = VecEnv::new(&env, 3, Autoreset::Disabled, threads).unwrap();
        envs.reset(Some(5)).unwrap();
        let actions = vec![0.3; 9];
        let rows = envs.step(&actions).unwrap().to_vec();
        for (seed, (own, row)) in (5..).zip(envs.envs().zip(rows.chunks(rows.len() / 3))) {
            let mut single = varied(RANGES).unwrap();
            single.reset(Some(seed)).unwrap();
            single.step(&actions[..3]).unwrap();
            assert_eq!((own.mechanics(), row), (single.mechanics(), single.observation()));
        }
    }
}

#[test]
fn things_keep_their_distance() {
    let mut env = varied(RANGES).unwrap();
    for seed in 0..50 {
        env.reset(Some(seed)).unwrap();
        let place = |name: &str| {
            let model = &env.scene().model;
            let body = model.body(name).unwrap();
            env.scene().data.kin.xpos[body.index()]
        };
        let places = ["ball", "hammer", "stand"].map(place);
        for (k, a) in places.iter().enumerate() {
            assert!((-0.5..0.5).contains(&a[0]) && (0.2..0.6).contains(&a[1]), "{a:?}");
            for b in &places[k + 1..] {
                assert!((a[0] - b[0]).hypot(a[1] - b[1]) >= 0.25, "{places:?}");
            }
        }
    }
    let narrow = RANGES.replace("distance = 0.25", "distance = 2.5");
    let error = varied(&narrow).unwrap().reset(Some(0)).unwrap_err().to_string();
    assert!(error.contains("/pos found no place 2.5 m"), "{error}");
}

#[test]
fn nothing_changes_where_nothing_is_asked() {
    let (mut plain, mut empty) = (make("").unwrap(), varied("").unwrap());
    assert!(plain.mechanics().is_none());
    plain.reset(Some(4)).unwrap();
    empty.reset(Some(4)).unwrap();
    assert_eq!(numbers(&plain.scene().model), numbers(&empty.scene().model));
    assert_eq!(play(&mut plain), play(&mut empty));
}

#[test]
fn wrong_ranges_and_names_are_refused() {
    let factor = "factor = { low = [1], high = [2] }";
    for (case, text) in [
        (
            format!("masses = [{{ names = ['balk'], {factor} }}]"),
            "masses of physics_randomization names the body balk, which the model does not have; did you mean ball? (there are world, \
             stand, arm, finger, ball, hammer)",
        ),
        ("masses = [{ factor = { low = [0], high = [2] } }]".into(), "within 0.001 and 1000"),
        ("masses = [{ factor = { low = [3], high = [2] } }]".into(), "low not above high"),
        ("mases = []".into(), "did you mean masses?"),
        ("friction = [{ factor = { low = [nan], high = [1] } }]".into(), "friction factor"),
        (
            "actuators = [{ names = ['servo'], delay = { low = [0], high = [0.01] } }]".into(),
            "give it nsample in the model",
        ),
        ("actuators = [{ delay = { low = [0], high = [0.03] } }]".into(), "within 0 and 0.02"),
        (
            "sensors = [{ names = ['now'], delay = { low = [0], high = [0.01] } }]".into(),
            "sensors delay of physics_randomization names the sensor \"now\"",
        ),
        ("readings = { low = [0.5], high = [1] }".into(), "whole time steps"),
        (format!("sizes = [{{ {factor} }}]"), "names of geoms, or of bodies"),
        (format!("sizes = [{{ names = ['table'], {factor} }}]"), "is no sphere"),
        (format!("sizes = [{{ bodies = ['arm'], {factor} }}]"), "other bodies hang on"),
        (format!("sizes = [{{ names = ['ball'], keeps = 'size', {factor} }}]"), "keeps"),
        ("layouts = [{ names = ['ball', 'finger'], distance = 0.1 }]".into(), "pos is missing"),
        (
            "layouts = [{ names = ['ball', 'finger'], pos = { low = [0, 0], high = [1, 1] }, distance = 0.1 }]".into(),
            "hang on one body",
        ),
        ("layouts = [{ names = ['world'] }]".into(), "the world has no place"),
    ] {
        let error = varied(&case).err();
        let error = error.unwrap_or_else(|| panic!("{case} is accepted")).to_string();
        assert!(error.contains(text), "{case}: {error}");
    }
}
