//! Contacts against closed forms and laws: what two shapes at known places must touch.

use robohive_physics::collision::mixing::contact_frame;
use robohive_physics::collision::{CollisionScratch, PreContact, Shape, box_box, capsule_box, collide};
use robohive_physics::data::{Contact, Contacts, Flexes, Kinematics, StepBudget};
use robohive_physics::math::{
    Mat3, Vec3, cross, distance, dot, norm, quat_from_axis_angle, quat_to_mat, row, sub,
};
use robohive_physics::model::{Arrays, Disable, GeomType, Model};

const UPRIGHT: Mat3 = [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0];

fn shape(m: &Model, kind: GeomType, pos: Vec3, mat: Mat3, size: Vec3) -> Shape<'_> {
    Shape { kind, pos, mat, size, geom: 0, m }
}

fn turned(axis: Vec3, angle: f64) -> Mat3 {
    quat_to_mat(quat_from_axis_angle(axis, angle))
}

/// Spheres on bodies of one tree each, in the world at `pos`.
fn spheres(pos: &[Vec3], radius: f64) -> (Model, Kinematics) {
    let n = pos.len();
    let mut m = Arrays { nbody: n + 1, ngeom: n, nv: n, ..Arrays::default() };
    m.allocate();
    for g in 0..n {
        m.body_weldid[g + 1] = (g + 1) as i32;
        m.body_dofnum[g + 1] = 1;
        (m.body_contype[g + 1], m.body_conaffinity[g + 1]) = (1, 1);
        (m.body_geomadr[g + 1], m.body_geomnum[g + 1]) = (g as i32, 1);
        m.geom_type[g] = GeomType::Sphere.code();
        m.geom_bodyid[g] = (g + 1) as i32;
        (m.geom_contype[g], m.geom_conaffinity[g], m.geom_condim[g]) = (1, 1, 3);
        m.geom_size[g][0] = radius;
        m.geom_rbound[g] = radius;
        m.geom_aabb[g] = [0.0, 0.0, 0.0, radius, radius, radius];
        m.geom_solref[g] = [0.02, 1.0];
        m.geom_friction[g] = [1.0, 0.005, 0.0];
    }
    let m = Model::unchecked(m);
    let mut kin = Kinematics::new(&m);
    kin.geom_xpos.copy_from_slice(pos);
    kin.geom_xmat.fill(UPRIGHT);
    (m, kin)
}

/// Points of a fixed pseudo-random sequence in the unit cube.
fn cloud(n: usize) -> Vec<Vec3> {
    let mut state = 1u64;
    let mut next = || {
        state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (state >> 11) as f64 / (1u64 << 53) as f64
    };
    (0..n).map(|_| [next(), next(), next()]).collect()
}

fn contacts(m: &Model, kin: &Kinematics) -> Vec<Contact> {
    let mut con = Contacts::default();
    let flexes = Flexes::new(m);
    collide(m, kin, &flexes, StepBudget::default(), &mut CollisionScratch::default(), &mut con).unwrap();
    con.contact
}

#[test]
fn broad_phase_finds_what_brute_force_finds() {
    let pos = cloud(60);
    let radius = 0.07;
    let (m, kin) = spheres(&pos, radius);
    let mut expected = Vec::new();
    for a in 0..pos.len() {
        expected
            .extend((a + 1..pos.len()).filter(|&b| distance(pos[a], pos[b]) <= 2.0 * radius).map(|b| (a, b)));
    }
    assert!(expected.len() > 20);
    let found = contacts(&m, &kin);
    let pairs: Vec<_> = found.iter().map(|c| (c.geom[0] as usize, c.geom[1] as usize)).collect();
    assert_eq!(pairs, expected);
    for (c, (a, b)) in found.iter().zip(expected) {
        assert!((c.dist - (distance(pos[a], pos[b]) - 2.0 * radius)).abs() < 1e-15);
        assert!(norm(sub(c.pos, std::array::from_fn(|i| 0.5 * (pos[a][i] + pos[b][i])))) < 1e-15);
    }
}

