//! The compiled model as bytes: what `robohive compile` writes and every command reads.
//!
//! | part | bytes | content |
//! |---|---|---|
//! | mark | 8 | [`MARK`] |
//! | version | 4 | [`VERSION`] of this layout |
//! | fingerprint | 8 | digest of the names, types and shapes of all fields |
//! | length | 8 | bytes of the content |
//! | checksum | 8 | [`checksum`] of the content |
//! | content | | name, plugins of instances by name, flags, sizes, settings, arrays: scalars in order of declaration, little-endian |
//!
//! Zeros fill up each array, and what stands before the first, to whole words of eight bytes.
//!
//! The tables of the fields are the schema, so a row added to them changes the fingerprint and older files are refused.
//!
//! ```
//! use robohive_physics::Model;
//!
//! let model = robohive_mjcf::load_str("<mujoco><worldbody><geom name='g' size='.1'/></worldbody></mujoco>")?.model;
//! let bytes = model.to_bytes();
//! let again = Model::from_bytes(&bytes)?;
//! assert!(again.geom("g").is_some() && again.to_bytes() == bytes);
//! assert!(Model::from_bytes(&bytes[1..]).is_err());
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

pub use crate::arrays::reader::checksum;

use crate::arrays::reader::{ReadError, Reader, WORD, read_exact, sum};
use crate::consistency::{Inconsistent, check_consistency};
use crate::model::{
    Arrays, Model, NotSimulated, Options, PluginError, Registry, Statistic, VisualGlobal, VisualHeadlight,
    VisualMap, VisualQuality, VisualRgba, VisualScale,
};
use crate::pipeline::validity::check_model;
use std::fmt;
use std::io::{ErrorKind, Read, Write};

/// The first bytes of a compiled model.
pub const MARK: [u8; 8] = *b"\x89RHmdl\r\n";
/// Version of the layout.
pub const VERSION: u32 = 3;
/// Bytes before the content.
const HEADER: usize = 36;

/// Why bytes are not a model.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
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
    /// The setting of this name has an unknown code.
    Setting(&'static str),
    /// The arrays contradict each other.
    Inconsistent(Inconsistent),
    /// The model uses a feature that is not simulated.
    NotSimulated(NotSimulated),
    /// The model uses a plugin of this name, which is not registered.
    UnknownPlugin(String),
    /// A plugin refuses its instance.
    Plugin(PluginError),
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
            BinaryError::Setting(name) => {
                write!(f, "the option {name} of the compiled model has an unknown value; compile it again")
            }
            BinaryError::Inconsistent(what) => write!(f, "the compiled model contradicts itself: {what}"),
            BinaryError::NotSimulated(what) => write!(f, "{what}"),
            BinaryError::UnknownPlugin(name) => {
                write!(
                    f,
                    "the compiled model needs the plugin '{name}': register it before reading the model"
                )
            }
            BinaryError::Plugin(what) => write!(f, "{what}"),
        }
    }
}

impl std::error::Error for BinaryError {}

impl From<ReadError> for BinaryError {
    fn from(error: ReadError) -> Self {
        match error {
            ReadError::Unreadable(kind) => BinaryError::Unreadable(kind),
            ReadError::Length => BinaryError::Length,
            ReadError::Setting(name) => BinaryError::Setting(name),
        }
    }
}

/// True when `bytes` begin as a compiled model does, of whatever version.
pub fn is_model(bytes: &[u8]) -> bool {
    bytes.starts_with(&MARK)
}

/// Digest of the names, types and shapes of all fields (FNV-1a). How a compiler prints the tokens of a type is not part
/// of the layout.
const FINGERPRINT: u64 = {
    let tables = [
        Arrays::LAYOUT,
        Options::LAYOUT,
        Statistic::LAYOUT,
        VisualGlobal::LAYOUT,
        VisualQuality::LAYOUT,
        VisualHeadlight::LAYOUT,
        VisualMap::LAYOUT,
        VisualScale::LAYOUT,
        VisualRgba::LAYOUT,
    ];
    let mut digest: u64 = 0xcbf2_9ce4_8422_2325;
    let mut table = 0;
    while table < tables.len() {
        let mut rest = tables[table].as_bytes();
        while let [byte, tail @ ..] = rest {
            if *byte != b' ' {
                digest = (digest ^ *byte as u64).wrapping_mul(0x0100_0000_01b3);
            }
            rest = tail;
        }
        table += 1;
    }
    digest
};

impl Model {
    /// The model as bytes, the same for the same model on every machine.
    pub fn to_bytes(&self) -> Vec<u8> {
        let mut out = vec![0; HEADER];
        self.content(&mut |bytes| out.extend_from_slice(bytes));
        seal(&mut out);
        out
    }

