//! Pictures in the terminal.

use crate::failure::Failure;
use crate::terminal::write_bytes;
use clap::ValueEnum;
use std::io::IsTerminal;
use std::time::{Duration, Instant};
use terminal_size::{Height, Width};
use video::Frame;
use video::terminal::{Protocol, TerminalSize, preview};

/// How a terminal is sent pictures.
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Choice {
    /// What the terminal is known to understand
    Auto,
    /// Kitty's graphics: kitty, Ghostty, Konsole
    Kitty,
    /// Sixel: foot, mlterm, mintty, contour
    Sixel,
    /// Inline images: iTerm2, WezTerm
    Iterm2,
    /// Half blocks in 24-bit colours
    Blocks,
    /// Half blocks in 256 colours
    Blocks256,
}

/// Cells of a terminal that does not tell its size.
const CELLS: (u16, u16) = (80, 24);

/// Goes to the upper left corner of the terminal.
const HOME: &str = "\x1b[H";
/// Clears the terminal.
const CLEAR: &str = "\x1b[2J";

/// A terminal that shows pictures.
pub struct Screen {
    protocol: Protocol,
    size: TerminalSize,
}

impl Screen {
    /// Standard output, if it is a terminal known to show pictures, or whatever it is if a protocol is chosen.
    pub fn new(choice: Choice) -> Option<Self> {
        let protocol = match choice {
            Choice::Auto if !std::io::stdout().is_terminal() => return None,
            Choice::Auto => Protocol::detect()?,
            Choice::Kitty => Protocol::Kitty,
            Choice::Sixel => Protocol::Sixel,
            Choice::Iterm2 => Protocol::ITerm2,
            Choice::Blocks => Protocol::HalfBlocks,
            Choice::Blocks256 => Protocol::HalfBlocks256,
        };
        let told = terminal_size::terminal_size().map(|(Width(columns), Height(rows))| (columns, rows));
        let (columns, rows) = told.unwrap_or(CELLS);
        // One line stays for the prompt.
        Some(Screen { protocol, size: TerminalSize::of(columns, rows.saturating_sub(1)) })
    }

    /// The screen that is asked for.
    ///
    /// # Errors
    /// Standard output shows no pictures; `instead` is what to do then.
    pub fn require(choice: Choice, instead: &str) -> Result<Self, Failure> {
        Screen::new(choice).ok_or_else(|| {
            Failure::usage(format!(
                "standard output is not a terminal known to show pictures: {instead}, or choose a protocol, such as \
                 --preview=sixel"
            ))
        })
    }

    /// Shows a picture below what the terminal shows.
    pub fn show(&self, frame: &Frame<'_>) {
        write_bytes(preview(frame, self.protocol, self.size).as_bytes());
    }
}

/// A film in the terminal, each frame over the one before, not faster than its rate.
pub struct Player {
    screen: Screen,
    period: Duration,
    due: Option<Instant>,
}

impl Player {
    /// Plays frames of a rate [1/s].
    pub fn new(screen: Screen, frames_per_second: f64) -> Self {
        Player { screen, period: Duration::from_secs_f64(1.0 / frames_per_second), due: None }
    }

    /// Shows the next frame when its time has come.
    pub fn show(&mut self, frame: &Frame<'_>) {
        let text = preview(frame, self.screen.protocol, self.screen.size);
        let now = Instant::now();
        let due = self.due.unwrap_or(now).max(now);
        std::thread::sleep(due - now);
        let start = if self.due.is_none() { [CLEAR, HOME].concat() } else { HOME.to_owned() };
        self.due = Some(due + self.period);
        write_bytes((start + &text).as_bytes());
    }
}
