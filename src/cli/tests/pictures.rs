//! Pictures and videos: what files hold, and what is said of wrong requests.

mod command;

use command::{command, robohive, scratch, text};
use dataset::{Array, Values};
use std::collections::BTreeSet;
use std::path::Path;

const REACH: &str = "hive/FrankaReach-v0";
const ARM: &str = "assets/franka/franka_table.xml";

/// Runs a command that must succeed; what it prints.
fn done(arguments: &[&str]) -> String {
    let out = robohive(arguments);
    assert!(out.status.success(), "{arguments:?}: {}", text(&out.stderr));
    text(&out.stdout)
}

/// Runs a command that must be refused as wrong; what it complains of.
fn refused(arguments: &[&str]) -> String {
    let out = robohive(arguments);
    assert_eq!(out.status.code(), Some(2), "{arguments:?}: {}", text(&out.stderr));
    text(&out.stderr)
}

/// A path for a picture, without an older one.
fn fresh(name: &str) -> String {
    let path = scratch(name);
    _ = std::fs::remove_file(&path);
    path.to_str().unwrap().to_owned()
}

/// Size, bytes of a pixel, and bytes of a PNG.
fn decode(path: &str) -> ((u32, u32), usize, Vec<u8>) {
    let file = std::io::BufReader::new(std::fs::File::open(path).unwrap());
    let mut reader = png::Decoder::new(file).read_info().unwrap();
    let mut bytes = vec![0; reader.output_buffer_size().unwrap()];
    let frame = reader.next_frame(&mut bytes).unwrap();
    (reader.info().size(), frame.color_type.samples() * frame.bit_depth as usize / 8, bytes)
}

fn colours(path: &str) -> usize {
    let (_, 3, bytes) = decode(path) else { panic!("{path} is not in colour") };
    bytes.as_chunks::<3>().0.iter().collect::<BTreeSet<_>>().len()
}

fn numbers(path: &str) -> Array {
    Array::decode(&std::fs::read(path).unwrap()).unwrap()
}

#[test]
fn a_model_and_an_environment_are_drawn_in_many_colours() {
    let (model, env, again) = (fresh("arm.png"), fresh("reach.png"), fresh("again.png"));
    let said = done(&["render", ARM, "--camera", "front", "--size", "96x64", "--out", &model]);
    assert!(said.contains("arm.png") && said.contains("96x64") && said.contains("front"), "{said}");
    assert_eq!(decode(&model).0, (96, 64));
    assert!(colours(&model) > 100, "{} colours", colours(&model));
    done(&["render", REACH, "--seed", "3", "--size", "64", "--out", &env]);
    assert_eq!(decode(&env).0, (64, 64));
    assert!(colours(&env) > 100, "{} colours", colours(&env));
    done(&["render", REACH, "--seed", "3", "--size", "64", "--out", &again]);
    assert_eq!(decode(&env), decode(&again), "a seed has one picture");
    done(&["render", REACH, "--seed", "4", "--size", "64", "--out", &again]);
    assert_ne!(decode(&env), decode(&again), "another seed has another target");
}

/// A ball of radius 0.1 m above a floor, seen straight from above at 2 m.
fn ball() -> String {
    let path = scratch("ball.xml");
    let world = "<geom name='floor' type='plane' size='3 3 .1'/><camera name='above' pos='0 0 2'/>
        <body pos='0 0 1'><freejoint/><geom name='ball' size='.1' rgba='1 0 0 1'/></body>";
    std::fs::write(&path, format!("<mujoco><worldbody>{world}</worldbody></mujoco>")).unwrap();
    path.to_str().unwrap().to_owned()
}

