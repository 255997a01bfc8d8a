//! The compile of small models: laws that hold whatever the numbers, and refusals.

use robohive_mjcf::load_str;

fn compile(text: &str) -> physics::Model {
    load_str(text).unwrap_or_else(|errors| panic!("{errors}")).model
}

fn refusal(text: &str) -> String {
    load_str(text).map(|_| ()).expect_err("the model must be refused").to_string()
}

/// A trunk with two arms, the second with two fingers; a rail apart from it.
const TREE: &str = r#"
<mujoco>
  <worldbody>
    <body name="trunk">
      <joint type="ball"/>
      <geom type="capsule" fromto="0 0 0 0 0 .5" size=".05"/>
      <body name="left" pos="0 .1 .5">
        <joint axis="0 1 0"/>
        <geom type="box" size=".1 .02 .03" pos=".1 0 0"/>
        <body name="plate" pos=".2 0 0" euler="0 30 0">
          <geom type="cylinder" size=".04 .01" pos="0 0 .02"/>
          <body name="finger1" pos="0 .03 0">
            <joint type="slide" axis="1 0 0"/>
            <geom size=".02"/>
          </body>
          <body name="finger2" pos="0 -.03 0">
            <joint axis="0 0 1" pos="0 .01 0"/>
            <geom type="ellipsoid" size=".02 .03 .01"/>
          </body>
        </body>
      </body>
      <body name="right" pos="0 -.1 .5">
        <joint axis="1 0 0"/>
        <geom type="box" size=".03 .1 .02" quat="1 .3 .2 .1"/>
      </body>
    </body>
    <body name="rail">
      <joint type="slide" axis="1 0 0"/>
      <joint type="slide" axis="0 1 0"/>
      <geom type="box" size=".1 .2 .3"/>
    </body>
  </worldbody>
</mujoco>"#;

#[test]
fn patterns_of_inertia_agree_with_the_tree() {
    let m = compile(TREE);
    assert_eq!((m.nv, m.nM, m.nC, m.ntree), (9, 27, 26, 2));
    assert_eq!(m.body_simple[m.nbody - 1], 2, "a box on aligned sliders is simple");
    for row in 0..m.nv {
        let columns =
            |address: &[i32], count: &[i32]| address[row] as usize..(address[row] + count[row]) as usize;
        for k in columns(&m.D_rowadr, &m.D_rownnz) {
            let (low, high) = (row.min(m.D_colind[k] as usize), row.max(m.D_colind[k] as usize));
            let Ok(entry) = usize::try_from(m.mapM2D[k]) else { continue };
            assert_eq!(m.M_colind[entry] as usize, low);
            assert!(columns_of(&m, high).contains(&entry));
        }
        for k in columns(&m.M_rowadr, &m.M_rownnz) {
            let entry = m.mapD2M[k] as usize;
            assert_eq!(m.D_colind[entry], m.M_colind[k]);
            let hops = m.mapM2M[k] - m.dof_Madr[row];
            let above = (0..hops).fold(row as i32, |dof, _| m.dof_parentid[dof as usize]);
            assert_eq!(above, m.M_colind[k]);
        }
    }
}

fn columns_of(m: &physics::Model, row: usize) -> std::ops::Range<usize> {
    m.M_rowadr[row] as usize..(m.M_rowadr[row] + m.M_rownnz[row]) as usize
}

