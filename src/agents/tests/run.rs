//! Runs in folders: what an interruption changes, what the files hold, and what is refused.

use agents::learn::{Algorithm, Fit, Lessons, Settings, Teaching};
use agents::run::{COLUMNS, Config, Run};
use agents::{Policy, PolicyError};
use env::{Env, Options, OwnModels};
use robohive_agents as agents;
use std::path::{Path, PathBuf};

const ID: &str = "hive/myoElbowPose1D6MRandom-v0";

/// A soft actor-critic that forgets: with room for nine of its episodes.
fn sac() -> Settings {
    let mut settings = Settings::sac();
    let Algorithm::Sac(sac) = &mut settings.algorithm else { panic!("soft actor-critic") };
    (sac.remembered, sac.begin) = (909, 500);
    settings.fit = Fit { epochs: 4, batch: 32, ..settings.fit };
    settings
}

fn env(id: &str) -> Env {
    Env::make(id, &OwnModels, &Options::default()).unwrap()
}

fn folder(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    _ = std::fs::remove_dir_all(&folder);
    folder
}

/// A small training, with a teacher where there is something to learn from one.
fn config(mut learning: Settings) -> Config {
    (learning.episodes, learning.hidden) = (4, [vec![8, 8], vec![8]]);
    let lessons = Lessons { episodes: 2, noise: 0.1 };
    let teaching = Teaching { by: "muscle_pose".into(), lessons };
    let teacher = learning.algorithm.needs_demonstrations().then_some(teaching);
    Config { seed: 3, iterations: 4, keep_every: 2, teacher, ..Config::new(ID, learning) }
}

/// The log without the times.
fn rows(folder: &Path) -> Vec<String> {
    let text = std::fs::read_to_string(folder.join("log.csv")).unwrap();
    text.lines().map(|line| line.rsplit_once(',').unwrap().0.to_owned()).collect()
}

/// Wall times \[s\] of the events, and what else they hold: all but the time of the iteration, which is last, and checksums.
fn events(folder: &Path) -> (Vec<f64>, Vec<Vec<u8>>) {
    let file = bytes(folder, "events.out.tfevents.robohive");
    let (mut rest, mut times, mut contents) = (&file[..], Vec::new(), Vec::new());
    while let Some((length, framed)) = rest.split_first_chunk() {
        let (event, after) = framed[4..].split_at(u64::from_le_bytes(*length) as usize);
        match event.strip_prefix(&[0x09]).and_then(|event| event.split_first_chunk()) {
            Some((time, scalars)) => {
                times.push(f64::from_le_bytes(*time));
                contents.push(scalars[..scalars.len() - 4].into());
            }
            None => contents.push(event.into()),
        }
        rest = &after[4..];
    }
    (times, contents)
}

fn bytes(folder: &Path, file: &str) -> Vec<u8> {
    std::fs::read(folder.join(file)).unwrap()
}

/// Three iterations, of which the third comes after the last checkpoint, and then a process that ends.
#[test]
fn an_interrupted_run_ends_in_the_same_bits() {
    for (name, learning) in [
        ("npg", Settings::npg()),
        ("ppo", Settings::ppo()),
        ("bc", Settings::cloning()),
        ("dagger", Settings::dagger()),
        ("dapg", Settings::dapg()),
        ("sac", sac()),
    ] {
        let (whole, parts) = (folder(&format!("{name}_whole")), folder(&format!("{name}_parts")));
        let mut run = Run::create(&whole, config(learning.clone()), &env(ID), 1, |_| ()).unwrap();
        while !run.is_finished() {
            run.iterate().unwrap();
        }
        let mut run = Run::create(&parts, config(learning), &env(ID), 2, |_| ()).unwrap();
        (0..3).for_each(|_| _ = run.iterate().unwrap());
        drop(run);
        assert_eq!(rows(&parts).len(), 4, "a header and three rows");
        let mut run = Run::resume(&parts, &env(ID), 2).unwrap();
        assert_eq!(run.iterations(), 2);
        while !run.is_finished() {
            let row = run.iterate().unwrap();
            assert!(row.get("kl_dist") > 0.0 && row.get("stoc_pol_std") > 0.0, "{row:?}");
        }
        for file in ["checkpoint.safetensors", "policy.safetensors", "run.toml"] {
            assert!(bytes(&whole, file) == bytes(&parts, file), "{name}: {file}");
        }
        assert_eq!(rows(&whole), rows(&parts));
        assert_eq!(rows(&whole)[0].split(',').count() + 1, COLUMNS.len());
        let (times, contents) = events(&parts);
        assert!(contents.len() == 5 && contents == events(&whole).1, "a version and four iterations");
        let mut taken = 0.0;
        for (time, row) in times.iter().zip(Run::rows_of(&parts).unwrap()) {
            taken += row.get("time");
            assert_eq!(*time, taken);
        }
        let lines = std::fs::read_to_string(parts.join("log.jsonl")).unwrap();
        assert!(
            lines.lines().count() == 4 && lines.lines().all(|line| line.contains("\"success_percentage\":"))
        );
    }
}