#[test]
fn contact_types_welds_and_excludes_filter_pairs() {
    let (mut m, kin) = spheres(&[[0.0; 3], [0.1, 0.0, 0.0], [0.0, 0.1, 0.0]], 0.2);
    let pairs = |m: &Model| contacts(m, &kin).iter().map(|c| c.geom).collect::<Vec<_>>();
    assert_eq!(pairs(&m), [[0, 1], [0, 2], [1, 2]]);
    m.unchecked_mut().nexclude = 1;
    m.unchecked_mut().exclude_signature = vec![(1 << 16) + 3].into();
    assert_eq!(pairs(&m), [[0, 1], [1, 2]]);
    m.unchecked_mut().body_weldid[2] = 1;
    assert_eq!(pairs(&m), [[1, 2]]);
    m.unchecked_mut().geom_contype[2] = 2;
    m.unchecked_mut().geom_conaffinity[2] = 2;
    assert!(pairs(&m).is_empty());
}

#[test]
fn parents_do_not_touch_their_children_unless_asked() {
    let (mut m, kin) = spheres(&[[0.0; 3], [0.1, 0.0, 0.0], [0.0, 0.1, 0.0]], 0.2);
    let pairs = |m: &Model| contacts(m, &kin).iter().map(|c| c.geom).collect::<Vec<_>>();
    m.unchecked_mut().body_parentid[2] = 1;
    m.unchecked_mut().body_parentid[3] = 2;
    assert_eq!(pairs(&m), [[0, 2]], "a grandchild does");
    m.options_mut().disableflags |= Disable::FILTERPARENT;
    assert_eq!(pairs(&m), [[0, 1], [0, 2], [1, 2]]);
    // Children of the world, and bodies welded to it, have no parent in this sense.
    m.options_mut().disableflags = Disable::NONE;
    m.unchecked_mut().body_weldid[1] = 0;
    assert_eq!(pairs(&m), [[0, 1], [0, 2]]);
}

#[test]
fn parameters_mix_by_priority_and_weight() {
    let (mut m, kin) = spheres(&[[0.0; 3], [0.1, 0.0, 0.0]], 0.1);
    m.unchecked_mut().geom_solmix = vec![1.0, 3.0].into();
    m.unchecked_mut().geom_solref[1] = [0.06, 3.0];
    m.unchecked_mut().geom_friction[1] = [0.5, 0.01, 0.0];
    m.unchecked_mut().geom_margin = vec![0.01, 0.02].into();
    let c = contacts(&m, &kin)[0];
    assert!((c.solref[0] - 0.05).abs() < 1e-15 && (c.solref[1] - 2.5).abs() < 1e-15);
    assert_eq!(c.friction, [1.0, 1.0, 0.01, 1e-5, 1e-5]);
    assert!((c.includemargin - 0.03).abs() < 1e-15);
    m.unchecked_mut().geom_priority[1] = 1;
    let c = contacts(&m, &kin)[0];
    assert_eq!((c.solref, c.friction[0]), ([0.06, 3.0], 0.5));
}

#[test]
fn frame_is_right_handed_and_keeps_the_normal() {
    for normal in cloud(50).into_iter().map(|p| p.map(|x| x - 0.5)) {
        let f = contact_frame(normal, [0.0; 3]);
        let (x, y, z) = (row(&f, 0), row(&f, 1), row(&f, 2));
        assert!((dot(x, normal) - norm(normal)).abs() < 1e-15);
        assert!(dot(x, y).abs() < 1e-15 && (norm(y) - 1.0).abs() < 1e-15);
        assert!(norm(sub(cross(x, y), z)) < 1e-15);
    }
}

#[test]
fn turned_cube_on_a_cube_touches_in_an_octagon() {
    let m = Model::default();
    let base = shape(&m, GeomType::Box, [0.0; 3], UPRIGHT, [1.0; 3]);
    let angle = std::f64::consts::FRAC_PI_4;
    let top = shape(&m, GeomType::Box, [0.0, 0.0, 1.99], turned([0.0, 0.0, 1.0], angle), [1.0; 3]);
    let mut found = Vec::new();
    box_box::box_box(&base, &top, 0.0, &mut found);
    assert_eq!(found.len(), 8);
    // Vertices of the intersection: one coordinate at a face, the other at tan(22.5 degrees).
    let inner = std::f64::consts::SQRT_2 - 1.0;
    for c in &found {
        let (small, large) = (c.pos[0].abs().min(c.pos[1].abs()), c.pos[0].abs().max(c.pos[1].abs()));
        assert!((small - inner).abs() < 1e-12 && (large - 1.0).abs() < 1e-12);
        assert!((c.dist + 0.01).abs() < 1e-12 && (c.pos[2] - 0.995).abs() < 1e-12);
        assert!(distance(c.normal, [0.0, 0.0, 1.0]) < 1e-12);
    }
}

