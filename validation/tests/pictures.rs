//! The measures of pictures beside scikit-image's, on pictures that `reference/pictures.py --measures` made.

use dataset::{NpzReader, Values};
use robohive_validation::pictures::measures::{Geometry, compare_colours, compare_shapes, interior};
use robohive_validation::pictures::plan::Plan;
use robohive_validation::pictures::{Inputs, measure};
use std::collections::BTreeSet;
use std::path::Path;

/// Largest relative difference of a measure.
const TOLERANCE: f64 = 1e-6;

struct Side {
    rgb: Vec<u8>,
    geometry: Geometry,
}

fn side(archive: &NpzReader, name: &str) -> Side {
    let array = |field: &str| archive.require(&format!("{name}/{field}")).expect("an array of the picture");
    let Values::U8(rgb) = array("rgb").values else { panic!("colours are bytes") };
    let width = array("rgb").shape[1];
    let ids = array("ids").values.to_f64();
    let ids = ids.as_chunks::<2>().0.iter().map(|id| id.map(|x| x as i32)).collect();
    let depth = array("depth").values.to_f64().into_iter().map(|x| x as f32).collect();
    Side { rgb, geometry: Geometry { width, depth, ids } }
}

#[test]
fn measures_are_those_of_scikit_image() {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("reference/pictures/measures.npz");
    let archive = NpzReader::open(&file).expect("the recorded measures");
    let (a, b) = (side(&archive, "a"), side(&archive, "b"));
    let width = a.geometry.width;
    assert_ne!(a.rgb, b.rgb, "equal pictures measure nothing");
    let inside = interior(&a.geometry.ids, width);
    let colours = compare_colours(&a.rgb, &b.rgb, width, &inside);
    let shapes = compare_shapes(&a.geometry, &b.geometry, &inside);
    let ours = [
        ("psnr", colours.psnr),
        ("psnr_interior", colours.psnr_interior),
        ("ssim", colours.ssim),
        ("ids", shapes.ids),
        ("ids_interior", shapes.ids_interior),
        ("iou", shapes.iou),
        ("depth_median", shapes.depth_median),
        ("depth_p99", shapes.depth_p99),
    ];
    for (name, ours) in ours {
        let expected = archive.require(&format!("measure/{name}")).expect("a measure").values.to_f64()[0];
        let difference = (ours - expected).abs() / expected.abs();
        assert!(difference <= TOLERANCE, "{name}: {ours}, scikit-image has {expected}");
        assert!(expected != 0.0 && expected != 1.0, "{name} is trivial");
    }
}

#[test]
fn the_scenes_are_listed_once_and_held_to_bars() {
    let plan = Plan::listed().expect("the list of scenes");
    let names: BTreeSet<&str> = plan.scenes.iter().map(|scene| scene.name.as_str()).collect();
    assert_eq!(names.len(), plan.scenes.len(), "a name stands twice");
    for scene in &plan.scenes {
        plan.bars_of(scene).expect("exceptions are bars");
    }
}

#[test]
fn own_models_of_scenes_exist() {
    let plan = Plan::listed().expect("the list of scenes");
    let own: Vec<_> = plan.scenes.iter().filter(|scene| scene.is_own()).collect();
    assert!(own.len() >= 5, "own models are drawn too");
    for scene in own {
        let path = scene.path(None);
        let model = mjcf::load(&path).expect("an own model loads").model;
        let camera = scene.camera.as_deref();
        assert!(
            camera.is_none_or(|name| model.camera(name).is_some()),
            "{} has no camera {camera:?}",
            scene.file
        );
    }
}

#[test]
fn pictures_of_own_models_are_those_of_mujoco() {
    let references = Path::new(env!("CARGO_MANIFEST_DIR")).join("reference/pictures");
    let inputs = Inputs { models: None, references: &references, only: "", other: None, dump: None };
    let (table, verdict) = measure(&inputs).expect("the recorded pictures");
    assert!(table.contains("| franka_table | 84 |"), "nothing was compared:\n{table}");
    assert_eq!(verdict, Ok(()), "{table}");
}