#[test]
fn the_policy_of_a_run_acts_as_it_did_in_training() {
    let place = folder("acts");
    let mut run = Run::create(&place, config(Settings::npg()), &env(ID), 1, |_| ()).unwrap();
    run.iterate().unwrap();
    run.keep().unwrap();
    let mut env = env(ID);
    env.reset(Some(1)).unwrap();
    let actions = [run.policy(), place.join("checkpoint.safetensors")].map(|file| {
        let mut action = vec![0.0; env.action_len()];
        Policy::open(file).unwrap().action(&env, &mut action).unwrap();
        action
    });
    assert_eq!(actions[0], actions[1], "a checkpoint is a policy too");
    assert!(actions[0].iter().any(|value| *value != 0.0));
    let Policy::Trained(trained) = Policy::open(run.policy()).unwrap() else { panic!("a trained policy") };
    let Algorithm::Npg(npg) = trained.card().settings.algorithm else { panic!("by NPG") };
    assert!(
        trained.card().teacher.is_none()
            && npg.step == 0.1
            && trained.card().iterations == 1
            && trained.card().samples > 0
    );
    let other = self::env("hive/FrankaReach-v0");
    let error = Policy::open(run.policy()).unwrap().action(&other, &mut vec![0.0; other.action_len()]);
    assert!(error.unwrap_err().to_string().contains("trained on hive/myoElbowPose1D6MRandom-v0"));
}

