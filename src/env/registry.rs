//! Every id, from the tables in `registry/`, and every task by its name.
//!
//! ```
//! use robohive_env::{Env, Options, OwnModels, Registry};
//!
//! let mut registry = Registry::builtin().clone();
//! let id = registry.register_variant("hive/ElbowPose-v0", &"frame_skip = 5".parse()?, None)?;
//! assert_eq!(id, "hive/ElbowPose-v0-frame_skip_5");
//! let env = registry.make(&id, &OwnModels, &Options::default())?;
//! assert_eq!(env.frame_skip(), 5);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

use crate::arguments::Arguments;
use crate::error::EnvError;
use crate::spec::Spec;
use crate::suite;
use crate::task::{Setup, Task};
use crate::task_type::TaskType;
use crate::twins::twin;
use physics::model::Suggestions;
use serde::de::DeserializeOwned;
use std::collections::HashMap;
use std::sync::LazyLock;
use toml::Table;

/// The tables, one for each suite: its name, then one row an id. A row names its task, model and settings, or the id that it
/// varies (`from`) and what differs. A rule under `variants` adds a variant of every row whose id begins like `from` and ends
/// like `to`: `from = "myo*"` and `to = "myoSarc*"` make `myoSarcLegWalk-v0` of `myoLegWalk-v0`.
const TABLES: [&str; 17] = [
    include_str!("registry/hive.toml"),
    include_str!("registry/arms.toml"),
    include_str!("registry/classical.toml"),
    include_str!("registry/claws.toml"),
    include_str!("registry/dclaw.toml"),
    include_str!("registry/deformable.toml"),
    include_str!("registry/fm.toml"),
    include_str!("registry/hands.toml"),
    include_str!("registry/in_hand.toml"),
    include_str!("registry/locomotion.toml"),
    include_str!("registry/multi_agent.toml"),
    include_str!("registry/multitask.toml"),
    include_str!("registry/myobase.toml"),
    include_str!("registry/myochallenge.toml"),
    include_str!("registry/myodm.toml"),
    include_str!("registry/quadrupeds.toml"),
    include_str!("registry/tabletop.toml"),
];

/// Tables of ids on models that neither come with this crate nor are imported: a setting names the model.
const GUESTS: [&str; 1] = [include_str!("registry/gymnasium.toml")];

static BUILTIN: LazyLock<Registry> = LazyLock::new(|| {
    const FORM: &str = "the built-in tables are well formed, which a test checks";
    let (mut registry, mut guests) = (Registry::default(), Registry::default());
    TABLES.iter().for_each(|table| registry.add_table(table).expect(FORM));
    let twins: Vec<Spec> = registry.specs.iter().filter_map(twin).collect();
    twins.into_iter().for_each(|spec| registry.register(spec));
    GUESTS.iter().for_each(|table| guests.add_table(table).expect(FORM));
    registry.guests = guests.specs;
    registry
});

/// Ids and what they stand for, and the tasks that they name.
#[derive(Clone, Debug)]
pub struct Registry {
    specs: Vec<Spec>,
    by_id: HashMap<String, usize>,
    guests: Vec<Spec>,
    tasks: Vec<TaskType>,
}

impl Default for Registry {
    /// No environments, and every task of this crate.
    fn default() -> Self {
        Registry { specs: Vec::new(), by_id: HashMap::new(), guests: Vec::new(), tasks: suite::tasks() }
    }
}

