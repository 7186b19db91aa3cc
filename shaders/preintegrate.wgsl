#import shared/transfer

// Fills the table of a 1D function's segments (shared/curves.wgsl, preintegrated_segment).

@group(3) @binding(0) var<storage, read_write> filled: array<vec4f>;

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3u, @builtin(num_workgroups) groups: vec3u) {
    let i = id.x + id.y * groups.x * 64u;
    let front = i % TABLE_SIZE;
    let back = (i / TABLE_SIZE) % TABLE_SIZE;
    let level = i / (TABLE_SIZE * TABLE_SIZE);
    if level >= LENGTHS {
        return;
    }
    let scalars = vec2f(f32(front), f32(back)) / f32(TABLE_SIZE - 1u);
    let extent = LONGEST * exp2(LENGTH_STEP * (f32(level) - f32(LENGTHS - 1u)));
    let mean = curve_mean(scalars.x, scalars.y);
    let seen = curve_segment(scalars, extent);
    let depth = min(mean * extent, 1e25);
    var color = 0.5 * (curve_at(scalars.x).rgb + curve_at(scalars.y).rgb);
    // Where nothing absorbs, the colour is any.
    if depth > 1e-12 {
        color = seen.rgb / (depth * phi_one(depth));
    }
    filled[i] = vec4f(color, mean);
}
