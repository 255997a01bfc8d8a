//! Models edited by programs: what changes, what follows, what is refused, and states carried over.

use physics::model::ObjType;
use physics::{Data, Model, step};
use robohive_mjcf::diagnostic::Sources;
use robohive_mjcf::edit::carry_state;
use robohive_mjcf::files::Memory;
use robohive_mjcf::spec::Spec;
use robohive_mjcf::{load_str, parse_str};

const ROBOT: &str = "<mujoco model='robot'>
  <compiler angle='degree'/>
  <default><geom rgba='1 0 0 1'/><default class='thin'><geom size='.02'/></default></default>
  <asset><material name='steel'/><mesh name='wedge' vertex='0 0 0 1 0 0 0 1 0 0 0 1'/></asset>
  <worldbody>
    <light name='lamp' target='hand' mode='targetbody'/>
    <body name='arm' pos='0 0 1'>
      <joint name='shoulder' axis='0 1 0' range='-90 90'/>
      <geom name='upper' type='capsule' fromto='0 0 0 .4 0 0' size='.05' material='steel'/>
      <body name='hand' pos='.4 0 0'>
        <joint name='wrist' axis='0 1 0'/>
        <joint type='slide' axis='1 0 0' range='0 .1'/>
        <geom name='palm' type='mesh' mesh='wedge'/>
        <site name='tip' pos='.1 0 0'/>
      </body>
    </body>
    <body name='ball' pos='1 0 1'><freejoint name='free'/><geom name='ball' size='.1' mass='2'/></body>
  </worldbody>
  <contact><exclude body1='arm' body2='hand'/><pair geom1='palm' geom2='ball'/></contact>
  <tendon><fixed name='both'><joint joint='shoulder' coef='1'/><joint joint='wrist' coef='2'/></fixed></tendon>
  <actuator><motor name='lift' joint='shoulder'/><motor name='bend' joint='wrist'/><motor tendon='both'/></actuator>
  <sensor><jointpos name='angle' joint='wrist'/><framepos objtype='site' objname='tip'/><clock/></sensor>
  <custom><tuple name='parts'><element objtype='body' objname='hand'/><element objtype='body' objname='ball'/></tuple></custom>
  <keyframe><key name='up' qpos='.1 .2 .03 1 2 3 1 0 0 0' ctrl='5 6 7'/></keyframe>
</mujoco>";

fn robot() -> Spec {
    parse_str(ROBOT).unwrap().spec
}

fn compiled(spec: &Spec) -> Model {
    spec.compile(&Memory::default(), &Sources::default()).unwrap_or_else(|e| panic!("{e}")).model
}

fn message<T>(result: Result<T, robohive_mjcf::diagnostic::Diagnostics>) -> String {
    match result {
        Ok(_) => panic!("not refused"),
        Err(findings) => findings.to_string(),
    }
}

#[test]
fn elements_are_found_by_name_and_misspellings_get_advice() {
    let mut spec = robot();
    assert_eq!(spec.bodies().map(|b| b.name.as_str()).collect::<Vec<_>>(), ["world", "arm", "hand", "ball"]);
    assert_eq!(spec.joint("wrist").unwrap().axis, [0.0, 1.0, 0.0]);
    assert_eq!(spec.joints().count(), 4);
    assert!(spec.geom("").is_none() && spec.actuator("lift").is_some() && spec.material("steel").is_some());
    assert!(message(spec.body_mut("hnd")).contains("did you mean 'hand'?"));
    assert!(message(spec.tendon_mut("bth")).contains("did you mean 'both'?"));
    spec.geom_mut("ball").unwrap().size[0] = 0.3;
    assert_eq!(compiled(&spec).geom_size[2][0], 0.3);
}

#[test]
fn additions_are_read_like_texts() {
    let mut spec = robot();
    spec.add(
        "hand",
        "<body name='finger' pos='.1 0 0'><joint name='curl' range='0 45'/><geom class='thin'/></body>",
    )
    .unwrap();
    spec.add_element("world", "geom", &[("name", "floor"), ("type", "plane"), ("size", "1 1 1")]).unwrap();
    spec.extend("<option timestep='.001'/><actuator><position joint='curl' kp='3'/></actuator>").unwrap();
    spec.extend_element("sensor", "gyro", &[("site", "tip")]).unwrap();
    let m = compiled(&spec);
    let finger = m.id_of(ObjType::Body, "finger").unwrap();
    let geom = m.body_geomadr[finger] as usize;
    assert_eq!((m.geom_size[geom][0], m.geom_rgba[geom]), (0.02, [1.0, 0.0, 0.0, 1.0]));
    assert_eq!(m.jnt_range[m.id_of(ObjType::Joint, "curl").unwrap()][1], std::f64::consts::FRAC_PI_4);
    assert_eq!((m.opt.timestep, m.nu, m.nsensordata), (0.001, 4, 1 + 3 + 1 + 3));
    // Keyframes keep to their elements though a joint came between.
    let free = m.jnt_qposadr[m.id_of(ObjType::Joint, "free").unwrap()] as usize;
    assert_eq!(m.key_qpos[free..free + 3], [1.0, 2.0, 3.0]);
    assert_eq!(m.key_ctrl[..], [5.0, 6.0, 7.0, 0.0]);
}

