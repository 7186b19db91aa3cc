//! Ray casting on a graphics device.

#![expect(clippy::print_stdout, reason = "what was measured, for `--nocapture`")]

mod casting;
mod common;

use std::sync::Arc;

use casting::overlap;
use common::gpu::{self, assert_same_bits};
use common::meshes;
use tetralux::gpu::{Gpu, RayCaster};
use tetralux::image::Comparison;
use tetralux::mesh::synth::Sample;
use tetralux::renderer::{Frame, Rendered, Renderer, Settings};
use tetralux::scene::Optics;
use tetralux::tet::TetMesh;

const COMPILES: bool = true;

fn engine(mesh: &Arc<TetMesh>, settings: Settings) -> Box<dyn Renderer> {
    Box::new(RayCaster::new(gpu::device(), mesh.clone(), settings).unwrap_or_else(|e| panic!("{e}")))
}

/// The boxes' picture by a caster.
fn overlapping(mut caster: RayCaster, mesh: &TetMesh, size: [u32; 2]) -> Rendered {
    let (camera, transfer) = overlap::outside(mesh);
    let background = [0.2, 0.1, 0.3, 1.0];
    let frame = Frame { camera: &camera, transfer: &transfer, optics: &Optics::PLAIN, size, background };
    caster.render(&frame, true).unwrap_or_else(|e| panic!("{e}"))
}

fn caster(gpu: &Gpu, mesh: &Arc<TetMesh>) -> RayCaster {
    RayCaster::new(gpu.clone(), mesh.clone(), Settings::default()).unwrap_or_else(|e| panic!("{e}"))
}

/// Devices, the second of which binds so many bytes.
fn devices(bytes: u64) -> [Gpu; 2] {
    [gpu::device(), Gpu::with_binding_limit(gpu::choice(), bytes).unwrap_or_else(|e| panic!("{e}"))]
}

fn has_pass(drawn: &Rendered, name: &str) -> bool {
    drawn.stats.passes.iter().any(|pass| pass.pass == name)
}

/// 32 KiB bind the colours of 2,048 segments: of fewer rows of pixels than a tile has.
#[test]
fn strips_and_dispatches_of_overlapping_rays_change_nothing() {
    let mesh = Arc::new(overlap::boxes());
    let size = [64, 120];
    let [device, small] = devices(32 << 10);
    let whole = overlapping(caster(&device, &mesh), &mesh, size);
    assert!(whole.stats.notes.iter().any(|n| n.contains("in 1 strips")), "{:?}", whole.stats.notes);
    let lists = ["overlapping", "list_ends", "list_colors"];
    assert!(lists.iter().all(|name| whole.stats.buffers.iter().any(|b| b.name == *name && b.bytes > 16)));
    let cut = overlapping(caster(&small, &mesh), &mesh, size);
    println!("{:?}", cut.stats.notes);
    let composed = cut.stats.passes.iter().filter(|pass| pass.pass == "compose").count();
    assert!(composed > size[1] as usize / 8, "{composed} strips are no more than rows of tiles");
    assert_same_bits(&cut.image, &whole.image, "in strips");
    // Turns are two at least. A ray that goes on has the values at the last face from its corners in another order: 5.7e-6
    // in thin bands.
    for turns in [0, 20] {
        let left = overlapping(caster(&device, &mesh).leaving_rays_after(turns), &mesh, size);
        let difference = Comparison::new(&left.image, &whole.image).expect("equal sizes");
        println!("left after {turns} turns: {:.1e}", difference.max);
        assert!(difference.max < 2e-5, "left after {turns} turns: {difference}");
    }
    let mut planted = whole.image.clone();
    planted.pixels[3000][2] += 3e-5;
    assert!(Comparison::new(&planted, &whole.image).expect("equal sizes").max > 2e-5);
}

/// Where the device cannot count segments, rays keep what they have composed walk by walk, with a note: a wrong picture, so
/// that the tests of overlaps would see it.
#[test]
fn without_lists_overlapping_rays_err() {
    let mesh = Arc::new(overlap::boxes());
    // 76,800 bytes of counts.
    let size = [96, 200];
    let [device, small] = devices(64 << 10);
    let listed = overlapping(caster(&device, &mesh), &mesh, size);
    let by_walks = overlapping(caster(&small, &mesh), &mesh, size);
    assert!(has_pass(&listed, "raylist") && !has_pass(&by_walks, "raylist"));
    assert!(by_walks.stats.notes.iter().any(|n| n.contains("too large for lists")), "{:?}", by_walks.stats.notes);
    let (camera, transfer) = overlap::outside(&mesh);
    let background = [0.2, 0.1, 0.3, 1.0];
    let frame = Frame { camera: &camera, transfer: &transfer, optics: &Optics::PLAIN, size, background };
    let [good, bad] = [&listed, &by_walks].map(|drawn| overlap::verdict(&mesh, frame, &drawn.image));
    // By walks 42 dB.
    println!("listed: {good}\nby walks: {bad}");
    assert!(good.failures().is_empty() && bad.failures().len() == 3, "{:?} and {:?}", good.failures(), bad.failures());
}

#[test]
fn rays_of_a_conforming_mesh_are_cast_once() {
    let mesh = meshes::sample(Sample::Tangle, 1_000);
    let device = gpu::device();
    let drawn = overlapping(caster(&device, &mesh), &mesh, [40, 40]);
    assert!(has_pass(&drawn, "raycast") && !has_pass(&drawn, "raylist"));
    assert!(drawn.stats.notes.is_empty(), "{:?}", drawn.stats.notes);
}
