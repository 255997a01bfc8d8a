//! A task of one's own: what is observed, what is rewarded, where episodes start.

use robohive::env::{
    Arguments, AssetError, Assets, Defaults, Episode, Options, Registry, Rows, Setup, Task, Verdict, View,
};
use robohive::mjcf::{Loader, files::Memory};
use robohive::physics::elements::JointId;
use robohive::{Env, EnvError};
use std::path::PathBuf;
use std::sync::Arc;

const CART: &str = "
<mujoco>
  <worldbody>
    <body name='cart'>
      <joint name='rail' type='slide' axis='1 0 0' range='-2 2'/>
      <geom type='box' size='.1 .05 .05' mass='1'/>
      <body name='pole'>
        <joint name='pivot' axis='0 1 0'/>
        <geom type='capsule' fromto='0 0 0 0 0 .6' size='.02' mass='.1'/>
      </body>
    </body>
  </worldbody>
  <actuator><motor name='push' joint='rail' gear='10' ctrlrange='-1 1'/></actuator>
</mujoco>";

/// Where the model comes from.
struct Cart;

impl Assets for Cart {
    fn model(&self, path: &str) -> Result<(Loader, PathBuf), AssetError> {
        let mut files = Memory::default();
        files.insert("cart.xml", CART.as_bytes());
        Ok((Loader::default().files(files), path.into()))
    }

    fn read(&self, path: &str) -> Result<Arc<[u8]>, AssetError> {
        Err(format!("there is no file {path}").into())
    }
}

/// Holds a pole upright on a cart.
#[derive(Clone)]
struct Balance {
    pivot: JointId,
    /// The angle that counts as fallen \[rad\].
    limit: f64,
}

impl Balance {
    fn build(own: Arguments, setup: &mut Setup<'_>) -> Result<Self, EnvError> {
        let names = || setup.scene.model.joint_names().map(|(_, name)| name);
        let pivot =
            setup.scene.model.joint("pivot").ok_or_else(|| EnvError::missing("joint", "pivot", names()))?;
        Ok(Balance { pivot, limit: own.get("limit").unwrap_or(0.5) })
    }
}

impl Task for Balance {
    fn defaults(&self) -> Defaults {
        Defaults::new(&["position", "velocity"], &[("upright", 1.0)], 5)
    }

    fn reset(&mut self, episode: &mut Episode<'_>) -> Result<(), EnvError> {
        let place = episode.scene.model.joint(self.pivot).qpos_range().start;
        episode.start.qpos[place] = episode.rng.uniform(-0.05, 0.05)?;
        Ok(())
    }

    fn observe(&self, view: &View<'_>, rows: &mut Rows) {
        rows.set("position", "m, rad", &view.data.state.qpos);
        rows.set("velocity", "m/s, rad/s", &view.data.state.qvel);
    }

    fn reward(&self, view: &View<'_>, _: &Rows, terms: &mut Rows) -> Verdict {
        let angle = view.data.joint(self.pivot).qpos()[0];
        let upright = angle.abs() < self.limit;
        terms.set("upright", "", [f64::from(upright)]);
        Verdict { sparse: f64::from(upright), solved: upright, done: !upright }
    }
}

/// Steps until the pole falls, under a policy of the observation.
fn balanced(env: &mut Env, policy: impl Fn(&[f64]) -> f64) -> Result<usize, EnvError> {
    env.reset(Some(4))?;
    loop {
        let action = policy(env.observation());
        let step = env.step(&[action])?;
        if step.terminated || step.truncated {
            return Ok(env.steps());
        }
    }
}

/// Makes environments of the task and runs them.
pub fn main() -> Result<(), Box<dyn std::error::Error>> {
    // The task gets a name, ids name the task, the model and settings.
    let mut registry = Registry::default();
    registry.add_task("balance", Balance::build);
    registry.add_table(
        "suite = 'own'
         ['own/Balance-v0']
         task = 'balance'
         max_episode_steps = 200
         model_path = 'cart.xml'
         normalize_act = false
         limit = 0.3",
    )?;
    let mut env = registry.make("own/Balance-v0", &Cart, &Options::default())?;

    let idle = balanced(&mut env, |_| 0.0)?;
    let held = balanced(&mut env, |seen| 2.0 * seen[1] + 0.5 * seen[3] + 0.1 * seen[0] + 0.2 * seen[2])?;
    assert!(idle < 100 && held == 200, "the pole falls after {idle} steps, and is held for {held}");
    Ok(())
}
