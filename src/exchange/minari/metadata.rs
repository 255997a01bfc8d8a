//! What `metadata.json` says of a dataset.

use dataset::Dtype;
use serde_json::{Map, Value, json};

/// The version of Minari whose layout is written.
const VERSION: &str = "0.5.4";

/// What a dataset is about.
#[derive(Clone, Debug, Default)]
pub struct About {
    /// Space of the observations, as Minari writes it; see [`box_space`].
    pub observation_space: String,
    /// Space of the actions.
    pub action_space: String,
    /// The environment, as the JSON of Gymnasium's `EnvSpec`.
    pub env_spec: Option<String>,
    /// Further entries, such as `author`, `algorithm_name`, `description`, `requirements`.
    pub more: Map<String, Value>,
}

/// Entries that the writer sets.
const OWN: [&str; 10] = [
    "total_episodes",
    "total_steps",
    "data_format",
    "jpeg_encoding",
    "observation_space",
    "action_space",
    "env_spec",
    "dataset_id",
    "minari_version",
    "dataset_size",
];

impl About {
    /// The entries of a dataset of no episodes.
    ///
    /// # Errors
    /// A further entry is one that the writer sets.
    pub(super) fn entries(&self, id: &str) -> Result<Map<String, Value>, String> {
        if let Some(key) = self.more.keys().find(|key| OWN.contains(&&key[..])) {
            return Err(format!("{key:?} is set by the writer"));
        }
        let mut out = Map::new();
        out.insert("total_episodes".into(), 0.into());
        out.insert("total_steps".into(), 0.into());
        out.insert("data_format".into(), "hdf5".into());
        out.insert("jpeg_encoding".into(), false.into());
        out.insert("observation_space".into(), self.observation_space.clone().into());
        out.insert("action_space".into(), self.action_space.clone().into());
        if let Some(spec) = &self.env_spec {
            out.insert("env_spec".into(), spec.clone().into());
        }
        out.insert("dataset_id".into(), id.into());
        out.insert("minari_version".into(), VERSION.into());
        out.extend(self.more.clone());
        Ok(out)
    }
}

/// The JSON of Gymnasium's `EnvSpec` of an environment of the Python package, by which `recover_environment` makes it. Its
/// episodes end after `steps`.
pub fn env_spec(id: &str, steps: Option<usize>) -> String {
    json!({
        "id": id,
        "entry_point": "robohive.envs:RoboHiveEnv",
        "reward_threshold": null,
        "nondeterministic": false,
        "max_episode_steps": steps,
        "order_enforce": true,
        "disable_env_checker": false,
        "kwargs": { "env_id": id },
        "additional_wrappers": [],
        "vector_entry_point": "robohive.vector:make_vec",
    })
    .to_string()
}

/// The JSON of a box of this shape with the same limits in every direction, as Minari writes spaces.
pub fn box_space(dtype: Dtype, shape: &[usize], limits: (f64, f64)) -> String {
    let bound = |limit: f64| {
        let mut out = match limit {
            // Python's JSON knows these words.
            f64::INFINITY => "Infinity".to_owned(),
            f64::NEG_INFINITY => "-Infinity".to_owned(),
            x if matches!(dtype, Dtype::F16 | Dtype::F32 | Dtype::F64) => format!("{x:?}"),
            x => format!("{x:.0}"),
        };
        for &axis in shape.iter().rev() {
            out = format!("[{}]", vec![out; axis].join(", "));
        }
        out
    };
    let (dtype, shape_text) = (json!(dtype.name()), json!(shape));
    format!(
        "{{\"type\": \"Box\", \"dtype\": {dtype}, \"shape\": {shape_text}, \"low\": {}, \"high\": {}}}",
        bound(limits.0),
        bound(limits.1)
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn limits_are_nested_as_the_shape_is() {
        let text = box_space(Dtype::F64, &[2], (f64::NEG_INFINITY, 1.0));
        assert_eq!(
            text,
            "{\"type\": \"Box\", \"dtype\": \"float64\", \"shape\": [2], \"low\": [-Infinity, -Infinity], \"high\": [1.0, 1.0]}"
        );
        assert!(box_space(Dtype::U8, &[1, 2], (0.0, 255.0)).ends_with("\"high\": [[255, 255]]}"));
    }
}
