//! URDF: what its elements become, and what is said about faulty ones. That the arrays are MuJoCo's is compared with
//! recordings elsewhere.

use physics::Model;
use physics::model::{JointType, ObjType};
use robohive_mjcf::files::Memory;
use robohive_mjcf::{Loader, load, load_str};

fn file(name: &str) -> String {
    format!("{}/tests/urdf/{name}", env!("CARGO_MANIFEST_DIR"))
}

fn robot(content: &str) -> String {
    format!("<robot name='r'>\n{content}\n</robot>")
}

fn model(content: &str) -> Model {
    load_str(robot(content)).unwrap_or_else(|d| panic!("{d}")).model
}

fn first(content: &str) -> String {
    let findings = load_str(robot(content)).err().unwrap_or_else(|| panic!("accepted: {content}"));
    findings.to_string().lines().next().unwrap_or_default().to_owned()
}

const BALL: &str = "<collision><geometry><sphere radius='0.1'/></geometry></collision>";

#[test]
fn links_become_bodies_with_joints_shapes_and_masses() {
    let m = load(file("arm.urdf")).unwrap().model;
    assert_eq!((m.nbody, m.njnt, m.ngeom, m.nmesh), (6, 3, 8, 2));
    let [yaw, lift, spin] = ["yaw", "lift", "spin"].map(|name| m.id_of(ObjType::Joint, name).unwrap());
    assert_eq!(m.jnt_type[..], [JointType::Hinge.code(), JointType::Slide.code(), JointType::Hinge.code()]);
    assert_eq!((m.jnt_range[yaw], m.jnt_actfrcrange[yaw]), ([-1.5, 2.0], [-30.0, 30.0]));
    assert_eq!((m.dof_damping[yaw], m.dof_frictionloss[yaw]), (0.7, 0.1));
    assert_eq!(m.jnt_axis[lift], [0.0, 0.0, -1.0]);
    // One end bounds nothing, and no effort is no bound.
    assert_eq!((m.jnt_limited[spin], m.jnt_actfrclimited[spin]), (false, false));
    assert_eq!(m.opt.gravity, [0.0, 0.0, -3.7]);
    // A second geom of one name has none.
    assert_eq!((0..m.ngeom).filter(|&g| m.name_of(ObjType::Geom, g) == "foot").count(), 1);
    assert_eq!([0, 1].map(|mesh| m.name_of(ObjType::Mesh, mesh)), ["wedge", "wedge1"]);
    // The colour of a visual holds for the collisions after it.
    assert_eq!((m.geom_rgba[0], m.geom_rgba[1]), ([0.6, 0.6, 0.65, 1.0], [0.6, 0.6, 0.65, 1.0]));
    // Impossible moments of inertia are balanced.
    assert!(m.body_inertia[3].iter().all(|x| (x - 0.4).abs() < 1e-15));
}

#[test]
fn the_world_link_is_the_world_and_fixed_links_are_fused() {
    let m = load(file("world.urdf")).unwrap().model;
    assert_eq!((m.nbody, m.njnt, m.ngeom), (5, 6, 5));
    let names: Vec<&str> = (0..m.nbody).map(|body| m.name_of(ObjType::Body, body)).collect();
    assert_eq!(names, ["world", "ball", "puck", "arm", "flap"]);
    let planar = ["slide_TX", "slide_TY", "slide_RZ"].map(|name| m.id_of(ObjType::Joint, name).unwrap());
    for joint in planar {
        let dof = m.jnt_dofadr[joint] as usize;
        assert_eq!((m.dof_damping[dof], m.dof_frictionloss[dof]), (0.5, 0.2));
    }
    assert_eq!(planar.map(|joint| m.jnt_limited[joint]), [true, false, false]);
}

#[test]
fn a_urdf_goes_through_mjcf_unchanged() {
    for name in ["arm.urdf", "world.urdf"] {
        let path = file(name);
        let parsed = Loader::default().parse(&path).unwrap();
        let mut spec = parsed.spec.clone();
        let model = Loader::default().compile(parsed).unwrap().model;
        let (dir, _) = path.rsplit_once('/').unwrap();
        spec.place_assets(dir).unwrap();
        let text = spec.to_xml().unwrap();
        let place = format!("{dir}/written.xml");
        let files = robohive_mjcf::files::Overlay::new(
            robohive_mjcf::files::Disk::everywhere(),
            &place,
            text.as_bytes(),
        );
        let again = Loader::default().files(files).load(&place).unwrap().model;
        assert_eq!(again.to_bytes(), model.to_bytes(), "{name}");
    }
}

#[test]
fn meshes_of_packages_are_found_around_the_file() {
    let obj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
    let text = |strip: &str| {
        robot(&format!(
            "<mujoco><compiler {strip}/></mujoco><link name='a'><collision><geometry>
             <mesh filename='package://arm/meshes/m.obj'/></geometry></collision></link>"
        ))
    };
    for (mesh, strip) in [
        ("ws/arm/meshes/m.obj", ""),
        ("ws/arm/urdf/arm/meshes/m.obj", ""),
        ("ws/arm/urdf/m.obj", "strippath='true'"),
    ] {
        let mut files = Memory::default();
        files.insert("ws/arm/urdf/arm.urdf", text(strip).into_bytes());
        files.insert(mesh, obj.as_bytes().to_vec());
        let loaded = Loader::default().files(files).load("ws/arm/urdf/arm.urdf");
        assert_eq!(loaded.unwrap_or_else(|d| panic!("{mesh}: {d}")).model.nmesh, 1);
    }
    let mut files = Memory::default();
    files.insert("arm.urdf", text("").into_bytes());
    let message = Loader::default().files(files).load("arm.urdf").unwrap_err().to_string();
    assert!(message.contains("m.obj"), "{message}");
}

