//! Legs of muscles that stand: mass, root and feet are to accelerate as springs with dampers, and static optimisation shares the
//! forces that this takes among the muscles and the ground, which pushes as if it were one more muscle (with muscles for motors, the
//! control by inverse dynamics of Herzog and others, Momentum control with hierarchical inverse dynamics on a torque-controlled
//! humanoid, Autonomous Robots 40, 2016).
//!
//! The mass follows the divergent component of motion, as in the walk on two feet.

use super::pulls::{Pulls, activation, check, even, most, pulls, range};
use super::soles::Sole;
use crate::controller::{Controller, command};
use crate::error::ControlError;
use crate::maths::{Pendulum, activations_to};
use crate::tasks::locomotion::body::Body;
use crate::tasks::locomotion::seen::{Plane, Seen, minus, plus, rotate};
use env::Env;
use env::suite::coupling::Coupling;
use nalgebra::{DMatrix, DVector};
use physics::elements::{BodyId, SiteId};
use physics::inertia::full_inertia;
use physics::math::{Mat3, Vec3, mul_mat_t_vec, mul_mat_vec, ops};
use physics::model::JointType;
use physics::{Data, Model};

/// How much of the divergent component's error the centre of pressure moves by.
const GAIN: f64 = 1.0;
/// How far the centre of pressure is asked to be from the middle of the feet \[m\]: forward, and beside.
const SOLE: Plane = [0.07, 0.1];
/// Acceleration of the root by height \[1/s²\] and speed \[1/s\], and by its lean and turning.
const HEIGHT: [f64; 2] = [30.0, 11.0];
const LEAN: [f64; 2] = [40.0, 12.0];
/// Of feet by their height and incline, and by speed.
const FOOT: [f64; 2] = [100.0, 20.0];
/// Of joints, towards the standing pose, and what they count beside all else.
const JOINT: [f64; 2] = [40.0, 12.0];
const LOOSE: f64 = 0.03;
/// Rate at which the wanted height changes \[m/s\].
const LOWER: f64 = 0.1;
/// Weight of missed forces over activations.
const EXACTNESS: f64 = 1e6;

/// The controller.
pub struct MuscleStand {
    root: BodyId,
    feet: [SiteId; 2],
    soles: [Sole; 2],
    /// The vertical in the frames of the root and of the feet when the body stands.
    up: [Vec3; 3],
    stand: Vec<f64>,
    couplings: Vec<Coupling>,
    pendulum: Pendulum,
    /// Height that is wanted now \[m\].
    tall: f64,
    controls: Vec<f64>,
}

/// Rows of linear equations for the accelerations of degrees of freedom.
struct Wanted {
    slopes: Vec<f64>,
    values: Vec<f64>,
}

impl Wanted {
    /// One more: `slope` times accelerations is `value`, with a weight.
    fn row(&mut self, weight: f64, slope: impl IntoIterator<Item = f64>, value: f64) {
        self.slopes.extend(slope.into_iter().map(|part| weight * part));
        self.values.push(weight * value);
    }

    /// Three more, one for each axis, of a Jacobian (3 by nv).
    fn rows(&mut self, jacobian: &[f64], values: [f64; 3]) {
        for (slope, value) in jacobian.chunks(jacobian.len() / 3).zip(values) {
            self.row(1.0, slope.iter().copied(), value);
        }
    }
}

impl MuscleStand {
    /// The controller for legs of muscles on a level floor.
    ///
    /// # Errors
    /// A task without roles; a body that has not two feet with capsules; actuators that do not pull.
    pub fn new(env: &Env) -> Result<Self, ControlError> {
        let m = &env.scene().model;
        let Body { root, feet, stand, .. } = Body::new(env, "", "muscle_stand", 2)?;
        check(env)?;
        // Its first degrees of freedom then move all mass along the axes of the world.
        if m.jnt_type[0] != JointType::Free as i32 || m.body_rootid[root.index()] != m.jnt_bodyid[0] {
            return Err(ControlError::unfit(env, "the first joint is to be the free one of the legs"));
        }
        let mut posed = Data::new(m);
        posed.state.qpos.copy_from_slice(&stand);
        physics::forward(m, &mut posed)?;
        let kin = &posed.kin;
        let [left, right] = [feet[0].index(), feet[1].index()];
        let axes = [kin.xmat[root.index()], kin.site_xmat[left], kin.site_xmat[right]];
        let over = posed.com.subtree_com[root.index()][2] - kin.site_xpos[left][2];
        Ok(MuscleStand {
            root,
            feet: [feet[0], feet[1]],
            soles: [Sole::new(env, feet[0])?, Sole::new(env, feet[1])?],
            up: axes.map(|axes| mul_mat_t_vec(&axes, [0.0, 0.0, 1.0])),
            stand,
            couplings: Coupling::all(m),
            pendulum: Pendulum::of_height(over),
            tall: 0.0,
            controls: vec![0.0; m.nu],
        })
    }

