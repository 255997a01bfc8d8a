//! The engine inside another program: everything is found by name.

use robohive::{Batch, Data, Ray, RayFilter, Snapshot, StepError, forward, load_str, step};

const ARM: &str = r#"
<mujoco>
  <worldbody>
    <geom name="table" type="plane" size="1 1 .1"/>
    <body name="arm" pos="0 0 .3">
      <joint name="elbow" axis="0 1 0" damping=".2"/>
      <geom name="rod" type="capsule" fromto="0 0 0 .5 0 0" size=".02"/>
      <site name="tip" pos=".5 0 0"/>
    </body>
  </worldbody>
  <actuator><position name="bend" joint="elbow" kp="30"/></actuator>
  <sensor><framelinvel name="speed" objtype="site" objname="tip"/></sensor>
</mujoco>"#;

/// Presses an arm on a table.
pub fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut model = load_str(ARM)?.model;
    let (arm, elbow) = (model.body("arm").ok_or("no arm")?, model.joint("elbow").ok_or("no elbow")?);
    let (tip, speed) = (model.site("tip").ok_or("no tip")?, model.sensor("speed").ok_or("no sensor")?);
    let (bend, table) = (model.actuator("bend").ok_or("no motor")?, model.geom("table").ok_or("no table")?);

    // The arm bends; a Jacobian tells how fast its tip moves, as the sensor does.
    let (mut data, mut start) = (Data::new(&model), Snapshot::default());
    data.actuator_mut(bend).set_ctrl(0.8);
    data.save(&mut start);
    (0..20).try_for_each(|_| step(&model, &mut data))?;
    forward(&model, &mut data)?;
    let [velocity, _] = data.jacobian(&model, tip).velocity(&data.state.qvel);
    let differences = velocity.iter().zip(data.sensor(speed).data()).map(|(v, s)| (v - s).abs());
    assert!(velocity[2] < -1.0 && differences.fold(0.0, f64::max) < 1e-12);

    // It presses on the table, and a ray from above sees it. Heavier, it presses harder.
    let mut forces = Vec::new();
    for mass in [0.5, 2.5] {
        model.edit(|m| m.body_mass[arm.index()] = mass)?;
        data.restore(&start)?;
        (0..1000).try_for_each(|_| step(&model, &mut data))?;
        let contact = data.contacts().find(|contact| contact.touches(table)).ok_or("no contact")?;
        forces.push(contact.force(&model)[0]);
        let ray = Ray { origin: [0.3, 0.0, 1.0], direction: [0.0, 0.0, -1.0] };
        let (seen, hit) = data.cast_ray(&model, ray, RayFilter::default()).ok_or("nothing seen")?;
        assert!(model.geom(seen).body() == arm && hit.distance < 1.0);
    }
    assert!(forces.is_sorted_by(|light, heavy| *light > 10.0 && *heavy > light + 5.0), "{forces:?}");

    // Each environment of a batch holds an angle of its own; one spins faster than numbers go.
    let mut batch = Batch::with_payloads(model, vec![-0.4, 0.0, 0.2], 2)?;
    batch.data_mut()[1].joint_mut(elbow).set_qvel([1e12]);
    let result = batch.run(|env| {
        env.data.actuator_mut(bend).set_ctrl(*env.payload);
        (0..500).try_for_each(|_| step(env.model, env.data))
    });
    let failures = result.expect_err("unstable").failures;
    assert!(failures.iter().all(|f| f.environment == 1 && matches!(f.error, StepError::BadQvel(_))));
    Ok(())
}
