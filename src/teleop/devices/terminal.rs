//! A terminal whose keys are read one by one.

use crate::error::TeleopError;
use crate::event::Event;
use crate::keyboard::{Answer, Keyboard, QUESTION, TURN_OFF, TURN_ON};
use rustix::termios::{
    InputModes, LocalModes, OptionalActions, SpecialCodeIndex, Termios, tcgetattr, tcsetattr,
};
use std::io::{IsTerminal, Stdin, Write, stdin, stdout};
use std::os::fd::{AsFd, BorrowedFd};

/// The terminal of standard input, without line editing and echo until this is dropped.
pub struct Terminal {
    input: Stdin,
    before: Termios,
    keyboard: Keyboard,
    /// It tells releases, and was asked to.
    releases: bool,
}

impl Terminal {
    /// Takes the keyboard, and asks the terminal whether it can tell releases; it answers among the keys.
    ///
    /// # Errors
    /// Standard input is no terminal.
    pub fn open() -> Result<Self, TeleopError> {
        let input = stdin();
        let refused = |_| TeleopError::Device {
            device: "keyboard".to_owned(),
            path: None,
            message: "standard input is no terminal".to_owned(),
            fix: "run the command in a terminal, without a pipe or a redirection, or `ssh -t`".to_owned(),
        };
        let before = tcgetattr(&input).map_err(refused)?;
        let mut single = before.clone();
        single.local_modes &= !(LocalModes::ICANON | LocalModes::ECHO);
        single.input_modes &= !(InputModes::ICRNL | InputModes::IXON);
        single.special_codes[SpecialCodeIndex::VMIN] = 0;
        single.special_codes[SpecialCodeIndex::VTIME] = 0;
        if cfg!(target_os = "linux") {
            // A session that is stopped by Ctrl-Z would leave the shell a terminal that it does not know.
            single.special_codes[SpecialCodeIndex::VSUSP] = 0;
        }
        tcsetattr(&input, OptionalActions::Now, &single).map_err(refused)?;
        if stdout().is_terminal() {
            say(QUESTION);
        }
        Ok(Terminal { input, before, keyboard: Keyboard::default(), releases: false })
    }

    /// Takes what was typed until `now` \[s\]; false where the terminal is gone.
    pub fn read(&mut self, ready: bool, now: f64, events: &mut Vec<Event>) -> bool {
        let mut bytes = [0; 1024];
        let mut there = true;
        if ready {
            match rustix::io::read(&self.input, &mut bytes) {
                Ok(0) => there = false,
                Ok(count) => self.keyboard.feed(&bytes[..count], now, events),
                Err(rustix::io::Errno::AGAIN | rustix::io::Errno::INTR) => {}
                Err(_) => there = false,
            }
        }
        self.keyboard.settle(now, events);
        for answer in self.keyboard.answers() {
            if answer == Answer::Releases && !self.releases {
                self.releases = true;
                say(TURN_ON);
            }
        }
        there
    }

    /// Whether it tells releases.
    pub fn tells_releases(&self) -> bool {
        self.releases
    }
}

impl AsFd for Terminal {
    fn as_fd(&self) -> BorrowedFd<'_> {
        self.input.as_fd()
    }
}

impl Drop for Terminal {
    fn drop(&mut self) {
        if self.releases {
            say(TURN_OFF);
        }
        // There is nobody to tell that it did not work.
        _ = tcsetattr(&self.input, OptionalActions::Drain, &self.before);
    }
}

/// Writes to the terminal; one that does not listen is left alone.
fn say(text: &str) {
    let mut out = stdout().lock();
    _ = out.write_all(text.as_bytes()).and_then(|()| out.flush());
}
