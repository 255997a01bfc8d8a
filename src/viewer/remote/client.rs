//! The program's side: a window in a process of its own.

use super::PROTOCOL;
use super::edits::{apply, changed_settings, changes};
use super::message::{Opening, Order, Report, TurnedSight};
use super::overlay::Bytes;
use super::post::{Post, Reports, listen};
use super::sight::Sight;
use super::state::StateCopy;
use super::wire::{LONGEST, WireError, receive, send};
use physics::{Data, Model};
use std::fmt;
use std::io::{Read, Write};
use std::process::{Child, Command, Stdio};
use std::sync::Arc;
use std::time::{Duration, Instant};

/// How long a window that was asked to close may take.
const FAREWELL: Duration = Duration::from_secs(3);

/// Why there is no window.
#[derive(Debug)]
#[non_exhaustive]
pub enum NoViewer {
    /// Its process could not be started.
    Start(std::io::Error),
    /// It says why.
    Refused(String),
    /// It ended without a word.
    Died(String),
    /// It did not open in time.
    Late(Duration),
    /// It is no window of this version.
    Wire(WireError),
}

impl fmt::Display for NoViewer {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            NoViewer::Start(error) => write!(f, "the window's process cannot be started: {error}"),
            NoViewer::Refused(why) => f.write_str(why),
            NoViewer::Died(how) => write!(f, "the window's process ended before its window opened ({how})"),
            NoViewer::Late(patience) => {
                write!(f, "no window opened within {} s", patience.as_secs())
            }
            NoViewer::Wire(error) => write!(f, "the window's process is not understood: {error}"),
        }
    }
}

impl std::error::Error for NoViewer {}

/// A window of another process.
pub struct Client {
    to: Option<Box<dyn Write + Send>>,
    reports: Arc<Post<Reports>>,
    child: Option<Child>,
    /// The model as the window has it.
    shown: Option<Model>,
    /// The number of the last sight that was sent.
    turn: u64,
}

impl Client {
    /// Starts a process that calls [`Link::meet`](super::Link::meet) over its standard streams, and waits until its window
    /// is open.
    ///
    /// # Errors
    /// There is no window, and why.
    pub fn spawn(
        command: &mut Command,
        opening: Opening,
        subject: Option<(&Model, &Data)>,
        patience: Duration,
    ) -> Result<Client, NoViewer> {
        command.stdin(Stdio::piped()).stdout(Stdio::piped());
        let mut child = command.spawn().map_err(NoViewer::Start)?;
        let (Some(to), Some(from)) = (child.stdin.take(), child.stdout.take()) else {
            return Err(NoViewer::Died("without its standard streams".into()));
        };
        let mut client = Client::over(from, to, opening, subject);
        client.child = Some(child);
        match client.opened(patience) {
            Ok(()) => Ok(client),
            Err(error) => Err(client.why(error)),
        }
    }

    /// A client over a pair of pipes; `from` is read on a thread of its own.
    pub fn over(
        from: impl Read + Send + 'static,
        mut to: impl Write + Send + 'static,
        opening: Opening,
        subject: Option<(&Model, &Data)>,
    ) -> Client {
        let reports = listen::<Report, Reports>(Greeted { from, greeted: false }, || ());
        let greeted = send(&PROTOCOL.to_owned(), &mut to).is_ok();
        let to: Option<Box<dyn Write + Send>> = if greeted { Some(Box::new(to)) } else { None };
        let mut client = Client { to, reports, child: None, shown: None, turn: 0 };
        client.open(opening, subject);
        client
    }

    /// Shows another model, or none.
    pub fn open(&mut self, mut opening: Opening, subject: Option<(&Model, &Data)>) -> bool {
        self.shown = subject.map(|(model, _)| model.clone());
        opening.model = subject.map(|(model, _)| Bytes(model.to_bytes()));
        opening.state = subject.map(|(_, data)| StateCopy::of(data));
        self.tell(&Order::Open(Box::new(opening)))
    }

    /// Waits until the window is open.
    fn opened(&self, patience: Duration) -> Result<(), NoViewer> {
        let mut seen = self.reports.wait(patience, |seen| seen.ready || seen.failed.is_some() || seen.over);
        match seen.failed.take() {
            Some(why) => Err(NoViewer::Refused(why)),
            None if seen.ready => Ok(()),
            None if seen.over => Err(NoViewer::Died(String::new())),
            None => Err(NoViewer::Late(patience)),
        }
    }

