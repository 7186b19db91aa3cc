//! Fragments in lists, a pixel each, sorted by depth: visibility that does not rest on the order of cells. A picture's
//! lists may not fit at once, so that it is made strip by strip; fragments are counted before any is listed, and none is
//! lost.

use crate::error::{Error, Result};
use crate::gpu::device::Gpu;
use crate::gpu::kernel::{Kernel, Resources};
use crate::gpu::layout;
use crate::gpu::record::{Recorder, Work};
use crate::renderer::BufferSize;

/// Bytes of a listed fragment's colour; its depth and its rank are less.
const COLOR_BYTES: u64 = 16;

/// Bytes of a pixel's state (`compose.wgsl`).
const STATE_BYTES: u64 = 32;

/// Bytes of the states of a strip.
const MOST_STATES: u64 = 64 << 20;

/// Most fragments of a strip: 448 MiB in all.
const MOST_LISTED: u64 = 1 << 24;

/// lavapipe ends the loops of 8 pixels at once after 65,535 turns.
const SOFTWARE_TURNS: u32 = 5_000;
const HARDWARE_TURNS: u32 = 100_000;

/// Pixels of a workgroup of `compose.wgsl`.
const GROUP: u32 = 64;

/// What is listed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Listed {
    /// Cells' fragments, of all pixels.
    Cells,
    /// Segments of some rays: the other pixels stay as they are.
    Rays,
}

impl Listed {
    /// What to do where lists do not fit.
    fn advice(self) -> &'static str {
        match self {
            Self::Cells => "render with --order centroid",
            Self::Rays => "render with --device cpu",
        }
    }
}

/// Buffers and kernels of the lists of pictures.
pub struct FragmentLists {
    /// Numbers the fragments of each row.
    pub rows: Kernel,
    compose: Kernel,
    /// [`layout::Strip`].
    pub strip: wgpu::Buffer,
    /// Counts, a word a pixel.
    pub fragments: wgpu::Buffer,
    /// Fragments of each row.
    row_totals: wgpu::Buffer,
    /// Pixels that are left to the next dispatch.
    unfinished: wgpu::Buffer,
    /// Fragments beyond those counted.
    unlisted: wgpu::Buffer,
    list_ends: wgpu::Buffer,
    row_bases: wgpu::Buffer,
    depths: wgpu::Buffer,
    colors: wgpu::Buffer,
    ranks: wgpu::Buffer,
    states: wgpu::Buffer,
    listed: Listed,
    room: Room,
    /// Of the picture, pixels.
    pub size: [u32; 2],
}

/// What a strip holds at most.
#[derive(Clone, Copy, Debug)]
struct Room {
    fragments: u64,
    pixels: u64,
}

impl Room {
    fn of(gpu: &Gpu) -> Self {
        Self {
            fragments: MOST_LISTED.min(gpu.max_binding / COLOR_BYTES),
            pixels: gpu.max_binding.min(MOST_STATES) / STATE_BYTES,
        }
    }

    fn holds(self, fragments: u64, pixels: u32) -> bool {
        fragments <= self.fragments && u64::from(pixels) <= self.pixels
    }
}

/// Pixels, row by row, whose lists fit at once.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Strip {
    /// The first.
    pub first: u32,
    /// Behind the last.
    pub end: u32,
    /// Fragments before the first.
    pub before: u64,
    /// Fragments of the strip.
    pub listed: u64,
}

impl Strip {
    /// As shaders see it.
    pub fn uniform(self) -> layout::Strip {
        // Numbers of fragments wrap.
        layout::Strip { first_pixel: self.first, end_pixel: self.end, base: self.before as u32, goes_on: 0 }
    }

    /// The first row that it has pixels of, and how many rows.
    pub fn rows(self, width: u32) -> [u32; 2] {
        let top = self.first / width;
        [top, self.end.div_ceil(width) - top]
    }
}

