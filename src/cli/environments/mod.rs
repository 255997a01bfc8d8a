//! Commands that work on environments.

pub mod batch_speed;
pub mod bench_env;
pub mod bench_visual;
pub mod check_env;
pub mod env_requests;
pub mod info;
pub mod list;
pub mod rollout;
pub mod run;
