//! Flexes: what flexcomps become, what is compiled of it, and what is wrong with bad ones.

use physics::Model;
use physics::model::ObjType;
use robohive_mjcf::files::Memory;
use robohive_mjcf::flex::decode_gmsh;
use robohive_mjcf::{Loader, load_str, parse_str};

fn scene(flexcomp: &str) -> String {
    format!("<mujoco><worldbody><body name='b' pos='1 2 3'>{flexcomp}</body></worldbody></mujoco>")
}

fn load(text: &str) -> Model {
    load_str(text).unwrap_or_else(|error| panic!("{text}\n{error}")).model
}

fn refused(flexcomp: &str) -> String {
    load_str(scene(flexcomp)).err().map(|error| error.to_string()).unwrap_or_default()
}

/// Total mass and its centre, of all bodies that a flexcomp made.
fn mass_and_centre(m: &Model) -> (f64, [f64; 3]) {
    let made = 2..m.nbody;
    let mass: f64 = made.clone().map(|b| m.body_mass[b]).sum();
    let centre = |k: usize| made.clone().map(|b| m.body_mass[b] * m.body_pos[b][k]).sum::<f64>() / mass;
    (mass, [centre(0), centre(1), centre(2)])
}

#[test]
fn every_regular_type_keeps_mass_and_centre() {
    for (kind, points) in [
        ("type='grid' dim='1' count='5 1 1'", 5),
        ("type='grid' dim='2' count='4 5 1'", 20),
        ("type='grid' dim='3' count='3 4 3'", 36),
        ("type='circle' dim='1' count='9 1 1'", 8),
        ("type='square' count='4 4 1'", 16),
        ("type='disc' count='5 5 1'", 25),
        ("type='box' dim='3' count='4 4 4'", 57),
        ("type='cylinder' dim='3' count='5 5 3'", 67),
        ("type='ellipsoid' dim='3' count='5 5 5'", 99),
    ] {
        let m = load(&scene(&format!(
            "<flexcomp name='f' {kind} mass='2.5' spacing='.1 .1 .1' radius='.001' pos='.1 .2 .3'/>"
        )));
        assert_eq!((m.nflex, m.nbody - 2), (1, points), "{kind}");
        let (mass, centre) = mass_and_centre(&m);
        assert!((mass - 2.5).abs() < 1e-12, "{kind}: mass {mass}");
        for k in 0..3 {
            assert!((centre[k] - [0.1, 0.2, 0.3][k]).abs() < 1e-12, "{kind}: centre {centre:?}");
        }
    }
}

#[test]
fn lattices_keep_mass_and_centre() {
    for (dof, nodes) in [("trilinear", 8), ("quadratic", 27)] {
        let m = load(&scene(&format!(
            "<flexcomp name='f' type='grid' dim='3' count='4 4 4' spacing='.1 .1 .1' mass='3' dof='{dof}'>\
             <contact selfcollide='none'/><elasticity young='100' poisson='.2'/></flexcomp>"
        )));
        assert_eq!((m.nflexnode, m.nbody - 2), (nodes, nodes));
        let (mass, centre) = mass_and_centre(&m);
        assert!((mass - 3.0).abs() < 1e-12 && centre.iter().all(|c| c.abs() < 1e-12), "{dof}: {centre:?}");
        assert_eq!(m.flex_stiffness.len(), (3 * nodes) * (3 * nodes));
        assert!(m.flex_vertbodyid.iter().all(|&b| b == -1));
    }
}

#[test]
fn pins_are_fixed_to_the_parent() {
    let m = load(&scene(
        "<flexcomp name='f' type='grid' dim='2' count='3 3 1' mass='9'><pin id='0'/><pin gridrange='2 0 2 2'/></flexcomp>",
    ));
    assert_eq!(m.nbody - 2, 5);
    assert_eq!(m.flex_vertbodyid.iter().filter(|&&b| b == 1).count(), 4);
    assert!(!m.flex_centered[0] && m.flex_vert[0] != [0.0; 3] && m.flex_vert[1] == [0.0; 3]);
    assert!(m.body_mass[2..].iter().all(|&mass| mass == 1.0));
    let rigid = load(&scene("<flexcomp name='f' type='grid' dim='2' count='3 3 1' rigid='true'/>"));
    assert!(rigid.flex_rigid[0] && rigid.nbody == 2 && rigid.flexedge_rigid.iter().all(|&r| r));
}

