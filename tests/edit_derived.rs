//! What an edit derives is what a fresh compile derives: bounds, frames and constants of every array, to the bit.

mod models;

use models::assets;
use robohive::physics::model::{Draft, GeomType};
use robohive::physics::{Model, set_const};

/// A fixed sequence of numbers in the unit interval.
struct Sequence(u64);

impl Sequence {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (self.0 >> 11) as f64 / (1u64 << 53) as f64
    }

    fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.next()
    }

    fn triple(&mut self, low: f64, high: f64) -> String {
        let [x, y, z] = [0; 3].map(|_| self.between(low, high));
        format!("{x} {y} {z}")
    }

    fn one_of<'a>(&mut self, list: &[&'a str]) -> &'a str {
        list[(self.next() * list.len() as f64) as usize]
    }
}

const SHAPES: [&str; 5] = ["sphere", "capsule", "ellipsoid", "cylinder", "box"];

/// Geoms of one body, of any primitive type; some cannot collide.
fn geoms(count: usize, random: &mut Sequence) -> String {
    let geom = |random: &mut Sequence| {
        format!(
            "<geom type='{}' size='{}' pos='{}' euler='{}' margin='{}' gap='{}' contype='{}' conaffinity='{}'/>",
            random.one_of(&SHAPES),
            random.triple(0.02, 0.3),
            random.triple(-0.5, 0.5),
            random.triple(-90.0, 90.0),
            random.between(0.0, 0.01),
            random.between(0.0, 0.02),
            random.one_of(&["0", "1", "2"]),
            random.one_of(&["0", "1"]),
        )
    };
    (0..count).map(|_| geom(random)).collect()
}

/// Bodies with geoms, sites, cameras, lights, tendons and welds whose numbers follow from the seed.
fn scene(seed: u64) -> Model {
    let random = &mut Sequence(seed);
    let mut bodies = String::new();
    for b in 0..6 {
        let joint = ["<freejoint/>", "<joint axis='0 1 0'/>", "", "<joint type='ball'/>"][b % 4];
        bodies += &format!(
            "<body name='b{b}' pos='{}' euler='{}'>{joint}
               <inertial pos='.1 0 .2' mass='1' diaginertia='.1 .2 .15'/>{}
               <geom name='w{b}' type='sphere' size='{}' contype='0' conaffinity='0' pos='{}'/>
               <site name='s{b}' pos='{}'/><site name='t{b}' pos='{}'/>
               <camera pos='{}' mode='{}'/><light pos='{}' dir='1 0 -1'/>
               <body pos='{}'><joint axis='1 0 0'/><inertial pos='0 0 .1' mass='2' diaginertia='.1 .1 .1'/>{}</body>
             </body>",
            random.triple(-1.0, 1.0),
            random.triple(-90.0, 90.0),
            geoms(b, random),
            random.between(0.02, 0.05),
            random.triple(-0.1, 0.1),
            random.triple(0.2, 0.5),
            random.triple(-0.5, -0.2),
            random.triple(-1.0, 1.0),
            ["fixed", "track", "trackcom"][b % 3],
            random.triple(-1.0, 1.0),
            random.triple(-0.3, 0.3),
            geoms(2, random),
        );
    }
    let text = format!(
        "<mujoco><worldbody>{}{bodies}</worldbody>
         <tendon><spatial name='t' springlength='.5'><site site='s1'/><geom geom='w2'/><site site='s2'/><site site='t3'/></spatial></tendon>
         <equality><connect body1='b0' body2='b1' anchor='.1 .2 .3'/></equality>
         <actuator><general tendon='t'/><position site='s4' refsite='t5' kp='10' gear='1 2 3 0 0 0'/></actuator>
         </mujoco>",
        geoms(7, random),
    );
    robohive::mjcf::load_str(&text).unwrap().model
}

/// What the numbers of a text set directly in the scenes above.
const WRITTEN: [&str; 16] = [
    "geom_type",
    "geom_size",
    "geom_pos",
    "geom_quat",
    "geom_margin",
    "geom_gap",
    "geom_contype",
    "geom_conaffinity",
    "body_pos",
    "body_quat",
    "site_pos",
    "site_quat",
    "cam_pos",
    "light_pos",
    "qpos0",
    "qpos_spring",
];

/// The numbers of an array.
fn numbers(m: &Model, array: &str) -> Vec<f64> {
    let mut found = Vec::new();
    m.visit(&mut |name, _, values| {
        if name == array {
            found = values.to_f64();
        }
    });
    found
}

/// Names of the arrays in which two models differ.
fn differences(a: &Model, b: &Model) -> Vec<&'static str> {
    let all = |m: &Model| {
        let mut all = Vec::new();
        m.visit(&mut |name, shape, values| all.push((name, shape, values.to_f64())));
        all
    };
    all(a).into_iter().zip(all(b)).filter(|(a, b)| a != b).map(|(a, _)| a.0).collect()
}

