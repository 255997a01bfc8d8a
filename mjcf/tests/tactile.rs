//! Tactile sensors: arrays, readings, the way back to text and to bytes, and what is refused.

use physics::model::{ObjType, SensorType, Stage};
use physics::{Data, Model, forward};
use robohive_mjcf::{Loader, load_str, parse_str};

/// A box of 4 cm that has sunk 1 mm into the floor and slides at 0.5 m/s, with points below. In MuJoCo as here, the
/// tangents are turned by the mesh's frame once more: the first, x in the text, reads y, the second z.
const MODEL: &str = "<mujoco>
  <asset><mesh name='pad' builtin='plate' params='3 2' scale='.02 .02 .02'/></asset>
  <worldbody>
    <geom name='floor' type='plane' size='1 1 .1'/>
    <body name='tip' pos='0 0 .019'>
      <joint name='x' type='slide' axis='.6 .8 0'/><joint name='z' type='slide' axis='0 0 1'/>
      <geom type='box' size='.02 .02 .02' mass='.1'/>
      <geom name='pad' type='mesh' mesh='pad' mass='0' contype='0' conaffinity='0'/>
    </body>
  </worldbody>
  <sensor><clock/><tactile name='touch' geom='pad' mesh='pad'/></sensor>
</mujoco>";

#[test]
fn every_vertex_reads_its_depth_and_two_speeds() {
    let m = load_str(MODEL).unwrap().model;
    assert_eq!((m.sensor_type[1], m.sensor_dim[1], m.sensor_adr[1]), (SensorType::Tactile.code(), 18, 1));
    let [object, reference] = [m.sensor_objtype[1], m.sensor_reftype[1]];
    assert_eq!([object, reference], [ObjType::Mesh.code(), ObjType::Geom.code()]);
    assert_eq!((m.sensor_objid[1], m.sensor_refid[1], m.sensor_needstage[1]), (0, 2, Stage::Acc.code()));
    let mut d = Data::new(&m);
    d.state.qvel[0] = 0.5;
    forward(&m, &mut d).unwrap();
    let readings = &d.sensor.sensordata[1..];
    assert!(readings[..6].iter().all(|depth| (depth - 1e-3).abs() < 1e-9), "{readings:?}");
    assert!(readings[6..12].iter().all(|speed| (speed - 0.4).abs() < 1e-7), "{readings:?}");
    assert!(readings[12..].iter().all(|speed| speed.abs() < 1e-7), "{readings:?}");
    // Above the floor nothing is felt.
    d.state.qpos[1] = 0.01;
    forward(&m, &mut d).unwrap();
    assert_eq!(d.sensor.sensordata[1..], [0.0; 18]);
}

#[test]
fn a_mesh_with_one_normal_a_vertex_reads_depths_alone() {
    let m = load_str(
        MODEL
            .replace("builtin='plate' params='3 2'", "builtin='sphere' params='0'")
            .replace("'pad' type", "'pad' pos='0 0 -.005' type"),
    )
    .unwrap()
    .model;
    let mut d = Data::new(&m);
    d.state.qvel[0] = 0.5;
    forward(&m, &mut d).unwrap();
    let (depths, speeds) = d.sensor.sensordata[1..].split_at(12);
    assert_eq!(depths.iter().filter(|depth| (**depth - 0.003_013_02).abs() < 1e-8).count(), 2, "{depths:?}");
    assert_eq!(speeds, [0.0; 24]);
}

#[test]
fn the_sensor_comes_back_from_text_and_from_bytes() {
    let text = MODEL
        .replace("name='touch'", "name='touch' nsample='4' interp='linear' delay='.01' interval='.02 0'");
    let parsed = parse_str(&text).unwrap();
    let written = parsed.spec.to_xml().unwrap();
    let model = Loader::default().compile(parsed).unwrap().model;
    let again = load_str(&written).unwrap_or_else(|e| panic!("{e}\n{written}")).model;
    assert_eq!(again.to_bytes(), model.to_bytes());
    assert_eq!(Model::from_bytes(&model.to_bytes()).unwrap().to_bytes(), model.to_bytes());
    assert!(written.contains("<tactile") && model.nhistory > 4 * 18, "{written}");
}

#[test]
fn sensors_that_cannot_be_are_refused_with_the_way_out() {
    let inert = "type='box' contype='0' conaffinity='0'";
    for (from, to, expected) in [
        ("geom='pad' mesh='pad'", "geom='pad' mesh='pda'", "'pda'"),
        ("geom='pad' mesh='pad'", "geom='bad' mesh='pad'", "'bad'"),
        ("geom='pad' mesh='pad'", "mesh='pad'", "<tactile> needs the attribute 'geom'"),
        ("geom='pad' mesh='pad'", "geom='pad'", "<tactile> needs the attribute 'mesh'"),
        ("geom='pad' mesh='pad'", "geom='pad' mesh='pad' cutoff='1'", "'cutoff'"),
        (
            "<geom type='box'",
            &format!("<geom {inert}"),
            "give the body a geom whose 'contype' or 'conaffinity' is not 0",
        ),
    ] {
        let text = MODEL.replace(from, to);
        assert_ne!(text, MODEL);
        let message = load_str(&text).map(|_| ()).expect_err(to).to_string();
        assert!(message.contains(expected) && message.starts_with("<text>:11:"), "{to}: {message}");
    }
}

#[test]
fn bytes_with_another_mesh_or_number_of_readings_are_refused() {
    let m = load_str(MODEL).unwrap().model;
    let broken = |change: &dyn Fn(&mut physics::model::Arrays)| {
        let mut m = m.clone();
        change(m.unchecked_mut());
        Model::from_bytes(&m.to_bytes()).map(|_| ()).expect_err("inconsistent").to_string()
    };
    assert!(broken(&|m| m.sensor_objid[1] = 1).contains("sensor_objid"));
    assert!(broken(&|m| m.sensor_refid[1] = 9).contains("sensor_objid"));
    assert!(broken(&|m| m.mesh_vertnum[0] = 5).contains("mesh"));
}
