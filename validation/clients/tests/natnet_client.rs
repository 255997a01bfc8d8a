//! The client of the crate natnet, which other people wrote, connects to the simulated tracker and reads its frames.
#![cfg(unix)]

use natnet::net::CommandClient;
use natnet::{Decoder, Message};
use robot::Config;
use std::net::{Ipv4Addr, SocketAddrV4, UdpSocket};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex};
use std::time::Duration;
use wire::optitrack::Tracker;
use wire::{Bench, Carries, End, Plant, serve};

const BODY: &str =
    "<mujoco><option gravity='0 0 0'/><worldbody><body name='torso' pos='.5 -.25 1'><freejoint/>
    <geom size='.1'/></body></worldbody>
  <sensor><framepos name='where' objtype='xbody' objname='torso'/></sensor></mujoco>";

#[test]
fn natnet_connects_and_reads_the_pose() {
    let plant = Plant::new(mjcf::load_str(BODY).unwrap().model).unwrap();
    let config = Config::from_toml(
        "[[device]]
         name = 'torso'
         interface = { type = 'optitrack', protocol = 'natnet', id = 5 }
         sensor = [{ name = 'where[0]', range = [-1, 1], hdr_id = 'x' }]",
        "torso.toml",
    )
    .unwrap();
    let tracker = Tracker::of(&config.devices[0], &plant).unwrap();
    let mut bench = Bench::new(plant);
    let [frames, requests] = bench.connect_all(Box::new(tracker), [Carries::Datagrams; 2]);
    let here = |port| (Ipv4Addr::LOCALHOST, port).into();
    let receiver = UdpSocket::bind((Ipv4Addr::LOCALHOST, 0)).unwrap();
    receiver.set_read_timeout(Some(Duration::from_secs(10))).unwrap();
    let port = receiver.local_addr().unwrap().port();
    let mut ends = vec![
        (frames, End::udp(here(0), Some(here(port))).unwrap()),
        (requests, End::udp(here(0), None).unwrap()),
    ];
    let address: SocketAddrV4 = ends[1].1.address().parse().unwrap();
    let (bench, stop) = (Arc::new(Mutex::new(bench)), Arc::new(AtomicBool::new(false)));
    let serving = {
        let stop = stop.clone();
        std::thread::spawn(move || serve(&bench, &mut ends, &stop))
    };
    let mut client = CommandClient::bind(Ipv4Addr::LOCALHOST, address).unwrap();
    let info = client.connect_handshake(Duration::from_secs(10)).unwrap();
    let decoder = Decoder::new(info.protocol_version).unwrap();
    let mut buffer = vec![0; 65_536];
    let (mut before, mut seen) = (0, 0);
    while seen < 20 {
        let (count, _) = receiver.recv_from(&mut buffer).unwrap();
        let decoded = decoder.parse(&buffer[..count]).unwrap();
        let Message::FrameOfData(frame) = decoded.message() else { continue };
        let body = &frame.rigid_bodies[0];
        assert_eq!((body.id, body.position, body.orientation), (5, [0.5, -0.25, 1.0], [0.0, 0.0, 0.0, 1.0]));
        assert!(frame.frame_number > before);
        before = frame.frame_number;
        seen += 1;
    }
    stop.store(true, Ordering::Relaxed);
    serving.join().unwrap().unwrap();
}
