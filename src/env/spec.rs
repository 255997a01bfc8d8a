//! What an id stands for: a task, its settings, and how long an episode lasts.

use crate::arguments::Arguments;
use crate::error::EnvError;
use crate::randomize::{PhysicsRandomization, VisualRandomization};
use physics::model::Suggestions;
use robot::ActionMode;
use serde::Deserialize;
use std::cmp::Ordering;
use toml::{Table, Value};

/// A registered environment.
#[derive(Clone, Debug, PartialEq)]
pub struct Spec {
    /// Its id, as in `FrankaReachRandom-v0`.
    pub id: String,
    /// The suite that it belongs to.
    pub suite: String,
    /// The task, by its name in the registry.
    pub task: String,
    /// Steps after which an episode is truncated.
    pub max_episode_steps: usize,
    /// Settings of the environment and of the task, by RoboHive's names.
    pub args: Arguments,
}

/// The settings that every environment understands.
#[derive(Clone, Debug, Deserialize)]
pub struct Settings {
    /// The model, as the assets name it.
    pub model_path: String,
    /// Replacements in the model's text.
    #[serde(default)]
    pub define: Vec<[String; 2]>,
    /// Bodies moved before the model is compiled: the body, and its new parent.
    #[serde(default)]
    pub reparent: Vec<[String; 2]>,
    /// The robot's configuration, as the assets name it.
    #[serde(default)]
    pub config_path: Option<String>,
    /// Rows of the observation vector.
    #[serde(default, alias = "obs_keys_wt")]
    pub obs_keys: Option<Vec<String>>,
    /// Terms of the dense reward with their weights.
    #[serde(default)]
    pub weighted_reward_keys: Option<Arguments>,
    /// Rows of the proprioception.
    #[serde(default, alias = "proprio_keys_wt")]
    pub proprio_keys: Option<Vec<String>>,
    /// Images of the exteroception.
    #[serde(default)]
    pub visual_keys: Vec<String>,
    /// What changes in the look of the scene from episode to episode.
    #[serde(default)]
    pub visual_randomization: Option<VisualRandomization>,
    /// What changes in the physics of the scene from episode to episode.
    #[serde(default)]
    pub physics_randomization: Option<PhysicsRandomization>,
    /// Which reward a step returns.
    #[serde(default)]
    pub reward_mode: RewardMode,
    /// Time steps of the physics in one step of the environment.
    #[serde(default)]
    pub frame_skip: Option<usize>,
    /// Whether actions are normalised to -1..1.
    #[serde(default = "yes")]
    pub normalize_act: bool,
    /// Bounds of the observation space, which are declared and not enforced.
    #[serde(default = "obs_range")]
    pub obs_range: [f64; 2],
    /// How the robot reads actions.
    #[serde(default = "position")]
    pub act_mode: String,
    /// Scale of the sensor noise that the robot's configuration states.
    #[serde(default)]
    pub noise_scale: f64,
    /// What the robot is called in messages.
    #[serde(default)]
    pub robot_name: Option<String>,
}

/// Which reward a step returns.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum RewardMode {
    /// The weighted sum of all terms.
    #[default]
    Dense,
    /// The sparse reward.
    Sparse,
}

fn yes() -> bool {
    true
}

fn obs_range() -> [f64; 2] {
    [-10.0, 10.0]
}

fn position() -> String {
    "pos".into()
}

/// Names of [`Settings`].
const SETTINGS: [&str; 20] = [
    "model_path",
    "define",
    "reparent",
    "config_path",
    "obs_keys",
    "obs_keys_wt",
    "weighted_reward_keys",
    "proprio_keys",
    "proprio_keys_wt",
    "visual_keys",
    "visual_randomization",
    "physics_randomization",
    "reward_mode",
    "frame_skip",
    "normalize_act",
    "obs_range",
    "act_mode",
    "noise_scale",
    "robot_name",
    "max_episode_steps",
];

/// Most time steps in one step of an environment: a step that takes minutes cannot be interrupted.
pub const MAX_FRAME_SKIP: usize = 10_000;