#[test]
fn faulty_additions_are_refused_with_their_place_and_change_nothing() {
    let mut spec = robot();
    let before = spec.to_xml().unwrap();
    let text = message(spec.add("hand", "<geom size='.1'/>\n<geom siz='.1'/>"));
    assert!(text.contains("<edit>:2:7: error") && text.contains("did you mean 'size'?"), "{text}");
    let text = message(spec.add("hand", "<geom siz='.1'/>"));
    assert!(text.contains("<edit>:1:7: error"), "{text}");
    assert!(message(spec.add("hand", "<geom name='palm' size='.1'/>")).contains("a geom 'palm' already"));
    assert!(message(spec.add("hnd", "<geom/>")).contains("did you mean 'hand'?"));
    assert!(message(spec.add("hand", "<geom")).contains("error"));
    assert!(message(spec.add("world", "<joint/>")).contains("joint"));
    assert!(
        message(spec.extend("<actuator><mtor joint='wrist'/></actuator>")).contains("did you mean <motor>?")
    );
    assert!(message(spec.extend("<asset><model file='a.xml'/></asset>")).contains("model"));
    assert_eq!(spec.to_xml().unwrap(), before);
}

#[test]
fn attributes_are_set_by_the_names_of_the_schema() {
    let mut spec = robot();
    spec.set(ObjType::Geom, "upper", "friction", "2 .1").unwrap();
    spec.set(ObjType::Body, "hand", "euler", "0 90 0").unwrap();
    spec.set(ObjType::Body, "hand", "quat", "1 0 0 0").unwrap();
    spec.set(ObjType::Body, "hand", "gravcomp", ".5").unwrap();
    spec.set(ObjType::Joint, "shoulder", "damping", "3").unwrap();
    spec.set(ObjType::Actuator, "lift", "gear", "7").unwrap();
    spec.set(ObjType::Actuator, "lift", "joint", "wrist").unwrap();
    spec.set(ObjType::Sensor, "angle", "noise", ".25").unwrap();
    spec.set(ObjType::Tendon, "both", "stiffness", "4").unwrap();
    spec.set(ObjType::Mesh, "wedge", "scale", "2 2 2").unwrap();
    let m = compiled(&spec);
    assert_eq!(m.geom_friction[0], [2.0, 0.1, 0.0001]);
    assert_eq!((m.body_quat[2], m.body_gravcomp[2]), ([1.0, 0.0, 0.0, 0.0], 0.5));
    assert_eq!((m.dof_damping[0], m.actuator_gear[0][0], m.sensor_noise[0]), (3.0, 7.0, 0.25));
    assert_eq!((m.actuator_trnid[0][0], m.tendon_stiffness[0]), (1, 4.0));
    assert_eq!(m.jnt_range[0][1], std::f64::consts::FRAC_PI_2);

    let before = spec.to_xml().unwrap();
    assert!(message(spec.set(ObjType::Geom, "upper", "frction", "1")).contains("did you mean 'friction'?"));
    assert!(message(spec.set(ObjType::Geom, "upper", "friction", "1 x")).contains("not a number"));
    assert!(message(spec.set(ObjType::Body, "hand", "mocap", "maybe")).contains("cannot be 'maybe'"));
    assert!(message(spec.set(ObjType::Body, "hand", "mocp", "true")).contains("did you mean 'mocap'?"));
    assert!(message(spec.set(ObjType::Geom, "uper", "size", "1")).contains("did you mean 'upper'?"));
    assert!(message(spec.set(ObjType::Geom, "upper", "name", "x")).contains("rename"));
    assert_eq!(spec.to_xml().unwrap(), before);
}

#[test]
fn references_follow_a_new_name() {
    let mut spec = robot();
    spec.rename(ObjType::Body, "hand", "gripper").unwrap();
    spec.rename(ObjType::Joint, "wrist", "roll").unwrap();
    spec.rename(ObjType::Site, "tip", "tool").unwrap();
    spec.rename(ObjType::Material, "steel", "iron").unwrap();
    spec.rename(ObjType::Mesh, "wedge", "slab").unwrap();
    let (m, before) = (compiled(&spec), compiled(&robot()));
    assert_eq!(m.id_of(ObjType::Body, "gripper"), Some(2));
    assert_eq!(
        (m.nu, m.nsensor, m.npair, m.nexclude),
        (before.nu, before.nsensor, before.npair, before.nexclude)
    );
    assert_eq!(
        (&m.geom_matid[..], &m.light_targetbodyid[..]),
        (&before.geom_matid[..], &before.light_targetbodyid[..])
    );
    assert!(message(spec.rename(ObjType::Body, "arm", "gripper")).contains("already"));
    assert!(message(spec.rename(ObjType::Body, "armm", "x")).contains("did you mean 'arm'?"));
    assert!(message(spec.rename(ObjType::Body, "world", "x")).contains("cannot"));
    assert!(message(spec.rename(ObjType::Body, "arm", "")).contains("cannot"));
}

