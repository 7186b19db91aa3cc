//! What ray casting on a graphics device does besides `gpu_casting`: layouts, limits, shading, fields that change, and
//! rays through everything that is hard to meet.

#![expect(clippy::print_stdout, reason = "what was measured, for `--nocapture`")]

mod common;

use std::sync::Arc;

use common::agreement::{Cause, Limits, Verdict, assert_limits_bite};
use common::boxes::{box_mesh, chord};
use common::gpu::{assert_same_bits, choice, device};
use common::{delaunay, gpu, meshes};
use glam::DVec3;
use tetralux::cpu::CpuRenderer;
use tetralux::gpu::{Gpu, RayCaster};
use tetralux::image::Comparison;
use tetralux::mesh::synth::Sample;
use tetralux::oracle::Oracle;
use tetralux::renderer::{CellLayout, Frame, Rendered, Renderer as _, SegmentIntegral, Settings};
use tetralux::scene::{
    Camera, Curve, CurveNode, EmissionModel, LightSpace, Lighting, Optics, Projection, Silhouette, SilhouetteMode,
    TransferFunction, Widget, WidgetShape,
};
use tetralux::tet::TetMesh;

const SIZE: [u32; 2] = [96, 80];
const GOLD: [f64; 3] = [0.9, 0.6, 0.3];

fn caster_on(gpu: Gpu, mesh: &Arc<TetMesh>, settings: Settings) -> RayCaster {
    RayCaster::new(gpu, mesh.clone(), settings).unwrap_or_else(|e| panic!("{e}"))
}

fn caster(mesh: &Arc<TetMesh>, settings: Settings) -> RayCaster {
    caster_on(device(), mesh, settings)
}

/// With storage bindings of 1 MiB at most.
fn small_device() -> Gpu {
    Gpu::with_binding_limit(choice(), 1 << 20).unwrap_or_else(|e| panic!("{e}"))
}

fn camera(mesh: &TetMesh, away: DVec3) -> Camera {
    let (target, diagonal) = meshes::center_and_diagonal(mesh);
    let projection = Projection::Perspective { fov_y: 0.8 };
    Camera { eye: target + diagonal * away, target, up: DVec3::Y, projection, near: None }
}

fn outside(mesh: &TetMesh) -> Camera {
    camera(mesh, DVec3::new(0.7, 0.45, 0.85))
}

fn curve(mesh: &TetMesh) -> TransferFunction {
    let (range, diagonal) = (mesh.scalar_range(), meshes::center_and_diagonal(mesh).1);
    let node = |(x, depth, color): (f64, f64, [f64; 3])| CurveNode {
        scalar: range.min + x * range.length(),
        color,
        extinction: depth / diagonal,
    };
    let nodes = [(0.0, 1.0, GOLD), (0.6, 12.0, [0.2, 0.4, 1.0]), (1.0, 2.0, GOLD)];
    TransferFunction::Curve(Curve { nodes: nodes.map(node).to_vec() })
}

fn gaussian(mesh: &TetMesh) -> TransferFunction {
    let (s, g) = (mesh.scalar_range(), mesh.gradient_range());
    let shape = WidgetShape::Gaussian {
        center: [s.min + 0.4 * s.length(), g.min + 0.2 * g.length()],
        sigma: [0.15 * s.length(), 0.3 * g.length()],
        angle: 0.0,
    };
    TransferFunction::Widgets(vec![Widget::new(shape, GOLD, 12.0 / meshes::center_and_diagonal(mesh).1)])
}

fn draw_with(caster: &mut RayCaster, camera: &Camera, transfer: &TransferFunction, optics: &Optics) -> Rendered {
    let frame = Frame { camera, transfer, optics, size: SIZE, background: [0.0; 4] };
    caster.render(&frame, false).unwrap_or_else(|e| panic!("{e}"))
}

fn draw(caster: &mut RayCaster, camera: &Camera, transfer: &TransferFunction) -> Rendered {
    draw_with(caster, camera, transfer, &Optics::PLAIN)
}

/// Bytes of the mesh's own buffers.
fn mesh_bytes(rendered: &Rendered) -> u64 {
    let of_frame = ["occupied", "entries", "tallies", "states"];
    let buffers = rendered.stats.buffers.iter().filter(|b| !of_frame.contains(&b.name.as_str()));
    buffers.map(|b| b.bytes).sum()
}

