//! The pass that sorts and composes lists, alone: what no scene is known to make.

use tetralux::gpu::Gpu;
use tetralux::gpu::layout::{Frame, Strip};

use crate::common::gpu;

/// Depth; premultiplied colour and transmittance.
type Fragment = (f32, [f32; 4]);

const BACKGROUND: [f32; 4] = [0.5, 0.5, 0.5, 1.0];

/// Composes a picture of one pixel, in one dispatch. How many pixels that left to the next one, and the picture.
fn compose(gpu: &Gpu, list: &[Fragment]) -> (u32, [f32; 4]) {
    let kernel = gpu.kernel("compose", &[("MOST_TURNS", 1000.0)]).expect("a kernel");
    let count = list.len() as u32;
    let frame = Frame { image_width: 1.0, image_height: 1.0, background: BACKGROUND, ..Frame::default() };
    let depths: Vec<f32> = list.iter().map(|fragment| fragment.0).collect();
    let colors: Vec<[f32; 4]> = list.iter().map(|fragment| fragment.1).collect();
    let usage = wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC | wgpu::BufferUsages::COPY_DST;
    let unfinished = gpu.buffer("unfinished", 4, usage);
    let buffers = [
        ("frame", gpu.uniform("frame", &[frame])),
        ("strip", gpu.uniform("strip", &[Strip { end_pixel: 1, ..Strip::default() }])),
        ("list_ends", gpu.storage("list_ends", &[count; 4])),
        ("row_bases", gpu.storage("row_bases", &[0_u32; 4])),
        ("fragments", gpu.storage("fragments", &[count; 4])),
        ("list_depths", gpu.storage("list_depths", &depths)),
        ("list_colors", gpu.storage("list_colors", &colors)),
        ("list_ranks", gpu.buffer("list_ranks", 8 * u64::from(count), usage)),
        ("list_states", gpu.buffer("list_states", 32, usage)),
        ("unfinished", unfinished.clone()),
    ];
    let size = wgpu::Extent3d { width: 1, height: 1, depth_or_array_layers: 1 };
    let picture = gpu.device.create_texture(&wgpu::TextureDescriptor {
        label: Some("picture"),
        size,
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format: wgpu::TextureFormat::Rgba32Float,
        usage: wgpu::TextureUsages::STORAGE_BINDING | wgpu::TextureUsages::COPY_SRC,
        view_formats: &[],
    });
    let view = picture.create_view(&wgpu::TextureViewDescriptor::default());
    let bind_group = |group: u32| {
        let resource = |name: &str| match buffers.iter().find(|(known, _)| *known == name) {
            Some((_, buffer)) => buffer.as_entire_binding(),
            None => wgpu::BindingResource::TextureView(&view),
        };
        let bindings = kernel.bindings.iter().filter(|b| b.group == group);
        let entries: Vec<_> =
            bindings.map(|b| wgpu::BindGroupEntry { binding: b.index, resource: resource(&b.name) }).collect();
        let layout = &kernel.pipeline.get_bind_group_layout(group);
        gpu.device.create_bind_group(&wgpu::BindGroupDescriptor { label: Some("compose"), layout, entries: &entries })
    };
    let mut encoder = gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
    let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor::default());
    pass.set_pipeline(&kernel.pipeline);
    for group in 0..4 {
        pass.set_bind_group(group, &bind_group(group), &[]);
    }
    pass.dispatch_workgroups(1, 1, 1);
    drop(pass);
    let usage = wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST;
    let texel = gpu.buffer("texel", 256, usage);
    let layout = wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(256), rows_per_image: None };
    let to = wgpu::TexelCopyBufferInfo { buffer: &texel, layout };
    encoder.copy_texture_to_buffer(picture.as_image_copy(), to, size);
    gpu.queue.submit([encoder.finish()]);
    let left: Vec<u32> = gpu.read(&unfinished, 4).expect("a count");
    let pixel: Vec<[f32; 4]> = gpu.map(&texel, 16).expect("a pixel");
    (left[0], pixel[0])
}

#[test]
fn nan_ends_a_pixel() {
    let gpu = gpu::device();
    let (red, green) = ((2.0, [0.5, 0.0, 0.0, 0.5]), (1.0, [0.0, 0.25, 0.0, 0.75]));
    // Sorted, and over the background: 0.25 green, 0.75 * 0.5 red, and 0.375 of what is behind.
    assert_eq!(compose(&gpu, &[red, green]), (0, [0.5625, 0.4375, 0.1875, 1.0]));
    for fragment in [(f32::NAN, [0.0; 4]), (1.5, [0.0, 0.0, 0.0, f32::NAN])] {
        for list in [vec![fragment, red, green], vec![red, green, fragment], vec![fragment]] {
            let (left, pixel) = compose(&gpu, &list);
            assert_eq!(left, 0, "{list:?} is never done");
            assert!(fragment.0.is_nan() || pixel[3].is_nan(), "{list:?} made {pixel:?}");
        }
    }
}