impl FragmentLists {
    /// Turns of loops after which a dispatch leaves a pixel.
    pub fn turns(gpu: &Gpu) -> u32 {
        if gpu.is_software() { SOFTWARE_TURNS } else { HARDWARE_TURNS }
    }

    /// `turns`: after which a dispatch leaves a pixel.
    ///
    /// # Errors
    /// A shader that does not compile.
    pub fn new(gpu: &Gpu, turns: u32, listed: Listed) -> Result<Self> {
        let keeps_others = f64::from(u8::from(listed == Listed::Rays));
        let constants = [("MOST_TURNS", f64::from(turns)), ("KEEPS_OTHERS", keeps_others)];
        let usage = wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC | wgpu::BufferUsages::COPY_DST;
        let buffer = |label| gpu.buffer(label, 0, usage);
        Ok(Self {
            rows: gpu.kernel("list_rows", &[])?,
            compose: gpu.kernel("compose", &constants)?,
            strip: gpu.uniform("strip", &[layout::Strip::default()]),
            fragments: buffer("fragments"),
            row_totals: buffer("row_totals"),
            unfinished: buffer("unfinished"),
            unlisted: buffer("unlisted"),
            list_ends: buffer("list_ends"),
            row_bases: buffer("row_bases"),
            depths: buffer("list_depths"),
            colors: buffer("list_colors"),
            ranks: buffer("list_ranks"),
            states: buffer("list_states"),
            listed,
            room: Room::of(gpu),
            size: [0; 2],
        })
    }

    /// Whether the device can count the fragments of a picture's pixels.
    pub fn can_count(gpu: &Gpu, size: [u32; 2]) -> bool {
        count_bytes(size) <= gpu.max_binding
    }

    /// Makes room for the counts of a picture.
    ///
    /// # Errors
    /// A picture whose pixels the device cannot count.
    pub fn need_size(&mut self, gpu: &Gpu, size: [u32; 2]) -> Result<()> {
        if !Self::can_count(gpu, size) {
            return Err(Error::Device(format!(
                "'{}' binds {} MiB at once, too little for the lists of {}x{} pixels: render a smaller picture, or {}",
                gpu.info.name,
                gpu.max_binding >> 20,
                size[0],
                size[1],
                self.listed.advice()
            )));
        }
        let (pixels, rows) = (count_bytes(size), u64::from(size[1]) * 4);
        for (buffer, label, bytes) in [
            (&mut self.fragments, "fragments", pixels),
            (&mut self.list_ends, "list_ends", pixels),
            (&mut self.row_totals, "row_totals", rows),
            (&mut self.row_bases, "row_bases", rows),
        ] {
            grow(gpu, buffer, label, bytes, gpu.max_binding);
        }
        self.size = size;
        Ok(())
    }

    /// Cuts the picture into strips, after the rows' fragments were numbered, and makes room for the largest.
    ///
    /// # Errors
    /// A lost device; a pixel with more fragments than fit.
    pub fn plan(&mut self, gpu: &Gpu) -> Result<Vec<Strip>> {
        let totals: Vec<u32> = gpu.read(&self.row_totals, u64::from(self.size[1]) * 4)?;
        let mut before = 0_u32;
        let bases: Vec<u32> = totals
            .iter()
            .map(|&total| {
                let base = before;
                before = before.wrapping_add(total);
                base
            })
            .collect();
        gpu.write(&self.row_bases, 0, bytemuck::cast_slice(&bases));
        let (width, room) = (self.size[0], self.room);
        let ends: Vec<u32> = if totals.iter().all(|&total| room.holds(total.into(), width)) {
            Vec::new()
        } else {
            // Rare: a row that has to be cut.
            gpu.read(&self.list_ends, count_bytes(self.size))?
        };
        let strips = strips(&totals, &ends, width, room).ok_or_else(|| {
            Error::Device(format!(
                "a pixel has more fragments than the {} that fit a binding of '{}': {}",
                room.fragments,
                gpu.info.name,
                self.listed.advice()
            ))
        })?;
        let listed = strips.iter().map(|s| s.listed).max().unwrap_or(0);
        let pixels = strips.iter().map(|s| u64::from(s.end - s.first)).max().unwrap_or(0);
        for (buffer, label, number, bytes, most) in [
            (&mut self.depths, "list_depths", listed, 4, room.fragments),
            (&mut self.colors, "list_colors", listed, COLOR_BYTES, room.fragments),
            (&mut self.ranks, "list_ranks", listed, 8, room.fragments),
            (&mut self.states, "list_states", pixels, STATE_BYTES, room.pixels),
        ] {
            grow(gpu, buffer, label, number * bytes, most * bytes);
        }
        Ok(strips)
    }

