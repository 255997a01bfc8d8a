//! Faulty texts: each gives the diagnostic that names the fault and its place, without a panic.

use robohive_mjcf::diagnostic::Diagnostics;
use robohive_mjcf::files::{Disk, Memory};
use robohive_mjcf::{Loader, load_str};

fn refused(text: &str) -> Diagnostics {
    load_str(text).err().unwrap_or_else(|| panic!("accepted: {text}"))
}

/// The first line of what is said about `text`.
fn first(text: &str) -> String {
    refused(text).to_string().lines().next().unwrap_or_default().to_string()
}

/// A model around the content of its world.
fn world(content: &str) -> String {
    format!("<mujoco>\n<worldbody>\n{content}\n</worldbody>\n</mujoco>")
}

/// What may stand in `<worldbody>`, and what is said of it.
const IN_THE_WORLD: [(&str, &str); 21] = [
    (
        "<geom size='1' masss='2'/>",
        "<text>:3:16: error: unknown attribute 'masss' of <geom>; did you mean 'mass'?",
    ),
    ("<geoms size='1'/>", "<text>:3:1: error: unknown element <geoms> in <worldbody>; did you mean <geom>?"),
    ("<geom size='1 2 3 4'/>", "<text>:3:13: error: attribute 'size' of <geom> takes 1 to 3 numbers, not 4"),
    ("<geom size='1' pos='0 1'/>", "<text>:3:21: error: attribute 'pos' of <geom> takes 3 numbers, not 2"),
    ("<geom size='1' pos='0 1 2x'/>", "<text>:3:25: error: attribute 'pos' of <geom>: '2x' is not a number"),
    (
        "<geom size='1' condim='3.5'/>",
        "<text>:3:24: error: attribute 'condim' of <geom>: '3.5' is not an integer",
    ),
    (
        "<geom size='1' condim='30000000000'/>",
        "<text>:3:24: error: attribute 'condim' of <geom>: integer '30000000000' is too large",
    ),
    (
        "<geom size='nan'/>",
        "<text>:3:13: error: attribute 'size' of <geom>: 'nan' is not allowed: values must be numbers",
    ),
    (
        "<geom size='1' mass='1e309'/>",
        "<text>:3:22: error: attribute 'mass' of <geom>: number '1e309' is too large",
    ),
    (
        "<geom size='1' rgba='1 1e308 1 1'/>",
        "<text>:3:24: error: attribute 'rgba' of <geom>: number '1e308' is too large",
    ),
    (
        "<geom size='1' mass='1e308'/>",
        "<text>:3:22: error: attribute 'mass' of <geom>: number '1e308' is too large: at most 1e100 in magnitude",
    ),
    (
        "<geom size='1' pos='0 -inf 0'/>",
        "<text>:3:23: error: attribute 'pos' of <geom>: number '-inf' is too large: at most 1e100 in magnitude",
    ),
    (
        "<geom type='capsul' size='1'/>",
        "<text>:3:13: error: attribute 'type' of <geom> cannot be 'capsul'; did you mean 'capsule'?",
    ),
    ("<geom size='1' quat='0 0 0 0'/>", "<text>:3:22: error: a quaternion cannot be zero"),
    (
        "<body name='a'/><body name='a'/>",
        "<text>:3:29: error: duplicate body name 'a'; the first is at <text>:3:13",
    ),
    ("<geom class='fat' size='1'/>", "<text>:3:14: error: no default class is named 'fat'"),
    ("<joint/>", "<text>:3:1: error: unknown element <joint> in <worldbody>"),
    ("<body><inertial mass='1'/></body>", "<text>:3:7: error: <inertial> needs the attribute 'pos'"),
    (
        "<body><inertial pos='0 0 0' mass='1'/><inertial pos='0 0 0' mass='1'/></body>",
        "<text>:3:39: error: <inertial> may stand only once in <body>",
    ),
    (
        "<geom size='1' euler='0 0 1' quat='1 0 0 0'/>",
        "<text>:3:1: error: <geom> takes only one of 'quat' or 'axisangle' or 'xyaxes' or 'zaxis' or 'euler'",
    ),
    (
        "<composite type='cable'/>",
        "<text>:3:1: error: a cable is made of capsules, cylinders or boxes: set 'type' of its <geom>",
    ),
];

