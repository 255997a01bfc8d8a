//! Configs: what the literal's parser understands, and that everything wrong is refused with its place and a remedy.

use robohive_robot::{Config, HardwareId, Value};

const SENSOR: &str = "'name': 's', 'range': (-1, 1)";

/// The message of a literal that is refused.
fn refused(text: &str) -> String {
    Config::from_literal(text, "arm.config").unwrap_err().to_string()
}

fn refused_toml(text: &str) -> String {
    Config::from_toml(text, "arm.toml").unwrap_err().to_string()
}

/// A parameter of an interface, which may be any value.
fn parameter(value: &str) -> Value {
    let text = format!("{{'d': {{'interface': {{'p': {value}}}}}}}");
    let config = Config::from_literal(&text, "arm.config").unwrap_or_else(|error| panic!("{error}"));
    config.devices[0].interface.parameters["p"].clone()
}

/// The message of a parameter that is refused; it begins at column 27.
fn refused_parameter(value: &str) -> String {
    refused(&format!("{{'d': {{'interface': {{'p': {value}}}}}}}"))
}

#[test]
fn numbers_and_arithmetic_are_pythons() {
    let pi = std::f64::consts::PI;
    for (text, value) in [
        ("-4*np.pi/2", -4.0 * pi / 2.0),
        ("-1*(-3*np.pi/2)", 3.0 * pi / 2.0),
        ("+1*(np.pi)", pi),
        ("1 - 2 - 3.5", -4.5),
        ("2 + 3 * 4.", 14.0),
        ("7 / 2", 3.5),
        ("-.32", -0.32),
        ("1e-3", 1e-3),
        ("1_000.5E+2", 100_050.0),
        ("- - math.pi", pi),
    ] {
        assert_eq!(parameter(text), Value::Number(value), "{text}");
    }
    for (text, value) in [("00", 0), ("-7", -7), ("2 * 3 - 1", 5), ("(4)", 4), ("1_000", 1000), ("-(0)", 0)] {
        assert_eq!(parameter(text), Value::Integer(value), "{text}");
    }
    assert_eq!(parameter("-0.00"), Value::Number(-0.0));
}

#[test]
fn texts_are_pythons() {
    for (text, value) in [
        ("'a\"b'", "a\"b"),
        ("\"it's\"", "it's"),
        ("'''two\nlines, one ' quote'''", "two\nlines, one ' quote"),
        ("\"\"\"\"x\"\"\"", "\"x"),
        (r"'\n\t\\\'\x41\u00e9\U0001F600\101\0'", "\n\t\\'A\u{e9}\u{1f600}A\0"),
        ("'one\\\n line'", "one line"),
        ("r'\\n\\''", "\\n\\'"),
        ("u'text'", "text"),
        ("'one' \"two\"  # a comment\n 'three'", "onetwothree"),
        ("'/dev/ttyUSB0'", "/dev/ttyUSB0"),
        ("'grün'", "grün"),
    ] {
        assert_eq!(parameter(text), Value::Text(value.to_owned()), "{text}");
    }
}

#[test]
fn lists_tuples_and_tables_nest() {
    let numbers = |values: &[i64]| Value::List(values.iter().map(|&value| Value::Integer(value)).collect());
    for (text, value) in [
        ("[1, 2,]", numbers(&[1, 2])),
        ("(1, 2)", numbers(&[1, 2])),
        ("(1,)", numbers(&[1])),
        ("()", numbers(&[])),
        ("[]", numbers(&[])),
        ("[[1], (2,)]", Value::List(vec![numbers(&[1]), numbers(&[2])])),
        ("True", Value::Bool(true)),
        ("False", Value::Bool(false)),
        ("None", Value::None),
        ("{}", Value::Table([].into())),
        (
            "{'a': {'b': 1},}",
            Value::Table([("a".into(), Value::Table([("b".into(), Value::Integer(1))].into()))].into()),
        ),
    ] {
        assert_eq!(parameter(text), value, "{text}");
    }
}

