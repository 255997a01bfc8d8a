//! Numbers as unevaluated sums of two f64, for constants and last-bit corrections (Dekker 1971; Knuth, "The Art of
//! Computer Programming", volume 2, section 4.2.2).

/// A value `head + tail`. Sums and products expect and give a tail below the last bit of the head.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Double {
    pub head: f64,
    pub tail: f64,
}

/// `a + b`, exactly.
const fn two_sum(a: f64, b: f64) -> Double {
    let head = a + b;
    let b_part = head - a;
    Double { head, tail: (a - (head - b_part)) + (b - b_part) }
}

/// `a + b` where `a` is zero or not the smaller one, exactly.
pub(super) const fn ordered_sum(a: f64, b: f64) -> Double {
    let head = a + b;
    Double { head, tail: b - (head - a) }
}

/// `a` as a sum of two numbers of at most 26 bits each.
pub(super) const fn split(a: f64) -> [f64; 2] {
    const FACTOR: f64 = 134_217_729.0; // 2^27 + 1
    let scaled = FACTOR * a;
    let head = scaled - (scaled - a);
    [head, a - head]
}

/// `a b`, exactly.
const fn two_product(a: f64, b: f64) -> Double {
    let head = a * b;
    let ([a0, a1], [b0, b1]) = (split(a), split(b));
    Double { head, tail: ((a0 * b0 - head) + a0 * b1 + a1 * b0) + a1 * b1 }
}

impl Double {
    /// Sum.
    pub const fn plus(self, other: Double) -> Double {
        let sum = two_sum(self.head, other.head);
        two_sum(sum.head, sum.tail + (self.tail + other.tail))
    }

    /// Product.
    pub const fn times(self, other: Double) -> Double {
        let product = two_product(self.head, other.head);
        two_sum(product.head, product.tail + (self.head * other.tail + self.tail * other.head))
    }

    /// Quotient by a number.
    pub const fn over(self, divisor: f64) -> Double {
        let quotient = self.head / divisor;
        let product = two_product(quotient, divisor);
        two_sum(quotient, (((self.head - product.head) - product.tail) + self.tail) / divisor)
    }

    /// Square root; zero for zero.
    pub fn sqrt(self) -> Double {
        let root = self.head.sqrt();
        if root == 0.0 {
            return Double { head: 0.0, tail: 0.0 };
        }
        let rest = self.plus(two_product(root, root).negated());
        two_sum(root, rest.round() / (2.0 * root))
    }

    /// The sum with a number that is small beside the head, kept in the tail.
    pub const fn extended(self, small: f64) -> Double {
        Double { head: self.head, tail: self.tail + small }
    }

    /// The nearest f64.
    pub const fn round(self) -> f64 {
        self.head + self.tail
    }

    /// The value with its sign changed.
    pub const fn negated(self) -> Double {
        Double { head: -self.head, tail: -self.tail }
    }
}
