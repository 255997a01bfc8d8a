//! What texts mean: default classes, shortcuts, copies, includes and edits. Expected numbers are MuJoCo 3.12.0's
//! for the same text.

use robohive_mjcf::files::Memory;
use robohive_mjcf::{Loader, load_str};

fn model(text: &str) -> physics::Model {
    load_str(text).unwrap_or_else(|d| panic!("{d}")).model
}

#[test]
fn classes_inherit_and_short_vectors_keep_the_rest() {
    let m = model(
        "<mujoco><compiler angle='radian'/>
        <default>
          <geom friction='0.5 0.02 0.03' solimp='0.8 0.85 0.01 0.4 3'/>
          <default class='outer'>
            <geom friction='0.9' euler='0 0 1'/><joint damping='2 3'/>
            <default class='inner'><geom solimp='0.7' rgba='1 0 0 1'/></default>
          </default>
        </default>
        <worldbody>
          <body childclass='inner'><joint damping='5'/><geom size='1' quat='0 1 0 0'/>
            <body><joint/><geom class='main' size='1'/></body>
          </body>
        </worldbody></mujoco>",
    );
    assert_eq!(m.geom_friction, [[0.9, 0.02, 0.03], [0.5, 0.02, 0.03]]);
    assert_eq!(m.geom_solimp, [[0.7, 0.85, 0.01, 0.4, 3.0], [0.8, 0.85, 0.01, 0.4, 3.0]]);
    assert_eq!(m.geom_rgba, [[1.0, 0.0, 0.0, 1.0], [0.5, 0.5, 0.5, 1.0]]);
    assert_eq!((m.dof_damping[0], m.dof_damping[1]), (5.0, 2.0));
    assert_eq!(m.dof_dampingpoly, [[3.0, 0.0], [3.0, 0.0]]);
    // The class's euler outlives the element's quat.
    let expected = [0.8775825618903728, 0.0, 0.0, 0.479425538604203];
    assert!(m.geom_quat[0].iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-15), "{:?}", m.geom_quat[0]);
}

#[test]
fn shortcuts_expand_on_top_of_their_class() {
    let m = model(
        "<mujoco>
        <default>
          <default class='servo'><position kp='7' ctrlrange='-1 1'/></default>
          <default class='hill'><muscle force='300' lmin='0.4'/></default>
        </default>
        <worldbody><body><joint name='j'/><geom size='1'/></body></worldbody>
        <actuator>
          <position class='servo' joint='j'/>
          <muscle class='hill' joint='j' lengthrange='0 1'/>
          <velocity class='servo' joint='j' kv='4'/>
        </actuator></mujoco>",
    );
    let first = |prm: &[f64; 10]| [prm[0], prm[1], prm[2]];
    assert_eq!(
        m.actuator_gainprm.iter().map(first).collect::<Vec<_>>(),
        [[7.0, 0.0, 0.0], [0.75, 1.05, 300.0], [4.0, 0.0, 0.0]]
    );
    assert_eq!(
        m.actuator_biasprm.iter().map(first).collect::<Vec<_>>(),
        [[0.0, -7.0, 0.0], [0.75, 1.05, 300.0], [0.0, 0.0, -4.0]]
    );
    assert_eq!(m.actuator_gainprm[1][3..9], [200.0, 0.4, 1.6, 1.5, 1.3, 1.2]);
    assert_eq!(first(&m.actuator_dynprm[1]), [0.01, 0.04, 0.0]);
    assert_eq!(m.actuator_ctrlrange, [[-1.0, 1.0], [0.0, 0.0], [-1.0, 1.0]]);
}

#[test]
fn replicate_turns_steps_and_copies_what_refers_inside() {
    let parsed = robohive_mjcf::parse_str(
        "<mujoco>
        <worldbody><site name='o'/>
          <replicate count='3' offset='1 0 0' euler='0 0 90' sep='-'>
            <body name='b' pos='0 0 1'><joint name='j'/><geom size='0.1'/><site name='s' pos='0 0 2'/></body>
          </replicate>
        </worldbody>
        <actuator><motor name='m' joint='j'/></actuator>
        <sensor><clock name='c'/><touch name='t' site='s'/></sensor>
        <tendon><spatial name='w'><site site='o'/><site site='s'/></spatial></tendon></mujoco>",
    )
    .unwrap_or_else(|d| panic!("{d}"));
    let spec = &parsed.spec;
    let names: Vec<&str> = spec.world.bodies.iter().map(|b| b.name.as_str()).collect();
    assert_eq!(names, ["b-0", "b-1", "b-2"]);
    assert_eq!(
        spec.actuators.iter().map(|a| (&*a.name, &*a.target)).collect::<Vec<_>>(),
        [("m-0", "j-0"), ("m-1", "j-1"), ("m-2", "j-2")]
    );
    assert_eq!(spec.sensors.iter().map(|s| &*s.name).collect::<Vec<_>>(), ["c", "t-0", "t-1", "t-2"]);
    assert_eq!(spec.tendons.iter().map(|t| &*t.name).collect::<Vec<_>>(), ["w-0", "w-1", "w-2"]);
    // Each copy steps along the axes of the one before.
    let frame = |i: usize| &spec.frames[spec.world.bodies[i].frame.expect("copies stand in frames")];
    for (i, expected) in [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0]].into_iter().enumerate() {
        let pos = frame(i).pos;
        assert!(pos.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-15), "{pos:?}");
    }
}