#[test]
fn layouts_and_parts_draw_the_same_bits() {
    let mesh = meshes::sample(Sample::Tangle, 150_000);
    let (camera, transfer) = (outside(&mesh), gaussian(&mesh));
    let with = |layout| Settings { layout, ..Settings::default() };
    let fast = draw(&mut caster(&mesh, with(CellLayout::Fast)), &camera, &transfer);
    let compact = draw(&mut caster(&mesh, with(CellLayout::Compact)), &camera, &transfer);
    // Links and ids in three parts.
    let parts = draw(&mut caster_on(small_device(), &mesh, with(CellLayout::Auto)), &camera, &transfer);
    assert_same_bits(&fast.image, &compact.image, "fast and compact");
    assert_same_bits(&fast.image, &parts.image, "whole and in parts");
    let per_tet = |r: &Rendered| mesh_bytes(r) as f64 / mesh.tets.len() as f64;
    println!("bytes a tetrahedron: fast {:.2}, compact {:.2}", per_tet(&fast), per_tet(&compact));
    assert!(per_tet(&fast) < 96.1 && per_tet(&compact) < 40.0, "{} and {}", per_tet(&fast), per_tet(&compact));
    let links = |r: &Rendered| r.stats.buffers.iter().filter(|b| b.name.starts_with("links")).count();
    assert_eq!((links(&fast), links(&parts)), (1, 3));
    assert!(parts.stats.pipelines.contains("compact") && fast.stats.pipelines.contains("fast"));
}

/// Rays of a picture whose states do not fit one binding.
#[test]
fn slabs_draw_the_same_bits() {
    let mesh = meshes::sample(Sample::Tangle, 3_000);
    let (camera, transfer) = (outside(&mesh), gaussian(&mesh));
    let size = [250, 249];
    let frame = Frame { camera: &camera, transfer: &transfer, optics: &Optics::PLAIN, size, background: [0.0; 4] };
    let on = |gpu| caster_on(gpu, &mesh, Settings::default()).render(&frame, true).expect("a picture");
    let (whole, slabs) = (on(device()), on(small_device()));
    let dispatches = |r: &Rendered| r.stats.passes.iter().filter(|p| p.pass == "raycast").count();
    assert_eq!((dispatches(&whole), dispatches(&slabs)), (1, 4));
    assert_same_bits(&whole.image, &slabs.image, "whole and in slabs");
    assert_eq!(whole.stats.rays, slabs.stats.rays);
}

/// Rays that are left in the middle of a walk or a search, again and again, go on as if nothing had been.
#[test]
fn rays_go_on_where_they_were_left() {
    let mesh = meshes::fire();
    let transfer = curve(&mesh);
    let inside = Camera { near: None, ..camera(&mesh, DVec3::new(0.03, -0.02, 0.05)) };
    for camera in [outside(&mesh), inside] {
        for layout in [CellLayout::Fast, CellLayout::Compact] {
            let settings = Settings { layout, ..Settings::default() };
            let frame = Frame {
                camera: &camera,
                transfer: &transfer,
                optics: &Optics::PLAIN,
                size: SIZE,
                background: [0.0; 4],
            };
            let at_once = caster(&mesh, settings).leaving_rays_after(20_000).render(&frame, true).expect("a picture");
            let often = caster(&mesh, settings).leaving_rays_after(20).render(&frame, true).expect("a picture");
            let dispatches = |r: &Rendered| r.stats.passes.iter().filter(|p| p.pass == "raycast").count();
            let comparison = Comparison::new(&often.image, &at_once.image).expect("equal sizes");
            println!("{} and {} dispatches, {:.1e}", dispatches(&at_once), dispatches(&often), comparison.max);
            assert!(dispatches(&often) > 8 && dispatches(&at_once) == 1);
            // Corners of the face where a ray goes on may come in another order.
            assert!(comparison.max < 1e-6, "{comparison}");
            assert_eq!(often.stats.rays, at_once.stats.rays);
        }
    }
}

