//! Pickles that Python wrote, pickles that are malformed, and pickles that mean harm.

use robohive_dataset::pickle::{Pickle, Value};

/// `{"name": "door", "numbers": [0, 255, 65535, -1, 2**40, 2**80, 1.5], "flags": (True, False, None), "set": {7},
/// "empty": [(), {}, []]}`, as Python writes it in protocols 2 to 5.
const DUMPED: [&[u8]; 4] = [
    b"\x80\x02}q\x00(X\x04\x00\x00\x00nameq\x01X\x04\x00\x00\x00doorq\x02X\x07\x00\x00\x00numbersq\x03]q\x04(K\x00K\xffM\xff\xffJ\xff\xff\xff\xff\x8a\x06\x00\x00\x00\x00\x00\x01\x8a\x0b\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x01G?\xf8\x00\x00\x00\x00\x00\x00eX\x05\x00\x00\x00flagsq\x05\x88\x89N\x87q\x06X\x03\x00\x00\x00setq\x07c__builtin__\x0aset\x0aq\x08]q\x09K\x07a\x85q\x0aRq\x0bX\x05\x00\x00\x00emptyq\x0c]q\x0d()}q\x0e]q\x0feu.",
    b"\x80\x03}q\x00(X\x04\x00\x00\x00nameq\x01X\x04\x00\x00\x00doorq\x02X\x07\x00\x00\x00numbersq\x03]q\x04(K\x00K\xffM\xff\xffJ\xff\xff\xff\xff\x8a\x06\x00\x00\x00\x00\x00\x01\x8a\x0b\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x01G?\xf8\x00\x00\x00\x00\x00\x00eX\x05\x00\x00\x00flagsq\x05\x88\x89N\x87q\x06X\x03\x00\x00\x00setq\x07cbuiltins\x0aset\x0aq\x08]q\x09K\x07a\x85q\x0aRq\x0bX\x05\x00\x00\x00emptyq\x0c]q\x0d()}q\x0e]q\x0feu.",
    b"\x80\x04\x95u\x00\x00\x00\x00\x00\x00\x00}\x94(\x8c\x04name\x94\x8c\x04door\x94\x8c\x07numbers\x94]\x94(K\x00K\xffM\xff\xffJ\xff\xff\xff\xff\x8a\x06\x00\x00\x00\x00\x00\x01\x8a\x0b\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x01G?\xf8\x00\x00\x00\x00\x00\x00e\x8c\x05flags\x94\x88\x89N\x87\x94\x8c\x03set\x94\x8f\x94(K\x07\x90\x8c\x05empty\x94]\x94()}\x94]\x94eu.",
    b"\x80\x05\x95u\x00\x00\x00\x00\x00\x00\x00}\x94(\x8c\x04name\x94\x8c\x04door\x94\x8c\x07numbers\x94]\x94(K\x00K\xffM\xff\xffJ\xff\xff\xff\xff\x8a\x06\x00\x00\x00\x00\x00\x01\x8a\x0b\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x01G?\xf8\x00\x00\x00\x00\x00\x00e\x8c\x05flags\x94\x88\x89N\x87\x94\x8c\x03set\x94\x8f\x94(K\x07\x90\x8c\x05empty\x94]\x94()}\x94]\x94eu.",
];

