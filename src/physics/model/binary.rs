//! The compiled model as bytes: what `robohive compile` writes and every command reads.
//!
//! | part | bytes | content |
//! |---|---|---|
//! | mark | 8 | [`MARK`] |
//! | version | 4 | [`VERSION`] of this layout |
//! | fingerprint | 8 | digest of the names, types and shapes of all fields |
//! | length | 8 | bytes of the content |
//! | checksum | 8 | [`checksum`] of the content |
//! | content | | name, flags, sizes, settings, arrays: scalars in order of declaration, little-endian |
//!
//! The tables of the fields are the schema, so a row added to them changes the fingerprint and older files are refused.

use super::options::Setting;
use super::{
    Model, Options, Statistic, VisualGlobal, VisualHeadlight, VisualMap, VisualQuality, VisualRgba,
    VisualScale,
};
use crate::consistency::{Inconsistent, check_consistency};
use crate::table::Field;
use crate::validity::{StepError, check_model};
use std::fmt;

/// The first bytes of a compiled model.
pub const MARK: [u8; 8] = *b"\x89RHmdl\r\n";
/// Version of the layout.
pub const VERSION: u32 = 1;
/// Bytes before the content.
const HEADER: usize = 36;

/// Why bytes are not a model.
#[derive(Clone, Debug, PartialEq)]
pub enum BinaryError {
    /// The bytes do not begin as a compiled model does.
    NotAModel,
    /// Another version of the layout, or another table of fields, wrote it.
    Stale,
    /// The content is shorter or longer than its header or its sizes say.
    Length,
    /// The content is not what was written.
    Checksum,
    /// The name of the model is not UTF-8.
    Name,
    /// The arrays contradict each other.
    Inconsistent(Inconsistent),
    /// The model uses a feature that is not simulated.
    NotSimulated(StepError),
}

impl fmt::Display for BinaryError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            BinaryError::NotAModel => write!(f, "not a compiled model"),
            BinaryError::Stale => {
                write!(
                    f,
                    "compiled by another version of robohive; compile it again: robohive compile MODEL.xml --out FILE"
                )
            }
            BinaryError::Length => write!(f, "the compiled model is cut off or too long; compile it again"),
            BinaryError::Checksum => write!(f, "the compiled model is damaged (checksum); compile it again"),
            BinaryError::Name => write!(f, "the name of the compiled model is not UTF-8"),
            BinaryError::Inconsistent(what) => write!(f, "the compiled model contradicts itself: {what}"),
            BinaryError::NotSimulated(what) => write!(f, "{what}"),
        }
    }
}

impl std::error::Error for BinaryError {}

/// True when `bytes` begin as a compiled model does, of whatever version.
pub fn is_model(bytes: &[u8]) -> bool {
    bytes.starts_with(&MARK)
}

/// Digest of 64 bits, by words of eight bytes. Each step is invertible, so bytes changed within one word always show.
pub fn checksum(bytes: &[u8]) -> u64 {
    let mix = |h: u64, word: u64| {
        let h = (h ^ word).wrapping_mul(0x9e37_79b9_7f4a_7c15);
        h ^ (h >> 32)
    };
    let (words, rest) = bytes.as_chunks::<8>();
    let h = words.iter().fold(bytes.len() as u64, |h, &word| mix(h, u64::from_le_bytes(word)));
    rest.iter().fold(h, |h, &byte| mix(h, u64::from(byte)))
}

/// Digest of the names, types and shapes of all fields.
fn fingerprint() -> u64 {
    let mut text = String::new();
    let mut line = |name: &str, kind: &str, shape: &str| {
        text.extend(name.chars().chain(":".chars()).chain(kind.chars()).chain(shape.chars()));
        text.push('\n');
    };
    Model::layout(&mut line);
    let mut setting = |name: &'static str, kind: &'static str| line(name, kind, "");
    Options::layout(&mut setting);
    Statistic::layout(&mut setting);
    VisualGlobal::layout(&mut setting);
    VisualQuality::layout(&mut setting);
    VisualHeadlight::layout(&mut setting);
    VisualMap::layout(&mut setting);
    VisualScale::layout(&mut setting);
    VisualRgba::layout(&mut setting);
    // How a compiler prints the tokens of a type is not part of the layout.
    text.retain(|c| c != ' ');
    checksum(text.as_bytes())
}

impl Model {
    /// The model as bytes, the same for the same model on every machine.
    pub fn to_bytes(&self) -> Vec<u8> {
        let mut out = vec![0; HEADER];
        out.extend((self.name.len() as u64).to_le_bytes());
        out.extend(self.name.as_bytes());
        out.extend([self.flg_gravcomp, self.flg_surfacevel, self.flg_adhesion].map(u8::from));
        self.visit_sizes(&mut |_, n| out.extend((n as isize as i64).to_le_bytes()));
        let mut setting = |_: &str, values: crate::table::Slice<'_>| values.write(&mut out);
        self.opt.visit(&mut setting);
        self.stat.visit(&mut setting);
        self.vis.global.visit(&mut setting);
        self.vis.quality.visit(&mut setting);
        self.vis.headlight.visit(&mut setting);
        self.vis.map.visit(&mut setting);
        self.vis.scale.visit(&mut setting);
        self.vis.rgba.visit(&mut setting);
        self.visit(&mut |_, _, values| values.write(&mut out));
        seal(&mut out);
        out
    }

