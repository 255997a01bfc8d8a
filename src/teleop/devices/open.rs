//! Devices that are open, and waiting for what they say.

use super::found::{Candidate, gamepads, space_mice};
use crate::error::TeleopError;
use crate::event::{Device, Event, Lost};
use crate::gamepad::{Ends, Gamepad};
use crate::glove::Glove;
use crate::quest::Quest;
use crate::space_mouse::SpaceMouse;
use rustix::event::{PollFd, PollFlags, Timespec, poll};
use rustix::fs::{Mode, OFlags};
use rustix::io::Errno;
use std::os::fd::{AsFd, BorrowedFd, OwnedFd};
use std::path::{Path, PathBuf};

/// Most bytes of one reading.
const MOST: usize = 4096;

/// What decodes the bytes of a device.
pub(super) enum Decoder {
    Gamepad(Gamepad),
    SpaceMouse(SpaceMouse),
    Quest(Quest),
    Glove(Glove),
}

/// A device that is open.
pub struct Opened {
    file: OwnedFd,
    decoder: Decoder,
    name: String,
}

impl Opened {
    /// The first gamepad there is, or the one at a path; `ends` are those of axes that a mapping names.
    ///
    /// # Errors
    /// There is none, or it must not be read; the error says what to do.
    pub fn gamepad(path: Option<&Path>, ends: &[(u16, Ends)]) -> Result<Self, TeleopError> {
        let listed = || gamepads(&std::fs::read_to_string("/proc/bus/input/devices").unwrap_or_default());
        let found =
            choose("gamepad", path, listed, "connect one, or name its file by --path /dev/input/eventN")?;
        let file = open("gamepad", &found, "the group input")?;
        Ok(Opened { file, decoder: Decoder::Gamepad(Gamepad::with_ends(ends.to_vec())), name: found.name })
    }

    /// The first six-axis mouse there is, or the one at a path.
    ///
    /// # Errors
    /// As [`Opened::gamepad`].
    pub fn space_mouse(path: Option<&Path>) -> Result<Self, TeleopError> {
        let found =
            choose("six-axis mouse", path, hidraw, "connect one, or name its file by --path /dev/hidrawN")?;
        let file = open(
            "six-axis mouse",
            &found,
            "a group that a udev rule gives the device to, as \
            KERNEL==\"hidraw*\", ATTRS{idVendor}==\"256f\", GROUP=\"input\", MODE=\"0660\" does",
        )?;
        Ok(Opened { file, decoder: Decoder::SpaceMouse(SpaceMouse::default()), name: found.name })
    }

    /// A source of lines of a headset's log, such as a pipe that `adb logcat` writes to.
    ///
    /// # Errors
    /// It cannot be opened.
    pub fn quest(path: Option<&Path>) -> Result<Self, TeleopError> {
        let fix = "make a pipe, `mkfifo quest; adb logcat -T 1 > quest &`, and name it by --path quest";
        let found = choose("Quest", path, Vec::new, fix)?;
        let file = open("Quest", &found, "whoever may read the pipe")?;
        Ok(Opened { file, decoder: Decoder::Quest(Quest::default()), name: found.name })
    }

    /// A device whose bytes come from an open file, such as a socket.
    pub fn of(device: Device, file: OwnedFd) -> Self {
        let (decoder, name) = match device {
            Device::Gamepad => (Decoder::Gamepad(Gamepad::default()), "gamepad"),
            Device::SpaceMouse => (Decoder::SpaceMouse(SpaceMouse::default()), "six-axis mouse"),
            Device::Quest => (Decoder::Quest(Quest::default()), "Quest"),
            Device::Glove => (Decoder::Glove(Glove::default()), "glove"),
        };
        Opened { file, decoder, name: name.to_owned() }
    }

    /// The device by another name.
    pub fn called(self, name: &str) -> Self {
        Opened { name: name.to_owned(), ..self }
    }

    /// Its name, for people.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// What decodes its bytes.
    pub(super) fn decoder(&mut self) -> &mut Decoder {
        &mut self.decoder
    }

    fn device(&self) -> Device {
        match self.decoder {
            Decoder::Gamepad(_) => Device::Gamepad,
            Decoder::SpaceMouse(_) => Device::SpaceMouse,
            Decoder::Quest(_) => Device::Quest,
            Decoder::Glove(_) => Device::Glove,
        }
    }

