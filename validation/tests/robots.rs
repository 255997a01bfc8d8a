//! Our own robots: published numbers, and roles that their models have.

use env::{Env, Options, OwnModels, Registry, Spec};
use physics::elements::{Element, JointId};
use physics::{Data, Model, forward};
use robohive_validation::robots;
use robot::{Config, ConfigError, Roles};
use std::collections::BTreeMap;

fn load(path: &str) -> Model {
    mjcf::Loader::default().files(assets::Own).load(path).unwrap_or_else(|error| panic!("{error}")).model
}

/// Folders with a `roles.toml`, and what it says.
fn robots_with_roles() -> Vec<(String, Roles)> {
    let folders = assets::paths().filter_map(|path| path.strip_suffix("/roles.toml").map(str::to_owned));
    let read = |folder: String| {
        let file = format!("{folder}/roles.toml");
        let roles =
            Roles::from_toml(assets::text(&file).unwrap(), &file).unwrap_or_else(|error| panic!("{error}"));
        (folder, roles)
    };
    folders.map(read).collect()
}

#[test]
fn published_numbers_hold_or_say_why_not() {
    let rows = robots::measure().unwrap();
    assert!(rows.len() >= 30, "{} rows", rows.len());
    let (table, verdict) = robots::render(&rows);
    assert_eq!(verdict, Ok(()));
    let recorded = include_str!("../results/robots.md");
    assert!(
        recorded.contains(table.trim_end()),
        "results/robots.md is of other robots: write it again\n{table}"
    );
}

/// Every role of every robot is in its model and in its scene; its poses keep within the ranges of its joints, and a legged
/// robot that stands has not fallen.
#[test]
fn roles_are_filled() {
    let robots = robots_with_roles();
    assert!(robots.len() >= 8, "{} robots", robots.len());
    for (folder, roles) in &robots {
        let models = models(folder);
        assert!(!models.is_empty(), "{folder}/roles.toml is of no robot, and no id names it");
        for (name, m) in &models {
            check(roles, m).unwrap_or_else(|error| panic!("{error} ({name})"));
        }
        let Some(hardware) = &roles.hardware else { continue };
        let file = format!("{folder}/{hardware}");
        let text =
            assets::text(&file).unwrap_or_else(|| panic!("{folder}/roles.toml names no file: {hardware}"));
        Config::from_toml(text, &file).unwrap_or_else(|error| panic!("{error}"));
    }
}

/// What is to fill the roles of a folder: the robot and the scene in it; or, of a robot that is built in the scenes of tasks alone, those of the ids that
/// name its roles.
fn models(folder: &str) -> Vec<(String, Model)> {
    if assets::text(&format!("{folder}/robot.xml")).is_some() {
        return ["robot.xml", "scene.xml"]
            .map(|file| (file.into(), load(&format!("{folder}/{file}"))))
            .into();
    }
    let named = |spec: &&Spec| {
        let arm: Option<BTreeMap<String, String>> = spec.args.get("arm");
        arm.is_some_and(|arm| {
            arm.get("roles").is_some_and(|file| *file == format!("hive/{folder}/roles.toml"))
        })
    };
    let made = |spec: &Spec| {
        let env =
            Env::make(&spec.id, &OwnModels, &Options::default()).unwrap_or_else(|error| panic!("{error}"));
        (spec.id.clone(), env.scene().model.clone())
    };
    Registry::builtin().specs().iter().filter(named).map(made).collect()
}

fn check(roles: &Roles, m: &Model) -> Result<(), ConfigError> {
    let body = roles.cast(m, "", "test");
    let root = body.root()?.index();
    roles.head.as_ref().map(|_| body.head()).transpose()?;
    roles.palm.as_ref().map(|_| body.palm()).transpose()?;
    roles.tool.as_ref().map(|_| body.tool()).transpose()?;
    roles.fingertips.as_ref().map(|_| body.fingertips()).transpose()?;
    let feet = roles.feet.as_ref().map(|_| body.feet()).transpose()?.unwrap_or_default();
    for name in roles.poses.keys() {
        let mut d = Data::new(m);
        body.pose(name, &mut d.state.qpos)?;
        for (joint, value) in &roles.poses[name].joints {
            let id = m.id_of(JointId::KIND, joint).unwrap();
            let [low, high] = m.jnt_range[id];
            assert!((low - 1e-3..=high + 1e-3).contains(value), "{}: {joint} of pose {name}", roles.file);
        }
        let Some(fallen) = roles.fallen.filter(|_| name == "stand") else { continue };
        forward(m, &mut d).unwrap();
        let ground = feet.iter().map(|foot| d.kin.site_xpos[foot.index()][2]).fold(f64::INFINITY, f64::min);
        let height = d.kin.xpos[root][2] - ground;
        assert!(height > 1.2 * fallen.height, "{}: stands at {height}, {fallen:?}", roles.file);
        let axes = d.kin.xmat[root];
        let tilt = (0..3).map(|i| axes[6 + i] * roles.up[i]).sum::<f64>().acos();
        assert!(tilt < 0.5 * fallen.tilt, "{}: leans by {tilt}", roles.file);
    }
    Ok(())
}

/// A copy of a robot whose foot was renamed: the error names the role, the task and the place of the role.
#[test]
fn a_missing_foot_is_named_with_its_task() {
    let folder = std::env::temp_dir().join("robohive_missing_foot");
    assets::write(&folder).unwrap();
    let file = folder.join("dkitty/robot.xml");
    let text = std::fs::read_to_string(&file).unwrap().replace("\"A:FLfoot\"", "\"front_left\"");
    std::fs::write(&file, text).unwrap();
    let m = mjcf::load(&file).unwrap().model;
    let roles = Roles::from_toml(assets::text("dkitty/roles.toml").unwrap(), "dkitty/roles.toml").unwrap();
    let error = roles.cast(&m, "", "walk to a target").feet().unwrap_err().to_string();
    assert_eq!(
        error,
        "dkitty/roles.toml:4:1: the model has no site 'A:FLfoot' for the role 'feet', which the task 'walk to a target' \
         needs; did you mean 'A:FRfoot'?"
    );
    std::fs::remove_dir_all(&folder).unwrap();
}
