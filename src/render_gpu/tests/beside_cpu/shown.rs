//! Pictures that stay on a GPU which somebody else has opened.

use super::{Shot, renderer};
use render::scene::SceneOptions;
use render::{Picture, RenderError};
use robohive_render_gpu::{GpuError, GpuRenderer, Shown, wgpu};
use std::path::Path;

/// A device as a window opens it: on any adapter, with all that it offers.
fn device() -> Option<(wgpu::Adapter, wgpu::Device, wgpu::Queue)> {
    let mut descriptor = wgpu::InstanceDescriptor::new_without_display_handle();
    descriptor.backends = wgpu::Backends::PRIMARY;
    let backends = descriptor.backends;
    let adapters = pollster::block_on(wgpu::Instance::new(descriptor).enumerate_adapters(backends));
    let adapter = adapters.into_iter().next()?;
    let wanted = wgpu::DeviceDescriptor { required_limits: adapter.limits(), ..Default::default() };
    let (device, queue) = pollster::block_on(adapter.request_device(&wanted)).expect("a device");
    Some((adapter, device, queue))
}

fn own(file: &str, camera: &str) -> Shot {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../assets").join(file);
    let model = mjcf::load(&path).expect("an own model").model;
    Shot::of(&model, camera, &SceneOptions::default())
}

/// Mirrors, shadows, a sky and transparent surfaces.
#[test]
fn a_shown_picture_has_the_bytes_of_one_that_is_read_back_and_is_opaque() {
    let Some((adapter, device, queue)) = device() else { return };
    let shots = [own("yard/yard.xml", "free"), own("franka/franka_table.xml", "front")];
    let mut shared = GpuRenderer::shared(shots[0].settings, &adapter, &device, &queue).expect("a renderer");
    for (shot, size) in shots.iter().zip([[160, 121], [91, 64]]) {
        let mut own = renderer(shot.settings).expect("there is a GPU");
        let expected = shot.on_gpu(&mut own, size);
        shared.set(&shot.settings).expect("settings of another model");
        let Shown { taken, .. } = shared.show(&shot.assets, &shot.scene, size).expect("a picture");
        let even = size.map(|side| side.next_multiple_of(2) as f32);
        assert_eq!(taken, [size[0] as f32 / even[0], size[1] as f32 / even[1]]);
        let shown = shared.read_shown(size).expect("its bytes");
        let (pixels, _) = shown.as_chunks::<4>();
        assert!(pixels.iter().all(|pixel| pixel[3] == 255));
        let rgb: Vec<u8> = pixels.iter().flat_map(|&[r, g, b, _]| [r, g, b]).collect();
        assert!(rgb == expected.rgb, "{size:?}");
    }
}

#[test]
fn the_texture_stays_the_same_until_the_size_changes() {
    let Some((adapter, device, queue)) = device() else { return };
    let shot = own("pile/pile.xml", "free");
    let mut gpu = GpuRenderer::shared(shot.settings, &adapter, &device, &queue).expect("a renderer");
    let mut view = |size| gpu.show(&shot.assets, &shot.scene, size).map(|shown| shown.view.clone());
    let first = view([64, 48]).expect("a picture");
    assert_eq!(view([64, 48]).expect("a picture"), first);
    assert_ne!(view([66, 48]).expect("a picture"), first);
    assert_eq!(view([0, 48]), Err(GpuError::Render(RenderError::Size { width: 0, height: 48 })));
    assert!(matches!(
        gpu.draw(&shot.assets, &shot.scene, render::picture::Channels::ALL, &mut Picture::new(8, 8)),
        Ok(())
    ));
}