    /// Takes what is there to read. A device that is gone releases everything.
    ///
    /// # Errors
    /// It is gone.
    pub fn read(&mut self, events: &mut Vec<Event>) -> Result<(), TeleopError> {
        let mut bytes = [0; MOST];
        match rustix::io::read(&self.file, &mut bytes) {
            Ok(0) => {}
            Ok(count) => {
                match &mut self.decoder {
                    Decoder::Gamepad(gamepad) => gamepad.feed(&bytes[..count], events),
                    Decoder::SpaceMouse(mouse) => mouse.report(&bytes[..count], events),
                    Decoder::Quest(quest) => quest.feed(&bytes[..count], events),
                    Decoder::Glove(glove) => {
                        glove.feed(&bytes[..count], events);
                        if let Some(trouble) = glove.trouble() {
                            return Err(TeleopError::Device {
                                device: self.name.clone(),
                                path: None,
                                message: trouble.to_string(),
                                fix: "plug it in and start again; finished episodes are kept".to_owned(),
                            });
                        }
                    }
                }
                return Ok(());
            }
            Err(Errno::AGAIN | Errno::INTR) => return Ok(()),
            Err(_) => {}
        }
        events.push(Event::Lost(Lost::Device(self.device())));
        Err(TeleopError::Device {
            device: self.name.clone(),
            path: None,
            message: "it is gone".to_owned(),
            fix: "connect it again and start again; finished episodes are kept".to_owned(),
        })
    }
}

impl AsFd for Opened {
    fn as_fd(&self) -> BorrowedFd<'_> {
        self.file.as_fd()
    }
}

/// What there was to read, in the order of what was waited for.
pub type Wait = Vec<bool>;

/// Waits until one of these has something to read, or until `seconds` are over.
///
/// # Errors
/// The system refuses.
pub fn wait(files: &[BorrowedFd<'_>], seconds: f64) -> std::io::Result<Wait> {
    let mut polled: Vec<PollFd<'_>> =
        files.iter().map(|file| PollFd::from_borrowed_fd(*file, PollFlags::IN)).collect();
    let seconds = seconds.clamp(0.0, 3600.0);
    let timeout = Timespec { tv_sec: seconds as i64, tv_nsec: (seconds.fract() * 1e9) as i64 };
    match poll(&mut polled, Some(&timeout)) {
        Ok(_) | Err(Errno::INTR) => {}
        Err(error) => return Err(error.into()),
    }
    Ok(polled.iter().map(|polled| !polled.revents().is_empty()).collect())
}

fn choose(
    device: &str,
    path: Option<&Path>,
    listed: impl FnOnce() -> Vec<Candidate>,
    fix: &str,
) -> Result<Candidate, TeleopError> {
    match path {
        Some(path) => Ok(Candidate { name: device.to_owned(), path: path.to_owned() }),
        None => listed().into_iter().next().ok_or_else(|| TeleopError::Device {
            device: device.to_owned(),
            path: None,
            message: "there is none".to_owned(),
            fix: fix.to_owned(),
        }),
    }
}

fn open(device: &str, found: &Candidate, readers: &str) -> Result<OwnedFd, TeleopError> {
    let flags = OFlags::RDONLY | OFlags::NONBLOCK | OFlags::CLOEXEC;
    rustix::fs::open(&found.path, flags, Mode::empty())
        .map_err(|error| refusal(device, found, readers, error))
}

/// Why a device is not opened, and what to do.
fn refusal(device: &str, found: &Candidate, readers: &str, error: Errno) -> TeleopError {
    let (message, fix) = match error {
        Errno::ACCESS | Errno::PERM => (
            "you may not read it".to_owned(),
            format!("it may be read by {readers}: `sudo usermod -aG input $USER`, then log in again"),
        ),
        error => (error.to_string(), "name another file by --path".to_owned()),
    };
    TeleopError::Device { device: device.to_owned(), path: Some(found.path.clone()), message, fix }
}

/// Six-axis mice that the kernel knows.
fn hidraw() -> Vec<Candidate> {
    let folder = PathBuf::from("/sys/class/hidraw");
    let entries = std::fs::read_dir(&folder).into_iter().flatten().flatten();
    let mut texts: Vec<(String, String)> = entries
        .filter_map(|entry| {
            let text = std::fs::read_to_string(entry.path().join("device/uevent")).ok()?;
            Some((entry.file_name().into_string().ok()?, text))
        })
        .collect();
    texts.sort();
    space_mice(texts.iter().map(|(name, text)| (&name[..], &text[..])))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_refusal_names_device_path_and_group() {
        let found = Candidate { name: "pad".into(), path: "/dev/input/event17".into() };
        let said = refusal("gamepad", &found, "the group input", Errno::ACCESS).to_string();
        for part in ["gamepad", "/dev/input/event17", "you may not read it", "usermod -aG input"] {
            assert!(said.contains(part), "{part}: {said}");
        }
        let said = refusal("gamepad", &found, "the group input", Errno::NOENT).to_string();
        assert!(said.contains("--path") && !said.contains("usermod"), "{said}");
    }
}
