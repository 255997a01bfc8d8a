//! JSON files.

use dataset::trace::TraceError;
use serde_json::Value;
use std::path::Path;

/// Writes a JSON file that appears in one piece.
pub fn write(path: &Path, value: &Value) -> Result<(), TraceError> {
    let fail = |e: std::io::Error| TraceError::new(path, "", e);
    let text = serde_json::to_string_pretty(value).map_err(|e| TraceError::new(path, "", e))?;
    let new = path.with_extension("json.new");
    std::fs::write(&new, text + "\n").map_err(fail)?;
    std::fs::rename(&new, path).map_err(fail)
}

/// Reads a JSON file.
pub fn read(path: &Path) -> Result<Value, TraceError> {
    let text = std::fs::read_to_string(path).map_err(|e| TraceError::new(path, "", e))?;
    serde_json::from_str(&text).map_err(|e| TraceError::new(path, "", format!("no valid JSON: {e}")))
}
