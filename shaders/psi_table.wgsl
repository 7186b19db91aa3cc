#import math/psi

// Fills the table of psi over 1 - (1 + t)^(-1/4) of both extinctions (shared/table.wgsl).

@group(3) @binding(0) var<storage, read_write> filled: array<vec4f>;

override TABLE_SIZE: u32 = 2u;

// The extinction of a node; the last is as good as infinite.
fn extinction_of(node: u32) -> f32 {
    let rest = 1.0 - f32(min(node, TABLE_SIZE - 1u)) / f32(TABLE_SIZE - 1u);
    let square = max(rest * rest, 1e-12);
    return 1.0 / (square * square) - 1.0;
}

fn node(i: u32, j: u32) -> f32 {
    return psi(extinction_of(i), extinction_of(j));
}

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3u) {
    let i = id.x % TABLE_SIZE;
    let j = id.x / TABLE_SIZE;
    if j < TABLE_SIZE {
        filled[id.x] = vec4f(node(i, j), node(i + 1u, j), node(i, j + 1u), node(i + 1u, j + 1u));
    }
}
