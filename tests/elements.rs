//! Names, ids and views against the arrays that they stand for.

mod models;

use models::assets;
use robohive::physics::elements::{BodyId, Element};
use robohive::physics::math::{norm, sub};
use robohive::physics::model::{JointType, Model, ObjType};
use robohive::physics::ray::{Ray, RayFilter};
use robohive::physics::{Data, forward, step};

/// Names of one kind lead to their elements; the number of names.
fn names_lead_back<I: Element + PartialEq + std::fmt::Debug>(
    m: &Model,
    found: impl Fn(&str) -> Option<I>,
) -> usize {
    let mut named = 0;
    for index in 0..I::count(m) {
        let (id, name) = (I::at(m, index).unwrap(), m.name_of(I::KIND, index));
        assert_eq!(id.index(), index);
        if !name.is_empty() {
            assert_eq!(found(name), Some(id), "{:?} {name}", I::KIND);
            named += 1;
        }
    }
    assert!(I::at(m, I::count(m)).is_none());
    assert_eq!(found("no element is called this"), None);
    assert_eq!(found(""), None);
    named
}

#[test]
fn every_name_of_every_kind_leads_to_its_element() {
    let mut named = 0;
    for (_, m) in assets() {
        named += names_lead_back(&m, |n| m.body(n)) + names_lead_back(&m, |n| m.joint(n));
        named += names_lead_back(&m, |n| m.geom(n)) + names_lead_back(&m, |n| m.site(n));
        named += names_lead_back(&m, |n| m.camera(n)) + names_lead_back(&m, |n| m.light(n));
        named += names_lead_back(&m, |n| m.mesh(n)) + names_lead_back(&m, |n| m.hfield(n));
        named += names_lead_back(&m, |n| m.texture(n)) + names_lead_back(&m, |n| m.material(n));
        named += names_lead_back(&m, |n| m.pair(n)) + names_lead_back(&m, |n| m.exclude(n));
        named += names_lead_back(&m, |n| m.equality(n)) + names_lead_back(&m, |n| m.tendon(n));
        named += names_lead_back(&m, |n| m.actuator(n)) + names_lead_back(&m, |n| m.sensor(n));
        named += names_lead_back(&m, |n| m.numeric(n)) + names_lead_back(&m, |n| m.text(n));
        named += names_lead_back(&m, |n| m.tuple(n)) + names_lead_back(&m, |n| m.key(n));
    }
    assert!(named > 200, "{named}");
}

#[test]
fn iterators_visit_every_element_once() {
    for (name, m) in assets() {
        assert_eq!(m.joints().len(), m.njnt, "{name}");
        assert!(m.bodies().map(|body| body.index()).eq(0..m.nbody));
        let named: Vec<_> = m.geom_names().collect();
        assert!(named.iter().all(|(id, name)| m.geom(*name) == Some(*id) && m.geom(*id).name() == *name));
        let bearing = (0..m.ngeom).filter(|&g| !m.name_of(ObjType::Geom, g).is_empty()).count();
        assert_eq!(named.len(), bearing);
    }
}

#[test]
fn the_tree_of_bodies_can_be_walked() {
    for (_, m) in assets() {
        let world = m.bodies().next().unwrap();
        assert_eq!((m.body(world).parent(), m.body(world).name()), (None, "world"));
        let mut reached = vec![world];
        let mut at = 0;
        while let Some(&body) = reached.get(at) {
            reached.extend(m.body(body).children());
            at += 1;
        }
        assert_eq!(reached.len(), m.nbody);
        let joints: usize = m.bodies().map(|body| m.body(body).joints().len()).sum();
        let geoms: usize = m.bodies().map(|body| m.body(body).geoms().len()).sum();
        assert_eq!((joints, geoms), (m.njnt, m.ngeom));
        assert!(m.geoms().all(|geom| m.body(m.geom(geom).body()).geoms().any(|own| own == geom)));
        assert!(m.joints().all(|joint| m.body(m.joint(joint).body()).joints().any(|own| own == joint)));
    }
}

