//! `web`: the page, served to browsers of this machine.

pub mod http;
mod model;
mod server;
mod site;

use crate::failure::Failure;
use crate::terminal::show;
use clap::{Args, ValueHint};
use site::Site;
use std::net::{IpAddr, Ipv4Addr, SocketAddr, TcpListener};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

/// Look at models and environments in a browser of this machine
#[derive(Args)]
#[command(
    after_help = "The page simulates and draws by itself: this command only hands its files out, and of MODEL those files that the \
model reads. It listens on a loopback address, which other machines cannot reach, and answers only requests that name this machine. \
To show the page to others, put its folder on any static host.

`cargo xtask web` builds the page into a folder; --page, the environment variable ROBOHIVE_PAGE, or its place beside the command say \
where it is. A command built with the feature `page` has it inside.

Examples:
  robohive web
  robohive web assets/franka/franka_table.xml
  robohive web hive/FrankaReach-v0 --port 8123"
)]
pub struct Web {
    /// A model (MJCF, URDF, or a zip archive), or the id of one of our own environments, which the page opens
    #[arg(value_name = "MODEL|ID", value_hint = ValueHint::FilePath)]
    pub subject: Option<PathBuf>,
    /// Port to listen on; the system chooses one at 0
    #[arg(long, value_name = "PORT", default_value_t = 8080)]
    pub port: u16,
    /// Loopback address to listen on
    #[arg(long, value_name = "ADDRESS", default_value_t = IpAddr::V4(Ipv4Addr::LOCALHOST))]
    pub address: IpAddr,
    /// Open the page in the browser
    #[arg(long)]
    pub open: bool,
    /// Folder that the page was built into
    /// [default: the environment variable ROBOHIVE_PAGE, else beside the command]
    #[arg(long, value_name = "FOLDER", value_hint = ValueHint::DirPath)]
    pub page: Option<PathBuf>,
}

/// Runs the command, until a signal ends it.
pub fn run(a: &Web) -> Result<(), Failure> {
    if !a.address.is_loopback() {
        return Err(Failure::usage(format!(
            "{} can be reached from other machines, and the page would be served to them without a key; \
             only loopback addresses are listened on, such as 127.0.0.1 or ::1. For others, put the page's folder on a static host",
            a.address
        )));
    }
    let page = a.page.clone().or_else(|| std::env::var_os("ROBOHIVE_PAGE").map(PathBuf::from));
    let mut site = Site::find(page.as_deref())?;
    let link = a.subject.as_deref().map(|subject| link(subject, &mut site)).transpose()?;
    let listener = TcpListener::bind(SocketAddr::new(a.address, a.port)).map_err(|error| {
        Failure::new(format!("port {} of {}: {error}; --port 0 takes a free one", a.port, a.address))
    })?;
    let address = listener.local_addr().map_err(Failure::new)?;
    let url = format!("http://{address}/{}", link.unwrap_or_default());
    show!("{url}");
    show!("serves the page of {} to this machine until Ctrl-C", site.origin());
    if a.open {
        open(&url);
    }
    server::serve(&listener, site)
}

/// What the page opens, as the end of its address; files of a model become part of the site.
fn link(subject: &Path, site: &mut Site) -> Result<String, Failure> {
    if subject.is_file() {
        return Ok(format!("#model={}", http::encode(&site.add_model(subject)?)));
    }
    let id = subject.to_string_lossy();
    let own =
        env::Registry::builtin().specs().iter().any(|spec| spec.id == id && spec.id.starts_with("hive/"));
    match own {
        true => Ok(format!("#environment={}", http::encode(&id))),
        false => Err(Failure::usage(format!(
            "{id} is neither a file nor an environment on a model of our own; `robohive list` names these, they begin with hive/"
        ))),
    }
}

/// Asks the system to show an address. Where it cannot, the address was printed.
fn open(url: &str) {
    let program = if cfg!(target_os = "macos") {
        ["open"].as_slice()
    } else if cfg!(windows) {
        ["cmd", "/C", "start"].as_slice()
    } else {
        ["xdg-open"].as_slice()
    };
    let mut command = Command::new(program[0]);
    command.args(&program[1..]).arg(url).stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::null());
    if command.spawn().is_err() {
        show!("no browser was found to open it");
    }
}
