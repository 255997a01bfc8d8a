//! Members of groups: link messages, and the symbol tables of old files.

use super::bytes::{Cursor, Source};
use super::encode::{UNDEFINED, kind};
use super::error::Decoded;
use super::header::Message;
use super::heap;

/// What a name in a group leads to.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Member {
    /// The object whose header is at this address.
    Object(u64),
    /// The object of this path, by a soft link.
    Soft(String),
    /// Another file.
    External,
}

/// Names and members of the group whose header holds `messages`, in the order of the file; nothing for what is no group.
///
/// # Errors
/// The file is damaged, or keeps its links in a way that is not read.
pub fn members(source: &Source, messages: &[Message]) -> Decoded<Option<Vec<(String, Member)>>> {
    let mut group = false;
    let mut out = Vec::new();
    for message in messages {
        let mut at = Cursor(&message.data);
        match message.kind {
            kind::SYMBOL_TABLE => {
                group = true;
                let (tree, heap) = (at.long()?, at.long()?);
                symbol_table(source, tree, &heap::local(source, heap)?, &mut out)?;
            }
            kind::LINK_INFO => {
                group = true;
                at.byte()?;
                let flags = at.byte()?;
                at.take(if flags & 1 == 0 { 0 } else { 8 })?;
                if at.long()? != UNDEFINED {
                    return Err(
                        "a group with dense links (libver=\"latest\", more than eight members) is not read: \
                        write the file with h5py's default libver"
                            .into(),
                    );
                }
            }
            kind::LINK => {
                group = true;
                out.push(link(at)?);
            }
            _ => {}
        }
    }
    Ok(group.then_some(out))
}

fn link(mut at: Cursor<'_>) -> Decoded<(String, Member)> {
    at.byte()?;
    let flags = at.byte()?;
    let form = if flags & 8 == 0 { 0 } else { at.byte()? };
    at.take(if flags & 4 == 0 { 0 } else { 8 } + if flags & 16 == 0 { 0 } else { 1 })?;
    let length = at.number(1 << (flags & 3))?;
    let name = text(at.take(usize::try_from(length).map_err(|e| e.to_string())?)?);
    let member = match form {
        0 => Member::Object(at.long()?),
        1 => {
            let length = at.short()?;
            Member::Soft(text(at.take(length)?))
        }
        _ => Member::External,
    };
    Ok((name, member))
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

/// Appends what the tree of an old group leads to. `heap` holds the names.
fn symbol_table(source: &Source, tree: u64, heap: &[u8], out: &mut Vec<(String, Member)>) -> Decoded<()> {
    let mut room = Room::of(source);
    let mut nodes = vec![(tree, None)];
    while let Some((address, level)) = nodes.pop() {
        let node = TreeNode::read(source, address, level, 8)?;
        room.spend(node.children.len() as u64)?;
        if node.level == 0 {
            node.children
                .iter()
                .try_for_each(|child| symbols(source, child.address, heap, &mut room, out))?;
        } else {
            // The last first, since the next one is taken from the end.
            let below = Some(node.level - 1);
            nodes.extend(node.children.iter().rev().map(|child| (child.address, below)));
        }
    }
    Ok(())
}

fn symbols(
    source: &Source,
    address: u64,
    heap: &[u8],
    room: &mut Room,
    out: &mut Vec<(String, Member)>,
) -> Decoded<()> {
    let head = source.signed(b"SNOD", address, 8)?;
    let count = Cursor(&head[2..]).number(2)?;
    room.spend(count)?;
    let table = source.read(address + 8, 40 * count)?;
    for entry in table.as_chunks::<40>().0 {
        let mut at = Cursor(entry);
        let (offset, header, cached) = (at.long()?, at.long()?, at.number(4)?);
        at.number(4)?;
        let target = at.number(4)?;
        let member =
            if cached == 2 { Member::Soft(heap::name(heap, target)?) } else { Member::Object(header) };
        out.push((heap::name(heap, offset)?, member));
    }
    Ok(())
}

/// A node of a tree of version 1.
pub struct TreeNode {
    /// Zero above the leaves.
    pub level: u8,
    /// What is below it, in order.
    pub children: Vec<Child>,
}

/// A child of a node.
pub struct Child {
    /// The key before it.
    pub key: Vec<u8>,
    /// Where it is.
    pub address: u64,
}

impl TreeNode {
    /// The node at `address`, which must have this level, where one is given. Keys have `key` bytes.
    ///
    /// # Errors
    /// There is no such node.
    pub fn read(source: &Source, address: u64, level: Option<u8>, key: usize) -> Decoded<Self> {
        let head = source.signed(b"TREE", address, 24)?;
        let (found, count) = (head[1], Cursor(&head[2..]).number(2)?);
        if level.is_some_and(|level| level != found) {
            return Err(format!("the tree node at {address} has the wrong level: the file is damaged"));
        }
        let body = source.read(address + 24, count * (key as u64 + 8))?;
        let mut at = Cursor(&body);
        let mut children = Vec::new();
        for _ in 0..count {
            children.push(Child { key: at.take(key)?.to_vec(), address: at.long()? });
        }
        Ok(TreeNode { level: found, children })
    }
}

/// How many more nodes and members can be read from a file: each takes at least eight bytes and is read once, so that
/// trees that lead in circles end.
pub struct Room(u64);

impl Room {
    /// Room for as many as the file has bytes for.
    pub fn of(source: &Source) -> Self {
        Room(source.length() / 8)
    }

    /// Takes room for nodes and members that are read.
    ///
    /// # Errors
    /// The file cannot have so many.
    pub fn spend(&mut self, count: u64) -> Decoded<()> {
        self.0 = self.0.checked_sub(count).ok_or("a tree leads in circles: the file is damaged")?;
        Ok(())
    }
}