#[test]
fn what_is_no_run_is_refused() {
    let place = folder("refused");
    let says = |error: PolicyError| error.to_string();
    let resumed = |place: &Path, id: &str| Run::resume(place, &env(id), 1).map(drop).map_err(says);
    assert!(resumed(&place, ID).unwrap_err().contains("run.toml"));
    let mut run = Run::create(&place, config(Settings::ppo()), &env(ID), 1, |_| ()).unwrap();
    run.keep().unwrap();
    let again = Run::create(&place, config(Settings::ppo()), &env(ID), 1, |_| ()).map(drop).map_err(says);
    assert!(again.unwrap_err().contains("not empty"));
    let single = Settings { fit: Fit { batch: 1, ..sac().fit }, ..sac() };
    let why = Run::create(&folder("single"), config(single), &env(ID), 1, |_| ()).map(drop).map_err(says);
    assert!(why.unwrap_err().contains("fit.batch must be at least 2 for sac"));
    for (algorithm, by, why) in [
        (Settings::cloning(), None, "learn from a teacher: name a controller"),
        (Settings::ppo(), Some("muscle_pose"), "only bc, dagger and dapg learn from a teacher"),
        (Settings::dagger(), Some("nobody"), "nobody is no controller"),
        (Settings::dagger(), Some("trot"), "trot"),
    ] {
        let lessons = Lessons { episodes: 2, noise: 0.1 };
        let teacher = by.map(|by| Teaching { by: by.into(), lessons });
        let (place, config) = (folder("taught"), Config { teacher, ..config(algorithm) });
        let refused = Run::create(&place, config, &env(ID), 1, |_| ()).map(drop).map_err(says).unwrap_err();
        assert!(refused.contains(why) && !place.exists(), "{refused}");
    }
    assert!(resumed(&place, "hive/ElbowPose-v0").unwrap_err().contains("it was trained on hive/myoElbow"));
    let text = std::fs::read_to_string(place.join("run.toml")).unwrap();
    for (from, to) in [("seed = 3", "seed = 4"), ("gamma = 0.97", "gamma = 0.9")] {
        std::fs::write(place.join("run.toml"), text.replace(from, to)).unwrap();
        assert!(resumed(&place, ID).unwrap_err().contains("differs from the checkpoint's"), "{to}");
    }
    std::fs::write(place.join("run.toml"), &text).unwrap();
    run.iterate().unwrap();
    run.keep().unwrap();
    let log = std::fs::read_to_string(place.join("log.csv")).unwrap();
    std::fs::write(place.join("log.csv"), format!("{}\n", log.lines().next().unwrap())).unwrap();
    assert!(resumed(&place, ID).unwrap_err().contains("it has 0 rows, and the checkpoint is of iteration 1"));
    std::fs::write(place.join("log.csv"), &log[1..]).unwrap();
    assert!(resumed(&place, ID).unwrap_err().contains("does not name the columns"));
    assert_eq!(Run::iterations_of(&place).unwrap(), 1);
    let file = place.join("checkpoint.safetensors");
    let whole = std::fs::read(&file).unwrap();
    for (bytes, why) in [
        (&whole[..4], "failed to fill"),
        (&whole[..20], "header"),
        (&[255; 20], "header is longer than any"),
        (b"\x02\0\0\0\0\0\0\0{}", "metadata have no \"robohive\""),
    ] {
        std::fs::write(&file, bytes).unwrap();
        let says = Run::iterations_of(&place).unwrap_err().to_string();
        assert!(says.contains(why), "{says}");
    }
    std::fs::write(&file, whole).unwrap();
    let whole = std::fs::read(&file).unwrap();
    for cut in [0, 7, 9, 200, whole.len() - 1] {
        std::fs::write(&file, &whole[..cut]).unwrap();
        let why = resumed(&place, ID).unwrap_err();
        assert!(
            why.contains("checkpoint.safetensors") && why.contains("no safetensors file"),
            "{cut}: {why}"
        );
    }
    let policy = bytes(&place, "policy.safetensors");
    std::fs::write(&file, policy).unwrap();
    assert!(resumed(&place, ID).unwrap_err().contains("has no tensor \"values.layers.0.weight\""));
    for (from, to, why) in [
        ("gamma = 0.97", "gamma = 1.97", "horizon.gamma must be from 0 to 1, and is 1.97"),
        ("gamma = 0.97", "gama = 0.97", "unknown field `gama`"),
        ("[8, 8]", "[8, 0]", "hidden layers must be 1 to 4096 wide, and one is 0"),
    ] {
        assert!(text.contains(from), "{text}");
        std::fs::write(place.join("run.toml"), text.replace(from, to)).unwrap();
        let error = Run::config_of(&place).map_err(says).unwrap_err();
        assert!(error.contains(why) && error.contains("run.toml"), "{error}");
    }
}

#[test]
fn settings_change_by_their_paths() {
    let plain = config(Settings::npg());
    let changed = plain.with("learning.fit.rate", "0.25").unwrap();
    assert_eq!(changed.learning.fit.rate, 0.25);
    assert_eq!(changed.with("learning.fit.rate", "1e-3").unwrap(), plain);
    assert_eq!(plain.with("learning.hidden", "[[4], [2, 2]]").unwrap().learning.hidden[1], [2, 2]);
    assert_eq!(plain.with("id", "hive/FrankaReach-v0").unwrap().id, "hive/FrankaReach-v0");
    let wide = plain.with("environment.target.low", "[0, 1]").unwrap();
    assert_eq!(wide.settings().unwrap()["environment.target.low"], "[0, 1]");
    assert_eq!(plain.settings().unwrap()["learning.fit.rate"], "0.001");
    for (key, value, why) in [
        ("learning.fit.rte", "1", "there is no \"rte\" among epochs, batch, rate, longest"),
        ("", "1", "there is no \"\" among id, seed"),
        ("environment.", "1", "there is no \"\" among"),
        ("seed.low", "1", "seed is 3, and has no settings of its own"),
        ("learning.episodes", "many", "invalid type: string \"many\", expected u64"),
        ("learning.fit.rate", "-1", "fit.rate must be above 0, and is -1"),
    ] {
        let error = plain.with(key, value).unwrap_err().to_string();
        assert!(error.contains(&format!("the setting {key}: ")) && error.contains(why), "{error}");
    }
}