/// `numpy.array([[1, 2, 3], [4, 5, 6.5]])` in protocol 3, and `numpy.array([1, -2], dtype="f4")` in protocol 4.
const ARRAYS: [&[u8]; 2] = [
    b"\x80\x03cnumpy._core.multiarray\x0a_reconstruct\x0aq\x00cnumpy\x0andarray\x0aq\x01K\x00\x85q\x02C\x01bq\x03\x87q\x04Rq\x05(K\x01K\x02K\x03\x86q\x06cnumpy\x0adtype\x0aq\x07X\x02\x00\x00\x00f8q\x08\x89\x88\x87q\x09Rq\x0a(K\x03X\x01\x00\x00\x00<q\x0bNNNJ\xff\xff\xff\xffJ\xff\xff\xff\xffK\x00tq\x0cb\x89C0\x00\x00\x00\x00\x00\x00\xf0?\x00\x00\x00\x00\x00\x00\x00@\x00\x00\x00\x00\x00\x00\x08@\x00\x00\x00\x00\x00\x00\x10@\x00\x00\x00\x00\x00\x00\x14@\x00\x00\x00\x00\x00\x00\x1a@q\x0dtq\x0eb.",
    b"\x80\x04\x95\x91\x00\x00\x00\x00\x00\x00\x00\x8c\x16numpy._core.multiarray\x94\x8c\x0c_reconstruct\x94\x93\x94\x8c\x05numpy\x94\x8c\x07ndarray\x94\x93\x94K\x00\x85\x94C\x01b\x94\x87\x94R\x94(K\x01K\x02\x85\x94h\x03\x8c\x05dtype\x94\x93\x94\x8c\x02f4\x94\x89\x88\x87\x94R\x94(K\x03\x8c\x01<\x94NNNJ\xff\xff\xff\xffJ\xff\xff\xff\xffK\x00t\x94b\x89C\x08\x00\x00\x80?\x00\x00\x00\xc0\x94t\x94b.",
];

fn message(bytes: &[u8]) -> String {
    match Pickle::parse(bytes) {
        Err(error) => error.to_string(),
        Ok(_) => panic!("{bytes:?} is malformed"),
    }
}

#[test]
fn every_protocol_gives_the_same_values() {
    for bytes in DUMPED {
        let pickle = Pickle::parse(bytes).unwrap();
        let root = pickle.root();
        assert_eq!(root.get("name").and_then(Value::text), Some("door"));
        let numbers: Vec<_> = root.get("numbers").unwrap().items().map(Value::float).collect();
        let big = Some(2f64.powi(40));
        assert_eq!(numbers, [Some(0.0), Some(255.0), Some(65535.0), Some(-1.0), big, None, Some(1.5)]);
        let long = root.get("numbers").unwrap().item(5).unwrap().long().unwrap();
        assert_eq!(long, [0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1]);
        let flags = root.get("flags").unwrap();
        assert_eq!(flags.items().map(Value::bool).collect::<Vec<_>>(), [Some(true), Some(false), None]);
        assert!(flags.item(2).unwrap().is_none());
        // A set is a call of `set` up to protocol 3.
        let set = root.get("set").unwrap();
        let items = match set.call("builtins", "set").or(set.call("__builtin__", "set")) {
            Some(arguments) => arguments.item(0).unwrap(),
            None => set,
        };
        assert_eq!(items.items().map(Value::int).collect::<Vec<_>>(), [Some(7)]);
        assert_eq!(
            root.get("empty").unwrap().items().map(Value::len).collect::<Vec<_>>(),
            [Some(0), None, Some(0)]
        );
        assert!(root.get("absent").is_none());
    }
}

#[test]
fn arrays_are_read() {
    let array = Pickle::parse(ARRAYS[0]).unwrap().root().array().unwrap();
    assert_eq!((array.shape, array.values.to_f64()), (vec![2, 3], vec![1.0, 2.0, 3.0, 4.0, 5.0, 6.5]));
    let array = Pickle::parse(ARRAYS[1]).unwrap().root().array().unwrap();
    assert_eq!((array.shape, array.values.to_f64()), (vec![2], vec![1.0, -2.0]));
    let error = Pickle::parse(DUMPED[0]).unwrap().root().array().unwrap_err().to_string();
    assert!(error.contains("a dictionary of 5 is something else"), "{error}");
}

