//! Devices of `teleop`, by name.

use super::reach::Reach;
use protocol::adb;
use std::fmt;
use std::path::PathBuf;

/// The device that drives.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum DeviceChoice {
    /// The keyboard of this terminal.
    Keyboard,
    /// A gamepad.
    Gamepad,
    /// A six-axis mouse.
    SpaceMouse,
    /// Controllers of a Quest, by the adb server at this address.
    Quest(Option<String>),
    /// A CyberGlove on this serial port.
    Glove(PathBuf),
    /// An arm that is led by hand, by this config.
    Leader(PathBuf),
    /// A phone or a headset, by a page.
    Phone(Reach),
    /// Controllers of an OpenXR runtime, by a program that sends them to this port of the loopback.
    OpenXr(u16),
}

/// Port of the page of phones, and of OpenXR.
const PAGE: u16 = 8090;

impl DeviceChoice {
    /// Reads the argument.
    pub fn read(text: &str) -> Result<Self, String> {
        let (name, place) = text.split_once(':').map_or((text, None), |(name, place)| (name, Some(place)));
        match (name, place) {
            ("keyboard", None) => Ok(DeviceChoice::Keyboard),
            ("gamepad", None) => Ok(DeviceChoice::Gamepad),
            ("spacemouse", None) => Ok(DeviceChoice::SpaceMouse),
            ("quest", None) => Ok(DeviceChoice::Quest(None)),
            ("quest", Some(place)) => {
                let port = place.rsplit_once(':').and_then(|(_, port)| port.parse::<u16>().ok());
                let address = port.map(|_| DeviceChoice::Quest(Some(place.to_owned())));
                address.ok_or_else(|| {
                    format!("'{place}' is not the address of an adb server, such as 127.0.0.1:{}", adb::PORT)
                })
            }
            ("glove", Some(port)) if !port.is_empty() => Ok(DeviceChoice::Glove(port.into())),
            ("leader", Some(file)) if !file.is_empty() => Ok(DeviceChoice::Leader(file.into())),
            ("phone", None) => Ok(DeviceChoice::Phone(Reach::Loopback(PAGE))),
            ("phone-lan", None) => Ok(DeviceChoice::Phone(Reach::Network(PAGE))),
            ("phone-lan", Some(place)) => {
                let port = place.parse().map(Reach::Network);
                let reach = port.or_else(|_| place.parse().map(Reach::Address));
                reach.map(DeviceChoice::Phone).map_err(|_| {
                    format!("'{place}' is neither a port, such as {PAGE}, nor an address of this machine with a port, such as 192.168.0.7:{PAGE}")
                })
            }
            ("phone", Some(text)) => port(text).map(|port| DeviceChoice::Phone(Reach::Loopback(port))),
            ("openxr", None) => Ok(DeviceChoice::OpenXr(PAGE)),
            ("openxr", Some(text)) => port(text).map(DeviceChoice::OpenXr),
            _ => {
                Err("the devices are keyboard, gamepad, spacemouse, quest, quest:HOST:PORT, glove:PORT, leader:FILE, phone, phone:PORT, phone-lan, phone-lan:PORT, phone-lan:ADDRESS:PORT, openxr, openxr:PORT".to_owned())
            }
        }
    }
}

fn port(text: &str) -> Result<u16, String> {
    text.parse().map_err(|_| format!("'{text}' is not a port, such as {PAGE}"))
}

/// Its name, without its address.
impl fmt::Display for DeviceChoice {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            DeviceChoice::Keyboard => "keyboard",
            DeviceChoice::Gamepad => "gamepad",
            DeviceChoice::SpaceMouse => "spacemouse",
            DeviceChoice::Quest(_) => "quest",
            DeviceChoice::Glove(_) => "glove",
            DeviceChoice::Leader(_) => "leader",
            DeviceChoice::Phone(_) => "phone",
            DeviceChoice::OpenXr(_) => "openxr",
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn devices_are_read_with_their_addresses() {
        assert_eq!(DeviceChoice::read("quest"), Ok(DeviceChoice::Quest(None)));
        let address = DeviceChoice::Quest(Some("headset.local:5037".to_owned()));
        assert_eq!(DeviceChoice::read("quest:headset.local:5037"), Ok(address));
        assert_eq!(DeviceChoice::read("glove:/dev/ttyS0"), Ok(DeviceChoice::Glove("/dev/ttyS0".into())));
        assert_eq!(DeviceChoice::read("openxr"), Ok(DeviceChoice::OpenXr(PAGE)));
        assert_eq!(DeviceChoice::read("openxr:0"), Ok(DeviceChoice::OpenXr(0)));
        for wrong in [
            "quest:headset",
            "quest:host:70000",
            "gamepad:3",
            "mouse",
            "glove",
            "glove:",
            "leader",
            "phone:x",
            "openxr:x",
            "openxr:70000",
            "phone-lan:x",
            "",
        ] {
            assert!(DeviceChoice::read(wrong).is_err(), "{wrong}");
        }
        assert_eq!(
            DeviceChoice::read("spacemouse").map(|device| device.to_string()),
            Ok("spacemouse".into())
        );
    }
}
