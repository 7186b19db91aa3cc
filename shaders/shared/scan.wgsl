var<workgroup> partial: array<u32, 256>;

// Inclusive scan of one word a thread, in a workgroup of 256; partial[255] is then the total. A barrier must stand between
// the last read of `partial` and the next scan.
fn scan(lane: u32, value: u32) -> u32 {
    partial[lane] = value;
    for (var reach = 1u; reach < 256u; reach *= 2u) {
        workgroupBarrier();
        var left = 0u;
        if lane >= reach {
            left = partial[lane - reach];
        }
        workgroupBarrier();
        partial[lane] += left;
    }
    workgroupBarrier();
    return partial[lane];
}
