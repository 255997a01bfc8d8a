//! What pictures of environments are asked for by, made of, and drawn with.

pub(crate) mod cameras;
pub(crate) mod eyes;
pub(crate) mod network;
pub(crate) mod rendering;
pub(crate) mod sight;
pub mod visual;