#[test]
fn what_does_not_fit_is_refused_with_numbers() {
    let mesh = meshes::sample(Sample::Tangle, 150_000);
    let refusal = |limit: u64, layout| {
        let gpu = Gpu::with_binding_limit(choice(), limit).unwrap_or_else(|e| panic!("{e}"));
        let made = RayCaster::new(gpu, mesh.clone(), Settings { layout, ..Settings::default() });
        made.err().map(|e| e.to_string()).unwrap_or_default()
    };
    let fast = refusal(1 << 20, CellLayout::Fast);
    assert!(fast.contains(&mesh.tets.len().to_string()) && fast.contains("use --layout compact"), "{fast}");
    let any = refusal(1 << 18, CellLayout::Auto);
    assert!(any.contains("a coarser mesh") && any.contains("65536"), "{any}");
}

/// The whole boundary is in one tile, and rays run out of turns while they look for an entry.
#[test]
fn a_far_mesh_is_cast_in_several_dispatches() {
    let mesh = meshes::sample(Sample::Tangle, 400_000);
    let camera = camera(&mesh, DVec3::new(7.0, 4.5, 8.5));
    let transfer = curve(&mesh);
    let size = [56, 56];
    let frame = Frame { camera: &camera, transfer: &transfer, optics: &Optics::PLAIN, size, background: [0.0; 4] };
    let cast = caster(&mesh, Settings::default()).leaving_rays_after(7_000).render(&frame, true).expect("a picture");
    let dispatches = cast.stats.passes.iter().filter(|p| p.pass == "raycast").count();
    assert!(dispatches > 1, "{dispatches}");
    let want = CpuRenderer::new(mesh.clone(), Settings::default()).expect("an engine").render(&frame, false);
    let comparison = Comparison::new(&cast.image, &want.expect("a picture").image).expect("equal sizes");
    println!("{dispatches} dispatches, {:.1} dB", comparison.psnr);
    assert!(comparison.psnr > 100.0, "{comparison}");
    assert!(cast.image.pixels.iter().filter(|p| p[3] > 0.1).count() > 4, "little is seen");
}

/// Where all is of one colour the order of cells does not matter.
#[test]
fn projection_draws_the_same() {
    for mesh in [meshes::fire(), meshes::sample(Sample::Tangle, 20_000)] {
        let transfer = gaussian(&mesh);
        for away in [DVec3::new(0.7, 0.45, 0.85), DVec3::new(-0.9, 0.2, 0.1)] {
            let camera = camera(&mesh, away);
            let cast = draw(&mut caster(&mesh, Settings::default()), &camera, &transfer).image;
            let projected = gpu::draw(&mut gpu::renderer(&mesh, Settings::default()), &camera, &transfer, SIZE).image;
            let comparison = Comparison::new(&projected, &cast).expect("equal sizes");
            println!("{:.1} dB, 99.9% {:.1e}", comparison.psnr, comparison.percentile_99_9);
            assert!(comparison.psnr >= 80.0 && comparison.percentile_99_9 <= 1e-3, "{comparison}");
        }
    }
}

#[test]
fn fields_and_places_are_replaced() {
    let mesh = meshes::sample(Sample::Tangle, 20_000);
    // Another field, as steep everywhere as it is high; then other places, too.
    let mut other = TetMesh::clone(&mesh);
    other.scalar.iter_mut().for_each(|s| *s = (0.3 * *s).sin());
    other.gradient_magnitude.iter_mut().zip(&other.scalar).for_each(|(g, s)| *g = s.abs());
    let mut moved = other.clone();
    moved.vertices.iter_mut().for_each(|v| *v += DVec3::new(0.1 * v.y * v.y, 0.0, 0.05 * v.x));
    let optics = Optics {
        lighting: Some(Lighting {
            ambient: 0.3,
            diffuse: 0.6,
            specular: 0.4,
            shininess: 20.0,
            direction: DVec3::new(0.3, 0.4, 0.9).normalize(),
            space: LightSpace::View,
        }),
        ..Optics::PLAIN
    };
    for layout in [CellLayout::Fast, CellLayout::Compact] {
        let settings = Settings { layout, ..Settings::default() };
        let mut kept = caster(&mesh, settings);
        let before = draw_with(&mut kept, &outside(&mesh), &gaussian(&mesh), &optics).image;
        for next in [Arc::new(other.clone()), Arc::new(moved.clone()), mesh.clone()] {
            kept.replace(next.clone()).expect("the same tetrahedra");
            let (camera, transfer) = (outside(&next), gaussian(&next));
            let got = draw_with(&mut kept, &camera, &transfer, &optics).image;
            let want = draw_with(&mut caster(&next, settings), &camera, &transfer, &optics).image;
            assert!(next.scalar == mesh.scalar || Comparison::new(&got, &before).expect("equal sizes").max > 0.1);
            let comparison = Comparison::new(&got, &want).expect("equal sizes");
            // A new renderer orders moved cells anew; its pictures are the same but for ties.
            assert!(comparison.max < 1e-6, "{comparison}");
        }
        let mut fewer = TetMesh::clone(&mesh);
        Arc::make_mut(&mut fewer.tets).pop();
        let refusal = kept.replace(Arc::new(fewer)).expect_err("other tetrahedra").to_string();
        assert!(refusal.contains("other tetrahedra"), "{refusal}");
    }
}

