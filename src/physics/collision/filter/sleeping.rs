//! Pairs of which neither can move, because they sleep.

use crate::model::Model;
use crate::sleep::{Awake, is_on};
use crate::stages::State;

/// Which pairs sleep leaves out.
#[derive(Clone, Copy)]
pub(crate) struct SleepFilter<'a> {
    /// The model lets trees sleep: of a predefined pair, one body must be able to move.
    sleeps: bool,
    pub awake: Awake<'a>,
}

impl<'a> SleepFilter<'a> {
    /// Leaves out nothing.
    pub fn none() -> Self {
        SleepFilter { sleeps: false, awake: Awake::EVERYTHING }
    }

    /// Leaves out what sleeps in this state.
    pub fn of(m: &Model, state: &'a State) -> Self {
        SleepFilter { sleeps: is_on(m), awake: Awake::of(m, state) }
    }

    /// Whether a predefined pair stands still.
    pub fn drops(self, m: &Model, pair: usize) -> bool {
        let body = |geom: i32| m.geom_bodyid[geom as usize] as usize;
        let stands = |geom: i32| {
            let b = body(geom);
            let fixed = m.body_treeid[b] < 0 && m.body_mocapid[m.body_rootid[b] as usize] < 0;
            fixed || self.awake.sleeps(b)
        };
        self.sleeps && stands(m.pair_geom1[pair]) && stands(m.pair_geom2[pair])
    }
}
