//! The module's script. What wasm-bindgen writes holds one instance for a whole page; here it becomes a function that makes
//! one, so that a page can give up an instance whose memory has grown, or keep several apart.

use super::files::write;
use std::path::Path;
use wasm_bindgen_cli_support::Bindgen;

/// Writes the module `NAME_bg.wasm`, its script `NAME.js` and the types `NAME.d.ts`.
pub fn bind(module: &Path, name: &str, folder: &Path) -> Result<(), String> {
    let mut bindgen = Bindgen::new();
    bindgen.input_path(module).out_name(name).typescript(true).omit_default_module_path(true);
    bindgen.remove_name_section(true).remove_producers_section(true);
    let made = bindgen.web(true).and_then(Bindgen::generate_output);
    let mut output = made.map_err(|error| format!("{error:#}"))?;
    std::fs::create_dir_all(folder).map_err(|error| format!("{}: {error}", folder.display()))?;
    write(&folder.join(format!("{name}.js")), &factory(output.js())?)?;
    write(&folder.join(format!("{name}.d.ts")), &types(output.ts().unwrap_or_default())?)?;
    let path = folder.join(format!("{name}_bg.wasm"));
    std::fs::write(&path, output.wasm_mut().emit_wasm())
        .map_err(|error| format!("{}: {error}", path.display()))
}

/// The script as a function that returns what it exports, with `init`.
fn factory(script: &str) -> Result<String, String> {
    const LAST: &str = "export { initSync, __wbg_init as default };";
    let body = script.trim_end().strip_suffix(LAST).ok_or("the script of wasm-bindgen ends otherwise")?;
    let mut names = vec!["init: __wbg_init"];
    let mut text = String::from("export default function makeEngine() {\n");
    for line in body.lines() {
        let Some(rest) = line.strip_prefix("export ") else {
            text += &format!("{line}\n");
            continue;
        };
        let name = rest.strip_prefix("class ").or_else(|| rest.strip_prefix("function "));
        let name = name.and_then(|name| name.split([' ', '(']).next());
        names.push(name.ok_or_else(|| format!("wasm-bindgen exports something else: {line}"))?);
        text += &format!("{rest}\n");
    }
    if text.contains("import.meta") || body.lines().any(|line| line.starts_with("import ")) {
        return Err("the script of wasm-bindgen imports something".into());
    }
    Ok(format!("{text}return {{ {} }};\n}}\n", names.join(", ")))
}

/// The types without those of the functions that make an instance, and without what programs of an older library of
/// TypeScript do not know.
fn types(text: &str) -> Result<String, String> {
    let (types, _) =
        text.split_once("export type InitInput").ok_or("the types of wasm-bindgen are others")?;
    Ok(types
        .lines()
        .filter(|line| !line.contains("[Symbol.dispose]"))
        .fold(String::new(), |text, line| text + line + "\n"))
}
