//! Contacts under rapier: MuJoCo's rules of who touches, and forces that `Data` tells.

use physics::acceleration::contact_force::contact_force;
use physics::math::mul_mat_t_vec;
use physics::{Data, Model, Stepper};
use robohive_rapier::{Options, Rapier, check, refusals, shapes_of};

fn model(inside: &str) -> Model {
    mjcf::load_str(format!("<mujoco>{inside}</mujoco>")).unwrap().model
}

fn moved(m: &Model, steps: usize, start: impl Fn(&mut Data)) -> Data {
    let mut d = Data::new(m);
    start(&mut d);
    let mut rapier = Rapier::new(m, Options::default()).unwrap();
    (0..steps).for_each(|_| rapier.step(m, &mut d).unwrap());
    d
}

/// Force of all contacts on the second geoms, in the world.
fn sum_of_forces(m: &Model, d: &Data) -> [f64; 3] {
    d.con.contact.iter().fold([0.0; 3], |sum, contact| {
        let [x, y, z, ..] = contact_force(m, &d.efc, contact);
        let force = mul_mat_t_vec(&contact.frame, [x, y, z]);
        [sum[0] + force[0], sum[1] + force[1], sum[2] + force[2]]
    })
}

const FLOOR: &str = "<geom name='floor' type='plane' size='5 5 1' friction='.3'/>";

#[test]
fn forces_of_contacts_are_what_moved_the_body() {
    for (cone, joint) in [
        ("pyramidal", "<freejoint/>"),
        ("elliptic", "<freejoint/>"),
        ("pyramidal", "<joint type='slide' axis='1 0 0'/><joint type='slide' axis='0 0 1'/>"),
    ] {
        let m = model(&format!(
            "<option cone='{cone}'/><worldbody>{FLOOR}<body pos='0 0 .1'>{joint}<geom type='box' size='.1 .1 .1' \
             mass='2' friction='.3'/></body></worldbody>"
        ));
        let d = moved(&m, 100, |d| d.state.qvel[0] = 1.5);
        let vertical = m.nv.min(3) - 1;
        let found = sum_of_forces(&m, &d);
        let [along, up] = [0, vertical].map(|dof| d.acc.qfrc_constraint[dof]);
        assert!((found[0] - along).abs() < 0.02 * 2.0 * 9.81, "{cone} {joint}: {found:?} {along}");
        assert!((found[2] - up).abs() < 0.02 * 2.0 * 9.81, "{cone} {joint}: {found:?} {up}");
        let mean = (1.5 - d.state.qvel[0]) / d.time();
        assert!((mean - 0.3 * 9.81).abs() < 0.1 * 0.3 * 9.81, "{cone} {joint}: slowed by {mean} m/s²");
    }
}

#[test]
fn sensors_read_contacts() {
    let m = model(&format!(
        "<worldbody>{FLOOR}<body pos='0 0 .1'><freejoint/><geom type='box' size='.1 .1 .1' mass='2'/>
         <site name='sole' type='box' size='.11 .11 .11'/></body></worldbody>
         <sensor><touch site='sole'/><accelerometer site='sole'/></sensor>"
    ));
    let d = moved(&m, 300, |_| ());
    let [touch, _, _, up] = d.sensor.sensordata[..] else { panic!("four readings") };
    assert!((touch - 2.0 * 9.81).abs() < 0.2 && (up - 9.81).abs() < 0.1, "{touch} {up}");
}

/// Which geoms of a model touch after some steps, by name.
fn touching(inside: &str) -> Vec<(String, String)> {
    let m = model(inside);
    let d = moved(&m, 3, |_| ());
    let name = |geom: i32| m.geom_names().find(|(id, _)| id.index() == geom as usize).unwrap().1.to_owned();
    let mut found: Vec<_> = d.con.contact.iter().map(|c| (name(c.geom[0]), name(c.geom[1]))).collect();
    found.sort();
    found.dedup();
    found
}