/// Against the oracle, whose order is exact, too.
#[test]
fn shading_agrees() {
    const LIMITS: Limits = Limits { psnr: 90.0, percentile_99_9: 5e-4, explained_above: 2e-3 };
    let lighting = |space| Lighting {
        ambient: 0.3,
        diffuse: 0.6,
        specular: 0.4,
        shininess: 20.0,
        direction: DVec3::new(0.3, 0.4, 0.9).normalize(),
        space,
    };
    let silhouette = |mode| Silhouette { exponent: 1.5, strength: 0.9, mode };
    let optics = [
        Optics { lighting: Some(lighting(LightSpace::View)), ..Optics::PLAIN },
        Optics { silhouette: Some(silhouette(SilhouetteMode::Opacity)), ..Optics::PLAIN },
        Optics {
            lighting: Some(lighting(LightSpace::World)),
            silhouette: Some(silhouette(SilhouetteMode::Depth)),
            ..Optics::PLAIN
        },
    ];
    let flat = |mesh: &TetMesh| Camera {
        projection: Projection::Orthographic { height: 0.8 * meshes::center_and_diagonal(mesh).1 },
        ..outside(mesh)
    };
    let (fire, tangle) = (meshes::fire(), meshes::sample(Sample::Tangle, 20_000));
    for (mesh, transfer, camera) in [(&fire, curve(&fire), flat(&fire)), (&tangle, gaussian(&tangle), outside(&tangle))]
    {
        let oracle = Oracle::new(mesh.clone());
        let mut caster = caster(mesh, Settings::default());
        let plain = draw(&mut caster, &camera, &transfer).image;
        for optics in &optics {
            let got = draw_with(&mut caster, &camera, &transfer, optics).image;
            let frame = Frame { camera: &camera, transfer: &transfer, optics, size: SIZE, background: [0.0; 4] };
            let want = oracle.image(&frame).expect("a picture");
            let verdict = Verdict::new(&got, &want, LIMITS, |_, _| Cause::Unknown);
            println!("{verdict}");
            assert!(Comparison::new(&plain, &want).expect("equal sizes").max > 0.02, "shading changes little");
            assert_limits_bite(&want, LIMITS);
            verdict.assert_good("shaded");
        }
    }
}

/// A box, perhaps with a smaller one taken out.
struct Hull {
    name: &'static str,
    mesh: Arc<TetMesh>,
    outer: [DVec3; 2],
    hole: Option<[DVec3; 2]>,
}

