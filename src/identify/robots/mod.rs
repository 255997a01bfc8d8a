//! Robots with known parameters, and logs of them with noise on their sensors.

use mjcf::spec::Spec;
use physics::model::ObjType;
use physics::{Data, Model, step};
use random::{Generator, SeedSequence};
use robohive_identify::{Found, Log, Readings};

/// Seven joints under servos.
pub const ARM: &str = include_str!("arm.xml");
/// Abduction, hip and knee of a leg that swings.
pub const LEG: &str = include_str!("leg.xml");
/// A finger of four joints.
pub const FINGER: &str = include_str!("finger.xml");

/// Standard deviations of the noise of positions \[rad\] and velocities \[rad/s\].
pub const NOISE: [f64; 2] = [1e-4, 2e-3];

/// A robot whose parameters are known.
pub struct Robot {
    text: String,
    /// Its model.
    pub model: Model,
}

/// What was recorded, row by row.
pub struct Rows {
    pub times: Vec<f64>,
    pub ctrl: Vec<f64>,
    pub states: [Vec<f64>; 2],
    pub readings: Vec<f64>,
}

impl Robot {
    pub fn new(text: &str) -> Self {
        Robot { text: text.into(), model: mjcf::load_str(text).expect("a robot").model }
    }

    pub fn spec(&self) -> Spec {
        mjcf::parse_str(&self.text).expect("a robot").spec
    }

    /// Moves every joint by two waves of its own, in steps; controls come `late` rows late.
    pub fn rows(&self, start: &Data, seconds: f64, late: usize, seed: u64) -> Rows {
        let m = &self.model;
        let mut d = start.clone();
        let mut draws = Generator::pcg64(SeedSequence::new(seed));
        let count = (seconds / m.opt.timestep) as usize;
        let told = |row: usize| {
            let t = row as f64 * m.opt.timestep;
            (0..m.nu).map(move |i| {
                let x = i as f64;
                let slow = (6.3 * (0.35 + 0.06 * x) * t + 0.7 * x).sin();
                0.6 * slow + 0.2 * (6.3 * (1.3 + 0.17 * x) * t + 0.4 * x).sin()
            })
        };
        let mut rows = Rows { times: vec![], ctrl: vec![], states: [vec![], vec![]], readings: vec![] };
        for row in 0..count {
            rows.times.push(row as f64 * m.opt.timestep);
            rows.ctrl.extend(told(row));
            rows.states[0].extend_from_slice(&d.state.qpos);
            rows.states[1].extend_from_slice(&d.state.qvel);
            d.state.ctrl.iter_mut().zip(told(row.saturating_sub(late))).for_each(|(to, from)| *to = from);
            step(m, &mut d).expect("a stable robot");
            for sensor in 0..m.nsensor {
                let speed = m.name_of(ObjType::Sensor, sensor).starts_with("vel");
                let noise = NOISE[usize::from(speed)] * draws.standard_normal();
                rows.readings.push(d.sensor.sensordata[sensor] + noise);
            }
        }
        rows
    }

    pub fn log(&self, seconds: f64, late: usize, seed: u64) -> Log {
        let start = Data::new(&self.model);
        self.log_from(&start, self.rows(&start, seconds, late, seed))
    }

    pub fn log_from(&self, start: &Data, rows: Rows) -> Log {
        let readings = Readings::sensors(&self.model, rows.readings);
        Log::of_arrays("log", rows.times, start, rows.ctrl, readings, &self.model).expect("a log")
    }

    /// Readings of a robot that does not move, with noise.
    pub fn at_rest(&self, rows: usize, seed: u64) -> Vec<f64> {
        let mut draws = Generator::pcg64(SeedSequence::new(seed));
        let half = self.model.nsensordata / 2;
        let columns = 0..rows * self.model.nsensordata;
        columns.map(|i| NOISE[i / half % 2] * draws.standard_normal()).collect()
    }

    /// The robot with other dynamics of its joints: by turns 0.5 and 1.6 times the true ones.
    pub fn disturbed(&self) -> Model {
        self.model
            .edited(|d| {
                for dof in 0..d.dof_damping.len() {
                    let factor = if dof % 2 == 0 { 0.5 } else { 1.6 };
                    d.dof_damping[dof] *= factor;
                    d.dof_armature[dof] *= factor;
                    d.dof_frictionloss[dof] *= factor;
                }
            })
            .expect("a robot")
    }

    /// The true value of each parameter.
    pub fn truth(&self, found: &Found) -> Vec<f64> {
        let m = &self.model;
        let value = |name: &str, element: usize| match name {
            "damping" => m.dof_damping[m.jnt_dofadr[element] as usize],
            "armature" => m.dof_armature[m.jnt_dofadr[element] as usize],
            "frictionloss" => m.dof_frictionloss[m.jnt_dofadr[element] as usize],
            "gain" => m.actuator_gainprm[element][0],
            "mass" => m.body_mass[element],
            _ => 0.0,
        };
        found.parameters.iter().map(|p| value(p.quantity.name(), p.element)).collect()
    }
}