#[test]
fn sheets_have_edges_shells_and_constraints() {
    let m = load(&scene(
        "<flexcomp name='f' type='grid' dim='2' count='3 3 1' spacing='.1 .1 .1' mass='9'>\
         <edge equality='true'/></flexcomp>",
    ));
    assert_eq!((m.nflexvert, m.nflexedge, m.nflexelem), (9, 16, 8));
    assert_eq!((m.flex_shellnum[0], m.neq, m.flex_edgeequality[0]), (8, 1, 1));
    assert_eq!((m.nbvhdynamic, m.nbvh), (15, 15));
    assert_eq!(m.flexedge_J_rownnz.iter().filter(|&&n| n == 6).count(), 16);
    let vertices = load(&scene(
        "<flexcomp name='f' type='grid' dim='2' count='3 3 1' spacing='.1 .1 .1' mass='9'>\
         <edge equality='vert'/></flexcomp>",
    ));
    assert_eq!((vertices.flex_edgeequality[0], vertices.flex_vertedgenum[4]), (2, 6));
    assert!(vertices.flex_vertmetric[4][0] > 0.0);
}

const BAD: [(&str, &str); 16] = [
    ("<flexcomp type='grid'/>", "<flexcomp> needs the attribute 'name'"),
    ("<flexcomp name='f' type='grid' dim='4'/>", "dim must be 1, 2 or 3, is 4"),
    ("<flexcomp name='f' type='grid' dim='2' count='3 3 2'/>", "the third number of 'count' must be 1"),
    ("<flexcomp name='f' type='grid' dim='2' count='1 3 1'/>", "the count makes no element"),
    ("<flexcomp name='f' type='box' dim='3' count='3 3 1'/>", "at least 2 points along each axis"),
    ("<flexcomp name='f' type='grid' count='3 3 1' spacing='.001 1 1'/>", "must be at least 0.01"),
    ("<flexcomp name='f' type='grid' count='3 3 1' mass='0'/>", "'mass' and 'inertiabox' must be positive"),
    ("<flexcomp name='f' type='grid' count='3 3 1'><pin id='9'/></flexcomp>", "point 9 does not exist"),
    ("<flexcomp name='f' type='grid' count='3 3 1'><pin grid='0'/></flexcomp>", "not a multiple of 2"),
    ("<flexcomp name='f' type='direct' point='0 0 0 1 0 0 0 1 0' element='0 1 3'/>", "element 0 has point 3"),
    ("<flexcomp name='f' type='mesh'/>", "it needs the attribute 'file'"),
    ("<flexcomp name='f' type='mesh' file='no.obj'/>", "cannot read 'no.obj'"),
    (
        "<flexcomp name='f' type='grid' count='3 3 1'><edge equality='true'/><elasticity young='1'/></flexcomp>",
        "constraints and elasticity exclude each other",
    ),
    ("<flexcomp name='f' type='grid' count='3 3 1'><edge stiffness='1'/></flexcomp>", "edges of triangles"),
    (
        "<flexcomp name='f' type='grid' dim='3' count='3 3 3' dof='trilinear'/>",
        "an interpolated flex cannot collide with itself",
    ),
    ("<flexcomp name='f' type='grid' dim='3' count='2000000000 2000000000 2'/>", "more than the budget"),
];

#[test]
fn bad_flexcomps_are_refused_with_a_reason() {
    for (text, reason) in BAD {
        let said = refused(text);
        assert!(said.contains(reason) && said.contains("<text>:1:"), "{text}\n{said}");
    }
}

const FLEX: &str = "<mujoco><worldbody><body name='a'><joint type='slide'/><geom size='.1'/></body>\
    <body name='b' pos='1 0 0'/><body name='c' pos='0 1 0'/></worldbody><deformable>FLEX</deformable></mujoco>";

