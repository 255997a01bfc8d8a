//! Reference motions: where a robot and an object should be at a time.

use crate::assets::Assets;
use crate::draws::Rng;
use crate::error::EnvError;
use dataset::NpzReader;
use physics::math::{ops, quat_normalize};
use robot::{Compat, Keeper};
use serde::Deserialize;
use std::io::Cursor;
use std::ops::Range;

/// Numbers that state the pose of an object: position \[m\], and orientation as a quaternion.
pub const OBJECT: usize = 7;

/// Frames of a motion are found by their time, rounded to this many per second.
const TIME_PRECISION: f64 = 1e4;

/// A reference as settings state it.
#[derive(Clone, Debug, Deserialize)]
#[serde(untagged)]
pub enum Source {
    /// A numpy archive with the arrays of [`Frames`].
    File(String),
    /// The arrays themselves: one frame is a fixed target, two are the bounds of a random one.
    Frames(Frames),
}

/// Arrays of a reference, one row a frame.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Frames {
    /// When each frame is due \[s\]; two numbers for a target that does not move.
    time: Vec<f64>,
    /// Joint positions of the robot \[rad, m\].
    robot: Vec<Vec<f64>>,
    /// Joint velocities of the robot \[rad/s, m/s\].
    robot_vel: Option<Vec<Vec<f64>>>,
    /// Poses of the object.
    object: Vec<Vec<f64>>,
    /// Where the robot starts, when not in the first frame.
    robot_init: Option<Vec<f64>>,
    /// Where the object starts, when not in the first frame.
    object_init: Option<Vec<f64>>,
}

/// A motion to follow, or a target, which may be drawn.
#[derive(Clone, Debug)]
pub struct Reference {
    compat: Compat,
    shown: Frames,
    /// Two frames between which the single one shown is drawn.
    bounds: Option<Frames>,
}

/// A reference at one time.
#[derive(Clone, Copy, Debug)]
pub struct Moment<'a> {
    /// Joint positions of the robot.
    pub robot: Blend<'a>,
    /// Joint velocities of the robot, where the reference states them.
    pub robot_vel: Option<Blend<'a>>,
    /// Pose of the object.
    pub object: [f64; OBJECT],
}

/// A row of the frame that is due, or of the two between which time is.
#[derive(Clone, Copy, Debug)]
pub struct Blend<'a> {
    before: &'a [f64],
    after: &'a [f64],
    how: How,
}

/// How two rows make one.
#[derive(Clone, Copy, Debug, PartialEq)]
enum How {
    /// The first as it is.
    First,
    /// This share of the second, the rest of the first.
    Linear(f64),
    /// As the original mixes joints: it raises what is left of one to the power of the first.
    Power(f64),
}

impl<'a> Blend<'a> {
    /// The blended row.
    pub fn values(self) -> impl ExactSizeIterator<Item = f64> + Clone + 'a {
        self.before.iter().zip(self.after).map(move |(&before, &after)| match self.how {
            How::First => before,
            How::Linear(share) => (1.0 - share) * before + share * after,
            How::Power(share) => ops::pow(1.0 - share, before) + share * after,
        })
    }
}

impl Source {
    /// The reference for a robot of `joints` joints.
    ///
    /// # Errors
    /// The file cannot be read, or arrays are missing or of wrong shapes.
    pub(super) fn load(
        &self,
        joints: usize,
        assets: &dyn Assets,
        compat: Compat,
    ) -> Result<Reference, String> {
        let mut frames = match self {
            Source::Frames(frames) => frames.clone(),
            Source::File(path) => {
                let bytes = assets.read(path)?;
                read(&bytes).map_err(|message| format!("the reference motion {path}: {message}"))?
            }
        };
        frames.check(joints).map_err(|message| format!("the reference motion: {message}"))?;
        frames.time.iter_mut().for_each(|time| *time = rounded(*time));
        Ok(Reference::new(frames, compat))
    }
}

fn read(bytes: &[u8]) -> Result<Frames, String> {
    let archive = NpzReader::read(Cursor::new(bytes)).map_err(|error| error.to_string())?;
    let rows = |name: &str| -> Result<Option<Vec<Vec<f64>>>, String> {
        let Some(array) = archive.get(name).map_err(|error| error.to_string())? else { return Ok(None) };
        let (values, rows) = (array.values.to_f64(), array.rows());
        if rows == 0 || values.is_empty() {
            return Err(format!("the array {name} is empty"));
        }
        Ok(Some(values.chunks(values.len() / rows).map(<[f64]>::to_vec).collect()))
    };
    let flat = |name: &str| Ok::<_, String>(rows(name)?.map(|rows| rows.concat()));
    let missing = |name: &str| format!("the array {name} is missing");
    Ok(Frames {
        time: flat("time")?.ok_or_else(|| missing("time"))?,
        robot: rows("robot")?.ok_or_else(|| missing("robot"))?,
        robot_vel: rows("robot_vel")?,
        object: rows("object")?.ok_or_else(|| missing("object"))?,
        robot_init: flat("robot_init")?,
        object_init: flat("object_init")?,
    })
}

