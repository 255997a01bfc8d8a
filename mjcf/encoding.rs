//! What bytes are that should be text and are not.

use physics::model::binary;

/// Files that are often taken for others, by what they begin with.
const BEGINNINGS: [(&[u8], &str); 8] = [
    (b"\x89PNG", "a PNG image"),
    (b"\xff\xd8\xff", "a JPEG image"),
    (b"GIF8", "a GIF image"),
    (b"%PDF", "a PDF document"),
    (b"PK\x03\x04", "a zip archive"),
    (b"\x1f\x8b", "compressed with gzip"),
    (b"7z\xbc\xaf", "a 7z archive"),
    (b"glTF", "a binary glTF scene"),
];

/// What bytes are that cannot be text in UTF-8: by what they begin with, their byte order mark, or the zero bytes among
/// them.
pub(crate) fn foreign(bytes: &[u8]) -> Option<&'static str> {
    if binary::is_model(bytes) {
        return Some("a compiled model");
    }
    if let Some((_, what)) = BEGINNINGS.iter().find(|(beginning, _)| bytes.starts_with(beginning)) {
        return Some(what);
    }
    let wide = |at: usize| bytes.iter().skip(at).step_by(2).take(32).all(|&b| b == 0) && bytes.len() > 1;
    match bytes {
        [0xff, 0xfe, 0, 0, ..] | [0, 0, 0xfe, 0xff, ..] => Some("text in UTF-32"),
        [0xff, 0xfe, ..] | [0xfe, 0xff, ..] => Some("text in UTF-16"),
        _ if !bytes.contains(&0) => None,
        _ if nul(bytes).is_some() => Some("text with a NUL in it"),
        _ if wide(0) != wide(1) => Some("text in UTF-16"),
        _ => Some("binary"),
    }
}

/// The first NUL of what is text apart from that; `None` for anything else.
pub(crate) fn nul(bytes: &[u8]) -> Option<usize> {
    let first = bytes.iter().position(|&byte| byte == 0)?;
    let zeros = bytes.iter().filter(|&&byte| byte == 0).count();
    let is_control = |byte: &u8| byte.is_ascii_control() && !b"\t\n\x0c\r\0".contains(byte);
    // Every other byte of English text in UTF-16 is zero.
    let wide = bytes.len() >= 4 && 3 * zeros >= bytes.len();
    let is_text = !wide && !bytes.iter().any(is_control) && std::str::from_utf8(bytes).is_ok();
    is_text.then_some(first)
}

/// What MuJoCo stores its arrays after: a number of its own, and the size of its own.
const MJB: &[u8] = b"\x31\xd4\x00\x00\x08\x00\x00\x00";

/// Formats of models that are not read, by what they begin with, and what to do instead.
const REFUSED: [(&[u8], &str); 3] = [
    (
        MJB,
        "this is MJB, arrays of one version of MuJoCo, which is not read: load the MJCF it was made of, or have MuJoCo \
         write MJCF with mj_saveLastXML; `robohive compile` makes files that load as quickly",
    ),
    (b"#usda", "this is OpenUSD, which is not read: convert it to MJCF with a program that reads USD"),
    (b"PXR-USDC", "this is OpenUSD, which is not read: convert it to MJCF with a program that reads USD"),
];

/// Why a model in another format than MJCF or URDF is refused.
pub(crate) fn refused(bytes: &[u8]) -> Option<&'static str> {
    REFUSED.iter().find(|(beginning, _)| bytes.starts_with(beginning)).map(|(_, why)| *why)
}
