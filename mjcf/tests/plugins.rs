//! Plugins and composites: numbers, attributes, errors, states, and the way back to text and to bytes.

use physics::data::State;
use physics::model::{ObjType, Stage};
use physics::plugin::{
    ActuatorInputs, AttributeError, Capability, Config, Instance, Plugin, Registry, SensorInputs,
};
use physics::{Data, Model, Snapshot, forward, step};
use robohive_mjcf::{Loader, load_str, parse_str};

fn refused(text: &str) -> String {
    load_str(text).map(|_| ()).expect_err("the model must be refused").to_string()
}

/// A cable of `attributes` and `parts` in a model that knows the cable plugin.
fn cable(attributes: &str, parts: &str) -> String {
    format!(
        "<mujoco><extension><plugin plugin=\"mujoco.elasticity.cable\"/></extension><worldbody>\
         <composite type=\"cable\" {attributes}>{parts}</composite></worldbody></mujoco>"
    )
}

const CAPSULES: &str = "<geom type=\"capsule\" size=\".01\"/>";
const BOXES: &str = "<geom type=\"box\" size=\".03 .02 .001\"/>";
const ELASTIC: &str = "<plugin plugin=\"mujoco.elasticity.cable\"><config key=\"twist\" value=\"1e6\"/>\
                       <config key=\"bend\" value=\"1e6\"/></plugin>";

fn assert_comes_back(text: &str) {
    let parsed = parse_str(text).unwrap();
    let written = parsed.spec.to_xml().unwrap();
    let model = Loader::default().compile(parsed).unwrap().model;
    let again = load_str(&written).unwrap_or_else(|e| panic!("{e}\n{written}")).model;
    let mut arrays = Vec::new();
    model.visit(&mut |name, _, values| arrays.push((name, values.to_f64())));
    let mut at = arrays.iter();
    again.visit(&mut |name, _, values| assert_eq!(at.next(), Some(&(name, values.to_f64())), "{name}"));
    assert_eq!(parse_str(&written).unwrap().spec.to_xml().unwrap(), written);
    let bytes = model.to_bytes();
    assert_eq!(Model::from_bytes(&bytes).unwrap().to_bytes(), bytes);
}

#[test]
fn a_cable_has_names_joints_sites_excludes_and_one_instance() {
    let parts = format!("{CAPSULES}{ELASTIC}<joint kind=\"main\" damping=\".1\"/>");
    let text = cable("prefix=\"c\" count=\"5 1 1\" curve=\"s\" size=\"1\" initial=\"free\"", &parts);
    let m = load_str(&text).unwrap().model;
    let names = |kind, n| (0..n).map(|i| m.name_of(kind, i)).collect::<Vec<_>>();
    assert_eq!(names(ObjType::Body, m.nbody), ["world", "cB_first", "cB_1", "cB_2", "cB_last"]);
    assert_eq!(names(ObjType::Joint, m.njnt), ["cJ_first", "cJ_1", "cJ_2", "cJ_last"]);
    assert_eq!(names(ObjType::Geom, m.ngeom), ["cG0", "cG1", "cG2", "cG3"]);
    assert_eq!(names(ObjType::Site, m.nsite), ["cS_first", "cS_last"]);
    assert_eq!((m.nexclude, m.nplugin, m.ntext), (3, 1, 1));
    assert_eq!(names(ObjType::Plugin, 1), ["compositec"]);
    assert_eq!(m.body_plugin[..], [-1, 0, 0, 0, 0]);
    // The free joint has no damping; the others have.
    assert_eq!((m.dof_damping[0], m.dof_damping[6]), (0.0, 0.1));
    assert_eq!(m.jnt_group[1], 3);
    assert_comes_back(&text);
}

