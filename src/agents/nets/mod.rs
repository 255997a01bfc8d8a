//! Small networks and their optimiser in single precision, with the same bits on every machine.
//!
//! ```
//! use robohive_agents::nets::{Activation, Adam, Mlp, Tape};
//! # use random as robohive_random;
//! use robohive_random::Generator;
//!
//! // Fits y = x² on five places.
//! let net = Mlp::new(&[1, 16, 1], Activation::Tanh, false);
//! let mut parameters = net.draw(1.0, &mut Generator::pcg64(1_u64));
//! let (places, mut adam, mut tape) = ([-1.0, -0.5, 0.0, 0.5, 1.0], Adam::new(net.parameters()), Tape::default());
//! for _ in 0..1500 {
//!     net.forward(&parameters, &places, &mut tape);
//!     let slopes: Vec<f32> = tape.output().iter().zip(places).map(|(y, x)| y - x * x).collect();
//!     let mut gradient = vec![0.0; net.parameters()];
//!     net.backward(&parameters, &tape, &slopes, &mut gradient);
//!     adam.step(1e-2, 0.0, &gradient, &mut parameters);
//! }
//! net.forward(&parameters, &[0.75], &mut tape);
//! assert!((tape.output()[0] - 0.5625).abs() < 0.05);
//! ```

mod activation;
mod adam;
pub mod gaussian;
mod kernel;
mod layer_norm;
mod mlp;
mod running;
mod squashed;

pub use activation::{Activation, exp};
pub use adam::{Adam, clip};
pub use mlp::{Mlp, Tape};
pub use running::Running;
pub use squashed::Squashed;