#[test]
fn views_show_the_arrays() {
    for (name, m) in assets() {
        let mut d = Data::new(&m);
        d.state.ctrl.iter_mut().enumerate().for_each(|(k, u)| *u = 0.1 * k as f64);
        (0..20).for_each(|_| step(&m, &mut d).unwrap());
        forward(&m, &mut d).unwrap();
        let flat = |parts: Vec<&[f64]>| parts.concat();
        assert_eq!(flat(m.joints().map(|j| d.joint(j).qpos()).collect()), d.state.qpos, "{name}");
        assert_eq!(flat(m.joints().map(|j| d.joint(j).qvel()).collect()), d.state.qvel);
        assert_eq!(flat(m.joints().map(|j| d.joint(j).qacc()).collect()), d.acc.qacc);
        assert_eq!(flat(m.actuators().map(|a| d.actuator(a).ctrl()).collect()), d.state.ctrl);
        assert_eq!(flat(m.actuators().map(|a| d.actuator(a).act()).collect()), d.state.act);
        assert_eq!(flat(m.actuators().map(|a| d.actuator(a).force()).collect()), d.actuation.actuator_force);
        assert_eq!(flat(m.sensors().map(|s| d.sensor(s).data()).collect()), d.sensor.sensordata);
        assert!(m.bodies().map(|b| *d.body(b).xpos()).eq(d.kin.xpos.iter().copied()));
        assert!(m.sites().map(|s| *d.site(s).xmat()).eq(d.kin.site_xmat.iter().copied()));
        assert!(m.geoms().map(|g| *d.geom(g).xpos()).eq(d.kin.geom_xpos.iter().copied()));
        assert!(m.cameras().map(|c| *d.camera(c).xpos()).eq(d.kin.cam_xpos.iter().copied()));
        assert!(m.tendons().map(|t| d.tendon(t).length()).eq(d.ten.ten_length.iter().copied()));
    }
}

const SCENE: &str = r#"
<mujoco>
  <worldbody>
    <geom name="floor" type="plane" size="2 2 .1"/>
    <body name="target" mocap="true" pos="0 0 3"><geom name="lamp" size=".05" contype="0" conaffinity="0"/></body>
    <body name="ball" pos="0 0 .1">
      <freejoint name="free"/>
      <geom name="ball" size=".1" mass="2"/>
      <site name="pole" pos="0 0 .1"/>
    </body>
    <body name="arm" pos="1 0 1">
      <joint name="shoulder" axis="0 1 0"/>
      <geom name="rod" type="capsule" fromto="0 0 0 .5 0 0" size=".02"/>
      <body name="hand" pos=".5 0 0">
        <joint name="wrist" type="ball"/>
        <geom name="palm" size=".05"/>
        <site name="grip" pos=".1 0 .02"/>
      </body>
    </body>
  </worldbody>
  <equality><weld name="hold" body1="target" body2="ball" active="false"/></equality>
  <actuator><motor name="lift" joint="shoulder" ctrlrange="-3 3" gear="2"/></actuator>
  <custom><numeric name="gains" data="1 2 3"/><text name="note" data="by name"/></custom>
</mujoco>"#;

