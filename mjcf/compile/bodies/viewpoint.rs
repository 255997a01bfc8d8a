//! Sites, cameras and lights: things with a place in a body and no mass.

use super::geom;
use crate::compile::frame::{Pose, direction, same_frame_in_body};
use crate::compile::log::{Log, title};
use crate::compile::lookup::Lookup;
use crate::compile::nodes::{BodyNode, CameraNode, LightNode, SiteNode};
use crate::compile::values::push_user;
use crate::spec::{Camera, Compiler, Light, Site, Spec, resolve};
use crate::vector::{EPS, normalize};
use physics::geometry::shape;
use physics::math::Legible;
use physics::math::ops;
use physics::model::{GeomType, ObjType, Rows};
use std::f64::consts::PI;

/// Compiles sites, cameras and lights of a body.
pub(super) fn compile<'s>(body: &mut BodyNode<'s>, model: &'s Spec, frames: &[Pose], log: &mut Log) {
    let frame = |index: Option<usize>| index.and_then(|i| frames.get(i));
    for s in &body.spec.sites {
        let node = compile_site(s, frame(s.frame), model.compiler_at(s.loc));
        body.sites.extend(log.check(s.loc, &title("site", &s.name), node));
    }
    for c in &body.spec.cameras {
        let node = compile_camera(c, frame(c.frame), model.compiler_at(c.loc), model.visual.map.znear);
        body.cameras.extend(log.check(c.loc, &title("camera", &c.name), node));
    }
    for l in &body.spec.lights {
        let node = compile_light(l, frame(l.frame));
        body.lights.extend(log.check(l.loc, &title("light", &l.name), node));
    }
}

fn compile_site<'s>(
    spec: &'s Site,
    frame: Option<&Pose>,
    settings: &Compiler,
) -> Result<SiteNode<'s>, String> {
    if matches!(
        spec.kind,
        GeomType::Mesh | GeomType::Hfield | GeomType::Plane | GeomType::None | GeomType::Sdf
    ) {
        return Err("a site cannot be a mesh, height field or plane".into());
    }
    let (mut pose, size) = match spec.fromto {
        Some(fromto) => geom::stretched(spec.kind, spec.pos, fromto, spec.size)?,
        None => (Pose { pos: spec.pos, quat: resolve(spec.quat, spec.alt, settings)? }, spec.size),
    };
    if let Some(frame) = frame {
        pose = frame.then(&pose);
    }
    normalize(&mut pose.quat);
    shape::check_size(spec.kind, size).map_err(|error| error.to_string())?;
    Ok(SiteNode { spec, pose, size })
}

fn compile_camera<'s>(
    spec: &'s Camera,
    frame: Option<&Pose>,
    settings: &Compiler,
    znear: f32,
) -> Result<CameraNode<'s>, String> {
    let mut pose = Pose { pos: spec.pos, quat: resolve(spec.quat, spec.alt, settings)? };
    if let Some(frame) = frame {
        pose = frame.then(&pose);
    }
    normalize(&mut pose.quat);
    if spec.fovy >= 180.0 {
        return Err(format!("fovy must be below 180 degrees, is {}", Legible(spec.fovy)));
    }
    let given = [spec.focal_length, spec.focal_pixel, spec.principal_length, spec.principal_pixel];
    let sensor = spec.sensor_size[0] > 0.0 && spec.sensor_size[1] > 0.0;
    if !sensor && given.iter().flatten().any(|&x| x != 0.0) {
        return Err("focal length and principal point require sensorsize".into());
    }
    if !sensor {
        let intrinsic = [znear, znear, spec.intrinsic[2], spec.intrinsic[3]];
        return Ok(CameraNode { spec, pose, intrinsic, fovy: spec.fovy });
    }
    if spec.resolution.iter().any(|&r| r <= 0) {
        return Err(
            "attribute 'sensorsize' is shared out among pixels: set 'resolution' to how many there are"
                .into(),
        );
    }
    let length = |pixels: [f32; 2], length: [f32; 2], k: usize| {
        let density = spec.resolution[k] as f32 / spec.sensor_size[k];
        if pixels[k] != 0.0 { pixels[k] / density } else { length[k] }
    };
    let intrinsic = [
        length(spec.focal_pixel, spec.focal_length, 0),
        length(spec.focal_pixel, spec.focal_length, 1),
        length(spec.principal_pixel, spec.principal_length, 0),
        length(spec.principal_pixel, spec.principal_length, 1),
    ];
    Ok(CameraNode { spec, pose, intrinsic, fovy: field_of_view(spec.sensor_size[1] / 2.0, intrinsic[1]) })
}

/// The vertical field of view \[degrees\] of half a sensor's height and a focal length.
fn field_of_view(half_height: f32, focal: f32) -> f64 {
    f64::from(ops::atan2_single(half_height, focal)) * 360.0 / PI
}