#[test]
fn what_refers_to_a_removed_element_goes_with_it() {
    let mut spec = robot();
    spec.remove(ObjType::Body, "hand").unwrap();
    let m = compiled(&spec);
    assert_eq!((m.nbody, m.njnt, m.nu, m.nsensor), (3, 2, 1, 1));
    assert_eq!((m.npair, m.nexclude, m.ntendon, m.ntuple), (0, 0, 0, 1));
    assert_eq!((m.tuple_size[0], m.light_targetbodyid[0]), (1, -1));
    // Keyframes keep the numbers of what remains.
    assert_eq!(m.key_qpos[..4], [0.1, 1.0, 2.0, 3.0]);
    assert_eq!(m.key_ctrl[..], [5.0]);

    let mut spec = robot();
    assert!(message(spec.remove(ObjType::Mesh, "wedge")).contains("shown by the geom 'palm'"));
    assert!(message(spec.remove(ObjType::Body, "world")).contains("cannot be removed"));
    assert!(message(spec.remove(ObjType::Body, "hnd")).contains("did you mean 'hand'?"));
    spec.add("arm", "<frame name='mount'><site name='eye'/></frame>").unwrap();
    assert!(message(spec.remove(ObjType::Frame, "mount")).contains("places its elements"));
    spec.remove(ObjType::Material, "steel").unwrap();
    spec.remove(ObjType::Key, "up").unwrap();
    let m = compiled(&spec);
    assert_eq!((m.nmat, m.geom_matid[0], m.nkey), (0, -1, 0));
}

#[test]
fn parts_are_detached_and_attached() {
    let mut spec = robot();
    let hand = spec.detach("hand").unwrap();
    let part = compiled(&hand);
    assert_eq!((part.nbody, part.njnt, part.nmesh, part.nmat, part.nsensor), (2, 2, 1, 0, 2));
    assert_eq!((part.nu, part.ntendon), (1, 0));
    let rest = compiled(&spec);
    assert_eq!((rest.nbody, rest.nu, rest.nsensor), (3, 1, 1));

    for prefix in ["left_", "right_"] {
        spec.attach("ball", &hand, Some("hand"), prefix).unwrap();
    }
    let m = compiled(&spec);
    assert_eq!((m.nbody, m.nu, m.nsensor, m.nmesh), (5, 3, 5, 2 + 1));
    assert_eq!(m.body_parentid[m.id_of(ObjType::Body, "right_hand").unwrap()], 2);
    assert!(message(spec.attach("ball", &hand, Some("hand"), "left_")).contains("left_hand"));
    assert!(message(spec.attach("bll", &hand, None, "x")).contains("did you mean 'ball'?"));
    assert!(message(spec.attach("ball", &hand, Some("hnd"), "x")).contains("hnd"));
    assert_eq!(compiled(&spec).nbody, 5);
}

#[test]
fn attached_elements_keep_their_units() {
    let child = "<mujoco><compiler angle='radian' eulerseq='zyx'/><worldbody><body name='b' euler='.1 .2 .3'>
        <joint name='j' range='0 1'/><geom size='.1'/></body></worldbody></mujoco>";
    let child = parse_str(child).unwrap().spec;
    let mut spec = robot();
    spec.attach("world", &child, None, "c/").unwrap();
    let (m, alone) = (compiled(&spec), compiled(&child));
    assert_eq!(m.jnt_range[m.id_of(ObjType::Joint, "c/j").unwrap()], [0.0, 1.0]);
    assert_eq!(m.body_quat[m.id_of(ObjType::Body, "c/b").unwrap()], alone.body_quat[1]);
    let mut settled = spec.clone();
    settled.settle_keys(&m);
    let again = load_str(settled.to_xml().unwrap()).unwrap().model;
    assert_eq!((&again.jnt_range[..], &again.body_quat[..]), (&m.jnt_range[..], &m.body_quat[..]));
}