    /// How degrees of freedom (nv) go with those that no other one leads: a column for each of these.
    fn freedom(&self, m: &Model, qpos: &[f64]) -> DMatrix<f64> {
        let led = |dof: &usize| self.couplings.iter().any(|coupling| coupling.dofs[0] == *dof);
        let free: Vec<usize> = (0..m.nv).filter(|dof| !led(dof)).collect();
        let mut freedom = DMatrix::zeros(m.nv, free.len());
        for (column, &dof) in free.iter().enumerate() {
            freedom[(dof, column)] = 1.0;
            for coupling in self.couplings.iter().filter(|coupling| coupling.dofs[1] == dof) {
                freedom[(coupling.dofs[0], column)] = coupling.slope(qpos);
            }
        }
        freedom
    }

    /// Acceleration of the centre of mass in the plane that brings it over the middle of the feet \[m/s²\].
    fn balance(&self, m: &Model, d: &Data) -> Plane {
        let seen = Seen::new(m, d, self.root, self.feet);
        let [left, right] = seen.feet.map(|foot| foot.place);
        let middle = [0, 1].map(|i| 0.5 * (left.at[i] + right.at[i]));
        let divergent = [0, 1].map(|i| self.pendulum.divergent(seen.mass[i], seen.velocity[i]));
        let off = rotate(minus(divergent, middle), -seen.yaw);
        let pressure = [0, 1].map(|i| (off[i] + GAIN * off[i]).clamp(-SOLE[i], SOLE[i]));
        let away = minus(seen.mass, plus(middle, rotate(pressure, seen.yaw)));
        away.map(|away| self.pendulum.rate * self.pendulum.rate * away)
    }

    /// Accelerations that degrees of freedom are to have (nv), by those of mass, root, feet and joints.
    fn accelerations(
        &self,
        env: &Env,
        inertia: &DMatrix<f64>,
        freedom: &DMatrix<f64>,
    ) -> Option<DVector<f64>> {
        let (m, d, rows) = (&env.scene().model, &env.scene().data, env.rows());
        let mut wanted = Wanted { slopes: Vec::new(), values: Vec::new() };
        for (row, value) in self.balance(m, d).into_iter().enumerate() {
            wanted.row(1.0, inertia.row(row).iter().map(|mass| mass / inertia[(row, row)]), value);
        }
        let root = d.jacobian(m, self.root);
        let [speed, turning] = root.velocity(&d.state.qvel);
        let rise = HEIGHT[0] * (self.tall - rows["height"][0]) - HEIGHT[1] * speed[2];
        wanted.row(1.0, root.pos[2 * m.nv..].iter().copied(), rise);
        wanted.rows(&root.rot, level(&d.kin.xmat[self.root.index()], self.up[0], turning, LEAN));
        for (k, (foot, sole)) in self.feet.iter().zip(&self.soles).enumerate() {
            let jacobian = d.jacobian(m, *foot);
            let [speed, turning] = jacobian.velocity(&d.state.qvel);
            let [u, v, w] = speed.map(|speed| -FOOT[1] * speed);
            wanted.rows(&jacobian.pos, [u, v, w - FOOT[0] * sole.height(m, d)]);
            wanted.rows(&jacobian.rot, level(&d.kin.site_xmat[foot.index()], self.up[k + 1], turning, FOOT));
        }
        for joint in (0..m.njnt).filter(|&joint| m.jnt_type[joint] == JointType::Hinge as i32) {
            let (place, dof) = (m.jnt_qposadr[joint] as usize, m.jnt_dofadr[joint] as usize);
            let (off, speed) = (self.stand[place] - d.state.qpos[place], d.state.qvel[dof]);
            let slope = (0..m.nv).map(|other| f64::from(u8::from(other == dof)));
            wanted.row(LOOSE, slope, JOINT[0] * off - JOINT[1] * speed);
        }
        let slopes = DMatrix::from_row_slice(wanted.values.len(), m.nv, &wanted.slopes) * freedom;
        let target = slopes.transpose() * DVector::from_vec(wanted.values);
        let factor = (slopes.transpose() * &slopes).cholesky()?;
        Some(freedom * factor.solve(&target))
    }

