//! What a rendering took, as one line of JSON and as text.

use std::fmt::Write as _;
use std::time::Duration;

use serde::ser::SerializeMap as _;
use serde::{Serialize, Serializer};

use super::args::{ChoiceArgs, Device, RenderArgs};
use crate::plan::order::Inversions;
use crate::renderer::{RayCounts, Stats};
use crate::tet::Domain;

/// Clocks of one run.
pub(super) struct Timing {
    /// Reading the file and building the tetrahedra.
    pub load: Duration,
    /// Opening the device and uploading.
    pub prepare: Duration,
    /// Each timed frame, without read-back; empty where none was timed.
    pub frames: Vec<Duration>,
}

/// All there is to tell of one run. Times are in seconds unless the name says otherwise.
#[derive(Serialize)]
pub(super) struct Report<'a> {
    adapter: &'a str,
    device: Device,
    settings: ChoiceArgs,
    mesh: MeshSize<'a>,
    image: ImageSize,
    cells: Cells<'a>,
    #[serde(skip_serializing_if = "Option::is_none")]
    rays: Option<Rays>,
    #[serde(skip_serializing_if = "str::is_empty")]
    order: &'a str,
    #[serde(skip_serializing_if = "Option::is_none")]
    inversions: Option<Pairs>,
    passes: Vec<Pass<'a>>,
    buffers: Vec<Buffer<'a>>,
    device_bytes: u64,
    load_seconds: f64,
    prepare_seconds: f64,
    frames: usize,
    frame_seconds: f64,
    frame_seconds_min: f64,
    frame_seconds_max: f64,
    pipelines: &'a str,
    notes: &'a [String],
    chosen: Option<String>,
}

#[derive(Serialize)]
struct MeshSize<'a> {
    field: &'a str,
    vertices: usize,
    tets: u64,
}

#[derive(Serialize)]
struct ImageSize {
    width: u32,
    height: u32,
}

#[derive(Clone, Copy, Serialize)]
struct Rays {
    steps: u64,
    repaired: u64,
    lost: u64,
}

/// Neighbours that were drawn, and those in the wrong order.
#[derive(Clone, Copy, Serialize)]
struct Pairs {
    pairs: u64,
    wrong: u64,
}

/// An object whose keys stand in the order of the stages.
struct Cells<'a>(&'a [(String, u64)]);

impl Serialize for Cells<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut map = serializer.serialize_map(Some(self.0.len()))?;
        for (stage, count) in self.0 {
            map.serialize_entry(stage, count)?;
        }
        map.end()
    }
}

#[derive(Serialize)]
struct Pass<'a> {
    pass: &'a str,
    work: &'a str,
    ms: f64,
}

#[derive(Serialize)]
struct Buffer<'a> {
    name: &'a str,
    bytes: u64,
}

impl<'a> Report<'a> {
    pub fn new(args: &RenderArgs, mesh: &'a dyn Domain, size: [u32; 2], stats: &'a Stats, timing: &Timing) -> Self {
        let mut seconds: Vec<f64> = timing.frames.iter().map(Duration::as_secs_f64).collect();
        seconds.sort_by(f64::total_cmp);
        let passes = stats.passes.iter().map(|p| Pass { pass: &p.pass, work: &p.work, ms: 1e3 * p.time.as_secs_f64() });
        Self {
            adapter: &stats.adapter,
            device: args.device,
            settings: args.choices,
            mesh: MeshSize { field: mesh.field(), vertices: mesh.vertex_count(), tets: mesh.tet_count() },
            image: ImageSize { width: size[0], height: size[1] },
            cells: Cells(&stats.cells),
            rays: stats.rays.map(|RayCounts { steps, repaired, lost }| Rays { steps, repaired, lost }),
            order: &stats.order,
            inversions: stats.inversions.map(|Inversions { pairs, wrong }| Pairs { pairs, wrong }),
            passes: passes.collect(),
            buffers: stats.buffers.iter().map(|b| Buffer { name: &b.name, bytes: b.bytes }).collect(),
            device_bytes: stats.buffers.iter().map(|b| b.bytes).sum(),
            load_seconds: timing.load.as_secs_f64(),
            prepare_seconds: timing.prepare.as_secs_f64(),
            frames: seconds.len(),
            frame_seconds: median(&seconds),
            frame_seconds_min: seconds.first().copied().unwrap_or(0.0),
            frame_seconds_max: seconds.last().copied().unwrap_or(0.0),
            pipelines: &stats.pipelines,
            notes: &stats.notes,
            chosen: None,
        }
    }

