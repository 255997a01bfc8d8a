//! A terminal of the test's own, which a session is typed into.

use crate::command::command;
use rustix::pty::{OpenptFlags, grantpt, openpt, ptsname, unlockpt};
use rustix::termios::{Winsize, tcsetwinsize};
use std::fs::File;
use std::io::{Read, Write};
use std::os::fd::OwnedFd;
use std::process::{Child, ExitStatus};
use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant};

/// A session in a terminal.
pub struct Typed {
    master: File,
    /// The other end, kept open so that its settings can be looked at.
    pub slave: File,
    pub child: Child,
    written: Arc<Mutex<String>>,
}

impl Typed {
    /// Starts the command in a terminal.
    pub fn open(arguments: &[&str]) -> Self {
        let master = openpt(OpenptFlags::RDWR | OpenptFlags::NOCTTY | OpenptFlags::CLOEXEC).unwrap();
        grantpt(&master).unwrap();
        unlockpt(&master).unwrap();
        let path = ptsname(&master, Vec::new()).unwrap();
        let slave = File::options().read(true).write(true).open(path.to_str().unwrap()).unwrap();
        tcsetwinsize(&slave, Winsize { ws_row: 30, ws_col: 200, ws_xpixel: 0, ws_ypixel: 0 }).unwrap();
        let end = || OwnedFd::from(slave.try_clone().unwrap());
        let child =
            command().arg("teleop").args(arguments).stdin(end()).stdout(end()).stderr(end()).spawn().unwrap();
        let master = File::from(master);
        let written = Arc::new(Mutex::new(String::new()));
        let (mut from, to) = (master.try_clone().unwrap(), written.clone());
        std::thread::spawn(move || {
            let mut bytes = [0; 4096];
            while let Ok(count @ 1..) = from.read(&mut bytes) {
                to.lock().unwrap().push_str(&String::from_utf8_lossy(&bytes[..count]));
            }
        });
        Typed { master, slave, child, written }
    }

    /// Starts the command in a terminal that tells releases, or does not, and waits for the first episode.
    pub fn start(arguments: &[&str], tells_releases: bool) -> Self {
        let mut typed = Typed::open(arguments);
        typed.wait_for("\u{1b}[?u");
        typed.write(if tells_releases { "\u{1b}[?0u\u{1b}[?62c" } else { "\u{1b}[?62c" });
        if tells_releases {
            typed.wait_for("\u{1b}[>11u");
        }
        typed.wait_for("episode 1");
        typed
    }

    pub fn write(&mut self, keys: &str) {
        self.master.write_all(keys.as_bytes()).unwrap();
    }

    /// All that was written so far.
    pub fn all(&self) -> String {
        self.written.lock().unwrap().clone()
    }

    pub fn wait_for(&self, what: &str) {
        let began = Instant::now();
        while !self.all().contains(what) {
            assert!(began.elapsed() < Duration::from_secs(60), "no {what:?}: {:?}", self.tail());
            std::thread::sleep(Duration::from_millis(5));
        }
    }

    /// The end of it.
    pub fn tail(&self) -> String {
        let all: Vec<char> = self.all().chars().collect();
        all[all.len().saturating_sub(600)..].iter().collect()
    }

    /// The last line that says how it goes.
    pub fn line(&self) -> String {
        let all = self.all();
        all.rsplit('\r').find(|line| line.starts_with("episode ")).unwrap_or_default().to_owned()
    }

    pub fn end(&mut self) -> (ExitStatus, String) {
        let began = Instant::now();
        loop {
            if let Some(status) = self.child.try_wait().unwrap() {
                // What is on its way is read.
                std::thread::sleep(Duration::from_millis(50));
                return (status, self.all());
            }
            assert!(began.elapsed() < Duration::from_secs(60), "it does not end: {:?}", self.tail());
            std::thread::sleep(Duration::from_millis(5));
        }
    }

    pub fn pause(&self) {
        std::thread::sleep(Duration::from_millis(120));
    }
}

impl Drop for Typed {
    fn drop(&mut self) {
        // One that has ended is not there to be ended.
        _ = self.child.kill();
        _ = self.child.wait();
    }
}