    /// Shares of their largest controls that actuators are to have.
    fn share(&self, env: &Env) -> Result<DVector<f64>, ControlError> {
        let (m, d) = (&env.scene().model, &env.scene().data);
        let freedom = self.freedom(m, &d.state.qpos);
        let inertia = DMatrix::from_row_slice(m.nv, m.nv, &full_inertia(m, &d.inertia.M));
        let wanted = self.accelerations(env, &inertia, &freedom);
        let wanted = wanted.ok_or_else(|| ControlError::unfit(env, "the legs have no definite motion"))?;
        let Pulls { strength, rest, mut bounds } = pulls(env);
        let apart = DVector::from_fn(m.nv, |dof, _| d.vel.qfrc_bias[dof] - d.passive.qfrc_passive[dof]);
        let weight = 9.81 * m.body_subtreemass[m.body_rootid[self.root.index()] as usize];
        let [left, right] = [0, 1].map(|k| self.soles[k].pushes(m, d, weight));
        let mut all = DMatrix::zeros(m.nv, m.nu + left.ncols() + right.ncols());
        all.columns_mut(0, m.nu).copy_from(&strength);
        all.columns_mut(m.nu, left.ncols()).copy_from(&left);
        all.columns_mut(m.nu + left.ncols(), right.ncols()).copy_from(&right);
        bounds.resize(all.ncols(), [0.0, 1.0]);
        let mut forces = freedom.transpose() * (inertia * wanted + apart - rest);
        let mut strength = freedom.transpose() * all;
        even(&mut strength, &mut forces);
        Ok(activations_to(EXACTNESS, &strength, &forces, &bounds)?)
    }
}

/// Angular acceleration that turns an axis of a frame to the vertical.
fn level(axes: &Mat3, up: Vec3, turning: Vec3, [stiff, damp]: [f64; 2]) -> Vec3 {
    let [x, y, _] = mul_mat_vec(axes, up);
    let [a, b, c] = turning.map(|speed| -damp * speed);
    [a + stiff * y, b - stiff * x, c]
}

impl Controller for MuscleStand {
    fn reset(&mut self, env: &Env, _: u64) -> Result<(), ControlError> {
        self.tall = env.rows()["height"][0];
        Ok(())
    }

    fn act(&mut self, env: &Env, action: &mut [f64]) -> Result<(), ControlError> {
        let m = &env.scene().model;
        let step = LOWER * env.dt();
        self.tall += (env.rows()["height_command"][0] - self.tall).clamp(-step, step);
        let shares = self.share(env)?;
        for (actuator, control) in self.controls.iter_mut().enumerate() {
            let [low, high] = range(m, actuator);
            let wanted = shares[actuator] * most(m, actuator);
            *control = lead(env, actuator, wanted).clamp(low, high);
        }
        command(env, &self.controls, action)
    }
}

/// The control that brings the activation of an actuator to what is wanted within a step.
fn lead(env: &Env, actuator: usize, wanted: f64) -> f64 {
    let Some(now) = activation(env, actuator) else { return wanted };
    let [rise, fall] = [0, 1].map(|i| env.scene().model.actuator_dynprm[actuator][i]);
    let slow = 0.5 + 1.5 * now;
    let lag = if wanted > now { rise * slow } else { fall / slow };
    now + (wanted - now) / (1.0 - ops::exp(-env.dt() / lag))
}
