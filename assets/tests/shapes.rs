//! Every mesh is a closed surface that faces outwards, and robots are drawn with a bounded number of triangles, so that pictures
//! stay fast. The numbers of the READMEs are printed by `-- --nocapture`.

mod measure;

use measure::own;
use physics::model::GeomType;

/// Models, and the triangles that their meshes may have together, copies counted.
const MOST: &[(&str, usize)] = &[
    ("adroit/robot.xml", 10_000),
    ("allegro/robot.xml", 3000),
    ("atlas/robot.xml", 3000),
    ("car/robot.xml", 5500),
    ("darwin/robot.xml", 3000),
    ("dclaw/robot.xml", 6000),
    ("dhand/robot.xml", 3000),
    ("dkitty/robot.xml", 6000),
    ("dmanus/hand.xml", 5000),
    ("fetch/robot.xml", 6000),
    ("hopper/robot.xml", 2500),
    ("kitchen/scene.xml", 14_000),
    ("minicheetah/robot.xml", 3000),
    ("mpl/robot.xml", 3000),
    ("myoarm/robot.xml", 8500),
    ("myoelbow/robot.xml", 8500),
    ("myofinger/robot.xml", 3500),
    ("myohand/robot.xml", 3000),
    ("myolegs/robot.xml", 8500),
    ("panda/robot.xml", 5500),
    ("robotiq/gripper.xml", 4500),
    ("sawyer/robot.xml", 3000),
    ("shadow/robot.xml", 3000),
    ("snake/robot.xml", 4500),
    ("so101/robot.xml", 3000),
    ("spot/robot.xml", 3000),
    ("trifinger/robot.xml", 6000),
];

#[test]
fn meshes_are_closed_and_face_outwards() {
    let meshes: Vec<_> =
        robohive_assets::paths().filter_map(|path| Some((robohive_assets::mesh(&path)?, path))).collect();
    assert!(meshes.len() > 100, "{}", meshes.len());
    for (mesh, path) in meshes {
        assert!(mesh.is_closed() && mesh.volume() > 0.0, "{path}");
    }
}

#[test]
fn few_triangles_draw_a_robot() {
    for (path, most) in MOST {
        let m = own(path);
        let meshes = (0..m.ngeom).filter(|geom| m.geom_type[*geom] == GeomType::Mesh as i32);
        let faces: i32 = meshes.map(|geom| m.mesh_facenum[m.geom_dataid[geom] as usize]).sum();
        println!("{path}: {faces} triangles");
        assert!(faces > 0 && faces as usize <= *most, "{path}: {faces} triangles");
    }
}
