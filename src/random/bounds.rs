//! Integers in a range, each with the same probability.
//!
//! numpy has two methods, and both start from as few random bits as the type and the range need. A
//! `Generator` multiplies (Lemire, "Fast random integer generation in an interval", 2019), the legacy
//! functions and every shuffle cut off high bits and reject what is too large.

use crate::{BitGenerator, RandomError};
use std::ops::{Range, RangeInclusive};

mod sealed {
    pub trait Sealed {}
}

/// A type of integers that can be drawn: `i8` to `i64`, `u8` to `u64`, and `bool`. The type decides how many
/// random bits a draw takes, as numpy's `dtype` does; 32 and 64 bits draw alike where the range has at most
/// 2³² members.
pub trait Integer: Copy + sealed::Sealed {
    /// Bits of the random numbers behind a draw.
    const BITS: u32;

    /// The value.
    fn widen(self) -> i128;

    /// The integer `offset` above `self`, within the type's range.
    fn above(self, offset: u64) -> Self;
}

macro_rules! integers {
    ($($integer:ty)*) => {$(
        impl sealed::Sealed for $integer {}
        impl Integer for $integer {
            const BITS: u32 = <$integer>::BITS;

            fn widen(self) -> i128 {
                self.into()
            }

            fn above(self, offset: u64) -> Self {
                self.wrapping_add(offset as $integer)
            }
        }
    )*};
}

integers!(i8 i16 i32 i64 u8 u16 u32 u64);

impl sealed::Sealed for bool {}

impl Integer for bool {
    const BITS: u32 = 1;

    fn widen(self) -> i128 {
        self.into()
    }

    fn above(self, offset: u64) -> Self {
        self | (offset == 1)
    }
}

/// A range of integers: `0..10`, or `0..=9`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Bounds<T> {
    low: T,
    high: T,
    closed: bool,
}

impl<T> From<Range<T>> for Bounds<T> {
    fn from(Range { start, end }: Range<T>) -> Self {
        Bounds { low: start, high: end, closed: false }
    }
}

impl<T> From<RangeInclusive<T>> for Bounds<T> {
    fn from(range: RangeInclusive<T>) -> Self {
        let (low, high) = range.into_inner();
        Bounds { low, high, closed: true }
    }
}

impl<T: Integer> Bounds<T> {
    /// The first integer of the range, and the distance of the last from it.
    pub(crate) fn first_and_span(self) -> Result<(T, u64), RandomError> {
        let (low, high) = (self.low.widen(), self.high.widen());
        u64::try_from(high - low - i128::from(!self.closed))
            .map(|span| (self.low, span))
            .map_err(|_| RandomError::EmptyRange { low, high, closed: self.closed })
    }
}

/// How a number is made to fit a range.
#[derive(Clone, Copy)]
pub(crate) enum Method {
    /// As a `Generator` does.
    Multiply,
    /// As legacy functions and shuffles do.
    Mask,
}

/// Random numbers of `bits` bits. Those below 32 bits are cut from words of 32, whose rest waits for the next
/// number.
struct Pieces {
    bits: u32,
    word: u32,
    left: u32,
}

impl Pieces {
    fn largest(&self) -> u64 {
        u64::MAX >> (64 - self.bits)
    }

    #[inline]
    fn next(&mut self, source: &mut impl BitGenerator) -> u64 {
        match self.bits {
            64 => source.next_u64(),
            32 => source.next_u32().into(),
            _ => {
                if self.left == 0 {
                    self.word = source.next_u32();
                    self.left = 32 / self.bits;
                } else {
                    self.word >>= self.bits;
                }
                self.left -= 1;
                u64::from(self.word) & self.largest()
            }
        }
    }
}

/// Fills `out` with integers of `bounds`.
pub(crate) fn fill<T: Integer>(
    source: &mut impl BitGenerator,
    bounds: Bounds<T>,
    method: Method,
    out: &mut [T],
) -> Result<(), RandomError> {
    let (first, span) = bounds.first_and_span()?;
    let mut pieces = Pieces { bits: bits_for(T::BITS, span), word: 0, left: 0 };
    for slot in out {
        *slot = first.above(offset(source, &mut pieces, span, method));
    }
    Ok(())
}

/// A number from 0 to `last`.
#[inline]
pub(crate) fn up_to(source: &mut impl BitGenerator, last: u64, method: Method) -> u64 {
    let mut pieces = Pieces { bits: bits_for(64, last), word: 0, left: 0 };
    offset(source, &mut pieces, last, method)
}

/// Ranges of 64-bit integers that 32 bits can cover are drawn from 32.
fn bits_for(bits: u32, span: u64) -> u32 {
    if bits == 64 && span <= u32::MAX.into() { 32 } else { bits }
}

#[inline]
fn offset(source: &mut impl BitGenerator, pieces: &mut Pieces, span: u64, method: Method) -> u64 {
    if span == 0 {
        0
    } else if span == pieces.largest() {
        pieces.next(source)
    } else {
        match method {
            Method::Multiply => by_product(source, pieces, span),
            Method::Mask => by_mask(source, pieces, span),
        }
    }
}

/// The upper half of a random number times the number of members. Products are drawn again where their lower
/// half shows that one member would come up more often than another.
#[inline]
fn by_product(source: &mut impl BitGenerator, pieces: &mut Pieces, span: u64) -> u64 {
    let members = span + 1;
    let mut product = u128::from(pieces.next(source)) * u128::from(members);
    let mut lower = product as u64 & pieces.largest();
    if lower < members {
        let surplus = (pieces.largest() - span) % members;
        while lower < surplus {
            product = u128::from(pieces.next(source)) * u128::from(members);
            lower = product as u64 & pieces.largest();
        }
    }
    (product >> pieces.bits) as u64
}

#[inline]
fn by_mask(source: &mut impl BitGenerator, pieces: &mut Pieces, span: u64) -> u64 {
    let mask = u64::MAX >> span.leading_zeros();
    loop {
        let number = pieces.next(source) & mask;
        if number <= span {
            return number;
        }
    }
}
