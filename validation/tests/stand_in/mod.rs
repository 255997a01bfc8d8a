//! A model with the names and counts of a recorded one, and nothing else of it.

use dataset::npz::NpzReader;
use env::Injected;
use physics::math::quat_to_mat;
use serde_json::Value;
use std::collections::HashMap;
use std::fmt::Write;

/// Kinds of joints, by MuJoCo's numbers.
const JOINTS: [&str; 4] = ["free", "ball", "slide", "hinge"];

/// MJCF of a stand-in: every joint on a body of its own, in order; sites, bodies and geoms in the world at the poses that
/// they had when the recorded model was loaded.
pub fn text(meta: &Value) -> String {
    let (world, actuators) = (format!("{}{}", moving(meta), still(meta)), actuators(meta));
    let sensors: String = list(meta, "sensors")
        .enumerate()
        .map(|(index, sensor)| format!("<clock name='{}'/>\n", named(sensor, "sensor", index)))
        .collect();
    let mut keys: String = list(meta, "keys")
        .map(|key| {
            format!("<key qpos='{}'/>\n", numbers(if key["qpos"].is_array() { &key["qpos"] } else { key }))
        })
        .collect();
    // Starts of episodes; nothing of them is compared.
    keys += "<key/><key/>";
    format!(
        "<mujoco><compiler angle='radian' autolimits='true' boundmass='1e-9' boundinertia='1e-9'/>\
         <option timestep='{}'/>\
         <asset><hfield name='terrain' nrow='100' ncol='100' size='1 1 1 1'/></asset>\
         <worldbody>{world}</worldbody><actuator>{actuators}</actuator><sensor>{sensors}</sensor>\
         <keyframe>{keys}</keyframe></mujoco>",
        meta["timestep"]
    )
}

/// Joints, each on a body of its own.
fn moving(meta: &Value) -> String {
    let mut world = String::new();
    let inertia = "<inertial pos='0 0 0' mass='1e-9' diaginertia='1e-9 1e-9 1e-9'/>";
    let mut free = expected_free(meta);
    for (index, joint) in list(meta, "joints").enumerate() {
        let kind = JOINTS[joint["type"].as_u64().unwrap() as usize];
        let limits = format!("range='{}' limited='auto'", numbers(&joint["range"]));
        let limits = if kind == "free" || kind == "ball" { String::new() } else { limits };
        let reference = joint["qpos0"][0].as_f64().filter(|_| kind == "slide" || kind == "hinge");
        let limits = reference.map_or(limits.clone(), |reference| format!("{limits} ref='{reference}'"));
        let name = if kind == "free" { free.next() } else { None };
        let body = name.map_or_else(|| format!("of joint {index}"), String::from);
        let joint = named(joint, "joint", index);
        _ = writeln!(
            world,
            "<body name='{body}'><joint name='{joint}' type='{kind}' {limits}/>{inertia}</body>"
        );
    }
    world
}

/// Bodies, geoms and sites that rest in the world.
fn still(meta: &Value) -> String {
    let mut world = String::new();
    let free = list(meta, "joints").filter(|joint| joint["type"] == 0).count();
    let placed: Vec<_> = expected_free(meta).take(free).collect();
    for index in 0..meta["sizes"]["nmocap"].as_u64().unwrap_or(0) {
        // The one that a task asks for by name is the first.
        let name = if index == 0 { "opponent".to_string() } else { format!("mocap {index}") };
        _ = writeln!(world, "<body name='{name}' mocap='true'/>");
    }
    for (index, body) in list(meta, "bodies").enumerate() {
        let name = named(body, "body", index);
        if name == "world" || placed.contains(&name.as_str()) {
            continue;
        }
        let mass = body["mass"].as_f64().unwrap().max(1e-9);
        _ = writeln!(
            world,
            "<body name='{name}' pos='{}' quat='{}'><inertial pos='0 0 0' mass='{mass}' diaginertia='1 1 1'/></body>",
            numbers(&body["xpos"]),
            numbers(&body["xquat"])
        );
    }
    // Bodies that the original finds by their place in the model.
    for name in ["key", "object"] {
        if !list(meta, "bodies").any(|body| body["name"] == name) {
            _ = writeln!(world, "<body name='{name}'><geom name='{name}' size='.01' mass='0'/></body>");
        }
    }
    for (index, geom) in list(meta, "geoms").enumerate() {
        let shape = if named(geom, "geom", index) == "terrain" {
            "type='hfield' hfield='terrain'"
        } else {
            "size='.01'"
        };
        _ = writeln!(
            world,
            "<geom name='{}' {shape} pos='{}' contype='0' conaffinity='0' mass='0'/>",
            named(geom, "geom", index),
            numbers(&geom["xpos"])
        );
    }
    for (index, site) in list(meta, "sites").enumerate() {
        let (pos, quat) = (numbers(&site["xpos"]), numbers(&site["xquat"]));
        _ = writeln!(world, "<site name='{}' pos='{pos}' quat='{quat}'/>", named(site, "site", index));
    }
    world
}