/// Numbers recorded from MuJoCo 3.12.0.
#[test]
fn boxes_of_a_cable_are_covered_with_a_skin() {
    let text =
        cable("prefix=\"c\" count=\"4 1 1\" curve=\"s 0 sin(s)\" size=\"1 .1 1\" initial=\"none\"", BOXES);
    let m = load_str(&text).unwrap().model;
    assert_eq!((m.nskinvert, m.nskinface, m.nskinbone, m.nskinbonevert, m.nskintexvert), (16, 28, 8, 16, 0));
    assert_eq!((m.name_of(ObjType::Skin, 0), m.skin_inflate[0], m.skin_rgba[0]), ("cSkin", 0.002, [1.0; 4]));
    #[rustfmt::skip]
    assert_eq!(m.skin_face[..], [
        [0, 2, 3], [0, 3, 1], [2, 4, 5], [2, 5, 3], [4, 6, 7], [4, 7, 5],
        [8, 11, 10], [8, 9, 11], [10, 13, 12], [10, 11, 13], [12, 15, 14], [12, 13, 15],
        [0, 10, 2], [0, 8, 10], [2, 12, 4], [2, 10, 12], [4, 14, 6], [4, 12, 14],
        [1, 3, 11], [1, 11, 9], [3, 5, 13], [3, 13, 11], [5, 7, 15], [5, 15, 13],
        [0, 1, 9], [0, 9, 8], [6, 15, 7], [6, 14, 15],
    ]);
    assert_eq!(m.skin_bonebodyid[..], [1, 1, 2, 2, 3, 3, 3, 3]);
    assert_eq!(m.skin_bonebindpos[1], [0.0, 0.02, 0.0]);
    assert_eq!(m.skin_bonebindpos[6], [-0.06, -0.02, 0.0]);
    assert_eq!(m.skin_bonevertid[4..8], [2, 10, 3, 11]);
    assert_comes_back(&text);
}

/// Numbers recorded from MuJoCo 3.12.0. Its rounding leaves a weight of 3e-17 at some vertices, which counts.
#[test]
fn points_between_bones_follow_sixteen_of_them() {
    let parts = format!("{BOXES}<skin subgrid=\"2\" texcoord=\"true\" group=\"2\"/>");
    let text =
        cable("prefix=\"c\" count=\"4 1 1\" curve=\"s 0 sin(s)\" size=\"1 .1 1\" initial=\"none\"", &parts);
    let m = load_str(&text).unwrap().model;
    assert_eq!((m.nskinvert, m.nskinface, m.nskinbone, m.nskinbonevert), (140, 276, 12, 784));
    assert_eq!(m.skin_bonevertnum[..], [50, 58, 50, 76, 86, 72, 78, 86, 74, 50, 54, 50]);
    let first = m.skin_bonevertadr[4] as usize;
    assert_eq!(m.skin_bonevertid[first..first + 12], [8, 78, 9, 79, 15, 85, 16, 86, 10, 80, 11, 81]);
    let weights = [0.165_980_8_f32, 0.331_961_57, 0.331_961_57, 0.663_923_14, 0.407_407_4, 0.331_961_57];
    for (pair, expected) in m.skin_bonevertweight[first..first + 12].as_chunks::<2>().0.iter().zip(weights) {
        assert_eq!(*pair, [expected; 2]);
    }
    let size = |w: &f32| f64::from(w.abs());
    let least = m.skin_bonevertweight.iter().map(size).fold(f64::MAX, f64::min);
    assert_eq!(least, 2.775_557_561_562_891_4e-17);
    let sum: f64 = m.skin_bonevertweight.iter().map(size).sum();
    assert!((sum - 162.123_456_386_616_45).abs() < 1e-9, "{sum}");
    assert_eq!((m.skin_texcoord[8], m.skin_group[0]), ([1.0 / 9.0, 1.0 / 6.0], 2));
    assert_comes_back(&text);
}