#[test]
fn includes_stand_anywhere_and_assets_are_sought_from_the_main_file_first() {
    let mut files = Memory::default();
    files.insert(
        "top/model.xml",
        "<mujoco><compiler meshdir='meshes'/><include file='parts/asset.xml'/>
        <worldbody><body><include file='parts/body.xml'/></body></worldbody></mujoco>"
            .as_bytes(),
    );
    files.insert(
        "top/parts/asset.xml",
        "<mujocoinclude><asset><mesh name='near' file='a.stl'/><mesh name='far' file='b.stl'/></asset></mujocoinclude>"
            .as_bytes(),
    );
    files.insert("top/parts/body.xml", "<x><geom size='1'/><include file='deep/site.xml'/></x>".as_bytes());
    files.insert("top/parts/deep/site.xml", "<x><site name='OBJECT_NAME'/></x>".as_bytes());
    files.insert("top/meshes/a.stl", *b"");
    files.insert("top/parts/b.stl", *b"");
    let loader = Loader::default().files(files).substitute("OBJECT_NAME", "apple");
    let parsed = loader.parse("top/model.xml").unwrap_or_else(|d| panic!("{d}"));
    let meshes: Vec<&str> = parsed.spec.meshes.iter().map(|m| m.file.as_str()).collect();
    assert_eq!(meshes, ["top/meshes/a.stl", "top/parts/b.stl"]);
    let body = &parsed.spec.world.bodies[0];
    assert_eq!((body.geoms.len(), body.sites[0].name.as_str()), (1, "apple"));
}

/// A definition must replace something, in whichever file it stands; words in comments are no candidates.
#[test]
fn definitions_that_replace_nothing_are_errors() {
    let mut files = Memory::default();
    files.insert("a.xml", *b"<mujoco><!-- MIT --><worldbody><include file='b.xml'/></worldbody></mujoco>");
    files.insert("b.xml", *b"<x><geom name='OBJECT_NAME' size='RADIUS'/></x>");
    let loader = Loader::default().files(files).define("RADIUS", "1");
    assert!(loader.clone().define("OBJECT_NAME", "apple").load("a.xml").is_ok());
    let error = |text: &str| loader.clone().define(text, "apple").load("a.xml").unwrap_err().to_string();
    assert_eq!(
        error("OBJCT_NAME"),
        "a.xml:1:1: error: nothing to replace: no file of the model contains 'OBJCT_NAME'; did you mean 'OBJECT_NAME'?"
    );
    assert!(error("THING").ends_with("words in capitals there: 'OBJECT_NAME'"), "{}", error("THING"));
    assert!(loader.substitute("THING", "apple").load("a.xml").is_ok());
}

#[test]
fn bodies_move_before_reading() {
    let mut files = Memory::default();
    let text = "<mujoco><worldbody><body name='hand'><geom size='1'/></body>
        <body name='arm' pos='1 0 0'><geom size='1'/><body name='wrist' pos='0 2 0'/></body></worldbody></mujoco>";
    files.insert("a.xml", text.as_bytes());
    let loader = Loader::default().files(files);
    let m = loader.clone().reparent("hand", "wrist").load("a.xml").unwrap_or_else(|d| panic!("{d}")).model;
    assert_eq!(m.body_parentid, [0, 0, 1, 2]);
    let lost = loader.clone().reparent("hand", "elbow").load("a.xml").err().map(|d| d.to_string());
    assert!(lost.is_some_and(|text| text.contains("no body named 'elbow'")));
    let loop_ = loader.reparent("arm", "wrist").load("a.xml").err().map(|d| d.to_string());
    assert!(loop_.is_some_and(|text| text.contains("is part of the moved body")));
}

#[test]
fn the_reference_lists_every_element_with_its_attributes() {
    let text = robohive_mjcf::reference();
    for line in [
        "mujoco — A model",
        "          contype: int — contact bits",
        "          type: plane|hfield|sphere|capsule|ellipsoid|cylinder|box|mesh|sdf — shape",
        "        composite — Bodies in a chain, as a cable has them",
    ] {
        assert!(text.contains(line), "no line '{line}' in\n{text}");
    }
    assert!(text.lines().count() > 800, "{} lines", text.lines().count());
}