#[test]
fn states_and_inputs_are_written_by_id() {
    let m = robohive::mjcf::load_str(SCENE).unwrap().model;
    let mut d = Data::new(&m);
    let (free, wrist) = (m.joint("free").unwrap(), m.joint("wrist").unwrap());
    assert_eq!((m.joint(free).kind(), m.joint(wrist).kind()), (Some(JointType::Free), Some(JointType::Ball)));
    d.joint_mut(free).set_qpos([0.3, 0.0, 0.5, 1.0, 0.0, 0.0, 0.0]);
    d.joint_mut(wrist).set_qvel([0.0, 0.2, 0.0]);
    d.joint_mut(wrist).set_qfrc_applied([0.0, 0.0, 0.1]);
    d.actuator_mut(m.actuator("lift").unwrap()).set_ctrl(1.5);
    d.body_mut(m.body("ball").unwrap()).set_xfrc_applied([0.0, 0.0, 5.0, 0.0, 0.0, 0.0]);
    assert_eq!(d.state.qpos, [0.3, 0.0, 0.5, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0]);
    assert_eq!(d.state.qvel, [0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.2, 0.0]);
    forward(&m, &mut d).unwrap();
    assert_eq!(d.body(m.body("ball").unwrap()).xpos(), &[0.3, 0.0, 0.5]);
    assert_eq!(d.joint(m.joint("shoulder").unwrap()).qfrc_actuator(), [3.0]);
    assert!((d.joint(free).qacc()[2] - (5.0 / 2.0 - 9.81)).abs() < 1e-12, "the wrench lifts");
    let (target, hold) = (m.body("target").unwrap(), m.equality("hold").unwrap());
    *d.body_mut(target).mocap().unwrap().pos = [0.3, 0.0, 2.5];
    assert!(d.body_mut(m.body("arm").unwrap()).mocap().is_none());
    assert!(!d.equality(hold).active() && d.efc.ne == 0);
    d.equality_mut(hold).set_active(true);
    forward(&m, &mut d).unwrap();
    assert_eq!((d.efc.ne, d.body(target).xpos()), (6, &[0.3, 0.0, 2.5]));
    assert_eq!(m.numeric(m.numeric("gains").unwrap()).data(), [1.0, 2.0, 3.0]);
    assert_eq!(m.text(m.text("note").unwrap()).data(), "by name");
}

#[test]
fn contacts_know_their_geoms_and_carry_the_weight() {
    let m = robohive::mjcf::load_str(SCENE).unwrap().model;
    let mut d = Data::new(&m);
    (0..1000).for_each(|_| step(&m, &mut d).unwrap());
    let (floor, ball) = (m.geom("floor").unwrap(), m.geom("ball").unwrap());
    let contact = d.contacts().find(|c| c.touches(ball)).unwrap();
    assert_eq!(contact.geoms(), [Some(floor), Some(ball)]);
    assert_eq!(m.geom(ball).body(), m.body("ball").unwrap());
    assert!(norm(sub(contact.normal(), [0.0, 0.0, 1.0])) < 1e-12 && contact.dist() < 0.0);
    assert!((contact.force(&m)[0] - 2.0 * 9.81).abs() < 1e-6, "{:?}", contact.force(&m));
    assert!(!contact.touches(m.geom("palm").unwrap()));
}

#[test]
fn jacobians_map_velocities_and_wrenches() {
    let m = robohive::mjcf::load_str(SCENE).unwrap().model;
    let mut d = Data::new(&m);
    let (grip, shoulder) = (m.site("grip").unwrap(), m.joint("shoulder").unwrap());
    forward(&m, &mut d).unwrap();
    let (jacobian, before) = (d.jacobian(&m, grip), *d.site(grip).xpos());
    d.joint_mut(shoulder).set_qvel([0.7]);
    let [linear, angular] = jacobian.velocity(&d.state.qvel);
    assert_eq!(angular, [0.0, 0.7, 0.0]);
    assert!(norm(linear) > 0.4);
    d.joint_mut(shoulder).set_qpos([0.7e-6]);
    forward(&m, &mut d).unwrap();
    let moved = sub(*d.site(grip).xpos(), before).map(|x| x / 1e-6);
    assert!(norm(sub(moved, linear)) < 1e-6, "{moved:?} {linear:?}");
    let (force, torque) = ([1.0, 2.0, -3.0], [0.4, -0.5, 0.6]);
    let mut qfrc = vec![0.0; m.nv];
    jacobian.add_wrench(force, torque, &mut qfrc);
    let power: f64 = qfrc.iter().zip(&d.state.qvel).map(|(f, v)| f * v).sum();
    let expected: f64 = (0..3).map(|k| force[k] * linear[k] + torque[k] * angular[k]).sum();
    assert!((power - expected).abs() < 1e-12 && expected.abs() > 0.1, "{power} {expected}");
}