#[test]
fn a_bent_cable_springs_back_and_keeps_its_curve() {
    let parts = format!("{CAPSULES}{ELASTIC}");
    let text = cable("count=\"12 1 1\" curve=\"cos(s) sin(s) 0\" size=\"1 .3 1\" initial=\"none\"", &parts);
    let text = text.replace("<worldbody>", "<option gravity=\"0 0 0\"/><worldbody>");
    let m = load_str(&text).unwrap().model;
    let mut d = Data::new(&m);
    forward(&m, &mut d).unwrap();
    assert!(d.passive.qfrc_passive.iter().all(|f| f.abs() < 1e-9), "at rest in its own curve");
    d.state.qpos[..4].copy_from_slice(&[0.05_f64.cos(), 0.0, 0.05_f64.sin(), 0.0]);
    forward(&m, &mut d).unwrap();
    assert!(d.passive.qfrc_passive[1] < -1e-3, "{:?}", &d.passive.qfrc_passive[..3]);
    let flat =
        text.replace("<config key=\"bend\"", "<config key=\"flat\" value=\"true\"/><config key=\"bend\"");
    let m = load_str(&flat).unwrap().model;
    let mut d = Data::new(&m);
    forward(&m, &mut d).unwrap();
    assert!(d.passive.qfrc_passive.iter().any(|f| f.abs() > 1e-3), "a flat cable is bent by its curve");
}

#[test]
fn composites_that_cannot_be_made_are_refused_with_the_way_out() {
    let plain = "count=\"5 1 1\" curve=\"s\"";
    for (attributes, parts, expected) in [
        (plain, "", "a cable is made of capsules, cylinders or boxes"),
        ("count=\"2 1 1\" curve=\"s\"", BOXES, "a cable of boxes has four vertices or more"),
        (
            plain,
            "<geom type=\"box\" size=\".1 .1 .1\"/><skin subgrid=\"100000\"/>",
            "the skin of <composite>",
        ),
        (
            plain,
            "<geom type=\"box\" size=\".1 .1 .1\"/><skin group=\"6\"/>",
            "'group' of <skin> must be between 0 and 5",
        ),
        ("count=\"5 2 1\" curve=\"s\"", CAPSULES, "a cable has one dimension"),
        ("count=\"0\" curve=\"s\"", CAPSULES, "set each number to 1 or more"),
        ("count=\"5 1 1\" curve=\"s t\"", CAPSULES, "'t' is none of s, cos(s), sin(s) and 0"),
        ("count=\"5 1 1\" curve=\"s s s s\"", CAPSULES, "more than three functions"),
        ("count=\"5 1 1\" curve=\"s\" size=\"0\"", CAPSULES, "'size' of <composite> is zero"),
        ("count=\"5 1 1\" vertex=\"0 0 0 1 0 0\"", CAPSULES, "either 'vertex' or 'count'"),
        ("vertex=\"0 0 0 1 0\"", CAPSULES, "write three a vertex"),
        ("count=\"2000000 1 1\" curve=\"s\"", CAPSULES, "makes more than 1000000 elements"),
    ] {
        let message = refused(&cable(attributes, parts));
        assert!(message.contains(expected), "{attributes} {parts}: {message}");
        assert!(message.starts_with("<text>:1:"), "{message}");
    }
    let rope = refused("<mujoco><worldbody>\n <composite type=\"rope\"/></worldbody></mujoco>");
    assert!(rope.starts_with("<text>:2:2: error: composite type 'rope' has been dropped"), "{rope}");
    assert!(rope.contains("use type=\"cable\""), "{rope}");
    let foreign = cable(plain, &format!("{CAPSULES}<plugin plugin=\"mujoco.pid\"/>"));
    assert!(refused(&foreign).contains("takes no plugin but mujoco.elasticity.cable"));
}

const ARM: &str = "<worldbody><body><joint name=\"j\"/><geom size=\".1\"/></body></worldbody>";

#[test]
fn instances_are_numbered_by_section_and_attributes_laid_out_in_order() {
    let text = format!(
        "<mujoco><extension><plugin plugin=\"mujoco.pid\"><instance name=\"b\"><config key=\"kd\" value=\"2\"/>\
         <config key=\"kp\" value=\"1\"/></instance></plugin></extension>{ARM}<actuator>\
         <plugin plugin=\"mujoco.pid\" joint=\"j\" actdim=\"1\"><config key=\"ki\" value=\"3\"/></plugin>\
         <plugin instance=\"b\" joint=\"j\"/></actuator></mujoco>"
    );
    let m = load_str(&text).unwrap().model;
    assert_eq!(m.actuator_plugin[..], [1, 0]);
    assert_eq!((m.name_of(ObjType::Plugin, 0), m.name_of(ObjType::Plugin, 1)), ("b", ""));
    assert_eq!(m.plugin_attr[..], *b"1\0\x002\0\0\0\x003\0\0\0\0");
    assert_eq!(m.plugin_attradr[..], [0, 7]);
    assert_comes_back(&text);
}