    /// The model that [`Model::to_bytes`] made `bytes` of, bit for bit.
    ///
    /// # Errors
    /// Bytes of something else, of another version, damaged, or whose arrays contradict each other. No more memory
    /// is taken than the bytes fill.
    pub fn from_bytes(bytes: &[u8]) -> Result<Model, BinaryError> {
        let mut m = Model::default();
        let mut from = Reader { rest: content(bytes)? };
        let length = from.word()?;
        m.name = String::from_utf8(from.take(length, 1)?.to_vec()).map_err(|_| BinaryError::Name)?;
        for flag in [&mut m.flg_gravcomp, &mut m.flg_surfacevel, &mut m.flg_adhesion] {
            from.setting(flag)?;
        }
        read_sizes(&mut m, &mut from)?;
        m.opt.read(&mut from)?;
        m.stat.read(&mut from)?;
        m.vis.global.read(&mut from)?;
        m.vis.quality.read(&mut from)?;
        m.vis.headlight.read(&mut from)?;
        m.vis.map.read(&mut from)?;
        m.vis.scale.read(&mut from)?;
        m.vis.rgba.read(&mut from)?;
        m.read_arrays(&mut from)?;
        if !from.rest.is_empty() {
            return Err(BinaryError::Length);
        }
        check_consistency(&m).map_err(BinaryError::Inconsistent)?;
        check_model(&m).map_err(BinaryError::NotSimulated)?;
        Ok(m)
    }
}

/// Writes the header that fits the content of `bytes`, which begin with room for one.
pub fn seal(bytes: &mut [u8]) {
    let Some((header, content)) = bytes.split_at_mut_checked(HEADER) else { return };
    header[..8].copy_from_slice(&MARK);
    header[8..12].copy_from_slice(&VERSION.to_le_bytes());
    header[12..20].copy_from_slice(&fingerprint().to_le_bytes());
    header[20..28].copy_from_slice(&(content.len() as u64).to_le_bytes());
    header[28..36].copy_from_slice(&checksum(content).to_le_bytes());
}

/// What follows a header that fits.
fn content(bytes: &[u8]) -> Result<&[u8], BinaryError> {
    if !is_model(bytes) {
        return Err(BinaryError::NotAModel);
    }
    let (header, content) = bytes.split_at_checked(HEADER).ok_or(BinaryError::Length)?;
    if header[8..12] != VERSION.to_le_bytes() || header[12..20] != fingerprint().to_le_bytes() {
        return Err(BinaryError::Stale);
    }
    if header[20..28] != (content.len() as u64).to_le_bytes() {
        return Err(BinaryError::Length);
    }
    if header[28..36] != checksum(content).to_le_bytes() {
        return Err(BinaryError::Checksum);
    }
    Ok(content)
}

/// Sizes in order of declaration. Those of arrays are bounded by what follows when the arrays are read; the number of
/// mocap bodies here, since a row of keyframes multiplies it.
fn read_sizes(m: &mut Model, from: &mut Reader<'_>) -> Result<(), BinaryError> {
    let mut names = Vec::new();
    m.visit_sizes(&mut |name, _| names.push(name));
    for name in names {
        let size = i64::from_le_bytes(from.fixed()?);
        m.set_size(name, isize::try_from(size).map_err(|_| BinaryError::Length)? as usize);
    }
    if m.nmocap > from.rest.len() / 4 {
        return Err(BinaryError::Length);
    }
    Ok(())
}

/// Reads scalars one after another.
pub(crate) struct Reader<'a> {
    rest: &'a [u8],
}

impl<'a> Reader<'a> {
    /// The next `count` items of `size` bytes.
    fn take(&mut self, count: usize, size: usize) -> Result<&'a [u8], BinaryError> {
        let bytes = count.checked_mul(size).ok_or(BinaryError::Length)?;
        let (taken, rest) = self.rest.split_at_checked(bytes).ok_or(BinaryError::Length)?;
        self.rest = rest;
        Ok(taken)
    }

    fn fixed<const N: usize>(&mut self) -> Result<[u8; N], BinaryError> {
        let (taken, rest) = self.rest.split_first_chunk().ok_or(BinaryError::Length)?;
        self.rest = rest;
        Ok(*taken)
    }

    fn word(&mut self) -> Result<usize, BinaryError> {
        usize::try_from(u64::from_le_bytes(self.fixed()?)).map_err(|_| BinaryError::Length)
    }

    /// Reads a scalar or a short vector.
    pub(super) fn setting<S: Setting>(&mut self, setting: &mut S) -> Result<(), BinaryError> {
        setting.read(self.take(1, S::BYTES)?);
        Ok(())
    }

    /// Reads an array of `rows` times `width` rows of fixed columns.
    pub(super) fn array<F: Field>(
        &mut self,
        field: &mut F,
        rows: usize,
        width: usize,
    ) -> Result<(), BinaryError> {
        let count = rows.checked_mul(width).ok_or(BinaryError::Length)?;
        field.read(self.take(count, F::ROW_BYTES)?);
        Ok(())
    }
}
