//! Skins.

use super::requirement::{Inconsistent, ranges, require, spans};
use crate::arrays::Arrays;

pub(super) fn check(m: &Arrays) -> Result<(), Inconsistent> {
    ranges! { m:
        skin_vertadr skin_vertnum m.nskinvert;
        skin_faceadr skin_facenum m.nskinface;
        skin_boneadr skin_bonenum m.nskinbone;
        skin_bonevertadr skin_bonevertnum m.nskinbonevert;
    }
    (0..m.nskin).try_for_each(|skin| check_skin(m, skin))
}

/// Indices within one skin.
fn check_skin(m: &Arrays, skin: usize) -> Result<(), Inconsistent> {
    let range = |first: i32, count: i32| first.max(0) as usize..(first.max(0) + count) as usize;
    let vertices = m.skin_vertnum[skin];
    let coordinates = i64::from(m.skin_texcoordadr[skin]);
    let textured =
        coordinates == -1 || (coordinates >= 0 && coordinates + i64::from(vertices) <= m.nskintexvert as i64);
    require(textured, "skin_texcoordadr", skin, "the address of as many coordinates as vertices")?;
    let inside = |values: &[i32]| values.iter().all(|v| (0..vertices).contains(v));
    for f in range(m.skin_faceadr[skin], m.skin_facenum[skin]) {
        require(inside(&m.skin_face[f]), "skin_face", 3 * f, "a vertex of the skin")?;
    }
    let bones = range(m.skin_boneadr[skin], m.skin_bonenum[skin]);
    require(!bones.is_empty(), "skin_bonenum", skin, "positive")?;
    for bone in bones {
        let moved = range(m.skin_bonevertadr[bone], m.skin_bonevertnum[bone]);
        let known = inside(&m.skin_bonevertid[moved]);
        require(known, "skin_bonevertadr", bone, "the address of vertices of the skin")?;
    }
    Ok(())
}
