//! A scripted page that drives an arm over a WebSocket.

#![cfg(unix)]

mod command;
mod typing;

use command::{robohive, scratch, text};
use dataset::trace::TraceReader;
use record::Recorded;
use rustix::termios::{LocalModes, tcgetattr};
use std::io::{Read, Write};
use std::net::TcpStream;
use std::time::{Duration, Instant};
use tungstenite::{Message, connect};
use typing::Typed;

const ID: &str = "hive/FrankaReach-v0";

/// The status line of an answer.
fn status(address: &str, path: &str, host: &str) -> String {
    let mut stream = TcpStream::connect(address).unwrap();
    write!(stream, "GET {path} HTTP/1.1\r\nHost: {host}\r\n\r\n").unwrap();
    let mut answer = String::new();
    stream.read_to_string(&mut answer).unwrap();
    answer.lines().next().unwrap_or_default().to_owned()
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
    assert!(status(address, &format!("/{key}"), address).contains("200"));
    assert!(status(address, "/", address).contains("403"));
    assert!(status(address, &format!("/{key}"), "evil.example").contains("403"));
    assert!(connect(format!("ws://{address}/{}/socket", "0".repeat(32))).is_err());
    let (mut socket, _) = connect(format!("ws://{address}/{key}/socket")).unwrap();
    let began = Instant::now();
    let mut say = |k: u32, buttons: &str| {
        let time = began.elapsed().as_secs_f64();
        let text = format!(
            "{{\"seq\":{k},\"time\":{time},\"pose\":[0,{},0,0,0,0,1],\"tracked\":true,\"buttons\":[{buttons}]}}",
            -0.1 * time
        );
        socket.send(Message::text(text)).unwrap();
        std::thread::sleep(Duration::from_millis(17));
    };
    (0..60).for_each(|k| say(k, "\"RG\""));
    // A page that says nothing moves nothing, and the session goes on.
    typed.pause();
    assert!(typed.line().starts_with("episode 1  seed 0"), "{}", typed.line());
    (60..70).for_each(|k| say(k, "\"A\""));
    typed.wait_for("episode 2  seed 1");
    typed.write("\u{1b}[27u");
    let (status, said) = typed.end();
    assert!(status.success() && said.contains("1 episodes kept, 1 succeeded"), "{said}");
    assert!(tcgetattr(&typed.slave).unwrap().local_modes.contains(LocalModes::ICANON));
    let recorded = Recorded::read(&TraceReader::open(&file).unwrap(), "Trial0").unwrap();
    assert!(recorded.actions.row(2).is_some());
    let out = robohive(&["teleop", ID, "--device", "phone:x"]);
    assert!(text(&out.stderr).contains("is not a port"), "{}", text(&out.stderr));
}