/// Whole texts, and what is said of them.
const WHOLE_TEXTS: [(&str, &str); 16] = [
    (
        "<mujoco><keyframe><key qpos='0 inf'/></keyframe></mujoco>",
        "<text>:1:32: error: attribute 'qpos' of <key>: number 'inf' is too large: at most 1e100 in magnitude",
    ),
    (
        "<mujoco><option timestep='nan'/></mujoco>",
        "<text>:1:27: error: attribute 'timestep' of <option>: 'nan' is not allowed: values must be numbers",
    ),
    (
        "<mujoco><option timestep='1e308'/></mujoco>",
        "<text>:1:27: error: attribute 'timestep' of <option>: number '1e308' is too large: at most 1e100 in magnitude",
    ),
    (
        "<mujoco><option timestep='0'/></mujoco>",
        "<text>:1:27: error: attribute 'timestep' of <option> must be positive, is 0",
    ),
    (
        "<mujoco><option gravity='0 0 -9.81' timestep='-0.002'/></mujoco>",
        "<text>:1:47: error: attribute 'timestep' of <option> must be positive, is -0.002",
    ),
    (
        "<mujoco><actuator><motor joint='elbov'/></actuator><worldbody><body><joint name='elbow'/></body></worldbody></mujoco>",
        "<text>:1:33: error: no joint is named 'elbov'; did you mean 'elbow'?",
    ),
    (
        "<mujoco><sensor><touch name='t'/></sensor></mujoco>",
        "<text>:1:17: error: <touch> needs the attribute 'site'",
    ),
    (
        "<mujoco><sensor><framepos objtype='bodyy' objname='world'/></sensor></mujoco>",
        "<text>:1:36: error: attribute 'objtype' of <framepos> cannot be 'bodyy'; did you mean 'body'?",
    ),
    (
        "<mujoco><compiler eulerseq='xyq'/></mujoco>",
        "<text>:1:29: error: attribute 'eulerseq' takes three of the letters xyzXYZ",
    ),
    (
        "<mujoco><option><flag contact='off'/></option></mujoco>",
        "<text>:1:32: error: attribute 'contact' of <flag> cannot be 'off'; one of disable, enable",
    ),
    (
        "<mujoco><size memory='12Q'/></mujoco>",
        "<text>:1:23: error: attribute 'memory' takes a number of bytes such as 512K or 15M",
    ),
    (
        "<mujoco><default><default class='a'><geom name='g'/></default></default></mujoco>",
        "<text>:1:43: error: attribute 'name' of <geom> cannot have a default",
    ),
    ("<model/>", "<text>:1:1: error: root element <model> is not <mujoco>"),
    (
        "<mujoco><sensor><tactile geom='g'/></sensor></mujoco>",
        "<text>:1:17: error: <tactile> needs the attribute 'mesh'",
    ),
    (
        "<mujoco><sensor><tactile geom='g' mesh='m' cutoff='1'/></sensor></mujoco>",
        "<text>:1:44: error: unknown attribute 'cutoff' of <tactile>",
    ),
    (
        "<mujoco><option collision='predefined'/></mujoco>",
        "<text>:1:17: error: attribute 'collision' of <option> is no longer supported; only 'all' is accepted: pairs and excludes now decide alone",
    ),
];

#[test]
fn every_fault_is_named_where_it_stands() {
    for (content, expected) in IN_THE_WORLD {
        assert_eq!(first(&world(content)), expected, "for {content}");
    }
    for (text, expected) in WHOLE_TEXTS {
        assert_eq!(first(text), expected, "for {text}");
    }
}

#[test]
fn all_faults_are_reported_together() {
    let text =
        world("<geom size='x'/>\n<site typo='1'/>\n<body name='a'><geom size='1' material='none'/></body>");
    let found = refused(&text);
    let lines: Vec<usize> = found.errors().filter_map(|d| d.position.as_ref().map(|p| p.line)).collect();
    assert_eq!(found.errors().count(), 3, "{found}");
    assert!([3, 4, 5].iter().all(|line| lines.contains(line)), "{found}");
}