#[test]
fn motors_and_servos_follow_their_data_sheets() {
    let model = |actuator: &str| {
        let text = format!(
            "<mujoco><worldbody><body><joint name='j'/><geom size='.1'/></body></worldbody>\
             <actuator>{actuator}</actuator></mujoco>"
        );
        robohive_mjcf::load_str(&text).map(|l| l.model).map_err(|e| e.to_string())
    };
    // No-load speed and stall torque at the nominal voltage give back motor constant and resistance.
    let motor = model("<dcmotor joint='j' nominal='12 .3 500' saturation='0 4'/>").unwrap();
    let (r, k) = (motor.actuator_gainprm[0][0], motor.actuator_gainprm[0][1]);
    assert!((12.0 / k - 500.0).abs() < 1e-9 && (k * 12.0 / r - 0.3).abs() < 1e-12);
    assert_eq!(motor.actuator_forcerange[0], [-4.0 * k, 4.0 * k]);
    let heats =
        model("<dcmotor joint='j' motorconst='1' resistance='2' thermal='3 0 6' lugre='5 1 .1 .2 .3'/>");
    assert_eq!(heats.unwrap().actuator_actnum, [2]);
    for (actuator, expected) in [
        ("<dcmotor joint='j' resistance='2'/>", "positive motor constant"),
        ("<dcmotor joint='j' motorconst='1' resistance='2' thermal='0 0 1'/>", "must be positive"),
        ("<pid joint='j' kp='1' input='vel pos'/>", "in the order"),
        ("<pid joint='j' kp='1' input='voltage'/>", "use only the words pos, vel and ff"),
        ("<pid joint='j' kp='1' slewmax='-1'/>", "attribute 'slewmax' is negative"),
        ("<orientation joint='j' kp='1'/>", "an so3 actuator turns a ball joint"),
    ] {
        let message = model(actuator).expect_err("the model must be refused");
        assert!(message.contains(expected), "{actuator}: {message}");
    }
}

#[test]
fn names_that_nothing_declares_are_errors_of_whole_models_alone() {
    let text = "<mujoco>\n  <worldbody><body name='arm'><geom size='.1'/><site name='here'/></body></worldbody>\n  \
                <tendon><spatial name='t'><site site='shoulder'/><site site='here'/></spatial></tendon>\n</mujoco>";
    let parsed = robohive_mjcf::parse_str(text).unwrap_or_else(|found| panic!("{found}"));
    let found = robohive_mjcf::Loader::default().compile(parsed).err().map(|found| found.to_string());
    let expected = "<text>:3:29: error: tendon 't': there is no site 'shoulder'";
    assert!(found.as_ref().is_some_and(|found| found.contains(expected)), "{found:?}");

    let mut whole = robohive_mjcf::parse_str(text).unwrap_or_else(|found| panic!("{found}")).spec;
    let torso = "<mujoco><worldbody><site name='shoulder' pos='0 0 1'/></worldbody></mujoco>";
    whole.world.sites.extend(robohive_mjcf::parse_str(torso).expect("a site").spec.world.sites);
    let model =
        whole.compile(&robohive_mjcf::files::Memory::default(), &Default::default()).expect("whole").model;
    assert_eq!((model.nsite, model.ntendon, model.tendon_length0[0]), (2, 1, 1.0));
}

#[test]
fn bodies_outside_of_the_world_are_ignored_with_a_warning() {
    let text = "<mujoco>\n <body name='arm'><geom size='.1'/></body>\n</mujoco>";
    let loaded = robohive_mjcf::load_str(text).unwrap_or_else(|found| panic!("{found}"));
    assert_eq!((loaded.model.nbody, loaded.model.ngeom), (1, 0));
    let warnings: Vec<String> = loaded.warnings.iter().map(ToString::to_string).collect();
    assert_eq!(warnings.len(), 1);
    assert!(warnings[0].contains("2:2: warning: <body> outside of <worldbody> is ignored"), "{warnings:?}");

    let refused = |inside: &str| {
        let found = robohive_mjcf::load_str(format!("<mujoco>{inside}</mujoco>")).err();
        found.map(|found| found.to_string()).unwrap_or_default()
    };
    assert!(refused("<geom size='.1'/>").contains("unknown element <geom> in <mujoco>"));
    assert!(refused("<body><bla/></body>").contains("unknown element <bla> in <body>"));
    assert!(refused("<body><joint name='j'/></body><actuator><motor joint='j'/></actuator>").contains("'j'"));
}