fn ball(name: &str, attributes: &str) -> String {
    format!(
        "<body name='{name}' pos='0 0 .05'><freejoint/><geom name='{name}' size='.1' {attributes}/></body>"
    )
}

#[test]
fn types_affinities_exclusions_parents_and_pairs_decide() {
    let pairs = |attributes: [&str; 2], more: &str| {
        let bodies = format!("{}{}", ball("a", attributes[0]), ball("b", attributes[1]));
        touching(&format!("<option gravity='0 0 0'/><worldbody>{bodies}</worldbody>{more}"))
    };
    let both = vec![("a".to_owned(), "b".to_owned())];
    assert_eq!(pairs(["", ""], ""), both);
    assert_eq!(pairs(["contype='2' conaffinity='0'", "contype='0' conaffinity='2'"], ""), both);
    assert_eq!(pairs(["contype='2' conaffinity='2'", ""], ""), []);
    assert_eq!(pairs(["", ""], "<contact><exclude body1='a' body2='b'/></contact>"), []);
    let none = "contype='0' conaffinity='0'";
    assert_eq!(pairs([none, none], "<contact><pair geom1='a' geom2='b'/></contact>"), both);
    let chain = |option: &str| {
        touching(&format!(
            "<option gravity='0 0 0'>{option}</option><worldbody><body><joint axis='0 1 0'/><joint axis='1 0 0'/>
             <geom name='a' size='.1'/><body pos='.1 0 0'><joint axis='0 1 0'/><joint axis='0 0 1'/>
             <geom name='b' size='.1'/></body></body></worldbody>"
        ))
    };
    assert_eq!(chain(""), [], "parent and child, each of two joints");
    assert_eq!(chain("<flag filterparent='disable'/>"), both);
}

#[test]
fn friction_is_the_larger_or_that_of_higher_priority_or_the_pairs() {
    let slid = |box_attributes: &str, more: &str| {
        let m = model(&format!(
            "<worldbody>{FLOOR}<body pos='0 0 .1'><freejoint/><geom name='box' type='box' size='.1 .1 .1' {box_attributes}/>
             </body></worldbody>{more}"
        ));
        let d = moved(&m, 50, |d| d.state.qvel[0] = 1.0);
        (1.0 - d.state.qvel[0]) / (0.1 * 9.81)
    };
    let close = |found: f64, expected: f64| assert!((found - expected).abs() < 0.05, "{found} {expected}");
    close(slid("friction='.1'", ""), 0.3);
    close(slid("friction='.6'", ""), 0.6);
    close(slid("friction='.1' priority='1'", ""), 0.1);
    close(slid("friction='.6' condim='1'", ""), 0.6);
    let pair = |attributes| format!("<contact><pair geom1='floor' geom2='box' {attributes}/></contact>");
    close(slid("", &pair("friction='.05 .05'")), 0.05);
    close(slid("", &pair("condim='1'")), 0.0);
}

