//! A `Spec` of the elements that Python holds.

use super::origin::Origin;
use super::value::take;
use super::{deformable, parts};
use mjcf::diagnostic::Loc;
use mjcf::spec::*;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList};
use std::collections::HashMap;
use viewer::settings::assign_choice;

/// An element of Python: attributes, body, frame, the description it was made in, where that one's text declares it.
type Row<'py> = (Bound<'py, PyDict>, i64, i64, u32, Option<(u32, u32)>);
/// Numbers of settings by name.
type Settings = HashMap<String, Vec<f64>>;

/// Texts of each further description are numbered from its number times this.
const TEXTS: u32 = 1 << 20;

/// What a tree of Python consists of.
pub struct Tree<'a, 'py> {
    pub elements: &'a Bound<'py, PyDict>,
    /// The tree's own origin, then the origins of attached models, each with the dictionary of its settings.
    pub origins: Vec<(&'a Origin, &'a Bound<'py, PyDict>)>,
    /// Sizes and statistics.
    pub general: &'a Bound<'py, PyDict>,
    /// `option` and the groups of `visual`.
    pub options: HashMap<String, Settings>,
}

impl<'py> Tree<'_, 'py> {
    /// The description.
    ///
    /// # Errors
    /// A `ValueError` that names the attribute whose value does not fit.
    pub fn spec(&self) -> PyResult<Spec> {
        let mut spec = Spec::default();
        self.settings(&mut spec)?;
        take(self.general, &mut spec.size)?;
        take(self.general, &mut spec.stat)?;
        if let Some(name) = self.general.get_item("modelname")? {
            spec.modelname = name.extract()?;
        }
        for (group, settings) in &self.options {
            for (name, numbers) in settings {
                assign(&mut spec, group, name, numbers)?;
            }
        }
        self.frames(&mut spec)?;
        self.tree(&mut spec)?;
        self.lists(&mut spec)?;
        Ok(spec)
    }

    fn settings(&self, spec: &mut Spec) -> PyResult<()> {
        for (number, (origin, settings)) in self.origins.iter().enumerate() {
            let base = number as u32 * TEXTS;
            let mut compiler = Compiler::default();
            take(settings, &mut compiler)?;
            if let Some(options) = settings.get_item("LRopt")? {
                take(options.getattr("__dict__")?.cast()?, &mut compiler.lengthrange)?;
            }
            let shifted = origin.attached.iter().map(|(file, own)| (file.saturating_add(base), own.clone()));
            spec.attached.extend(shifted);
            match number {
                0 => spec.compiler = compiler,
                _ => _ = spec.attached.insert(base, compiler),
            }
        }
        Ok(())
    }

