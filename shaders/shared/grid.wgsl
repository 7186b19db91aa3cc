// A grid of samples: voxels are visited brick by brick, 8 x 8 x 8 of them, and cut into five tetrahedra each, in every
// other voxel mirrored (src/tet/split.rs). A voxel's corner c lies (c & 1, c >> 1 & 1, c >> 2) steps from its first.

struct Grid {
    // Samples along each axis.
    points: vec3u,
    // Perspective: voxels that reach nearer are not in the picture, or drawn otherwise.
    least_depth: f32,
    // The voxel nearest to the eye: those on either side of it are drawn towards it.
    nearest: vec3u,
    // Of a tetrahedron, the longest in the grid.
    longest_edge: f32,
    // Voxels that are drawn.
    low: vec3u,
    pad_a: u32,
    high: vec3u,
    pad_b: u32,
    // Voxels that are drawn otherwise.
    near_low: vec3u,
    pad_c: u32,
    near_high: vec3u,
    pad_d: u32,
}

@group(1) @binding(0) var<uniform> grid: Grid;
@group(1) @binding(1) var<storage, read> samples: array<u32>; // see `scalar_at`
@group(1) @binding(2) var<storage, read> gradients: array<f32>; // 0..1
@group(1) @binding(3) var<storage, read> places: array<f32>; // of the samples along x, y and z
// Of the batch, in the order of drawing: x | y << 10 | z << 20.
@group(1) @binding(4) var<storage, read> bricks: array<u32>;
// What samples take, where that is little.
@group(1) @binding(6) var<storage, read> levels: array<f32>;

// Of a sample: 32 are its value, 8 or 16 its number among the levels.
override SAMPLE_BITS: u32 = 32u;

// Tetrahedra of even and odd voxels, four that are cut off and the middle: corners in ascending order, 3 bits each;
// whether that turns the tetrahedron over; the corner that is cut off.
const TETS = array<u32, 10>(0x02ac8u, 0x05cd0u, 0x08d60u, 0x0ffabu, 0x01d58u,
                            0x00888u, 0x07ed1u, 0x0af61u, 0x0dfa2u, 0x00f11u);
const MIDDLE = 4u;

fn tet_of(voxel: vec3u, k: u32) -> u32 {
    let odd = (voxel.x + voxel.y + voxel.z) & 1u;
    var tets = TETS;
    return tets[odd * 5u + k];
}

fn corners_of(tet: u32) -> vec4u {
    return (vec4u(tet) >> vec4u(0u, 3u, 6u, 9u)) & vec4u(7u);
}

fn apex_of(tet: u32) -> u32 {
    return tet >> 13u;
}

fn corner_step(corner: u32) -> vec3u {
    return vec3u(corner & 1u, (corner >> 1u) & 1u, corner >> 2u);
}

fn sample_at(at: vec3u) -> u32 {
    return at.x + grid.points.x * (at.y + grid.points.y * at.z);
}

// 0..1.
fn scalar_at(sample: u32) -> f32 {
    if SAMPLE_BITS == 32u {
        return bitcast<f32>(samples[sample]);
    }
    let bit = sample % (32u / SAMPLE_BITS) * SAMPLE_BITS;
    return levels[(samples[sample / (32u / SAMPLE_BITS)] >> bit) & (0xffffffffu >> (32u - SAMPLE_BITS))];
}

fn place_at(at: vec3u) -> vec3f {
    return vec3f(places[at.x], places[grid.points.x + at.y], places[grid.points.x + grid.points.y + at.z]);
}

// The brick's voxel of a rank in the order of drawing, far ones first; it may lie beyond the grid.
fn voxel_of(brick: u32, rank: u32) -> vec3u {
    let first = 8u * vec3u(brick & 1023u, (brick >> 10u) & 1023u, brick >> 20u);
    let nearest = min(max(grid.nearest, first) - first, vec3u(7u));
    let turn = vec3u(rank & 7u, (rank >> 3u) & 7u, rank >> 6u);
    return first + select(7u - (turn - nearest), turn, turn < nearest);
}

fn is_in(voxel: vec3u, low: vec3u, high: vec3u) -> bool {
    return all(voxel >= low) && all(voxel < high);
}

// Place and scalar.
fn vertex_at(at: vec3u) -> vec4f {
    return vec4f(place_at(at), scalar_at(sample_at(at)));
}
