#import shared/bound
#import shared/grid
#import shared/reached

// What a transfer function can make of a grid's tetrahedra.

// Off: every cell is a candidate.
override CULL: bool = true;

// Of a tetrahedron, as shared/bound.wgsl has it.
fn tet_bound(voxel: vec3u, corners: vec4u) -> f32 {
    let a = voxel + corner_step(corners.x);
    let b = voxel + corner_step(corners.y);
    let c = voxel + corner_step(corners.z);
    let d = voxel + corner_step(corners.w);
    var magnitudes = vec4f(0.0);
    if BIVARIATE {
        magnitudes = vec4f(gradients[sample_at(a)], gradients[sample_at(b)], gradients[sample_at(c)],
                           gradients[sample_at(d)]);
    }
    return depth_bound(vertex_at(a), vertex_at(b), vertex_at(c), vertex_at(d), magnitudes);
}

fn is_candidate(depth: f32) -> bool {
    return !CULL || depth > INVISIBLE;
}

// Whether the function can show any of a voxel, by the ranges of its samples.
fn may_show(voxel: vec3u) -> bool {
    var low = vec2f(1e30);
    var high = vec2f(-1e30);
    for (var corner = 0u; corner < 8u; corner++) {
        let at = sample_at(voxel + corner_step(corner));
        var value = vec2f(scalar_at(at), 0.0);
        if BIVARIATE {
            value.y = gradients[at];
        }
        low = min(low, value);
        high = max(high, value);
    }
    return is_candidate(box_bound(low, high) * grid.longest_edge);
}

// The bands of a tetrahedron.
fn tet_bands(voxel: vec3u, corners: vec4u, depth: f32) -> u32 {
    let scalars = vec4f(scalar_at(sample_at(voxel + corner_step(corners.x))),
                        scalar_at(sample_at(voxel + corner_step(corners.y))),
                        scalar_at(sample_at(voxel + corner_step(corners.z))),
                        scalar_at(sample_at(voxel + corner_step(corners.w))));
    let reached = scalar_range(scalars);
    return bands_between(reached.x, reached.y, depth > THIN);
}