    /// Why the method was taken, where it was chosen.
    pub fn because(self, chosen: Option<String>) -> Self {
        Self { chosen, ..self }
    }

    /// One line.
    pub fn summary(&self) -> String {
        let [median, min, max] = [self.frame_seconds, self.frame_seconds_min, self.frame_seconds_max].map(|s| 1e3 * s);
        format!("frame     {median:>12.2} ms, median of {} ({min:.2} to {max:.2}), on {}", self.frames, self.adapter)
    }

    /// The plan and the passes, for people.
    pub fn explain(&self) -> String {
        // Writing to a string does not fail.
        let mut text = String::new();
        let choices = self.settings.settings();
        let _ = writeln!(text, "on        {}", self.adapter);
        let _ = writeln!(
            text,
            "plan      {:?}, {} integral, culling {}",
            choices.method,
            self.settings.integral,
            if choices.cull { "on" } else { "off" }
        );
        if let Some(why) = &self.chosen {
            let _ = writeln!(text, "chosen    {why}");
        }
        if !self.order.is_empty() {
            let _ = writeln!(text, "order     {}", self.order);
        }
        if let Some(Pairs { pairs, wrong }) = self.inversions {
            let share = 100.0 * wrong as f64 / pairs.max(1) as f64;
            let _ = writeln!(text, "order     {wrong:>12}  of {pairs} pairs of neighbours are wrong: {share:.3} %");
        }
        if !self.pipelines.is_empty() {
            let _ = writeln!(text, "pipelines {}", self.pipelines);
        }
        let MeshSize { field, vertices, tets } = self.mesh;
        let _ = writeln!(text, "mesh      {tets} tetrahedra, {vertices} vertices, field {field}");
        let _ = writeln!(text, "image     {} x {} pixels", self.image.width, self.image.height);
        for (stage, count) in self.cells.0 {
            let _ = writeln!(text, "cells     {count:>12}  after {stage}");
        }
        if let Some(Rays { steps, repaired, lost }) = self.rays {
            let _ =
                writeln!(text, "rays      {steps:>12}  cells entered, {repaired} steps repaired, {lost} walks lost");
        }
        for Pass { pass, work, ms } in &self.passes {
            let _ = writeln!(text, "pass      {ms:>12.3} ms  {pass:<16} {work}");
        }
        for Buffer { name, bytes } in &self.buffers {
            let _ = writeln!(text, "buffer    {bytes:>12} B   {name}");
        }
        if self.device_bytes > 0 {
            let per_tet = self.device_bytes as f64 / tets.max(1) as f64;
            let _ = writeln!(text, "memory    {:>12} B   {per_tet:.1} a tetrahedron", self.device_bytes);
        }
        let _ = writeln!(text, "load      {:>12.3} s", self.load_seconds);
        let _ = writeln!(text, "prepare   {:>12.3} s", self.prepare_seconds);
        let _ = write!(text, "{}", self.summary());
        text
    }
}

/// The middle of sorted numbers; 0 of none.
fn median(sorted: &[f64]) -> f64 {
    match sorted.len() {
        0 => 0.0,
        n if n % 2 == 1 => sorted[n / 2],
        n => 0.5 * (sorted[n / 2 - 1] + sorted[n / 2]),
    }
}

#[cfg(test)]
mod tests {
    #[test]
    fn median_is_the_middle() {
        assert_eq!([super::median(&[]), super::median(&[3.0]), super::median(&[1.0, 2.0, 9.0])], [0.0, 3.0, 2.0]);
        assert_eq!(super::median(&[1.0, 2.0, 4.0, 9.0]), 3.0);
    }
}