#[test]
fn scaled_bodies_scale_in_all_their_lengths() {
    let mut spec = robot();
    spec.scale("arm", 2.0).unwrap();
    let (m, before) = (compiled(&spec), compiled(&robot()));
    // The body stays where it stands; what hangs on it moves away.
    assert_eq!((m.body_pos[1], m.body_pos[2]), ([0.0, 0.0, 1.0], [0.8, 0.0, 0.0]));
    let slide = 2;
    assert_eq!((m.jnt_range[slide], m.jnt_range[0]), ([0.0, 0.2], before.jnt_range[0]));
    for body in [1, 2] {
        assert!((m.body_mass[body] / before.body_mass[body] - 8.0).abs() < 1e-9);
        assert!((m.body_inertia[body][0] / before.body_inertia[body][0] - 32.0).abs() < 1e-9);
    }
    assert_eq!((m.body_mass[3], m.geom_rbound[2]), (before.body_mass[3], before.geom_rbound[2]));
    spec.scale("ball", 0.5).unwrap();
    assert_eq!(compiled(&spec).body_mass[3], 0.25);
    for factor in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert!(message(spec.scale("arm", factor)).contains("positive"));
    }
}

#[test]
fn a_mesh_that_others_show_is_copied_to_be_scaled() {
    let mut spec = robot();
    spec.add("ball", "<geom name='chip' type='mesh' mesh='wedge'/>").unwrap();
    spec.scale("hand", 3.0).unwrap();
    let m = compiled(&spec);
    assert_eq!(m.nmesh, 2);
    let [palm, chip] = ["palm", "chip"].map(|name| m.geom_rbound[m.id_of(ObjType::Geom, name).unwrap()]);
    assert!((palm / chip - 3.0).abs() < 1e-6);
}

#[test]
fn states_are_carried_by_name() {
    let before = compiled(&robot());
    let mut data = Data::new(&before);
    data.reset_to_key(&before, 0).unwrap();
    data.state.xfrc_applied[3] = [1.0, 2.0, 3.0, 4.0, 5.0, 6.0];
    for _ in 0..20 {
        step(&before, &mut data).unwrap();
    }
    let mut spec = robot();
    spec.add("world", "<body name='first' pos='0 0 3'><joint name='new'/><geom size='.1'/></body>").unwrap();
    // A body that stands before the others shifts every address.
    let last = spec.world.bodies.pop().unwrap();
    spec.world.bodies.insert(0, last);
    spec.extend("<actuator><motor name='extra' joint='new'/></actuator>").unwrap();
    spec.remove(ObjType::Actuator, "lift").unwrap();
    let after = compiled(&spec);
    let carried = carry_state(&before, &data, &after);
    assert_eq!(carried.state.time, data.state.time);
    for name in ["shoulder", "wrist", "free"] {
        let [a, b] = [&before, &after].map(|m| m.id_of(ObjType::Joint, name).unwrap());
        let (was, is) = (before.jnt_qposadr[a] as usize, after.jnt_qposadr[b] as usize);
        assert_eq!(carried.state.qpos[is], data.state.qpos[was], "{name}");
        let (was, is) = (before.jnt_dofadr[a] as usize, after.jnt_dofadr[b] as usize);
        assert_eq!(carried.state.qvel[is], data.state.qvel[was], "{name}");
    }
    // The slide has no name: it is the second joint of the hand.
    let hand = after.id_of(ObjType::Body, "hand").unwrap();
    let slide = after.jnt_qposadr[after.body_jntadr[hand] as usize + 1] as usize;
    assert_eq!(carried.state.qpos[slide], data.state.qpos[2]);
    assert_eq!(carried.state.qpos[after.jnt_qposadr[0] as usize], 0.0);
    let ball = after.id_of(ObjType::Body, "ball").unwrap();
    assert_eq!(carried.state.xfrc_applied[ball], [1.0, 2.0, 3.0, 4.0, 5.0, 6.0]);
    // The actuator without a name is the only one of its kind.
    assert_eq!(carried.state.ctrl[..], [6.0, 7.0, 0.0]);

    let same = compiled(&robot());
    let all = carry_state(&before, &data, &same);
    let numbers = |d: &Data| {
        [d.state.qpos.to_vec(), d.state.qvel.to_vec(), d.state.ctrl.to_vec(), d.state.qacc_warmstart.to_vec()]
    };
    assert_eq!(numbers(&all), numbers(&data));
    assert_eq!(all.state.xfrc_applied, data.state.xfrc_applied);
}

#[test]
fn classes_are_for_what_is_added() {
    let mut spec = robot();
    spec.classes.add("big", "thin").unwrap().geom.size[0] = 0.7;
    assert!(spec.classes.add("big", "thin").is_none() && spec.classes.add("other", "none").is_none());
    assert_eq!(spec.classes.names().collect::<Vec<_>>(), ["big", "main", "thin"]);
    spec.add("ball", "<geom name='huge' class='big'/>").unwrap();
    assert_eq!(spec.geom("huge").unwrap().size[0], 0.7);
    assert!(message(spec.add("ball", "<geom class='bg'/>")).contains("did you mean 'big'?"));
}
