//! Cameras: decoding, alignment, the newest frame, and what goes wrong.

use robohive_hardware::camera::{
    Cameras, Capture, Captures, Counts, Encoding, Format, Frame, Intrinsics, Registration, Request, Source,
    Streamed, Wanted, depth_to_z16, rgb_to_yuyv,
};
use robohive_hardware::{Services, Setup};
use robot::{Clock, Config, Fault};
use std::io;
use std::sync::{Arc, Mutex};
use std::time::Duration;

/// A clock that shows what it is told.
#[derive(Clone, Default)]
struct Hands(Arc<Mutex<f64>>);

impl Clock for Hands {
    fn now(&mut self) -> f64 {
        *self.0.lock().unwrap()
    }
    fn wait(&mut self, seconds: f64) {
        *self.0.lock().unwrap() += seconds;
    }
}

/// What a simulated camera does at its next frame.
#[derive(Clone)]
enum Next {
    Frame { bytes: Vec<u8>, sequence: u32, damaged: bool },
    Nothing,
    Gone,
}

/// A camera that sends what a script says, one entry for each look, the last of it again and again.
#[derive(Clone, Default)]
struct Script {
    entries: Arc<Mutex<Vec<Next>>>,
    asked: Arc<Mutex<Vec<Request>>>,
    /// Whether frames come by themselves: one at each look, then nothing until the next.
    gone: Arc<Mutex<bool>>,
}

struct Player {
    script: Script,
    format: Format,
    bytes: Vec<u8>,
}

impl Capture for Player {
    fn format(&self) -> Format {
        self.format
    }

    fn next(&mut self, _: Duration) -> io::Result<Option<Frame<'_>>> {
        let mut entries = self.script.entries.lock().unwrap();
        let next = if entries.is_empty() { Next::Nothing } else { entries.remove(0) };
        match next {
            Next::Nothing => Ok(None),
            Next::Gone => Err(io::Error::other("unplugged")),
            Next::Frame { bytes, sequence, damaged } => {
                self.bytes = bytes;
                Ok(Some(Frame { bytes: &self.bytes, sequence, time: 0.05 * f64::from(sequence), damaged }))
            }
        }
    }
}

impl Captures for Script {
    fn open(&self, _: &str, request: &Request) -> Result<Box<dyn Capture>, Fault> {
        self.asked.lock().unwrap().push(request.clone());
        if *self.gone.lock().unwrap() {
            return Err(Fault::Unreachable("no such node".to_owned()));
        }
        let format = Format {
            encoding: request.encodings[0],
            width: request.width,
            height: request.height,
            rate: request.rate,
        };
        Ok(Box::new(Player { script: self.clone(), format, bytes: Vec::new() }))
    }
}

fn frame(sequence: u32, bytes: Vec<u8>) -> Next {
    Next::Frame { bytes, sequence, damaged: false }
}

/// The camera of a config on a script, and the time.
fn connect(interface: &str, cam: &str, script: &Script) -> (Result<Cameras, String>, Hands) {
    let text = format!("[[device]]\nname = 'front'\ninterface = {{ {interface} }}\ncam = [{cam}]");
    let config = Config::from_toml(&text, "eyes.toml").unwrap();
    let hands = Hands::default();
    let clock = hands.clone();
    let setup = Setup::default()
        .in_virtual_time(
            Arc::new(move || Box::new(clock.clone())),
            Services::default(),
            Arc::new(|_, _| Err(io::ErrorKind::NotFound.into())),
        )
        .with_captures(Arc::new(script.clone()));
    (Cameras::connect(&config, &setup).map_err(|error| error.to_string()), hands)
}

const RGB: &str = "{ name = 'colours', range = [0, 255], hdr_id = 'rgb' },";
const DEPTH: &str = "{ name = 'depth', range = [0.2, 4], hdr_id = 'd', scale = 2, offset = 0.5 },";

fn rgb(cameras: &mut Cameras, size: [usize; 2]) -> Result<Vec<u8>, String> {
    let mut rgb = Vec::new();
    let wanted = Wanted { rgb: Some(&mut rgb), depth: None };
    cameras.take("front", size, wanted).map_err(|error| error.to_string())?;
    Ok(rgb)
}

