//! numpy's random draws, to the last bit: an episode that numpy seeded and drew starts the same here.
//!
//! | numpy | here |
//! |---|---|
//! | `SeedSequence(7)`, `.generate_state(n)`, `.spawn(n)` | [`SeedSequence`] |
//! | `default_rng(7)`, `Generator(PCG64(7))`, `Generator(MT19937(7))` | [`Generator`] over [`Pcg64`] or [`Mt19937`] |
//! | `.random()`, `.uniform(a, b)`, `.standard_normal()`, `.normal(m, s)` | the methods of these names |
//! | `.integers(a, b, dtype=…)`, `endpoint=True` | [`Generator::integer`] over `a..b`, `a..=b`, of any integer type |
//! | `.choice(n, k, replace=…, p=…, shuffle=…)` | [`Generator::choice`] with a [`Sampling`] |
//! | `.shuffle(x)`, `.permutation(n)` | the methods of these names |
//! | `RandomState(7)` and the functions of `numpy.random` | [`RandomState`] |
//! | `bit_generator.state`, `get_state()` | `state()` and `from_state()`: plain structs |
//!
//! Draws of arrays fill slices in row-major order. A method whose name begins with `fill_` draws what numpy
//! draws for an array; for integers of 8 and 16 bits and `bool` that is not what as many single draws give.
//!
//! ```
//! use robohive_random::{Generator, Sampling, SeedSequence};
//!
//! let mut generator = Generator::pcg64(SeedSequence::new(42_u64));
//! assert_eq!(generator.random(), 0.7739560485559633);
//! assert_eq!(generator.integer(0..10)?, 6);
//! let mut noise = [0.0; 3];
//! generator.fill_normal(0.0, 0.02, &mut noise)?;
//! assert_eq!(generator.choice(5, 2, Sampling::WithoutReplacement)?.len(), 2);
//! # Ok::<(), robohive_random::RandomError>(())
//! ```
//!
//! # Which numpy
//!
//! The integers are numpy's on every platform. Normal draws take a logarithm, and there numpy's own results
//! depend on the C library it meets: the reference is glibc 2.36 on an x86-64 processor with fused
//! multiply-add. Here the same operations run in software where the processor lacks them, so the draws are
//! the same on every platform.
//!
//! There is no seed from the operating system: a seed is always given.

mod bit_generator;
mod bounds;
mod choice;
mod error;
mod generator;
mod legacy;
mod logarithm;
mod mt19937;
mod normal;
mod pcg64;
mod seed_sequence;
mod uniform;
mod ziggurat;

pub use bit_generator::BitGenerator;
pub use bounds::{Bounds, Integer};
pub use choice::Sampling;
pub use error::RandomError;
pub use generator::Generator;
pub use legacy::{RandomState, RandomStateSnapshot};
pub use mt19937::{Mt19937, Mt19937State};
pub use pcg64::{Pcg64, Pcg64State};
pub use seed_sequence::{Entropy, SeedSequence};
