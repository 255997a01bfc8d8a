//! Which model a command works on, and how it is read.

use clap::{Args, ValueHint};
use std::path::PathBuf;

/// An MJCF file, and what its template text stands for; or a compiled model.
#[derive(Args)]
pub struct ModelSource {
    /// MJCF file, or a model written by `compile`; - for standard input
    #[arg(value_name = "MODEL", value_hint = ValueHint::FilePath)]
    pub path: PathBuf,
    /// How it is read
    #[command(flatten)]
    pub reading: Reading,
}

/// How models are read.
#[derive(Args)]
pub struct Reading {
    /// Replace TEXT by VALUE in the file and all it includes, e.g. OBJECT_NAME=apple; TEXT must occur
    #[arg(long = "define", value_name = "TEXT=VALUE")]
    pub defines: Vec<String>,
    /// Keep compiled models in this folder, and take them from there while none of their input files has changed
    /// [default: the environment variable ROBOHIVE_CACHE, else none are kept]
    #[arg(long, value_name = "FOLDER", value_hint = ValueHint::DirPath)]
    pub cache: Option<PathBuf>,
    /// Memory that the model may ask for, in MiB
    #[arg(long, value_name = "MIB", default_value_t = 2048, value_parser = clap::value_parser!(u32).range(1..))]
    pub memory: u32,
}
