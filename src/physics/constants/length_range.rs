//! Ranges of actuator lengths, found by pulling each actuator from both ends with all other forces off (MuJoCo
//! documentation, Modeling, "Actuator length range").
//!
//! ```
//! use robohive_physics::constants::length_range::{LengthRangeOptions, set_length_ranges};
//! use robohive_physics::model::LengthRangeMode;
//!
//! let text = "<mujoco><worldbody><body><joint name='j' axis='0 1 0' limited='true' range='-90 90'/>
//!     <geom size='.1' pos='1 0 0'/></body></worldbody><actuator><motor joint='j'/></actuator></mujoco>";
//! let mut model = robohive_mjcf::load_str(text)?.model;
//! let options = LengthRangeOptions { mode: LengthRangeMode::All, uselimit: true, ..Default::default() };
//! set_length_ranges(&mut model, &options)?;
//! assert_eq!(model.actuator_lengthrange, model.jnt_range);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

use crate::actuation::transmission::moment;
use crate::data::Data;
use crate::inertia::solve;
use crate::math::dense::norm_slice;
use crate::math::ops;
use crate::model::bounds::MINVAL;
use crate::model::{BiasType, Disable, Enable, GainType, LengthRangeMode, Model, ObjType, TrnType};
use crate::pipeline::error::StepError;
use crate::pipeline::forward::{acceleration, position, velocity};
use crate::pipeline::integrate::{Factors, advance_once};
use crate::pipeline::validity::check_acceleration;
use std::fmt;

/// How length ranges are computed (XML reference, `compiler/lengthrange`).
#[derive(Clone, Debug, PartialEq)]
pub struct LengthRangeOptions {
    /// Which actuators get a range.
    pub mode: LengthRangeMode,
    /// Keep a range that the model already has.
    pub useexisting: bool,
    /// Take the range of a limited joint or tendon.
    pub uselimit: bool,
    /// Norm of the acceleration that the pull causes \[rad/s², m/s²\].
    pub accel: f64,
    /// Largest norm of the pull; 0 for none \[N, N m\].
    pub maxforce: f64,
    /// Time constant with which velocities decay \[s\].
    pub timeconst: f64,
    /// Time step; 0 keeps the model's \[s\].
    pub timestep: f64,
    /// Time simulated on each side \[s\].
    pub inttotal: f64,
    /// Part of it, at the end, in which lengths are recorded \[s\].
    pub interval: f64,
    /// Largest variation in that part, as a share of the range.
    pub tolrange: f64,
}

impl Default for LengthRangeOptions {
    fn default() -> Self {
        LengthRangeOptions {
            mode: LengthRangeMode::Muscle,
            useexisting: true,
            uselimit: false,
            accel: 20.0,
            maxforce: 0.0,
            timeconst: 1.0,
            timestep: 0.01,
            inttotal: 10.0,
            interval: 2.0,
            tolrange: 0.05,
        }
    }
}

/// Why a length range cannot be computed.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum LengthRangeError {
    /// The simulation broke down.
    Unstable {
        /// The actuator.
        actuator: String,
        /// What broke down.
        cause: StepError,
    },
    /// The largest length is not above the smallest.
    Invalid {
        /// The actuator.
        actuator: String,
        /// The two lengths.
        range: [f64; 2],
    },
    /// Lengths still moved at the end.
    NotConverged {
        /// The actuator.
        actuator: String,
        /// The range found.
        range: [f64; 2],
        /// Smallest and largest length recorded on the side that moved.
        recorded: [f64; 2],
    },
}

impl fmt::Display for LengthRangeError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            LengthRangeError::Unstable { actuator, cause } => {
                write!(f, "the length range of {actuator} cannot be computed: {cause}")
            }
            LengthRangeError::Invalid { actuator, range: [low, high] } => {
                write!(
                    f,
                    "the length range of {actuator} is empty, from {low} to {high}; check its transmission and the limits of its joints"
                )
            }
            LengthRangeError::NotConverged { actuator, range: [low, high], recorded: [least, most] } => {
                write!(
                    f,
                    "the length range of {actuator}, {low} to {high}, did not converge: its length moved \
                     between {least} and {most}"
                )
            }
        }
    }
}

impl std::error::Error for LengthRangeError {}

/// Sets `actuator_lengthrange` of the actuators that `opt` selects; the rest of the model must be complete.
///
/// # Errors
/// The first actuator whose range cannot be computed; the others have theirs.
pub fn set_length_ranges(m: &mut Model, opt: &LengthRangeOptions) -> Result<(), LengthRangeError> {
    let mut simulated = Vec::new();
    for i in 0..m.nactuator {
        let out = m.actuator_outadr[i] as usize;
        let [low, high] = m.actuator_lengthrange[out];
        if !selected(m, opt.mode, i) || (opt.useexisting && low < high) {
            continue;
        }
        match limits(m, i).filter(|_| opt.uselimit) {
            Some(range) => m.unchecked_mut().actuator_lengthrange[out] = range,
            None => simulated.push(i),
        }
    }
    if simulated.is_empty() {
        return Ok(());
    }
    let model_options = m.opt.clone();
    let options = m.options_mut();
    options.disableflags = Disable::FRICTIONLOSS
        | Disable::CONTACT
        | Disable::SPRING
        | Disable::DAMPER
        | Disable::GRAVITY
        | Disable::ACTUATION;
    options.enableflags.set(Enable::SLEEP, false);
    if opt.timestep > 0.0 {
        options.timestep = opt.timestep;
    }
    let ranges = measure_all(m, opt, &simulated);
    let m = m.unchecked_mut();
    m.opt = model_options;
    let mut result = Ok(());
    for (i, range) in simulated.into_iter().zip(ranges) {
        match range {
            Ok(range) => m.actuator_lengthrange[m.actuator_outadr[i] as usize] = range,
            Err(e) => result = result.and(Err(e)),
        }
    }
    result
}

