//! Settings, custom data and keyframes.

use physics::model::{Options, Visual};

use super::rows::{put_rows, put_some};
use super::text::{element, integers};
use crate::schema::option::{FLAGS, OPTIONS};
use crate::schema::settings::{
    COMPILER_ROWS, ENTRY_ROWS, KEY_ROWS, LENGTHRANGE_ROWS, NUMERIC_ROWS, SIZE_ROWS, STATISTIC_ROWS,
    TEXT_ROWS, TUPLE_ROWS,
};
use crate::schema::visual::{
    VISUAL_GLOBAL, VISUAL_HEADLIGHT, VISUAL_MAP, VISUAL_QUALITY, VISUAL_RGBA, VISUAL_SCALE,
};
use crate::schema::words::OBJECT_TYPES;
use crate::spec::{
    Compiler, Key, LengthRangeOptions, Numeric, Size, Spec, StatisticOverride, Text, Tuple, TupleEntry,
};
use crate::xml::Element;
use physics::model::ObjType;

pub(super) fn compiler(compiler: &Compiler) -> Element {
    let mut out = element("compiler");
    put_rows(&mut out, &COMPILER_ROWS, compiler, &Compiler::default());
    if compiler.eulerseq != Compiler::default().eulerseq {
        out.put("eulerseq", String::from_utf8_lossy(&compiler.eulerseq));
    }
    let mut range = element("lengthrange");
    put_rows(&mut range, &LENGTHRANGE_ROWS, &compiler.lengthrange, &LengthRangeOptions::default());
    out.add(range);
    out
}

pub(super) fn option(option: &Options) -> Element {
    let base = Options::default();
    let mut out = element("option");
    put_rows(&mut out, &OPTIONS, option, &base);
    let groups: Vec<i32> = (0..31).filter(|k| option.disableactuator >> k & 1 == 1).collect();
    if !groups.is_empty() {
        out.put("actuatorgroupdisable", integers(&groups));
    }
    let mut flag = element("flag");
    put_rows(&mut flag, &FLAGS, option, &base);
    out.add(flag);
    out
}

pub(super) fn size(size: &Size) -> Element {
    let mut out = element("size");
    out.attributes.extend(size.memory.map(|bytes| {
        let mut holder = element("size");
        holder.put("memory", bytes.to_string());
        holder.attributes.remove(0)
    }));
    let old = |name: &str| size.memory.is_none() || name != "njmax";
    put_some(&mut out, &SIZE_ROWS, size, &Size::default(), &old);
    if let Some(nstack) = size.nstack.filter(|_| size.memory.is_none()) {
        out.put("nstack", nstack.to_string());
    }
    out
}

pub(super) fn visual(visual: &Visual) -> Element {
    let base = Visual::default();
    let mut out = element("visual");
    macro_rules! parts {
        ($($tag:ident $rows:ident)*) => {
            $(let mut part = element(stringify!($tag));
            put_rows(&mut part, &$rows, &visual.$tag, &base.$tag);
            out.add(part);)*
        };
    }
    parts!(global VISUAL_GLOBAL quality VISUAL_QUALITY headlight VISUAL_HEADLIGHT map VISUAL_MAP
           scale VISUAL_SCALE rgba VISUAL_RGBA);
    out
}

pub(super) fn statistic(stat: &StatisticOverride) -> Element {
    let mut out = element("statistic");
    put_rows(&mut out, &STATISTIC_ROWS, stat, &StatisticOverride::default());
    out
}

pub(super) fn custom(spec: &Spec) -> Element {
    let mut out = element("custom");
    out.children.extend(spec.numerics.iter().map(numeric));
    out.children.extend(spec.texts.iter().map(custom_text));
    out.children.extend(spec.tuples.iter().map(tuple));
    out
}

pub(super) fn numeric(numeric: &Numeric) -> Element {
    let mut out = element("numeric");
    put_rows(&mut out, &NUMERIC_ROWS, numeric, &Numeric::default());
    if numeric.size as usize != numeric.data.len() {
        out.put("size", numeric.size.to_string());
    }
    out
}

pub(super) fn custom_text(text: &Text) -> Element {
    let mut out = element("text");
    put_rows(&mut out, &TEXT_ROWS, text, &Text::default());
    out
}

pub(super) fn tuple(tuple: &Tuple) -> Element {
    let mut out = element("tuple");
    put_rows(&mut out, &TUPLE_ROWS, tuple, &Tuple::default());
    for entry in &tuple.entries {
        let mut child = element("element");
        child.put("objtype", object_word(entry.objtype));
        put_rows(&mut child, &ENTRY_ROWS, entry, &TupleEntry::default());
        out.children.push(child);
    }
    out
}

/// The word for a kind of object in `objtype`; empty for what has none.
pub(super) fn object_word(kind: ObjType) -> &'static str {
    usize::try_from(kind.code() - 1).ok().and_then(|i| OBJECT_TYPES.get(i)).copied().unwrap_or("")
}

pub(super) fn keyframe(keys: &[Key]) -> Element {
    let mut out = element("keyframe");
    out.children.extend(keys.iter().map(key));
    out
}

pub(super) fn key(key: &Key) -> Element {
    let mut out = element("key");
    put_rows(&mut out, &KEY_ROWS, key, &Key::default());
    out
}
