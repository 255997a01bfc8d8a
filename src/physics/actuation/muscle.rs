//! Muscle actuators: force-length-velocity curves and activation dynamics (documentation: Modeling, "Muscles";
//! activation after Millard et al. 2013, <https://doi.org/10.1115/1.4023390>).
//!
//! Lengths and velocities are normalised by the resting length `L0` that the operating range implies; parameters
//! are `range[2], force, scale, lmin, lmax, vmax, fpmax, fvmax`.

use crate::model::bounds::MINVAL;

/// What a muscle's curves need besides the state of its tendon.
#[derive(Clone, Copy, Debug)]
pub struct Muscle<'a> {
    /// Range of actuator lengths over which the muscle operates.
    pub lengthrange: [f64; 2],
    /// Acceleration from unit force, which scales an automatic peak force.
    pub acc0: f64,
    /// Parameters, in the order given in the module documentation.
    pub prm: &'a [f64; 10],
}

impl Muscle<'_> {
    fn peak_force(&self) -> f64 {
        let (force, scale) = (self.prm[2], self.prm[3]);
        if force < 0.0 { scale / self.acc0.max(MINVAL) } else { force }
    }

    fn resting_length(&self) -> f64 {
        (self.lengthrange[1] - self.lengthrange[0]) / (self.prm[1] - self.prm[0]).max(MINVAL)
    }

    fn normalized_length(&self, length: f64) -> f64 {
        self.prm[0] + (length - self.lengthrange[0]) / self.resting_length().max(MINVAL)
    }

    /// Active force per unit of activation; negative, since muscles pull.
    pub fn gain(&self, length: f64, velocity: f64) -> f64 {
        let [.., lmin, lmax, vmax, _, fvmax, _] = *self.prm;
        let v = velocity / (self.resting_length() * vmax).max(MINVAL);
        -self.peak_force()
            * length_curve(self.normalized_length(length), lmin, lmax)
            * velocity_curve(v, fvmax)
    }

    /// Derivative of `gain` with respect to velocity.
    pub fn gain_slope(&self, length: f64, velocity: f64) -> f64 {
        let [.., lmin, lmax, vmax, _, fvmax, _] = *self.prm;
        let fastest = (self.resting_length() * vmax).max(MINVAL);
        let v = velocity / fastest;
        let y = fvmax - 1.0;
        let slope = if v <= -1.0 || v > y.max(0.0) {
            0.0
        } else if v <= 0.0 {
            2.0 * v + 2.0
        } else {
            2.0 * (y - v) / y.max(MINVAL)
        };
        -self.peak_force() * length_curve(self.normalized_length(length), lmin, lmax) * slope / fastest
    }

    /// Passive force: a parabola from the resting length, continued by a line.
    pub fn bias(&self, length: f64) -> f64 {
        let (lmax, fpmax) = (self.prm[5], self.prm[7]);
        let l = self.normalized_length(length);
        let knee = 0.5 * (1.0 + lmax);
        let width = (knee - 1.0).max(MINVAL);
        if l <= 1.0 {
            0.0
        } else if l <= knee {
            let x = (l - 1.0) / width;
            -self.peak_force() * fpmax * 0.5 * x * x
        } else {
            let x = (l - knee) / width;
            -self.peak_force() * fpmax * (0.5 + x)
        }
    }
}

/// Active force over normalised length: four parabolas, zero outside `lmin..lmax` and one at 1.
pub fn length_curve(l: f64, lmin: f64, lmax: f64) -> f64 {
    if !(lmin <= l && l <= lmax) {
        return 0.0;
    }
    let (a, b) = (0.5 * (lmin + 1.0), 0.5 * (1.0 + lmax));
    let parabola = |distance: f64, width: f64| {
        let x = distance / width.max(MINVAL);
        0.5 * x * x
    };
    if l <= a {
        parabola(l - lmin, a - lmin)
    } else if l <= 1.0 {
        1.0 - parabola(1.0 - l, 1.0 - a)
    } else if l <= b {
        1.0 - parabola(l - 1.0, b - 1.0)
    } else {
        parabola(lmax - l, lmax - b)
    }
}

/// Active force over normalised velocity: zero at the fastest shortening, `fvmax` in fast lengthening.
fn velocity_curve(v: f64, fvmax: f64) -> f64 {
    let y = fvmax - 1.0;
    if v <= -1.0 {
        0.0
    } else if v <= 0.0 {
        (v + 1.0) * (v + 1.0)
    } else if v <= y {
        fvmax - (y - v) * (y - v) / y.max(MINVAL)
    } else {
        fvmax
    }
}

/// Time derivative of activation `act` under excitation `ctrl`; `prm` holds the time constants of activation and
/// deactivation and the width over which they blend.
pub fn activation_rate(ctrl: f64, act: f64, prm: &[f64; 10]) -> f64 {
    let slow = 0.5 + 1.5 * act.clamp(0.0, 1.0);
    let excess = ctrl.clamp(0.0, 1.0) - act;
    excess / time_constant(excess, prm[0] * slow, prm[1] / slow, prm[2]).max(MINVAL)
}

/// Time constant for rising (`up`) or falling (`down`) activation, blended over `width` of excess excitation.
pub fn time_constant(excess: f64, up: f64, down: f64, width: f64) -> f64 {
    if width >= MINVAL {
        down + (up - down) * smooth_step(excess / width + 0.5)
    } else if excess > 0.0 {
        up
    } else {
        down
    }
}

/// Quintic step from 0 to 1 with zero first and second derivatives at both ends.
pub fn smooth_step(x: f64) -> f64 {
    if x <= 0.0 {
        0.0
    } else if x >= 1.0 {
        1.0
    } else {
        x * x * x * (3.0 * x * (2.0 * x - 5.0) + 10.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const DEFAULTS: [f64; 10] = [0.75, 1.05, 100.0, 200.0, 0.5, 1.6, 1.5, 1.3, 1.2, 0.0];

    #[test]
    fn isometric_force_at_resting_length_is_the_peak() {
        let muscle = Muscle { lengthrange: [0.0, 0.3], acc0: 1.0, prm: &DEFAULTS };
        assert!((muscle.gain(0.25, 0.0) + 100.0).abs() < 1e-12);
        assert_eq!(muscle.bias(0.25), 0.0);
    }

    /// Half of `fpmax` in the middle between the resting length and `lmax`, a quarter of that half-way there, and
    /// one and a half of `fpmax` at `lmax`.
    #[test]
    fn stretched_muscle_pulls_by_a_parabola_then_a_line() {
        let muscle = Muscle { lengthrange: [0.0, 0.3], acc0: 1.0, prm: &DEFAULTS };
        for (length, force) in [(0.4, -16.25), (0.55, -65.0), (0.85, -195.0)] {
            assert!((muscle.bias(length) - force).abs() < 1e-12, "{length}: {}", muscle.bias(length));
        }
    }

    #[test]
    fn curves_join_smoothly() {
        let slope = |f: &dyn Fn(f64) -> f64, x: f64| (f(x + 1e-7) - f(x - 1e-7)) / 2e-7;
        let length = |l: f64| length_curve(l, 0.5, 1.6);
        for knot in [0.75, 1.0, 1.3] {
            let jump = slope(&length, knot + 1e-6) - slope(&length, knot - 1e-6);
            assert!(jump.abs() < 1e-3, "{knot} {jump}");
        }
        assert!((slope(&|v| velocity_curve(v, 1.2), 0.0) - 2.0).abs() < 1e-5);
    }
}
