//! The stack machine that a pickle is a program for.

use super::error::PickleError;
use super::graph::{Id, Node, Object, Pickle};
use super::input::Input;
use std::collections::HashMap;

/// Most values that a pickle may build.
pub const MAX_VALUES: usize = 1 << 24;

/// The opcode that names the protocol.
const PROTOCOL: u8 = 0x80;

impl<'a> Pickle<'a> {
    /// Reads a pickle that fills all of `bytes`.
    ///
    /// # Errors
    /// The pickle is malformed, truncated or too large, or uses a protocol or opcode that is not supported.
    pub fn parse(bytes: &'a [u8]) -> Result<Self, PickleError> {
        let (pickle, rest) = Self::parse_prefix(bytes)?;
        if rest.is_empty() {
            return Ok(pickle);
        }
        let end = bytes.len() - rest.len();
        Err(PickleError::at(end, format!("the pickle ends here, and {} more bytes follow", rest.len())))
    }

    /// Reads the pickle at the beginning of `bytes`, and returns what follows it.
    ///
    /// # Errors
    /// As [`Pickle::parse`], more bytes aside.
    pub fn parse_prefix(bytes: &'a [u8]) -> Result<(Self, &'a [u8]), PickleError> {
        run(bytes)
    }
}

/// Builds the values of the pickle at the beginning of `bytes`, and returns what follows it.
fn run(bytes: &[u8]) -> Result<(Pickle<'_>, &[u8]), PickleError> {
    let mut machine = Machine {
        input: Input::new(bytes),
        nodes: Vec::new(),
        stack: Vec::new(),
        marks: Vec::new(),
        memo: HashMap::new(),
        opcode_at: 0,
    };
    loop {
        machine.opcode_at = machine.input.position();
        let opcode = machine.input.byte()?;
        if machine.opcode_at == 0 && opcode != PROTOCOL {
            return Err(
                machine.wrong("this is no pickle of protocol 2 to 5, all of which begin with their protocol")
            );
        }
        if opcode == b'.' {
            break;
        }
        machine.execute(opcode)?;
    }
    if !machine.marks.is_empty() || machine.stack.len() != 1 {
        let message = format!("the pickle should end with one value, and {} are left", machine.stack.len());
        return Err(machine.wrong(message));
    }
    let root = machine.stack[0];
    Ok((Pickle { input: bytes, nodes: machine.nodes, root }, machine.input.rest()))
}

struct Machine<'a> {
    input: Input<'a>,
    nodes: Vec<Node>,
    stack: Vec<Id>,
    /// Heights of the stack at which groups of values begin.
    marks: Vec<usize>,
    memo: HashMap<u32, Id>,
    /// Where the opcode being executed stands.
    opcode_at: usize,
}