#[test]
fn bad_flexes_are_refused_with_a_reason() {
    for (flex, reason) in [
        ("<flex name='f' body='a b c' element='0 1 3'/>", "element 0 has vertex 3"),
        ("<flex name='f' body='a b c' element='0 1 1'/>", "vertex 1 twice"),
        ("<flex name='f' body='a b c' element='0 1'/>", "not 3 an element"),
        ("<flex name='f' body='a b d' element='0 1 2'/>", "there is no body 'd'"),
        ("<flex name='f' body='a b' vertex='0 0 0 0 0 0 0 0 0' element='0 1 2'/>", "names 2 bodies"),
        (
            "<flex name='f' body='a b c' element='0 1 2' texcoord='0 0'/>",
            "not two for each of the 3 vertices",
        ),
        (
            "<flex name='f' body='a b c' element='0 1 2'><elasticity young='1' elastic2d='both'/></flex>",
            "elastic2d needs a positive thickness",
        ),
        (
            "<flex name='f' body='a b c' element='0 1 2' node='a b c' dof='trilinear'><contact selfcollide='none'/></flex>",
            "the lattice has 8 nodes",
        ),
    ] {
        let said = load_str(FLEX.replace("FLEX", flex)).err().map(|e| e.to_string()).unwrap_or_default();
        assert!(said.contains(reason) && said.contains("<text>:1:"), "{flex}\n{said}");
    }
}

#[test]
fn written_flexes_compile_to_the_same_arrays() {
    for flexcomp in [
        "<flexcomp name='f' type='grid' dim='2' count='3 4 1' mass='2' rgba='1 0 0 1'><pin id='0 2'/>\
         <contact solref='.01 1' condim='4' internal='true'/><elasticity young='1e3' poisson='.1' thickness='.01' elastic2d='both'/>\
         </flexcomp>",
        "<flexcomp name='f' type='grid' dim='3' count='3 3 3' dof='trilinear' euler='0 0 30'>\
         <contact selfcollide='none'/><edge equality='strain'/></flexcomp>",
        "<flexcomp name='f' type='box' dim='3' count='3 3 3' dof='radial'><edge equality='true' damping='1'/></flexcomp>",
    ] {
        let text = scene(flexcomp);
        let parsed = parse_str(&text).unwrap();
        let written = parsed.spec.to_xml().unwrap();
        let (first, second) = (load(&text), load(&written));
        assert!(first.to_bytes() == second.to_bytes(), "{written}");
        assert_eq!(parse_str(&written).unwrap().spec.to_xml().unwrap(), written);
        assert!(Model::from_bytes(&first.to_bytes()).is_ok());
    }
}

