//! The hopper hops both ways and without a goal, by a controller of three parts (after Raibert, "Legged Robots That Balance", 1986): the leg is a spring that is
//! longer while it stretches, the hip keeps the body upright in stance, and in flight puts the foot where the speed asks for it. The
//! numbers of the README are printed by `-- --nocapture`.

mod measure;

use measure::{own, run};
use physics::math::ops::{asin, atan2, sincos};
use physics::{Data, Model};

/// Length of thigh and shin, and of the leg as a spring without load \[m\].
const LINK: f64 = 0.25;
const LEG: f64 = 0.45;
/// Torque of motors at a control of 1 \[N m\].
const GEAR: [f64; 3] = [40.0, 40.0, 15.0];

/// What the controller remembers.
struct Hopping {
    speed: f64,
    flight: bool,
    /// When that last changed, and for how long the last stance lasted \[s\].
    since: f64,
    stance: f64,
    hops: usize,
    /// Highest place of the sole in this flight, and that of all flights together \[m\].
    high: f64,
    clearance: f64,
    /// Largest angle of the body off upright \[rad\].
    pitch: f64,
}

impl Hopping {
    fn new(speed: f64) -> Self {
        Hopping {
            speed,
            flight: true,
            since: -1.0,
            stance: 0.2,
            hops: 0,
            high: 0.0,
            clearance: 0.0,
            pitch: 0.0,
        }
    }

    /// Notices landing and leaving, 0.05 s apart at least.
    fn look(&mut self, time: f64, touch: bool) {
        if touch != self.flight || time - self.since < 0.05 {
            return;
        }
        if self.flight {
            self.hops += 1;
            self.clearance += self.high;
            self.high = 0.0;
        } else {
            self.stance = time - self.since;
        }
        (self.flight, self.since) = (!self.flight, time);
    }

    fn act(&mut self, m: &Model, d: &mut Data) {
        let [_, _, pitch, hip, knee, ankle]: [f64; 6] = d.state.qpos[..6].try_into().unwrap();
        let [_, _, turn, hip_rate, knee_rate, ankle_rate]: [f64; 6] = d.state.qvel[..6].try_into().unwrap();
        let [touch, speed] = ["sole", "velocity"].map(|name| d.sensor(m.sensor(name).unwrap()).data()[0]);
        self.look(d.time(), touch > 0.5);
        self.high = self.high.max(d.site(m.site("foot").unwrap()).xpos()[2]);
        self.pitch = self.pitch.max(pitch.abs());
        let (thigh, shin) = (hip - pitch, hip - pitch - knee);
        let ((s1, c1), (s2, c2)) = (sincos(thigh), sincos(shin));
        // The ankle seen from the hip, and its Jacobian for hip and knee.
        let [x, z] = [LINK * (s1 + s2), -LINK * (c1 + c2)];
        let jacobian = [[LINK * (c1 + c2), -LINK * c2], [LINK * (s1 + s2), -LINK * s2]];
        let rates = [hip_rate - turn, knee_rate];
        let [vx, vz] = jacobian.map(|row| row[0] * rates[0] + row[1] * rates[1]);
        let (length, angle) = (x.hypot(z), atan2(x, -z));
        let [ux, uz] = [x / length, z / length];
        let (stretch, swing) = (ux * vx + uz * vz, (ux * vz - uz * vx) / length);
        // A force along the leg, and a moment about the hip.
        let (force, moment, foot) = if self.flight {
            let goal =
                asin(((speed * self.stance / 2.0 + 0.04 * (speed - self.speed)) / LEG).clamp(-0.5, 0.5));
            let level = -15.0 * (shin + ankle) - 0.4 * (ankle_rate + hip_rate - knee_rate - turn);
            (300.0 * (LEG - length) - 13.5 * stretch, 35.0 * (goal - angle) - 1.5 * swing, level)
        } else {
            let longer = if stretch > 0.0 { 0.03 } else { 0.0 };
            let force = 1900.0 * (LEG + longer - length) - 20.0 * stretch.min(0.0);
            (force, -120.0 * pitch - 16.0 * turn, -12.0 * pitch)
        };
        let push = [force * ux - moment / length * uz, force * uz + moment / length * ux];
        let torque = [0, 1].map(|joint| jacobian[0][joint] * push[0] + jacobian[1][joint] * push[1]);
        for (motor, torque) in [torque[0], torque[1], foot].into_iter().enumerate() {
            d.state.ctrl[motor] = (torque / GEAR[motor]).clamp(-1.0, 1.0);
        }
    }
}

/// Hops for ten seconds after a fall of 8 cm; the hopper and how far it came \[m\].
fn hop(m: &Model, speed: f64) -> (Hopping, f64) {
    let mut d = Data::new(m);
    d.state.qpos.copy_from_slice(&[0.0, -0.0873 + 0.08, 0.0, 0.6, 1.2, 0.6]);
    let mut hopping = Hopping::new(speed);
    run(m, &mut d, 10.0, |d| hopping.act(m, d));
    (hopping, d.state.qpos[0])
}

#[test]
fn it_has_its_mass_and_stands_as_high_as_its_links() {
    let m = own("hopper/scene.xml");
    assert!((m.body_subtreemass[0] - 5.47).abs() < 1e-9, "{}", m.body_subtreemass[0]);
    let mut d = Data::new(&m);
    physics::forward(&m, &mut d).unwrap();
    assert!(d.site(m.site("foot").unwrap()).xpos()[2].abs() < 1e-9);
}

#[test]
fn it_hops_for_ten_seconds_and_the_way_that_it_is_told() {
    let m = own("hopper/scene.xml");
    for (speed, least, most) in [(0.0, -1.5, 1.5), (0.3, 1.5, 4.5), (-0.3, -4.5, -1.5)] {
        let (hopping, way) = hop(&m, speed);
        let clearance = hopping.clearance / hopping.hops as f64;
        println!(
            "told {speed} m/s: {} hops, sole {:.0} mm high on the mean, {way:.2} m in 10 s, pitch within {:.2} rad",
            hopping.hops,
            clearance * 1e3,
            hopping.pitch
        );
        assert!(hopping.hops >= 30 && clearance > 0.015);
        assert!((least..most).contains(&way) && hopping.pitch < 0.7);
    }
}

#[test]
fn without_a_controller_it_falls() {
    let m = own("hopper/scene.xml");
    let mut d = Data::new(&m);
    d.state.qpos.copy_from_slice(&[0.0, -0.0873, 0.0, 0.6, 1.2, 0.6]);
    run(&m, &mut d, 2.0, |_| ());
    let height = d.body(m.body("torso").unwrap()).xpos()[2];
    assert!(height < 0.25, "{height}");
}
