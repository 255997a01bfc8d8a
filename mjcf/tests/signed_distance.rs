//! Signed distance geoms: surfaces of plugins, octrees of meshes, contacts and rays.

use physics::model::GeomType;
use physics::ray::{Ray, ray_geom};
use physics::{Data, Model, forward, step};
use robohive_mjcf::{Loader, load_str, parse_str};

/// A ring of radii 0.4 and 0.1 that falls on `others`.
fn ring(others: &str) -> String {
    format!(
        "<mujoco><extension><plugin plugin=\"mujoco.sdf.torus\"><instance name=\"ring\"><config key=\"radius1\" value=\".4\"/>\
         <config key=\"radius2\" value=\".1\"/></instance></plugin></extension>\
         <asset><mesh name=\"ring\"><plugin instance=\"ring\"/></mesh></asset><option sdf_initpoints=\"20\" sdf_iterations=\"10\"/>\
         <worldbody>{others}<body pos=\"0 0 1\"><freejoint/><geom name=\"ring\" type=\"sdf\" mesh=\"ring\">\
         <plugin instance=\"ring\"/></geom></body></worldbody></mujoco>"
    )
}

/// A cube of half length 0.3, given in place.
const CUBE: &str = "<mesh name=\"cube\" vertex=\"-.3 -.3 -.3 .3 -.3 -.3 -.3 .3 -.3 .3 .3 -.3 -.3 -.3 .3 .3 -.3 .3 -.3 .3 .3 .3 .3 .3\"/>";

fn data(m: &Model) -> Data {
    let mut d = Data::new(m);
    forward(m, &mut d).unwrap();
    d
}

#[test]
fn the_surface_of_a_plugin_has_its_volume_and_stays_in_its_frame() {
    let text = ring("").replace("<mesh name", "<mesh inertia=\"exact\" name");
    let m = load_str(text).unwrap().model;
    let (radius, tube) = (0.4, 0.1);
    let volume = 2.0 * std::f64::consts::PI.powi(2) * radius * tube * tube;
    let mass = m.body_mass[1] / 1000.0;
    assert!((mass / volume - 1.0).abs() < 2e-3, "{mass} {volume}");
    assert_eq!((m.mesh_pos[0], m.mesh_quat[0]), ([0.0; 3], [1.0, 0.0, 0.0, 0.0]));
    assert_eq!((m.mesh_octadr[0], m.noct), (-1, 0));
    for vertex in &m.mesh_vert[..] {
        let [x, y, z] = vertex.map(f64::from);
        let distance = ((x.hypot(y) - radius).hypot(z) - tube).abs();
        assert!(distance < 2e-4, "{vertex:?}");
    }
}

#[test]
fn an_octree_interpolates_the_distance_and_is_continuous() {
    let text = format!(
        "<mujoco><asset>{CUBE}</asset><worldbody><geom type=\"sdf\" mesh=\"cube\"/></worldbody></mujoco>"
    );
    let m = load_str(&text).unwrap().model;
    assert_eq!((m.mesh_octadr[0], m.mesh_octnum[0] as usize), (0, m.noct));
    assert!(m.noct > 100 && m.oct_depth.iter().all(|&depth| (0..=6).contains(&depth)));
    for cell in (0..m.noct).filter(|&c| m.oct_child[c][0] < 0) {
        for (corner, &found) in m.oct_coeff[cell].iter().enumerate() {
            let p: [f64; 3] = std::array::from_fn(|k| {
                let side = if corner >> k & 1 == 1 { 1.0 } else { -1.0 };
                m.oct_aabb[cell][k] + side * m.oct_aabb[cell][k + 3]
            });
            let beyond = p.map(|x| x.abs() - 0.3);
            let outside = beyond.iter().fold(0.0, |sum: f64, b| sum + b.max(0.0).powi(2)).sqrt();
            let expected = outside + beyond.into_iter().fold(f64::MIN, f64::max).min(0.0);
            // Corners that hang between others have their mean.
            assert!((found - expected).abs() < 0.02, "{p:?}: {found} {expected}");
        }
    }
}

