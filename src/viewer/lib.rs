//! A simulation to look at and to touch: what a viewer does, without a window.
//!
//! A [`Session`] holds a model and its state, lets time go by at a chosen speed, keeps the states that it was in, and answers
//! gestures: cameras turn, bodies are picked and pulled. Windows, pages and scripts drive the same session.
//!
//! ```
//! # use mjcf as robohive_mjcf;
//! use robohive_viewer::{Grip, Plane, Session};
//!
//! let text = "<mujoco><worldbody><light pos='0 0 3'/><geom type='plane' size='2 2 .1'/>\
//!             <body name='ball' pos='0 0 .5'><freejoint/><geom size='.2'/></body></worldbody></mujoco>";
//! let mut session = Session::new(robohive_mjcf::load_str(text)?.model)?;
//!
//! // A tenth of a second goes by, which is fifty steps of two milliseconds.
//! session.run(true);
//! assert_eq!(session.advance(0.1, &mut || true), 50);
//!
//! // Double click on the middle of the picture, then drag upwards.
//! let ball = session.select(16.0 / 9.0, [0.5, 0.5]).ok_or("nothing there")?;
//! assert_eq!(ball.body, 1);
//! session.grab(Grip::Pull);
//! session.drag(Plane::Vertical, [0.0, 0.5]);
//! session.advance(0.3, &mut || true);
//! assert!(session.data().state.qvel[2] > 0.0, "it rises");
//!
//! // And back.
//! session.step_back();
//! assert_eq!(session.history().behind(), 1);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # Conventions
//! - Places in a picture are measured from its lower left corner to 1 at the right and the upper edge.
//! - Drags are measured in heights of the picture, to the right and up.

mod camera;
mod command;
mod drawing;
pub mod element;
mod files;
mod flags;
mod ghost;
mod hand;
mod history;
mod noise;
mod own;
mod play;
mod pointer;
mod profile;
pub mod remote;
mod replay;
mod session;
pub mod settings;
mod signals;
mod speed;
mod tape;
pub mod text;
mod watch;
#[cfg(feature = "window")]
pub mod window;

pub use camera::{Plane, orbit, pan, zoom};
pub use command::{Command, FRAMES, LABELS, Shortcut, shortcuts};
pub use drawing::{Drawing, Scenery};
pub use files::{Files, FilesError, MOST_BYTES, Unreadable, is_archive, is_model};
pub use flags::{EFFECTS, Flag, SHOW};
pub use hand::{Grip, Hand};
pub use history::History;
pub use noise::Noise;
pub use own::{OwnModelError, load_own, own_loader, own_models};
pub use play::{Acting, Play, PlayError};
pub use pointer::{Picked, pick, ray_through};
pub use profile::{FRAMES_KEPT, Frame, Profile, convergence};
pub use replay::{Reference, Replay};
pub use session::{ForeignTrajectory, KEPT_KEYS, Look, Selected, Session, TapeError};
pub use signals::{Series, Signal, Signals};
pub use speed::{Pace, SPEEDS};
pub use tape::Recorded;
pub use watch::{WatchError, watch};
