//! Stiffness and damping that depend polynomially on deflection or speed (documentation: XML reference, joint
//! `stiffness` and `damping`).

/// A coefficient with its dependence on the argument: `linear + p0 x + p1 x²`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Polynomial {
    /// Constant part, the one of a linear law.
    pub linear: f64,
    /// Parts that grow with the argument and its square.
    pub poly: [f64; 2],
}

impl Polynomial {
    /// True when there is no force at all.
    pub fn is_zero(&self) -> bool {
        self.linear == 0.0 && self.poly == [0.0; 2]
    }

    /// Coefficient at `x`; the force is `-x` times it.
    pub fn at(&self, x: f64) -> f64 {
        self.linear + self.poly[0] * x + self.poly[1] * (x * x)
    }

    /// Derivative of `x at(x)`.
    pub fn slope(&self, x: f64) -> f64 {
        self.linear + 2.0 * self.poly[0] * x + 3.0 * self.poly[1] * (x * x)
    }

    /// Work against the force from 0 to `x`.
    pub fn potential(&self, x: f64) -> f64 {
        0.5 * self.linear * (x * x) + self.poly[0] / 3.0 * (x * x * x) + self.poly[1] / 4.0 * (x * x * x * x)
    }
}
