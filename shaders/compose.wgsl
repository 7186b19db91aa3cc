#import shared/frame
#import shared/lists

// Sorts each pixel's list, front first, and composes it. Runs are merged, two at a time, into runs twice as long. A
// pixel leaves a dispatch after MOST_TURNS turns of loops and goes on in the next.

@group(3) @binding(3) var<storage, read> fragments: array<u32>; // listed, of each pixel
@group(3) @binding(4) var<storage, read> list_depths: array<f32>;
@group(3) @binding(5) var<storage, read> list_colors: array<vec4f>;
// Twice as long as lists: the fragments of the runs that are merged, and those of the runs that are made.
@group(3) @binding(6) var<storage, read_write> list_ranks: array<u32>;
// Of each pixel of the strip: how far it is, and what it has seen.
@group(3) @binding(7) var<storage, read_write> list_states: array<vec4u>;
@group(3) @binding(8) var<storage, read_write> unfinished: atomic<u32>;
@group(3) @binding(9) var picture: texture_storage_2d<rgba32float, write>;

// Those of gpu/lists.rs: pixels of a workgroup, vectors of a pixel's state.
const GROUP: u32 = 64u;
const STATE_VECTORS: u32 = 2u;

override MOST_TURNS: u32 = 8192u;
// On: pixels without fragments stay as they are.
override KEEPS_OTHERS: bool = false;
// Nothing behind less is seen.
const OPAQUE: f32 = 1e-7;
// A pixel that is done has runs so long.
const DONE: u32 = 0xffffffffu;

// Whether fragment `a` of a list comes before `b`. At one depth the colours decide: which of them was listed first is a
// matter of chance.
fn is_before(start: u32, depths: vec2f, a: u32, b: u32) -> bool {
    if depths.x != depths.y {
        return depths.x < depths.y;
    }
    let p = list_colors[start + a];
    let q = list_colors[start + b];
    if p.a != q.a {
        return p.a < q.a;
    }
    if p.r != q.r {
        return p.r < q.r;
    }
    if p.g != q.g {
        return p.g < q.g;
    }
    return p.b < q.b;
}

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3u, @builtin(num_workgroups) groups: vec3u) {
    let in_strip = id.x + id.y * groups.x * GROUP;
    let pixel = strip.first_pixel + in_strip;
    if pixel >= strip.end_pixel {
        return;
    }
    let width = u32(frame.image_width);
    let list = list_of(pixel, width);
    let count = fragments[pixel];
    if KEEPS_OTHERS && count == 0u {
        return;
    }
    // Length of the runs; made or composed fragments; where the two runs are that are merged.
    var run = 1u;
    var made = 0u;
    var heads = vec2u(0u);
    var color = vec3f(0.0);
    var transmittance = 1.0;
    if strip.goes_on != 0u {
        let state = list_states[STATE_VECTORS * in_strip];
        if state.x == DONE {
            return;
        }
        run = state.x;
        made = state.y;
        heads = state.zw;
        let seen = bitcast<vec4f>(list_states[STATE_VECTORS * in_strip + 1u]);
        color = seen.rgb;
        transmittance = seen.a;
    }
    var turns = 0u;
    while run < count && turns < MOST_TURNS {
        // Runs of 1, 4, 16, ... are in the first half, but for the first ones, which are nowhere.
        let is_odd = (countTrailingZeros(run) & 1u) != 0u;
        let source = 2u * list.start + select(0u, list.room, is_odd);
        let goal = 2u * list.start + select(list.room, 0u, is_odd);
        let first = made - made % (2u * run);
        let middle = min(first + run, count);
        let end = min(first + 2u * run, count);
        if made == first {
            heads = vec2u(first, middle);
        }
        var ranks = min(heads, vec2u(count - 1u));
        if run > 1u {
            ranks = vec2u(list_ranks[source + ranks.x], list_ranks[source + ranks.y]);
        }
        var depths = vec2f(list_depths[list.start + ranks.x], list_depths[list.start + ranks.y]);
        while made < end && turns < MOST_TURNS {
            turns++;
            let takes_second = heads.x == middle
                || (heads.y < end && is_before(list.start, depths.yx, ranks.y, ranks.x));
            list_ranks[goal + made] = select(ranks.x, ranks.y, takes_second);
            made++;
            heads += select(vec2u(1u, 0u), vec2u(0u, 1u), takes_second);
            var next = min(select(heads.x, heads.y, takes_second), count - 1u);
            if run > 1u {
                next = list_ranks[source + next];
            }
            let depth = list_depths[list.start + next];
            ranks = select(vec2u(next, ranks.y), vec2u(ranks.x, next), takes_second);
            depths = select(vec2f(depth, depths.y), vec2f(depths.x, depth), takes_second);
        }
        if made == count {
            run *= 2u;
            made = 0u;
        }
    }
    let sorted = 2u * list.start + select(0u, list.room, (countTrailingZeros(run) & 1u) != 0u);
    while run >= count && made < count && transmittance > OPAQUE && turns < MOST_TURNS {
        turns++;
        var rank = made;
        if count > 1u {
            rank = list_ranks[sorted + made];
        }
        let seen = list_colors[list.start + rank];
        color += transmittance * seen.rgb;
        transmittance *= seen.a;
        made++;
    }
    // What ended with turns left, NaN too, has ended for good.
    let is_done = run >= count && (made == count || turns < MOST_TURNS);
    if !is_done {
        atomicAdd(&unfinished, 1u);
        list_states[STATE_VECTORS * in_strip] = vec4u(run, made, heads);
        list_states[STATE_VECTORS * in_strip + 1u] = bitcast<vec4u>(vec4f(color, transmittance));
        return;
    }
    list_states[STATE_VECTORS * in_strip].x = DONE;
    let background = frame.background;
    textureStore(picture, vec2u(pixel % width, pixel / width),
                 vec4f(color + transmittance * background.rgb, 1.0 - transmittance * (1.0 - background.a)));
}
