//! Skins: surfaces whose vertices follow bodies, given in place or by an SKN file.

use crate::asset::AssetError;
use crate::diagnostic::Loc;
use physics::math::Legible;
use physics::model::bounds::MINVAL;

/// What an `asset/skin` element says, with its file already read.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct SkinSource {
    /// Name for messages.
    pub name: String,
    /// File bytes and path; then nothing is given in place.
    pub file: Option<(Vec<u8>, String)>,
    /// What is given in place.
    pub inline: RawSkin,
}

/// The arrays of a skin as a file or an element gives them.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct RawSkin {
    /// Vertex positions in the bind pose, three numbers each \[m\].
    pub vert: Vec<f32>,
    /// Texture coordinates, two numbers a vertex, or none.
    pub texcoord: Vec<f32>,
    /// Vertices of each triangle, three each.
    pub face: Vec<i32>,
    /// The bodies that move the vertices.
    pub bones: Vec<Bone>,
}

/// The rows one skin contributes to a model. The weights of a vertex add up to one.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct CompiledSkin {
    /// `skin_vert` \[m\].
    pub vert: Vec<[f32; 3]>,
    /// `skin_texcoord`; empty for none.
    pub texcoord: Vec<[f32; 2]>,
    /// `skin_face`, vertices of this skin.
    pub face: Vec<[i32; 3]>,
    /// `skin_bone*`.
    pub bones: Vec<Bone>,
}

/// A body that moves vertices of a skin.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Bone {
    /// Where the element stands in the sources.
    pub loc: Loc,
    /// Name of the body.
    pub body: String,
    /// Position of the body in the bind pose, metres.
    pub bindpos: [f32; 3],
    /// Orientation of the body in the bind pose; any length but zero.
    pub bindquat: [f32; 4],
    /// Vertices that it moves.
    pub vertid: Vec<i32>,
    /// Weight of each.
    pub vertweight: Vec<f32>,
}

/// Checks a skin and normalises weights and orientations.
///
/// # Errors
/// The file is damaged; arrays are missing, of wrong length or not finite; a vertex does not exist or has no weight.
pub fn skin(source: SkinSource) -> Result<CompiledSkin, AssetError> {
    let SkinSource { name, file, inline } = source;
    let fail = |what: String| AssetError::inconsistent(format!("skin '{name}': {what}"));
    let raw = match file {
        None => inline,
        Some(_) if inline != RawSkin::default() => {
            return Err(fail("both a file and data in place".into()));
        }
        Some((bytes, path)) => read(&bytes, &path)?,
    };
    check(&raw).map_err(fail)?;
    let RawSkin { vert, texcoord, face, mut bones } = raw;
    normalise(vert.len() / 3, &mut bones).map_err(fail)?;
    Ok(CompiledSkin {
        vert: vert.as_chunks().0.to_vec(),
        texcoord: texcoord.as_chunks().0.to_vec(),
        face: face.as_chunks().0.to_vec(),
        bones,
    })
}

/// Checks lengths, indices and numbers.
fn check(raw: &RawSkin) -> Result<(), String> {
    let RawSkin { vert, texcoord, face, bones } = raw;
    for (empty, what) in
        [(vert.is_empty(), "vertices"), (face.is_empty(), "faces"), (bones.is_empty(), "bones")]
    {
        if empty {
            return Err(format!("it has no {what}"));
        }
    }
    for (length, what) in [(vert.len(), "vertex"), (face.len(), "face")] {
        if length % 3 != 0 {
            return Err(format!("{length} numbers in '{what}', which are not three each"));
        }
    }
    let vertices = vert.len() / 3;
    if !texcoord.is_empty() && texcoord.len() != 2 * vertices {
        return Err(format!("{} numbers in 'texcoord' for {vertices} vertices", texcoord.len()));
    }
    if let Some(v) = face.iter().find(|v| !(0..vertices as i64).contains(&i64::from(**v))) {
        return Err(format!("a face has vertex {v} of {vertices}"));
    }
    for bone in bones {
        let (ids, weights) = (&bone.vertid, &bone.vertweight);
        let what = |what: String| Err(format!("bone '{}': {what}", bone.body));
        if ids.is_empty() || ids.len() != weights.len() {
            return what(format!("{} weights for {} vertices", weights.len(), ids.len()));
        }
        if let Some(v) = ids.iter().find(|v| !(0..vertices as i64).contains(&i64::from(**v))) {
            return what(format!("vertex {v} of {vertices}"));
        }
        let mut numbers = weights.iter().chain(&bone.bindpos).chain(&bone.bindquat);
        if let Some(x) = numbers.find(|x| !x.is_finite()) {
            return what(format!("a weight or bind pose is {x}"));
        }
    }
    match vert.iter().chain(texcoord).find(|x| !x.is_finite()) {
        Some(x) => Err(format!("a coordinate is {x}")),
        None => Ok(()),
    }
}