#[test]
fn what_is_ignored_is_said() {
    let text = robot(&format!(
        "<mujoco><compiler angl='degree'/><bogus/></mujoco><gazebo/><sensor/>
        <link name='a'>{BALL}</link><link name='b'>{BALL}</link>
        <joint name='j' type='revolute'><parent link='a'/><child link='b'/><mimic joint='x'/><limit upper='1'/></joint>"
    ));
    let loaded = load_str(text).unwrap();
    let said = loaded.warnings.to_string();
    let expected = [
        "attribute 'angl' of <compiler> is ignored; did you mean 'angle'?",
        "<bogus> is ignored",
        "<sensor> is ignored in a URDF",
        "<mimic> is ignored",
        "the limit is ignored",
    ];
    for expected in expected {
        assert!(said.contains(expected), "{expected}: {said}");
    }
    assert_eq!(loaded.warnings.warnings().count(), expected.len(), "{said}");
    assert_eq!(model("<link name='a'/>").nbody, 1);
}

#[test]
fn faults_are_located() {
    let joint = |inside: &str| {
        format!(
            "<link name='a'>{BALL}</link><link name='b'>{BALL}</link>\n<joint {inside}<parent link='a'/><child link='b'/></joint>"
        )
    };
    let shape = |inside: &str| format!("<link name='a'><collision>\n{inside}</collision></link>");
    let cases = [
        ("<link/>".to_owned(), "2:1: error: <link> needs the attribute 'name'"),
        ("<link name='a'/>\n<link name='a'/>".to_owned(), "3:1: error: duplicate link name 'a'"),
        (joint("name='j' type='revolut'>"), "3:23: error: a joint cannot be 'revolut'; did you mean 'revolute'?"),
        (joint("name='j'>"), "3:1: error: <joint> needs the attribute 'type'"),
        (joint("type='fixed'>"), "3:1: error: <joint> needs the attribute 'name'"),
        (
            joint("name='j' type='fixed'><origin xyz='0 1'/>"),
            "3:43: error: attribute 'xyz' of <origin> takes 3 numbers, not 2",
        ),
        (
            joint("name='j' type='fixed'><origin xyz='0 1 x'/>"),
            "3:47: error: attribute 'xyz' of <origin>: 'x' is not a number",
        ),
        (joint("name='j' type='prismatic'><axis/>"), "3:34: error: <axis> needs the attribute 'xyz'"),
        (joint("name='j' type='prismatic'><axis xyz='0 0 0'/>"), "3:1: error: joint 'j': axis has no length"),
        (
            "<link name='arm'/>\n<joint name='j' type='fixed'><parent link='arm'/><child link='armm'/></joint>".to_owned(),
            "3:50: error: no link is named 'armm'; did you mean 'arm'?",
        ),
        (
            "<link name='a'/>\n<joint name='j' type='fixed'><child link='a'/></joint>".to_owned(),
            "3:1: error: <joint> needs a <parent> in it",
        ),
        (
            "<link name='a'/>\n<joint name='j' type='fixed'><parent link='a'/><child link='a'/></joint>".to_owned(),
            "2:1: error: link 'a' is its own ancestor: its joints go in a circle",
        ),
        (shape(""), "2:16: error: <collision> needs a <geometry> in it"),
        (
            shape("<geometry><cone/></geometry>"),
            "3:1: error: <geometry> needs one of <box>, <cylinder>, <sphere>, <capsule>, <mesh>",
        ),
        (shape("<geometry><box size='1 1'/></geometry>"), "3:22: error: attribute 'size' of <box> takes 3 numbers, not 2"),
        (shape("<geometry><cylinder radius='1'/></geometry>"), "3:11: error: <cylinder> needs the attribute 'length'"),
        (shape("<geometry><mesh/></geometry>"), "3:11: error: <mesh> needs the attribute 'filename'"),
        (shape("<geometry/>\n<geometry/>"), "4:1: error: <geometry> may stand only once in <collision>"),
        (
            "<link name='a'><inertial>\n<mass value='1'/></inertial></link>".to_owned(),
            "2:16: error: <inertial> needs a <inertia> in it",
        ),
        (
            format!("<link name='b'>{BALL}</link><link name='world'/>\n<joint name='j' type='revolute'><parent link='b'/><child link='world'/></joint>"),
            "3:1: error: link 'world' is fixed, and no joint moves it: give it another name",
        ),
    ];
    for (content, expected) in cases {
        assert_eq!(first(&content), format!("<text>:{expected}"), "for {content}");
    }
    let chain: String = (0..300)
        .map(|k| {
            let next = k + 1;
            format!("<link name='{k}'/><joint name='{k}' type='fixed'><parent link='{k}'/><child link='{next}'/></joint>")
        })
        .collect();
    let message = first(&format!("{chain}<link name='300'/>"));
    assert!(message.contains("links are nested more than 200 deep"), "{message}");
}
