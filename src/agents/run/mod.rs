//! Trainings in folders, which can be interrupted and resumed.
//!
//! A run is a folder: `run.toml` says what is trained and how, `log.csv` and `log.jsonl` have a row for each iteration, `checkpoint.safetensors` is
//! where it goes on, `demonstrations.safetensors` is what it learns from besides, and `policy.safetensors` is what acts. Rows after the last checkpoint
//! are made again when it goes on: with the same numbers.
//!
//! `events.out.tfevents.robohive` has the same rows for TensorBoard: an event for each iteration, with a scalar for each column, in single
//! precision. Its step is `num_samples`, the environment's steps so far; its wall time is the sum of `time` so far \[s\], which differs from
//! machine to machine as `time` does, and leaves out the pauses of a run that was interrupted. TensorBoard's
//! relative time is thus the time that learning took; dates are those of the beginning of 1970. Tags are names of columns within groups:
//!
//! | group | columns |
//! |---|---|
//! | `rollout/` | what the episodes were like: `stoc_pol_mean` … `faults` |
//! | `train/` | what the update was like: `kl_dist`, `entropy`, `clipped`, `vf_explained` |
//! | `time/` | `iteration`, `num_samples`, `episodes`, `time` |
//!
//! Numbers that are NaN are written too: TensorBoard marks them. The file is made again from `log.csv` when a run goes on, so that it has
//! each iteration once, also where a run began without it; a TensorBoard that is open meanwhile may keep reading the old file.
//!
//! ```
//! use robohive_agents::{Policy, learn::Settings, run::{Config, Run}};
//! # use env as robohive_env;
//! use robohive_env::{Env, Options, OwnModels};
//!
//! let env = Env::make("hive/myoElbowPose1D6MRandom-v0", &OwnModels, &Options::default())?;
//! let learning = Settings { episodes: 2, ..Settings::npg() };
//! let config = Config { iterations: 1, ..Config::new(&env.spec().id, learning) };
//! let folder = std::env::temp_dir().join(format!("robohive-run-{}", std::process::id()));
//! // On one thread; nobody demonstrates anything here.
//! let mut run = Run::create(&folder, config, &env, 1, |_| ())?;
//! while !run.is_finished() {
//!     let row = run.iterate()?;
//!     assert!(row.get("num_samples") == 400.0 && row.get("kl_dist") > 0.0);
//! }
//! assert!(matches!(Policy::open(run.policy())?, Policy::Trained(_)));
//! # std::fs::remove_dir_all(folder)?;
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod config;
mod events;
mod log;
mod teacher;

pub use config::Config;
pub use log::{COLUMNS, Row};
pub use teacher::teacher;

use crate::error::PolicyError;
use crate::learn::{Card, Collector, Demonstrations, Learner};
use env::Env;
use log::Log;
use std::path::{Path, PathBuf};
use std::time::Instant;

/// Files of the folder.
const CONFIG: &str = "run.toml";
const CHECKPOINT: &str = "checkpoint.safetensors";
const POLICY: &str = "policy.safetensors";
const DEMONSTRATIONS: &str = "demonstrations.safetensors";

/// Environments that each thread steps side by side: networks are faster on several rows.
const SIDE_BY_SIDE: usize = 16;

/// A training in a folder.
pub struct Run {
    folder: PathBuf,
    config: Config,
    learner: Learner,
    collector: Collector,
    log: Log,
    /// Iterations when the last checkpoint was written.
    kept: u64,
}

impl Run {
    /// Begins a run in a new or empty folder, on environments like `env` with this number of threads, 0 for as many as there are processors, which make
    /// no difference to what is learnt. Where it is learnt from demonstrations, the teacher plays now, and each of its episodes is told of.
    ///
    /// # Errors
    /// The folder holds something or cannot be written; settings make no sense; there is no teacher where one is needed, or it fails; the
    /// environment is hardware.
    pub fn create(
        folder: &Path,
        config: Config,
        env: &Env,
        threads: usize,
        tell: impl FnMut(&Demonstrations),
    ) -> Result<Self, PolicyError> {
        refuse_full(folder)?;
        config.learning.check().map_err(|message| PolicyError::run(folder, message))?;
        let mut learner = Learner::new(config.learning.clone(), config.seed, env);
        learner.check_size().map_err(|error| PolicyError::run(folder, error))?;
        // A teacher that fails leaves no folder.
        if let Some(teaching) = config.teaching()? {
            learner.teach(teacher::shown(teaching, config.seed, env, tell)?);
        }
        let collector = collector(&config, env, threads)?;
        std::fs::create_dir_all(folder).map_err(|error| PolicyError::run(folder, error))?;
        config.write(&folder.join(CONFIG))?;
        let log = Log::open(folder, 0)?;
        let mut run = Run { folder: folder.into(), config, learner, collector, log, kept: 0 };
        run.keep()?;
        Ok(run)
    }

    /// What the run in a folder is of.
    ///
    /// # Errors
    /// There is no run.
    pub fn config_of(folder: &Path) -> Result<Config, PolicyError> {
        Config::read(&folder.join(CONFIG))
    }

    /// What each iteration of the run in a folder was like.
    ///
    /// # Errors
    /// There is no log, or it is damaged.
    pub fn rows_of(folder: &Path) -> Result<Vec<Row>, PolicyError> {
        log::read(folder)
    }

