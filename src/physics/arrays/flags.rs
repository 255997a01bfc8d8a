//! Sets of switches: parts of the physics that `<flag>` turns off or on, with MuJoCo's bits.

use std::ops::{BitOr, BitOrAssign, BitXor, Not};

macro_rules! flags {
    ($($(#[$meta:meta])* $name:ident { $($(#[$doc:meta])* $flag:ident = $bit:literal,)* })*) => {$(
        $(#[$meta])*
        #[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
        pub struct $name(i32);

        impl $name {
            /// No switch.
            pub const NONE: Self = Self(0);
            $($(#[$doc])* pub const $flag: Self = Self(1 << $bit);)*

            /// The set with these bits; bits without a name are kept.
            pub const fn from_bits(bits: i32) -> Self {
                Self(bits)
            }

            /// The bits as compiled files and MuJoCo hold them.
            pub const fn bits(self) -> i32 {
                self.0
            }

            /// True when every switch of `other` is in the set.
            pub const fn contains(self, other: Self) -> bool {
                self.0 & other.0 == other.0
            }

            /// True when some switch of `other` is in the set.
            pub const fn intersects(self, other: Self) -> bool {
                self.0 & other.0 != 0
            }

            /// Adds or removes the switches of `other`.
            pub const fn set(&mut self, other: Self, on: bool) {
                self.0 = if on { self.0 | other.0 } else { self.0 & !other.0 };
            }

            /// The set as the one number of a field.
            pub(super) const fn as_slice(&self) -> &[i32] {
                std::slice::from_ref(&self.0)
            }
        }

        impl BitOr for $name {
            type Output = Self;
            fn bitor(self, other: Self) -> Self {
                Self(self.0 | other.0)
            }
        }

        impl BitOrAssign for $name {
            fn bitor_assign(&mut self, other: Self) {
                *self = *self | other;
            }
        }

        impl BitXor for $name {
            type Output = Self;
            fn bitxor(self, other: Self) -> Self {
                Self(self.0 ^ other.0)
            }
        }

        impl Not for $name {
            type Output = Self;
            fn not(self) -> Self {
                Self(!self.0)
            }
        }
    )*};
}

flags! {
    /// Parts of the physics that are off (`opt.disableflags`).
    Disable {
        /// The whole constraint solver.
        CONSTRAINT = 0,
        /// Equality constraints.
        EQUALITY = 1,
        /// Dry friction of joints and tendons.
        FRICTIONLOSS = 2,
        /// Joint and tendon limits.
        LIMIT = 3,
        /// Contacts.
        CONTACT = 4,
        /// Springs of joints and tendons.
        SPRING = 5,
        /// Dampers of joints and tendons.
        DAMPER = 6,
        /// Gravity.
        GRAVITY = 7,
        /// Clamping of controls to their range.
        CLAMPCTRL = 8,
        /// Start of the solver from the last acceleration.
        WARMSTART = 9,
        /// Omission of contacts between parent and child.
        FILTERPARENT = 10,
        /// Actuator forces.
        ACTUATION = 11,
        /// Lower bound of time constants by the time step.
        REFSAFE = 12,
        /// Sensors.
        SENSOR = 13,
        /// Bounding volume trees in collision.
        MIDPHASE = 14,
        /// Implicit damping in the Euler integrator.
        EULERDAMP = 15,
        /// Reset after bad numbers.
        AUTORESET = 16,
        /// GJK and EPA; portal refinement takes over.
        NATIVECCD = 17,
        /// Independent solution of constraint islands.
        ISLAND = 18,
        /// Several contacts of a convex pair.
        MULTICCD = 19,
    }
    /// Additional computations that are on (`opt.enableflags`).
    Enable {
        /// Contact parameters come from the options.
        OVERRIDE = 0,
        /// Energies are computed.
        ENERGY = 1,
        /// Forward and inverse dynamics are compared.
        FWDINV = 2,
        /// Inverse dynamics of the discrete step.
        INVDISCRETE = 3,
        /// Trees at rest sleep.
        SLEEP = 4,
        /// The diagonal of the constraint inertia is exact.
        DIAGEXACT = 5,
    }
}