#[test]
fn depth_is_in_metres_or_millimetres() {
    let ball = ball();
    let (npy, png, seen) = (fresh("depth.npy"), fresh("depth.png"), fresh("depth_colours.png"));
    let view = ["--camera", "above", "--size", "33x21", "--out"];
    done(&[&["render", &ball, "--depth"], &view[..], &[&npy]].concat());
    let Array { shape, values: Values::F32(depth) } = numbers(&npy) else { panic!("not float32") };
    assert_eq!(shape, [21, 33]);
    let (middle, corner) = (depth[10 * 33 + 16], depth[0]);
    assert!((middle - 0.9).abs() < 1e-3, "the ball's top is {middle} m away");
    assert!((corner - 2.0).abs() < 1e-3, "the floor is {corner} m away");

    done(&[&["render", &ball, "--depth"], &view[..], &[&png]].concat());
    let (size, 2, bytes) = decode(&png) else { panic!("not 16 bits of grey") };
    let millimetres: Vec<u16> = bytes.as_chunks().0.iter().map(|&pair| u16::from_be_bytes(pair)).collect();
    assert_eq!((size, millimetres[0]), ((33, 21), 2000));
    for (metres, millimetres) in depth.iter().zip(&millimetres) {
        assert!((1000.0 * metres - f32::from(*millimetres)).abs() <= 0.51);
    }
    done(&[&["render", &ball, "--depth=colours"], &view[..], &[&seen]].concat());
    assert!(colours(&seen) > 3);
}

#[test]
fn segmentation_has_the_numbers_of_geoms() {
    let ball = ball();
    let (npy, png) = (fresh("parts.npy"), fresh("parts.png"));
    let view = ["--camera", "above", "--size", "31", "--segmentation", "--out"];
    done(&[&["render", &ball], &view[..], &[&npy]].concat());
    let Array { shape, values: Values::I32(ids) } = numbers(&npy) else { panic!("not int32") };
    assert_eq!(shape, [31, 31, 2]);
    let (middle, corner) = (&ids[2 * (15 * 31 + 15)..][..2], &ids[..2]);
    assert_eq!((middle, corner), (&[1, 5][..], &[0, 5][..]), "geoms are objects of type 5");
    done(&[&["render", &ball], &view[..], &[&png]].concat());
    assert_eq!(colours(&png), 2);
}

#[test]
fn what_is_shown_changes_the_picture() {
    let ball = ball();
    let picture = |name: &str, options: &[&str]| {
        let path = fresh(name);
        done(&[&["render", &ball, "--size", "64x48", "--out", &path], options].concat());
        decode(&path).2
    };
    let plain = picture("plain.png", &[]);
    let moved = "--qpos=0.3,0,0.5,1,0,0,0";
    let asked: [&[&str]; 10] = [
        &["--samples", "1"],
        &["--hide", "static"],
        &["--show", "world-frame,cameras"],
        &["--label", "geoms"],
        &["--label", "bodies"],
        &["--groups", "3"],
        &["--azimuth", "-30", "--elevation=-70"],
        &["--lookat", "-1,0,0.5", "--distance", "2"],
        &["--camera", "0"],
        &[moved],
    ];
    let pictures: BTreeSet<_> =
        asked.iter().enumerate().map(|(i, options)| picture(&format!("shown{i}.png"), options)).collect();
    assert!(pictures.len() == asked.len() && !pictures.contains(&plain));
    assert_eq!(picture("hidden.png", &["--hide", "shadows"]), picture("bare.png", &["--no-shadows"]));
}