#[test]
fn broken_xml_is_located() {
    let cases = [
        ("", "<text>:1:1: error: file is empty"),
        (
            "<mujoco>\n <worldbody>\n</mujoco>",
            "<text>:3:1: error: </mujoco> does not close <worldbody> opened on line 2",
        ),
        ("<mujoco>\n <option/>", "<text>:1:1: error: <mujoco> is never closed"),
        ("<mujoco>\n <option timestep='1", "<text>:2:19: error: attribute value has no closing quote"),
        ("<mujoco>\n <option", "<text>:2:2: error: <option has no '>'"),
        ("</mujoco><mujoco/>", "<text>:1:1: error: </mujoco> closes nothing"),
        ("<mujoco/><mujoco>", "<text>:1:10: error: <mujoco> is never closed"),
        ("<mujoco/>text", "<text>:1:10: error: not XML: unknown token"),
        ("<mujoco><!-- open </mujoco>", "<text>:1:9: error: comment is never closed"),
        ("<mujoco model='&what;'/>", "<text>:1:16: error: not XML: unknown entity reference 'what'"),
        (
            "<mujoco model='a' model='b'/>",
            "<text>:1:19: error: not XML: attribute 'model' is already defined",
        ),
    ];
    for (text, expected) in cases {
        assert_eq!(first(text), expected, "for {text}");
    }
}

/// MuJoCo's parser reads one element, and stops at a closing tag that closes nothing.
#[test]
fn what_follows_the_model_is_ignored_with_a_warning() {
    for rest in
        ["</mujoco>", "</mujoco> text <", "</other>", "<mujoco><geom/></mujoco>", "<a b='1'c='2'/><!-- -->"]
    {
        let text = format!("<mujoco model='m'><worldbody><geom size='1'/></worldbody></mujoco>{rest}");
        let loaded = load_str(&text).unwrap_or_else(|d| panic!("{rest}: {d}"));
        assert_eq!((loaded.model.ngeom, loaded.model.name.as_str()), (1, "m"), "{rest}");
        let expected = "<text>:1:67: warning: what follows the end of the first element is ignored";
        assert_eq!(loaded.warnings.to_string(), expected, "{rest}");
    }
}

#[test]
fn other_formats_of_models_are_refused_with_a_way_out() {
    let mjb = b"\x31\xd4\x00\x00\x08\x00\x00\x00b\x00\x00\x00";
    for (path, content, expected) in [
        ("m.mjb", &mjb[..], "m.mjb:1:1: error: this is MJB"),
        ("m.usda", b"#usda 1.0\n", "m.usda:1:1: error: this is OpenUSD"),
        ("m.usdc", b"PXR-USDC\x00\x07", "m.usdc:1:1: error: this is OpenUSD"),
        ("m.mjz", b"PK\x03\x04", "m.mjz:1:1: error: file is a zip archive"),
    ] {
        let mut files = Memory::default();
        files.insert(path, content);
        let message = Loader::default().files(files).load(path).unwrap_err().to_string();
        assert!(message.starts_with(expected), "{message}");
        assert!(path == "m.mjz" || message.contains("MJCF"), "{message}");
    }
}

/// MuJoCo reads them, and they mean that there is no bound.
#[test]
fn ranges_may_be_infinite() {
    let text = "<mujoco><worldbody><body><joint name='j' range='-inf 1e308' limited='true'/><geom size='1' user='inf'/>
        </body></worldbody><actuator><motor joint='j' ctrlrange='-inf inf' forcerange='-1e300 inf'/></actuator></mujoco>";
    let model = load_str(text).unwrap_or_else(|d| panic!("{d}")).model;
    assert_eq!(model.actuator_forcerange, [[-1e300, f64::INFINITY]]);
}

#[test]
fn what_mujocos_parser_forgives_is_read() {
    let text = "\u{feff}<?xml version='1.0'?><!DOCTYPE mujoco><!-- a -- b -->\n<mujoco><worldbody><geom size='1'pos='0 0 1'/></worldbody></mujoco>";
    let model = load_str(text).unwrap_or_else(|d| panic!("{d}")).model;
    assert_eq!(model.geom_pos, [[0.0, 0.0, 1.0]]);
}

/// Half of a very short text may be zeros, as in UTF-16.
#[test]
fn a_nul_in_a_text_is_named_at_its_place() {
    for (text, place) in
        [("<mujoco>\n</mujoco>\0", "2:10"), ("<mujoco>\0</mujoco>", "1:9"), ("a\0", "1:2"), ("\0", "1:1")]
    {
        let said = load_str(text).unwrap_err().to_string();
        assert!(said.starts_with(&format!("<text>:{place}: error: the text has a NUL here")), "{said}");
    }
}