#[test]
fn every_shape_rests_on_the_floor() {
    let shapes = [
        ("type='box' size='.1 .1 .1'", 0.1),
        ("size='.1'", 0.1),
        ("type='capsule' size='.1 .1' euler='90 0 0'", 0.1),
        ("type='cylinder' size='.1 .05'", 0.05),
        ("type='ellipsoid' size='.2 .15 .1'", 0.1),
        ("type='mesh' mesh='cube'", 0.1),
    ];
    let cube = "<asset><mesh name='cube' vertex='-.1 -.1 -.1 .1 -.1 -.1 -.1 .1 -.1 .1 .1 -.1 -.1 -.1 .1 .1 -.1 .1 -.1 .1 .1 .1 .1 .1'/>
        <hfield name='flat' nrow='5' ncol='7' size='2 2 .4 .1' elevation='0 0 0 0 0 0 0 .25 .25 .25 .25 .25 .25 .25 .5 .5 .5 .5 .5 .5 .5 .75 .75 .75 .75 .75 .75 .75 1 1 1 1 1 1 1'/></asset>";
    for (shape, height) in shapes {
        let m = model(&format!(
            "{cube}<worldbody>{FLOOR}<body pos='0 0 .25'><freejoint/><geom {shape}/></body></worldbody>"
        ));
        let d = moved(&m, 1000, |_| ());
        assert!((d.state.qpos[2] - height).abs() < 2e-3, "{shape}: {}", d.state.qpos[2]);
    }
    // A slope that rises along y, so that a field that is turned or mirrored is seen.
    let m = model(&format!(
        "{cube}<worldbody><geom type='hfield' hfield='flat'/><body pos='.3 1 .6'><freejoint/><geom size='.1'/></body></worldbody>"
    ));
    let d = moved(&m, 150, |_| ());
    let mut own = Data::new(&m);
    (0..150).for_each(|_| physics::step(&m, &mut own).unwrap());
    assert!(own.state.qvel[1] > 0.01 && d.state.qvel[1] > 0.1, "both roll down, along y: {:?}", d.state.qvel);
    // The relief falls from 0.4 to 0 over 4 m.
    let surface = 0.1 * (2.0 - d.state.qpos[1]);
    let rests = surface + 0.1 * 1.01_f64.sqrt();
    assert!((d.state.qpos[2] - rests).abs() < 2e-3 && d.state.qvel[0].abs() < 0.01, "{:?}", d.state.qpos);
}

#[test]
fn what_is_not_simulated_is_refused_by_name() {
    for (inside, said) in [
        (
            "<worldbody><geom name='sticky' size='.1' adhesion='3'/></worldbody>",
            "geom \"sticky\" asks for adhesion under rapier",
        ),
        (
            "<worldbody><body name='hand' mocap='true'><body><joint name='finger' axis='1 0 0'/><geom size='.1'/></body></body></worldbody>",
            "joint \"finger\" asks for a joint below a mocap body under rapier",
        ),
    ] {
        let m = model(inside);
        let refusal = check(&m).unwrap_err().to_string();
        assert!(refusal.contains(said), "{refusal}");
        assert!(Rapier::new(&m, Options::default()).is_err());
    }
    let m = model(
        "<asset><mesh name='field' builtin='sphere' params='2'/></asset><worldbody>
         <geom name='belt' type='plane' size='1 1 1' surfacevel='1 0 0 0 0 0'/>
         <body><freejoint/><geom name='field' type='sdf' mesh='field'/></body>
         <body><freejoint/><geom name='seen' type='sdf' mesh='field' contype='0' conaffinity='0'/></body></worldbody>",
    );
    let all: Vec<String> = refusals(&m).iter().map(ToString::to_string).collect();
    let named = |text: &String, name: &str| text.starts_with(&format!("geom \"{name}\" asks for"));
    assert!(all.len() == 2 && named(&all[0], "belt") && named(&all[1], "field"), "{all:?}");
    assert_eq!(all[0], Rapier::new(&m, Options::default()).unwrap_err().to_string());
}

#[test]
fn an_ellipsoid_is_within_its_stated_error() {
    let m = model("<worldbody><geom type='ellipsoid' size='.1 .2 .3'/></worldbody>");
    let shapes = shapes_of(&m).unwrap();
    let polyhedron = shapes[0].shape.as_convex_polyhedron().unwrap();
    let off = |p: &robohive_rapier::parry::math::Vector| {
        ((p.x / 0.1).powi(2) + (p.y / 0.2).powi(2) + (p.z / 0.3).powi(2)).sqrt() - 1.0
    };
    assert_eq!(polyhedron.points().len(), 642);
    assert!(
        polyhedron.points().iter().all(|p| off(p) > 0.0 && off(p) < 0.004),
        "vertices are outside by less than 0.4 %"
    );
}