impl Machine<'_> {
    fn wrong(&self, message: impl Into<String>) -> PickleError {
        PickleError::at(self.opcode_at, message)
    }

    fn push(&mut self, node: Node) -> Result<(), PickleError> {
        if self.nodes.len() >= MAX_VALUES {
            return Err(self.wrong(format!("the pickle builds more than {MAX_VALUES} values")));
        }
        self.stack.push(self.nodes.len() as Id);
        self.nodes.push(node);
        Ok(())
    }

    /// Takes the topmost value, which belongs to the innermost group.
    fn pop(&mut self) -> Result<Id, PickleError> {
        let floor = self.marks.last().copied().unwrap_or(0);
        if self.stack.len() <= floor {
            return Err(self.wrong("the opcode takes a value, and there is none"));
        }
        let id = self.stack[self.stack.len() - 1];
        self.stack.truncate(self.stack.len() - 1);
        Ok(id)
    }

    fn top(&mut self) -> Result<Id, PickleError> {
        let id = self.pop()?;
        self.stack.push(id);
        Ok(id)
    }

    /// Takes the values of the innermost group.
    fn group(&mut self) -> Result<Vec<Id>, PickleError> {
        let mark = self.marks.pop().ok_or_else(|| self.wrong("the opcode ends a group, and none began"))?;
        Ok(self.stack.split_off(mark))
    }

    /// Executes one opcode, the last one aside.
    fn execute(&mut self, opcode: u8) -> Result<(), PickleError> {
        match opcode {
            PROTOCOL => self.protocol(),
            // A frame only says how much to read at once.
            0x95 => self.input.span(8).map(drop),
            b'(' => {
                self.marks.push(self.stack.len());
                Ok(())
            }
            b'0' => self.pop().map(drop),
            b'1' => self.group().map(drop),
            b'2' => {
                let id = self.top()?;
                self.stack.push(id);
                Ok(())
            }
            b'N' | 0x88 | 0x89 | b'J' | b'K' | b'M' | b'G' | 0x8a | 0x8b => self.number(opcode),
            b'C' | b'B' | 0x8e | 0x96 | b'U' | b'T' | 0x8c | b'X' | 0x8d => self.string(opcode),
            b']' | b'l' | b'a' | b'e' | b')' | b't' | 0x85..=0x87 => self.sequence(opcode),
            b'}' | b'd' | b's' | b'u' | 0x8f | 0x90 | 0x91 => self.mapping(opcode),
            b'q' | b'r' | 0x94 | b'h' | b'j' => self.remember(opcode),
            b'c' | 0x93 | b'R' | 0x81 | 0x92 | b'b' | b'Q' => self.object(opcode),
            _ => {
                let shown = char::from(opcode).escape_default();
                Err(self.wrong(format!(
                    "opcode {opcode:#04x} ({shown}) is not supported; opcodes of protocols 2 to 5 that pickles of \
                     arrays and models use are"
                )))
            }
        }
    }

    fn protocol(&mut self) -> Result<(), PickleError> {
        let protocol = self.input.byte()?;
        if !(2..=5).contains(&protocol) {
            return Err(self.wrong(format!("protocol {protocol} is not read; 2 to 5 are read")));
        }
        Ok(())
    }

    fn number(&mut self, opcode: u8) -> Result<(), PickleError> {
        let node = match opcode {
            b'N' => Node::None,
            0x88 => Node::Bool(true),
            0x89 => Node::Bool(false),
            b'J' => Node::Int(i32::from_le_bytes(self.input.array()?).into()),
            b'K' => Node::Int(self.input.byte()?.into()),
            b'M' => Node::Int(u16::from_le_bytes(self.input.array()?).into()),
            b'G' => Node::Float(f64::from_be_bytes(self.input.array()?)),
            _ => {
                let span =
                    if opcode == 0x8a { self.input.counted::<1>()? } else { self.input.counted::<4>()? };
                self.input.integer(&span).map_or(Node::Long(span), Node::Int)
            }
        };
        self.push(node)
    }

    fn string(&mut self, opcode: u8) -> Result<(), PickleError> {
        let span = match opcode {
            b'C' | b'U' | 0x8c => self.input.counted::<1>()?,
            b'B' | b'T' | b'X' => self.input.counted::<4>()?,
            _ => self.input.counted::<8>()?,
        };
        let text = matches!(opcode, 0x8c | b'X' | 0x8d);
        let node = if text { Node::Text(self.input.text(span)?) } else { Node::Bytes(span) };
        self.push(node)
    }

    fn sequence(&mut self, opcode: u8) -> Result<(), PickleError> {
        let node = match opcode {
            b']' => Node::List(Vec::new()),
            b')' => Node::Tuple(Vec::new()),
            b'l' => Node::List(self.group()?),
            b't' => Node::Tuple(self.group()?),
            b'a' => {
                let item = self.pop()?;
                return self.extend(vec![item]);
            }
            b'e' => {
                let items = self.group()?;
                return self.extend(items);
            }
            _ => {
                let mut items = Vec::new();
                for _ in 0..opcode - 0x84 {
                    items.insert(0, self.pop()?);
                }
                Node::Tuple(items)
            }
        };
        self.push(node)
    }

    /// Appends to the list or set on top.
    fn extend(&mut self, mut added: Vec<Id>) -> Result<(), PickleError> {
        let target = self.top()?;
        match &mut self.nodes[target as usize] {
            Node::List(items) | Node::Set(items) => items.append(&mut added),
            Node::Object(object) => object.items.append(&mut added),
            _ => return Err(self.wrong("values are appended to something that is no list")),
        }
        Ok(())
    }

    fn mapping(&mut self, opcode: u8) -> Result<(), PickleError> {
        match opcode {
            b'}' => self.push(Node::Dict(Vec::new())),
            b'd' => {
                let group = self.group()?;
                let entries = self.pairs(&group)?;
                self.push(Node::Dict(entries))
            }
            0x8f => self.push(Node::Set(Vec::new())),
            0x91 => {
                let items = self.group()?;
                self.push(Node::Set(items))
            }
            0x90 => {
                let items = self.group()?;
                self.extend(items)
            }
            b's' => {
                let value = self.pop()?;
                let key = self.pop()?;
                self.insert(vec![[key, value]])
            }
            _ => {
                let group = self.group()?;
                let entries = self.pairs(&group)?;
                self.insert(entries)
            }
        }
    }

    fn pairs(&self, values: &[Id]) -> Result<Vec<[Id; 2]>, PickleError> {
        match values.as_chunks::<2>() {
            (pairs, []) => Ok(pairs.to_vec()),
            _ => Err(self.wrong("the last key has no value")),
        }
    }

    /// Sets entries of the dictionary on top.
    fn insert(&mut self, mut added: Vec<[Id; 2]>) -> Result<(), PickleError> {
        let target = self.top()?;
        match &mut self.nodes[target as usize] {
            Node::Dict(entries) => entries.append(&mut added),
            Node::Object(object) => object.entries.append(&mut added),
            _ => return Err(self.wrong("entries are set in something that is no dictionary")),
        }
        Ok(())
    }

    /// Stores the topmost value under a number, or fetches one that was stored.
    fn remember(&mut self, opcode: u8) -> Result<(), PickleError> {
        let place = match opcode {
            b'q' | b'h' => self.input.byte()?.into(),
            b'r' | b'j' => u32::from_le_bytes(self.input.array()?),
            // The number of values stored so far.
            _ => u32::try_from(self.memo.len()).map_err(|_| self.wrong("too many values are stored"))?,
        };
        if matches!(opcode, b'h' | b'j') {
            let stored = self.memo.get(&place).copied();
            let id = stored.ok_or_else(|| self.wrong(format!("nothing is stored under {place}")))?;
            self.stack.push(id);
        } else {
            let id = self.top()?;
            self.memo.insert(place, id);
        }
        Ok(())
    }

    fn object(&mut self, opcode: u8) -> Result<(), PickleError> {
        match opcode {
            b'c' => {
                let (module, name) = (self.input.line()?, self.input.line()?);
                let global = Node::Global([self.input.text(module)?, self.input.text(name)?]);
                self.push(global)
            }
            0x93 => {
                let (name, module) = (self.pop()?, self.pop()?);
                let (Node::Text(module), Node::Text(name)) =
                    (&self.nodes[module as usize], &self.nodes[name as usize])
                else {
                    return Err(self.wrong("a class is named by something that is no text"));
                };
                let global = Node::Global([module.clone(), name.clone()]);
                self.push(global)
            }
            b'b' => {
                let state = self.pop()?;
                let target = self.top()?;
                let Node::Object(object) = &mut self.nodes[target as usize] else {
                    return Err(self.wrong("a state is given to something that is no object"));
                };
                object.state = Some(state);
                Ok(())
            }
            b'Q' => {
                let key = self.pop()?;
                self.push(Node::Persistent(key))
            }
            _ => {
                if opcode == 0x92 {
                    // Arguments by name, which only the call would have needed.
                    self.pop()?;
                }
                let arguments = self.pop()?;
                let callable = self.pop()?;
                if !matches!(self.nodes[arguments as usize], Node::Tuple(_)) {
                    return Err(self.wrong("the arguments of an object are no tuple"));
                }
                let (items, entries) = (Vec::new(), Vec::new());
                self.push(Node::Object(Box::new(Object { callable, arguments, state: None, items, entries })))
            }
        }
    }
}
