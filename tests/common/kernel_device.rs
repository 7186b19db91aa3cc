//! Runs a formula of `shaders/math` over its inputs on a device.

use tetralux::gpu::{DeviceChoice, Gpu};

use super::cases::{ARGUMENTS, Kernel, all_math};

/// What no kernel gives: a place that still holds it was not written.
const SENTINEL: f32 = -7777.0;

const MAIN: &str = "
fn share_and_start(part: vec2f) -> vec2f {
    let share = max(part.y - part.x, 0.0);
    return vec2f(share, share * part.x);
}

@group(0) @binding(0) var<storage, read> inputs: array<array<f32, 6>>;
@group(0) @binding(1) var<storage, read_write> outputs: array<vec2f>;

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3u) {
    if id.x < arrayLength(&inputs) {
        let x = inputs[id.x];
        outputs[id.x] = vec2f(CALL);
    }
}
";

/// An opened device.
pub fn open() -> Gpu {
    let choice = match std::env::var("TETRALUX_GPU").as_deref() {
        Ok("hardware") => DeviceChoice::Hardware,
        _ => DeviceChoice::Software,
    };
    Gpu::new(choice).expect("a device")
}

/// A kernel's results on the device.
pub fn run(gpu: &Gpu, kernel: &Kernel) -> Vec<[f64; 2]> {
    let mut source = all_math();
    source += &MAIN.replace("CALL", kernel.call);
    let shader = gpu.device.create_shader_module(wgpu::ShaderModuleDescriptor {
        label: Some(kernel.name),
        source: wgpu::ShaderSource::Wgsl(source.into()),
    });
    let pipeline = gpu.device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
        label: Some(kernel.name),
        layout: None,
        module: &shader,
        entry_point: Some("main"),
        compilation_options: Default::default(),
        cache: None,
    });
    // As many as whole workgroups take, so that the arrays' lengths are those of the buffers.
    let mut flat: Vec<f32> = kernel.inputs.iter().flatten().copied().collect();
    let count = kernel.inputs.len().next_multiple_of(64);
    flat.resize(count * ARGUMENTS, 0.0);
    let inputs = gpu.storage("inputs", &flat);
    let bytes = count as u64 * 8;
    let usage = wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::COPY_SRC;
    let outputs = gpu.buffer("outputs", bytes, usage);
    gpu.write(&outputs, 0, bytemuck::cast_slice(&vec![SENTINEL; 2 * count]));
    let back = gpu.buffer("back", bytes, wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST);
    let group = gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
        label: Some(kernel.name),
        layout: &pipeline.get_bind_group_layout(0),
        entries: &[
            wgpu::BindGroupEntry { binding: 0, resource: inputs.as_entire_binding() },
            wgpu::BindGroupEntry { binding: 1, resource: outputs.as_entire_binding() },
        ],
    });
    let mut encoder = gpu.device.create_command_encoder(&Default::default());
    let mut pass = encoder.begin_compute_pass(&Default::default());
    pass.set_pipeline(&pipeline);
    pass.set_bind_group(0, &group, &[]);
    pass.dispatch_workgroups(count as u32 / 64, 1, 1);
    drop(pass);
    encoder.copy_buffer_to_buffer(&outputs, 0, &back, 0, bytes);
    gpu.queue.submit([encoder.finish()]);
    let results: Vec<[f32; 2]> = gpu.map(&back, bytes).expect("results");
    assert!(results.iter().flatten().all(|&r| r != SENTINEL), "'{}' left results out", kernel.name);
    results[..kernel.inputs.len()].iter().map(|r| r.map(f64::from)).collect()
}
