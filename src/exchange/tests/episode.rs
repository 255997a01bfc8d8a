//! Trials of recordings as transitions.

mod folder;

use dataset::trace::{Layout, Precision, Recorder, TraceReader};
use dataset::{Array, Values};
use folder::Folder;
use robohive_exchange::Episode;

type Columns = Vec<(&'static str, Array)>;

/// A recording with one trial of these rows.
fn recording(folder: &Folder, columns: &[(&str, Array)]) -> TraceReader {
    let path = folder.path().join("trace.h5");
    let mut recorder = Recorder::create(&path, Layout::RoboHive, Precision::Full).unwrap();
    let mut trial = recorder.begin("Trial0").unwrap();
    for (key, array) in columns {
        trial.set_series(key, array.clone()).unwrap();
    }
    trial.finish().unwrap();
    recorder.close().unwrap();
    TraceReader::open(&path).unwrap()
}

fn ramp(shape: &[usize]) -> Array {
    Array::f64(shape.to_vec(), (0..shape.iter().product()).map(|i| i as f64).collect())
}

fn done(flags: &[bool]) -> Array {
    Array { shape: vec![flags.len()], values: Values::Bool(flags.to_vec()) }
}

fn columns(flags: &[bool]) -> Columns {
    let rows = flags.len();
    vec![
        ("observations", ramp(&[rows, 2])),
        ("actions", ramp(&[rows, 3])),
        ("rewards", ramp(&[rows])),
        ("done", done(flags)),
        ("time", ramp(&[rows])),
        ("env_infos/solved", ramp(&[rows])),
        ("env_infos/short", ramp(&[rows - 1])),
    ]
}

#[test]
fn rewards_belong_to_the_step_before_their_row() {
    let folder = Folder::new("rewards");
    for (flags, terminated) in [([false, false, false, true], true), ([false; 4], false)] {
        let trace = recording(&folder, &columns(&flags));
        let episode = Episode::of_trial(&trace, "Trial0").unwrap();
        assert_eq!((episode.steps(), episode.observations.rows()), (3, 4));
        assert_eq!(episode.rewards, Array::f64(vec![3], vec![1.0, 2.0, 3.0]));
        assert_eq!(episode.actions, Array::f64(vec![3, 3], (0..9).map(f64::from).collect()));
        assert_eq!(episode.terminations.values, Values::Bool(vec![false, false, terminated]));
        // An episode that did not end was cut off.
        assert_eq!(episode.truncations.values, Values::Bool(vec![false, false, !terminated]));
        assert_eq!(episode.times, [0.0, 1.0, 2.0, 3.0]);
        let infos: Vec<_> = episode.infos.iter().map(|(name, array)| (&name[..], array.rows())).collect();
        assert_eq!(infos, [("solved", 4)]);
        let [(key, why)] = &episode.dropped[..] else { panic!("{:?}", episode.dropped) };
        assert!(key == "env_infos/short" && why.contains("4 rows"), "{key}: {why}");
    }
}

#[test]
fn trials_that_are_no_episodes_are_refused_by_name() {
    let folder = Folder::new("trials");
    let refused = |change: &dyn Fn(&mut Columns), expected: &[&str]| {
        let mut changed = columns(&[false, false, true]);
        change(&mut changed);
        let error = Episode::of_trial(&recording(&folder, &changed), "Trial0").unwrap_err().to_string();
        assert!(expected.iter().all(|part| error.contains(part)), "{error:?} lacks one of {expected:?}");
    };
    refused(&|c| c[1].1 = ramp(&[2, 3]), &["Trial0/actions", "2 rows, where \"observations\" has 3"]);
    refused(&|c| c[2].1 = ramp(&[3, 2]), &["Trial0/rewards", "[3, 2]", "one number"]);
    refused(&|c| c[3].1 = ramp(&[3, 4]), &["Trial0/done", "one number"]);
    refused(&|c| c[4].1 = ramp(&[4]), &["Trial0/time", "4 rows"]);
    let one_row = |c: &mut Columns| {
        *c = vec![("observations", ramp(&[1, 2])), ("actions", ramp(&[1, 3])), ("rewards", ramp(&[1]))];
        c.push(("done", done(&[true])));
    };
    refused(&one_row, &["Trial0/observations", "two are the least"]);
    for missing in ["actions", "rewards", "done"] {
        refused(&|c| c.retain(|(key, _)| *key != missing), &["Trial0"]);
    }
}