    fn rows(&self, kind: &str) -> PyResult<Vec<Row<'py>>> {
        match self.elements.get_item(kind)? {
            Some(rows) => rows.cast::<PyList>()?.iter().map(|row| row.extract()).collect(),
            None => Ok(Vec::new()),
        }
    }

    fn loc(&self, row: &Row<'_>) -> Loc {
        let base = row.3.saturating_mul(TEXTS);
        match row.4 {
            Some((file, offset)) if file < TEXTS => Loc { file: file.saturating_add(base), offset },
            _ if base > 0 => Loc { file: base, offset: 0 },
            _ => Loc::NONE,
        }
    }

    fn frames(&self, spec: &mut Spec) -> PyResult<()> {
        for row in self.rows("frame")? {
            let mut frame =
                Frame { loc: self.loc(&row), parent: usize::try_from(row.2).ok(), ..Frame::default() };
            take(&row.0, &mut frame)?;
            frame.alt = parts::take_orientation(&row.0, "alt")?;
            spec.frames.push(frame);
        }
        Ok(())
    }

    /// Bodies with what they hold; each row names a body before it.
    fn tree(&self, spec: &mut Spec) -> PyResult<()> {
        let rows = self.rows("body")?;
        let mut bodies: Vec<Body> = Vec::with_capacity(rows.len());
        for row in &rows {
            let mut body = Body { loc: self.loc(row), frame: usize::try_from(row.2).ok(), ..Body::default() };
            take(&row.0, &mut body)?;
            body.alt = parts::take_orientation(&row.0, "alt")?;
            body.keyed = parts::take_shares(&row.0)?;
            body.plugin = deformable::take_use(&row.0, body.loc)?;
            bodies.push(body);
        }
        macro_rules! hold {
            ($($kind:literal $type:ident $list:ident |$element:ident, $row:ident| $($more:expr)?;)*) => {
                $(for $row in self.rows($kind)? {
                    let frame = usize::try_from($row.2).ok();
                    let mut $element = $type { loc: self.loc(&$row), frame, ..$type::default() };
                    take(&$row.0, &mut $element)?;
                    $($more;)?
                    let holder = usize::try_from($row.1).ok().and_then(|body| bodies.get_mut(body));
                    holder.ok_or_else(misplaced)?.$list.push($element);
                })*
            };
        }
        hold! {
            "joint" Joint joints |joint, row| joint.keyed = parts::take_shares(&row.0)?;
            "geom" Geom geoms |geom, row| {
                geom.alt = parts::take_orientation(&row.0, "alt")?;
                geom.plugin = deformable::take_use(&row.0, geom.loc)?;
            };
            "site" Site sites |site, row| site.alt = parts::take_orientation(&row.0, "alt")?;
            "camera" Camera cameras |camera, row| camera.alt = parts::take_orientation(&row.0, "alt")?;
            "light" Light lights |_light, _row|;
        }
        let groups = spec.compiler.inertiagrouprange;
        for (body, row) in bodies.iter_mut().zip(&rows).skip(1) {
            let weighs = body.geoms.iter().any(|geom| (groups[0]..=groups[1]).contains(&geom.group));
            body.inertial = parts::take_inertial(&row.0, weighs, body.loc)?;
        }
        for (child, row) in rows.iter().enumerate().skip(1).rev() {
            let parent =
                usize::try_from(row.1).ok().filter(|&parent| parent < child).ok_or_else(misplaced)?;
            let body = bodies.pop().ok_or_else(misplaced)?;
            bodies[parent].bodies.insert(0, body);
        }
        // Where only settings are of interest no body is given.
        spec.world = bodies.pop().unwrap_or_default();
        spec.world.name = "world".into();
        Ok(())
    }

    fn lists(&self, spec: &mut Spec) -> PyResult<()> {
        macro_rules! lists {
            ($($kind:literal $type:ident $list:ident |$element:ident, $row:ident| $($more:expr)?;)*) => {
                $(for $row in self.rows($kind)? {
                    let mut $element = $type { loc: self.loc(&$row), ..$type::default() };
                    take(&$row.0, &mut $element)?;
                    $($more;)?
                    spec.$list.push($element);
                })*
            };
        }
        lists! {
            "mesh" Mesh meshes |x, row| {
                (x.file, x.path) = self.place(&row, "file", |c| &c.meshdir)?;
                x.plugin = deformable::take_use(&row.0, x.loc)?;
            };
            "flex" Flex flexes |x, row| x.empty_cells = parts::required(&row.0, "_empty_cells")?.extract()?;
            "skin" Skin skins |x, row| {
                (x.file, x.path) = self.place(&row, "file", |c| &c.meshdir)?;
                x.bones = deformable::take_bones(&row.0, x.loc)?;
            };
            "hfield" Hfield hfields |x, row| (x.file, x.path) = self.place(&row, "file", |c| &c.meshdir)?;
            "texture" Texture textures |x, row| self.place_texture(&mut x, &row)?;
            "material" Material materials |_x, _row|;
            "pair" Pair pairs |_x, _row|;
            "exclude" Exclude excludes |_x, _row|;
            "equality" Equality equalities |_x, _row|;
            "tendon" Tendon tendons |x, row| x.path = parts::take_path(&row.0, x.loc)?;
            "actuator" Actuator actuators |x, row| {
                x.keyed = parts::take_shares(&row.0)?;
                x.plugin = deformable::take_use(&row.0, x.loc)?;
            };
            "sensor" Sensor sensors |x, row| x.plugin = deformable::take_use(&row.0, x.loc)?;
            "numeric" Numeric numerics |_x, _row|;
            "text" Text texts |_x, _row|;
            "tuple" Tuple tuples |x, row| x.entries = parts::take_entries(&row.0)?;
        }
        for row in self.rows("extension")? {
            spec.extensions.push(deformable::take_extension(&row.0, self.loc(&row))?);
        }
        for row in self.rows("plugin")? {
            spec.plugins.push(deformable::take_instance(&row.0, self.loc(&row))?);
        }
        for row in self.rows("key")? {
            let mut key = Key { loc: self.loc(&row), ..Key::default() };
            take(&row.0, &mut key)?;
            if row.0.get_item("_kept")?.map_or(Ok(false), |kept| kept.is_truthy())? {
                let Key { name, loc, time, .. } = key;
                spec.kept_keys.push(KeptKey { name, loc, time, own: true });
            } else {
                spec.keys.push(key);
            }
        }
        Ok(())
    }

    /// What is opened for the file that an asset names, and how the model records it.
    fn place(
        &self,
        row: &Row<'_>,
        attribute: &str,
        dir: impl Fn(&Compiler) -> &str,
    ) -> PyResult<(String, String)> {
        let name: String = match row.0.get_item(attribute)? {
            Some(name) => name.extract()?,
            None => String::new(),
        };
        self.placed(row, &name, dir)
    }

    fn placed(
        &self,
        row: &Row<'_>,
        name: &str,
        dir: impl Fn(&Compiler) -> &str,
    ) -> PyResult<(String, String)> {
        let Some((origin, settings)) = self.origins.get(row.3 as usize) else { return Err(misplaced()) };
        let mut compiler = Compiler::default();
        take(settings, &mut compiler)?;
        // What the text names stays what the reader found, while the directories stay.
        if let Some(opened) =
            origin.opened.get(&(dir(&compiler).to_owned(), compiler.strippath, name.to_owned()))
        {
            return Ok((opened.clone(), name.to_owned()));
        }
        Ok(compiler.asset_file(&origin.folder, dir(&compiler), name))
    }

    fn place_texture(&self, texture: &mut Texture, row: &Row<'_>) -> PyResult<()> {
        (texture.file, texture.path) = self.place(row, "file", |c| &c.texturedir)?;
        let names: Vec<String> = match row.0.get_item("cubefiles")? {
            Some(names) => names.extract()?,
            None => Vec::new(),
        };
        for (side, name) in names.iter().enumerate().take(texture.cubefiles.len()) {
            (texture.cubefiles[side], texture.cubepaths[side]) = self.placed(row, name, |c| &c.texturedir)?;
        }
        Ok(())
    }
}

fn misplaced() -> PyErr {
    PyValueError::new_err("an element stands in a body that is not part of the tree")
}

fn assign(spec: &mut Spec, group: &str, name: &str, numbers: &[f64]) -> PyResult<()> {
    let fits = assign_choice(&mut spec.option, &mut spec.visual, group, name, numbers);
    match fits {
        Some(true) => Ok(()),
        _ => Err(PyValueError::new_err(format!("{numbers:?} is no value of {group}.{name}"))),
    }
}
