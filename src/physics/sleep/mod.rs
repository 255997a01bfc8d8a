//! Sleep: trees at rest are skipped by all stages until something wakes them (MuJoCo documentation, Computation,
//! "Sleeping islands").
//!
//! `State::tree_asleep` says which trees sleep: below -1 a tree is awake, and counts up with every step in which it is slow
//! enough; at -1 it is ready; from 0 on it sleeps, and the number names another tree of the same island, so that the trees
//! that fell asleep together form a cycle. [`update`] derives everything else in `State` about sleep from these numbers.
//!
//! Stages leave what they computed of a sleeping tree as it was. Without the flag `sleep`, and while nothing sleeps, they
//! work on everything.

pub(crate) mod object;
pub(crate) mod rest;
pub(crate) mod wake;

use crate::model::{Enable, Model};
use crate::stages::State;

/// What `body_awake` says of a body.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Activity {
    /// It cannot move: fixed to the world, and not moved by the user.
    Static,
    /// Its tree sleeps.
    Asleep,
    /// Its tree is awake, or the user moves it.
    Awake,
}

impl Activity {
    fn code(self) -> i32 {
        match self {
            Activity::Static => -1,
            Activity::Asleep => 0,
            Activity::Awake => 1,
        }
    }
}

/// Steps during which a tree must be slow before it sleeps.
const SLOW_STEPS: i32 = 10;
/// `tree_asleep` of a tree that has moved.
pub(crate) const MOVED: i32 = -(1 + SLOW_STEPS);
/// `tree_asleep` of a tree that may fall asleep.
pub(crate) const READY: i32 = -1;

/// True when the model lets trees sleep.
#[inline]
pub(crate) fn is_on(m: &Model) -> bool {
    m.opt.enableflags.contains(Enable::SLEEP)
}

/// Numbers of elements, ascending.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Subset<'a> {
    /// All up to this one.
    All(usize),
    /// These.
    Listed(&'a [i32]),
}

/// Runs an expression with an iterator over a subset: compiled for all and for a list, so that all costs no more than a loop.
macro_rules! over {
    ($subset:expr, |$items:ident| $work:expr) => {
        match $subset {
            $crate::sleep::Subset::All(count) => {
                let $items = 0..count;
                $work
            }
            $crate::sleep::Subset::Listed(list) => {
                let $items = list.iter().map(|&i| i as usize);
                $work
            }
        }
    };
}
pub(crate) use over;

/// What stages work on: everything, or what is awake.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Awake<'a> {
    lists: Option<&'a State>,
}

impl<'a> Awake<'a> {
    /// Everything.
    pub const EVERYTHING: Awake<'static> = Awake { lists: None };

    /// What is awake in a state. Not inlined: loops over elements would ask again for every element.
    #[inline(never)]
    pub fn of(m: &Model, state: &'a State) -> Self {
        Awake { lists: (is_on(m) && state.ntree_awake < m.ntree).then_some(state) }
    }

    /// True when nothing sleeps.
    pub fn is_everything(self) -> bool {
        self.lists.is_none()
    }

    /// Bodies that do not sleep, the world first.
    pub fn bodies(self, m: &Model) -> Subset<'a> {
        self.lists.map_or(Subset::All(m.nbody), |s| Subset::Listed(&s.body_awake_ind[..s.nbody_awake]))
    }

    /// Bodies whose parent does not sleep; where nothing does, the world too.
    pub fn children(self, m: &Model) -> Subset<'a> {
        self.lists.map_or(Subset::All(m.nbody), |s| Subset::Listed(&s.parent_awake_ind[..s.nparent_awake]))
    }

    /// Degrees of freedom that do not sleep.
    pub fn dofs(self, m: &Model) -> Subset<'a> {
        self.lists.map_or(Subset::All(m.nv), |s| Subset::Listed(&s.dof_awake_ind[..s.nv_awake]))
    }

    /// Whether body `b` sleeps.
    #[inline]
    pub fn sleeps(self, b: usize) -> bool {
        self.lists.is_some_and(|s| s.body_awake[b] == Activity::Asleep.code())
    }

    /// Whether body `b` may have moved.
    #[inline]
    pub fn moves(self, b: usize) -> bool {
        self.lists.is_none_or(|s| s.body_awake[b] == Activity::Awake.code())
    }

    /// Whether an element sleeps, by a function of [`object`].
    #[inline]
    pub fn skips(self, activity: impl FnOnce(&State) -> Activity) -> bool {
        self.lists.is_some_and(|s| activity(s) == Activity::Asleep)
    }

    /// Whether an element is awake, by a function of [`object`].
    #[inline]
    pub fn has_awake(self, activity: impl FnOnce(&State) -> Activity) -> bool {
        self.lists.is_none_or(|s| activity(s) == Activity::Awake)
    }
}

/// Derives all that follows from `tree_asleep`.
pub(crate) fn update(m: &Model, state: &mut State) {
    state.ntree_awake = 0;
    for tree in 0..m.ntree {
        let awake = state.tree_asleep[tree] < 0;
        state.tree_awake[tree] = awake.into();
        state.ntree_awake += usize::from(awake);
    }
    (state.nbody_awake, state.nparent_awake, state.nv_awake) = (0, 0, 0);
    for b in 0..m.nbody {
        let activity = match usize::try_from(m.body_treeid[b]) {
            Ok(tree) if state.tree_awake[tree] != 0 => Activity::Awake,
            Ok(_) => Activity::Asleep,
            Err(_) if m.body_mocapid[m.body_rootid[b] as usize] >= 0 => Activity::Awake,
            Err(_) => Activity::Static,
        };
        state.body_awake[b] = activity.code();
        if activity != Activity::Asleep {
            state.body_awake_ind[state.nbody_awake] = b as i32;
            state.nbody_awake += 1;
        }
        if b > 0 && state.body_awake[m.body_parentid[b] as usize] != Activity::Asleep.code() {
            state.parent_awake_ind[state.nparent_awake] = b as i32;
            state.nparent_awake += 1;
        }
    }
    for dof in 0..m.nv {
        if state.tree_awake[m.dof_treeid[dof] as usize] != 0 {
            state.dof_awake_ind[state.nv_awake] = dof as i32;
            state.nv_awake += 1;
        }
    }
}