    /// Forgets what was counted.
    pub fn clear(&self, recorder: &mut Recorder<'_>) {
        recorder.encoder().clear_buffer(&self.fragments, 0, None);
        recorder.encoder().clear_buffer(&self.unlisted, 0, None);
    }

    /// Sorts and composes a strip that was listed, into the picture of `resources`.
    ///
    /// # Errors
    /// A lost device.
    pub fn compose(
        &self,
        gpu: &Gpu,
        recorder: &mut Recorder<'_>,
        resources: &Resources<'_>,
        strip: Strip,
    ) -> Result<()> {
        let groups = self.compose.bind(gpu, resources)?;
        let mut uniform = strip.uniform();
        loop {
            recorder.encoder().clear_buffer(&self.unfinished, 0, None);
            recorder.compute(&self.compose, &groups, Work::Groups((strip.end - strip.first).div_ceil(GROUP)))?;
            recorder.submit();
            let unfinished: Vec<u32> = gpu.read(&self.unfinished, 4)?;
            if unfinished == [0] {
                return Ok(());
            }
            uniform.goes_on = 1;
            gpu.queue.write_buffer(&self.strip, 0, bytemuck::bytes_of(&uniform));
        }
    }

    /// That all fragments were listed.
    ///
    /// # Errors
    /// Fragments that had not been counted; a lost device.
    pub fn check(&self, gpu: &Gpu) -> Result<()> {
        let unlisted: Vec<u32> = gpu.read(&self.unlisted, 4)?;
        if unlisted == [0] {
            return Ok(());
        }
        Err(Error::Device(format!("internal: {unlisted:?} fragments were drawn that had not been counted")))
    }

    /// Adds what shaders bind.
    pub fn offer<'a>(&'a self, resources: Resources<'a>) -> Resources<'a> {
        self.list().into_iter().fold(resources.with("strip", &self.strip), |r, (name, buffer)| r.with(name, buffer))
    }

