//! Frames of NatNet, against the crate natnet: what it writes is read here, what is written here it reads.

use natnet::{Decoder, Message, PlannedBody, SyntheticServer, Version};
use protocol::optitrack::Body;
use protocol::optitrack::natnet::{Bitstream, Frame, ServerInfo, connect, message, open};

const BITSTREAMS: [(Bitstream, Version); 2] =
    [(Bitstream::V3, Version::new(3, 0, 0, 0)), (Bitstream::V41, Version::V4_1)];

#[test]
fn frames_of_another_writer_are_read() {
    for (bitstream, version) in BITSTREAMS {
        let server = SyntheticServer::new(version, 10_000_000);
        let seen = PlannedBody {
            mean_marker_error: 0.25,
            ..PlannedBody::tracked(7, [1.0, 2.5, -3.0], [0.5, -0.5, 0.5, 0.5])
        };
        let lost =
            PlannedBody { tracking_valid: false, ..PlannedBody::tracked(9, [0.0; 3], [0.0, 0.0, 0.0, 1.0]) };
        let datagram = server.datagram(42, 0.5, &[seen, lost]).unwrap();
        let (what, content) = open(&datagram).unwrap();
        assert_eq!(what, message::FRAME);
        let frame = Frame::decode(content, bitstream).unwrap();
        assert_eq!((frame.number, frame.timestamp, frame.bodies.len()), (42, 0.5, 2));
        let body = Body {
            id: 7,
            position: [1.0, 2.5, -3.0],
            orientation: [0.5, 0.5, -0.5, 0.5],
            error: 0.25,
            tracked: true,
        };
        assert_eq!(frame.bodies[0], body);
        assert!(!frame.bodies[1].tracked);
    }
}

#[test]
fn another_reader_understands_our_frames() {
    for (bitstream, version) in BITSTREAMS {
        let body = Body {
            id: 3,
            position: [0.5, -1.5, 2.0],
            orientation: [0.5, 0.5, -0.5, -0.5],
            error: 0.125,
            tracked: true,
        };
        let frame = Frame { number: 11, timestamp: 2.25, bodies: vec![body] };
        let datagram = protocol::optitrack::natnet::message(message::FRAME, &frame.encode(bitstream));
        let decoded = Decoder::new(version).unwrap().parse(&datagram).unwrap();
        let Message::FrameOfData(read) = decoded.message() else { panic!("a frame") };
        assert_eq!((read.frame_number, read.rigid_bodies.len()), (11, 1));
        let body = &read.rigid_bodies[0];
        assert_eq!((body.id, body.position, body.orientation), (3, [0.5, -1.5, 2.0], [0.5, -0.5, -0.5, 0.5]));
        assert_eq!((body.mean_marker_error, body.params & 1), (0.125, 1));
    }
}

#[test]
fn another_reader_understands_what_our_server_says_of_itself() {
    let info = ServerInfo {
        version: Bitstream::V41.version(),
        clock: 10_000_000,
        data_port: 1511,
        group: Some([239, 255, 42, 99]),
    };
    let datagram = protocol::optitrack::natnet::message(message::SERVER_INFO, &info.encode());
    let decoded = Decoder::new(Version::V4_1).unwrap().parse(&datagram).unwrap();
    let Message::ServerInfo(read) = decoded.message() else { panic!("a server's description") };
    assert_eq!(read.protocol_version, Version::V4_1);
    assert_eq!(connect(Bitstream::V41).len(), 270);
}
