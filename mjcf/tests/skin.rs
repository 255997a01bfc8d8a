//! Skins: compiled from text and from SKN files, refused where they are damaged, written, edited.

use physics::Model;
use physics::model::ObjType;
use robohive_mjcf::files::Memory;
use robohive_mjcf::mesh::{SkinSource, skin};
use robohive_mjcf::{Loader, load_str, parse_str};

/// Four vertices; the arm moves three of them, the hand two.
const MODEL: &str = "<mujoco>
  <asset><material name='fur'/></asset>
  <worldbody>
    <body name='arm'><joint/><geom size='.1'/><body name='hand' pos='1 0 0'><joint/><geom size='.1'/></body></body>
  </worldbody>
  <deformable>
    <skin name='coat' material='fur' rgba='1 0 .5 1' inflate='.01' group='3' vertex='0 0 0 1 0 0 0 1 0 0 0 1'
          texcoord='0 0 1 0 0 1 1 1' face='0 1 2 0 2 3'>
      <bone body='arm' bindpos='0 0 .5' bindquat='2 0 0 0' vertid='0 1 2' vertweight='1 .5 3'/>
      <bone body='hand' bindpos='1 0 0' bindquat='0 1 0 0' vertid='1 3' vertweight='1.5 .25'/>
    </skin>
  </deformable>
</mujoco>";

fn check_coat(m: &Model) {
    assert_eq!((m.nskin, m.nskinvert, m.nskintexvert, m.nskinface), (1, 4, 4, 2));
    assert_eq!((m.nskinbone, m.nskinbonevert), (2, 5));
    assert_eq!(m.skin_vert[1..3], [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]);
    assert_eq!(m.skin_texcoord[3], [1.0, 1.0]);
    assert_eq!(m.skin_face[..], [[0, 1, 2], [0, 2, 3]]);
    assert_eq!((&m.skin_bonebodyid[..], &m.skin_bonevertadr[..]), (&[1, 2][..], &[0, 3][..]));
    assert_eq!((&m.skin_bonevertnum[..], &m.skin_bonevertid[..]), (&[3, 2][..], &[0, 1, 2, 1, 3][..]));
    // Weights add up to one at every vertex, orientations have length one.
    assert_eq!(m.skin_bonevertweight[..], [1.0, 0.25, 1.0, 0.75, 1.0]);
    assert_eq!(m.skin_bonebindquat[..], [[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0]]);
    assert_eq!(m.skin_bonebindpos[0], [0.0, 0.0, 0.5]);
}

#[test]
fn a_skin_in_place_fills_its_arrays() {
    let m = load_str(MODEL).unwrap().model;
    check_coat(&m);
    assert_eq!((m.skin_matid[0], m.skin_group[0], m.skin_inflate[0]), (0, 3, 0.01));
    assert_eq!((m.skin_rgba[0], m.skin_pathadr[0], m.skin_texcoordadr[0]), ([1.0, 0.0, 0.5, 1.0], -1, 0));
    assert_eq!(m.id_of(ObjType::Skin, "coat"), Some(0));
    let plain = load_str(MODEL.replace("texcoord='0 0 1 0 0 1 1 1'", "")).unwrap().model;
    assert_eq!((plain.skin_texcoordadr[0], plain.nskintexvert), (-1, 0));
}

/// The skin of [`MODEL`] as a file.
fn file() -> Vec<u8> {
    let mut words: Vec<[u8; 4]> = [4_i32, 4, 2, 2].map(i32::to_le_bytes).into();
    let floats = |values: &[f32]| values.iter().map(|x| x.to_le_bytes()).collect::<Vec<_>>();
    let integers = |values: &[i32]| values.iter().map(|x| x.to_le_bytes()).collect::<Vec<_>>();
    words.extend(floats(&[0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0]));
    words.extend(floats(&[0.0, 0.0, 1.0, 0.0, 0.0, 1.0, 1.0, 1.0]));
    words.extend(integers(&[0, 1, 2, 0, 2, 3]));
    let mut bone = |name: &str, pose: [f32; 7], ids: &[i32], weights: &[f32]| {
        let mut text = [0; 40];
        text[..name.len()].copy_from_slice(name.as_bytes());
        words.extend(text.as_chunks::<4>().0);
        words.extend(floats(&pose));
        words.extend(integers(&[ids.len() as i32]));
        words.extend(integers(ids));
        words.extend(floats(weights));
    };
    bone("arm", [0.0, 0.0, 0.5, 2.0, 0.0, 0.0, 0.0], &[0, 1, 2], &[1.0, 0.5, 3.0]);
    bone("hand", [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0], &[1, 3], &[1.5, 0.25]);
    words.as_flattened().to_vec()
}

/// [`MODEL`] with its skin in a file.
fn with_file() -> String {
    let (before, rest) = MODEL.split_once("<deformable>").unwrap();
    let (_, after) = rest.split_once("</deformable>").unwrap();
    format!("{before}<asset><skin file='looks/coat.skn' group='1'/></asset>{after}")
}

fn files(model: &str, skin: &[u8]) -> Memory {
    let mut memory = Memory::default();
    memory.insert("m/model.xml", model.as_bytes());
    memory.insert("m/looks/coat.skn", skin);
    memory
}

fn refusal(model: &str, skin: &[u8]) -> String {
    match Loader::default().files(files(model, skin)).load("m/model.xml") {
        Ok(_) => panic!("not refused"),
        Err(findings) => findings.to_string(),
    }
}