impl Spec {
    /// The settings that every environment understands, and those that are left for the task.
    ///
    /// # Errors
    /// A setting has a wrong type, or the model is missing.
    pub(crate) fn settings(&self) -> Result<(Settings, Table), EnvError> {
        let (common, own): (Table, Table) =
            self.args.0.clone().into_iter().partition(|(key, _)| SETTINGS.contains(&key.as_str()));
        let settings: Settings =
            common.try_into().map_err(|error: toml::de::Error| self.wrong(one_line(&error)))?;
        settings.check().map_err(|message| self.wrong(message))?;
        Ok((settings, own))
    }

    /// The task's own settings.
    ///
    /// # Errors
    /// A setting is unknown to the task, missing, or of a wrong type.
    pub(crate) fn task_args<T: for<'de> Deserialize<'de>>(&self, own: Table) -> Result<T, EnvError> {
        own.try_into().map_err(|error: toml::de::Error| self.wrong(one_line(&error)))
    }

    /// An error about a setting of this id.
    pub fn wrong(&self, message: impl Into<String>) -> EnvError {
        EnvError::Setting { id: self.id.clone(), message: message.into() }
    }

    /// The same environment with other settings; tables within settings are merged, all else is replaced. The setting
    /// `max_episode_steps` changes the length of an episode.
    ///
    /// # Errors
    /// An episode length that is no positive integer.
    pub fn with(&self, changes: &Arguments) -> Result<Spec, EnvError> {
        let mut spec = self.clone();
        merge(&mut spec.args.0, &changes.0);
        if let Some(steps) = spec.args.0.remove("max_episode_steps") {
            let steps =
                steps.as_integer().and_then(|steps| usize::try_from(steps).ok()).filter(|&steps| steps > 0);
            spec.max_episode_steps = steps.ok_or_else(|| {
                self.wrong("max_episode_steps is the number of steps of an episode, 1 or more")
            })?;
        }
        Ok(spec)
    }
}

impl Settings {
    /// Refuses numbers that mean nothing.
    fn check(&self) -> Result<(), String> {
        let [low, high] = self.obs_range;
        // Not the negation: NaN is in no order.
        if !matches!(low.partial_cmp(&high), Some(Ordering::Less)) {
            return Err(format!("obs_range is two numbers, the lower one first, not [{low:?}, {high:?}]"));
        }
        if self.frame_skip.is_some_and(|steps| !(1..=MAX_FRAME_SKIP).contains(&steps)) {
            return Err(format!(
                "frame_skip is the number of time steps in one step, 1 or more and at most {MAX_FRAME_SKIP}"
            ));
        }
        if !(self.noise_scale >= 0.0 && self.noise_scale.is_finite()) {
            return Err(format!("noise_scale is a finite number, 0 or more, not {:?}", self.noise_scale));
        }
        Ok(())
    }

    /// The weights of the dense reward, where the id gives them.
    ///
    /// # Errors
    /// A weight that is no number: its name.
    pub(crate) fn weights(&self) -> Result<Option<Vec<(String, f64)>>, String> {
        let number = |(key, value): (&String, &Value)| match value {
            Value::Float(weight) if weight.is_finite() => Ok((key.clone(), *weight)),
            Value::Integer(weight) => Ok((key.clone(), *weight as f64)),
            Value::Float(weight) => Err(format!("the weight of {key} is {weight}: weights are finite")),
            _ => Err(format!("the weight of {key} is no number")),
        };
        self.weighted_reward_keys.as_ref().map(|given| given.0.iter().map(number).collect()).transpose()
    }

    /// How the robot reads actions.
    ///
    /// # Errors
    /// A mode that does not exist, with those that do.
    pub(crate) fn action_mode(&self) -> Result<ActionMode, String> {
        self.act_mode.parse().map_err(|_| format!("act_mode is pos, vel or torque, not {}", self.act_mode))
    }
}

/// What is wrong, and in which setting; of names that do not exist, the nearest that does.
fn one_line(error: &toml::de::Error) -> String {
    let text = error.to_string();
    let message = error.message();
    // "unknown field `x`, expected one of `a`, `b`": names stand between backticks.
    let kind = ["unknown field `", "unknown variant `"].iter().find(|kind| message.starts_with(**kind));
    let mut names = message.split('`').skip(1).step_by(2);
    let nearest = kind.and_then(|_| {
        let unknown = names.next()?;
        let near = Suggestions::default().nearest(unknown, names.chain(SETTINGS))?;
        let place = text.trim().strip_prefix(message).unwrap_or_default().trim();
        let place = if place.is_empty() { String::new() } else { format!(" {place}") };
        Some(format!("there is no {unknown}{place}; did you mean {near}?"))
    });
    nearest.unwrap_or_else(|| text.trim().replace('\n', " "))
}

