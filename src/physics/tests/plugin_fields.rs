//! The fields of gears, bolts and nuts against MuJoCo 3.12.0's.
//!
//! `plugin_fields.txt` was written by a program around the functions `distance` of MuJoCo's `plugin/sdf/{gear,bolt,nut}.cc`: a line
//! with a plugin and its attributes, then points and values, drawn at random around the parts.

use robohive_physics::plugin::{Config, Registry};

/// Largest difference from MuJoCo's values, in the unit of length.
const TOLERANCE: f64 = 1e-12;

/// The text and the largest difference of each part.
fn differences(table: &str) -> Vec<(&str, f64)> {
    let registry = Registry::default();
    let mut field = None;
    let mut found: Vec<(&str, f64)> = Vec::new();
    for line in table.lines() {
        if line.starts_with("mujoco.") {
            let mut words = line.split(' ');
            let plugin = registry.slot(words.next().unwrap()).and_then(|slot| registry.get(slot)).unwrap();
            let given: Vec<(&str, &str)> = words.map(|word| word.split_once('=').unwrap()).collect();
            let names = plugin.attributes();
            assert!(given.iter().all(|(name, _)| names.contains(name)), "{line}");
            let text = |name: &&str| given.iter().find(|(key, _)| key == name).map_or("", |&(_, text)| text);
            let bytes: String = names.iter().map(|name| format!("{}\0", text(name))).collect();
            field = plugin.field(&Config::new(names, bytes.as_bytes())).unwrap();
            found.push((line, 0.0));
            continue;
        }
        let [x, y, z, expected] = *line.split(' ').map(|x| x.parse().unwrap()).collect::<Vec<f64>>() else {
            panic!("{line}");
        };
        let difference = (field.as_ref().unwrap().distance([x, y, z]) - expected).abs();
        assert!(difference <= TOLERANCE, "{line}: {difference}");
        let largest = &mut found.last_mut().unwrap().1;
        *largest = difference.max(*largest);
    }
    found
}

#[test]
fn fields_agree_with_mujocos() {
    let found = differences(include_str!("plugin_fields.txt"));
    assert_eq!(found.len(), 10);
}