fn hulls() -> [Hull; 4] {
    let cube = [DVec3::ZERO, DVec3::ONE];
    let regular = box_mesh(16, cube[0], cube[1], |p| [p.x, 0.0]);
    let mut holed = box_mesh(8, cube[0], cube[1], |p| [p.x, 0.0]);
    let inside = [DVec3::splat(0.25), DVec3::splat(0.75)];
    let middle =
        |tet: &[u32; 4]| tet.map(|v| holed.data_from_mesh(holed.vertices[v as usize])).iter().sum::<DVec3>() / 4.0;
    let kept: Vec<[u32; 4]> = holed
        .tets
        .iter()
        .copied()
        .filter(|tet| {
            let p = middle(tet);
            p.cmplt(inside[0]).any() || p.cmpgt(inside[1]).any()
        })
        .collect();
    assert!(kept.len() < holed.tets.len());
    holed.tets = Arc::new(kept);
    let random = delaunay::cube(1_500, 40, 8, 7, |p| [p.x, 0.0]);
    // Cells of 1e-2 at coordinates of 1e6.
    let far = [DVec3::new(1e6, -2e6, 3e6), DVec3::new(1e6 + 0.125, -2e6 + 0.125, 3e6 + 0.125)];
    let far_mesh = box_mesh(12, far[0], far[1], |p| [p.x, 0.0]);
    let hull = |name, mesh, outer, hole| Hull { name, mesh: Arc::new(mesh), outer, hole };
    [
        hull("regular", regular, cube, None),
        hull("with a hole", holed, cube, Some(inside)),
        hull("random", random, cube, None),
        hull("far from the origin", far_mesh, far, None),
    ]
}

/// Pictures of 256 x 256 parallel rays, random ones and such along the axes and diagonals that pass exactly through
/// vertices, edges and faces.
fn views(hull: &Hull) -> Vec<Camera> {
    let [min, max] = hull.outer;
    let (center, size) = (0.5 * (min + max), (max - min).x);
    let mut random = common::random::Random(5);
    let ups = [DVec3::Y, DVec3::Z, DVec3::X, DVec3::Z, DVec3::X, DVec3::Y];
    let straight = [DVec3::X, DVec3::Y, DVec3::Z, DVec3::new(1.0, 1.0, 0.0), DVec3::new(0.0, 1.0, 1.0), DVec3::ONE];
    let aligned = straight.into_iter().zip(ups).map(|(direction, up)| (direction, up, 2.0));
    let turned: Vec<_> = (0..2).map(|_| (random.direction(), random.direction(), 1.8)).collect();
    let camera = |(direction, up, height): (DVec3, DVec3, f64)| Camera {
        // Pixel centres lie half a pixel beside the middle: then on it, and on all that is a multiple of 1/128 away.
        eye: center + size * (2.0 * direction + 0.00390625 * (up.normalize() + up.cross(direction).normalize())),
        target: center + size * 0.00390625 * (up.normalize() + up.cross(direction).normalize()),
        up,
        projection: Projection::Orthographic { height: height * size },
        near: None,
    };
    aligned.chain(turned).map(camera).collect()
}

const RAYS: [u32; 2] = [256, 256];

/// How far a ray's length is from what rays beside it, moved by less than f32 tells, pass: in units of the diagonal.
fn length_error(hull: &Hull, camera: &Camera, pixel: [f64; 2], length: f64) -> f64 {
    let diagonal = (hull.outer[1] - hull.outer[0]).length();
    let ray = camera.ray(RAYS, pixel);
    let basis = camera.basis();
    let lengths = [-1.0, 0.0, 1.0].into_iter().flat_map(|x| [-1.0, 0.0, 1.0].map(|y| [x, y])).map(|[x, y]| {
        let origin = ray.origin + 3e-7 * diagonal * (x * basis.right + y * basis.up);
        let inside = |[min, max]: [DVec3; 2]| chord(origin, ray.direction, 0.0, min, max);
        inside(hull.outer) - hull.hole.map_or(0.0, inside)
    });
    let (low, high) = lengths.fold((f64::INFINITY, 0.0_f64), |(l, h), c| (l.min(c), h.max(c)));
    (low - length).max(length - high).max(0.0) / diagonal
}

