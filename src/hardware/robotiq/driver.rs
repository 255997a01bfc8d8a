//! The driver of a gripper.

use super::line::Line;
use super::settings::{Place, Settings};
use crate::driver::Driver;
use crate::port::{Opener, Sockets};
use crate::safety::limits::Limits;
use crate::safety::watchdog::Timeouts;
use protocol::robotiq::{
    Action, FORCES, SERIOUS, SPEEDS, STROKE, Stage, Status, describe_fault, register, share, width,
};
use robot::{DeviceConfig, Fault};
use std::sync::Arc;

/// Without a reading for this long the fingers are stopped \[s\].
const READING: f64 = 0.2;
/// Longest that an activation takes \[s\].
const ACTIVATION: f64 = 10.0;
/// Time between two looks at an activation \[s\].
const LOOK: f64 = 0.1;

/// A gripper, see [the module](super).
pub struct Robotiq {
    settings: Settings,
    serial: Opener,
    sockets: Arc<dyn Sockets>,
    line: Option<Line>,
    action: Action,
}

impl Robotiq {
    /// The driver of a device; nothing is opened yet.
    ///
    /// # Errors
    /// What the config lacks or says wrongly.
    pub fn new(config: &DeviceConfig, serial: Opener, sockets: Arc<dyn Sockets>) -> Result<Robotiq, Fault> {
        let settings = Settings::new(config)?;
        Ok(Robotiq { settings, serial, sockets, line: None, action: Action::default() })
    }

    fn line(&mut self) -> Result<&mut Line, Fault> {
        self.line.as_mut().ok_or(Fault::NotConnected)
    }

    fn trouble(status: Status) -> Fault {
        let Status { fault, stage, .. } = status;
        match fault {
            0 => Fault::Hardware(format!(
                "the gripper is in stage {stage:?} of its activation; a reset activates it"
            )),
            _ => Fault::Hardware(format!("{} (fault {fault})", describe_fault(fault))),
        }
    }

    /// Activates a gripper that is not; its fingers close and open once.
    fn activate(&mut self) -> Result<(), Fault> {
        let line = self.line()?;
        let status = line.status()?;
        if status.stage == Stage::Active && status.fault < SERIOUS {
            return Ok(());
        }
        line.command(Action::default())?;
        line.wait(LOOK);
        line.command(Action { activate: true, ..Action::default() })?;
        let end = line.now() + ACTIVATION;
        loop {
            line.wait(LOOK);
            match line.status() {
                Ok(status) if status.stage == Stage::Active && status.fault < SERIOUS => return Ok(()),
                Ok(status) if status.fault >= SERIOUS => return Err(Robotiq::trouble(status)),
                // A lost answer is no failure of an activation.
                Ok(_) | Err(Fault::Stale(_)) => {}
                Err(fault) => return Err(fault),
            }
            if line.now() > end {
                let text = format!("the gripper has not ended its activation for {ACTIVATION} s");
                return Err(Fault::Hardware(text));
            }
        }
    }

    fn send(&mut self) -> Result<(), Fault> {
        let action = self.action;
        self.line()?.command(action)
    }
}

impl Driver for Robotiq {
    fn connect(&mut self) -> Result<(), Fault> {
        let explain = |error: std::io::Error| Fault::Unreachable(error.to_string());
        let (line, whence) = match &self.settings.place {
            Place::Serial { path, baud, address } => {
                let port = (self.serial)(path, *baud).map_err(explain)?;
                (Line::new(port, Some(*address)), format!("at address {address} and {baud} baud on {path}"))
            }
            Place::Gateway { host, port } => {
                let connection = self.sockets.connect(host, *port).map_err(explain)?;
                (Line::new(connection, None), format!("behind {host}, port {port}"))
            }
        };
        let line = self.line.insert(line);
        line.status().map(drop).map_err(|fault| match fault {
            Fault::Stale(_) => Fault::Unreachable(format!(
                "no gripper answers {whence}; check its supply of 24 V, its address and its baud rate"
            )),
            other => other,
        })
    }

    fn read(&mut self, values: &mut [f64]) -> Result<(), Fault> {
        let armed = self.action.activate;
        let status = self.line()?.position()?;
        if armed && (status.fault >= SERIOUS || status.stage != Stage::Active) {
            return Err(Robotiq::trouble(status));
        }
        values.fill(width(status.position));
        Ok(())
    }

    fn present(&mut self, commands: &mut [f64]) -> Result<(), Fault> {
        let status = self.line()?.status()?;
        commands.fill(width(status.position));
        Ok(())
    }

    fn arm(&mut self, _present: &[f64]) -> Result<(), Fault> {
        self.activate()?;
        // An activation has moved the fingers.
        let status = self.line()?.status()?;
        self.action = Action {
            activate: true,
            go: true,
            release: false,
            position: status.position,
            speed: share(self.settings.speed, SPEEDS),
            force: share(self.settings.force, FORCES),
        };
        self.send()
    }

    fn command(&mut self, commands: &[f64]) -> Result<(), Fault> {
        let Some(command) = commands.first() else { return Ok(()) };
        let position = register(*command);
        if position == self.action.position {
            return Ok(());
        }
        self.action.position = position;
        self.send()
    }

    fn make_safe(&mut self) -> Result<bool, Fault> {
        // They stop, and hold what they hold.
        self.action.go = false;
        self.send().map(|()| true)
    }

    fn disconnect(&mut self) {
        self.line = None;
        self.action = Action::default();
    }

    fn limits(&self) -> Vec<Limits> {
        vec![Limits::of_value([0.0, STROKE])]
    }

    fn timeouts(&self) -> Timeouts {
        Timeouts { command: self.settings.watchdog, reading: READING, heartbeat: READING / 3.0 }
    }

    fn resource(&self) -> String {
        match &self.settings.place {
            Place::Serial { path, .. } => path.clone(),
            Place::Gateway { host, port } => format!("{host}:{port}"),
        }
    }

    fn reset_duration(&self) -> f64 {
        self.settings.reset_time
    }
}