impl Frames {
    fn check(&self, joints: usize) -> Result<(), String> {
        let velocities = self.robot_vel.as_deref().unwrap_or_default();
        let widths = [
            ("robot", &self.robot[..], joints),
            ("robot_vel", velocities, joints),
            ("object", &self.object, OBJECT),
            ("robot_init", self.robot_init.as_slice(), joints),
            ("object_init", self.object_init.as_slice(), OBJECT),
        ];
        for (name, rows, width) in widths {
            if let Some(row) = rows.iter().find(|row| row.len() != width) {
                return Err(format!("a row of {name} has {width} numbers, and one has {}", row.len()));
            }
            if rows.iter().flatten().any(|value| !value.is_finite()) {
                return Err(format!("{name} holds numbers that are not finite"));
            }
        }
        let frames = self.robot.len().max(self.object.len());
        let lengths = [self.robot.len(), self.object.len(), velocities.len()];
        let fit = lengths[..2].iter().all(|&n| n == 1 || n == frames)
            && [0, self.robot.len()].contains(&lengths[2]);
        if !fit || (frames > 2 && self.time.len() != frames) {
            return Err(format!(
                "robot, object and robot_vel have {lengths:?} frames for {} times; they have one frame each, or all \
                 as many as there are times",
                self.time.len()
            ));
        }
        if self.time.is_empty()
            || self.time.windows(2).any(|pair| pair[0].is_nan() || pair[1].is_nan() || pair[0] >= pair[1])
        {
            return Err("times must increase from frame to frame".into());
        }
        Ok(())
    }

    /// The frames before and after a time \[s\] and how far it is from one to the other; one frame where it is due then.
    fn around(&self, time: f64) -> (usize, Option<f64>) {
        let last = self.robot.len().max(self.object.len()) - 1;
        let due = rounded(time);
        if last == 0 || due >= self.time[last] {
            return (last, None);
        }
        let frame = self.time.partition_point(|&start| start <= due).saturating_sub(1);
        let (start, end) = (self.time[frame], self.time[frame + 1]);
        (frame, (due > start).then(|| (time - start) / (end - start)))
    }
}

/// A time \[s\] as precise as frames are found by.
fn rounded(time: f64) -> f64 {
    (time * TIME_PRECISION).round_ties_even() / TIME_PRECISION
}

impl Reference {
    fn new(frames: Frames, compat: Compat) -> Self {
        let random = frames.robot.len().max(frames.object.len()) == 2;
        let mut shown = frames.clone();
        if random {
            let first = |rows: &mut Vec<Vec<f64>>| rows.truncate(1);
            first(&mut shown.robot);
            first(&mut shown.object);
            shown.robot_vel.as_mut().map(first);
        }
        Reference { compat, shown, bounds: random.then_some(frames) }
    }

    /// Draws the target, if it is random: joint positions, joint velocities, then the object's pose.
    ///
    /// # Errors
    /// A bound that is below the other.
    pub fn draw(&mut self, rng: &mut Rng) -> Result<(), EnvError> {
        let Some(bounds) = &self.bounds else { return Ok(()) };
        let mut between = |bounds: &[Vec<f64>], shown: &mut [Vec<f64>]| {
            rng.fill_uniform_each(&bounds[0], &bounds[bounds.len() - 1], &mut shown[0])
        };
        between(&bounds.robot, &mut self.shown.robot)?;
        if let (Some(bounds), Some(shown)) = (&bounds.robot_vel, &mut self.shown.robot_vel) {
            between(bounds, shown)?;
        }
        between(&bounds.object, &mut self.shown.object)?;
        Ok(())
    }

    /// Writes or reads the target, if it is random.
    pub fn keep(&mut self, keeper: &mut Keeper) {
        if self.bounds.is_none() {
            return;
        }
        let Frames { robot, robot_vel, object, .. } = &mut self.shown;
        let rows = robot.iter_mut().chain(robot_vel.iter_mut().flatten()).chain(object);
        rows.for_each(|row| keeper.numbers(row));
    }

    /// Joint positions that the robot starts in.
    pub fn robot_init(&self) -> &[f64] {
        self.shown.robot_init.as_ref().unwrap_or(&self.shown.robot[0])
    }

    /// Pose that the object starts in.
    pub fn object_init(&self) -> &[f64] {
        self.shown.object_init.as_ref().unwrap_or(&self.shown.object[0])
    }