/// Errors of all rays, and what the device counted. The colour of a medium that hardly absorbs and glows is the length.
fn cast_lengths(hull: &Hull, mesh: &Arc<TetMesh>) -> (Vec<f64>, u64, u64) {
    let optics = Optics { emission: EmissionModel::Unweighted, ..Optics::PLAIN };
    let size = (hull.outer[1] - hull.outer[0]).x;
    let white = Widget::new(WidgetShape::Uniform, [1.0 / size, 0.0, 0.0], 1e-9 / size);
    let transfer = TransferFunction::Widgets(vec![white]);
    let mut caster = caster(mesh, Settings { least_transmittance: 0.0, ..Settings::default() });
    let (mut errors, mut steps, mut lost) = (Vec::new(), 0, 0);
    for camera in &views(hull) {
        let frame = Frame { camera, transfer: &transfer, optics: &optics, size: RAYS, background: [0.0; 4] };
        let rendered = caster.render(&frame, false).unwrap_or_else(|e| panic!("{e}"));
        let counts = rendered.stats.rays.expect("counts");
        (steps, lost) = (steps + counts.steps, lost + counts.lost);
        errors.extend(rendered.image.pixels.iter().enumerate().map(|(i, pixel)| {
            let [x, y] = [i % RAYS[0] as usize, i / RAYS[0] as usize].map(|n| n as f64 + 0.5);
            length_error(hull, camera, [x, y], f64::from(pixel[0]) * size)
        }));
    }
    (errors, steps, lost)
}

/// 2 million rays; issue 4's bounds, in units of the diagonal.
#[test]
fn rays_pass_the_hulls_chord() {
    for hull in hulls() {
        let (mut errors, steps, lost) = cast_lengths(&hull, &hull.mesh);
        errors.sort_by(f64::total_cmp);
        let (median, worst) = (errors[errors.len() / 2], errors[errors.len() - 1]);
        println!("{}: {} rays, median {median:.1e}, worst {worst:.1e}, {steps} steps", hull.name, errors.len());
        assert!(median <= 1e-5 && worst <= 1e-3, "{}: median {median}, worst {worst}", hull.name);
        assert_eq!(lost, 0, "{}", hull.name);
        assert!(steps > 4 * errors.len() as u64, "{}: {steps}", hull.name);
    }
}

#[test]
fn a_missing_cell_is_seen() {
    let hull = &hulls()[2];
    let mut mesh = TetMesh::clone(&hull.mesh);
    let middle = mesh.tets.len() / 2;
    Arc::make_mut(&mut mesh.tets).swap_remove(middle);
    let (errors, ..) = cast_lengths(hull, &Arc::new(mesh));
    let bad = errors.iter().filter(|&&error| error > 1e-3).count();
    println!("{bad} rays differ");
    assert!(bad > 20, "{bad}");
}

/// Curves of 10 or 255 control points (Espinha & Celes 2005, Table 3), and of 9, which are the field's values at all entries
/// and exits of some rays.
#[test]
fn control_points_are_met() {
    let mesh = Arc::new(box_mesh(8, DVec3::ZERO, DVec3::ONE, |p| [p.x, 0.0]));
    let oracle = Oracle::new(mesh.clone());
    for (count, integral) in [(9, "partial-direct"), (9, "partial"), (10, "partial"), (255, "partial")] {
        let node = |i: u32| CurveNode {
            scalar: f64::from(i) / f64::from(count - 1),
            color: [GOLD, [0.1, 0.3, 0.9]][(i % 2) as usize],
            extinction: f64::from(i % 3),
        };
        let transfer = TransferFunction::Curve(Curve { nodes: (0..count).map(node).collect() });
        let integral: SegmentIntegral = integral.parse().expect("an integral");
        let mut caster = caster(&mesh, Settings { integral, ..Settings::default() });
        for direction in [DVec3::X, -DVec3::X, DVec3::Z, DVec3::new(0.6, 0.3, 0.7)] {
            let camera = Camera {
                eye: DVec3::splat(0.5) + 2.0 * direction,
                target: DVec3::splat(0.5),
                up: DVec3::Y,
                projection: Projection::Orthographic { height: 1.5 },
                near: None,
            };
            let optics = &Optics::PLAIN;
            let frame = Frame { camera: &camera, transfer: &transfer, optics, size: SIZE, background: [0.0; 4] };
            let want = oracle.image(&frame).expect("a picture");
            let got = caster.render(&frame, false).expect("a picture").image;
            let comparison = Comparison::new(&got, &want).expect("equal sizes");
            println!("{count} points, {integral}, along {direction}: {:.1} dB", comparison.psnr);
            assert!(comparison.psnr > 90.0, "{count} points, {integral}, along {direction}: {comparison}");
        }
    }
}