#[test]
fn edited_into_another_text_a_model_equals_that_text_compiled() {
    let mut resized = 0;
    for seed in 0..40 {
        let (mut m, other) = (scene(2 * seed + 1), scene(2 * seed + 2));
        let before = differences(&m, &other);
        for array in ["geom_rbound", "geom_aabb", "bvh_aabb", "body_margin", "tendon_length0", "cam_pos0"] {
            assert!(before.contains(&array), "{seed}: {array} does not depend on the seed");
        }
        resized += usize::from(m.nbvh != other.nbvh);
        m.edit(|m| {
            WRITTEN.iter().for_each(|array| assert_eq!(m.assign(array, &numbers(&other, array)), Some(true)))
        })
        .unwrap();
        assert_eq!(differences(&m, &other), Vec::<&str>::new(), "{seed}");
        assert!(m.to_bytes() == other.to_bytes(), "{seed}");
    }
    assert!(resized > 10, "only {resized} pairs differ in the number of nodes");
}

#[test]
fn one_array_after_the_other_gives_the_same() {
    for seed in 100..110 {
        let (mut m, other) = (scene(2 * seed + 1), scene(2 * seed + 2));
        for array in WRITTEN {
            m.edit(|m| assert_eq!(m.assign(array, &numbers(&other, array)), Some(true))).unwrap();
        }
        assert!(m.to_bytes() == other.to_bytes(), "{seed}: {:?}", differences(&m, &other));
    }
}

/// Geoms whose shape is a formula of their size.
fn is_primitive(code: i32) -> bool {
    let primitive =
        [GeomType::Sphere, GeomType::Capsule, GeomType::Ellipsoid, GeomType::Cylinder, GeomType::Box];
    primitive.iter().any(|kind| kind.code() == code)
}

/// Other types and sizes for primitive geoms, other poses, margins and contact types for all that have bounds.
fn distort(m: &mut Draft<'_>, random: &mut Sequence) {
    for g in 0..m.ngeom {
        if m.geom_type[g] == GeomType::Plane.code() {
            continue;
        }
        if is_primitive(m.geom_type[g]) {
            m.geom_type[g] = GeomType::Sphere.code() + (random.next() * 5.0) as i32;
            m.geom_size[g] = [0; 3].map(|_| random.between(0.01, 0.3));
        }
        m.geom_pos[g] = [0; 3].map(|_| random.between(-1.0, 1.0));
        m.geom_margin[g] = random.between(0.0, 0.1);
        m.geom_contype[g] = (random.next() * 4.0) as i32;
        m.geom_conaffinity[g] = (random.next() * 4.0) as i32;
    }
}

#[test]
fn own_models_distorted_and_restored_are_as_compiled() {
    for (name, compiled) in assets() {
        let mut m = compiled.clone();
        m.edit(|m| distort(m, &mut Sequence(7))).unwrap();
        let changed = differences(&m, &compiled);
        assert!(["geom_aabb", "geom_rbound"].iter().all(|a| changed.contains(a)), "{name}");
        let moves = m.geom_bodyid.iter().any(|&body| body > 0);
        assert!(!moves || changed.contains(&"body_contype"), "{name}");
        let arrays =
            ["geom_type", "geom_size", "geom_pos", "geom_margin", "geom_contype", "geom_conaffinity"];
        m.edit(|m| arrays.iter().for_each(|a| assert_eq!(m.assign(a, &numbers(&compiled, a)), Some(true))))
            .unwrap();
        assert!(m.to_bytes() == compiled.to_bytes(), "{name}: {:?}", differences(&m, &compiled));
    }
}

/// Whatever array an edit writes, all constants follow: recomputing them changes nothing.
#[test]
fn an_edited_model_is_complete() {
    let mut edited = 0;
    let scenes = (0..3).map(|seed| (format!("scene {seed}"), scene(seed)));
    for (name, compiled) in assets().into_iter().chain(scenes) {
        let mut arrays = Vec::new();
        compiled.visit(&mut |array, _, values| arrays.push((array, values.to_f64(), values.is_float())));
        let numeric = arrays.iter().filter(|(_, values, float)| *float && !values.is_empty());
        for (array, values, _) in numeric {
            let (mut m, mut values) = (compiled.clone(), values.clone());
            for at in [values.len() / 3, values.len() - 1] {
                values[at] = 1.25 * values[at] + 0.01;
            }
            if m.edit(|m| assert_eq!(m.assign(array, &values), Some(true))).is_err() {
                continue;
            }
            let mut again = m.clone();
            set_const(&mut again).unwrap();
            assert_eq!(differences(&again, &m), Vec::<&str>::new(), "{name}: {array}");
            let given = statistic(&compiled, |m| set_const(m).unwrap()) != statistic(&compiled, |_| ());
            let computed = statistic(&again, |_| ()) == statistic(&m, |_| ());
            assert!(given || computed, "{name}: statistics after {array}");
            edited += 1;
        }
    }
    assert!(edited > 500, "{edited}");
}

/// Statistics of a copy of the model after a change.
fn statistic(m: &Model, change: impl FnOnce(&mut Model)) -> robohive::physics::model::Statistic {
    let mut copy = m.clone();
    change(&mut copy);
    copy.stat.clone()
}