#[test]
fn colours_come_out_as_bt601_says() {
    let script = Script::default();
    // White, black, red and blue of ITU-R BT.601, two pixels each.
    let colours = [[235, 128, 235, 128], [16, 128, 16, 128], [81, 90, 81, 240], [41, 240, 41, 110]];
    let bytes: Vec<u8> = std::iter::repeat_n(colours.concat(), 32).flatten().collect();
    script.entries.lock().unwrap().push(frame(0, bytes.clone()));
    let small = "type = 'camera', name = '/dev/video0', width = 16, height = 16, warm_up = 0";
    let (cameras, _) = connect(small, RGB, &script);
    let mut cameras = cameras.unwrap();
    let seen = rgb(&mut cameras, [16, 16]).unwrap();
    let expected = [[255, 255, 255], [0, 0, 0], [255, 0, 0], [0, 0, 255]];
    for (pixel, colour) in seen.chunks_exact(3).enumerate() {
        let off = colour.iter().zip(expected[pixel / 2 % 4]).map(|(a, b)| a.abs_diff(b)).max();
        assert!(off <= Some(1), "pixel {pixel}: {colour:?}");
    }
    // A quarter of the size is the mean of what is covered: white, black, red and blue in each block.
    let mean = rgb(&mut cameras, [4, 2]).unwrap();
    assert!(mean.chunks_exact(3).all(|colour| colour[0].abs_diff(128) <= 1 && colour[1].abs_diff(64) <= 1));

    // The other way round what two pixels share is their colour, not their brightness.
    let mut again = Vec::new();
    rgb_to_yuyv(&seen, &mut again);
    let off = again.iter().zip(&bytes).map(|(a, b)| a.abs_diff(*b)).max();
    assert!(off <= Some(1), "{off:?}");
}

#[test]
fn jpeg_frames_come_out_with_and_without_their_tables() {
    // 32 x 16 pixels with red from left to right, green from top to bottom and blue from right to left, by Pillow 12.
    let picture = include_bytes!("data/frame.jpg");
    // Cameras leave the segments with Huffman tables out (UVC 1.5, payload of MJPEG).
    let mut bare = picture[..2].to_vec();
    let mut at = 2;
    while picture[at + 1] != 0xda {
        let end = at + 2 + usize::from(u16::from_be_bytes([picture[at + 2], picture[at + 3]]));
        if picture[at + 1] != 0xc4 {
            bare.extend(&picture[at..end]);
        }
        at = end;
    }
    bare.extend(&picture[at..]);
    assert!(bare.len() < picture.len() - 400);
    let camera =
        "type = 'camera', name = '/dev/video0', format = 'mjpg', width = 32, height = 16, warm_up = 0";
    for bytes in [picture.to_vec(), bare] {
        let script = Script::default();
        script.entries.lock().unwrap().push(frame(0, bytes));
        let seen = rgb(&mut connect(camera, RGB, &script).0.unwrap(), [16, 32]).unwrap();
        // What Pillow decodes at the corners and in the middle.
        let places = [(0, 0), (31, 0), (16, 8), (0, 15), (31, 15)];
        let pillow = [[4, 0, 247], [242, 2, 15], [127, 128, 123], [5, 239, 248], [244, 241, 14]];
        for ((x, y), colour) in places.into_iter().zip(pillow) {
            let pixel = &seen[3 * (32 * y + x)..][..3];
            let off = pixel.iter().zip(colour).map(|(a, b)| a.abs_diff(b)).max();
            assert!(off <= Some(3), "({x}, {y}): {pixel:?} instead of {colour:?}");
        }
    }
    // Half a picture, another size, and no picture: an error each, and no panic.
    for (bytes, said) in [(picture[..80].to_vec(), "damaged"), (vec![0; 100], "damaged")] {
        let script = Script::default();
        script.entries.lock().unwrap().push(frame(0, bytes));
        let error = rgb(&mut connect(camera, RGB, &script).0.unwrap(), [16, 32]).unwrap_err();
        assert!(error.contains("camera 'front'") && error.contains(said), "{error}");
    }
    let script = Script::default();
    script.entries.lock().unwrap().push(frame(0, picture.to_vec()));
    let other = camera.replace("width = 32", "width = 64");
    let error = rgb(&mut connect(&other, RGB, &script).0.unwrap(), [16, 32]).unwrap_err();
    assert!(error.contains("32 x 16 pixels instead of 64 x 16"), "{error}");
}

#[test]
fn depth_comes_out_in_metres_as_the_config_corrects_it() {
    let script = Script::default();
    let mut bytes = Vec::new();
    let depths: Vec<f32> = (0..256).map(|k| if k % 16 < 8 { 1.0 } else { 0.0 }).collect();
    depth_to_z16(&depths, 0.0001, &mut bytes);
    assert_eq!(bytes[..2], 10_000u16.to_le_bytes());
    script.entries.lock().unwrap().push(frame(0, bytes));
    let camera =
        "type = 'realsense', serial = '12', width = 16, height = 16, warm_up = 0, depth_unit = 0.0001";
    let mut cameras = connect(camera, DEPTH, &script).0.unwrap();
    let mut depth = Vec::new();
    let wanted = Wanted { rgb: None, depth: Some(&mut depth) };
    cameras.take("front", [8, 8], wanted).unwrap();
    // 1 m times 2 plus 0.5; where there is no depth there is none.
    for (pixel, depth) in depth.iter().enumerate() {
        assert_eq!(*depth, if pixel % 8 < 4 { 2.5 } else { 0.0 }, "{pixel}");
    }
    let error = rgb(&mut cameras, [8, 8]).unwrap_err();
    assert!(error.contains("no entry with hdr_id 'rgb'"), "{error}");
}

