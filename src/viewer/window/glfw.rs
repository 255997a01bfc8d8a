//! Keys by GLFW's numbers, as MuJoCo's viewer hands them to programs: those of a key's place on an American keyboard.

use eframe::egui::Key;

/// Keys without a letter, with their numbers.
const NAMED: [(Key, i32); 36] = [
    (Key::Space, 32),
    (Key::Quote, 39),
    (Key::Comma, 44),
    (Key::Minus, 45),
    (Key::Period, 46),
    (Key::Slash, 47),
    (Key::Semicolon, 59),
    (Key::Equals, 61),
    (Key::Plus, 61),
    (Key::OpenBracket, 91),
    (Key::Backslash, 92),
    (Key::CloseBracket, 93),
    (Key::Backtick, 96),
    (Key::Escape, 256),
    (Key::Enter, 257),
    (Key::Tab, 258),
    (Key::Backspace, 259),
    (Key::Insert, 260),
    (Key::Delete, 261),
    (Key::ArrowRight, 262),
    (Key::ArrowLeft, 263),
    (Key::ArrowDown, 264),
    (Key::ArrowUp, 265),
    (Key::PageUp, 266),
    (Key::PageDown, 267),
    (Key::Home, 268),
    (Key::End, 269),
    (Key::CapsLock, 280),
    (Key::ShiftLeft, 340),
    (Key::ControlLeft, 341),
    (Key::AltLeft, 342),
    (Key::SuperLeft, 343),
    (Key::ShiftRight, 344),
    (Key::ControlRight, 345),
    (Key::AltRight, 346),
    (Key::SuperRight, 347),
];

/// The number of F1.
const F1: i32 = 290;

/// The number of a key; `None` for one that GLFW does not know.
pub fn code(key: Key) -> Option<i32> {
    let name = key.name();
    let letter = name.bytes().next().filter(|byte| name.len() == 1 && byte.is_ascii_alphanumeric());
    let function = name.strip_prefix('F').and_then(|number| number.parse::<i32>().ok());
    let named = || NAMED.iter().find(|(own, _)| *own == key).map(|(_, code)| *code);
    letter
        .map(i32::from)
        .or_else(|| function.filter(|number| (1..=25).contains(number)).map(|number| F1 + number - 1))
        .or_else(named)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn keys_have_the_numbers_of_glfw() {
        let expected =
            [(Key::A, 65), (Key::Z, 90), (Key::Num0, 48), (Key::Num9, 57), (Key::F1, 290), (Key::F12, 301)];
        assert!(expected.iter().all(|(key, number)| code(*key) == Some(*number)));
        assert_eq!((code(Key::F), code(Key::F25), code(Key::Space)), (Some(70), Some(314), Some(32)));
        assert_eq!((code(Key::ArrowRight), code(Key::Eject)), (Some(262), None));
    }
}