#[test]
fn what_is_no_literal_is_refused_where_it_stands() {
    for (value, message) in [
        (
            "__import__('os')",
            "1:27: '__import__' is no literal: of names, a config may use True, False, None and np.pi",
        ),
        ("np.sin(1)", "1:27: 'np.sin' is no literal"),
        ("[1 for x in y]", "1:30: 'f' where ',' or ']' should stand"),
        ("2 ** 3", "1:29: of operators, a config may use + - * /"),
        ("7 // 2", "1:29: of operators"),
        ("1 / 0", "1:31: a division by zero"),
        ("'a' * 2", "1:27: '*' takes numbers, not a text"),
        ("2 + [1]", "1:31: '+' takes numbers, not a list"),
        ("-'a'", "1:27: '-' before what is no number"),
        ("012", "1:27: '012' is no decimal number"),
        ("0x10", "1:27: '0x10' is no decimal number"),
        ("1.2.3", "1:27: '1.2.3' is no decimal number"),
        ("1__0", "1:27: '1__0' is no decimal number"),
        ("9223372036854775808", "1:27: an integer beyond 64 bits"),
        ("9223372036854775807 + 1", "1:27: an integer beyond 64 bits"),
        ("'open\n'", "1:27: a text without its closing ' on the line"),
        ("'open", "1:27: a text without its closing '"),
        ("'''open", "1:27: a text without its closing '''"),
        (r"'\q'", r"1:28: the escape '\q'; a backslash is written '\\'"),
        (r"'\x4'", r"1:28: an escape '\x' without the code of a character"),
        (r"'\ud800'", r"1:28: an escape '\u' without the code of a character"),
        ("b'bytes'", "1:27: texts of the form b'…' have no place in a config"),
        ("f'{x}'", "1:27: texts of the form f'…'"),
        ("[1", "1:29: '}' where ',' or ']' should stand"),
        ("", "1:27: '}' where a value should stand"),
        ("{1: 2}", "1:28: a key that is a number; keys are texts"),
        ("{'a' 1}", "1:32: '1' where the ':' after the key 'a' should stand"),
        ("{'a': 1, 'a': 2}", "1:36: the key 'a' a second time"),
    ] {
        let error = refused_parameter(value);
        assert!(error.starts_with(&format!("arm.config:{message}")), "{value}: {error}");
    }
    assert_eq!(refused("{} # fine\n  {}"), "arm.config:2:3: '{' after the end of the literal");
    assert_eq!(refused("# nothing\n"), "arm.config:2:1: the end of the text where a value should stand");
    assert_eq!(refused("{'ä':: 1}"), "arm.config:1:6: ':' where a value should stand");
}

#[test]
fn nesting_and_length_are_bounded() {
    for (open, close) in [("[", "]"), ("(", ")"), ("{'a':", "}"), ("-", "")] {
        let text = format!("{}1{}", open.repeat(100_000), close.repeat(100_000));
        assert!(refused(&text).contains("more than 64 levels of brackets and signs"), "{open}");
    }
    let long = " ".repeat((1 << 20) + 1);
    assert_eq!(refused(&long), "arm.config: 1048577 bytes are no config of a robot; it may have 1048576");
}

#[test]
fn devices_keep_the_order_of_the_file_and_defaults_fill_gaps() {
    let text = "{'b': {'sensor': [{'name': 'x', 'range': [0, 1]}, {'name': 'y', 'range': [0, 1]}]},
                 'a': {'interface': {'type': 'log', 'port': 5000}, 'actuator': [{'name': 'm', 'pos_range': (0, 2),
                       'vel_range': (-1, 1), 'effort_range': (-5, 5), 'mode': 'PWM', 'hdr_id': 'left'}],
                       'cams': [{'name': 'c', 'range': (0, 255), 'hdr_id': 'rgb'}]}}";
    let config = Config::from_literal(text, "two.config").unwrap();
    let [b, a] = &config.devices[..] else { panic!("{config:?}") };
    assert_eq!((b.name.as_str(), a.name.as_str()), ("b", "a"));
    assert_eq!(b.interface.kind, None);
    let y = &b.sensors[1];
    assert_eq!((y.noise, y.scale, y.offset), (0.0, 1.0, 0.0));
    assert_eq!((&b.sensors[0].hardware, &y.hardware), (&HardwareId::Number(0), &HardwareId::Number(1)));
    assert_eq!(a.interface.kind.as_deref(), Some("log"));
    assert_eq!(a.interface.parameters["port"], Value::Integer(5000));
    let m = &a.actuators[0];
    assert_eq!((m.effort_range, m.mode.as_deref()), (Some([-5.0, 5.0]), Some("PWM")));
    assert_eq!(m.hardware, HardwareId::Name("left".to_owned()));
    assert_eq!(a.cameras[0].hardware, HardwareId::Name("rgb".to_owned()));
    assert_eq!(Config::from_toml(&config.to_toml(), "two.toml").unwrap(), config);
}

