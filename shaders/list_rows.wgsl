#import shared/frame
#import shared/scan

// A row of the picture a workgroup: how many fragments its pixels have, up to each.

@group(3) @binding(0) var<storage, read> fragments: array<u32>;
@group(3) @binding(1) var<storage, read_write> list_ends: array<u32>;
@group(3) @binding(2) var<storage, read_write> row_totals: array<u32>;

@compute @workgroup_size(256)
fn main(@builtin(local_invocation_index) lane: u32, @builtin(workgroup_id) group: vec3u) {
    let width = u32(frame.image_width);
    let row = group.x * width;
    var before = 0u;
    for (var first = 0u; first < width; first += 256u) {
        let x = first + lane;
        var count = 0u;
        if x < width {
            count = fragments[row + x];
        }
        let inclusive = scan(lane, count);
        if x < width {
            list_ends[row + x] = before + inclusive;
        }
        before += partial[255];
        workgroupBarrier();
    }
    if lane == 0u {
        row_totals[group.x] = before;
    }
}