#[test]
fn bytes_that_are_no_text_are_named() {
    let text = "<mujoco><worldbody/></mujoco>";
    let wide = |mark: &[u8], unit: fn(u16) -> [u8; 2]| {
        mark.iter().copied().chain(text.encode_utf16().flat_map(unit)).collect::<Vec<u8>>()
    };
    let cases = [
        (wide(&[0xff, 0xfe], u16::to_le_bytes), "text in UTF-16"),
        (wide(&[0xfe, 0xff], u16::to_be_bytes), "text in UTF-16"),
        (wide(&[], u16::to_le_bytes), "text in UTF-16"),
        (wide(&[], u16::to_be_bytes), "text in UTF-16"),
        (vec![0xff, 0xfe, 0, 0, b'<', 0, 0, 0], "text in UTF-32"),
        (b"\x7fELF\x02\x01\x01\0\0".to_vec(), "binary"),
    ];
    for (bytes, what) in cases {
        let mut memory = Memory::default();
        memory.insert("main.xml", "<mujoco><include file='part.xml'/></mujoco>".as_bytes());
        memory.insert("part.xml", bytes);
        let loader = Loader::default().files(memory);
        let expected = format!("part.xml:1:1: error: file is {what}: a model is text in UTF-8");
        let found = loader.load("part.xml").err().map(|d| d.to_string());
        assert_eq!(found.as_ref(), Some(&expected));
        let included = loader.load("main.xml").err().map(|d| d.to_string());
        assert_eq!(included, Some(format!("{expected}\n  included from main.xml:1:24")));
    }
}

/// A few words may not ask for all memory or all time.
#[test]
fn what_is_asked_for_without_data_is_bounded_in_sum() {
    let bodies = "<replicate count='100'><body/></replicate>";
    let motors = |attributes: &str| {
        let joint = "<worldbody><body><joint name='j'/><geom size='1'/></body></worldbody>";
        let motor = format!("<motor joint='j' {attributes}/>").repeat(300);
        format!("<mujoco>{joint}<actuator>{motor}</actuator></mujoco>")
    };
    let cases = [
        (
            "<mujoco><size nuserdata='2000000000'/></mujoco>".into(),
            "nuserdata must be between 0 and 16777216",
        ),
        (
            format!("<mujoco><size nuser_body='1000000'/><worldbody>{bodies}</worldbody></mujoco>"),
            "room for nuser_body must be between 0 and 16777216, is 101000000",
        ),
        (motors("nsample='100000'"), "the history of all actuators must be between 0 and 16777216"),
        (world("<replicate count='70000'><body/></replicate>"), "more than 65533 bodies"),
    ];
    for (text, expected) in cases {
        let found = refused(&text).to_string();
        assert!(found.contains(expected), "{expected}: {}", found.lines().next().unwrap_or_default());
    }
}

/// Inverse weights are found within each tree: the time grows with the number of trees, not with its square.
#[test]
fn many_trees_compile() {
    let tree = "<body><joint/><geom size='.1'/><body pos='1 0 0'><joint axis='0 1 0'/><geom size='.1'/></body></body>";
    let model = load_str(world(&format!("<replicate count='8000' offset='3 0 0'>{tree}</replicate>")));
    let model = model.unwrap_or_else(|d| panic!("{d}")).model;
    assert_eq!(model.ntree, 8000);
    assert_ne!(model.body_invweight0[1], model.body_invweight0[2]);
    let first = model.body_invweight0[2];
    for tip in model.body_invweight0[2..].iter().step_by(2) {
        assert!((0..2).all(|k| (tip[k] - first[k]).abs() < 1e-9 * first[k]), "{tip:?} {first:?}");
    }
}

fn in_memory(files: &[(&str, &str)]) -> Loader {
    let mut memory = Memory::default();
    files.iter().for_each(|(path, text)| memory.insert(path, text.as_bytes()));
    Loader::default().files(memory)
}

#[test]
fn includes_that_never_end_or_repeat_are_refused() {
    let own = in_memory(&[("m/a.xml", "<mujoco><include file='a.xml'/></mujoco>")]);
    let found = own.load("m/a.xml").err().map(|d| d.to_string());
    assert_eq!(found.as_deref(), Some("m/a.xml:1:24: error: 'm/a.xml' includes itself"));

    let ring = in_memory(&[
        ("a.xml", "<mujoco>\n<include file='b.xml'/></mujoco>"),
        ("b.xml", "<any><include file='c/c.xml'/></any>"),
        ("c/c.xml", "<any>\n\n <include file='../a.xml'/></any>"),
    ]);
    let found = ring.load("a.xml").err().map(|d| d.to_string()).unwrap_or_default();
    assert_eq!(
        found,
        "c/c.xml:3:17: error: 'a.xml' includes itself\n  included from b.xml:1:21\n  included from a.xml:2:16"
    );

    let twice = in_memory(&[
        ("a.xml", "<mujoco><include file='b.xml'/><include file='b.xml'/></mujoco>"),
        ("b.xml", "<any><option timestep='0.001'/></any>"),
    ]);
    let found = twice.load("a.xml").err().map(|d| d.to_string());
    assert_eq!(
        found.as_deref(),
        Some("a.xml:1:47: error: file 'b.xml' is included a second time: remove one of the two")
    );
}