#[test]
fn a_call_is_a_name_and_arguments() {
    // os.system("echo"), which Python would run.
    let bytes = b"\x80\x02cos\nsystem\nX\x04\x00\x00\x00echo\x85R.";
    let pickle = Pickle::parse(bytes).unwrap();
    let root = pickle.root();
    assert_eq!(root.callable(), Some(("os", "system")));
    assert_eq!(root.call("os", "system").and_then(|arguments| arguments.item(0)?.text()), Some("echo"));
    assert!(root.call("os", "remove").is_none());
    assert_eq!(root.kind(), "an object of os.system");
}

#[test]
fn malformed_pickles_are_refused() {
    for (bytes, part) in [
        (&b""[..], "byte 0 of the pickle: 1 bytes should follow, and only 0 do"),
        (b"\x80\x09N.", "protocol 9 is not read; 2 to 5 are"),
        (b"\x80\x02.", "one value, and 0 are left"),
        (b"\x80\x02NN.", "one value, and 2 are left"),
        (b"\x80\x02N.N", "byte 4 of the pickle: the pickle ends here, and 1 more bytes follow"),
        (b"\x80\x02(N.", "one value"),
        (b"\x80\x02Nt.", "ends a group, and none began"),
        (b"\x80\x02(\x85.", "takes a value, and there is none"),
        (b"\x80\x02h\x05.", "nothing is stored under 5"),
        (b"\x80\x02X\xff\xff\xff\xffab.", "4294967295 bytes should follow, and only 3 do"),
        (b"\x80\x02X\x02\x00\x00\x00\xc3\x28.", "not valid UTF-8"),
        (b"\x80\x02NK\x01a.", "appended to something that is no list"),
        (b"\x80\x02](K\x01K\x02u.", "set in something that is no dictionary"),
        (b"\x80\x02}(K\x01u.", "the last key has no value"),
        (b"\x80\x02N}b.", "given to something that is no object"),
        (b"\x80\x02cos\nsystem\nNR.", "arguments of an object are no tuple"),
        (b"\x80\x02cos\nsystem", "a line should follow, and none ends"),
        (b"\x80\x02I01\n.", "opcode 0x49 (I) is not supported"),
        (b"GIF89a", "byte 0 of the pickle: this is no pickle of protocol 2 to 5"),
        (b"\x80\x05\x8e\xff\xff\xff\xff\xff\xff\xff\xffa.", "18446744073709551615 bytes"),
    ] {
        let message = message(bytes);
        assert!(message.contains(part), "{message}, not {part}");
    }
}

#[test]
fn no_part_of_a_pickle_and_no_changed_byte_panics() {
    for bytes in DUMPED.iter().chain(&ARRAYS) {
        for end in 0..bytes.len() {
            assert!(Pickle::parse(&bytes[..end]).is_err());
        }
        for place in 0..bytes.len() {
            for byte in [0x00, 0x28, 0x2e, 0x52, 0x62, 0x75, 0x7f, 0x80, 0xff] {
                let mut changed = bytes.to_vec();
                changed[place] = byte;
                if let Ok(pickle) = Pickle::parse(&changed) {
                    assert!(!pickle.root().kind().is_empty());
                    let _ = pickle.root().array();
                    let _ = pickle.root().tensor();
                }
            }
        }
    }
}

#[test]
fn depth_and_cycles_are_harmless() {
    // A million lists, each within the next.
    let depth = 1_000_000;
    let bytes = [&b"\x80\x02"[..], &vec![b']'; depth], &vec![b'a'; depth - 1], b"."].concat();
    let pickle = Pickle::parse(&bytes).unwrap();
    let mut value = pickle.root();
    let mut levels = 1;
    while let Some(inner) = value.item(0) {
        value = inner;
        levels += 1;
    }
    assert_eq!(levels, depth);
    // A list that contains itself.
    let pickle = Pickle::parse(b"\x80\x02]q\x00h\x00a.").unwrap();
    assert_eq!(pickle.root().item(0).and_then(|inner| inner.item(0)).and_then(Value::len), Some(1));
}
