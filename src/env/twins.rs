//! RoboHive's ids on models of our own: the same task, settings and episode, and a model that every machine has.

use crate::pictures::visual::{Encoder, VisualKey};
use crate::spec::Spec;
use std::collections::BTreeMap;
use std::sync::LazyLock;

/// Our files by the paths of those that they stand in for.
static OURS: LazyLock<BTreeMap<String, String>> = LazyLock::new(|| {
    toml::from_str(include_str!("registry/twins.toml"))
        .expect("the built-in table is well formed, which a test checks")
});

/// Settings that name files.
const FILES: [&str; 3] = ["model_path", "config_path", "relief"];

/// The twin of an id on our own model; `None` where we have none for it, and where networks encode its images, since their weights have to
/// be downloaded.
pub(crate) fn twin(spec: &Spec) -> Option<Spec> {
    // Most ids have no images.
    let images: Vec<String> = spec.args.get("visual_keys").unwrap_or_default();
    if images.iter().any(|key| needs_weights(key)) {
        return None;
    }
    let ours = |setting: &str| spec.args.get::<String>(setting).map(|path| OURS.get(&path).cloned());
    let mut twin = Spec { id: format!("hive/{}", spec.id), suite: "hive".into(), ..spec.clone() };
    // Ours come put together: a robot's folder has the arm with its hand.
    twin.args.0.remove("reparent");
    for setting in FILES {
        if let Some(path) = ours(setting) {
            twin.args.0.insert(setting.into(), path?.into());
        }
    }
    Some(twin)
}

fn needs_weights(key: &str) -> bool {
    key.parse::<VisualKey>().is_ok_and(|key| !matches!(key.encoder, Encoder::Flat | Encoder::Image))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Registry;

    #[test]
    fn every_file_of_the_table_is_ours_and_some_id_uses_it() {
        let registry = Registry::builtin();
        for (theirs, ours) in OURS.iter() {
            let path = ours.strip_prefix("hive/").unwrap();
            assert!(assets::text(path).is_some(), "{ours}");
            let names = |spec: &Spec, file: &str| {
                FILES.iter().any(|setting| spec.args.get::<String>(setting).as_deref() == Some(file))
            };
            assert!(registry.specs().iter().any(|spec| names(spec, theirs)), "{theirs}");
            assert!(registry.specs().iter().any(|spec| names(spec, ours)), "{ours}");
        }
    }

    #[test]
    fn twins_differ_in_their_files_alone() {
        let registry = Registry::builtin();
        let (theirs, ours) = (
            registry.spec("FrankaPushRandom-v0").unwrap(),
            registry.spec("hive/FrankaPushRandom-v0").unwrap(),
        );
        assert_eq!(ours.args.get::<String>("model_path").unwrap(), "hive/panda/tasks/push.xml");
        assert_eq!((&ours.task, ours.max_episode_steps), (&theirs.task, theirs.max_episode_steps));
        let rest = |spec: &Spec| {
            let mut args = spec.args.clone();
            FILES.iter().for_each(|setting| _ = args.remove(setting));
            args
        };
        assert_eq!(rest(ours), rest(theirs));
    }
}
