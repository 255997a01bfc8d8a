//! The state of a simulation on its way between processes.

use super::numbers::Numbers;
use super::wire::record;
use physics::data::State;
use physics::{Data, Snapshot};

/// All that decides what is seen of a simulation of a known model.
#[derive(Clone, Debug, PartialEq)]
pub struct StateCopy {
    /// Simulation time \[s\].
    pub time: f64,
    /// Trees, bodies, bodies by their parents, and degrees of freedom that are awake.
    awake: [usize; 4],
    /// The arrays of the table of [`State`], in order.
    arrays: Vec<Numbers>,
}

record!(StateCopy { time, awake, arrays });

impl StateCopy {
    /// The state of `data`.
    pub fn of(data: &Data) -> Self {
        let state = &data.state;
        StateCopy {
            time: state.time,
            awake: [state.ntree_awake, state.nbody_awake, state.nparent_awake, state.nv_awake],
            arrays: (0..).map_while(|number| state.array(number)).map(Numbers::from).collect(),
        }
    }

    /// Overwrites the state of a simulation; what follows from it is as it was. False where it is none of this model: then
    /// the data stay as they were.
    #[must_use]
    pub fn write(&self, data: &mut Data) -> bool {
        let lengths = (0..).map_while(|number| data.state.array(number));
        let fits = lengths.clone().count() == self.arrays.len()
            && lengths.zip(&self.arrays).all(|(slice, numbers)| numbers.fits(&slice));
        if !fits {
            return false;
        }
        let mut state = data.state.clone();
        state.time = self.time;
        [state.ntree_awake, state.nbody_awake, state.nparent_awake, state.nv_awake] = self.awake;
        for (number, numbers) in self.arrays.iter().enumerate() {
            if let Some(array) = state.array_mut(number) {
                numbers.copy_to(array);
            }
        }
        if !leads_somewhere(&state) {
            return false;
        }
        data.state = state;
        // A state from elsewhere is evaluated with everything awake, once.
        let mut snapshot = Snapshot::default();
        data.save(&mut snapshot);
        data.restore(&snapshot).is_ok()
    }
}

/// Whether the lists of what is awake lead to elements.
fn leads_somewhere(state: &State) -> bool {
    let within = |list: &[i32], count: usize, below: usize| {
        let inside = |&index: &i32| usize::try_from(index).is_ok_and(|index| index < below);
        list.get(..count).is_some_and(|counted| counted.iter().all(inside))
    };
    let (trees, bodies, dofs) = (state.tree_asleep.len(), state.body_awake.len(), state.dof_awake_ind.len());
    state.ntree_awake <= trees
        && state.tree_asleep.iter().all(|&next| i64::from(next) < trees as i64)
        && within(&state.body_awake_ind, state.nbody_awake, bodies)
        && within(&state.parent_awake_ind, state.nparent_awake, bodies)
        && within(&state.dof_awake_ind, state.nv_awake, dofs)
}