#[test]
fn plugins_that_do_not_fit_are_refused_in_their_place() {
    let model = |extension: &str, use_: &str| {
        format!("<mujoco><extension>{extension}</extension>{ARM}<actuator>\n{use_}</actuator></mujoco>")
    };
    let pid = "<plugin plugin=\"mujoco.pid\"/>";
    for (extension, used, expected) in [
        (
            "<plugin plugin=\"mujoco.pidd\"/>",
            "",
            "there is no plugin 'mujoco.pidd'; did you mean 'mujoco.pid'?",
        ),
        (
            "",
            "<plugin plugin=\"mujoco.pid\" joint=\"j\"/>",
            "<text>:2:1: error: plugin 'mujoco.pid' is not declared",
        ),
        (
            pid,
            "<plugin joint=\"j\"/>",
            "<text>:2:1: error: <plugin> needs the attribute 'plugin' or 'instance'",
        ),
        (
            pid,
            "<plugin plugin=\"mujoco.pid\" joint=\"j\"><config key=\"kpp\" value=\"1\"/></plugin>",
            "has no attribute 'kpp'; did you mean 'kp'?",
        ),
        (
            pid,
            "<plugin plugin=\"mujoco.pid\" joint=\"j\"><config key=\"kp\" value=\"x\"/></plugin>",
            "attribute 'kp' is 'x': write one number",
        ),
        (
            pid,
            "<plugin plugin=\"mujoco.pid\" joint=\"j\"><config key=\"kp\" value=\"1\"/><config key=\"kp\" value=\"2\"/></plugin>",
            "<config> sets 'kp' twice",
        ),
        (
            pid,
            "<plugin plugin=\"mujoco.pid\" joint=\"j\"><config key=\"ki\" value=\"1\"/></plugin>",
            "set actdim=\"1\"",
        ),
        (
            "<plugin plugin=\"mujoco.sdf.torus\"><instance name=\"t\"/></plugin>",
            "<plugin instance=\"t\" joint=\"j\"/>",
            "plugin 'mujoco.sdf.torus' drives no actuators",
        ),
        (
            "<plugin plugin=\"mujoco.pid\"><instance name=\"one\"/></plugin>",
            "<plugin instance=\"onn\" joint=\"j\"/>",
            "did you mean 'one'?",
        ),
    ] {
        let message = refused(&model(extension, used));
        assert!(message.contains(expected), "{used}: {message}");
    }
}

/// Counts steps, drives by the count, and shows it.
#[derive(Debug)]
struct Counter;

#[derive(Debug)]
struct Counting {
    from: f64,
    actuators: Vec<usize>,
    id: usize,
}

impl Plugin for Counter {
    fn name(&self) -> &str {
        "test.counter"
    }
    fn attributes(&self) -> &[&str] {
        &["from"]
    }
    fn capabilities(&self) -> &[Capability] {
        &[Capability::Actuator, Capability::Sensor]
    }
    fn stage(&self) -> Stage {
        Stage::Pos
    }
    fn states(&self, _: &Config) -> Result<usize, AttributeError> {
        Ok(1)
    }
    fn readings(&self, _: &Config) -> Result<usize, AttributeError> {
        Ok(2)
    }
    fn instance(&self, config: &Config, m: &Model, id: usize) -> Result<Box<dyn Instance>, AttributeError> {
        let from = config.number("from")?.unwrap_or_default();
        let actuators = (0..m.nactuator).filter(|&i| m.actuator_plugin[i] == id as i32).collect();
        Ok(Box::new(Counting { from, actuators, id }))
    }
}

