#import shared/frame
#import shared/range
#import shared/bound
#import shared/reached

// Marks the cells that the transfer function can make visible, independent of the view, and finds their bands.

@group(1) @binding(0) var<storage, read> tets: array<vec4u>; // of the range
@group(1) @binding(1) var<storage, read> volumes: array<f32>; // of the range
@group(1) @binding(2) var<storage, read> vertices: array<vec4f>;
@group(1) @binding(3) var<storage, read> gradients: array<f32>;
@group(3) @binding(1) var<storage, read_write> candidates: array<u32>; // one bit a cell of the range

// The bands of each cell of the range that is a candidate (curves only).
@group(3) @binding(2) var<storage, read_write> cell_bands: array<u32>;
@group(3) @binding(3) var<storage, read_write> band_totals: BandTotals;

struct BandTotals {
    bands: atomic<u32>,
    // Pairs of them, the last one of a cell perhaps alone.
    pairs: atomic<u32>,
    // Bands in one cell.
    most: atomic<u32>,
    // Deep cells.
    deep: atomic<u32>,
}

// Off: every cell of non-zero volume is a candidate.
override CULL: bool = true;

var<workgroup> block_flags: array<atomic<u32>, 8>;

fn scalars_of(tet: vec4u) -> vec4f {
    return vec4f(vertices[tet.x].w, vertices[tet.y].w, vertices[tet.z].w, vertices[tet.w].w);
}

fn cell_depth_bound(tet: vec4u) -> f32 {
    var magnitudes = vec4f(0.0);
    if BIVARIATE {
        magnitudes = vec4f(gradients[tet.x], gradients[tet.y], gradients[tet.z], gradients[tet.w]);
    }
    return depth_bound(vertices[tet.x], vertices[tet.y], vertices[tet.z], vertices[tet.w], magnitudes);
}

@compute @workgroup_size(256)
fn main(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u,
        @builtin(local_invocation_index) lane: u32) {
    let block = group.x + group.y * groups.x;
    let i = block * 256u + lane;
    if lane < 8u {
        atomicStore(&block_flags[lane], 0u);
    }
    workgroupBarrier();
    if i < range.tet_count && volumes[i] != 0.0 {
        let depth = cell_depth_bound(tets[i]);
        if !CULL || depth > INVISIBLE {
            atomicOr(&block_flags[lane >> 5u], 1u << (i & 31u));
            if PIECES > 0u {
                let scalars = scalar_range(scalars_of(tets[i]));
                let bands = bands_between(scalars.x, scalars.y, depth > THIN);
                cell_bands[i] = bands;
                atomicAdd(&band_totals.bands, band_count(bands));
                atomicAdd(&band_totals.pairs, (band_count(bands) + 1u) >> 1u);
                atomicMax(&band_totals.most, band_count(bands));
                if depth > THIN {
                    atomicAdd(&band_totals.deep, 1u);
                }
            }
        }
    }
    workgroupBarrier();
    if block * 256u < range.tet_count && lane < 8u {
        candidates[block * 8u + lane] = atomicLoad(&block_flags[lane]);
    }
}
