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
use std::io::{ErrorKind, Read};

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
    /// The source of the bytes failed.
    Unreadable(ErrorKind),
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
            BinaryError::Unreadable(kind) => write!(f, "the compiled model cannot be read: {kind}"),
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
    mix_all(bytes.len() as u64, bytes)
}

/// Continues a digest; all pieces but the last are whole words.
fn mix_all(digest: u64, bytes: &[u8]) -> u64 {
    let mix = |h: u64, word: u64| {
        let h = (h ^ word).wrapping_mul(0x9e37_79b9_7f4a_7c15);
        h ^ (h >> 32)
    };
    let (words, rest) = bytes.as_chunks::<8>();
    let h = words.iter().fold(digest, |h, &word| mix(h, u64::from_le_bytes(word)));
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
        Model::read(&mut &bytes[..], bytes.len() as u64)
    }

    /// [`Model::from_bytes`] of the next `length` bytes of a source, which are not kept in memory.
    ///
    /// # Errors
    /// Those of `from_bytes`, and failures of the source.
    pub fn read(source: &mut dyn Read, length: u64) -> Result<Model, BinaryError> {
        let mut from = Reader::new(source, length)?;
        let mut m = Model::default();
        let read = read_content(&mut m, &mut from);
        // What is damaged may have any fault.
        from.verify()?;
        read?;
        check_consistency(&m).map_err(BinaryError::Inconsistent)?;
        check_model(&m).map_err(BinaryError::NotSimulated)?;
        Ok(m)
    }
}

fn read_content(m: &mut Model, from: &mut Reader) -> Result<(), BinaryError> {
    let mut name = Vec::new();
    let length = usize::try_from(u64::from_le_bytes(from.fixed()?)).map_err(|_| BinaryError::Length)?;
    from.array(&mut name, length, 1)?;
    m.name = String::from_utf8(name).map_err(|_| BinaryError::Name)?;
    for flag in [&mut m.flg_gravcomp, &mut m.flg_surfacevel, &mut m.flg_adhesion] {
        from.setting(flag)?;
    }
    read_sizes(m, from)?;
    m.opt.read(from)?;
    m.stat.read(from)?;
    m.vis.global.read(from)?;
    m.vis.quality.read(from)?;
    m.vis.headlight.read(from)?;
    m.vis.map.read(from)?;
    m.vis.scale.read(from)?;
    m.vis.rgba.read(from)?;
    m.read_arrays(from)?;
    if from.left() == 0 { Ok(()) } else { Err(BinaryError::Length) }
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

/// Sizes in order of declaration. Those of arrays are bounded by what follows when the arrays are read; the number of
/// mocap bodies here, since a row of keyframes multiplies it.
fn read_sizes(m: &mut Model, from: &mut Reader) -> Result<(), BinaryError> {
    let mut names = Vec::new();
    m.visit_sizes(&mut |name, _| names.push(name));
    for name in names {
        let size = i64::from_le_bytes(from.fixed()?);
        m.set_size(name, isize::try_from(size).map_err(|_| BinaryError::Length)? as usize);
    }
    if m.nmocap as u64 > from.left() / 4 {
        return Err(BinaryError::Length);
    }
    Ok(())
}

/// Bytes read from the source at a time; whole words.
const BLOCK: usize = 1 << 16;

/// Reads scalars one after another.
pub(crate) struct Reader<'a> {
    source: &'a mut dyn Read,
    /// Room for a block behind what is left of another; `used..end` was read and not used.
    block: Vec<u8>,
    used: usize,
    end: usize,
    /// Bytes of the content that the source still has.
    unread: u64,
    digest: u64,
    expected: u64,
}

impl<'a> Reader<'a> {
    /// Reads a header, which must fit the `length` of all.
    fn new(source: &'a mut dyn Read, length: u64) -> Result<Self, BinaryError> {
        let mut header = [0; HEADER];
        let whole = length >= HEADER as u64;
        let have = if whole { HEADER } else { length as usize };
        read_exact(source, &mut header[..have])?;
        if !is_model(&header[..have]) {
            return Err(BinaryError::NotAModel);
        }
        if !whole {
            return Err(BinaryError::Length);
        }
        if header[8..12] != VERSION.to_le_bytes() || header[12..20] != fingerprint().to_le_bytes() {
            return Err(BinaryError::Stale);
        }
        let unread = length - HEADER as u64;
        if header[20..28] != unread.to_le_bytes() {
            return Err(BinaryError::Length);
        }
        let expected = u64::from_le_bytes(std::array::from_fn(|i| header[28 + i]));
        let block = vec![0; 2 * BLOCK];
        Ok(Reader { source, block, used: 0, end: 0, unread, digest: unread, expected })
    }

    /// Bytes of the content that were not used.
    fn left(&self) -> u64 {
        self.unread + (self.end - self.used) as u64
    }

    /// Makes the next `size` bytes available, fewer than a block.
    fn need(&mut self, size: usize) -> Result<(), BinaryError> {
        if size as u64 > self.left() {
            return Err(BinaryError::Length);
        }
        if self.end - self.used < size {
            self.next_block()?;
        }
        Ok(())
    }

    /// Reads a block behind the bytes that were not used.
    fn next_block(&mut self) -> Result<(), BinaryError> {
        self.block.copy_within(self.used..self.end, 0);
        (self.end, self.used) = (self.end - self.used, 0);
        let size = self.unread.min(BLOCK as u64) as usize;
        let block = &mut self.block[self.end..self.end + size];
        read_exact(self.source, block)?;
        self.digest = mix_all(self.digest, block);
        self.unread -= size as u64;
        self.end += size;
        Ok(())
    }

    /// Reads to the end and compares the checksum.
    fn verify(&mut self) -> Result<(), BinaryError> {
        while self.unread > 0 {
            self.used = self.end;
            self.next_block()?;
        }
        if self.digest == self.expected { Ok(()) } else { Err(BinaryError::Checksum) }
    }

    fn fixed<const N: usize>(&mut self) -> Result<[u8; N], BinaryError> {
        self.need(N)?;
        let bytes = std::array::from_fn(|i| self.block[self.used + i]);
        self.used += N;
        Ok(bytes)
    }

    /// Reads a scalar or a short vector.
    pub(super) fn setting<S: Setting>(&mut self, setting: &mut S) -> Result<(), BinaryError> {
        self.need(S::BYTES)?;
        setting.read(&self.block[self.used..self.used + S::BYTES]);
        self.used += S::BYTES;
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
        let bytes = count.checked_mul(F::ROW_BYTES).ok_or(BinaryError::Length)?;
        if bytes as u64 > self.left() {
            return Err(BinaryError::Length);
        }
        field.restart(count);
        let mut missing = bytes;
        while missing > 0 {
            self.need(F::ROW_BYTES)?;
            let whole = (self.end - self.used) / F::ROW_BYTES * F::ROW_BYTES;
            let piece = whole.min(missing);
            field.append(&self.block[self.used..self.used + piece]);
            self.used += piece;
            missing -= piece;
        }
        Ok(())
    }
}

fn read_exact(source: &mut dyn Read, bytes: &mut [u8]) -> Result<(), BinaryError> {
    source.read_exact(bytes).map_err(|error| match error.kind() {
        ErrorKind::UnexpectedEof => BinaryError::Length,
        kind => BinaryError::Unreadable(kind),
    })
}
