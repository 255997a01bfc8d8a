//! The two layouts of RoboHive's recordings, and what a name of one is called in the other.

/// How the rows of a trial are named.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Layout {
    /// By environment: `time`, `observations`, `actions`, `rewards`, `done`, `env_infos/…`. A trial of `h` steps has `h + 1`
    /// rows, the action of the last is NaN.
    #[default]
    RoboHive,
    /// By robot: `data/…`, `derived/…`, `config/…`.
    RoboSet,
}

impl Layout {
    /// Its name.
    pub fn name(self) -> &'static str {
        match self {
            Layout::RoboHive => "RoboHive",
            Layout::RoboSet => "RoboSet",
        }
    }

    /// The layout of a trial with these keys, if it is one of the two.
    pub fn of<'a>(keys: impl IntoIterator<Item = &'a str>) -> Option<Self> {
        let mut found = None;
        for key in keys {
            if key.starts_with("data/") {
                return Some(Layout::RoboSet);
            }
            if key.starts_with("env_infos/") || ["observations", "actions", "rewards"].contains(&key) {
                found = Some(Layout::RoboHive);
            }
        }
        found
    }
}

/// Where the rows of a name go.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Route {
    /// To another name.
    Whole(String),
    /// The first numbers of a row to one name, the rest to another.
    Split {
        /// Numbers of the first.
        at: usize,
        /// Both names.
        to: [String; 2],
    },
    /// To one name with the rows of another, behind (`part` 1) or before (0) them.
    Join {
        /// The name.
        to: String,
        /// Which of the two.
        part: usize,
    },
}

/// Joints of the arm that RoboSet is about; the other actions are its gripper's.
const ARM: usize = 7;

/// Numbers of a position; the rest of a pose is its rotation.
const POSITION: usize = 3;

const OBSERVED: &str = "env_infos/obs_dict/";

/// Names that stand under `env_infos/obs_dict/` in one layout and under `data/` in the other.
const STATES: [&str; 7] = ["qp_arm", "qv_arm", "tau_arm", "qp_ee", "qv_ee", "tau_ee", "user"];

/// Parts of the names of cameras.
const CAMERAS: [&str; 4] = ["left", "right", "top", "wrist"];

/// Where rows of RoboHive's name `key` go in RoboSet's layout; nowhere, if it has no place for them.
pub fn to_roboset(key: &str) -> Vec<Route> {
    let whole = |to: String| vec![Route::Whole(to)];
    match key {
        "actions" => vec![Route::Split { at: ARM, to: ["data/ctrl_arm".into(), "data/ctrl_ee".into()] }],
        "env_infos/obs_dict/time" => whole("data/time".into()),
        "env_infos/obs_dict/pos_ee" => vec![Route::Join { to: "derived/pose_ee".into(), part: 0 }],
        "env_infos/obs_dict/rot_ee" => vec![Route::Join { to: "derived/pose_ee".into(), part: 1 }],
        "user_cmt" => whole("config/solved".into()),
        "seed" => whole("config/seed".into()),
        _ => {
            if let Some(state) = key.strip_prefix(OBSERVED).filter(|name| STATES.contains(name)) {
                return whole(format!("data/{state}"));
            }
            let name = key.rsplit('/').next().unwrap_or(key);
            let parts: Vec<&str> = name.split(':').collect();
            let camera = parts.get(1).and_then(|camera| CAMERAS.iter().find(|known| camera.contains(*known)));
            match (parts[0], camera) {
                (kind @ ("rgb" | "d"), Some(camera)) => whole(format!("data/{kind}_{camera}")),
                _ => Vec::new(),
            }
        }
    }
}

/// Where rows of RoboSet's name `key` go in RoboHive's layout; nowhere, if it has no place for them. Images name their
/// size; `row` is the shape of one.
pub fn to_robohive(key: &str, row: &[usize]) -> Vec<Route> {
    let observed = |name: &str| format!("{OBSERVED}{name}");
    let part = |part| vec![Route::Join { to: "actions".into(), part }];
    match key {
        "data/ctrl_arm" => part(0),
        "data/ctrl_ee" => part(1),
        "data/time" => vec![Route::Whole("time".into()), Route::Whole(observed("time"))],
        "derived/pose_ee" => {
            vec![Route::Split { at: POSITION, to: [observed("pos_ee"), observed("rot_ee")] }]
        }
        "config/solved" => vec![Route::Whole("user_cmt".into())],
        "config/seed" => vec![Route::Whole("seed".into())],
        _ => {
            let Some(name) = key.strip_prefix("data/") else { return Vec::new() };
            if STATES.contains(&name) {
                return vec![Route::Whole(observed(name))];
            }
            match (name.split_once('_'), row) {
                (Some((kind @ ("rgb" | "d"), camera)), [height, width, ..]) if CAMERAS.contains(&camera) => {
                    let name = format!("env_infos/visual_dict/{kind}:{camera}_cam:{height}x{width}:2d");
                    vec![Route::Whole(name)]
                }
                _ => Vec::new(),
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_name_that_goes_over_comes_back() {
        let row = [240, 424, 3];
        let names = STATES.map(|name| format!("{OBSERVED}{name}")).into_iter();
        let images = ["rgb", "d"].iter().flat_map(|kind| {
            CAMERAS.map(|camera| format!("env_infos/visual_dict/{kind}:{camera}_cam:240x424:2d"))
        });
        for name in names.chain(images).chain(["user_cmt", "seed"].map(String::from)) {
            let there = to_roboset(&name);
            let [Route::Whole(over)] = &there[..] else { panic!("{name}: {there:?}") };
            assert_eq!(to_robohive(over, &row), [Route::Whole(name)]);
        }
    }

    #[test]
    fn names_without_a_place_have_none() {
        for name in ["rewards", "env_infos/rwd_dense", "env_infos/obs_dict/hand_err", "rgb:front_cam:8x8:2d"]
        {
            assert_eq!(to_roboset(name), [], "{name}");
        }
        assert_eq!(to_robohive("data/user_input", &[]), []);
    }

    #[test]
    fn layouts_are_told_by_their_names() {
        assert_eq!(Layout::of(["config/solved", "data/time"]), Some(Layout::RoboSet));
        assert_eq!(Layout::of(["time", "env_infos/solved"]), Some(Layout::RoboHive));
        assert_eq!(Layout::of(["time", "x"]), None);
    }
}
