//! Learning from episodes, by the natural policy gradient, proximal policy optimisation and soft actor-critic, and from demonstrations:
//! behaviour cloning, dataset aggregation, and the natural policy gradient with demonstrations.
//!
//! ```
//! use robohive_agents::learn::{Algorithm, Collector, Fit, Horizon, Learner, Npg, Settings};
//! use robohive_agents::nets::Activation;
//! # use env as robohive_env;
//! use robohive_env::{Env, Options, OwnModels};
//!
//! let env = Env::make("hive/myoElbowPose1D6MRandom-v0", &OwnModels, &Options::default())?;
//! let settings = Settings {
//!     algorithm: Algorithm::Npg(Npg { step: 0.1 }),
//!     episodes: 2,
//!     horizon: Horizon { gamma: 0.95, lambda: 0.95 },
//!     hidden: [vec![8], vec![8]],
//!     activation: Activation::Tanh,
//!     log_std: [-0.5, -2.0],
//!     fit: Fit { epochs: 1, batch: 32, rate: 1e-3, longest: 0.5 },
//! };
//! // Two environments side by side, on one thread.
//! let (mut learner, mut collector) = (Learner::new(settings, 1, &env), Collector::new(&env, 2, 1)?);
//! let iteration = learner.iterate(&mut collector)?;
//! assert!(iteration.update.divergence > 0.0 && iteration.length > 1.0);
//! assert_eq!(learner.episodes, 4, "two to see what is observed, and two to learn from");
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod actor;
mod advantage;
mod batch;
mod check;
mod checkpoint;
mod cloning;
mod critic;
mod dapg;
mod demonstrations;
mod fit;
mod learner;
mod method;
mod npg;
mod on_policy;
mod ppo;
mod preset;
mod replay;
mod rollout;
mod sac;
mod settings;
mod shuffle;
mod teacher;
mod update;

pub use actor::{Actor, Head};
pub use advantage::Horizon;
pub use checkpoint::Card;
pub use dapg::Dapg;
pub use demonstrations::Demonstrations;
pub use fit::Fit;
pub use learner::{Iteration, Learner};
pub use npg::Npg;
pub use ppo::Ppo;
pub use rollout::{Choice, Collector, Episode};
pub use sac::Sac;
pub use settings::{Algorithm, Settings};
pub use teacher::{Lessons, Teacher, Teaching};
pub use update::Update;