/// Divides weights by their sum at each vertex, in single precision, and orientations by their length, in double.
fn normalise(vertices: usize, bones: &mut [Bone]) -> Result<(), String> {
    let mut totals = vec![0.0_f32; vertices];
    for bone in bones.iter() {
        for (&v, weight) in bone.vertid.iter().zip(&bone.vertweight) {
            totals[v as usize] += weight;
        }
    }
    if let Some(v) = totals.iter().position(|&total| total.is_nan() || f64::from(total) <= MINVAL) {
        return Err(format!(
            "the weights of vertex {v} add up to {}, not to a positive number",
            Legible(totals[v])
        ));
    }
    for bone in bones {
        for (&v, weight) in bone.vertid.iter().zip(&mut bone.vertweight) {
            *weight /= totals[v as usize];
        }
        bone.bindquat = unit(bone.bindquat);
    }
    Ok(())
}

/// The quaternion of length one; one without direction, or within rounding of that length, stays as it is.
fn unit(quat: [f32; 4]) -> [f32; 4] {
    const ROUNDING: f64 = 1e-14;
    let wide = quat.map(f64::from);
    let square = wide.iter().fold(0.0, |sum, x| sum + x * x);
    let length = square.sqrt();
    if square < ROUNDING || (length - 1.0).abs() <= ROUNDING {
        return quat;
    }
    wide.map(|x| (x / length) as f32)
}

/// Words before the arrays: vertices, texture coordinates, triangles, bones.
const HEADER: usize = 4;
/// Words of a bone before its vertices: name, position, orientation, number of vertices.
const BONE: usize = NAME + 3 + 4 + 1;
/// Words of a name, ended by a zero byte.
const NAME: usize = 10;

/// Words of a file, in order.
struct Words<'a> {
    left: &'a [[u8; 4]],
    path: &'a str,
}

impl<'a> Words<'a> {
    fn take(&mut self, count: usize, what: &str) -> Result<&'a [[u8; 4]], AssetError> {
        let Some((taken, left)) = self.left.split_at_checked(count) else {
            let message = format!("SKN file '{}' ends within its {what}", self.path);
            return Err(AssetError::truncated(message));
        };
        self.left = left;
        Ok(taken)
    }

    fn floats(&mut self, count: usize, what: &str) -> Result<Vec<f32>, AssetError> {
        Ok(self.take(count, what)?.iter().copied().map(f32::from_le_bytes).collect())
    }

    fn integers(&mut self, count: usize, what: &str) -> Result<Vec<i32>, AssetError> {
        Ok(self.take(count, what)?.iter().copied().map(i32::from_le_bytes).collect())
    }

    /// A count, `least` or more.
    fn count(&mut self, least: i32, what: &str) -> Result<usize, AssetError> {
        let count = self.integers(1, "header")?[0];
        if count < least {
            let message = format!("SKN file '{}' announces {count} {what}", self.path);
            return Err(AssetError::malformed(message));
        }
        Ok(count as usize)
    }
}

/// MuJoCo's binary format: counts, arrays, then one bone after the other, all in words of four bytes.
fn read(bytes: &[u8], path: &str) -> Result<RawSkin, AssetError> {
    let (words, rest) = bytes.as_chunks::<4>();
    if words.len() < HEADER || !rest.is_empty() {
        let message = format!("SKN file '{path}' has {} bytes, which are no header and words", bytes.len());
        return Err(AssetError::truncated(message));
    }
    let mut words = Words { left: words, path };
    let vertices = words.count(0, "vertices")?;
    let texcoords = words.count(0, "texture coordinates")?;
    let faces = words.count(0, "faces")?;
    let bones = words.count(0, "bones")?;
    // Counts are below 2^31, so that products fit.
    let vert = words.floats(3 * vertices, "vertices")?;
    let texcoord = words.floats(2 * texcoords, "texture coordinates")?;
    let face = words.integers(3 * faces, "faces")?;
    if words.left.len() / BONE < bones {
        return Err(AssetError::truncated(format!("SKN file '{path}' ends before its {bones} bones")));
    }
    let bones = (0..bones).map(|_| bone(&mut words)).collect::<Result<_, _>>()?;
    if !words.left.is_empty() {
        let message = format!("SKN file '{path}' has {} words after its bones", words.left.len());
        return Err(AssetError::malformed(message));
    }
    Ok(RawSkin { vert, texcoord, face, bones })
}

fn bone(words: &mut Words<'_>) -> Result<Bone, AssetError> {
    let name = words.take(NAME, "bones")?.as_flattened();
    // The last byte ends the longest name.
    let name = &name[..name.len() - 1];
    let name = name.split(|&byte| byte == 0).next().unwrap_or_default();
    let body = std::str::from_utf8(name).map_err(|_| {
        let shown = String::from_utf8_lossy(name);
        AssetError::malformed(format!("SKN file '{}': the name '{shown}' of a bone is not UTF-8", words.path))
    })?;
    let mut bone = Bone { body: body.to_owned(), ..Bone::default() };
    bone.bindpos.copy_from_slice(&words.floats(3, "bones")?);
    bone.bindquat.copy_from_slice(&words.floats(4, "bones")?);
    let count = words.count(1, "vertices of a bone")?;
    bone.vertid = words.integers(count, "vertices of a bone")?;
    bone.vertweight = words.floats(count, "weights of a bone")?;
    Ok(bone)
}