#[test]
fn errors_in_included_files_carry_the_chain() {
    let loader = in_memory(&[
        ("top/a.xml", "<mujoco>\n<worldbody><include file='parts/b.xml'/></worldbody></mujoco>"),
        ("top/parts/b.xml", "<whatever>\n<geom size='1' colour='red'/></whatever>"),
    ]);
    let found = loader.load("top/a.xml").err().map(|d| d.to_string());
    let expected =
        "top/parts/b.xml:2:16: error: unknown attribute 'colour' of <geom>\n  included from top/a.xml:2:27";
    assert_eq!(found.as_deref(), Some(expected));
}

#[test]
fn files_out_of_reach_are_refused() {
    let dir = std::env::temp_dir().join(format!("mjcf-reach-{}", std::process::id()));
    let inner = dir.join("inner");
    std::fs::create_dir_all(&inner).expect("temporary directory");
    std::fs::write(dir.join("secret.xml"), "<any><option/></any>").expect("write");
    std::fs::write(inner.join("a.xml"), "<mujoco><include file='../secret.xml'/></mujoco>").expect("write");
    std::fs::write(inner.join("b.xml"), "<mujoco><include file='/dev/zero'/></mujoco>").expect("write");
    let path = |name: &str| inner.join(name).to_string_lossy().into_owned();
    let jailed = Loader::default().files(Disk::within(&inner)).load(path("a.xml"));
    let device = Loader::default().load(path("b.xml"));
    std::fs::remove_dir_all(&dir).expect("clean up");
    let jailed = jailed.err().map(|d| d.to_string()).unwrap_or_default();
    assert!(jailed.contains("the path leads outside the directory that this model may read"), "{jailed}");
    let device = device.err().map(|d| d.to_string()).unwrap_or_default();
    assert!(device.contains("the path is not that of a regular file"), "{device}");
}

#[test]
fn broken_and_missing_meshes_are_located() {
    let model = |file: &str| {
        format!(
            "<mujoco>\n<asset><mesh name='m' file='{file}'/></asset>\n<worldbody><geom type='mesh' mesh='m'/></worldbody></mujoco>"
        )
    };
    let mut memory = Memory::default();
    memory.insert("missing.xml", model("none.stl").as_bytes());
    memory.insert("cut.xml", model("cut.stl").as_bytes());
    // A header that announces a thousand triangles, and one.
    let mut stl = vec![0_u8; 80];
    stl.extend(1000_u32.to_le_bytes());
    stl.extend([0; 50]);
    memory.insert("cut.stl", stl);
    let loader = Loader::default().files(memory);
    for path in ["missing.xml", "cut.xml"] {
        let found = loader.load(path).err().map(|d| d.to_string()).unwrap_or_default();
        println!("{found}");
        assert!(found.starts_with(&format!("{path}:2:8: error: ")), "{found}");
    }
}

#[test]
fn dropped_attributes_are_ignored_aloud() {
    let text = "<mujoco><option apirate='60' timestep='0.004'/><default class='old'><geom size='2'/></default><worldbody><geom/></worldbody></mujoco>";
    let loaded = load_str(text).unwrap_or_else(|d| panic!("{d}"));
    assert_eq!(loaded.model.opt.timestep, 0.004);
    assert_eq!(loaded.model.geom_size[0][0], 2.0);
    let warnings: Vec<String> = loaded.warnings.warnings().map(|w| w.to_string()).collect();
    assert_eq!(warnings.len(), 2, "{warnings:?}");
    assert!(
        warnings
            .iter()
            .any(|w| w.starts_with("<text>:1:17: warning: attribute 'apirate' of <option> is ignored"))
    );
    assert!(warnings.iter().any(|w| w.contains("'old'") && w.contains("'main'")), "{warnings:?}");
}
