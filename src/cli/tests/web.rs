//! `robohive web`: what it serves, to whom, and what it refuses.

mod command;

use command::{command, robohive, scratch, text};
use std::fs;
use std::io::{BufRead, BufReader, Read, Write};
use std::net::TcpStream;
use std::path::{Path, PathBuf};
use std::process::{Child, ChildStdout, Stdio};

/// A running server, ended when the test is over.
struct Server {
    child: Child,
    /// Kept open, so that what it prints reaches somebody.
    _printed: BufReader<ChildStdout>,
    /// Host and port.
    host: String,
    /// What the page opens.
    link: String,
}

impl Drop for Server {
    fn drop(&mut self) {
        _ = self.child.kill();
        _ = self.child.wait();
    }
}

impl Server {
    /// The command with these arguments, on a free port, once it listens.
    fn start(page: &Path, arguments: &[&str]) -> Self {
        let mut command = command();
        command.args(["web", "--port", "0", "--page"]).arg(page).args(arguments);
        let mut child = command.stdout(Stdio::piped()).spawn().unwrap();
        let mut printed = BufReader::new(child.stdout.take().unwrap());
        let mut line = String::new();
        printed.read_line(&mut line).unwrap();
        let (host, link) = line.trim().strip_prefix("http://").unwrap().split_once('/').unwrap();
        Server { host: host.into(), link: link.into(), _printed: printed, child }
    }

    /// The whole answer to a request of these lines.
    fn raw(&self, request: &str) -> String {
        let mut stream = TcpStream::connect(&self.host).unwrap();
        stream.write_all(request.as_bytes()).unwrap();
        let mut answer = Vec::new();
        _ = stream.read_to_end(&mut answer);
        text(&answer)
    }

    fn get(&self, path: &str) -> (u16, String) {
        let answer = self.raw(&format!("GET /{path} HTTP/1.1\r\nHost: {}\r\n\r\n", self.host));
        let status = answer.split(' ').nth(1).unwrap().parse().unwrap();
        (status, answer)
    }
}

/// A folder with a page, and files that are not to be served.
fn page(name: &str) -> PathBuf {
    let folder = scratch(name);
    _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(folder.join("page/inside")).unwrap();
    for (file, content) in [
        ("page/index.html", "<p>here"),
        ("page/engine_bg.wasm", "\0asm"),
        ("page/api.js", "export {}"),
        ("page/inside/secret.txt", "secret"),
        ("secret.txt", "secret"),
    ] {
        fs::write(folder.join(file), content).unwrap();
    }
    folder
}

#[test]
fn files_of_the_page_are_served_and_no_others() {
    let folder = page("web-page");
    let server = Server::start(&folder.join("page"), &[]);
    assert_eq!(server.link, "");
    let (status, answer) = server.get("");
    assert!(
        status == 200 && answer.ends_with("<p>here") && answer.contains("content-type: text/html"),
        "{answer}"
    );
    assert!(server.get("engine_bg.wasm").1.contains("content-type: application/wasm"));
    assert!(server.get("api.js?v=2").1.contains("content-type: text/javascript"));
    for path in ["nothing", "inside/secret.txt", "inside", "page/index.html"] {
        assert_eq!(server.get(path).0, 404, "{path}");
    }
    for path in ["../secret.txt", "%2e%2e/secret.txt", "inside/../../secret.txt", "..%5csecret.txt"] {
        assert_eq!(server.get(path).0, 400, "{path}");
    }
    let head = server.raw(&format!("HEAD / HTTP/1.1\r\nHost: {}\r\n\r\n", server.host));
    assert!(head.contains("content-length: 7") && head.ends_with("\r\n\r\n"), "{head}");
    let post = format!("POST / HTTP/1.1\r\nHost: {}\r\n\r\n", server.host);
    assert!(server.raw(&post).starts_with("HTTP/1.1 405"));
    let elsewhere = server.raw("GET / HTTP/1.1\r\nHost: evil.example\r\n\r\n");
    assert!(elsewhere.starts_with("HTTP/1.1 403") && !elsewhere.contains("here"), "{elsewhere}");
    let endless = server.raw(&format!("GET /{} HTTP/1.1\r\n", "a".repeat(20_000)));
    assert!(endless.is_empty() || endless.starts_with("HTTP/1.1 431"), "{endless}");
}

#[test]
fn a_model_is_served_with_what_it_reads() {
    let folder = page("web-model");
    fs::create_dir_all(folder.join("robots/one/parts")).unwrap();
    fs::create_dir_all(folder.join("robots/meshes")).unwrap();
    let scene = "<mujoco><include file='parts/body.xml'/><asset><mesh file='../meshes/m.obj'/><mesh file='gone.obj'/></asset></mujoco>";
    fs::write(folder.join("robots/one/my scene.xml"), scene).unwrap();
    fs::write(folder.join("robots/one/parts/body.xml"), "<mujoco><worldbody/></mujoco>").unwrap();
    fs::write(folder.join("robots/one/other.xml"), "secret").unwrap();
    fs::write(folder.join("robots/meshes/m.obj"), "v 0 0 0").unwrap();
    let scene = folder.join("robots/one/my scene.xml");
    let server = Server::start(&folder.join("page"), &[scene.to_str().unwrap()]);
    assert_eq!(server.link, "#model=open/one/my%20scene.xml");
    assert!(server.get("open/one/my%20scene.xml").1.ends_with("</mujoco>"));
    assert!(server.get("open/one/parts/body.xml").1.ends_with("<worldbody/></mujoco>"));
    assert!(server.get("open/meshes/m.obj").1.ends_with("v 0 0 0"));
    assert_eq!(server.get("open/one/other.xml").0, 404);
    let environment = Server::start(&folder.join("page"), &["hive/FrankaReach-v0"]);
    assert_eq!(environment.link, "#environment=hive/FrankaReach-v0");
}

#[test]
fn what_cannot_be_served_is_refused() {
    let folder = page("web-refused");
    let shown = |arguments: &[&str]| {
        let out = robohive(&[&["web"], arguments].concat());
        assert!(!out.status.success(), "{arguments:?}");
        text(&out.stderr)
    };
    let page = folder.join("page");
    let page = ["--page", page.to_str().unwrap()];
    assert!(shown(&["--page", folder.to_str().unwrap()]).contains("cargo xtask web"));
    for address in ["0.0.0.0", "192.168.0.1", "::"] {
        assert!(
            shown(&[&page[..], &["--address", address]].concat()).contains("other machines"),
            "{address}"
        );
    }
    assert!(shown(&[&page[..], &["nothing.xml"]].concat()).contains("neither a file nor"));
    let taken = Server::start(Path::new(page[1]), &[]);
    let port = taken.host.rsplit(':').next().unwrap();
    assert!(shown(&[&page[..], &["--port", port]].concat()).contains("--port 0"));
}