#[test]
fn wrong_requests_say_what_is_right() {
    let out = fresh("never.png");
    let render = |arguments: &[&str]| refused(&[&["render"], arguments, &["--out", &out]].concat());
    let error = render(&[ARM, "--camera", "frond"]);
    assert!(error.contains("did you mean front") && error.contains("free"), "{error}");
    assert!(render(&[ARM, "--camera", "9"]).contains("front"));
    for size in ["0x10", "5000x5", "10x", "many"] {
        assert!(render(&[ARM, "--size", size]).contains("1 to 4096"), "{size}");
    }
    assert!(render(&["hive/FrankaReach-v1"]).contains("hive/FrankaReach-v0"));
    assert!(render(&[ARM, "--camera", "front", "--distance", "1"]).contains("--camera free"));
    assert!(render(&[ARM, "--distance", "0"]).contains("more than 0"));
    assert!(render(&[ARM, "--lookat", "1,2"]).contains("three numbers"));
    assert!(render(&[ARM, "--qpos", "1,2"]).contains("--qpos has 2 numbers"));
    assert!(render(&[ARM, "--seed", "1"]).contains("--seed is for environments"));
    assert!(render(&[REACH, "--keyframe", "ready"]).contains("--keyframe is for models"));
    assert!(render(&[ARM, "--show", "frames,world-frame"]).contains("one kind of frames"));
    assert!(render(&[ARM, "--show", "ghosts"]).contains("contacts"));
    assert!(render(&["door-v1"]).contains("robohive assets import"));
    assert!(refused(&["render", ARM, "--out", "x.jpg"]).contains(".png or .npy"));
    assert!(refused(&["render", ARM]).contains("--out FILE.png"), "a pipe shows no picture");
    assert!(refused(&["run", REACH, "--fps", "5"]).contains("--video"));
    assert!(refused(&["run", REACH, "--video", "x.avi"]).contains(".mp4, .gif or .png"));
    assert!(refused(&["run", REACH, "--preview"]).contains("--video FILE.mp4"));
    assert!(refused(&["run", REACH, "--video", &out, "--fps", "0"]).contains("frames a second"));
    assert!(refused(&["run", REACH, "--renderer", "cpu"]).contains("--video"));
    assert!(
        refused(&["rollout", REACH, "--actions", "x.npz", "--out", "o.npz", "--renderer", "cpu"])
            .contains("--visual")
    );
    assert!(refused(&["render", ARM, "--out", &out, "--renderer", "cuda"]).contains("gpu:NAME"));
    #[cfg(not(feature = "gpu"))]
    for command in [&["render", ARM][..], &["gallery", "hive"]] {
        let said = refused(&[command, &["--out", &out, "--renderer", "gpu"]].concat());
        assert!(said.contains("cargo install --path src/cli --features gpu"), "{said}");
    }
    assert!(refused(&["gallery", "no_such_suite", "--out", &out]).contains("robohive list"));
    assert!(!Path::new(&out).exists());
}

#[test]
fn a_chosen_protocol_sends_the_picture_to_a_pipe() {
    let blocks = done(&["render", ARM, "--size", "40x20", "--preview=blocks"]);
    assert_eq!(blocks.matches('▀').count(), 400);
    assert!(done(&["render", ARM, "--size", "8", "--preview=kitty"]).starts_with("\u{1b}_G"));
}

/// Frames of a video: of an MP4 from its table of sample sizes, of the others from their decoders.
fn frames(path: &str) -> usize {
    let bytes = std::fs::read(path).unwrap();
    if path.ends_with(".gif") {
        let mut decoder = gif::DecodeOptions::new().read_info(&bytes[..]).unwrap();
        return std::iter::from_fn(|| decoder.read_next_frame().unwrap().map(|_| ())).count();
    }
    if path.ends_with(".png") {
        let reader = png::Decoder::new(std::io::Cursor::new(bytes)).read_info().unwrap();
        return reader.info().animation_control().unwrap().num_frames as usize;
    }
    let table = bytes.windows(4).position(|name| name == b"stsz").unwrap();
    let count = bytes[table + 12..table + 16].try_into().unwrap();
    u32::from_be_bytes(count) as usize
}

/// An episode of five steps of 0.04 s shows six states; a second episode adds its own.
#[test]
fn a_video_has_the_frames_of_its_episodes() {
    let steps = ["--set", "max_episode_steps=5", "--size", "64x48", "-q"];
    let period = {
        let info: serde_json::Value = serde_json::from_str(&done(&["info", REACH, "--json"])).unwrap();
        info["dt"].as_f64().unwrap()
    };
    for name in ["reach.mp4", "reach.gif", "reach_film.png"] {
        let path = fresh(name);
        let fps = (1.0 / period).to_string();
        let run = ["run", REACH, "--episodes", "2", "--video", &path, "--fps", &fps];
        let said = done(&[&run[..], &steps].concat());
        assert!(said.contains("12 frames") && said.contains(name), "{said}");
        assert_eq!(frames(&path), 12, "{name}");
    }
    let (slow, twice) = (fresh("slow.gif"), fresh("twice.gif"));
    let run = |path: &str, fps: f64| {
        let fps = fps.to_string();
        done(&[&["run", REACH, "--episodes", "1", "--video", path, "--fps", &fps], &steps[..]].concat());
        frames(path)
    };
    assert_eq!(run(&slow, 0.5 / period), 3, "every second state");
    assert_eq!(run(&twice, 2.0 / period), 11, "every state but the last twice");
}

