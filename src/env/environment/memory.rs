//! What an environment remembers, in a form that another process can take over: it goes on to the last bit.

use super::env::Env;
use crate::error::EnvError;
use crate::scene::Scene;
use physics::Snapshot;
use physics::table::Slice;
use robot::Keeper;

/// Numbers of a model that differ from those that the environment was made with, by name.
type Edits = Vec<(String, Vec<f64>)>;

/// All that decides the rest of an episode and the ones after it, beside how the environment was made.
///
/// [`EnvState`](crate::EnvState) is the same within a process, cheaper. State that another engine keeps besides,
/// such as impulses for warm starts, is not included: that engine then starts cold.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct EnvMemory {
    /// Arrays of the model that differ from a newly made environment's.
    pub edits: Edits,
    /// State of physics, robot, task and draws, and the last observation.
    pub words: Vec<u64>,
}

impl Env {
    /// What it remembers; `made` is an environment made in the same way, from which its model may differ by now.
    pub fn memory(&mut self, made: &Env) -> EnvMemory {
        let mut edits = Vec::new();
        let before = numbers(&made.scene);
        for ((name, now), (_, before)) in numbers(&self.scene).into_iter().zip(before) {
            if now.iter().map(|x| x.to_bits()).ne(before.iter().map(|x| x.to_bits())) {
                edits.push((name, now));
            }
        }
        let mut keeper = Keeper::writer();
        self.keep(&mut keeper);
        EnvMemory { edits, words: keeper.words() }
    }

    /// Goes on from what another environment remembered that was made in the same way.
    ///
    /// # Errors
    /// The memory is one of another environment, which leaves this one in no useful state.
    pub fn set_memory(&mut self, memory: EnvMemory) -> Result<(), EnvError> {
        let foreign = |message: String| EnvError::ForeignState { message };
        let EnvMemory { edits, words } = memory;
        let mut unknown = None;
        self.scene.overwrite(|m| {
            for (name, values) in &edits {
                let fits = match name.split_once('.') {
                    Some(("stat", name)) => m.stat.assign(name, values),
                    Some(("opt", name)) => m.opt.assign(name, values),
                    _ => m.assign(name, values),
                };
                if fits != Some(true) {
                    unknown = Some(name.clone());
                }
            }
        })?;
        if let Some(name) = unknown {
            return Err(foreign(format!("{name} of the model has another size here")));
        }
        let mut keeper = Keeper::reader(words);
        self.keep(&mut keeper);
        keeper.finish().map_err(|error| foreign(error.to_string()))?;
        let mut snapshot = Snapshot::default();
        self.scene.data.save(&mut snapshot);
        self.scene.forward()?;
        self.scene.mover.reset();
        // The pass above moved the solver's start.
        self.scene.data.restore(&snapshot).map_err(|error| foreign(error.to_string()))?;
        self.observe_readings()?;
        self.eyes.close();
        self.gather();
        Ok(())
    }

    /// Writes or reads every part, model aside.
    fn keep(&mut self, keeper: &mut Keeper) {
        keep_state(&mut self.scene, keeper);
        let mut robot = self.robot.memory();
        robot.keep(keeper);
        self.robot.restore(&robot);
        keeper.generator(&mut self.rng);
        self.task.keep(keeper);
        self.randomized.keep(keeper);
        self.rows.keep(keeper);
        self.terms.keep(keeper);
        keeper.number(&mut self.verdict.sparse);
        keeper.flag(&mut self.verdict.solved);
        keeper.flag(&mut self.verdict.done);
        keeper.number(&mut self.dense);
        keeper.count(&mut self.steps);
        keeper.flag(&mut self.faulty);
        keeper.count(&mut self.faults);
    }
}

/// Every number of the model that a reset may write: arrays, statistics and options.
fn numbers(scene: &Scene) -> Edits {
    let mut numbers = Vec::new();
    scene.model.visit(&mut |name, _, values| numbers.push((name.to_string(), values.to_f64())));
    scene.model.stat.visit(&mut |name, values| numbers.push((format!("stat.{name}"), values.to_f64())));
    scene.model.opt.visit(&mut |name, values| numbers.push((format!("opt.{name}"), values.to_f64())));
    numbers
}

fn keep_state(scene: &mut Scene, keeper: &mut Keeper) {
    let Scene { model, data, .. } = scene;
    keeper.number(&mut data.state.time);
    let mut parts: Vec<(&'static str, Vec<f64>)> = Vec::new();
    let mut take = |name, _, values: Slice<'_>| parts.push((name, values.to_f64()));
    data.state.visit(model, &mut take);
    for (name, values) in &mut parts {
        keeper.numbers(values);
        data.state.assign(name, values);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Options, OwnModels};

    #[test]
    fn another_environment_goes_on_to_the_last_bit() {
        for id in ["hive/FrankaReach-v0", "hive/ElbowPose-v0", "hive/QuadrupedWalk-v0"] {
            let options = Options::default();
            let make = || Env::make(id, &OwnModels, &options).unwrap();
            let (mut env, made) = (make(), make());
            env.reset(Some(3)).unwrap();
            let action = vec![0.3; env.action_len()];
            (0..7).for_each(|_| assert!(env.step(&action).unwrap().fault.is_none()));
            let memory = env.memory(&made);
            let mut other = make();
            other.set_memory(memory.clone()).unwrap();
            assert_eq!(other.memory(&made), memory);
            for _ in 0..2 {
                for _ in 0..5 {
                    assert_eq!(env.step(&action).unwrap(), other.step(&action).unwrap());
                    assert_eq!(env.observation(), other.observation());
                }
                assert_eq!(env.reset(None).unwrap(), other.reset(None).unwrap());
            }
        }
    }

    #[test]
    fn the_memory_of_another_environment_is_refused() {
        let options = Options::default();
        let mut arm = Env::make("hive/FrankaReach-v0", &OwnModels, &options).unwrap();
        let mut elbow = Env::make("hive/ElbowPose-v0", &OwnModels, &options).unwrap();
        let made = arm.fork().unwrap();
        let memory = arm.memory(&made);
        let error = elbow.set_memory(memory.clone()).unwrap_err().to_string();
        assert!(error.contains("does not fit"), "{error}");
        let short = EnvMemory { words: memory.words[..10].to_vec(), ..memory };
        assert!(arm.set_memory(short).is_err());
    }
}