    /// An error with how the process ended; a process that goes on is ended.
    fn why(&mut self, error: NoViewer) -> NoViewer {
        self.to = None;
        let Some(child) = &mut self.child else { return error };
        if matches!(error, NoViewer::Late(_)) {
            // A process that is gone already is no matter.
            let _ = child.kill();
        }
        match (error, child.wait()) {
            (NoViewer::Died(_), Ok(status)) => NoViewer::Died(status.to_string()),
            (error, _) => error,
        }
    }

    /// What has arrived from the window.
    pub fn reports(&self) -> &Arc<Post<Reports>> {
        &self.reports
    }

    /// Whether the window is open, as far as is known.
    pub fn is_open(&self) -> bool {
        let seen = self.reports.look();
        self.to.is_some() && !seen.left && !seen.over
    }

    /// Tells the window something. False where it is gone; nothing is an error then.
    pub fn tell(&mut self, order: &Order) -> bool {
        if !self.is_open() {
            self.to = None;
        }
        let Some(to) = &mut self.to else { return false };
        match send(order, to) {
            Ok(()) => true,
            Err(WireError::TooLarge(_)) => {
                let text = format!("what the program sent has more than {LONGEST} bytes, and is not shown");
                send(&Order::Trouble(text), to).is_ok()
            }
            Err(_) => {
                self.to = None;
                false
            }
        }
    }

    /// Sends what has changed of the model, where `whole`, and the state.
    pub fn sync(&mut self, model: &Model, data: &Data, whole: bool) -> bool {
        if let Some(shown) = self.shown.as_ref().filter(|_| whole) {
            let edits = changes(shown, model);
            if !edits.is_empty() {
                self.shown = Some(model.clone());
                self.tell(&Order::Edits(edits));
            }
        }
        self.tell(&Order::State(StateCopy::of(data)))
    }

    /// Takes note that the program has taken over settings that the window has told of, so that they are no news to it.
    pub fn agrees(&mut self, model: &Model) {
        if let Some(shown) = &mut self.shown {
            let edits = changed_settings(shown, model);
            // Settings of a model fit another one.
            let _ = apply(shown, &edits);
        }
    }

    /// Sends camera and options.
    pub fn look(&mut self, sight: Sight) -> bool {
        self.turn += 1;
        self.tell(&Order::Sight(Box::new(TurnedSight { turn: self.turn, sight })))
    }

    /// The sight that a person has chosen after hearing the program's last word on it, once.
    pub fn seen(&mut self) -> Option<Sight> {
        let told = self.reports.look().sight.take()?;
        (told.turn >= self.turn).then_some(told.sight)
    }

    /// Closes the window, and waits for its process to end; one that hangs is ended.
    pub fn close(&mut self) {
        self.tell(&Order::Close);
        self.to = None;
        let Some(mut child) = self.child.take() else { return };
        let until = Instant::now() + FAREWELL;
        while matches!(child.try_wait(), Ok(None)) && Instant::now() < until {
            std::thread::sleep(Duration::from_millis(5));
        }
        // A process that is gone already is no matter.
        let _ = child.kill();
        let _ = child.wait();
    }

    /// Number of the window's process.
    pub fn process(&self) -> Option<u32> {
        self.child.as_ref().map(Child::id)
    }
}

impl Drop for Client {
    fn drop(&mut self) {
        self.close();
    }
}

/// A stream that begins with the greeting of this protocol, which is checked when the first byte is read.
struct Greeted<R> {
    from: R,
    greeted: bool,
}

impl<R: Read> Read for Greeted<R> {
    fn read(&mut self, into: &mut [u8]) -> std::io::Result<usize> {
        if !self.greeted {
            self.greeted = true;
            greet(&mut self.from).map_err(std::io::Error::other)?;
        }
        self.from.read(into)
    }
}

/// Reads the other side's greeting.
pub(super) fn greet(from: &mut impl Read) -> Result<(), WireError> {
    match receive::<String>(from)? {
        None => Ok(()),
        Some(greeting) if greeting == PROTOCOL => Ok(()),
        Some(greeting) => Err(WireError::Version(greeting)),
    }
}