#[test]
fn rings_touch_every_type_of_geom() {
    let mesh = ring("<geom type=\"mesh\" mesh=\"cube\" pos=\"0 0 .65\"/>")
        .replace("<asset>", &format!("<asset>{CUBE}"));
    let octree = ring("<geom type=\"sdf\" mesh=\"cube\" pos=\"0 0 .65\"/>")
        .replace("<asset>", &format!("<asset>{CUBE}"));
    for (text, kind) in [
        (ring("<geom type=\"plane\" size=\"1 1 1\" pos=\"0 0 .91\"/>"), GeomType::Plane),
        (ring("<geom type=\"sphere\" size=\".3\" pos=\".4 0 .65\"/>"), GeomType::Sphere),
        (ring("<geom type=\"capsule\" size=\".1 .3\" pos=\".4 0 .6\"/>"), GeomType::Capsule),
        (ring("<geom type=\"ellipsoid\" size=\".2 .2 .3\" pos=\".4 0 .65\"/>"), GeomType::Ellipsoid),
        (ring("<geom type=\"cylinder\" size=\".2 .3\" pos=\".4 0 .65\"/>"), GeomType::Cylinder),
        (ring("<geom type=\"box\" size=\".3 .3 .3\" pos=\"0 0 .65\"/>"), GeomType::Box),
        (mesh, GeomType::Mesh),
        (octree, GeomType::Sdf),
    ] {
        let m = load_str(&text).unwrap().model;
        assert_eq!(m.geom_type[0], kind.code());
        let d = data(&m);
        assert!(!d.con.contact.is_empty(), "{kind:?}");
        for contact in &d.con.contact {
            // The normal leads to the ring, which lies above.
            assert!(contact.dist <= 0.0 && contact.frame[2] > 0.1, "{kind:?} {contact:?}");
            assert!(contact.dist > -0.15, "{kind:?} {contact:?}");
        }
    }
}

#[test]
fn a_ring_comes_to_rest_on_a_sphere_around_which_it_fits() {
    let text = ring("<geom type=\"sphere\" size=\".5\"/>").replace("pos=\"0 0 1\"", "pos=\"0 0 .45\"");
    let m = load_str(&text).unwrap().model;
    let mut d = Data::new(&m);
    for _ in 0..1000 {
        step(&m, &mut d).unwrap();
    }
    // Where the tube touches: distance of its circle from the centre is 0.6.
    let height = (0.6_f64 * 0.6 - 0.4 * 0.4).sqrt();
    assert!((d.state.qpos[2] - height).abs() < 0.02, "{}", d.state.qpos[2]);
    assert!(d.state.qvel.iter().all(|v| v.abs() < 0.1), "{:?}", d.state.qvel);
}

#[test]
fn rays_end_on_the_surface_of_fields() {
    let m = load_str(ring("")).unwrap().model;
    let d = data(&m);
    let ray = |x: f64| {
        let down = Ray { origin: [x, 0.0, 2.0], direction: [0.0, 0.0, -1.0] };
        ray_geom(&m, &d.kin, 0, down)
    };
    let hit = ray(0.4).unwrap();
    assert!((hit.distance - 0.9).abs() < 1e-6 && hit.normal[2] > 0.999, "{hit:?}");
    assert_eq!(ray(0.0), None, "through the middle");
}

#[test]
fn faulty_distance_geoms_are_refused_in_their_place() {
    let refused = |text: &str| load_str(text).map(|_| ()).expect_err("the model must be refused").to_string();
    let text = ring("");
    for (from, to, expected) in [
        (" mesh=\"ring\"><plugin instance=\"ring\"/>", ">", "a signed distance geom needs a mesh"),
        ("<mesh name=\"ring\">", "<mesh name=\"ring\" scale=\"2 2 2\">", "attribute 'scale' does not apply"),
        ("value=\".4\"", "value=\"wide\"", "attribute 'radius1' is 'wide'"),
        ("value=\".1\"", "value=\"-1\"", "attribute 'radius2' is -1"),
        ("value=\".1\"", "value=\".004\"", "mesh 'ring' has fewer than 4 vertices"),
        ("mesh=\"ring\"><plugin instance=\"ring\"/></geom>", "mesh=\"ring\"/>", "without a plugin"),
    ] {
        let faulty = text.replacen(from, to, 1);
        assert_ne!(faulty, text, "{from}");
        let message = refused(&faulty);
        assert!(message.contains(expected), "{to}: {message}");
    }
}

#[test]
fn distance_geoms_come_back_from_text_and_bytes() {
    let text = ring("<geom type=\"sdf\" mesh=\"cube\"/>").replace("<asset>", &format!("<asset>{CUBE}"));
    let parsed = parse_str(&text).unwrap();
    let written = parsed.spec.to_xml().unwrap();
    let model = Loader::default().compile(parsed).unwrap().model;
    let bytes = model.to_bytes();
    assert!(load_str(&written).unwrap().model.to_bytes() == bytes, "{written}");
    assert!(Model::from_bytes(&bytes).unwrap().to_bytes() == bytes);
    assert!(model.noct > 0);
}
