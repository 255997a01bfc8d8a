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

/// What RoboHive's model of a hand over a table leaves open, and what ours leaves open besides: an object's name and its file.
const OBJECT: [&str; 2] = ["OBJECT_NAME", "OBJECT_FILE"];

/// The twin of an id on our own model; `None` where we have none for it, and where it needs files that have to be downloaded: weights of
/// networks that encode images, and recorded motions.
pub(crate) fn twin(spec: &Spec) -> Option<Spec> {
    // Most ids have no images.
    let images: Vec<String> = spec.args.get("visual_keys").unwrap_or_default();
    if images.iter().any(|key| needs_weights(key)) || spec.args.get::<String>("reference").is_some() {
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
    // A `define` that is no list of pairs is refused when the environment is made.
    let mut defined: Vec<[String; 2]> = twin.args.get("define").unwrap_or_default();
    if let Some([_, name]) = defined.iter().find(|[from, _]| from == OBJECT[0]) {
        let file = object(name)?;
        defined.push([OBJECT[1].into(), file]);
        let defined: Vec<Vec<String>> = defined.into_iter().map(Vec::from).collect();
        twin.args.0.insert("define".into(), defined.into());
    }
    Some(twin)
}

/// The file of an object of our own, as models of robots name it; `None` where there is none.
fn object(name: &str) -> Option<String> {
    let own = |path: &str| path.starts_with("objects/") && path.ends_with(&format!("/{name}.xml"));
    assets::paths().find(|path| own(path)).map(|path| format!("../../{path}"))
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

    #[test]
    fn twins_with_an_object_name_its_file_and_recorded_motions_have_none() {
        let registry = Registry::builtin();
        let mug = registry.spec("hive/MyoHandMugFixed-v0").unwrap();
        let pairs: Vec<Vec<String>> = mug.args.get("define").unwrap();
        assert_eq!(pairs, [["OBJECT_NAME", "mug"], ["OBJECT_FILE", "../../objects/kitchen/mug.xml"]]);
        assert!(
            registry.spec("MyoHandMugLift-v0").is_ok() && registry.spec("hive/MyoHandMugLift-v0").is_err()
        );
    }
}