/// A video changes neither what `run` prints nor what `sim` records.
#[test]
fn videos_change_no_trajectory() {
    let (gif, with, without) = (fresh("motion.gif"), fresh("with.npz"), fresh("without.npz"));
    let sim = ["sim", "assets/pile/pile.xml", "--seconds", "0.2", "-q", "--out"];
    done(&[&sim[..], &[&with, "--video", &gif, "--size", "64x48", "--fps", "10"]].concat());
    done(&[&sim[..], &[&without]].concat());
    assert_eq!(std::fs::read(with).unwrap(), std::fs::read(without).unwrap());
    assert_eq!(frames(&gif), 3);
    let returns = |options: &[&str]| {
        let out = done(&[&["run", REACH, "--episodes", "2", "--json"], options].concat());
        serde_json::from_str::<serde_json::Value>(&out).unwrap()["returns"].clone()
    };
    assert_eq!(returns(&[]), returns(&["--video", &gif, "--size", "32"]));
}

#[cfg(unix)]
#[test]
fn an_interrupted_run_completes_its_video() {
    use std::process::Stdio;
    let path = fresh("interrupted.gif");
    let run = ["run", REACH, "--episodes", "1000000", "--each", "--size", "16", "--video", &path];
    let mut child = command().args(run).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    let mut line = String::new();
    let mut out = std::io::BufReader::new(child.stdout.take().unwrap());
    std::io::BufRead::read_line(&mut out, &mut line).unwrap();
    assert!(line.starts_with("seed 0: 50 steps") && !Path::new(&path).exists(), "{line}");
    let status = std::process::Command::new("kill").args(["-INT", &child.id().to_string()]).status();
    assert!(status.unwrap().success());
    let mut rest = String::new();
    std::io::Read::read_to_string(&mut out, &mut rest).unwrap();
    assert_eq!(child.wait().unwrap().code(), Some(130));
    assert!(rest.contains("interrupted.gif"), "{rest}");
    assert!(frames(&path) >= 50);
}

#[test]
fn a_gallery_is_the_same_on_any_number_of_threads() {
    let (one, two) = (fresh("one.png"), fresh("two.png"));
    let sheet = |path: &str, threads: &str| {
        done(&["gallery", "hive/Franka", "--size", "40x30", "--threads", threads, "-q", "--out", path])
    };
    assert!(sheet(&one, "1").contains("4 environments"));
    sheet(&two, "2");
    assert_eq!(decode(&one), decode(&two));
    assert!(colours(&one) > 100);

    let out = robohive(&["gallery", "--size", "16", "-q", "--out", &two]);
    assert!(out.status.success(), "{}", text(&out.stderr));
    let note = text(&out.stderr);
    assert!(note.contains("left out") && note.contains("robohive assets import"), "{note}");
    let out = robohive(&["gallery", "AirplaneFly", "-q", "--out", &two]);
    assert_eq!(out.status.code(), Some(1));
    assert!(text(&out.stderr).contains("no environment to draw"));
}

#[test]
fn solved_episodes_are_drawn_at_their_end_and_filmed() {
    let (start, end, clips) = (fresh("start.png"), fresh("end.png"), fresh("clips"));
    let size = ["--size", "64x48", "-q"];
    done(&[&["gallery", "KnifeEdge", "--out", &start][..], &size].concat());
    let said =
        done(&[&["gallery", "KnifeEdge", "--solved", "--clips", &clips, "--out", &end][..], &size].concat());
    assert!(said.contains("1 environments"), "{said}");
    assert_ne!(decode(&start), decode(&end));
    let film = std::fs::read(format!("{clips}/hive_KnifeEdgeReach-v0.mp4")).unwrap();
    assert!(film.len() > 2000 && film[4..8] == *b"ftyp");

    // Farther than the body comes in its time.
    let far = ["--set", "target_distance_range=[40, 41]"];
    let out = robohive(&[&["gallery", "DKittyWalkTo", "--solved", "--out", &end][..], &size, &far].concat());
    assert_eq!(out.status.code(), Some(1));
    assert!(text(&out.stderr).contains("do not solve them from seed 0"), "{}", text(&out.stderr));
    let none = refused(&["gallery", "AirplaneFly", "--solved", "--out", &end]);
    assert!(none.contains("no controller serves any of \"AirplaneFly\""), "{none}");
    assert!(refused(&["gallery", "KnifeEdge", "--clips", &clips, "--out", &end]).contains("--solved"));
}
