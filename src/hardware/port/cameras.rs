//! Cameras of this machine.

use super::capture::{Capture, Captures, Request};
use robot::Fault;
use std::path::Path;

/// A video device that the system knows.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Found {
    /// Path of its device node.
    pub path: String,
    /// Its name, from its driver.
    pub name: String,
    /// Vendor and product on the USB bus, as `8086:0b07`.
    pub usb: Option<String>,
    /// Its serial number on the USB bus.
    pub serial: Option<String>,
}

/// Where Linux lists video devices.
const LIST: &str = "/sys/class/video4linux";

/// Video devices of this machine, by the numbers of their nodes. One camera often has several: for frames, for
/// metadata, for each of its imagers.
pub fn video_devices() -> Vec<Found> {
    listed(Path::new(LIST))
}

/// The devices that a folder like Linux's lists.
fn listed(folder: &Path) -> Vec<Found> {
    let entries = std::fs::read_dir(folder).into_iter().flatten().flatten();
    let mut numbered: Vec<(u32, Found)> = entries
        .filter_map(|entry| {
            let node = entry.file_name().into_string().ok()?;
            let number = node.strip_prefix("video")?.parse().ok()?;
            Some((number, described(&node, &entry.path())))
        })
        .collect();
    numbered.sort_by_key(|(number, _)| *number);
    numbered.into_iter().map(|(_, found)| found).collect()
}

fn described(node: &str, entry: &Path) -> Found {
    let text =
        |path: std::path::PathBuf| std::fs::read_to_string(path).ok().map(|text| text.trim().to_owned());
    // The device is an interface on the USB bus; its parent has the identity.
    let usb = |file: &str| text(entry.join("device/..").join(file));
    Found {
        path: format!("/dev/{node}"),
        name: text(entry.join("name")).unwrap_or_default(),
        usb: usb("idVendor").zip(usb("idProduct")).map(|(vendor, product)| format!("{vendor}:{product}")),
        serial: usb("serial"),
    }
}

/// The cameras of this machine.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct System;

impl Captures for System {
    #[cfg(target_os = "linux")]
    fn open(&self, _: &str, request: &Request) -> Result<Box<dyn Capture>, Fault> {
        use super::capture::Source;
        use super::video::Video;
        let serial = match &request.source {
            Source::Node(path) => return Ok(Box::new(Video::open(path, request)?)),
            Source::RealSense(serial) => serial.as_deref(),
        };
        let nodes = real_sense(&video_devices(), serial)?;
        let offers = |path: &&String| Video::offers(path, &request.encodings);
        let node = nodes.iter().find(offers).ok_or_else(|| {
            Fault::Refused(format!(
                "{} offers no {} at {}",
                request.source,
                request.encodings[0],
                nodes.join(", ")
            ))
        })?;
        Ok(Box::new(Video::open(node, request)?))
    }

    #[cfg(not(target_os = "linux"))]
    fn open(&self, _: &str, _: &Request) -> Result<Box<dyn Capture>, Fault> {
        Err(Fault::Refused("cameras are supported on Linux only".to_owned()))
    }
}

/// Vendor of RealSense cameras, and the beginning of their names.
#[cfg(target_os = "linux")]
const REAL_SENSE: (&str, &str) = ("8086:", "Intel(R) RealSense");

/// The nodes of the RealSense with this serial number, or of the only one.
#[cfg(target_os = "linux")]
fn real_sense(devices: &[Found], serial: Option<&str>) -> Result<Vec<String>, Fault> {
    let is_one = |found: &&Found| {
        found.usb.as_deref().is_some_and(|usb| usb.starts_with(REAL_SENSE.0))
            && found.name.starts_with(REAL_SENSE.1)
    };
    let all: Vec<_> = devices.iter().filter(is_one).collect();
    let mut serials: Vec<_> = all.iter().filter_map(|found| found.serial.as_deref()).collect();
    serials.sort_unstable();
    serials.dedup();
    let chosen = match (serial, &serials[..]) {
        (_, []) => return Err(Fault::Unreachable("no RealSense is connected to this machine".to_owned())),
        (None, [only]) => *only,
        (None, several) => {
            return Err(Fault::Refused(format!(
                "its interface needs a 'serial': there are several RealSense cameras, {}",
                several.join(", ")
            )));
        }
        (Some(serial), known) => known.iter().find(|known| **known == serial).ok_or_else(|| {
            Fault::Unreachable(format!(
                "no RealSense has the serial number {serial} on the USB bus; there are {}. Set 'serial' to the number that \
                 rs-enumerate-devices calls Asic Serial Number, not the one printed on the camera",
                known.join(", ")
            ))
        })?,
    };
    Ok(all
        .iter()
        .filter(|found| found.serial.as_deref() == Some(chosen))
        .map(|found| found.path.clone())
        .collect())
}

#[cfg(all(test, target_os = "linux"))]
mod tests {
    use super::*;

    fn found(path: &str, usb: &str, serial: &str) -> Found {
        Found {
            path: path.to_owned(),
            name: "Intel(R) RealSense(TM) Depth Camera 435".to_owned(),
            usb: Some(usb.to_owned()),
            serial: Some(serial.to_owned()),
        }
    }

    #[test]
    fn nodes_are_listed_by_number_with_their_identity() {
        let root = std::env::temp_dir().join(format!("robohive-video-{}", std::process::id()));
        for number in [10, 2] {
            let entry = root.join(format!("class/video{number}"));
            let usb = root.join(format!("usb{number}"));
            std::fs::create_dir_all(usb.join("interface")).unwrap();
            std::fs::create_dir_all(&entry).unwrap();
            std::os::unix::fs::symlink(usb.join("interface"), entry.join("device")).unwrap();
            std::fs::write(entry.join("name"), format!("Camera {number}\n")).unwrap();
            let facts = [("idVendor", "8086\n"), ("idProduct", "0b07\n"), ("serial", "12345\n")];
            for (file, text) in facts {
                std::fs::write(usb.join(file), text).unwrap();
            }
        }
        let devices = listed(&root.join("class"));
        std::fs::remove_dir_all(&root).unwrap();
        let paths: Vec<_> = devices.iter().map(|found| found.path.as_str()).collect();
        assert_eq!(paths, ["/dev/video2", "/dev/video10"]);
        assert_eq!(devices[0].name, "Camera 2");
        assert_eq!(
            (devices[1].usb.as_deref(), devices[1].serial.as_deref()),
            (Some("8086:0b07"), Some("12345"))
        );
    }

    #[test]
    fn a_real_sense_is_found_by_serial_number_or_because_it_is_the_only_one() {
        let first = [found("/dev/video0", "8086:0b07", "11"), found("/dev/video4", "8086:0b07", "11")];
        let other = Found { usb: Some("046d:0825".to_owned()), ..found("/dev/video6", "", "22") };
        let one = [&first[..], &[other]].concat();
        assert_eq!(real_sense(&one, None).unwrap(), ["/dev/video0", "/dev/video4"]);
        let two = [&one[..], &[found("/dev/video8", "8086:0b3a", "33")]].concat();
        assert_eq!(real_sense(&two, Some("33")).unwrap(), ["/dev/video8"]);
        let several = real_sense(&two, None).unwrap_err().to_string();
        assert!(several.contains("'serial'") && several.contains("11, 33"), "{several}");
        let unknown = real_sense(&two, Some("44")).unwrap_err().to_string();
        assert!(unknown.contains("44") && unknown.contains("11, 33"), "{unknown}");
        assert!(real_sense(&[], None).unwrap_err().to_string().contains("no RealSense"));
    }
}