impl Instance for Counting {
    fn reset(&self, _: &Model, state: &mut [f64]) {
        state[0] = self.from;
    }
    fn forces(&self, inputs: &ActuatorInputs, _: &[f64], force: &mut [f64]) {
        let count = inputs.state.plugin_state[inputs.m.plugin_stateadr[self.id] as usize];
        self.actuators.iter().for_each(|&i| force[i] = count);
    }
    fn read(&self, m: &Model, inputs: &SensorInputs, _: usize, out: &mut [f64]) {
        if let SensorInputs::Position(inputs) = inputs {
            out[0] = inputs.state.plugin_state[m.plugin_stateadr[self.id] as usize];
        }
        out[1] = -1.0;
    }
    fn advance(&self, _: &Model, _: &State, own: &mut [f64]) {
        own[0] += 1.0;
    }
}

#[test]
fn a_plugin_of_the_user_has_state_that_copies_and_resets_carry() {
    let mut registry = Registry::default();
    registry.register(Counter).unwrap();
    assert!(registry.register(Counter).is_err(), "the name is taken");
    let text = format!(
        "<mujoco><extension><plugin plugin=\"test.counter\"><instance name=\"c\"><config key=\"from\" value=\"5\"/>\
         </instance></plugin></extension>{ARM}<actuator><plugin instance=\"c\" joint=\"j\"/></actuator>\
         <sensor><plugin instance=\"c\" cutoff=\"7\"/></sensor></mujoco>"
    );
    assert!(refused(&text).contains("there is no plugin 'test.counter'"));
    let m = Loader::default().plugins(registry.clone()).load_str(&text).unwrap().model;
    assert_eq!((m.npluginstate, m.nsensordata), (1, 2));
    let mut d = Data::new(&m);
    assert_eq!(d.state.plugin_state, [5.0]);
    for _ in 0..3 {
        step(&m, &mut d).unwrap();
    }
    assert_eq!(d.state.plugin_state, [8.0]);
    assert_eq!(d.actuation.actuator_force, [7.0]);
    assert_eq!(d.sensor.sensordata, [7.0, -1.0]);
    let (mut copy, mut taken) = (d.clone(), Snapshot::default());
    d.save(&mut taken);
    step(&m, &mut copy).unwrap();
    step(&m, &mut d).unwrap();
    assert_eq!((&copy.state.qpos, &copy.state.plugin_state), (&d.state.qpos, &d.state.plugin_state));
    // The reading is cut off.
    assert_eq!(copy.sensor.sensordata[0], 7.0);
    d.restore(&taken).unwrap();
    assert_eq!(d.state.plugin_state, [8.0]);
    d.reset(&m);
    assert_eq!(d.state.plugin_state, [5.0]);

    let bytes = m.to_bytes();
    let unknown = Model::from_bytes(&bytes).unwrap_err().to_string();
    assert!(unknown.contains("'test.counter'") && unknown.contains("register it"), "{unknown}");
    let again = Model::read_with(&mut &bytes[..], bytes.len() as u64, &registry).unwrap();
    assert_eq!(again.to_bytes(), bytes);
}

#[test]
fn programs_find_rename_and_remove_instances() {
    let text = format!(
        "<mujoco><extension><plugin plugin=\"mujoco.pid\"><instance name=\"a\"><config key=\"kp\" value=\"1\"/></instance>\
         <instance name=\"b\"/></plugin></extension>{ARM}<actuator><plugin name=\"m\" instance=\"a\" joint=\"j\"/></actuator></mujoco>"
    );
    let mut spec = parse_str(text).unwrap().spec;
    spec.rename(ObjType::Plugin, "a", "gains").unwrap();
    assert_eq!(spec.actuators[0].plugin.as_ref().map(|p| &*p.instance), Some("gains"));
    let in_use = spec.remove(ObjType::Plugin, "gains").unwrap_err().to_string();
    assert!(in_use.contains("in use"), "{in_use}");
    spec.remove(ObjType::Plugin, "b").unwrap();
    let mut without = spec.clone();
    without.remove(ObjType::Actuator, "m").unwrap();
    assert!(without.plugins.is_empty(), "nothing uses the instance any more");
    spec.plugin_mut("gains").unwrap().config[0].1 = "9".into();
    let m = spec.compile(&robohive_mjcf::files::Memory::default(), &Default::default()).unwrap().model;
    assert_eq!((m.nplugin, &m.plugin_attr[..2]), (1, &b"9\0"[..]));
}
