//! Sections whose numbers are text.

use super::cursor::Words;
use super::section::{Section, count, dimension, distinct, head, in_order, matching, node};
use crate::asset::AssetError;
use crate::flex::Cloud;

/// Least bytes of a number and the blank after it.
const WORD: usize = 2;

/// Format 2.2: a count, then a line an entry. Nodes are numbered by their place.
pub(super) fn read_v22(nodes: &Section<'_>, elements: &Section<'_>) -> Result<Cloud, AssetError> {
    let mut words = Words::new(nodes);
    let number = words.count()?;
    let n = count(number, 4 * WORD - 1, words.left(), nodes)?;
    let mut point = Vec::with_capacity(3 * n);
    for place in 0..n {
        in_order(words.number()?, place, &words.here())?;
        for _ in 0..3 {
            point.push(words.number()?);
        }
    }
    let mut words = Words::new(elements);
    let number = words.count()?;
    let count = count(number, 5 * WORD - 1, words.left(), elements)?;
    let (mut dim, mut element, mut tags) = (None, Vec::new(), Vec::new());
    for _ in 0..count {
        tags.push(words.number::<i64>()? as u64);
        let own = dimension(words.number()?, &words.here())?;
        if *dim.get_or_insert(own) != own {
            return Err(words.here().malformed("all elements must be of one type"));
        }
        match words.number::<u32>()? {
            0 => {}
            2 => {
                words.number::<i64>()?;
                words.number::<i64>()?;
            }
            tags => return Err(words.here().malformed(format!("elements have 2 tags or none, not {tags}"))),
        }
        for _ in 0..=own {
            let tag = words.number()?;
            element.push(node(tag, 1, n, &words.here())?);
        }
    }
    distinct(tags, elements)?;
    Ok(Cloud { dim: dim.unwrap_or(0), point, element, ..Cloud::default() })
}

/// Format 4.1: one block of node numbers, then of coordinates; one block of elements.
pub(super) fn read_v41(nodes: &Section<'_>, elements: &Section<'_>) -> Result<Cloud, AssetError> {
    let mut words = Words::new(nodes);
    let numbers = eight(&mut words)?;
    let nodes_head = head(numbers, 4 * WORD - 1, words.left(), nodes)?;
    let [_, entries, first, last, ..] = numbers;
    if last.wrapping_sub(first).wrapping_add(1) != entries {
        return Err(nodes.malformed("nodes must be numbered one after the other"));
    }
    for i in 0..nodes_head.count as u64 {
        if words.number::<u64>()?.checked_sub(nodes_head.first) != Some(i) {
            return Err(words.here().malformed("nodes must be numbered one after the other"));
        }
    }
    let mut point = Vec::with_capacity(3 * nodes_head.count);
    for _ in 0..3 * nodes_head.count {
        point.push(words.number()?);
    }
    let mut words = Words::new(elements);
    let numbers = eight(&mut words)?;
    let head = head(numbers, 3 * WORD - 1, words.left(), elements)?;
    let dim = matching(&nodes_head, &head, elements)?;
    let mut element = Vec::with_capacity((dim as usize + 1) * head.count);
    let mut tags = Vec::new();
    for _ in 0..head.count {
        tags.push(words.number()?);
        for _ in 0..=dim {
            let tag = words.number()?;
            element.push(node(tag, nodes_head.first, nodes_head.count, &words.here())?);
        }
    }
    distinct(tags, elements)?;
    Ok(Cloud { dim, point, element, ..Cloud::default() })
}

fn eight(words: &mut Words<'_>) -> Result<[u64; 8], AssetError> {
    let mut numbers = [0; 8];
    for number in &mut numbers {
        // Entities may be negative where they are reversed.
        *number = words.number::<i64>()? as u64;
    }
    Ok(numbers)
}