/// True when `mode` asks for the range of actuator `i`.
fn selected(m: &Model, mode: LengthRangeMode, i: usize) -> bool {
    let (gain, bias) = (m.actuator_gaintype[i], m.actuator_biastype[i]);
    let muscle = gain == GainType::Muscle.code() || bias == BiasType::Muscle.code();
    let user = gain == GainType::User.code() || bias == BiasType::User.code();
    match mode {
        LengthRangeMode::None => false,
        LengthRangeMode::Muscle => muscle,
        LengthRangeMode::Muscleuser => muscle || user,
        LengthRangeMode::All => true,
    }
}

/// Limits of the joint or tendon that actuator `i` drives, if it has any.
fn limits(m: &Model, i: usize) -> Option<[f64; 2]> {
    let target = m.actuator_trnid[i][0] as usize;
    match TrnType::from_code(m.actuator_trntype[i])? {
        TrnType::Joint | TrnType::Jointinparent => m.jnt_limited[target].then(|| m.jnt_range[target]),
        TrnType::Tendon => m.tendon_limited[target].then(|| m.tendon_range[target]),
        TrnType::Slidercrank | TrnType::Site | TrnType::Body | TrnType::So3 | TrnType::Undefined => None,
    }
}

type Measured = Result<[f64; 2], LengthRangeError>;

/// Measures actuators independently, on several threads where there are any; the result does not depend on them.
fn measure_all(m: &Model, opt: &LengthRangeOptions, actuators: &[usize]) -> Vec<Measured> {
    let threads = std::thread::available_parallelism().map_or(1, usize::from).min(actuators.len());
    let share = actuators.len().div_ceil(threads);
    let measure_share = |share: &[usize]| {
        let mut d = Data::new(m);
        share.iter().map(|&i| measure(m, &mut d, opt, i)).collect::<Vec<_>>()
    };
    if threads < 2 {
        return measure_share(actuators);
    }
    std::thread::scope(|scope| {
        let started: Vec<_> = actuators
            .chunks(share)
            .map(|share| {
                let thread = std::thread::Builder::new().spawn_scoped(scope, move || measure_share(share));
                (share, thread)
            })
            .collect();
        // A thread that cannot be had, or that is lost, is replaced by this one.
        let results = started.into_iter().map(|(share, thread)| {
            thread.ok().and_then(|t| t.join().ok()).unwrap_or_else(|| measure_share(share))
        });
        results.flatten().collect()
    })
}

/// Pulls actuator `i` to both ends.
fn measure(m: &Model, d: &mut Data, opt: &LengthRangeOptions, i: usize) -> Measured {
    let actuator = || m.label_of(ObjType::Actuator, i);
    let mut recorded = [[0.0; 2]; 2];
    for (side, direction) in [-1.0, 1.0].into_iter().enumerate() {
        recorded[side] = pull(m, d, opt, i, direction)
            .map_err(|cause| LengthRangeError::Unstable { actuator: actuator(), cause })?;
    }
    let range = [recorded[0][0], recorded[1][1]];
    let width = range[1] - range[0];
    if width <= 0.0 {
        return Err(LengthRangeError::Invalid { actuator: actuator(), range });
    }
    match recorded.into_iter().find(|[least, most]| most - least > opt.tolrange * width) {
        Some(recorded) => Err(LengthRangeError::NotConverged { actuator: actuator(), range, recorded }),
        None => Ok(range),
    }
}

/// Pulls actuator `i` in one direction from `qpos0`; smallest and largest length of the last interval.
fn pull(
    m: &Model,
    d: &mut Data,
    opt: &LengthRangeOptions,
    i: usize,
    direction: f64,
) -> Result<[f64; 2], StepError> {
    d.reset(m);
    let out = m.actuator_outadr[i] as usize;
    let decay = ops::exp(-m.opt.timestep / opt.timeconst.max(0.01));
    let mut recorded = None;
    while d.state.time < opt.inttotal {
        d.state.qvel.iter_mut().for_each(|v| *v *= decay);
        position(m, d, &mut ())?;
        velocity(m, d, &mut ());
        set_pull(m, d, opt, out, direction);
        acceleration(m, d, &mut ());
        check_acceleration(m, d)?;
        advance_once(m, d, Factors::Fresh);
        let length = d.trn.actuator_length[out];
        if d.state.time > opt.inttotal - opt.interval {
            let [least, most] = recorded.unwrap_or([length; 2]);
            recorded = Some([f64::min(least, length), f64::max(most, length)]);
        }
    }
    Ok(recorded.unwrap_or([0.0; 2]))
}

/// Sets the force along the moment arm that accelerates by `opt.accel`.
fn set_pull(m: &Model, d: &mut Data, opt: &LengthRangeOptions, out: usize, direction: f64) {
    let force = &mut d.state.qfrc_applied;
    let along = |force: &mut [f64], s: f64| {
        force.fill(0.0);
        moment(&d.trn, out).for_each(|(dof, arm)| force[dof] = arm * s);
    };
    along(force, 1.0);
    solve(m, &d.inertia, force);
    let s = direction * opt.accel / norm_slice(force).max(MINVAL);
    along(force, s);
    let norm = norm_slice(force);
    if opt.maxforce > 0.0 && norm > opt.maxforce {
        force.iter_mut().for_each(|f| *f *= opt.maxforce / norm.max(MINVAL));
    }
}
