//! Sections whose numbers are binary, little-endian.

use super::cursor::Bytes;
use super::section::{Section, count, dimension, distinct, head, in_order, matching, node};
use crate::asset::AssetError;
use crate::flex::Cloud;

/// Format 2.2: a count in digits, then entries. Elements stand in groups of one type, each with a head; some programs write
/// a group an element, others one for all.
pub(super) fn read_v22(nodes: &Section<'_>, elements: &Section<'_>) -> Result<Cloud, AssetError> {
    let mut bytes = Bytes::new(nodes);
    let number = bytes.line_of_digits()?;
    let n = count(number, 4 + 3 * 8, bytes.left(), nodes)?;
    let mut point = Vec::with_capacity(3 * n);
    for place in 0..n {
        in_order(u64::try_from(bytes.int()?).unwrap_or(0), place, nodes)?;
        for _ in 0..3 {
            point.push(bytes.real()?);
        }
    }
    let mut bytes = Bytes::new(elements);
    let number = bytes.line_of_digits()?;
    let total = count(number, 3 * 4, bytes.left(), elements)?;
    let (mut dim, mut element, mut own_tags, mut read) = (None, Vec::new(), Vec::new(), 0);
    while read < total {
        let own = dimension(bytes.int()?.into(), elements)?;
        if *dim.get_or_insert(own) != own {
            return Err(elements.malformed("all elements must be of one type"));
        }
        let (following, tags) = (bytes.int()?, bytes.int()?);
        if !(1..=(total - read) as i64).contains(&following.into()) || !(0..=2).contains(&tags) {
            return Err(elements.malformed(format!("a group of {following} elements with {tags} tags each")));
        }
        for _ in 0..following {
            own_tags.push(bytes.int()? as u64);
            for _ in 0..tags {
                bytes.int()?;
            }
            for _ in 0..=own {
                let tag = u64::try_from(bytes.int()?).unwrap_or(0);
                element.push(node(tag, 1, n, elements)?);
            }
        }
        read += following as usize;
    }
    distinct(own_tags, elements)?;
    Ok(Cloud { dim: dim.unwrap_or(0), point, element, ..Cloud::default() })
}

/// Format 4.1: as its text, numbers of entries in eight bytes.
pub(super) fn read_v41(nodes: &Section<'_>, elements: &Section<'_>) -> Result<Cloud, AssetError> {
    let mut bytes = Bytes::new(nodes);
    let numbers = eight(&mut bytes)?;
    let nodes_head = head(numbers, 4 * 8, bytes.left(), nodes)?;
    for i in 0..nodes_head.count as u64 {
        if bytes.long()?.checked_sub(nodes_head.first) != Some(i) {
            return Err(nodes.malformed("nodes must be numbered one after the other"));
        }
    }
    let mut point = Vec::with_capacity(3 * nodes_head.count);
    for _ in 0..3 * nodes_head.count {
        point.push(bytes.real()?);
    }
    let mut bytes = Bytes::new(elements);
    let numbers = eight(&mut bytes)?;
    let head = head(numbers, 3 * 8, bytes.left(), elements)?;
    let dim = matching(&nodes_head, &head, elements)?;
    let mut element = Vec::with_capacity((dim as usize + 1) * head.count);
    let mut tags = Vec::new();
    for _ in 0..head.count {
        tags.push(bytes.long()?);
        for _ in 0..=dim {
            element.push(node(bytes.long()?, nodes_head.first, nodes_head.count, elements)?);
        }
    }
    distinct(tags, elements)?;
    Ok(Cloud { dim, point, element, ..Cloud::default() })
}

/// The numbers before the entries: four counts of eight bytes, three numbers of four, one count.
fn eight(bytes: &mut Bytes<'_>) -> Result<[u64; 8], AssetError> {
    let [a, b, c, d] = [bytes.long()?, bytes.long()?, bytes.long()?, bytes.long()?];
    let [e, f, g] = [bytes.int()?, bytes.int()?, bytes.int()?].map(|x| i64::from(x) as u64);
    Ok([a, b, c, d, e, f, g, bytes.long()?])
}