#[test]
fn alignment_shows_what_the_other_imager_sees() {
    // Two imagers of 90 degrees, the second 0.1 m to the right of the first: what is 1 m away moves by half of 0.1 * 40
    // pixels to the left, and what is 0.5 m away by twice that.
    let imager = Intrinsics { size: [80, 60], focal: [40.0, 40.0], centre: [39.5, 29.5] };
    let registration = Registration {
        from: imager,
        to: imager,
        rotation: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
        translation: [-0.1, 0.0, 0.0],
    };
    let far_but_box = |left: usize, right: usize| -> Vec<f32> {
        let near = |pixel: usize| (left..right).contains(&(pixel % 80)) && (20..40).contains(&(pixel / 80));
        (0..80 * 60).map(|pixel| if near(pixel) { 0.5 } else { 1.0 }).collect()
    };
    let mut aligned = Vec::new();
    registration.align(&far_but_box(40, 50), [60, 80], &mut aligned);
    let expected = far_but_box(32, 42);
    for (pixel, (seen, expected)) in aligned.iter().zip(expected).enumerate() {
        // What the first imager does not see: the strip at the right edge, and what the box hides from it.
        let hidden =
            pixel % 80 >= 76 || ((42..46).contains(&(pixel % 80)) && (20..40).contains(&(pixel / 80)));
        assert_eq!(*seen, if hidden { 0.0 } else { expected }, "({}, {})", pixel % 80, pixel / 80);
    }

    // What is all but in the second imager's plane would cover the whole image, and is left out.
    let near = Registration { translation: [0.0, 0.0, -0.999], ..registration };
    near.align(&[1.0; 80 * 60], [60, 80], &mut aligned);
    assert!(aligned.iter().all(|depth| *depth == 0.0));

    // A wider imager with twice the pixels has no holes.
    let to = Intrinsics { size: [160, 120], focal: [80.0, 80.0], centre: [79.5, 59.5] };
    let wider = Registration { to, translation: [0.0; 3], ..registration };
    wider.align(&[2.0; 80 * 60], [60, 80], &mut aligned);
    assert!(aligned.len() == 160 * 120 && aligned.iter().all(|depth| *depth == 2.0));
}

#[test]
fn the_newest_frame_counts_and_old_ones_are_none() {
    let script = Script::default();
    let grey = |brightness: u8| [brightness, 128].repeat(256);
    let camera = "type = 'camera', name = '/dev/video0', width = 16, height = 16, warm_up = 1, rate = 20";
    *script.entries.lock().unwrap() = vec![frame(7, grey(235)), frame(8, grey(235))];
    let (cameras, mut hands) = connect(camera, RGB, &script);
    let mut cameras = cameras.unwrap();
    let damaged = Next::Frame { bytes: Vec::new(), sequence: 15, damaged: true };
    *script.entries.lock().unwrap() =
        vec![frame(9, grey(235)), frame(13, grey(16)), frame(14, grey(126)), damaged];
    assert_eq!(rgb(&mut cameras, [1, 1]).unwrap(), [128; 3]);
    let Streamed { camera, which, format, counts } = cameras.streams().next().unwrap();
    assert_eq!((camera, which, format.width, format.rate), ("front", "rgb", 16, 20.0));
    assert_eq!(
        counts,
        Counts { frames: 6, dropped: 3, damaged: 1, reopened: 0, longest: 0.05 * 13.0 - 0.05 * 9.0 }
    );
    // Three periods later it is no observation any more.
    hands.wait(0.14);
    assert_eq!(rgb(&mut cameras, [1, 1]).unwrap(), [128; 3]);
    hands.wait(0.02);
    let error = rgb(&mut cameras, [1, 1]).unwrap_err();
    assert_eq!(error, "camera 'front': its newest reading is 160 ms old");

    // Unplugged, still away, and back.
    *script.entries.lock().unwrap() = vec![frame(16, grey(235)), Next::Gone];
    *script.gone.lock().unwrap() = true;
    let error = rgb(&mut cameras, [1, 1]).unwrap_err();
    assert!(error.contains("unplugged"), "{error}");
    hands.wait(1.1);
    let error = rgb(&mut cameras, [1, 1]).unwrap_err();
    assert!(error.contains("no such node"), "{error}");
    *script.gone.lock().unwrap() = false;
    *script.entries.lock().unwrap() = vec![frame(0, grey(235))];
    hands.wait(1.1);
    assert!(rgb(&mut cameras, [1, 1]).is_err());
    assert_eq!(rgb(&mut cameras, [1, 1]).unwrap(), [255; 3]);
    assert_eq!(cameras.streams().next().unwrap().counts.reopened, 1);

    // A frame with bytes missing is an error, and no other camera has the name.
    *script.entries.lock().unwrap() = vec![frame(1, vec![0; 100])];
    let error = rgb(&mut cameras, [1, 1]).unwrap_err();
    assert!(error.contains("100 bytes instead of 512"), "{error}");
    let error = cameras.take("back", [1, 1], Wanted::default()).unwrap_err().to_string();
    assert!(error.contains("camera 'back'") && error.contains("its cameras are: front"), "{error}");
}

