//! What findings say: place, element, hint, lines of asset files, files that are no text, and nothing that commands a
//! terminal.

use robohive_mjcf::diagnostic::{Diagnostic, Diagnostics, Severity};
use robohive_mjcf::files::Memory;
use robohive_mjcf::{Loader, load, load_str};
use std::path::Path;

fn first(findings: &Diagnostics) -> &Diagnostic {
    findings.errors().next().unwrap_or_else(|| panic!("no error: {findings}"))
}

fn load_files(files: &[(&str, &[u8])]) -> Result<robohive_mjcf::Loaded, Diagnostics> {
    let mut memory = Memory::default();
    files.iter().for_each(|(path, content)| memory.insert(path, *content));
    Loader::default().files(memory).load(files[0].0)
}

#[test]
fn findings_are_data() {
    let text = b"<mujoco>\n <include file='part.xml'/>\n</mujoco>";
    let part = b"<mujoco>\n <worldbody>\n  <geom type='sphree' size='1'/>\n </worldbody>\n</mujoco>";
    let findings = load_files(&[("model.xml", text), ("part.xml", part)]).unwrap_err();
    let finding = first(&findings);
    assert_eq!(finding.severity, Severity::Error);
    let position = finding.position.as_ref().unwrap();
    assert_eq!((&*position.path, position.line, position.column), ("part.xml", 3, 15));
    assert_eq!(finding.element.as_deref(), Some("geom"));
    assert_eq!(finding.hint.as_deref(), Some("did you mean 'sphere'?"));
    assert_eq!(
        finding.include_chain.iter().map(|p| (&*p.path, p.line)).collect::<Vec<_>>(),
        [("model.xml", 2)]
    );
    assert_eq!((findings.iter().count(), findings.dropped()), (1, 0));
}

#[test]
fn lines_of_asset_files_are_named() {
    let model = |file: &str| format!("<mujoco><asset><mesh name='m' file='{file}'/></asset></mujoco>");
    let obj = b"# chair\nv 0 0 0\nv 1 0 zero\n";
    let stl = b"solid chair\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 nought 0\n";
    for (file, content, expected) in [
        ("m.obj", &obj[..], "OBJ file 'm.obj', line 3: cannot read 'v 1 0 zero'"),
        ("m.stl", stl, "STL file 'm.stl', line 5: 'nought' is not a coordinate"),
    ] {
        let findings = load_files(&[("model.xml", model(file).as_bytes()), (file, content)]).unwrap_err();
        assert_eq!(first(&findings).message, expected);
        assert_eq!(first(&findings).element.as_deref(), Some("mesh"));
    }
}

#[test]
fn files_that_are_no_text_are_named_as_what_they_are() {
    let utf16: Vec<u8> = "<mujoco/>".encode_utf16().flat_map(u16::to_le_bytes).collect();
    let marked = [&[0xff, 0xfe][..], &utf16].concat();
    let big: Vec<u8> = "<mujoco/>".encode_utf16().flat_map(u16::to_be_bytes).collect();
    for (content, expected) in [
        (&utf16[..], "is text in UTF-16"),
        (&marked, "is text in UTF-16"),
        (&big, "is text in UTF-16"),
        (b"\x89PNG\r\n\x1a\n", "is a PNG image"),
        (b"PK\x03\x04", "is a zip archive"),
        (b"\x7fELF\x02\x01\x01\0\0", "is binary"),
        (b"<mujoco>\0</mujoco>", " a NUL "),
    ] {
        let findings = load_files(&[("model.xml", content)]).unwrap_err();
        assert!(first(&findings).message.contains(expected), "{findings}");
        let model = b"<mujoco><asset><mesh file='m.obj'/></asset></mujoco>";
        let findings = load_files(&[("model.xml", model), ("m.obj", content)]).unwrap_err();
        assert!(first(&findings).message.contains(expected), "{findings}");
    }
}

#[test]
fn what_a_file_says_cannot_command_a_terminal() {
    let text = "<mujoco><worldbody><geom type='\u{1b}[2J\u{202e}' size='1'/></worldbody></mujoco>";
    // XML itself forbids the escape character; that which turns the direction of writing is allowed.
    for text in [text.to_owned(), text.replace('\u{1b}', "")] {
        let shown = load_str(text).unwrap_err().to_string();
        assert!(!shown.contains('\u{1b}') && !shown.contains('\u{202e}'), "{shown:?}");
    }
    let obj = b"v 0 0 \x1b]0;title\x07\n";
    let model = b"<mujoco><asset><mesh file='m.obj'/></asset></mujoco>";
    let shown = load_files(&[("model.xml", model), ("m.obj", obj)]).unwrap_err().to_string();
    assert!(shown.contains(r"\u{1b}]0;title\u{7}"), "{shown:?}");
    assert!(!shown.contains('\u{1b}'), "{shown:?}");
}

#[test]
fn paths_are_paths() {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("findings");
    std::fs::create_dir_all(&folder).unwrap();
    let path = folder.join("model.xml");
    std::fs::write(&path, "<mujoco/>").unwrap();
    assert_eq!(load(&path).unwrap().model.nbody, 1);
    assert_eq!(load(path.to_str().unwrap()).unwrap().model.nbody, 1);
    let missing = load(folder.join("none.xml")).unwrap_err().to_string();
    assert!(missing.contains("the file does not exist"), "{missing}");
}

#[cfg(unix)]
#[test]
fn a_path_that_is_not_utf8_is_refused_with_the_way_out() {
    use std::os::unix::ffi::OsStrExt;
    let path = Path::new(std::ffi::OsStr::from_bytes(b"models/caf\xe9.xml"));
    let findings = load(path).unwrap_err().to_string();
    assert!(findings.contains("is not UTF-8") && findings.contains("rename it"), "{findings}");
}