#[test]
fn damaged_compiled_flexes_are_refused() {
    let m = load(&scene("<flexcomp name='f' type='grid' dim='2' count='3 3 1'/>"));
    let damage = |change: &dyn Fn(&mut physics::model::Draft<'_>)| m.edited(change).is_err();
    assert!(damage(&|m| m.flex_elem[0] = 9));
    assert!(damage(&|m| m.flex_edge[0] = [0, 9]));
    assert!(damage(&|m| m.flex_vertbodyid[0] = 99));
    assert!(damage(&|m| m.flex_dim[0] = 0));
    assert!(damage(&|m| m.flex_condim[0] = 2));
}

#[test]
fn programs_edit_flexes() {
    let mut spec = parse_str(scene("<flexcomp name='f' type='grid' dim='2' count='2 2 1'/>")).unwrap().spec;
    spec.rename(ObjType::Flex, "f", "cloth").unwrap();
    spec.set(ObjType::Flex, "cloth", "radius", "0.01").unwrap();
    assert_eq!(spec.flex("cloth").map(|f| f.radius), Some(0.01));
    spec.rename(ObjType::Body, "f_0", "corner").unwrap();
    assert_eq!(spec.flex("cloth").unwrap().vertbody[0], "corner");
    let mut other = parse_str("<mujoco><worldbody><body name='hand'/></worldbody></mujoco>").unwrap().spec;
    other.attach("hand", &spec, Some("b"), "x_").unwrap();
    assert_eq!(other.flex("x_cloth").unwrap().vertbody[0], "x_corner");
    spec.remove(ObjType::Body, "corner").unwrap();
    assert!(spec.flexes.is_empty());
}

#[test]
fn replicated_flexes_get_numbers() {
    let m = load(
        "<mujoco><worldbody><replicate count='2' offset='1 0 0'><body name='b'>\
         <flexcomp name='f' type='grid' dim='2' count='2 2 1'><edge equality='true'/></flexcomp></body></replicate></worldbody></mujoco>",
    );
    assert_eq!((m.nflex, m.nbody, m.neq), (2, 11, 2));
}

const TEXT_22: &str = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n$EndNodes\n\
    $Elements\n1\n1 4 2 0 1 1 2 3 4\n$EndElements\n";
const TEXT_41: &str = "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Nodes\n1 4 1 4\n3 1 0 4\n1\n2\n3\n4\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n$EndNodes\n\
    $Elements\n1 1 1 1\n3 1 4 1\n1 1 2 3 4\n$EndElements\n";

fn binary(version: &str, nodes: Vec<u8>, elements: Vec<u8>) -> Vec<u8> {
    let mut file = format!("$MeshFormat\n{version} 1 8\n\x01\0\0\0\n$EndMeshFormat\n$Nodes\n").into_bytes();
    file.extend(nodes);
    file.extend(b"\n$EndNodes\n$Elements\n");
    file.extend(elements);
    file.extend(b"\n$EndElements\n");
    file
}

fn ints(values: &[i32]) -> Vec<u8> {
    values.iter().flat_map(|x| x.to_le_bytes()).collect()
}

fn longs(values: &[u64]) -> Vec<u8> {
    values.iter().flat_map(|x| x.to_le_bytes()).collect()
}

fn reals(values: &[f64]) -> Vec<u8> {
    values.iter().flat_map(|x| x.to_le_bytes()).collect()
}

#[test]
fn all_formats_of_gmsh_say_the_same() {
    let corners = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let mut nodes = b"4\n".to_vec();
    for (i, corner) in corners.iter().enumerate() {
        nodes.extend(ints(&[i as i32 + 1]));
        nodes.extend(reals(corner));
    }
    let tagged = [b"1\n".to_vec(), ints(&[4, 1, 2, 1, 0, 1, 1, 2, 3, 4])].concat();
    let plain = [b"1\n".to_vec(), ints(&[4, 1, 0, 1, 1, 2, 3, 4])].concat();
    let nodes_41 =
        [longs(&[1, 4, 1, 4]), ints(&[3, 1, 0]), longs(&[4, 1, 2, 3, 4]), reals(corners.as_flattened())];
    let elements_41 = [longs(&[1, 1, 1, 1]), ints(&[3, 1, 4]), longs(&[1, 1, 1, 2, 3, 4])];
    let files = [
        TEXT_22.as_bytes().to_vec(),
        TEXT_41.as_bytes().to_vec(),
        binary("2.2", nodes.clone(), tagged),
        binary("2.2", nodes, plain),
        binary("4.1", nodes_41.concat(), elements_41.concat()),
    ];
    for file in &files {
        let cloud = decode_gmsh(file, "t.msh").unwrap();
        assert_eq!(
            (cloud.dim, &*cloud.element, &*cloud.point),
            (3, &[0, 1, 2, 3][..], corners.as_flattened())
        );
        for end in 0..file.len().saturating_sub(14) {
            assert!(decode_gmsh(&file[..end], "t.msh").is_err(), "cut at {end}");
        }
    }
}

#[test]
fn bad_gmsh_files_are_refused_with_line_and_reason() {
    for (text, line, reason) in [
        (TEXT_22.replace("2.2", "3.0"), None, "format 3"),
        (TEXT_22.replace("$Nodes\n4", "$Nodes\nx"), Some(5), "'x' is not a number"),
        (TEXT_22.replace("$Nodes\n4", "$Nodes\n400000"), Some(5), "ends inside"),
        (TEXT_22.replace("$Elements\n1\n", "$Elements\n"), Some(12), "a line of its own"),
        (TEXT_22.replace("1 4 2 0 1 1 2 3 4", "1 5 2 0 1 1 2 3 4"), Some(13), "elements of type 5"),
        (TEXT_22.replace("1 2 3 4\n$EndE", "1 2 3 5\n$EndE"), Some(13), "there is no node 5"),
        (TEXT_41.replace("1 4 1 4\n3", "2 4 1 4\n3"), Some(5), "in one block"),
        (TEXT_41.replace("1\n2\n3\n4\n0", "1\n2\n4\n3\n0"), Some(9), "one after the other"),
        (TEXT_41.replace("3 1 4 1\n", "2 1 4 1\n"), Some(17), "do not fit each other"),
        (TEXT_22.replace("0 8", "0 0"), Some(1), "numbers have 8 bytes"),
        (TEXT_41.replace("0 8", "0 4"), Some(1), "numbers have 8 bytes"),
        (TEXT_22.replace("3 0 1 0", "2 0 1 0"), Some(8), "node 3 is numbered 2"),
        (
            TEXT_22.replace("1\n1 4 2 0 1 1 2 3 4", "2\n1 4 2 0 1 1 2 3 4\n1 4 2 0 1 2 1 3 4"),
            Some(12),
            "two elements are numbered 1",
        ),
        (
            TEXT_41.replace("1 1 1 1\n3 1 4 1\n1 1 2 3 4", "1 2 1 1\n3 1 4 2\n1 1 2 3 4\n1 2 1 3 4"),
            Some(17),
            "two elements are numbered 1",
        ),
    ] {
        let error = decode_gmsh(text.as_bytes(), "t.msh").unwrap_err();
        assert!(error.message.contains(reason), "{error}");
        assert!(line.is_none() || error.line == line, "{error}: {:?}", error.line);
    }
}

#[test]
fn files_become_flexes() {
    let mut files = Memory::default();
    files.insert("t.msh", TEXT_22.as_bytes());
    files.insert("lines.obj", *b"v 0 0 0\nv 1 0 0\nv 1 1 0\nl 1 2 3\n");
    files.insert("sheet.obj", *b"v 0 0 0\nv 1 0 0\nv 1 1 0\nv 9 9 9\nf 1 2 3\n");
    let text = |flexcomp: &str| scene(flexcomp);
    for (flexcomp, vertices, elements) in [
        ("<flexcomp name='f' type='gmsh' file='t.msh' radius='.01'/>", 4, 1),
        ("<flexcomp name='f' type='mesh' dim='1' file='lines.obj'/>", 3, 2),
        ("<flexcomp name='f' type='mesh' dim='2' file='sheet.obj'/>", 3, 1),
        ("<flexcomp name='f' type='mesh' dim='3' file='sheet.obj' origin='0 0 -1'/>", 4, 1),
    ] {
        files.insert("m.xml", text(flexcomp).as_bytes());
        let m = Loader::default().files(files.clone()).load("m.xml").unwrap().model;
        assert_eq!((m.nflexvert, m.nflexelem), (vertices, elements), "{flexcomp}");
    }
}

#[test]
fn the_text_of_the_author_names_the_files_of_flexcomps_from_elsewhere() {
    let mut files = Memory::default();
    files.insert("a/meshes/t.msh", TEXT_22.as_bytes());
    let flexcomp = "<frame><flexcomp name='f' type='gmsh' file='t.msh' radius='.01'/></frame>";
    let text = scene(flexcomp).replace("<mujoco>", "<mujoco><compiler meshdir='meshes'/>");
    files.insert("a/m.xml", text.as_bytes());
    let loader = Loader::default().files(files.clone());
    let kept = loader.flatten("a/m.xml", |path| format!("elsewhere/{path}")).unwrap();
    assert!(kept.contains("file=\"elsewhere/a/meshes/t.msh\"") && kept.contains("name=\"f\""), "{kept}");
    let again = loader.flatten("a/m.xml", str::to_owned).unwrap();
    files.insert("kept.xml", again.as_bytes());
    let (first, second) = (loader.load("a/m.xml"), Loader::default().files(files).load("kept.xml"));
    assert_eq!(first.unwrap().model.to_bytes(), second.unwrap().model.to_bytes());
}
