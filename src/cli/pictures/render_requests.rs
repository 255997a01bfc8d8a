//! `bench-render --requests`: pictures one kind at a time, for a program that measures processor time around each.

use crate::failure::Failure;
use crate::pictures::studio::{Kind, Studio, camera, start};
use crate::terminal::show_json;
use physics::{Data, forward};
use render::painter::Cpu;
use render::scene::Camera;
use serde_json::{Value, json};
use std::time::Instant;

/// Most pictures that a request can ask for, and most columns of one.
const MOST: usize = 1_000_000;
/// Environments of a batch.
const ENVIRONMENTS: usize = 64;

/// One line of the standard input.
enum Request {
    /// `state Q Q ...`: keep one more state, with these positions.
    State(Vec<f64>),
    /// `KIND SIDE N`: draw N pictures, going through the states.
    Draw(Kind, usize, usize),
    /// `other CAMERA SIDE N`: the same in colours from this camera.
    Other(String, usize, usize),
    /// `both CAMERA SIDE N`: the same in colours, each state from both cameras.
    Both(String, usize, usize),
    /// `batch SIDE T`: each of 64 environments once, in colours, on T threads.
    Batch(usize, usize),
}

impl Request {
    fn parse(line: &str) -> Option<Request> {
        let words: Vec<&str> = line.split_whitespace().collect();
        let number = |word: &str| word.parse().ok().filter(|number| (1..=MOST).contains(number));
        Some(match words.as_slice() {
            ["state", numbers @ ..] => {
                Request::State(numbers.iter().map(|word| word.parse().ok()).collect::<Option<_>>()?)
            }
            ["other", camera, side, count] => {
                Request::Other((*camera).to_owned(), number(side)?, number(count)?)
            }
            ["both", camera, side, count] => {
                Request::Both((*camera).to_owned(), number(side)?, number(count)?)
            }
            ["batch", side, threads] => Request::Batch(number(side)?, number(threads)?),
            [kind, side, count] => {
                let (_, kind) = Kind::ALL.into_iter().find(|(name, _)| name == kind)?;
                Request::Draw(kind, number(side)?, number(count)?)
            }
            _ => return None,
        })
    }
}

/// States of a model, and what draws them.
pub struct Requests<'a> {
    studio: Studio<'a>,
    camera: Camera,
    states: Vec<Data>,
}

impl<'a> Requests<'a> {
    /// Pictures from one camera; states come by request.
    pub fn new(studio: Studio<'a>, camera: Camera) -> Self {
        Requests { studio, camera, states: Vec::new() }
    }

    /// Answers every line of standard input by a line of JSON, until the input ends.
    pub fn answer(mut self) -> Result<(), Failure> {
        for line in std::io::stdin().lines() {
            let line = line.map_err(Failure::new)?;
            let request = Request::parse(&line).ok_or_else(|| {
                Failure::usage(format!(
                    "request {line:?} is not `state Q...`, `rgb`, `plain`, `depth` or `ids` with `SIDE N`, \
                     `other` or `both` with `CAMERA SIDE N`, or `batch SIDE T`"
                ))
            })?;
            show_json(&self.serve(request)?);
        }
        Ok(())
    }

    fn serve(&mut self, request: Request) -> Result<Value, Failure> {
        if self.states.is_empty() && !matches!(request, Request::State(_)) {
            return Err(Failure::usage("there is no state yet: `state Q...`"));
        }
        match request {
            Request::State(positions) => self.keep(&positions)?,
            Request::Draw(kind, side, count) => self.draw(&[self.camera], side, kind, count)?,
            Request::Other(name, side, count) => {
                self.draw(&[camera(self.studio.model, &name)?], side, Kind::Rgb, count)?;
            }
            Request::Both(name, side, count) => {
                let cameras = [self.camera, camera(self.studio.model, &name)?];
                self.draw(&cameras, side, Kind::Rgb, count)?;
            }
            Request::Batch(side, threads) => {
                let seconds = self.batch(side, threads)?;
                return Ok(json!({"frames": ENVIRONMENTS, "seconds": seconds}));
            }
        }
        let [items, triangles] = self.studio.load();
        Ok(json!({"states": self.states.len(), "items": items, "triangles": triangles}))
    }

    /// Draws pictures of `count` states, one from each camera.
    fn draw(&mut self, cameras: &[Camera], side: usize, kind: Kind, count: usize) -> Result<(), Failure> {
        for data in self.states.iter().cycle().take(count) {
            self.studio.take(data, cameras, side, kind)?;
        }
        Ok(())
    }

    fn keep(&mut self, positions: &[f64]) -> Result<(), Failure> {
        let model = self.studio.model;
        let mut data = start(model)?;
        if data.state.qpos.len() != positions.len() {
            let (expected, found) = (data.state.qpos.len(), positions.len());
            return Err(Failure::usage(format!("a state has {expected} positions, not {found}")));
        }
        data.state.qpos.copy_from_slice(positions);
        forward(model, &mut data).map_err(Failure::new)?;
        self.states.push(data);
        Ok(())
    }

    /// Wall time [s] of one picture of every environment, the threads' memory being there.
    fn batch(&self, side: usize, threads: usize) -> Result<f64, Failure> {
        let (model, assets, camera) = (self.studio.model, &self.studio.assets, self.camera);
        let environments: Vec<&Data> = self.states.iter().cycle().take(ENVIRONMENTS).collect();
        let mut studios: Vec<Studio<'_>> = (0..threads).map(|_| Studio::new(model, assets, &Cpu)).collect();
        let mut began = Instant::now();
        for _ in 0..2 {
            began = Instant::now();
            std::thread::scope(|scope| {
                let share = ENVIRONMENTS.div_ceil(threads);
                let parts = studios.iter_mut().zip(environments.chunks(share));
                let running: Vec<_> = parts
                    .map(|(studio, part)| {
                        scope.spawn(move || {
                            part.iter().try_for_each(|data| {
                                studio.take(data, &[camera], side, Kind::Rgb).map(|_| ())
                            })
                        })
                    })
                    .collect();
                let panicked = || Failure::new("a thread panicked while it drew");
                running.into_iter().try_for_each(|thread| thread.join().map_err(|_| panicked())?)
            })?;
        }
        Ok(began.elapsed().as_secs_f64())
    }
}
