//! A scripted page that drives an arm over a WebSocket.

#![cfg(unix)]

mod command;
mod phoning;
mod typing;

use command::{robohive, scratch, text};
use phoning::{Page, assert_recorded, status};
use rustix::termios::{LocalModes, tcgetattr};
use std::net::TcpStream;
use tungstenite::connect;
use typing::Typed;

const ID: &str = "hive/FrankaReach-v0";

fn ask(address: &str, path: &str, host: &str) -> String {
    status(&mut TcpStream::connect(address).unwrap(), path, host).unwrap()
}

#[test]
fn openxr_says_what_to_run_and_is_reached_with_the_key() {
    let mut typed = Typed::start(&[ID, "--device", "openxr:0"], true);
    let all = typed.all();
    assert!(all.contains("the OpenXR headset drives hive/FrankaReach-v0"), "{all}");
    let (_, after) = all.split_once("run `python -m robohive.openxr http://").unwrap();
    let (place, _) = after.split_once('`').unwrap();
    let (socket, _) = connect(format!("ws://{place}/socket")).unwrap();
    let mut bridge = Page::new(socket);
    bridge.hold("\"RG\"", 20);
    typed.write("\u{1b}[27u");
    let (status, said) = typed.end();
    assert!(status.success(), "{said}");
}

#[test]
fn a_page_with_the_key_drives_and_others_are_refused() {
    let file = scratch("phone.h5");
    let mut typed = Typed::start(&[ID, "--device", "phone:0", "--record", file.to_str().unwrap()], true);
    let all = typed.all();
    let (_, after) = all.split_once("open http://").unwrap();
    let (place, _) = after.split_once(' ').unwrap();
    let (address, key) = place.split_once('/').unwrap();
    assert_eq!(key.len(), 32);
    assert!(ask(address, &format!("/{key}"), address).contains("200"));
    assert!(ask(address, "/", address).contains("403"));
    assert!(ask(address, &format!("/{key}"), "evil.example").contains("403"));
    assert!(connect(format!("ws://{address}/{}/socket", "0".repeat(32))).is_err());
    let (socket, _) = connect(format!("ws://{address}/{key}/socket")).unwrap();
    let mut page = Page::new(socket);
    page.hold("\"RG\"", 60);
    // A page that says nothing moves nothing, and the session goes on.
    typed.pause();
    assert!(typed.line().starts_with("episode 1  seed 0"), "{}", typed.line());
    page.hold("\"A\"", 10);
    typed.wait_for("episode 2  seed 1");
    typed.write("\u{1b}[27u");
    let (status, said) = typed.end();
    assert!(status.success() && said.contains("1 episodes kept, 1 succeeded"), "{said}");
    assert!(tcgetattr(&typed.slave).unwrap().local_modes.contains(LocalModes::ICANON));
    assert_recorded(&file);
    let out = robohive(&["teleop", ID, "--device", "phone:x"]);
    assert!(text(&out.stderr).contains("is not a port"), "{}", text(&out.stderr));
}