#[test]
fn fusing_static_bodies_keeps_the_mechanism() {
    let whole = compile(TREE);
    let fused = compile(&TREE.replace("<worldbody>", r#"<compiler fusestatic="true"/><worldbody>"#));
    assert_eq!((whole.nbody, fused.nbody, fused.ngeom), (8, 7, whole.ngeom));
    assert!(fused.id_of(physics::model::ObjType::Body, "plate").is_none());
    for dof in 0..whole.nv {
        let (a, b) = (whole.dof_M0[dof], fused.dof_M0[dof]);
        assert!(a > 1e-6 && (a - b).abs() < 1e-12, "{dof}: {a} {b}");
        assert!(
            (whole.dof_invweight0[dof] - fused.dof_invweight0[dof]).abs() < 1e-9 * whole.dof_invweight0[dof]
        );
    }
}

/// MuJoCo 3.12.0's numbers: former leaves at inner nodes, and spare nodes behind the last tree.
#[test]
fn fused_hierarchies_keep_what_mujoco_keeps() {
    let fused = |bodies: &str| {
        compile(&format!("<mujoco><compiler fusestatic='true'/><worldbody>{bodies}</worldbody></mujoco>"))
    };
    let m = fused(
        "<body><freejoint/><geom size='.1'/><geom size='.3' pos='0 0 2' contype='0' conaffinity='0'/>
         <body pos='1 0 0'><geom size='.1'/><body pos='1 0 0'><geom size='.1'/><body pos='1 0 0'>
         <geom size='.1'/><geom size='.1' pos='0 0 1'/><body pos='1 0 0'><geom size='.1'/></body>
         </body></body></body></body>
         <body pos='3 3 3'><geom size='.1'/><geom size='.2'/><body pos='0 2 0'><geom size='.2'/></body></body>",
    );
    assert_eq!((m.nbody, m.nbvh, &m.body_bvhnum[..]), (2, 21, &[5, 11][..]));
    assert_eq!(&m.bvh_nodeid[..5], [-1, 0, 1, 1, 2]);
    assert_eq!(&m.bvh_nodeid[5..16], [3, 6, 3, 5, 5, 6, -1, 8, 8, 7, 9]);
    assert_eq!(&m.bvh_nodeid[16..], [0; 5]);
    assert_eq!(m.bvh_child[16..], [[0, 0]; 5]);
    // Trees without a leaf leave nothing behind.
    let m = fused(
        "<body pos='1 0 0'><geom size='.1'/><geom size='.1' pos='0 1 0'/></body>
         <body pos='0 1 0'><geom size='.1'/><body pos='0 0 1'><geom size='.2'/></body></body>",
    );
    assert_eq!(&m.bvh_nodeid[..], [-1, 2, 2, 3, 1, 0, 1, 0, 0]);
}

#[test]
fn fused_inertia_is_mujocos_to_the_last_bit() {
    let m = compile(
        "<mujoco><compiler fusestatic='true'/><worldbody><body><freejoint/>
         <inertial pos='0 0 0' mass='1' diaginertia='.7 .8 .9'/>
         <body pos='.3 .1 .2'><inertial pos='0 0 0' mass='.7' diaginertia='.5 .6 .7'/></body>
         </body></worldbody></mujoco>",
    );
    assert_eq!(m.body_inertia[1], [1.6429203110361983, 1.4539306096472717, 1.2184431969635852]);
}

#[test]
fn total_mass_is_scaled_and_visual_geoms_still_weigh() {
    let text = TREE.replace(
        "<worldbody>",
        r#"<compiler settotalmass="3" discardvisual="true"/><default><geom contype="0" conaffinity="0"/></default><worldbody>"#,
    );
    let m = compile(&text);
    assert_eq!(m.ngeom, 0);
    assert!((m.body_subtreemass[0] - 3.0).abs() < 1e-12);
    let whole = compile(TREE);
    let ratio = m.body_mass[1] / whole.body_mass[1];
    assert!((m.body_inertia[1][0] / whole.body_inertia[1][0] - ratio).abs() < 1e-12 && ratio < 1.0);
}

#[test]
fn references_are_checked_with_advice_and_position() {
    let text = TREE
        .replace(r#"<joint axis="0 1 0"/>"#, r#"<joint name="elbow" axis="0 1 0"/>"#)
        .replace("</worldbody>", "</worldbody>\n<actuator>\n<motor name=\"m\" joint=\"elbo\"/></actuator>");
    let message = refusal(&text);
    assert!(message.contains("elbo") && message.contains("'elbow'"), "{message}");
    let line = text.lines().position(|l| l.contains("motor")).unwrap() + 1;
    assert!(message.contains(&format!(":{line}:")), "{message}");
}

#[test]
fn what_cannot_move_or_exist_is_refused() {
    let body =
        |inside: &str| format!("<mujoco><worldbody><body name=\"b\">{inside}</body></worldbody></mujoco>");
    let massless = refusal(&body("<joint/>"));
    assert!(massless.contains("'b'") && massless.contains("mass"), "{massless}");
    let unbalanced = body(r#"<joint/><inertial pos="0 0 0" mass="1" diaginertia="1 1 3"/>"#);
    assert!(refusal(&unbalanced).contains("balanceinertia"));
    let plane = refusal(&body(r#"<joint/><geom size="1"/><geom type="plane" size="1 1 1"/>"#));
    assert!(plane.contains("plane"), "{plane}");
    let size = refusal(&body(r#"<geom name="g" type="box" size="1 0 1"/>"#));
    assert!(size.contains("'g'") && size.contains("size 2"), "{size}");
    let double = refusal(&body(r#"<geom name="g" size="1"/><geom name="g" size="1"/>"#));
    assert!(double.contains("duplicate"), "{double}");
}

#[test]
fn short_keyframes_are_completed() {
    let text =
        TREE.replace("</worldbody>", r#"</worldbody><keyframe><key name="k" qpos="2 0 0 0 .5"/></keyframe>"#);
    let m = compile(&text);
    assert_eq!((m.nkey, m.key_qpos.len(), m.key_qvel.len()), (1, m.nq, m.nv));
    assert_eq!(m.key_qpos[..6], [1.0, 0.0, 0.0, 0.0, 0.5, 0.0]);
}

/// Measured with MuJoCo 3.12.0: poses of bodies do not count, and `ref` is not converted.
#[test]
fn a_position_given_in_part_goes_on_without_the_poses_of_bodies() {
    let keyed = |key: &str| {
        let text = format!(
            "<mujoco><worldbody><body><joint type='slide' ref='.3'/><geom size='.1'/></body>
             <body pos='1 2 3' quat='0 1 0 0'><freejoint/><geom size='.1'/></body>
             <body><joint ref='20'/><geom size='.1'/></body>
             <body quat='0 0 1 0'><joint type='ball'/><geom size='.1'/></body></worldbody>
             <keyframe><key {key}/></keyframe></mujoco>"
        );
        compile(&text)
    };
    let whole = keyed("");
    assert_eq!(whole.key_qpos[..], whole.qpos0[..]);
    assert_eq!(
        keyed("qpos='.5'").key_qpos[..],
        [0.5, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 20.0, 1.0, 0.0, 0.0, 0.0]
    );
    assert_eq!(keyed("qpos='.5 1 2'").key_qpos[..6], [0.5, 1.0, 2.0, 0.0, 1.0, 0.0]);
}

/// Measured with MuJoCo 3.12.0: a body whose numbers are not all given keeps its pose.
#[test]
fn mocap_poses_given_in_part_count_body_by_body() {
    let keyed = |key: &str| {
        let text = format!(
            "<mujoco><worldbody><body mocap='true' pos='4 5 6' quat='0 1 0 0'/>
             <body mocap='true' pos='7 8 9' quat='0 0 0 1'/></worldbody><keyframe><key {key}/></keyframe></mujoco>"
        );
        let loaded = robohive_mjcf::load_str(text).unwrap_or_else(|found| panic!("{found}"));
        let m = loaded.model;
        (m.key_mpos.to_vec(), m.key_mquat.to_vec(), loaded.warnings.iter().count())
    };
    let (mpos, mquat) = (vec![4.0, 5.0, 6.0, 7.0, 8.0, 9.0], vec![0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0]);
    for key in ["mpos='1'", "mpos='1 1'", "mquat='1'", "mquat='0 0 1'"] {
        assert_eq!(keyed(key), (mpos.clone(), mquat.clone(), 1), "{key}");
    }
    assert_eq!(keyed("mpos='1 1 1 2'"), (vec![1.0, 1.0, 1.0, 7.0, 8.0, 9.0], mquat.clone(), 1));
    assert_eq!(keyed("mquat='0 0 1 0 1 0'").1, [0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0]);
    assert_eq!(keyed("mpos='1 1 1'"), (vec![1.0, 1.0, 1.0, 7.0, 8.0, 9.0], mquat, 0));
}

#[test]
fn a_computed_sphere_has_the_vertices_of_its_subdivisions() {
    let text = r#"<mujoco>
        <asset><mesh name="ball" builtin="sphere" params="1"/></asset>
        <worldbody><body><freejoint/><geom type="mesh" mesh="ball"/></body></worldbody>
    </mujoco>"#;
    let m = compile(text);
    assert_eq!((m.nmeshvert, m.nmeshface), (42, 80));
    // Icosahedral symmetry: equal moments.
    let [x, y, z] = m.body_inertia[1];
    assert!((x - y).abs() < 1e-4 * x && (x - z).abs() < 1e-4 * x);
}

#[test]
fn a_tendon_that_misses_its_geom_leaves_the_geoms_island_alone() {
    let text = r#"<mujoco>
        <worldbody>
            <site name="anchor" pos="0 0 1"/>
            <body pos="1 0 0.5"><joint type="slide" axis="1 0 0" frictionloss="1"/><geom name="post" size="0.1"/></body>
            <body><joint name="pulled" type="slide" axis="0 0 1" frictionloss="1"/><geom size="0.1"/><site name="end"/></body>
        </worldbody>
        <tendon>
            <spatial limited="true" range="0 0.9"><site site="anchor"/><geom geom="post"/><site site="end"/></spatial>
        </tendon>
    </mujoco>"#;
    let m = compile(text);
    let mut d = physics::Data::new(&m);
    physics::step(&m, &mut d).unwrap();
    assert!(d.acc.qacc[1] > 0.0, "the stretched tendon pulls up");
    assert_eq!(d.state.qpos[0], 0.0);
}

/// Inverse weights, which are computed tree by tree, equal those of dense rows and the whole inertia to the last bit.
#[test]
fn inverse_weights_within_trees_are_those_of_the_whole_inertia() {
    use physics::math::dense::dot_slice;
    use physics::position::jacobian::Jacobian;
    use physics::{Data, inertia};
    for name in ["workbench/workbench", "pile/pile", "yard/yard", "humanoid/humanoid"] {
        let path = format!("{}/../assets/{name}.xml", env!("CARGO_MANIFEST_DIR"));
        let m = robohive_mjcf::load(&path).unwrap_or_else(|errors| panic!("{errors}")).model;
        let mut d = Data::new(&m);
        d.state.qpos.copy_from_slice(&m.qpos0);
        physics::forward(&m, &mut d).unwrap();
        let mut jacobian = Jacobian::default();
        let mut compared = 0;
        for b in (1..m.nbody).filter(|&b| m.body_invweight0[b][1] > 0.0) {
            jacobian.body_com(&m, &d.kin, &d.com, b);
            for (k, rows) in [&jacobian.pos, &jacobian.rot].into_iter().enumerate() {
                let weight = |axis: usize| {
                    let row = &rows[axis * m.nv..(axis + 1) * m.nv];
                    let mut solution = row.to_vec();
                    inertia::solve(&m, &d.inertia, &mut solution);
                    dot_slice(row, &solution)
                };
                assert_eq!(
                    m.body_invweight0[b][k],
                    (weight(0) + weight(1) + weight(2)) / 3.0,
                    "{name}, body {b}"
                );
                compared += 1;
            }
        }
        assert!(compared > 8, "{name}");
    }
}