/// Writes `changes` over `base`, table by table.
fn merge(base: &mut Table, changes: &Table) {
    for (key, change) in changes {
        match (base.get_mut(key), change) {
            (Some(Value::Table(old)), Value::Table(new)) => merge(old, new),
            _ => {
                base.insert(key.clone(), change.clone());
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn spec() -> Spec {
        let args = "model_path = 'a.xml'\nfar = 1.0\nrange = { low = 1, high = 2 }".parse().unwrap();
        Spec { id: "a-v0".into(), suite: "a".into(), task: "t".into(), max_episode_steps: 50, args }
    }

    #[test]
    fn settings_are_parted_from_the_tasks_own() {
        let (settings, own) = spec().settings().unwrap();
        assert_eq!(settings.model_path, "a.xml");
        assert_eq!(settings.obs_range, [-10.0, 10.0]);
        assert_eq!(own.keys().collect::<Vec<_>>(), ["far", "range"]);
    }

    #[test]
    fn numbers_that_mean_nothing_are_refused() {
        let wrong = |change: &str| {
            let changed = spec().with(&change.parse().unwrap()).unwrap();
            let checked = changed.settings().and_then(|(settings, _)| {
                settings.weights().map_err(|message| changed.wrong(message)).map(drop)
            });
            checked.unwrap_err().to_string()
        };
        for range in ["[5, -5]", "[nan, 1]", "[0, nan]", "[1, 1]"] {
            assert!(wrong(&format!("obs_range = {range}")).contains("the lower one first"), "{range}");
        }
        for steps in ["0", "10001", "99999999999"] {
            let said = wrong(&format!("frame_skip = {steps}"));
            assert!(said.contains("1 or more and at most 10000"), "{said}");
        }
        assert!(wrong("noise_scale = nan").contains("not NaN"));
        assert!(wrong("noise_scale = -1").contains("0 or more"));
        for weight in ["nan", "inf"] {
            let said = wrong(&format!("weighted_reward_keys = {{ reach = {weight} }}"));
            assert!(said.contains("the weight of reach is"), "{said}");
        }
        assert!(spec().with(&"obs_range = [-inf, inf]".parse().unwrap()).unwrap().settings().is_ok());
    }

    #[derive(Debug, Deserialize)]
    #[serde(deny_unknown_fields)]
    struct Own {
        #[serde(rename = "far")]
        _far: f64,
    }

    #[test]
    fn misspelt_names_are_answered_with_the_nearest() {
        let task = |own: &str| spec().task_args::<Own>(own.parse().unwrap()).unwrap_err().to_string();
        assert!(
            task("far = 1.0\nframe_skips = 3").contains("there is no frame_skips; did you mean frame_skip?")
        );
        assert!(task("fer = 1.0").contains("there is no fer; did you mean far?"));
        assert!(task("far = 1.0\nzzzzzz = 3").contains("unknown field `zzzzzz`, expected `far`"));
        let common = |change: &str| {
            let changed = spec().with(&change.parse().unwrap()).unwrap();
            changed.settings().unwrap_err().to_string()
        };
        let said = common("reward_mode = 'dens'");
        assert!(said.contains("there is no dens in `reward_mode`; did you mean dense?"), "{said}");
        let said = common("visual_randomization = { ligths = [] }");
        assert!(said.contains("did you mean lights?"), "{said}");
        let said = common("physics_randomization = { mases = [] }");
        assert!(said.contains("did you mean masses?"), "{said}");
    }

    #[test]
    fn variants_merge_tables() {
        let changes = "range = { high = 3 }\nmax_episode_steps = 7".parse().unwrap();
        let variant = spec().with(&changes).unwrap();
        assert_eq!(variant.args.0["range"]["low"].as_integer(), Some(1));
        assert_eq!(variant.args.0["range"]["high"].as_integer(), Some(3));
        assert_eq!(variant.max_episode_steps, 7);
        let error = spec().with(&"max_episode_steps = 0".parse().unwrap()).unwrap_err().to_string();
        assert!(error.contains("a-v0") && error.contains("1 or more"), "{error}");
    }
}
