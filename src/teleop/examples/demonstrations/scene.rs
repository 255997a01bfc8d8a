//! The scenes: the Franka at its table, with a site on the cube and a target.

use env::{Env, Options, OwnModels, Registry};
use std::error::Error;
use std::path::PathBuf;
use std::sync::atomic::{AtomicUsize, Ordering};

/// What a person is to do.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Task {
    /// The fingertips to a target in the air.
    Reach,
    /// The cube to a target on the table.
    Push,
    /// The cube to a target in the air, where it stays only while it is held.
    PickUp,
}

/// All of them.
pub const TASKS: [Task; 3] = [Task::Reach, Task::Push, Task::PickUp];

impl Task {
    /// Its name.
    pub fn name(self) -> &'static str {
        match self {
            Task::Reach => "reach",
            Task::Push => "push",
            Task::PickUp => "pick up",
        }
    }

    /// Its environment: that of ours, or RoboHive's task of pushing on our scene.
    pub fn env(self, options: &Options) -> Result<Env, Box<dyn Error>> {
        let range = match self {
            Task::Reach => return Ok(Env::make("hive/FrankaReach-v0", &OwnModels, options)?),
            Task::Push => "low = [0.5, -0.12, 0.02], high = [0.62, 0.12, 0.02]",
            Task::PickUp => "low = [0.4, -0.1, 0.15], high = [0.6, 0.25, 0.35]",
        };
        let table = format!(
            "suite = 'demonstrations'\n['franka-v0']\ntask = 'push'\nmax_episode_steps = 1000\nmodel_path = '{}'\n\
            config_path = 'hive/franka/tasks/arm.toml'\nrobot_ndof = 9\nrobot_site_name = 'grasp'\nobject_site_name = 'cube'\n\
            target_site_name = 'target'\ntarget_xyz_range = {{ {range} }}\n",
            model()?.display()
        );
        let mut registry = Registry::default();
        registry.add_table(&table)?;
        let spec = registry.spec("franka-v0")?;
        Ok(Env::build(spec, &OwnModels, options)?)
    }
}

/// The scene with the sites of the task, as a file.
fn model() -> Result<PathBuf, Box<dyn Error>> {
    static FILES: AtomicUsize = AtomicUsize::new(0);
    let scene = assets::text("franka/franka_table.xml").ok_or("the scene is gone")?;
    let cube = "<freejoint name=\"cube\"/>";
    let text = scene.replace(cube, &format!("{cube}<site name=\"cube\" size=\"0.005\"/>")).replace(
        "</worldbody>",
        "<site name=\"target\" pos=\"0.5 0 0.4\" size=\"0.02\" rgba=\"0.1 0.8 0.2 0.6\"/></worldbody>",
    );
    let name = format!(
        "robohive-demonstrations-{}-{}.xml",
        std::process::id(),
        FILES.fetch_add(1, Ordering::Relaxed)
    );
    let path = std::env::temp_dir().join(name);
    std::fs::write(&path, text)?;
    Ok(path)
}