    /// Writes [`Model::to_bytes`] piece by piece.
    ///
    /// # Errors
    /// Those of `out`.
    pub fn write(&self, out: &mut dyn Write) -> std::io::Result<()> {
        let (mut length, mut digest) = (0, 0);
        self.content(&mut |bytes| {
            digest = sum(length / WORD as u64, bytes).wrapping_add(digest);
            length += bytes.len() as u64;
        });
        out.write_all(&header(length, digest))?;
        let mut written = Ok(());
        self.content(&mut |bytes| {
            if written.is_ok() {
                written = out.write_all(bytes);
            }
        });
        written
    }

    /// Hands out the content in pieces of whole words.
    fn content(&self, out: &mut dyn FnMut(&[u8])) {
        let mut head = Vec::new();
        head.extend((self.name.len() as u64).to_le_bytes());
        head.extend(self.name.as_bytes());
        let plugins: Vec<&str> = self.plugins().names().collect();
        let plugins = plugins.join("\0");
        head.extend((plugins.len() as u64).to_le_bytes());
        head.extend(plugins.as_bytes());
        self.visit_flags(&mut |_, flag| head.push(u8::from(flag)));
        self.visit_sizes(&mut |_, n| head.extend((n as isize as i64).to_le_bytes()));
        let mut setting = |_: &str, values: crate::table::Slice<'_>| {
            values.pieces(&mut |bytes| head.extend_from_slice(bytes));
        };
        self.opt.visit(&mut setting);
        self.stat.visit(&mut setting);
        self.vis.visit(&mut |_, name, values| setting(name, values));
        head.resize(head.len().next_multiple_of(WORD), 0);
        out(&head);
        self.visit(&mut |_, _, values| {
            values.pieces(&mut |bytes| match bytes.len() % WORD {
                0 => out(bytes),
                over => out(&[bytes, &[0; WORD][over..]].concat()),
            });
        });
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
        Model::read_with(source, length, &Registry::default())
    }

    /// [`Model::read`] of a model whose plugins are in `registry`.
    ///
    /// # Errors
    /// Those of `read`; a plugin that is not registered.
    pub fn read_with(source: &mut dyn Read, length: u64, registry: &Registry) -> Result<Model, BinaryError> {
        Model::read_parts(source, length, None, registry)
    }

    /// [`Model::read`] where `again` opens the source again at an offset in bytes from the start of the model: two
    /// threads then read a large one.
    ///
    /// # Errors
    /// Those of `read`.
    pub fn read_parts(
        source: &mut dyn Read,
        length: u64,
        again: Option<Again<'_>>,
        registry: &Registry,
    ) -> Result<Model, BinaryError> {
        let (mut from, expected) = open(source, length)?;
        let mut m = Arrays::default();
        let read = read_head(&mut m, &mut from).and_then(|Head { arrays, plugins }| {
            match again {
                Some(again) if from.left() > LARGE => read_halves(&mut m, &mut from, again, &arrays)?,
                _ => m.read_arrays(&mut from, 0..arrays.len())?,
            }
            Ok(plugins)
        });
        if let Err(BinaryError::Unreadable(kind)) = read {
            return Err(BinaryError::Unreadable(kind));
        }
        // What is damaged may have any other fault.
        from.drain()?;
        if from.digest != expected {
            return Err(BinaryError::Checksum);
        }
        let plugins = read?;
        check_consistency(&m).map_err(BinaryError::Inconsistent)?;
        m.plugin = slots(&plugins, &m, registry)?.into();
        let mut m = Model::unchecked(m);
        check_model(&m).map_err(BinaryError::NotSimulated)?;
        m.start_plugins(registry).map_err(BinaryError::Plugin)?;
        Ok(m)
    }
}

/// A reader of the content behind a header, which must fit the `length` of all, and the digest that the content must have.
fn open(source: &mut dyn Read, length: u64) -> Result<(Reader<'_>, u64), BinaryError> {
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
    if header[8..12] != VERSION.to_le_bytes() || header[12..20] != FINGERPRINT.to_le_bytes() {
        return Err(BinaryError::Stale);
    }
    let content = length - HEADER as u64;
    if header[20..28] != content.to_le_bytes() {
        return Err(BinaryError::Length);
    }
    let expected = u64::from_le_bytes(std::array::from_fn(|i| header[28 + i]));
    Ok((Reader::part(source, 0, content), expected))
}