#[test]
fn toml_keeps_every_value() {
    let text = r#"{'d "q"': {'interface': {'type': 'x\\y', 'list': [1, 2.5, 'a\nb', True, None], 'odd key': {'t': 1e300},
                  'tiny': -1e-7, 'control': '\x01', 'none': None},
                  'sensor': [{'name': 's', 'range': (-np.pi/3, 1e-9), 'noise': 0.1, 'hdr_id': -1, 'scale': -9.81}]}}"#;
    let config = Config::from_literal(text, "odd.config").unwrap();
    let again = Config::from_toml(&config.to_toml(), "odd.toml").unwrap_or_else(|error| panic!("{error}"));
    let mut expected = config;
    expected.devices[0].interface.parameters.remove("none");
    let list = expected.devices[0].interface.parameters.get_mut("list").unwrap();
    let Value::List(items) = list else { panic!("{list:?}") };
    items.pop();
    assert_eq!(again, expected);
}

#[test]
fn wrong_keys_and_values_are_refused_by_name() {
    let sensor = |row: &str| refused(&format!("{{'arm':\n {{'sensor': [{{{row}}}]}}}}"));
    let actuator = |row: &str| refused(&format!("{{'arm':\n {{'actuator': [{{{row}}}]}}}}"));
    assert_eq!(refused("[1]"), "arm.config:1:1: a config is a table of devices, this is a list");
    assert_eq!(refused("{'arm': 3}"), "arm.config:1:9: device 'arm' is a number, not a table");
    assert_eq!(
        refused("{'arm': {'sensors': []}}"),
        "arm.config:1:10: device 'arm' has an unknown key 'sensors'; did you mean 'sensor'?"
    );
    assert_eq!(
        refused("{'arm': {'wheels': []}}"),
        "arm.config:1:10: device 'arm' has an unknown key 'wheels'; it may have interface, sensor, actuator, cam, cams"
    );
    assert_eq!(
        refused("{'arm': {'sensor': {}}}"),
        "arm.config:1:20: 'sensor' of device 'arm' is a table, not a list"
    );
    assert_eq!(
        refused("{'arm': {'interface': 'dxl'}}"),
        "arm.config:1:23: an interface is a table, this is a text"
    );
    assert_eq!(
        refused("{'arm': {'interface': {'type': 1}}}"),
        "arm.config:1:32: the type of an interface is a text"
    );
    assert_eq!(sensor("'range': (0, 1)"), "arm.config:2:14: sensor 1 of device 'arm' has no 'name'");
    assert_eq!(sensor("'name': 's'"), "arm.config:2:14: sensor 1 of device 'arm' ('s') has no 'range'");
    for (value, complaint) in [
        ("'range': 1", "is a number, not a pair of numbers"),
        ("'range': (1, 2, 3)", "has 3 numbers, not 2"),
        ("'range': (2, 1)", "begins at 2, above its end 1"),
        ("'range': (0, 'a')", "is a text, not a number"),
        ("'range': (0, 1e999)", "is inf; it must be finite"),
    ] {
        let error = sensor(&format!("'name': 's', {value}"));
        assert!(
            error.ends_with(&format!("'range' of sensor 1 of device 'arm' ('s') {complaint}")),
            "{error}"
        );
    }
    for (value, complaint) in [
        ("'noise': -0.1", "'noise' of sensor 1 of device 'arm' ('s') is negative"),
        (
            "'scale': 0",
            "'scale' of sensor 1 of device 'arm' ('s') is 0, which nothing can be scaled back from",
        ),
        (
            "'hdr_id': 1.5",
            "'hdr_id' of sensor 1 of device 'arm' ('s') is a number, not a whole number or a name",
        ),
        ("'offset': True", "'offset' of sensor 1 of device 'arm' ('s') is a truth value, not a number"),
        ("'offest': 1", "has an unknown key 'offest'; did you mean 'offset'?"),
    ] {
        let error = sensor(&format!("{SENSOR}, {value}"));
        assert!(error.ends_with(complaint), "{error}");
    }
    assert!(actuator("'name': 7").ends_with("'name' of actuator 1 of device 'arm' is a number, not a text"));
    assert!(actuator("'name': 'm', 'pos_range': (0, 1)").ends_with("('m') has no 'vel_range'"));
}

#[test]
fn wrong_toml_is_refused_where_it_stands() {
    assert!(
        refused_toml("[[device]]\nname = \n").starts_with("arm.toml:2:"),
        "{}",
        refused_toml("[[device]]\nname = \n")
    );
    assert_eq!(refused_toml("[[device]]\nsensor = []"), "arm.toml:1:1: a device has no 'name'");
    assert_eq!(
        refused_toml("[[device]]\nname = 'a'\n[[device]]\nname = 'a'\n"),
        "arm.toml:3:1: the device 'a' a second time"
    );
    assert_eq!(
        refused_toml("[[devices]]\nname = 'a'"),
        "arm.toml:1:3: the config has an unknown key 'devices'; did you mean 'device'?"
    );
    assert_eq!(
        refused_toml("[[device]]\nname = 'a'\nsensor = [{ name = 's', range = [0, nan] }]"),
        "arm.toml:3:37: 'range' of sensor 1 of device 'a' ('s') is NaN; it must be finite"
    );
    assert_eq!(
        refused_toml("[[device]]\nname = 'a'\ninterface = { since = 2020-01-01 }"),
        "arm.toml:3:23: a date, of which a robot has no use"
    );
    assert!(
        refused_toml("[[device]]\nname = 'a'\ninterface = { n = 99999999999999999999 }")
            .contains("beyond 64 bits")
    );
}