impl Registry {
    /// The environments that come with this crate.
    pub fn builtin() -> &'static Registry {
        &BUILTIN
    }

    /// Every environment, in order of registration.
    pub fn specs(&self) -> &[Spec] {
        &self.specs
    }

    /// Environments on models of other packages, whose setting `model_path` names the user's copy. They can be made as all
    /// others, and are not among [`Registry::specs`], which run without settings.
    pub fn guests(&self) -> &[Spec] {
        &self.guests
    }

    /// What an id stands for.
    ///
    /// # Errors
    /// There is no such id; the nearest is named.
    pub fn spec(&self, id: &str) -> Result<&Spec, EnvError> {
        let all = || self.specs.iter().chain(&self.guests);
        let unknown = || EnvError::UnknownId {
            id: id.into(),
            nearest: Suggestions::default()
                .nearest(id, all().map(|spec| spec.id.as_str()))
                .map(str::to_owned),
        };
        let listed = self.by_id.get(id).map(|&index| &self.specs[index]);
        listed.or_else(|| self.guests.iter().find(|spec| spec.id == id)).ok_or_else(unknown)
    }

    /// Adds an environment, or replaces the one of the same id.
    pub fn register(&mut self, spec: Spec) {
        match self.by_id.get(&spec.id) {
            Some(&index) => self.specs[index] = spec,
            None => {
                self.by_id.insert(spec.id.clone(), self.specs.len());
                self.specs.push(spec);
            }
        }
    }

    /// Adds an environment that differs from `base` in some settings, and returns its id: `id`, or the base's with the
    /// changed settings appended.
    ///
    /// # Errors
    /// There is no `base`; a setting is wrong.
    pub fn register_variant(
        &mut self,
        base: &str,
        changes: &Arguments,
        id: Option<&str>,
    ) -> Result<String, EnvError> {
        let mut spec = self.spec(base)?.with(changes)?;
        spec.id = id.map_or_else(|| variant_id(base, changes), Into::into);
        let id = spec.id.clone();
        self.register(spec);
        Ok(id)
    }

    /// Adds a task under a name that specifications may use, or replaces the one of that name. `build` makes it from those
    /// settings of an id that not every environment understands, as whatever type it takes them, and from the world.
    /// [`Registry::make`] makes environments of this registry.
    ///
    /// ```
    /// use robohive_env::{Defaults, EnvError, Options, OwnModels, Registry, Rows, Setup, Task, Verdict, View};
    ///
    /// #[derive(serde::Deserialize)]
    /// #[serde(deny_unknown_fields)]
    /// struct Settings {
    ///     limit: f64,
    /// }
    ///
    /// /// The first joint is to be still.
    /// #[derive(Clone)]
    /// struct Still {
    ///     limit: f64,
    /// }
    ///
    /// impl Still {
    ///     fn new(settings: Settings, _: &mut Setup<'_>) -> Result<Self, EnvError> {
    ///         Ok(Still { limit: settings.limit })
    ///     }
    /// }
    ///
    /// impl Task for Still {
    ///     fn defaults(&self) -> Defaults {
    ///         Defaults::new(&["velocity"], &[("still", 1.0)], 10)
    ///     }
    ///
    ///     fn observe(&self, view: &View<'_>, rows: &mut Rows) {
    ///         rows.set("velocity", "rad/s", [view.data.state.qvel[0]]);
    ///     }
    ///
    ///     fn reward(&self, _: &View<'_>, rows: &Rows, terms: &mut Rows) -> Verdict {
    ///         let speed = rows["velocity"][0].abs();
    ///         terms.set("still", "", [f64::from(speed < self.limit)]);
    ///         Verdict { sparse: -speed, solved: speed < self.limit, done: false }
    ///     }
    /// }
    ///
    /// let mut registry = Registry::default();
    /// registry.add_task("still", Still::new);
    /// registry.add_table(
    ///     "suite = 'mine'
    ///     Still-v0 = { task = 'still', model_path = 'hive/elbow/elbow.xml', max_episode_steps = 100, limit = 0.1 }",
    /// )?;
    /// let mut env = registry.make("Still-v0", &OwnModels, &Options::default())?;
    /// env.reset(Some(1))?;
    /// # Ok::<(), EnvError>(())
    /// ```
    pub fn add_task<S, T>(
        &mut self,
        name: &str,
        build: impl Fn(S, &mut Setup<'_>) -> Result<T, EnvError> + Send + Sync + 'static,
    ) where
        S: DeserializeOwned,
        T: Task + 'static,
    {
        let task = TaskType::new(name, build);
        match self.tasks.iter_mut().find(|known| known.name() == name) {
            Some(known) => *known = task,
            None => self.tasks.push(task),
        }
    }

    /// The task of a specification.
    ///
    /// # Errors
    /// There is no task of that name; those that exist are named.
    pub(crate) fn task(&self, spec: &Spec) -> Result<&TaskType, EnvError> {
        self.tasks.iter().find(|task| task.name() == spec.task).ok_or_else(|| {
            let names: Vec<_> = self.tasks.iter().map(TaskType::name).collect();
            spec.wrong(format!("there is no task {}; there are {}", spec.task, names.join(", ")))
        })
    }

    /// Adds every row of a table.
    ///
    /// # Errors
    /// The table is malformed; a row lacks its task or varies an id that is unknown.
    pub fn add_table(&mut self, text: &str) -> Result<(), EnvError> {
        self.read_table(text).map_err(|message| EnvError::Table { message })
    }

    fn read_table(&mut self, text: &str) -> Result<(), String> {
        let mut table: Table = text.parse().map_err(|error| format!("{error}"))?;
        let suite =
            table.remove("suite").and_then(|suite| suite.as_str().map(String::from)).ok_or("no suite")?;
        let rules = table.remove("variants").map_or(Ok(Vec::new()), Rule::read)?;
        let mut specs = Vec::new();
        for (id, row) in table {
            let toml::Value::Table(row) = row else { return Err(format!("{id} is no table")) };
            let spec = self.row(&suite, &id, row).map_err(|error| format!("{id}: {error}"))?;
            specs.push(spec.clone());
            self.register(spec);
        }
        for rule in &rules {
            for spec in &specs {
                if let Some(id) = rule.id(&spec.id) {
                    let variant = spec.with(&rule.changes).map_err(|error| error.to_string())?;
                    self.register(Spec { id, ..variant });
                }
            }
        }
        Ok(())
    }

    fn row(&self, suite: &str, id: &str, mut row: Table) -> Result<Spec, String> {
        let mut spec = match row.remove("from") {
            Some(base) => {
                self.spec(base.as_str().unwrap_or_default()).map_err(|error| error.to_string())?.clone()
            }
            None => {
                let task =
                    row.remove("task").and_then(|task| task.as_str().map(String::from)).ok_or("no task")?;
                Spec {
                    id: id.into(),
                    suite: suite.into(),
                    task,
                    max_episode_steps: 0,
                    args: Arguments::default(),
                }
            }
        };
        spec.id = id.into();
        spec.suite = suite.into();
        spec = spec.with(&Arguments(row)).map_err(|error| error.to_string())?;
        if spec.max_episode_steps == 0 { Err("no max_episode_steps".into()) } else { Ok(spec) }
    }
}