/// Where the plugins of these names, one an instance, are in `registry`.
fn slots(names: &str, m: &Arrays, registry: &Registry) -> Result<Vec<i32>, BinaryError> {
    let names: Vec<&str> = names.split('\0').filter(|name| !name.is_empty()).collect();
    if names.len() != m.nplugin {
        return Err(BinaryError::Length);
    }
    let slot = |name: &&str| match registry.slot(name) {
        Some(slot) => Ok(slot as i32),
        None => Err(BinaryError::UnknownPlugin((*name).to_owned())),
    };
    names.iter().map(slot).collect()
}

/// Opens a source again, at an offset.
pub type Again<'a> = &'a (dyn Fn(u64) -> std::io::Result<Box<dyn Read>> + Sync);

/// More bytes are worth a second thread.
pub const LARGE: u64 = 1 << 20;

/// Reads arrays of the given lengths in bytes on two threads, about half of the bytes on each.
fn read_halves(
    m: &mut Arrays,
    from: &mut Reader,
    again: Again<'_>,
    arrays: &[u64],
) -> Result<(), BinaryError> {
    let (mut first, mut before) = (0, 0);
    for bytes in arrays {
        if before + bytes / 2 > from.left() / 2 && before > from.ahead() {
            break;
        }
        (first, before) = (first + 1, before + bytes);
    }
    let start = from.length - from.left() + before;
    let rest = from.give(start);
    let mut tail = m.clone();
    let (head, second) = std::thread::scope(|scope| {
        let second = scope.spawn(|| {
            let mut source =
                again(HEADER as u64 + start).map_err(|error| BinaryError::Unreadable(error.kind()))?;
            let mut from = Reader::part(&mut *source, start, rest);
            let read = tail.read_arrays(&mut from, first..arrays.len());
            from.drain()?;
            Ok::<_, BinaryError>((read, from.digest))
        });
        (m.read_arrays(from, 0..first), second.join())
    });
    let (read, digest) = second.unwrap_or_else(|panic| std::panic::resume_unwind(panic))?;
    from.digest = from.digest.wrapping_add(digest);
    m.take_arrays(&mut tail, first);
    head.and(read).map_err(BinaryError::from)
}

/// What stands before the arrays, beside sizes and settings.
struct Head {
    /// Bytes of each array.
    arrays: Vec<u64>,
    /// Names of the plugins of all instances, with a zero byte between two.
    plugins: String,
}

/// A text behind its length.
fn read_text(from: &mut Reader) -> Result<String, BinaryError> {
    let mut text = Vec::new();
    let length = usize::try_from(u64::from_le_bytes(from.fixed()?)).map_err(|_| BinaryError::Length)?;
    if length as u64 > from.left() {
        return Err(BinaryError::Length);
    }
    from.rows(&mut text, length)?;
    String::from_utf8(text).map_err(|_| BinaryError::Name)
}

/// Reads all before the arrays, whose bytes must add up to the rest.
fn read_head(m: &mut Arrays, from: &mut Reader) -> Result<Head, BinaryError> {
    m.name = read_text(from)?;
    let plugins = read_text(from)?;
    for flag in [&mut m.flg_gravcomp, &mut m.flg_surfacevel, &mut m.flg_adhesion] {
        from.setting("flag", flag)?;
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
    from.align()?;
    let arrays = m.array_bytes().ok_or(BinaryError::Length)?;
    let total = arrays.iter().try_fold(0_u64, |total, &bytes| total.checked_add(bytes));
    if total == Some(from.left()) { Ok(Head { arrays, plugins }) } else { Err(BinaryError::Length) }
}

/// Writes the header that fits the content of `bytes`, which begin with room for one.
pub fn seal(bytes: &mut [u8]) {
    let Some((header, content)) = bytes.split_at_mut_checked(HEADER) else { return };
    header.copy_from_slice(&self::header(content.len() as u64, checksum(content)));
}

fn header(length: u64, checksum: u64) -> [u8; HEADER] {
    let mut header = [0; HEADER];
    header[..8].copy_from_slice(&MARK);
    header[8..12].copy_from_slice(&VERSION.to_le_bytes());
    header[12..20].copy_from_slice(&FINGERPRINT.to_le_bytes());
    header[20..28].copy_from_slice(&length.to_le_bytes());
    header[28..36].copy_from_slice(&checksum.to_le_bytes());
    header
}

/// Sizes in order of declaration. Those of arrays are bounded by what follows when the arrays are read; the number of
/// mocap bodies here, since a row of keyframes multiplies it.
fn read_sizes(m: &mut Arrays, from: &mut Reader) -> Result<(), BinaryError> {
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
