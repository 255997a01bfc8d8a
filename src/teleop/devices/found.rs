//! Which devices there are, from what the kernel says of them.

use std::path::{Path, PathBuf};

/// A device that could be opened.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Candidate {
    /// Its name.
    pub name: String,
    /// Its file.
    pub path: PathBuf,
}

/// Makers of six-axis mice (USB).
const MAKERS: [&str; 2] = ["0000256F", "0000046D"];
/// Products of Logitech that are six-axis mice.
const PRODUCTS: [&str; 7] = ["C603", "C605", "C606", "C625", "C626", "C627", "C629"];
/// The Pro, of Logitech too.
const PRO: &str = "C62B";

/// Gamepads of the text of `/proc/bus/input/devices`: what also has a joystick's handler.
pub fn gamepads(text: &str) -> Vec<Candidate> {
    let mut found = Vec::new();
    for block in text.split("\n\n") {
        let line = |start: &str| block.lines().find_map(|line| line.strip_prefix(start));
        let name = line("N: Name=").unwrap_or_default().trim_matches('"').to_owned();
        let handlers: Vec<&str> = line("H: Handlers=").unwrap_or_default().split_whitespace().collect();
        let plays = handlers.iter().any(|handler| handler.strip_prefix("js").is_some_and(is_number));
        let event = handlers.iter().find(|handler| handler.strip_prefix("event").is_some_and(is_number));
        if let Some(event) = event.filter(|_| plays) {
            found.push(Candidate { name, path: Path::new("/dev/input").join(event) });
        }
    }
    found
}

fn is_number(text: &str) -> bool {
    !text.is_empty() && text.bytes().all(|byte| byte.is_ascii_digit())
}

/// Six-axis mice among devices of `hidraw`, each with its name under `/dev` and the text of its `device/uevent`.
pub fn space_mice<'a>(devices: impl IntoIterator<Item = (&'a str, &'a str)>) -> Vec<Candidate> {
    let is_one = |text: &str| {
        let id = text.lines().find_map(|line| line.strip_prefix("HID_ID="))?;
        let (_, rest) = id.split_once(':')?;
        let (maker, product) = rest.split_once(':')?;
        let product = product.trim().strip_prefix("0000")?;
        let known =
            maker == MAKERS[0] || (maker == MAKERS[1] && (PRODUCTS.contains(&product) || product == PRO));
        known.then_some(())
    };
    let name = |text: &str| {
        let name = text.lines().find_map(|line| line.strip_prefix("HID_NAME="));
        name.unwrap_or("six-axis mouse").to_owned()
    };
    let candidate = |(file, text): (&str, &str)| {
        is_one(text).map(|()| Candidate { name: name(text), path: Path::new("/dev").join(file) })
    };
    devices.into_iter().filter_map(candidate).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn gamepads_are_what_joysticks_handle() {
        let text = "I: Bus=0003 Vendor=045e\nN: Name=\"Microsoft X-Box 360 pad\"\nH: Handlers=event17 js0 \nB: EV=20000b\n\n\
                    I: Bus=0011\nN: Name=\"AT keyboard\"\nH: Handlers=sysrq kbd event3 leds \n\nN: Name=\"odd\"\nH: Handlers=js1\n";
        let expected =
            Candidate { name: "Microsoft X-Box 360 pad".into(), path: "/dev/input/event17".into() };
        assert_eq!(gamepads(text), [expected]);
        assert!(gamepads("").is_empty());
    }

    #[test]
    fn six_axis_mice_are_known_by_maker_and_product() {
        let devices = [
            ("hidraw0", "DRIVER=hid\nHID_ID=0003:0000046D:0000C077\nHID_NAME=Logitech USB Optical Mouse"),
            ("hidraw1", "HID_ID=0003:0000256F:0000C635\nHID_NAME=3Dconnexion SpaceMouse Compact"),
            ("hidraw2", "HID_ID=0003:0000046D:0000C626\n"),
            ("hidraw3", "HID_ID=broken"),
        ];
        let found = space_mice(devices);
        let paths: Vec<_> = found.iter().map(|candidate| candidate.path.to_str().unwrap()).collect();
        assert_eq!(paths, ["/dev/hidraw1", "/dev/hidraw2"]);
        assert_eq!(found[0].name, "3Dconnexion SpaceMouse Compact");
    }
}