    fn list(&self) -> [(&'static str, &wgpu::Buffer); 10] {
        [
            ("fragments", &self.fragments),
            ("row_totals", &self.row_totals),
            ("unfinished", &self.unfinished),
            ("unlisted", &self.unlisted),
            ("list_ends", &self.list_ends),
            ("row_bases", &self.row_bases),
            ("list_depths", &self.depths),
            ("list_colors", &self.colors),
            ("list_ranks", &self.ranks),
            ("list_states", &self.states),
        ]
    }

    /// Labels and sizes, for the report.
    pub fn sizes(&self) -> impl Iterator<Item = BufferSize> {
        self.list().into_iter().map(|(name, buffer)| BufferSize { name: name.to_owned(), bytes: buffer.size() })
    }
}

/// Of a picture's counts.
fn count_bytes(size: [u32; 2]) -> u64 {
    u64::from(size[0]) * u64::from(size[1]) * 4
}

/// Makes a buffer anew where it is too small, with a little more, up to `most`, for the next view.
fn grow(gpu: &Gpu, buffer: &mut wgpu::Buffer, label: &str, bytes: u64, most: u64) {
    if buffer.size() < bytes {
        *buffer = gpu.buffer(label, (bytes + bytes / 4).min(most), buffer.usage());
    }
}

/// Rows, one behind the other, as long as they fit; rows that do not are cut, given where the lists of all pixels end in
/// their rows. `None` where a pixel's list does not fit.
fn strips(totals: &[u32], ends: &[u32], width: u32, room: Room) -> Option<Vec<Strip>> {
    let mut strips = Vec::new();
    let mut open = Strip { first: 0, end: 0, before: 0, listed: 0 };
    // Adds pixels to the open strip, or begins another one.
    let mut add = |pixels: u32, listed: u64| {
        if !room.holds(open.listed + listed, open.end - open.first + pixels) && open.end > open.first {
            strips.push(open);
            open = Strip { first: open.end, end: open.end, before: open.before + open.listed, listed: 0 };
        }
        open.end += pixels;
        open.listed += listed;
        room.holds(open.listed, open.end - open.first)
    };
    for (row, &total) in totals.iter().enumerate() {
        if room.holds(total.into(), width) {
            add(width, total.into());
            continue;
        }
        let mut before = 0;
        for &end in ends.get(row * width as usize..(row + 1) * width as usize)? {
            if !add(1, (end - before).into()) {
                return None;
            }
            before = end;
        }
    }
    if open.end > open.first {
        strips.push(open);
    }
    Some(strips)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gpu::shader::Module;

    /// Strips of rows whose pixels' lists have these lengths.
    fn of(rows: &[[u32; 3]], fragments: u64, pixels: u64) -> Option<Vec<[u64; 4]>> {
        let totals: Vec<u32> = rows.iter().map(|row| row.iter().sum()).collect();
        let sum = |row: &[u32; 3]| [row[0], row[0] + row[1], row[0] + row[1] + row[2]];
        let ends: Vec<u32> = rows.iter().flat_map(sum).collect();
        let strips = strips(&totals, &ends, 3, Room { fragments, pixels })?;
        Some(strips.iter().map(|s| [s.first.into(), s.end.into(), s.before, s.listed]).collect())
    }

    #[test]
    fn strips_take_every_pixel_once_and_fit() {
        let rows = [[1, 2, 3], [4, 0, 0], [0, 0, 0], [9, 9, 9], [1, 1, 1]];
        assert_eq!(of(&rows, 100, 100), Some(vec![[0, 15, 0, 40]]));
        assert_eq!(of(&rows, 30, 100), Some(vec![[0, 9, 0, 10], [9, 15, 10, 30]]));
        assert_eq!(of(&rows, 30, 8), Some(vec![[0, 6, 0, 10], [6, 12, 10, 27], [12, 15, 37, 3]]));
        // The fourth row is cut.
        assert_eq!(of(&rows, 19, 100), Some(vec![[0, 10, 0, 19], [10, 12, 19, 18], [12, 15, 37, 3]]));
        assert_eq!(of(&rows, 8, 100), None);
        assert_eq!(of(&[[0, 0, 0]; 2], 8, 100), Some(vec![[0, 6, 0, 0]]));
        // Each row is wider than a strip.
        assert_eq!(of(&rows[..2], 100, 2), Some(vec![[0, 2, 0, 3], [2, 4, 3, 7], [4, 6, 10, 0]]));
    }

    #[test]
    fn rows_whose_ends_are_not_known_are_not_lost() {
        assert_eq!(strips(&[5], &[], 3, Room { fragments: 100, pixels: 2 }), None);
    }

    #[test]
    fn the_shader_has_the_same_constants() {
        let module = Module::new("compose").expect("a pass");
        let value = |name| module.constant(name);
        assert_eq!((value("GROUP"), u64::from(value("STATE_VECTORS")) * 16), (GROUP, STATE_BYTES));
        assert_eq!(module.naga.entry_points[0].workgroup_size, [GROUP, 1, 1]);
    }
}