#[test]
fn configs_of_the_original_say_which_camera_it_is() {
    let script = Script::default();
    let topics = "type = 'realsense', rgb_topic = 'realsense_815412070228/color/image_raw', \
                  d_topic = 'realsense_815412070228/depth_uncolored/image_raw', warm_up = 0, width = 16, height = 16";
    let z16 = vec![1; 512];
    *script.entries.lock().unwrap() = vec![frame(0, z16.clone()), frame(0, z16)];
    let _ = connect(topics, &[RGB, DEPTH].concat(), &script).0;
    let asked = script.asked.lock().unwrap();
    let serial = Source::RealSense(Some("815412070228".to_owned()));
    assert_eq!((asked[0].source.clone(), &asked[0].encodings[..]), (serial.clone(), &Encoding::COLOURS[..]));
    assert_eq!((asked[1].source.clone(), &asked[1].encodings[..]), (serial, &[Encoding::Z16][..]));
}

#[test]
fn bad_configs_say_what_to_write() {
    let camera = "type = 'camera', name = '/dev/video0'";
    let real = "type = 'realsense'";
    let thrice = "{ name = 'a', range = [0, 1], hdr_id = 3 },";
    let scaled = "{ name = 'a', range = [0, 1], hdr_id = 'rgb', scale = 2 },";
    for (interface, cam, said) in [
        ("type = 'camera'", RGB, "needs a 'name'"),
        (camera, "", "has no entry"),
        (camera, thrice, "must be 'rgb' or 'd'"),
        (camera, scaled, "must be 1"),
        (camera, &[RGB, RGB].concat(), "two entries"),
        (camera, DEPTH, "has no depth"),
        (&format!("{camera}, width = 33"), RGB, "even"),
        (&format!("{camera}, rate = 0"), RGB, "from 1 to 300"),
        (&format!("{camera}, format = 'h264'"), RGB, "auto, yuyv, uyvy, mjpg"),
        (&format!("{camera}, serial = '3'"), RGB, "not known"),
        (&format!("{real}, rgb_intrinsics = [1, 1, 0, 0]"), DEPTH, "both"),
        (&format!("{real}, rgb_intrinsics = [1, 1, 0]"), DEPTH, "4 finite numbers"),
        (
            &format!("{real}, rgb_intrinsics = [0, 1, 0, 0], depth_intrinsics = [1, 1, 0, 0]"),
            DEPTH,
            "positive",
        ),
        (
            &format!(
                "{real}, rgb_intrinsics = [1, 1, 0, 0], depth_intrinsics = [1, 1, 0, 0], \
                 depth_to_rgb = [2, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0]"
            ),
            DEPTH,
            "must be a rotation matrix",
        ),
        // Nothing is wrong, and no frame comes.
        (camera, RGB, "0 frames came in 5 s"),
    ] {
        let error = connect(interface, cam, &Script::default()).0.err().unwrap();
        assert!(error.starts_with("camera 'front': ") && error.contains(said), "{said}: {error}");
    }
}

#[test]
fn nodes_that_are_no_cameras_are_refused_by_name() {
    let config = |path: &std::path::Path| {
        let text = format!(
            "[[device]]\nname = 'front'\ninterface = {{ type = 'camera', name = '{}' }}\ncam = [{RGB}]",
            path.display()
        );
        Config::from_toml(&text, "eyes.toml").unwrap()
    };
    let connect = |path| Cameras::connect(&config(path), &Setup::default()).err().unwrap().to_string();
    let missing = connect(std::path::Path::new("/dev/video-none"));
    assert!(missing.contains("/dev/video-none") && missing.contains("hardware list"), "{missing}");
    let other = connect(std::path::Path::new("/dev/null"));
    assert!(other.contains("camera 'front'") && other.contains("/dev/null"), "{other}");
}