#[test]
fn a_config_has_a_device() {
    for text in ["{}", "\n# nothing\n{}"] {
        let line = text.lines().count();
        assert!(
            refused(text).starts_with(&format!("arm.config:{line}:1: the config has no device")),
            "{}",
            refused(text)
        );
    }
    for text in ["", "# nothing\n", "device = []"] {
        assert!(
            refused_toml(text).starts_with("arm.toml:1:1: the config has no device"),
            "{}",
            refused_toml(text)
        );
    }
}

#[test]
fn files_are_read_by_extension() {
    let folder = std::env::temp_dir().join(format!("robohive-robot-{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    let literal = folder.join("arm.config");
    std::fs::write(&literal, format!("{{'d': {{'sensor': [{{{SENSOR}}}]}}}}")).unwrap();
    let config = Config::read(&literal).unwrap();
    let toml = folder.join("arm.toml");
    std::fs::write(&toml, config.to_toml()).unwrap();
    assert_eq!(Config::read(&toml).unwrap(), config);
    std::fs::write(&toml, [b'a', 0xff]).unwrap();
    assert!(Config::read(&toml).unwrap_err().to_string().contains("UTF-8"));
    let missing = Config::read(folder.join("none.toml")).unwrap_err();
    assert_eq!((missing.position, missing.file.ends_with("none.toml")), (None, true));
    std::fs::remove_dir_all(&folder).unwrap();
}

#[test]
fn damaged_texts_end_in_a_config_or_an_error() {
    let text = "{'arm': {'interface': {'type': 'dxl', 'port': \"/dev/ttyUSB0\", 'x': [None, True, {'y': r'a\\b'}]}, # é
        'sensor': [{'name': '''q''', 'range': (-1*(-3*np.pi/2), 5e0), 'noise': 0.05, 'hdr_id': -1, 'scale': +1}],
        'actuator': [{'name': 'm\\x41', 'pos_range': (-.5, 00), 'vel_range': (-2*np.pi/4, 2), 'offset': 1_0}]}}";
    let toml = Config::from_literal(text, "arm.config").unwrap().to_toml();
    let mut rng = random::Generator::pcg64(1_u64);
    let (mut read, mut refused) = (0, 0);
    for (original, parse) in
        [(text, Config::from_literal as fn(&str, &str) -> _), (toml.as_str(), Config::from_toml)]
    {
        let characters: Vec<char> = original.chars().collect();
        for _ in 0..20_000 {
            let damaged = damaged(&characters, &mut rng);
            match parse(&damaged, "damaged") {
                Ok(config) => {
                    read += 1;
                    assert!(Config::from_toml(&config.to_toml(), "again").is_ok(), "{damaged}");
                }
                Err(error) => {
                    refused += 1;
                    assert!(error.position.is_some(), "{error}");
                }
            }
        }
    }
    assert!(read > 1000 && refused > 10_000, "{read} read, {refused} refused");
}

/// The text with one to three characters replaced or inserted, or cut off.
fn damaged(characters: &[char], rng: &mut random::Generator<random::Pcg64>) -> String {
    let mut damaged = characters.to_vec();
    for _ in 0..rng.integer(1..=3).unwrap() {
        let from = rng.integer(0..characters.len() as u64).unwrap() as usize;
        let to = rng.integer(0..damaged.len() as u64).unwrap() as usize;
        match rng.integer(0..20).unwrap() {
            0 => damaged.truncate(to + 1),
            1..10 => damaged[to] = characters[from],
            _ => damaged.insert(to, characters[from]),
        }
    }
    damaged.into_iter().collect()
}

#[test]
fn many_keys_are_read_in_time_that_grows_with_their_number() {
    let keys: String = (0..50_000).map(|k| format!("'{k}': 1,")).collect();
    let config =
        Config::from_literal(&format!("{{'d': {{'interface': {{{keys}}}}}}}"), "keys.config").unwrap();
    assert_eq!(config.devices[0].interface.parameters.len(), 50_000);
}
