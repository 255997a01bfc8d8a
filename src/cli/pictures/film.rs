//! Videos of what moves: to a file, and to the terminal while it moves.

use crate::failure::Failure;
use crate::pictures::drawing::{Drawing, Plan, frame};
use crate::pictures::look::{Size, Viewpoint};
use crate::pictures::preview::{Choice, Player, Screen};
use crate::pictures::renderer::RendererArguments;
use clap::{Args, ValueHint};
use physics::{Data, Model};
use render::picture::Channels;
use render::scene::{Effects, SceneOptions};
use render::{Painters, Settings};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use video::{FRAME_RATES, VideoFormat, VideoWriter};

/// Whether and how a video is made.
#[derive(Args)]
#[command(next_help_heading = "Video")]
pub struct FilmArguments {
    /// Write a video of what happens to this file: .mp4 (H.264), .gif, or .png (animated)
    #[arg(long, value_name = "FILE", value_hint = ValueHint::FilePath, value_parser = video_file)]
    video: Option<PathBuf>,
    /// Show what happens in the terminal, not faster than it would
    #[arg(long, value_name = "PROTOCOL", num_args = 0..=1, require_equals = true, default_missing_value = "auto")]
    preview: Option<Choice>,
    /// Columns and rows of the video, or one number for both [default: 640x480]
    #[arg(long, value_name = "WxH")]
    size: Option<Size>,
    /// Frames for each simulated second
    #[arg(long, value_name = "N", value_parser = frame_rate)]
    fps: Option<f64>,
    /// From where
    #[command(flatten)]
    viewpoint: Viewpoint,
    /// Draw no shadows
    #[arg(long)]
    no_shadows: bool,
    /// What draws
    #[command(flatten)]
    renderer: RendererArguments,
}

/// Size of a video where none is given.
const SIZE: Size = Size { width: 640, height: 480 };

fn video_file(text: &str) -> Result<PathBuf, String> {
    let path = PathBuf::from(text);
    match VideoFormat::of(&path) {
        Some(_) => Ok(path),
        None => Err("videos are .mp4, .gif or .png files".into()),
    }
}

fn frame_rate(text: &str) -> Result<f64, String> {
    let wanted = || format!("give {} to {} frames a second", FRAME_RATES.start(), FRAME_RATES.end());
    text.parse().ok().filter(|rate| FRAME_RATES.contains(rate)).ok_or_else(wanted)
}

impl FilmArguments {
    /// Begins the video that is asked for, of what has one picture every `period` of simulated time [s].
    ///
    /// # Errors
    /// An option needs a video, and none is asked for; the camera is unknown; the file cannot be written.
    pub fn film(
        &self,
        model: &Model,
        camera: &str,
        period: f64,
        painters: &dyn Painters,
    ) -> Result<Option<Film>, Failure> {
        if self.video.is_none() && self.preview.is_none() {
            return self.refuse_without().map(|()| None);
        }
        let (camera, _) = self.viewpoint.camera(model, camera)?;
        let size = self.size.unwrap_or(SIZE);
        let effects = Effects::default().with_shadows(!self.no_shadows);
        let options = SceneOptions::default().with_effects(effects);
        let plan = Plan { camera, size, options, settings: Settings::of(model) };
        let drawing = Drawing::new(model, plan, painters)?;
        let rate = self.fps.unwrap_or_else(|| default_rate(period));
        let player = self.preview.map(|choice| -> Result<Player, Failure> {
            Ok(Player::new(Screen::require(choice, "write a file with --video FILE.mp4")?, rate))
        });
        let player = player.transpose()?;
        let video = self.video.as_ref().map(|path| open(path, size, rate)).transpose()?;
        Ok(Some(Film { drawing, video, player, rate, shown: 0, path: self.video.clone() }))
    }

    /// What draws the video, and the images where `visual` says that there are some.
    ///
    /// # Errors
    /// A GPU is asked for that this build does not know, or something for a command that draws nothing.
    pub fn painters(&self, visual: bool) -> Result<Arc<dyn Painters>, Failure> {
        let draws = visual || self.video.is_some() || self.preview.is_some();
        self.renderer.painters_if(draws, "--video FILE, --preview and images")
    }

    /// Whether the terminal shows it.
    pub fn previews(&self) -> bool {
        self.preview.is_some()
    }

