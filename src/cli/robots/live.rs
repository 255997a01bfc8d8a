//! Environments whose robot is hardware.

use crate::failure::Failure;
use crate::input::library::Making;
use crate::interrupt::Interrupt;
use crate::robots::rehearsal::{rehearsal, simulated};
use crate::terminal::note;
use ::hardware::Setup;
use clap::{Args, ValueHint};
use env::Hardware;
use library::real_hardware;
use robot::Config;
use std::io::BufRead;
use std::path::PathBuf;
use std::sync::Arc;
use std::sync::mpsc::{self, RecvTimeoutError};
use std::time::Duration;

/// How a robot that is hardware is reached.
#[derive(Args)]
pub struct Live {
    /// Run on the devices that this robot config names, instead of in simulation
    #[arg(long, value_name = "CONFIG", value_hint = ValueHint::FilePath)]
    pub hardware: Option<PathBuf>,
    /// How far devices may go
    #[command(flatten)]
    pub arming: Arming,
    /// Drive simulated devices in simulated time instead of real ones: a rehearsal of the whole way
    #[arg(long, requires = "hardware", conflicts_with = "flight")]
    pub rehearse: bool,
}

/// How far devices may go.
#[derive(Args)]
pub struct Arming {
    /// Let the devices move
    #[arg(long)]
    pub arm: bool,
    /// Read the devices, and print what they would be sent instead of sending it
    #[arg(long, conflicts_with = "arm")]
    pub dry_run: bool,
    /// Keep the last minutes of commands, readings and faults of each device in this folder
    #[arg(long, value_name = "FOLDER", value_hint = ValueHint::DirPath)]
    pub flight: Option<PathBuf>,
}

/// Devices that are only read.
pub const READING: Arming = Arming { arm: false, dry_run: false, flight: None };

impl Arming {
    /// What drivers run with.
    pub fn setup(&self) -> Setup {
        let mut setup = Setup::default()
            .with_armed(self.arm)
            .with_dry_run(self.dry_run)
            .with_records(self.flight.clone());
        setup.say = Arc::new(note);
        setup
    }

    /// The same; a signal ends the motion of a reset.
    pub fn setup_until(&self, interrupt: &Interrupt) -> Setup {
        let interrupt = interrupt.clone();
        self.setup().with_halted(Arc::new(move || interrupt.code().is_some()))
    }
}

impl Live {
    /// The devices for an environment of this id; `None` in simulation.
    pub fn hardware(&self, id: &str, making: &Making) -> Result<Option<Hardware>, Failure> {
        let Some(path) = &self.hardware else {
            if self.arming.arm || self.arming.dry_run || self.arming.flight.is_some() {
                return Err(Failure::usage(
                    "--arm, --dry-run and --flight are about devices: name their config with --hardware",
                ));
            }
            return Ok(None);
        };
        let config = Config::read(path).map_err(Failure::usage)?;
        let interrupt = Interrupt::listen().map_err(Failure::new)?;
        let setup = self.arming.setup_until(&interrupt);
        Ok(Some(if self.rehearse {
            rehearsal(&config, &mut simulated(id, making)?)?.hardware(config, setup, None)
        } else {
            real_hardware(Some(config), &setup, Arc::new(move |_| ask(&interrupt)))
        }))
    }
}

/// Waits for a person to prepare the surroundings.
fn ask(interrupt: &Interrupt) -> Result<(), env::NotReady> {
    note("the robot stands at the start of an episode; put everything in place and press Enter");
    let (said, heard) = mpsc::channel();
    // Reading a line goes on after a signal, so that a thread of its own reads.
    std::thread::spawn(move || said.send(std::io::stdin().lock().read_line(&mut String::new())));
    loop {
        match heard.recv_timeout(Duration::from_millis(20)) {
            Ok(Ok(0)) => return Err("nobody is there to prepare it: standard input has ended".into()),
            Ok(read) => return Ok(read.map(drop)?),
            Err(RecvTimeoutError::Timeout) if interrupt.code().is_none() => {}
            Err(_) => return Err("a signal ended it while it waited for a person".into()),
        }
    }
}
