//! Devices that `robohive wire` serves without a robot's config: servos of three protocols, a headset, a glove.

#![cfg(unix)]

mod command;
mod typing;

use command::{command, robohive, scratch, text};
use rustix::termios::{LocalModes, tcgetattr};
use std::fs::OpenOptions;
use std::io::{BufRead, BufReader, Read, Write};
use std::process::{Child, Stdio};
use typing::Typed;

/// `robohive wire` in the background, and where its devices are.
struct Wire(Child, Vec<String>);

impl Wire {
    fn new(arguments: &[&str], devices: usize) -> Wire {
        let mut child = command().arg("wire").args(arguments).stdout(Stdio::piped()).spawn().unwrap();
        let mut lines = BufReader::new(child.stdout.take().unwrap()).lines();
        let addresses = (0..devices).map(|_| {
            let line = lines.next().unwrap().unwrap();
            line.rsplit(' ').next().unwrap().to_owned()
        });
        let addresses = addresses.collect();
        Wire(child, addresses)
    }
}

impl Drop for Wire {
    fn drop(&mut self) {
        self.0.kill().unwrap_or_default();
        self.0.wait().unwrap();
    }
}

#[test]
fn servos_of_every_protocol_answer_their_drivers() {
    for (model, interface) in [
        ("XL330-M288", "type = 'dynamixel'"),
        ("AX-12A", "type = 'dynamixel', protocol = 1"),
        ("MX-28", "type = 'dynamixel', model = 'MX-28'"),
        ("STS3215", "type = 'feetech'"),
    ] {
        let wire = Wire::new(&["--ids", "1,2", "--model", model], 1);
        let file = scratch("served.toml");
        let config = format!(
            "[[device]]\nname = 'pair'\ninterface = {{ {interface}, name = '{}' }}
             sensor = [{{ name = 'one', range = [-9, 9], hdr_id = 1 }}, {{ name = 'two', range = [-9, 9], hdr_id = 2 }}]",
            wire.1[0]
        );
        std::fs::write(&file, config).unwrap();
        let out = command()
            .args(["hardware", "check", "--samples", "3", "--rate", "20"])
            .arg(&file)
            .output()
            .unwrap();
        let said = text(&out.stdout);
        assert!(
            out.status.success() && said.contains("3 of 3, 0 faults"),
            "{model}: {said}{}",
            text(&out.stderr)
        );
    }
}

#[test]
fn a_headset_leads_a_hand_and_a_glove_says_what_its_fingers_do() {
    let wire = Wire::new(&["--quest", "1WMHH", "--glove", "18"], 2);
    let mut glove = OpenOptions::new().read(true).write(true).open(&wire.1[1]).unwrap();
    glove.write_all(b"?SG").unwrap();
    let mut said = [0; 24];
    glove.read_exact(&mut said).unwrap();
    assert_eq!(said[..5], *b"?S\x12\0G");
    assert_eq!(said[23], 0, "{said:?}");
    assert!(said[5..23].iter().all(|value| (60..=200).contains(value)), "{said:?}");

    // A calibration of 22 sensors is not that of this glove.
    let file = scratch("calibration.toml");
    let of = |value: u8| format!("{:?}", [value; 22]);
    let row = format!("{:?}", [0.0; 23]);
    let calibration = format!(
        "min = {}\nmax = {}\nmatrix = [{row}]\nranges = [[0, 1]]\nactuators = ['joint1']",
        of(0),
        of(255)
    );
    std::fs::write(&file, calibration).unwrap();
    let led = format!("glove:{}", wire.1[1]);
    let arguments = ["hive/FrankaReach-v0", "--device", &led, "--calibration", file.to_str().unwrap()];
    let typed = Typed::start(&arguments, true);
    typed.wait_for("does not say what the 22 sensors of its calibration measure");
    drop(typed);

    let device = format!("quest:{}", wire.1[0]);
    let hand = |typed: &Typed| typed.line().split_once("hand ").map(|(_, after)| after[..20].to_owned());
    let mut typed = Typed::start(&["hive/FrankaReach-v0", "--device", &device], true);
    typed.wait_for("hand ");
    let first = hand(&typed);
    (0..20).for_each(|_| typed.pause());
    assert_ne!(hand(&typed), first, "the controller is gripped and moves");
    typed.write("\u{1b}[27u");
    let (status, said) = typed.end();
    assert!(status.success(), "{said}");
    assert!(tcgetattr(&typed.slave).unwrap().local_modes.contains(LocalModes::ICANON));
}

#[test]
fn what_cannot_be_served_is_named() {
    for (arguments, says) in [
        (&["wire"][..], "--config <FILE>"),
        (&["wire", "--glove", "20"], "possible values: 18, 22"),
        (&["wire", "--ids", "1", "--model", "AX-12"], "the models are XM430-W350"),
        (&["wire", "--ids", "6-1"], "write 1-6"),
        (&["wire", "--ids", "1", "--faults", "drop=0.1,drop=0"], "the fault drop is there twice"),
        (&["wire", "--ids", "1-3,2"], "the id 2 is there twice"),
        (&["wire", "--quest", "my headset"], "no spaces"),
        (&["wire", "--ids", "1", "--seconds", "nan"], "a number of seconds"),
        (&["wire", "--quest", "1", "--link", "x", "--seconds", "0"], "no device here has one"),
    ] {
        let out = robohive(arguments);
        assert!(!out.status.success());
        assert!(text(&out.stderr).contains(says), "{arguments:?}: {}", text(&out.stderr));
    }
}