#[test]
fn a_skin_file_fills_the_same_arrays() {
    let m = Loader::default().files(files(&with_file(), &file())).load("m/model.xml").unwrap().model;
    check_coat(&m);
    assert_eq!((m.id_of(ObjType::Skin, "coat"), m.skin_group[0], m.skin_matid[0]), (Some(0), 1, -1));
    let path = &m.paths[m.skin_pathadr[0] as usize..];
    assert!(path.starts_with(b"looks/coat.skn\0"));
}

#[test]
fn damaged_files_are_refused_wherever_they_end() {
    let whole = file();
    let read = |bytes: &[u8]| {
        skin(SkinSource { file: Some((bytes.to_vec(), "s.skn".into())), ..SkinSource::default() })
    };
    assert!(read(&whole).is_ok());
    for end in 0..whole.len() {
        assert!(read(&whole[..end]).is_err(), "{end} bytes");
    }
    let longer = [&whole[..], &[0; 4]].concat();
    assert!(read(&longer).unwrap_err().message.contains("after its bones"));
    let mut negative = whole.clone();
    negative[3] = 0x80;
    assert!(read(&negative).unwrap_err().message.contains("announces"));
    let mut huge = whole;
    huge[12..16].copy_from_slice(&i32::MAX.to_le_bytes());
    assert!(read(&huge).unwrap_err().message.contains("bones"));
}

#[test]
fn what_is_wrong_with_a_skin_is_said_with_its_place() {
    for (from, to, wanted) in [
        ("face='0 1 2 0 2 3'", "face='0 1 2 0 2 4'", "a face has vertex 4 of 4"),
        ("face='0 1 2 0 2 3'", "face='0 1'", "2 numbers in 'face'"),
        ("vertid='1 3'", "vertid='1 -1'", "bone 'hand': vertex -1 of 4"),
        ("vertweight='1.5 .25'", "vertweight='1.5'", "1 weights for 2 vertices"),
        ("vertweight='1.5 .25'", "vertweight='1.5 0'", "the weights of vertex 3"),
        ("texcoord='0 0 1 0 0 1 1 1'", "texcoord='0 0'", "2 numbers in 'texcoord' for 4 vertices"),
        ("body='hand' bindpos", "body='hnad' bindpos", "no body is named 'hnad'"),
        ("material='fur'", "material='for'", "no material is named 'for'"),
        ("group='3'", "group='6'", "must be 0 to 5"),
        ("bindquat='0 1 0 0'", "bindquat='0 1 0'", "bindquat"),
    ] {
        let findings = load_str(MODEL.replace(from, to)).unwrap_err().to_string();
        assert!(findings.contains(wanted), "{findings}");
    }
    let bones = MODEL.replace("bone body", "bones body");
    assert!(load_str(&bones).unwrap_err().to_string().contains("bones"));
    let both = with_file().replace("group='1'/>", "vertex='0 0 0'/>");
    assert!(refusal(&both, &file()).contains("both a file and data in place"));
    let stranger = with_file().replace("name='hand'", "name='paw'");
    assert!(refusal(&stranger, &file()).contains("there is no body 'hand'"));
}

#[test]
fn skins_are_written_and_read_again() {
    let parsed = parse_str(MODEL).unwrap();
    let text = parsed.spec.to_xml().unwrap();
    let again = parse_str(&text).unwrap();
    assert_eq!(again.spec.to_xml().unwrap(), text);
    check_coat(&load_str(&text).unwrap().model);
    let loader = Loader::default().files(files(&with_file(), &file()));
    let text = loader.parse("m/model.xml").unwrap().spec.to_xml().unwrap();
    assert!(text.contains(r#"<skin group="1" file="looks/coat.skn"/>"#), "{text}");
}

#[test]
fn skins_follow_edits() {
    let mut spec = parse_str(MODEL).unwrap().spec;
    spec.rename(ObjType::Body, "hand", "paw").unwrap();
    spec.rename(ObjType::Skin, "coat", "pelt").unwrap();
    spec.set(ObjType::Skin, "pelt", "inflate", "0.5").unwrap();
    let pelt = spec.skin("pelt").unwrap();
    assert_eq!((pelt.bones[1].body.as_str(), pelt.inflate, pelt.vert.len()), ("paw", 0.5, 12));
    spec.scale("arm", 2.0).unwrap();
    let pelt = spec.skin("pelt").unwrap();
    assert_eq!((pelt.vert[3], pelt.bones[1].bindpos, pelt.inflate), (2.0, [2.0, 0.0, 0.0], 1.0));
    spec.remove(ObjType::Material, "fur").unwrap();
    assert_eq!(spec.skin("pelt").unwrap().material, "");
    spec.remove(ObjType::Body, "paw").unwrap();
    assert!(spec.skins.is_empty());
}

#[test]
fn attached_models_bring_their_skins() {
    let whole = "<mujoco><asset><model name='it' file='model.xml'/></asset>
      <worldbody><attach model='it' body='arm' prefix='my_'/></worldbody></mujoco>";
    let mut memory = files(MODEL, &[]);
    memory.insert("m/whole.xml", whole.as_bytes());
    let m = Loader::default().files(memory.clone()).load("m/whole.xml").unwrap().model;
    check_coat(&m);
    assert!(m.id_of(ObjType::Skin, "my_coat").is_some());
    let half = whole.replace("body='arm'", "body='hand'");
    memory.insert("m/whole.xml", half.as_bytes());
    assert_eq!(Loader::default().files(memory).load("m/whole.xml").unwrap().model.nskin, 0);
}
