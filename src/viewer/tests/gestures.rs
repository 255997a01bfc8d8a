//! Gestures do what they do in MuJoCo's viewer: `validation/reference/gestures.py` records it.

use physics::math::distance;
use physics::{Data, Model, forward};
use render::scene::{Camera, FreeCamera, SceneOptions};
use robohive_viewer::{Grip, Hand, Plane, orbit, pan, pick, zoom};
use serde_json::Value;
use std::path::Path;

/// Poses of eyes are rounded to single precision.
const SINGLE: f64 = 1e-5;

struct Record {
    model: Model,
    data: Data,
    camera: FreeCamera,
    recorded: Value,
}

fn records() -> Vec<Record> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let text = std::fs::read_to_string(root.join("src/viewer/tests/gestures.json")).unwrap();
    let all: Vec<Value> = serde_json::from_str(&text).unwrap();
    all.into_iter()
        .map(|recorded| {
            let name = recorded["model"].as_str().unwrap();
            let loaded = if name.starts_with('<') {
                mjcf::load_str(name)
            } else {
                mjcf::load(root.join("assets").join(name))
            };
            let model = loaded.unwrap().model;
            let mut data = Data::new(&model);
            data.state.qpos.copy_from_slice(&numbers(&recorded["qpos"]));
            data.state.qvel.copy_from_slice(&numbers(&recorded["qvel"]));
            let (pos, quat) = mocap(&recorded["mocap"]);
            data.state.mocap_pos.as_flattened_mut().copy_from_slice(&pos);
            data.state.mocap_quat.as_flattened_mut().copy_from_slice(&quat);
            forward(&model, &mut data).unwrap();
            let orthographic = recorded["orthographic"].as_bool().unwrap();
            let mut camera = FreeCamera { orthographic, ..FreeCamera::of(&model) };
            if orthographic {
                camera.fovy = 1.5 * model.stat.extent;
            }
            Record { model, data, camera, recorded }
        })
        .collect()
}

fn numbers(value: &Value) -> Vec<f64> {
    value.as_array().unwrap().iter().map(|x| x.as_f64().unwrap()).collect()
}

fn triple(value: &Value) -> [f64; 3] {
    numbers(value).try_into().unwrap()
}

fn pair(value: &Value) -> [f64; 2] {
    numbers(value).try_into().unwrap()
}

/// Positions and orientations of mocap bodies.
fn mocap(value: &Value) -> (Vec<f64>, Vec<f64>) {
    let all = numbers(value);
    let (pos, quat) = all.split_at(all.len() / 7 * 3);
    (pos.to_vec(), quat.to_vec())
}

/// Largest difference, in units of the largest number or 1.
fn difference(a: &[f64], b: &[f64]) -> f64 {
    assert_eq!(a.len(), b.len());
    let size = b.iter().fold(1.0, |size: f64, x| size.max(x.abs()));
    a.iter().zip(b).map(|(x, y)| (x - y).abs() / size).fold(0.0, f64::max)
}

#[test]
fn cameras_move_as_in_mujoco() {
    for Record { model, mut camera, recorded, .. } in records() {
        for row in recorded["moves"].as_array().unwrap() {
            let drag = pair(&row["drag"]);
            match row["look"].as_str().unwrap() {
                "orbit" => orbit(&mut camera, drag),
                "pan vertical" => pan(&mut camera, Plane::Vertical, drag),
                "pan horizontal" => pan(&mut camera, Plane::Horizontal, drag),
                // A drag downwards comes nearer.
                "zoom" => zoom(&mut camera, &model, -drag[1]),
                other => panic!("{other}"),
            }
            let [x, y, z] = camera.lookat;
            let now = [x, y, z, camera.distance, camera.azimuth, camera.elevation];
            let worst = difference(&now, &numbers(&row["camera"]));
            assert!(worst < SINGLE, "{} {row}: {now:?}", recorded["model"]);
        }
    }
}

#[test]
fn geoms_are_picked_as_in_mujoco() {
    let (mut met, mut missed) = (0, 0);
    for Record { model, data, camera, recorded } in records() {
        let view = Camera::Free(camera).view(&model, &data).unwrap();
        for row in recorded["picks"].as_array().unwrap() {
            let found = pick(&model, &data, &view, &SceneOptions::default(), 16.0 / 9.0, pair(&row["at"]));
            let geom = found.map_or(-1, |picked| picked.geom as i64);
            assert_eq!(geom, row["geom"].as_i64().unwrap(), "{} {row}", recorded["model"]);
            let Some(picked) = found else {
                missed += 1;
                continue;
            };
            assert_eq!(picked.body as i64, row["body"].as_i64().unwrap());
            assert!(distance(picked.point, triple(&row["point"])) < SINGLE * model.stat.extent);
            met += 1;
        }
    }
    assert!(met > 200 && missed > 20, "{met} met, {missed} missed");
}

#[test]
fn bodies_are_pulled_turned_and_placed_as_in_mujoco() {
    let (mut placed, mut worst) = (0, 0.0_f64);
    for Record { model, data, camera, recorded } in records() {
        let view = Camera::Free(camera).view(&model, &data).unwrap();
        for row in recorded["pulls"].as_array().unwrap() {
            let (name, body) = (row["grip"].as_str().unwrap(), row["body"].as_u64().unwrap() as usize);
            let grip = if name.starts_with("pull") { Grip::Pull } else { Grip::Turn };
            let plane = if name.ends_with("vertical") { Plane::Vertical } else { Plane::Horizontal };
            let mut hand = Hand::grab(&model, &data, &view, grip, body, triple(&row["point"])).unwrap();
            for drag in row["drags"].as_array().unwrap() {
                hand.drag(&model, &data, &view, plane, pair(drag));
            }
            let wrench = hand.wrench(&model, &data).concat();
            worst = worst.max(difference(&wrench, &numbers(&row["wrench"])));
            let mut state = data.clone();
            let changed = hand.place(&model, &mut state, true);
            let qpos = numbers(&row["qpos"]);
            let (pos, quat) = mocap(&row["mocap"]);
            assert_eq!(changed, !qpos.is_empty() || model.body_mocapid[body] >= 0, "{row}");
            if !qpos.is_empty() {
                worst = worst.max(difference(&state.state.qpos, &qpos));
            }
            worst = worst.max(difference(state.state.mocap_pos.as_flattened(), &pos));
            worst = worst.max(difference(state.state.mocap_quat.as_flattened(), &quat));
            placed += usize::from(changed);
        }
    }
    assert!(worst < SINGLE, "{worst:e}");
    assert!(placed > 30, "{placed} bodies were placed");
}