    fn refuse_without(&self) -> Result<(), Failure> {
        let given = [
            ("--size", self.size.is_some()),
            ("--fps", self.fps.is_some()),
            ("--no-shadows", self.no_shadows),
            ("--camera, --azimuth, --elevation, --distance or --lookat", self.viewpoint.is_given()),
        ];
        match given.iter().find(|(_, given)| *given) {
            None => Ok(()),
            Some((option, _)) => Err(Failure::usage(format!("{option} is for --video FILE or --preview"))),
        }
    }
}

fn open(path: &Path, size: Size, rate: f64) -> Result<VideoWriter, Failure> {
    VideoWriter::create(path, (size.width as u32, size.height as u32), rate).map_err(Failure::usage)
}

/// Most frames a second where the rate is not chosen: what GIF can show.
const MOST: f64 = 50.0;

/// Default frame rate [1/s] where a picture is made every `period` [s]: all pictures, or every n-th where that is
/// more than [`MOST`].
fn default_rate(period: f64) -> f64 {
    let pictures = 1.0 / period;
    // A hair below, so that 1 / 0.02 is 50.
    let every = (pictures / MOST - 1e-9).ceil().max(1.0);
    (pictures / every).clamp(*FRAME_RATES.start(), *FRAME_RATES.end())
}

/// A share of a frame by which its time may be missed, since times are sums of rounded periods.
const EARLY: f64 = 1e-6;

/// A video that is being made.
pub struct Film {
    drawing: Drawing,
    video: Option<VideoWriter>,
    player: Option<Player>,
    rate: f64,
    /// Frames of what is shown, since it began.
    shown: u64,
    path: Option<PathBuf>,
}

impl Film {
    /// A video of what `drawing` draws at this size, `rate` frames a second, in a file.
    ///
    /// # Errors
    /// The file cannot be written, or not in this size.
    pub fn to_file(path: &Path, drawing: Drawing, size: Size, rate: f64) -> Result<Self, Failure> {
        let video = open(path, size, rate)?;
        Ok(Film { drawing, video: Some(video), player: None, rate, shown: 0, path: Some(path.into()) })
    }

    /// What is shown begins again at time 0.
    pub fn begin(&mut self) {
        self.shown = 0;
    }

    /// Frames that have been due `time` after the beginning [s].
    fn due(&self, time: f64) -> u64 {
        (time * self.rate + EARLY) as u64 + 1
    }

    /// Whether [`Film::show`] would draw a state.
    pub fn is_due(&self, time: f64) -> bool {
        self.shown < self.due(time)
    }

    /// Shows a state that is reached `time` after the beginning [s]: as many frames as are due then, often none. All that
    /// is drawn must have been computed.
    ///
    /// # Errors
    /// The state cannot be drawn, or the file cannot be written.
    pub fn show(&mut self, model: &Model, data: &Data, time: f64) -> Result<(), Failure> {
        if !self.is_due(time) {
            return Ok(());
        }
        let due = self.due(time);
        let frame = frame(self.drawing.take(model, data, Channels::RGB)?)?;
        for _ in self.shown..due {
            if let Some(video) = &mut self.video {
                video.push(&frame).map_err(Failure::new)?;
            }
            if let Some(player) = &mut self.player {
                player.show(&frame);
            }
        }
        self.shown = due;
        Ok(())
    }

    /// Completes the file; what it holds, in a line. None where only the terminal shows the film.
    ///
    /// # Errors
    /// It cannot be written.
    pub fn finish(self) -> Result<Option<String>, Failure> {
        let (Some(video), Some(path)) = (self.video, self.path) else { return Ok(None) };
        let (frames, rate) = (video.frames(), (1e3 * self.rate).round() / 1e3);
        video.finish().map_err(Failure::new)?;
        Ok(Some(format!("{frames} frames, {rate} a second, in {}", path.display())))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rates_are_those_of_the_pictures_or_whole_parts_of_them() {
        for (period, rate) in [(0.04, 25.0), (0.02, 50.0), (0.01, 50.0), (0.002, 50.0), (0.015, 100.0 / 3.0)]
        {
            assert!((default_rate(period) - rate).abs() < 1e-6, "{period}: {}", default_rate(period));
        }
        assert!(FRAME_RATES.contains(&default_rate(1e9)) && FRAME_RATES.contains(&default_rate(1e-9)));
    }

    #[test]
    fn names_and_rates_are_checked() {
        assert!(video_file("a.MP4").is_ok() && video_file("a.gif").is_ok() && video_file("a.avi").is_err());
        assert!(frame_rate("30").is_ok());
        for wrong in ["0", "-1", "nan", "inf", "1e9", "x"] {
            assert!(frame_rate(wrong).is_err(), "{wrong}");
        }
    }
}