    /// Rows of the observation that are the same at all times and in all draws.
    pub fn constant_rows(&self) -> Vec<&'static str> {
        let frames = self.bounds.as_ref().unwrap_or(&self.shown);
        let same = |rows: &[Vec<f64>], part: Range<usize>| {
            rows.iter().all(|row| row[part.clone()] == rows[0][part.clone()])
        };
        let joints = 0..frames.robot[0].len();
        let mut constant = Vec::new();
        if same(&frames.robot, joints.clone()) {
            constant.push("targ_hand_qpos");
        }
        match &frames.robot_vel {
            None => constant.extend(["targ_hand_qvel", "hand_qvel_err"]),
            Some(rows) if same(rows, joints) => constant.push("targ_hand_qvel"),
            Some(_) => {}
        }
        if same(&frames.object, 0..3) {
            constant.push("targ_obj_com");
        }
        if same(&frames.object, 3..OBJECT) {
            constant.push("targ_obj_rot");
        }
        constant
    }

    /// The reference at a time \[s\]; after its end, the last frame. Orientations between frames are normalised.
    pub fn at(&self, time: f64) -> Moment<'_> {
        let frames = &self.shown;
        let (frame, share) = frames.around(time);
        let (joints, places) = match (share, self.compat) {
            (None, _) => (How::First, How::First),
            (Some(share), Compat::Fixed) => (How::Linear(share), How::Linear(share)),
            (Some(_), Compat::RoboHive07) => {
                let [start, end] = [frame, frame + 1].map(|k| frames.time[k]);
                let share = time - start / (end - start);
                (How::Power(share), How::Linear(share))
            }
        };
        let object = blend(&frames.object, frame, places);
        let mut pose = [0.0; OBJECT];
        pose.iter_mut().zip(object.values()).for_each(|(to, value)| *to = value);
        if self.compat == Compat::Fixed && object.how != How::First {
            let [.., w, x, y, z] = pose;
            pose[3..].copy_from_slice(&quat_normalize([w, x, y, z]));
        }
        let velocities = frames.robot_vel.as_deref();
        Moment {
            robot: blend(&frames.robot, frame, joints),
            robot_vel: velocities.map(|rows| blend(rows, frame, joints)),
            object: pose,
        }
    }
}

/// Rows of a frame and the next one; a single row holds for all frames.
fn blend(rows: &[Vec<f64>], frame: usize, how: How) -> Blend<'_> {
    match rows {
        [only] => Blend { before: only, after: only, how: How::First },
        _ => Blend { before: &rows[frame], after: &rows[(frame + 1).min(rows.len() - 1)], how },
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::FRAC_1_SQRT_2;

    fn frames(text: &str) -> Frames {
        text.parse::<toml::Table>().unwrap().try_into().unwrap()
    }

    fn object() -> Frames {
        frames(
            "time = [0.0, 0.02, 0.06]\nrobot = [[1.0], [2.0], [4.0]]\n\
             object = [[0, 0, 0, 1, 0, 0, 0], [0, 0, 1, 1, 0, 0, 0], [0, 0, 3, 0, 1, 0, 0]]",
        )
    }

    #[test]
    fn motions_are_blended_and_held() {
        let reference = Reference::new(object(), Compat::Fixed);
        let robot = |time| reference.at(time).robot.values().next().unwrap();
        assert_eq!([-1.0, 0.0, 0.02, 0.0200001, 0.06, 9.0].map(robot), [1.0, 1.0, 2.0, 2.0, 4.0, 4.0]);
        assert!((robot(0.04) - 3.0).abs() < 1e-14);
        let pose = reference.at(0.04).object;
        assert!((pose[2] - 2.0).abs() < 1e-14 && (pose[3] - FRAC_1_SQRT_2).abs() < 1e-14, "{pose:?}");
    }

    #[test]
    fn random_targets_are_drawn_between_two_frames() {
        let mut bounds = object();
        bounds.robot.truncate(2);
        bounds.object.truncate(2);
        bounds.check(1).unwrap();
        let mut reference = Reference::new(bounds, Compat::Fixed);
        let mut rng = Rng::pcg64(7_u64);
        reference.draw(&mut rng).unwrap();
        let mut draws = Rng::pcg64(7_u64);
        assert_eq!(reference.at(0.0).robot.values().next(), Some(1.0 + draws.random()));
        let height = (0..3).map(|_| draws.random()).last();
        assert_eq!(reference.at(5.0).object[2], height.unwrap());
    }

    #[test]
    fn shapes_that_do_not_fit_are_refused() {
        assert!(object().check(2).unwrap_err().contains("a row of robot has 2 numbers, and one has 1"));
        let mut wrong = object();
        wrong.object.pop();
        assert!(wrong.check(1).unwrap_err().contains("[3, 2, 0]"));
        let mut wrong = object();
        wrong.time[1] = 0.0;
        assert!(wrong.check(1).unwrap_err().contains("increase"));
        assert!(read(b"no archive").unwrap_err().contains("not a numpy archive"));
    }
}
