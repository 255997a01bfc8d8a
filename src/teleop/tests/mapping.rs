//! Mappings: the defaults, files, and what is wrong with them.

use robohive_teleop::{
    Axis, Button, DEFAULTS, Device, Event, HandPose, Held, Key, Mapping, Mark, TeleopError,
};

fn read(mapping: &mut Mapping, events: &[Event], now: f64) -> robohive_teleop::Input {
    let mut held = Held::default();
    held.tells_releases(true);
    events.iter().for_each(|event| held.apply(*event, now));
    mapping.read(&held.sample(now))
}

fn key(c: char) -> Event {
    Event::Press(Button::Key(Key::Char(c)))
}

fn pad(code: u16) -> Event {
    Event::Press(Button::Of(Device::Gamepad, code))
}

#[test]
fn the_defaults_are_a_mapping_and_robohives() {
    let mut mapping = Mapping::default();
    assert_eq!((mapping.gains.position, mapping.gains.rotation), (0.05, 0.1));
    Mapping::from_toml(DEFAULTS, "defaults.toml").unwrap();
    let expected = [
        ('d', 0, 1.0),
        ('a', 0, -1.0),
        ('w', 1, 1.0),
        ('x', 1, -1.0),
        ('q', 2, 1.0),
        ('z', 2, -1.0),
        (',', 5, -1.0),
        ('.', 5, 1.0),
    ];
    for (c, axis, sign) in expected {
        let along = read(&mut mapping, &[key(c)], 0.0).motion.arms[0].along;
        assert_eq!(along[axis], sign, "{c}");
        assert_eq!(along.iter().filter(|&&x| x != 0.0).count(), 1, "{c}");
    }
    for (arrow, axis, sign) in
        [(Key::Up, 3, -1.0), (Key::Down, 3, 1.0), (Key::Left, 4, -1.0), (Key::Right, 4, 1.0)]
    {
        assert_eq!(
            read(&mut mapping, &[Event::Press(Button::Key(arrow))], 0.0).motion.arms[0].along[axis],
            sign
        );
    }
    assert_eq!(read(&mut mapping, &[key('[')], 0.0).motion.arms[0].gripper, Some(-1.0));
    assert_eq!(read(&mut mapping, &[Event::Press(Button::Key(Key::Escape))], 0.0).marks, [Mark::End]);
    // Both ways at once is no way.
    assert!(!read(&mut mapping, &[key('d'), key('a')], 0.0).motion.moves());
}

#[test]
fn gamepads_move_by_sticks_and_end_by_two_buttons() {
    let mut mapping = Mapping::default();
    let axis = |code, place| Event::Move(Axis(Device::Gamepad, code), place);
    let input =
        read(&mut mapping, &[axis(1, 0.5), axis(0, -1.0), axis(2, 1.0), axis(5, 0.25), pad(307)], 0.0);
    assert_eq!(input.motion.arms[0].along, [0.5, -1.0, 0.75, 0.0, 0.0, 0.0]);
    assert!(input.motion.quarter);
    assert!(read(&mut mapping, &[pad(314)], 0.0).marks.is_empty());
    assert_eq!(read(&mut mapping, &[pad(314), pad(315)], 0.0).marks, [Mark::End]);
    let mouse = |bit| Event::Press(Button::Of(Device::SpaceMouse, bit));
    assert_eq!(read(&mut mapping, &[mouse(1)], 0.0).motion.arms[0].gripper, Some(1.0));
    // A chord counts alone.
    let both = read(&mut mapping, &[mouse(0), mouse(1)], 0.0);
    assert_eq!((both.motion.arms[0].gripper, both.marks), (None, vec![Mark::End]));
}

#[test]
fn a_hand_is_followed_while_the_clutch_is_held() {
    let mut mapping = Mapping::default();
    let at = |x: f64| HandPose { right: true, position: [0.1, x, -0.3], orientation: [1.0, 0.0, 0.0, 0.0] };
    let clutch = Event::Press(Button::Of(Device::Quest, 4));
    let hand = |x| Event::Hand(at(x));
    assert!(read(&mut mapping, &[hand(0.0)], 0.0).motion.arms[0].hand.is_none());
    assert!(
        read(&mut mapping, &[hand(0.2), clutch], 0.1).motion.arms[0].hand.is_none(),
        "it begins where it is"
    );
    let moved = read(&mut mapping, &[hand(0.25), clutch], 0.2).motion.arms[0].hand.unwrap();
    // Up in the frame of the headset is up in the world.
    assert!((moved.way[2] - 0.05).abs() < 1e-12 && moved.way[0] == 0.0, "{moved:?}");
    assert!(read(&mut mapping, &[hand(0.9)], 0.3).motion.arms[0].hand.is_none());
    assert!(
        read(&mut mapping, &[hand(0.1), clutch], 0.4).motion.arms[0].hand.is_none(),
        "taken again, it begins again"
    );
    let grip = Event::Move(Axis(Device::Quest, 0), 0.75);
    assert_eq!(read(&mut mapping, &[grip], 0.5).motion.arms[0].gripper, Some(-0.5));
}

#[test]
fn files_replace_sections_and_errors_name_what_is_wrong() {
    let text = "[gains]\nposition = 0.01\n[keyboard]\nm = \"+x\"\nspace = \"success\"\n[gamepad]\nx = \"-y\"\n\"tl+tr\" = \"discard\"\nends = { x = [0, 255] }\n";
    let mut mapping = Mapping::from_toml(text, "mine.toml").unwrap();
    assert_eq!((mapping.gains.position, mapping.gains.rotation), (0.01, 0.1));
    assert_eq!(read(&mut mapping, &[key('m')], 0.0).motion.arms[0].along[0], 1.0);
    assert!(!read(&mut mapping, &[key('d')], 0.0).motion.moves(), "the section is replaced");
    assert_eq!(read(&mut mapping, &[key(' ')], 0.0).marks, [Mark::Success]);
    assert_eq!(read(&mut mapping, &[pad(310), pad(311)], 0.0).marks, [Mark::Discard]);
    assert_eq!(mapping.ends.len(), 1);
    for (text, says) in [
        ("[keybord]", "[keybord]"),
        ("keyboard = 1", "[keyboard]"),
        ("[keyboard]\nspce = \"pause\"", "spce"),
        ("[keyboard]\nm = \"+w\"", "+w"),
        ("[keyboard]\nm = \"+0\"", "+0"),
        ("[keyboard]\nm = \"\"", "m = \"\""),
        ("[gamepad]\nrx2 = \"+x\"", "rx2"),
        ("[gamepad]\nends = { x = [5] }", "two ends"),
        ("[quest]\nstands = \"beside\"", "behind"),
        ("[gains]\nposition = -1", "positive"),
        ("[gains]\nposition = nan", "positive"),
        ("[arm]\ngripper = 2", "-1 (closed) to 1"),
        ("[arm]\nsites = \"grasp\"", "[arm] sites is a list of names, and not \"grasp\""),
        ("[arm]\nleft_sites = [3]", "[arm] left_sites is a list of names"),
        ("[arm", "mine.toml"),
    ] {
        let error = Mapping::from_toml(text, "mine.toml").err().unwrap_or_else(|| panic!("{text} is taken"));
        assert!(matches!(error, TeleopError::Mapping { .. }));
        assert!(error.to_string().contains(says), "{text}: {error}");
    }
}