fn compile_light<'s>(spec: &'s Light, frame: Option<&Pose>) -> Result<LightNode<'s>, String> {
    let (mut pos, mut dir) = (spec.pos, spec.dir);
    if let Some(frame) = frame {
        pos = frame.point(pos);
        dir = direction(frame.quat, dir);
    }
    if normalize(&mut dir) < EPS {
        return Err("direction has no length".into());
    }
    if !(0.0..=1.0).contains(&spec.softness) {
        return Err(format!("attribute 'softness' is {}: set it from 0 to 1", Legible(spec.softness)));
    }
    Ok(LightNode { spec, pos, dir })
}

/// Appends the sites of `body`.
pub(super) fn fill_sites(m: &mut Rows, body: &BodyNode, id: usize, lookup: &Lookup, log: &mut Log) {
    for node in &body.sites {
        let spec = node.spec;
        let what = title("site", &spec.name);
        m.site_type.push(spec.kind.code());
        m.site_bodyid.push(id as i32);
        m.site_matid.push(lookup.reference(ObjType::Material, &spec.material, spec.loc, &what, log));
        m.site_group.push(spec.group);
        m.site_sameframe.push(same_frame_in_body(node.pose, body.inertial).code() as u8);
        m.site_size.push(node.size);
        m.site_pos.push(node.pose.pos);
        m.site_quat.push(node.pose.quat);
        let user = push_user(&mut m.site_user, &spec.userdata, m.nuser_site, "nuser_site");
        log.check(spec.loc, &what, user);
        m.site_rgba.push(spec.rgba);
    }
}

/// Appends the cameras of `body`.
pub(super) fn fill_cameras(m: &mut Rows, body: &BodyNode, id: usize, lookup: &Lookup, log: &mut Log) {
    for node in &body.cameras {
        let spec = node.spec;
        let what = title("camera", &spec.name);
        m.cam_mode.push(spec.mode.code());
        m.cam_bodyid.push(id as i32);
        m.cam_targetbodyid.push(lookup.reference(ObjType::Body, &spec.targetbody, spec.loc, &what, log));
        m.cam_pos.push(node.pose.pos);
        m.cam_quat.push(node.pose.quat);
        m.cam_projection.push(spec.proj.code());
        m.cam_fovy.push(node.fovy);
        m.cam_ipd.push(spec.ipd);
        m.cam_resolution.push(spec.resolution);
        m.cam_output.push(spec.output);
        m.cam_sensorsize.push(spec.sensor_size);
        m.cam_intrinsic.push(node.intrinsic);
        let user = push_user(&mut m.cam_user, &spec.userdata, m.nuser_cam, "nuser_cam");
        log.check(spec.loc, &what, user);
    }
}

/// Appends the lights of `body`.
pub(super) fn fill_lights(m: &mut Rows, body: &BodyNode, id: usize, lookup: &Lookup, log: &mut Log) {
    for node in &body.lights {
        let spec = node.spec;
        let what = title("light", &spec.name);
        m.light_mode.push(spec.mode.code());
        m.light_bodyid.push(id as i32);
        m.light_targetbodyid.push(lookup.reference(ObjType::Body, &spec.targetbody, spec.loc, &what, log));
        m.light_type.push(spec.kind.code());
        m.light_texid.push(lookup.reference(ObjType::Texture, &spec.texture, spec.loc, &what, log));
        m.light_castshadow.push(spec.castshadow);
        m.light_bulbradius.push(spec.bulbradius);
        m.light_intensity.push(spec.intensity);
        m.light_range.push(spec.range);
        m.light_active.push(spec.active);
        m.light_pos.push(node.pos);
        m.light_dir.push(node.dir);
        m.light_attenuation.push(spec.attenuation);
        m.light_cutoff.push(spec.cutoff);
        m.light_softness.push(spec.softness);
        m.light_exponent.push(spec.exponent);
        m.light_ambient.push(spec.ambient);
        m.light_diffuse.push(spec.diffuse);
        m.light_specular.push(spec.specular);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The reference computes the angle in single precision; rounding the one of double precision differs in the last bit.
    #[test]
    fn fields_of_view_are_those_that_the_reference_computed() {
        // Half a sensor, focal length, field of view in degrees, as bits.
        let recorded: [(u32, u32, u64); 3] = [
            (1_019_403_159, 1_027_767_904, 4_632_686_287_381_100_111),
            (1_009_917_536, 1_017_934_522, 4_632_884_938_285_835_378),
            (983_173_419, 1_021_326_580, 4_617_222_559_756_009_259),
        ];
        for (half, focal, fovy) in recorded {
            assert_eq!(field_of_view(f32::from_bits(half), f32::from_bits(focal)).to_bits(), fovy);
        }
    }
}
