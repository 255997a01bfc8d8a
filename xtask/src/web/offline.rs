//! What is made of the files of the page: the module inside a script, and the list of what is kept for when there is no network.

use super::files::{read, remove, write};
use crate::command::succeed;
use std::fs;
use std::path::Path;
use std::process::Command;

/// Ends of the names of files that a page asks for.
const ASKED: [&str; 3] = [".js", ".html", ".wasm"];
/// Scripts that it does not ask for.
const NOT_ASKED: [&str; 3] = ["node.js", "inline.js", "offline.js"];
/// Begins the names of what only the viewer asks for.
const VIEWER: &str = "viewer";

/// Writes `inline.js`: the interface with the module inside, compressed, for bundlers that know no assets.
pub fn inline(folder: &Path) -> Result<(), String> {
    // Compressed by node, which packages are made with anyway.
    let script = "import{readFileSync,writeFileSync}from'node:fs';import{gzipSync}from'node:zlib';\
        const text=gzipSync(readFileSync('engine_bg.wasm'),{level:9}).toString('base64');\
        writeFileSync('inline.js',readFileSync(0,'utf8').replace('@MODULE@',text));";
    let template = folder.join("inline.in.js");
    fs::rename(folder.join("inline.js"), &template)
        .map_err(|error| format!("{}: {error}", template.display()))?;
    let input = fs::File::open(&template).map_err(|error| format!("{}: {error}", template.display()))?;
    let mut node = Command::new("node");
    node.args(["--input-type=module", "--eval", script]).current_dir(folder).stdin(input);
    succeed(&mut node)?;
    remove(&template)
}

/// Completes `offline.js` with the files of the page and a version that changes with them.
pub fn version(folder: &Path) -> Result<(), String> {
    let wrong = |error| format!("{}: {error}", folder.display());
    let entries = fs::read_dir(folder).map_err(wrong)?.flatten();
    let mut names: Vec<_> = entries.map(|entry| entry.file_name().to_string_lossy().into_owned()).collect();
    names.retain(|name| ASKED.iter().any(|end| name.ends_with(end)) && !NOT_ASKED.contains(&name.as_str()));
    names.sort();
    let mut hash: u64 = 0xcbf2_9ce4_8422_2325;
    for name in &names {
        let content = fs::read(folder.join(name)).map_err(wrong)?;
        for byte in name.bytes().chain(content) {
            hash = (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3);
        }
    }
    let path = folder.join("offline.js");
    let (viewer, page): (Vec<_>, Vec<_>) = names.iter().partition(|name| name.starts_with(VIEWER));
    let list =
        |names: &[&String]| names.iter().map(|name| format!("{name:?}")).collect::<Vec<_>>().join(", ");
    let text = read(&path)?.replace("@VERSION@", &format!("robohive-{hash:016x}"));
    write(&path, &text.replace("/* @FILES@ */", &list(&page)).replace("/* @VIEWER@ */", &list(&viewer)))
}