#[test]
fn rays_tell_the_geom_they_hit() {
    let m = robohive::mjcf::load_str(SCENE).unwrap().model;
    let mut d = Data::new(&m);
    forward(&m, &mut d).unwrap();
    let down = |x| Ray { origin: [x, 0.0, 2.0], direction: [0.0, 0.0, -1.0] };
    let (geom, hit) = d.cast_ray(&m, down(0.0), RayFilter::default()).unwrap();
    assert_eq!((m.geom(geom).name(), hit.normal), ("ball", [0.0, 0.0, 1.0]));
    assert!((hit.distance - 1.8).abs() < 1e-12);
    let (geom, _) = d.cast_ray(&m, down(-1.0), RayFilter::default()).unwrap();
    assert_eq!(m.geom(geom).name(), "floor");
    assert!(d.cast_ray(&m, down(50.0), RayFilter::default()).is_none());
}

#[test]
fn an_id_outlives_an_edit() {
    let mut m = robohive::mjcf::load_str(SCENE).unwrap().model;
    let ball: BodyId = m.body("ball").unwrap();
    m.edit(|m| m.body_mass[ball.index()] = 5.0).unwrap();
    assert_eq!((m.body("ball"), m.body(ball).mass()), (Some(ball), 5.0));
}

/// The same kinds of elements in another order.
const OTHER: &str = r#"
<mujoco>
  <worldbody>
    <body name="arm"><joint name="shoulder" axis="0 1 0"/><geom name="rod" size=".1"/></body>
    <body name="ball" pos="0 0 1"><freejoint name="free"/><geom name="ball" size=".1"/></body>
  </worldbody>
  <actuator><motor name="lift" joint="shoulder"/></actuator>
</mujoco>"#;

#[test]
fn an_id_serves_every_model_of_its_structure() {
    let m = robohive::mjcf::load_str(SCENE).unwrap().model;
    let ball = m.body("ball").unwrap();
    let edited = m.edited(|m| m.body_mass[ball] = 5.0).unwrap();
    let rewritten = m.edited(|m| m.jnt_type.swap(0, 0)).unwrap();
    let again = robohive::mjcf::load_str(SCENE).unwrap().model;
    let read = Model::from_bytes(&m.to_bytes()).unwrap();
    for other in [m.clone(), edited, rewritten, again, read] {
        let mut d = Data::new(&other);
        forward(&other, &mut d).unwrap();
        assert_eq!(other.body(ball).name(), "ball");
        assert_eq!(d.body(ball).xpos(), &[0.0, 0.0, 0.1]);
        assert_eq!(other.body("ball"), Some(ball));
        d.actuator_mut(m.actuator("lift").unwrap()).set_ctrl(1.0);
        assert_eq!(d.state.ctrl, [1.0]);
        assert!(d.contacts().any(|contact| contact.touches(m.geom("ball").unwrap())));
    }
}

#[cfg(debug_assertions)]
#[test]
fn debug_builds_refuse_an_id_of_another_model() {
    use std::panic::{AssertUnwindSafe, catch_unwind};
    let m = robohive::mjcf::load_str(SCENE).unwrap().model;
    let other = robohive::mjcf::load_str(OTHER).unwrap().model;
    let mut d = Data::new(&m);
    forward(&m, &mut d).unwrap();
    let (shoulder, lift) = (other.joint("shoulder").unwrap(), other.actuator("lift").unwrap());
    let (ball, geom) = (other.body("ball").unwrap(), other.geom("ball").unwrap());
    let uses: [&mut dyn FnMut(); 5] = [
        &mut || assert!(m.joint(shoulder).name().is_empty()),
        &mut || assert!(d.joint(shoulder).qpos().is_empty()),
        &mut || d.clone().actuator_mut(lift).set_ctrl(1.0),
        &mut || drop(d.jacobian(&m, ball)),
        &mut || assert!(d.contacts().all(|contact| contact.touches(geom))),
    ];
    for (number, refused) in uses.into_iter().enumerate() {
        let payload = catch_unwind(AssertUnwindSafe(refused)).unwrap_err();
        let message = payload.downcast_ref::<&str>().copied().unwrap_or_default();
        assert!(message.starts_with("this id belongs to another model"), "{number}: {message:?}");
    }
}
