// The most layers that any pixel of a slab has: more than the slab's format can blend well are drawn again in two.

@group(3) @binding(0) var layers: texture_2d<f32>;
@group(3) @binding(1) var<storage, read_write> most_layers: atomic<u32>;

@compute @workgroup_size(256)
fn main(@builtin(global_invocation_id) id: vec3u, @builtin(num_workgroups) groups: vec3u) {
    let size = textureDimensions(layers);
    let i = id.x + id.y * groups.x * 256u;
    if i < size.x * size.y {
        let count = u32(textureLoad(layers, vec2u(i % size.x, i / size.x), 0).r);
        if count > 0u {
            atomicMax(&most_layers, count);
        }
    }
}
