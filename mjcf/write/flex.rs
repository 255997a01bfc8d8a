//! Flexes and skins. What a `flexcomp` has made is written as the flex and the bodies that it is.

use super::asset::skin;
use super::rows::put_rows;
use super::text::element;
use crate::schema::flex::{CONTACT_ROWS, EDGE_ROWS, ELASTICITY_ROWS, FLEX_ROWS, LATTICE_ROWS};
use crate::spec::{Flex, Spec};
use crate::xml::Element;

pub(super) fn deformable(spec: &Spec) -> Result<Element, String> {
    let mut out = element("deformable");
    for one in &spec.flexes {
        out.children.push(flex(one)?);
    }
    out.children.extend(spec.skins.iter().map(skin));
    Ok(out)
}

/// # Errors
/// A body has a blank in its name, which separates names in the lists of a flex.
pub(crate) fn flex(flex: &Flex) -> Result<Element, String> {
    let blank = |name: &&String| name.is_empty() || name.contains(|c: char| c.is_ascii_whitespace());
    if let Some(name) = flex.vertbody.iter().chain(&flex.nodebody).find(blank) {
        let own = &flex.name;
        return Err(format!(
            "flex '{own}' is fixed to body '{name}', whose name cannot stand in a list: rename the body"
        ));
    }
    let (base, mut out) = (Flex::default(), element("flex"));
    put_rows(&mut out, &FLEX_ROWS, flex, &base);
    put_rows(&mut out, &LATTICE_ROWS, flex, &base);
    for (tag, rows) in
        [("contact", &CONTACT_ROWS[..]), ("edge", &EDGE_ROWS), ("elasticity", &ELASTICITY_ROWS)]
    {
        let mut child = element(tag);
        put_rows(&mut child, rows, flex, &base);
        out.add(child);
    }
    Ok(out)
}
