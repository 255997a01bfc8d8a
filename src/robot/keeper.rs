//! What is remembered between steps, as a list of words that is written and read in one order.

use random::{Generator, Mt19937State, Pcg64, Pcg64State, RandomState, RandomStateSnapshot};
use std::fmt;

/// Writes what something remembers into a list, or reads it from there: one function that names every part serves both
/// directions. Numbers are kept to the last bit.
///
/// ```
/// use robohive_robot::Keeper;
///
/// struct Counter {
///     steps: usize,
///     angle: f64,
/// }
/// fn keep(counter: &mut Counter, keeper: &mut Keeper) {
///     keeper.count(&mut counter.steps);
///     keeper.number(&mut counter.angle);
/// }
/// let mut writer = Keeper::writer();
/// keep(&mut Counter { steps: 3, angle: 0.1 }, &mut writer);
/// let mut counter = Counter { steps: 0, angle: 0.0 };
/// let mut reader = Keeper::reader(writer.words());
/// keep(&mut counter, &mut reader);
/// reader.finish()?;
/// assert_eq!((counter.steps, counter.angle), (3, 0.1));
/// # Ok::<(), robohive_robot::ForeignWords>(())
/// ```
#[derive(Clone, Debug, Default)]
pub struct Keeper {
    words: Vec<u64>,
    /// Word read next; `None` while writing.
    next: Option<usize>,
    foreign: bool,
}

/// Words that something else wrote.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ForeignWords;

impl fmt::Display for ForeignWords {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("what is remembered was written by something else: it has other parts")
    }
}

impl std::error::Error for ForeignWords {}

impl Keeper {
    /// One that writes.
    pub fn writer() -> Self {
        Self::default()
    }

    /// One that reads what another wrote.
    pub fn reader(words: Vec<u64>) -> Self {
        Keeper { words, next: Some(0), foreign: false }
    }

    /// What was written.
    pub fn words(self) -> Vec<u64> {
        self.words
    }

    /// Ends reading.
    ///
    /// # Errors
    /// There were too few words or too many, or one that the reader does not have.
    pub fn finish(self) -> Result<(), ForeignWords> {
        let all = self.next.is_none_or(|next| next == self.words.len());
        if all && !self.foreign { Ok(()) } else { Err(ForeignWords) }
    }

    /// Writes a word, or reads one.
    pub fn word(&mut self, word: &mut u64) {
        match &mut self.next {
            None => self.words.push(*word),
            Some(next) => match self.words.get(*next) {
                Some(kept) => (*word, *next) = (*kept, *next + 1),
                None => self.foreign = true,
            },
        }
    }

    /// A number.
    pub fn number(&mut self, number: &mut f64) {
        let mut bits = number.to_bits();
        self.word(&mut bits);
        *number = f64::from_bits(bits);
    }

    /// As many numbers as there are.
    pub fn numbers(&mut self, numbers: &mut [f64]) {
        numbers.iter_mut().for_each(|number| self.number(number));
    }

    /// A count or an index.
    pub fn count(&mut self, count: &mut usize) {
        let mut word = *count as u64;
        self.word(&mut word);
        *count = word as usize;
    }

    /// Whether something holds.
    pub fn flag(&mut self, flag: &mut bool) {
        let mut word = u64::from(*flag);
        self.word(&mut word);
        *flag = word != 0;
    }

    /// One of a few values.
    pub fn choice<T: Copy + PartialEq>(&mut self, value: &mut T, among: &[T]) {
        let mut index = among.iter().position(|other| other == value).unwrap_or(among.len());
        self.count(&mut index);
        match among.get(index) {
            Some(kept) => *value = *kept,
            None => self.foreign = true,
        }
    }

    /// A generator of random numbers.
    pub fn generator(&mut self, generator: &mut Generator<Pcg64>) {
        let state = generator.bits().state();
        let (mut wide, mut half) = ([state.state, state.inc], state.uinteger as usize);
        wide.iter_mut().for_each(|number| self.wide(number));
        let mut has_uint32 = state.has_uint32;
        self.flag(&mut has_uint32);
        self.count(&mut half);
        let state = Pcg64State { state: wide[0], inc: wide[1], has_uint32, uinteger: half as u32 };
        match Pcg64::from_state(&state) {
            Ok(bits) => *generator = Generator::new(bits),
            Err(_) => self.foreign = true,
        }
    }

    /// A generator of numpy's old kind.
    pub fn random_state(&mut self, generator: &mut RandomState) {
        let RandomStateSnapshot { state: Mt19937State { mut key, mut pos }, mut has_gauss, mut gauss } =
            generator.state();
        for key in &mut key {
            let mut word = u64::from(*key);
            self.word(&mut word);
            *key = word as u32;
        }
        self.count(&mut pos);
        self.flag(&mut has_gauss);
        self.number(&mut gauss);
        match RandomState::from_state(&RandomStateSnapshot {
            state: Mt19937State { key, pos },
            has_gauss,
            gauss,
        }) {
            Ok(kept) => *generator = kept,
            Err(_) => self.foreign = true,
        }
    }

    fn wide(&mut self, number: &mut u128) {
        let (mut high, mut low) = ((*number >> 64) as u64, *number as u64);
        self.word(&mut high);
        self.word(&mut low);
        *number = u128::from(high) << 64 | u128::from(low);
    }
}