/// Actuators, all on the first joint that has one axis.
fn actuators(meta: &Value) -> String {
    let first = list(meta, "joints").position(|joint| joint["type"].as_u64() >= Some(2)).unwrap_or(0);
    let joint = named(&meta["joints"][first], "joint", first);
    let mut actuators = String::new();
    for (index, actuator) in list(meta, "actuators").enumerate() {
        let kind = if actuator["muscle"] == true { "muscle lengthrange='0 1'" } else { "general" };
        let range = numbers(&actuator["ctrlrange"]);
        let name = named(actuator, "actuator", index);
        _ = writeln!(
            actuators,
            "<{kind} name='{name}' joint='{joint}' ctrllimited='true' ctrlrange='{range}'/>"
        );
    }
    actuators
}

/// Bodies that a task expects to be free; in the record, bodies and joints are not paired.
fn expected_free(meta: &Value) -> impl Iterator<Item = &str> {
    list(meta, "bodies").filter_map(|body| body["name"].as_str()).filter(|name| name.starts_with("obj"))
}

fn list<'a>(meta: &'a Value, kind: &str) -> impl Iterator<Item = &'a Value> {
    meta[kind].as_array().unwrap_or_else(|| panic!("no {kind}")).iter()
}

/// The element's name, or one that no task asks for.
fn named(element: &Value, kind: &str, index: usize) -> String {
    match element["name"].as_str() {
        Some(name) if !name.is_empty() => name.to_string(),
        _ => format!("{kind} {index}"),
    }
}

fn numbers(values: &Value) -> String {
    let values = values.as_array().map_or(&[][..], Vec::as_slice);
    values.iter().map(ToString::to_string).collect::<Vec<_>>().join(" ")
}

/// The rows of a record.
pub struct Columns {
    arrays: HashMap<String, (usize, Vec<f64>)>,
    /// Control period \[s\].
    dt: f64,
    /// Names of elements whose columns the arrays hold, by kind.
    names: HashMap<&'static str, Vec<String>>,
}

impl Columns {
    pub fn new(archive: &NpzReader, meta: &Value) -> Self {
        let mut arrays = HashMap::new();
        for name in archive.names().filter(|name| *name != "meta") {
            let array = archive.require(name).unwrap();
            arrays.insert(name.to_string(), (array.rows(), array.values.to_f64()));
        }
        let kinds = [("sites", "site"), ("bodies", "body"), ("geoms", "geom"), ("sensors", "sensor")];
        let names = kinds.map(|(list_of, kind)| {
            (
                kind,
                list(meta, list_of).enumerate().map(|(index, element)| named(element, kind, index)).collect(),
            )
        });
        Columns { arrays, dt: meta["dt"].as_f64().unwrap(), names: names.into() }
    }

    pub fn states(&self) -> usize {
        self.arrays["time"].0
    }

    /// Whether time is set by a count of steps, and not the recorded one.
    pub fn counts_steps(&self) -> bool {
        self.arrays.contains_key("obs_dict/phase_var")
    }

    pub fn row(&self, name: &str, state: usize) -> Option<&[f64]> {
        let (rows, values) = self.arrays.get(name)?;
        let width = values.len() / rows;
        let state = state.min(rows - 1);
        Some(&values[state * width..(state + 1) * width])
    }