/// A rule that varies many rows in the same way.
struct Rule {
    /// How ids of the rows begin.
    from: String,
    /// How ids of the variants begin instead.
    to: String,
    changes: Arguments,
}

impl Rule {
    fn read(rules: toml::Value) -> Result<Vec<Rule>, String> {
        let toml::Value::Array(rules) = rules else { return Err("variants are an array of tables".into()) };
        rules.into_iter().map(Self::read_one).collect()
    }

    fn read_one(rule: toml::Value) -> Result<Rule, String> {
        let toml::Value::Table(mut changes) = rule else { return Err("a variant is a table".into()) };
        let mut beginning = |key: &str| {
            let pattern = changes.remove(key);
            let pattern = pattern.as_ref().and_then(|pattern| pattern.as_str());
            pattern
                .and_then(|pattern| pattern.strip_suffix('*'))
                .map(String::from)
                .ok_or_else(|| format!("`{key}` of a variant is the beginning of an id and a `*`"))
        };
        let (from, to) = (beginning("from")?, beginning("to")?);
        Ok(Rule { from, to, changes: Arguments(changes) })
    }

    /// The id of the variant of `id`; `None` where the rule is for others.
    fn id(&self, id: &str) -> Option<String> {
        Some(format!("{}{}", self.to, id.strip_prefix(&self.from)?))
    }
}

/// The id of a variant: `base-key_value`, one pair for each setting that differs.
fn variant_id(base: &str, changes: &Arguments) -> String {
    let text = |value: &toml::Value| value.as_str().map_or_else(|| value.to_string(), String::from);
    changes.0.iter().fold(base.to_string(), |id, (key, value)| format!("{id}-{key}_{}", text(value)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_builtin_tables_are_well_formed() {
        let mut registry = Registry::default();
        for table in TABLES.iter().chain(&GUESTS) {
            registry.add_table(table).unwrap();
        }
        assert!(registry.spec("FrankaReachFixed-v0").is_ok());
    }

    #[test]
    fn rules_vary_every_row_that_they_fit() {
        let text = "suite = 's'
            variants = [{ from = 'a*', to = 'aWeak*', gain = 0.5 }]
            ab-v0 = { task = 't', max_episode_steps = 5, model_path = 'a.xml' }
            b-v0 = { from = 'ab-v0', max_episode_steps = 7 }";
        let mut registry = Registry::default();
        registry.add_table(text).unwrap();
        let ids: Vec<_> = registry.specs().iter().map(|spec| spec.id.as_str()).collect();
        assert_eq!(ids, ["ab-v0", "b-v0", "aWeakb-v0"]);
        let weak = registry.spec("aWeakb-v0").unwrap();
        assert_eq!((weak.max_episode_steps, weak.args.0["gain"].as_float()), (5, Some(0.5)));
        let error = registry
            .add_table("suite = 's'\nvariants = [{ from = 'a', to = 'b*' }]")
            .unwrap_err()
            .to_string();
        assert!(error.contains("`from`") && error.contains("`*`"), "{error}");
    }

    #[test]
    fn an_unknown_id_names_the_nearest() {
        let error = Registry::builtin().spec("FrankaReachFixed-v1").unwrap_err().to_string();
        assert!(error.contains("FrankaReachFixed-v0"), "{error}");
    }

    #[test]
    fn variants_are_named_after_what_differs() {
        let mut registry = Registry::builtin().clone();
        let id = registry
            .register_variant("FrankaReachFixed-v0", &"frame_skip = 20".parse().unwrap(), None)
            .unwrap();
        assert_eq!(id, "FrankaReachFixed-v0-frame_skip_20");
        assert_eq!(registry.spec(&id).unwrap().args.0["frame_skip"].as_integer(), Some(20));
    }
}