#[test]
fn crossed_box_edges_touch_in_one_point() {
    let m = Model::default();
    let quarter = std::f64::consts::FRAC_PI_4;
    let a = shape(&m, GeomType::Box, [0.0; 3], turned([1.0, 0.0, 0.0], quarter), [2.0, 0.5, 0.5]);
    let height = 2.0 * 0.5 * std::f64::consts::SQRT_2 - 0.02;
    let b = shape(&m, GeomType::Box, [0.3, 0.2, height], turned([0.0, 1.0, 0.0], quarter), [0.5, 2.0, 0.5]);
    let mut found = Vec::new();
    box_box::box_box(&a, &b, 0.0, &mut found);
    let [c] = found[..] else { panic!("{found:?}") };
    assert!((c.dist + 0.02).abs() < 1e-12);
    assert!(distance(c.pos, [0.3, 0.0, height / 2.0]) < 1e-12);
    assert!(distance(c.normal, [0.0, 0.0, 1.0]) < 1e-12);
}

#[test]
fn exchanged_boxes_see_opposite_normals() {
    let m = Model::default();
    let axis = [0.36, 0.48, 0.8];
    let a = shape(&m, GeomType::Box, [0.0; 3], UPRIGHT, [0.3, 0.4, 0.5]);
    let b = shape(&m, GeomType::Box, [0.4, 0.3, 0.5], turned(axis, 0.7), [0.2, 0.3, 0.4]);
    let run = |p: &Shape, q: &Shape| {
        let mut out: Vec<PreContact> = Vec::new();
        box_box::box_box(p, q, 0.01, &mut out);
        out.sort_by(|x, y| x.dist.total_cmp(&y.dist));
        out
    };
    let (forth, back) = (run(&a, &b), run(&b, &a));
    assert!(!forth.is_empty() && forth.len() == back.len());
    for (f, g) in forth.iter().zip(&back) {
        assert!((f.dist - g.dist).abs() < 1e-12 && distance(f.pos, g.pos) < 1e-12);
        assert!(norm(std::array::from_fn(|i| f.normal[i] + g.normal[i])) < 1e-12);
    }
}

#[test]
fn capsule_lying_on_a_box_touches_at_both_ends_of_the_overlap() {
    let m = Model::default();
    let cuboid = shape(&m, GeomType::Box, [0.0; 3], UPRIGHT, [1.0, 0.5, 0.2]);
    let lying = turned([0.0, 1.0, 0.0], std::f64::consts::FRAC_PI_2);
    let capsule = shape(&m, GeomType::Capsule, [0.6, 0.1, 0.29], lying, [0.1, 0.7, 0.0]);
    let mut found = Vec::new();
    capsule_box::capsule_box(&capsule, &cuboid, 0.0, &mut found);
    let mut ends: Vec<f64> = found.iter().map(|c| c.pos[0]).collect();
    ends.sort_by(f64::total_cmp);
    assert_eq!(ends.len(), 2);
    // From the end over the face to the far edge of the box.
    assert!((ends[0] + 0.1).abs() < 1e-12 && (ends[1] - 1.0).abs() < 1e-12);
    for c in &found {
        assert!((c.dist + 0.01).abs() < 1e-12 && distance(c.normal, [0.0, 0.0, -1.0]) < 1e-12);
    }
}

#[test]
fn spheres_that_just_touch_are_paired_as_in_the_reference() {
    // MuJoCo 3.12 reports one contact at distance zero for each: its sweep keeps pairs whose ends are equal.
    for (x, y, z) in [(-0.5153689779008721, 0.2726042698228307, -0.4108685834429343), (0.0, 0.0, 0.0)] {
        let (m, kin) = spheres(&[[x, y, z], [x, y, z - 0.4]], 0.2);
        assert_eq!(contacts(&m, &kin).iter().map(|c| c.dist).collect::<Vec<_>>(), [0.0]);
    }
}