    /// Iterations that the last checkpoint of the run in a folder has.
    ///
    /// # Errors
    /// There is no checkpoint.
    pub fn iterations_of(folder: &Path) -> Result<u64, PolicyError> {
        Card::of_file(&folder.join(CHECKPOINT)).map(|card| card.iterations)
    }

    /// The file of the policy of the run in a folder.
    pub fn policy_of(folder: &Path) -> PathBuf {
        folder.join(POLICY)
    }

    /// Goes on with the run in a folder, from its last checkpoint, with this number of threads.
    ///
    /// # Errors
    /// There is no run; the environment is not its; the files cannot be read or written; its teacher is needed again and is not there.
    pub fn resume(folder: &Path, env: &Env, threads: usize) -> Result<Self, PolicyError> {
        let config = Self::config_of(folder)?;
        let mut learner = Learner::resume(&folder.join(CHECKPOINT), env)?;
        if (learner.settings(), learner.seed()) != (&config.learning, config.seed) {
            let message = "its seed or [learning] differs from the checkpoint's: undo the change, or train from a copy of the file";
            return Err(PolicyError::run(&folder.join(CONFIG), message));
        }
        let (algorithm, file) = (config.learning.algorithm, folder.join(DEMONSTRATIONS));
        if algorithm.needs_demonstrations() {
            let mut demonstrations = Demonstrations::open(env, &file)?;
            if algorithm.needs_corrections() {
                let corrected = learner.iterations * config.learning.episodes;
                demonstrations.keep_corrected(corrected).map_err(|error| error.within(&file))?;
            }
            learner.teach(demonstrations);
        }
        let collector = collector(&config, env, threads)?;
        let kept = learner.iterations;
        let log = Log::open(folder, kept)?;
        Ok(Run { folder: folder.into(), config, learner, collector, log, kept })
    }

    /// What is trained, and how.
    pub fn config(&self) -> &Config {
        &self.config
    }

    /// Iterations made.
    pub fn iterations(&self) -> u64 {
        self.learner.iterations
    }

    /// Whether all iterations are made.
    pub fn is_finished(&self) -> bool {
        self.iterations() >= self.config.iterations
    }

    /// Makes more iterations than was planned.
    ///
    /// # Errors
    /// The configuration cannot be written.
    pub fn extend(&mut self, iterations: u64) -> Result<(), PolicyError> {
        self.config.iterations = iterations;
        self.config.write(&self.folder.join(CONFIG))
    }

    /// Makes an iteration and logs it; keeps the state when it is time for that, or all iterations are made.
    ///
    /// # Errors
    /// An environment fails or gives a reward that is not finite; files cannot be written.
    pub fn iterate(&mut self) -> Result<Row, PolicyError> {
        let began = Instant::now();
        let iteration = self.learner.iterate(&mut self.collector)?;
        let row = Row::new(&self.learner, &iteration, began.elapsed().as_secs_f64());
        self.log.add(&row)?;
        if self.iterations().is_multiple_of(self.config.keep_every.max(1)) || self.is_finished() {
            self.keep()?;
        }
        Ok(row)
    }

    /// Keeps the state, if it is not kept already.
    ///
    /// # Errors
    /// Files cannot be written.
    pub fn keep(&mut self) -> Result<(), PolicyError> {
        if self.kept == self.iterations() && self.folder.join(CHECKPOINT).exists() {
            return Ok(());
        }
        // Demonstrations come first: of more corrections than the checkpoint knows, the rest is left out when the run goes on.
        let grow = self.iterations() == 0 || self.config.learning.algorithm.needs_corrections();
        if let Some(demonstrations) = self.learner.demonstrations().filter(|_| grow) {
            demonstrations.save(&self.folder.join(DEMONSTRATIONS))?;
        }
        let (id, teacher) = (&self.config.id, self.config.teacher.as_ref());
        self.learner.save_policy(id, teacher, &self.folder.join(POLICY))?;
        self.learner.save(id, teacher, &self.folder.join(CHECKPOINT))?;
        self.kept = self.iterations();
        Ok(())
    }

    /// The file of the policy.
    pub fn policy(&self) -> PathBuf {
        Self::policy_of(&self.folder)
    }
}

/// Refuses a folder that holds something.
fn refuse_full(folder: &Path) -> Result<(), PolicyError> {
    let mut entries = match std::fs::read_dir(folder) {
        Ok(entries) => entries,
        Err(error) if error.kind() == std::io::ErrorKind::NotFound => return Ok(()),
        Err(error) => return Err(PolicyError::run(folder, error)),
    };
    match entries.next() {
        None => Ok(()),
        Some(_) => {
            let message = "it is not empty: name another folder, or resume the run that is there";
            Err(PolicyError::run(folder, message))
        }
    }
}

/// What collects episodes, with teachers who correct them where that is learnt from.
fn collector(config: &Config, env: &Env, threads: usize) -> Result<Collector, PolicyError> {
    let threads = match threads {
        0 => std::thread::available_parallelism().map_or(1, usize::from),
        threads => threads,
    };
    let mut collector = Collector::new(env, SIDE_BY_SIDE, threads)?;
    let corrects = config.learning.algorithm.needs_corrections();
    if let Some(teaching) = config.teaching()?.filter(|_| corrects) {
        collector.teach(|env| teacher(&teaching.by, env))?;
    }
    Ok(collector)
}
