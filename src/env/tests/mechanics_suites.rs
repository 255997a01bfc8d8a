//! Domain randomisation of physics in every suite: one id of each, by names and ranges that are drawn from what its model has.

use physics::Model;
use physics::model::{GeomType, ObjType};
use robohive_env::{Env, Options, OwnModels, Registry, Rng};
use std::collections::BTreeMap;
use std::fmt::Write;

/// The first id on a model of our own of every suite; those of RoboHive's suites by their twins.
fn ids() -> BTreeMap<String, String> {
    let registry = Registry::builtin();
    let mut ids = BTreeMap::new();
    for spec in registry.specs() {
        let own = spec.args.get("model_path").is_some_and(|path: String| path.starts_with("hive/"));
        let origin = spec.id.strip_prefix("hive/").and_then(|id| registry.spec(id).ok()).unwrap_or(spec);
        if own && !spec.args.contains("visual_keys") {
            ids.entry(origin.suite.clone()).or_insert_with(|| spec.id.clone());
        }
    }
    ids
}

/// Some of the names that elements of a kind have, as `names = [...], `; nothing, which means all, where none has a name.
fn names(model: &Model, kind: ObjType, ids: impl Iterator<Item = usize>, rng: &mut Rng) -> Option<String> {
    let named: Vec<_> = ids.map(|id| model.name_of(kind, id)).filter(|name| !name.is_empty()).collect();
    let count = named.len().min(3);
    let some: Vec<_> = (0..count).map(|_| format!("{:?}", rng.choose(&named).unwrap())).collect();
    (count > 0).then(|| format!("names = [{}], ", some.join(", ")))
}

/// Entries that name what a model has.
fn configuration(model: &Model, seed: u64) -> String {
    let mut rng = Rng::pcg64(seed);
    let mut factor = |key: &str, width: f64| {
        let middle = 1.0 + width * (rng.random() - 0.5);
        format!("{key} = {{ low = [{}], high = [{}] }}", middle - width / 2.0, middle + width / 2.0)
    };
    let [mass, friction, damping, loss, armature, gain, size] = [
        ("factor", 0.2),
        ("factor", 0.2),
        ("damping", 0.5),
        ("frictionloss", 0.5),
        ("armature", 0.5),
        ("gain", 0.3),
        ("factor", 0.01),
    ]
    .map(|(key, width)| factor(key, width));
    let mut rng = Rng::pcg64(seed + 1);
    let mut text = String::new();
    let mut entry = |key: &str, names: Option<String>, ranges: &str| {
        let _ = writeln!(text, "{key} = [{{ {}{ranges} }}]", names.unwrap_or_default());
    };
    let bodies = names(model, ObjType::Body, 1..model.nbody, &mut rng);
    entry("masses", bodies, &mass);
    entry("friction", names(model, ObjType::Geom, 0..model.ngeom, &mut rng), &friction);
    let joints = names(model, ObjType::Joint, 0..model.njnt, &mut rng);
    entry("joints", joints, &format!("{damping}, {loss}, {armature}"));
    entry("actuators", names(model, ObjType::Actuator, 0..model.nactuator, &mut rng), &gain);
    let round = |&geom: &usize| {
        let kind = GeomType::from_code(model.geom_type[geom]);
        matches!(kind, Some(GeomType::Sphere | GeomType::Capsule | GeomType::Box | GeomType::Cylinder))
    };
    if let Some(geoms) = names(model, ObjType::Geom, (0..model.ngeom).filter(round), &mut rng) {
        entry("sizes", Some(geoms), &format!("keeps = 'inertia', {size}"));
    }
    let free = |&body: &usize| model.body_dofnum[body] == 6 && model.body_jntnum[body] == 1;
    if let Some(free) = names(model, ObjType::Body, (1..model.nbody).filter(free), &mut rng) {
        let shift = "shift = { low = [-0.001, -0.001, 0], high = [0.001, 0.001, 0] }";
        entry("layouts", Some(free), &format!("{shift}, yaw = {{ low = [-1], high = [1] }}"));
    }
    text + "gravity = { low = [0, 0, -9.9], high = [0, 0, -9.7] }\nreadings = { low = [0], high = [2] }\n"
}

/// Observations of two episodes under random actions.
fn play(env: &mut Env, seed: u64) -> Vec<u64> {
    let (mut rng, mut action) = (Rng::pcg64(seed), vec![0.0; env.action_len()]);
    let mut seen = Vec::new();
    for seed in [Some(seed), None] {
        env.reset(seed).unwrap();
        for _ in 0..5 {
            env.random_action(&mut rng, &mut action).unwrap();
            let step = env.step(&action).unwrap();
            assert!(step.fault.is_none() && step.reward.is_finite());
            seen.extend(env.observation().iter().map(|x| x.to_bits()));
            if step.terminated {
                break;
            }
        }
    }
    seen
}

#[test]
fn every_suite_takes_what_its_model_has() {
    let ids = ids();
    assert!(ids.len() >= 14, "{ids:?}");
    for (suite, id) in ids {
        let plain = Env::make(&id, &OwnModels, &Options::default()).unwrap();
        let text = configuration(&plain.scene().model, suite.len() as u64);
        let settings = format!("[physics_randomization]\n{text}").parse().unwrap();
        let options = Options::default().with_changes(settings);
        let mut env = Env::make(&id, &OwnModels, &options).unwrap_or_else(|error| panic!("{error}\n{text}"));
        let made = env.fork().unwrap();
        let seen = play(&mut env, 3);
        assert!(env.mechanics().unwrap().values().iter().all(|value| value.is_finite()), "{id}");
        let gravity = env.mechanics().unwrap()["option/gravity"].to_vec();
        assert_eq!(env.scene().model.opt.gravity.to_vec(), gravity, "{id}");
        let (saved, memory) = (env.state(), env.memory(&made));
        let next = play(&mut env, 4);
        assert_eq!(play(&mut env, 3), seen, "{id}: the seed decides\n{text}");
        env.set_state(&saved).unwrap();
        assert_eq!(play(&mut env, 4), next, "{id}: a saved state goes on\n{text}");
        let mut other = made.fork().unwrap();
        other.set_memory(memory).unwrap();
        assert_eq!(other.mechanics().unwrap()["option/gravity"], gravity, "{id}");
        assert_eq!(play(&mut other, 4), next, "{id}: another one goes on\n{text}");
    }
}