    /// Writes a recorded state where physics would have left it.
    pub fn inject(&self, state: usize, to: &mut Injected<'_>) {
        let d = &mut to.scene.data;
        for (name, array) in
            [("qpos", &mut d.state.qpos), ("qvel", &mut d.state.qvel), ("act", &mut d.state.act)]
        {
            if let Some(row) = self.row(name, state) {
                array.copy_from_slice(row);
            }
        }
        d.state.time = self.row("time", state).unwrap()[0];
        for (name, array) in [
            ("mocap_pos", d.state.mocap_pos.as_flattened_mut()),
            ("mocap_quat", d.state.mocap_quat.as_flattened_mut()),
        ] {
            if let Some(row) = self.row(name, state) {
                array.copy_from_slice(row);
            }
        }
        if let Some(control) = self.row("control", state) {
            to.control.copy_from_slice(control);
        }
        if let (true, Some(steps)) = (self.counts_steps(), self.row("extra/steps", state)) {
            // Counted by the original before the step; here by the time after it.
            d.state.time = (steps[0] + 1.0) * self.dt;
            *to.steps = steps[0] as usize + 1;
        }
        for name in ["actuator_length", "actuator_velocity", "actuator_force"] {
            if let Some(row) = self.row(&format!("derived/{name}"), state) {
                assert_eq!(d.assign(name, row), Some(true), "{name}");
            }
        }
        for (kind, fields) in [
            ("site", &["site_xpos", "site_xmat"][..]),
            ("body", &["xpos", "xquat", "xmat", "xipos", "cvel", "subtree_com"]),
            ("geom", &["geom_xpos"]),
            ("sensor", &["sensordata"]),
        ] {
            for field in fields {
                if let Some(row) = self.row(&format!("derived/{field}"), state) {
                    self.scatter(kind, field, row, to);
                }
            }
        }
        // A frame of inertia that the record has as an observation alone.
        if let Some(&[w, x, y, z]) = self.row("obs_dict/curr_obj_rot", state) {
            for body in self.ids("body", to) {
                to.scene.data.kin.ximat[body] = quat_to_mat([w, x, y, z]);
            }
        }
        let poses =
            [("site", "site_pos"), ("site", "site_quat"), ("body", "body_pos"), ("body", "body_quat")];
        for (kind, field) in poses {
            if let Some(row) = self.row(field, state) {
                self.place(kind, field, row, to);
            }
        }
    }

    fn ids<'a>(&'a self, kind: &str, to: &'a Injected<'_>) -> Vec<usize> {
        let m = &to.scene.model;
        let id = |name: &String| match kind {
            "site" => m.site(name.as_str()).map(|id| id.index()),
            "body" => m.body(name.as_str()).map(|id| id.index()),
            "geom" => m.geom(name.as_str()).map(|id| id.index()),
            _ => m.sensor(name.as_str()).map(|id| id.index()),
        };
        self.names[kind].iter().map(|name| id(name).unwrap_or_else(|| panic!("no {kind} {name}"))).collect()
    }

    /// Writes columns of named elements into an array of all elements.
    fn scatter(&self, kind: &str, field: &str, row: &[f64], to: &mut Injected<'_>) {
        let ids = self.ids(kind, to);
        let mut all = Vec::new();
        to.scene.data.visit(&to.scene.model, &mut |name, _, values| {
            if name == field {
                all = values.to_f64();
            }
        });
        write_columns(&mut all, row, &ids);
        assert_eq!(to.scene.data.assign(field, &all), Some(true), "{field}");
    }

    fn place(&self, kind: &str, field: &str, row: &[f64], to: &mut Injected<'_>) {
        let ids = self.ids(kind, to);
        to.scene
            .overwrite(|m| {
                let array = match field {
                    "site_pos" => m.site_pos.as_flattened_mut(),
                    "site_quat" => m.site_quat.as_flattened_mut(),
                    "body_pos" => m.body_pos.as_flattened_mut(),
                    _ => m.body_quat.as_flattened_mut(),
                };
                write_columns(array, row, &ids);
            })
            .expect("recorded numbers");
    }
}

fn write_columns(all: &mut [f64], row: &[f64], ids: &[usize]) {
    let width = row.len().checked_div(ids.len()).unwrap_or(0);
    for (place, &id) in ids.iter().enumerate() {
        all[id * width..(id + 1) * width].copy_from_slice(&row[place * width..(place + 1) * width]);
    }
}
