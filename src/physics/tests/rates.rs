//! Rates of constraints and tendons are derivatives along the motion, and armature is inertia of the tendon's own velocity:
//! laws that hold whatever the numbers are.

use robohive_physics::math::{norm, quat_mul, quat_mul_axis};
use robohive_physics::{Data, Model, forward, inertia};

/// An arm, and a tendon along it. Inertia couples joints of one chain alone, so the tendon stays on one.
fn model(equality: &str, armature: f64) -> Model {
    let text = format!(
        "<mujoco>
          <worldbody>
            <site name='post' pos='.3 -.2 .4'/>
            <body>
              <joint axis='0 1 0'/><joint axis='0 0 1'/><geom type='capsule' fromto='0 0 0 .5 0 0' size='.03'/>
              <body name='first' pos='.5 0 0'>
                <joint axis='0 1 .2'/><geom type='capsule' fromto='0 0 0 .4 0 0' size='.03'/>
                <site name='tip' pos='.35 .02 0'/>
                <body name='second' pos='.4 0 .1'>
                  <joint axis='1 .3 0'/><joint axis='0 1 0'/><geom type='capsule' fromto='0 0 0 .3 0 .1' size='.03'/>
                  <site name='end' pos='.25 0 .1'/>
                </body>
              </body>
            </body>
          </worldbody>
          <equality>{equality}</equality>
          <tendon>
            <spatial armature='{armature}'>
              <site site='post'/><site site='tip'/><pulley divisor='2'/><site site='tip'/><site site='end'/>
            </spatial>
          </tendon>
        </mujoco>"
    );
    robohive_mjcf::load_str(text).unwrap().model
}

const POSE: [f64; 5] = [0.3, -0.4, 0.7, 0.2, -0.5];
const VELOCITY: [f64; 5] = [0.9, -1.3, 0.7, 1.1, -0.6];

/// Evaluated at `POSE + h VELOCITY` with `s VELOCITY`.
fn at(m: &Model, h: f64, s: f64) -> Data {
    let mut d = Data::new(m);
    for k in 0..m.nv {
        d.state.qpos[k] = POSE[k] + h * VELOCITY[k];
        d.state.qvel[k] = s * VELOCITY[k];
    }
    forward(m, &mut d).unwrap();
    d
}

/// The derivative of `f` along the motion with constant velocities.
fn derivative(m: &Model, f: impl Fn(&Data) -> Vec<f64>) -> Vec<f64> {
    let h = 1e-6;
    let [after, before] = [h, -h].map(|h| f(&at(m, h, 1.0)));
    after.iter().zip(before).map(|(a, b)| (a - b) / (2.0 * h)).collect()
}

#[test]
fn reference_accelerations_hold_the_rate_of_the_jacobian() {
    for equality in
        ["<connect body1='first' body2='second' anchor='.4 0 0'/>", "<weld body1='first' body2='second'/>"]
    {
        let m = model(equality, 0.0);
        let rows = if equality.starts_with("<weld") { 6 } else { 3 };
        let [moving, back, still] = [1.0, -1.0, 0.0].map(|s| at(&m, 0.0, s).efc.efc_aref.to_vec());
        let rate = derivative(&m, |d| d.efc.efc_vel.to_vec());
        assert!(moving.len() == rows && rate.iter().filter(|x| x.abs() > 0.05).count() >= 3, "{rate:?}");
        for k in 0..rows {
            // Damping is odd in the velocity and cancels; stiffness remains without one.
            let found = still[k] - 0.5 * (moving[k] + back[k]);
            assert!(
                (found - rate[k]).abs() < 1e-6 * rate[k].abs().max(1.0),
                "row {k}: {found}, not {}",
                rate[k]
            );
        }
    }
}

#[test]
fn armature_of_a_tendon_is_inertia_of_its_velocity() {
    const ARMATURE: f64 = 0.37;
    let (bare, armed) = (model("", 0.0), model("", ARMATURE));
    let energy = |m: &Model, d: &Data| {
        let dense = inertia::full_inertia(m, &d.inertia.M);
        let product = |i: usize| (0..m.nv).map(|j| dense[i * m.nv + j] * VELOCITY[j]).sum::<f64>();
        0.5 * (0..m.nv).map(|i| VELOCITY[i] * product(i)).sum::<f64>()
    };
    let (d, with) = (at(&bare, 0.0, 1.0), at(&armed, 0.0, 1.0));
    let speed = d.vel.ten_velocity[0];
    let expected = 0.5 * ARMATURE * speed * speed;
    assert!(expected > 1e-2, "{expected}");
    assert!((energy(&armed, &with) - energy(&bare, &d) - expected).abs() < 1e-13);
    // Its force on the bodies at zero acceleration: armature times the rate of its velocity, through its moments.
    let rate = derivative(&bare, |d| vec![d.vel.ten_velocity[0]])[0];
    assert!(rate.abs() > 0.1, "{rate}");
    let moment = derivative_of_length(&bare);
    for k in 0..bare.nv {
        let force = with.vel.qfrc_bias[k] - d.vel.qfrc_bias[k];
        assert!((force - ARMATURE * rate * moment[k]).abs() < 1e-6, "{k}: {force}");
    }
}

/// The derivative of the tendon's length by each coordinate.
fn derivative_of_length(m: &Model) -> Vec<f64> {
    let length = |k: usize, h: f64| {
        let mut d = at(m, 0.0, 0.0);
        d.state.qpos[k] += h;
        forward(m, &mut d).unwrap();
        d.ten.ten_length[0]
    };
    (0..m.nv).map(|k| (length(k, 1e-6) - length(k, -1e-6)) / 2e-6).collect()
}

#[test]
fn products_of_quaternions_and_vectors_are_products_of_quaternions() {
    for k in 0..20 {
        let number = |i: usize| number_of(k * 7 + i);
        let (q, v) = ([number(0), number(1), number(2), number(3)], [number(4), number(5), number(6)]);
        let (short, full) = (quat_mul_axis(q, v), quat_mul(q, [0.0, v[0], v[1], v[2]]));
        assert!(short.iter().zip(full).all(|(a, b)| (a - b).abs() < 1e-15), "{short:?}, not {full:?}");
        let length = |q: [f64; 4]| q.iter().map(|x| x * x).sum::<f64>().sqrt();
        assert!((length(short) - length(q) * norm(v)).abs() < 1e-14);
    }
}

/// Numbers between -1 and 1 that look random, none near zero.
fn number_of(k: usize) -> f64 {
    let unit = ((k * 2_654_435_761 + 12_345) % 1009) as f64 / 1009.0;
    if unit < 0.5 { -0.2 - unit } else { unit - 0.3 }
}
