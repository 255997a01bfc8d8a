//! Contact pairs, excluded pairs, equality constraints and tendons.

use physics::model::{EqType, ObjType};

use super::rows::{put_rows, put_some};
use super::text::{element, number, numbers};
use crate::schema::constraint::{
    EQUALITIES, EQUALITY_ROWS, EXCLUDE_ROWS, PAIR_ROWS, TENDON_LOOKS, TENDON_ROWS, equality_blocks,
};
use crate::spec::{Equality, Exclude, Pair, Spec, Tendon, Wrap, WrapKind};
use crate::xml::Element;

pub(super) fn contact(spec: &Spec) -> Element {
    let mut out = element("contact");
    out.children.extend(spec.pairs.iter().map(pair));
    out.children.extend(spec.excludes.iter().map(exclude));
    out
}

pub(super) fn pair(pair: &Pair) -> Element {
    let mut out = element("pair");
    put_rows(&mut out, &PAIR_ROWS, pair, &Pair::default());
    out
}

pub(super) fn exclude(exclude: &Exclude) -> Element {
    let mut out = element("exclude");
    put_rows(&mut out, &EXCLUDE_ROWS, exclude, &Exclude::default());
    out
}

pub(super) fn equalities(spec: &Spec) -> Element {
    let mut out = element("equality");
    out.children.extend(spec.equalities.iter().map(equality));
    out
}

pub(super) fn equality(equality: &Equality) -> Element {
    let tag = EQUALITIES.iter().find(|(_, kind)| *kind == equality.kind).map_or("connect", |(tag, _)| tag);
    let mut out = element(tag);
    let sites = equality.objtype == ObjType::Site;
    let mut base = Equality { kind: equality.kind, ..Equality::default() };
    if equality.kind == EqType::Weld && !sites {
        // A weld without an anchor has its own default.
        base.data[..3].fill(0.0);
    }
    put_rows(&mut out, &EQUALITY_ROWS, equality, &base);
    let joined = |name: &str| match name {
        "body1" | "body2" => !sites,
        "site1" | "site2" => sites,
        "anchor" | "relpose" => !sites,
        _ => true,
    };
    for block in equality_blocks(equality.kind) {
        put_some(&mut out, block, equality, &base, &joined);
    }
    if equality.kind == EqType::Connect && !sites && !out.has("anchor") {
        out.put("anchor", numbers(&equality.data[..3]));
    }
    out
}

pub(super) fn tendons(spec: &Spec) -> Element {
    let mut out = element("tendon");
    out.children.extend(spec.tendons.iter().enumerate().map(|(index, one)| tendon(one, Some(index))));
    out
}

/// Classes for what `fixed` cannot say of its looks, one a tendon.
pub(super) fn tendon_classes(spec: &Spec) -> Element {
    let mut out = element("default");
    for (index, tendon) in spec.tendons.iter().enumerate().filter(|(_, t)| is_fixed(t)) {
        let mut looks = element("tendon");
        put_rows(&mut looks, &TENDON_LOOKS, tendon, &Tendon::default());
        if !looks.attributes.is_empty() {
            let mut class = element("default");
            class.put("class", class_name(index));
            class.children.push(looks);
            out.children.push(class);
        }
    }
    out
}

fn class_name(index: usize) -> String {
    format!("looks of tendon {index}")
}

fn is_fixed(tendon: &Tendon) -> bool {
    tendon.path.iter().any(|wrap| matches!(wrap.kind, WrapKind::Joint { .. }))
}

/// A tendon without the looks that `fixed` cannot say.
pub(super) fn plain_tendon(one: &Tendon) -> Element {
    tendon(one, None)
}

fn tendon(tendon: &Tendon, index: Option<usize>) -> Element {
    let fixed = is_fixed(tendon);
    let base = Tendon::default();
    let mut out = element(if fixed { "fixed" } else { "spatial" });
    let mut looks = element("tendon");
    put_rows(&mut looks, &TENDON_LOOKS, tendon, &base);
    if let Some(index) = index.filter(|_| fixed && !looks.attributes.is_empty()) {
        out.put("class", class_name(index));
    }
    put_rows(&mut out, &TENDON_ROWS, tendon, &base);
    if tendon.springlength != base.springlength {
        out.put("springlength", numbers(&tendon.springlength));
    }
    if !fixed {
        out.attributes.append(&mut looks.attributes);
    }
    out.children.extend(tendon.path.iter().map(wrap));
    out
}

fn wrap(wrap: &Wrap) -> Element {
    let mut out = element(match wrap.kind {
        WrapKind::Site { .. } => "site",
        WrapKind::Geom { .. } => "geom",
        WrapKind::Joint { .. } => "joint",
        WrapKind::Pulley { .. } => "pulley",
    });
    match &wrap.kind {
        WrapKind::Site { site } => out.put("site", site),
        WrapKind::Geom { geom, sidesite } => {
            out.put("geom", geom);
            if !sidesite.is_empty() {
                out.put("sidesite", sidesite);
            }
        }
        WrapKind::Joint { joint, coef } => {
            out.put("joint", joint);
            out.put("coef", number(*coef));
        }
        WrapKind::Pulley { divisor } => out.put("divisor", number(*divisor)),
    }
    out
}
