//! Ray casting on the CPU.

#![expect(clippy::print_stdout, reason = "what was measured, for `--nocapture`")]

mod casting;
mod common;

use std::sync::Arc;

use common::meshes;
use glam::DVec3;
use tetralux::cpu::CpuRenderer;
use tetralux::mesh::synth::Sample;
use tetralux::renderer::{Frame, Method, Renderer, Settings};
use tetralux::scene::{Camera, EmissionModel, Optics, Projection, TransferFunction, Widget, WidgetShape};
use tetralux::tet::TetMesh;

const COMPILES: bool = false;

fn engine(mesh: &Arc<TetMesh>, settings: Settings) -> Box<dyn Renderer> {
    Box::new(CpuRenderer::new(mesh.clone(), settings).unwrap_or_else(|e| panic!("{e}")))
}

#[test]
fn what_it_cannot_do_is_refused() {
    let mesh = meshes::sample(Sample::Tangle, 1_000);
    for method in [Method::Project, Method::CellCast] {
        let refusal = CpuRenderer::new(mesh.clone(), Settings { method, ..Settings::default() });
        assert!(refusal.is_err_and(|e| e.to_string().contains("--method raycast")), "{method:?}");
    }
    let mut renderer = engine(&mesh, Settings { method: Method::RayCast, ..Settings::default() });
    let eye = DVec3::new(3.0, 2.0, 1.0);
    let projection = Projection::Perspective { fov_y: 0.8 };
    let camera = Camera { eye, target: DVec3::ZERO, up: DVec3::Y, projection, near: None };
    let mut refusal = |widget: Widget, optics: Optics, size| {
        let transfer = TransferFunction::Widgets(vec![Widget::new(WidgetShape::Uniform, [1.0; 3], 1.0), widget]);
        let frame = Frame { camera: &camera, transfer: &transfer, optics: &optics, size, background: [0.0; 4] };
        renderer.render(&frame, false).err().map(|e| e.to_string()).unwrap_or_default()
    };
    let size = [16, 16];
    let plain = Widget::new(WidgetShape::Uniform, [1.0; 3], 1.0);
    let glowing = Optics { emission: EmissionModel::Unweighted, ..Optics::PLAIN };
    assert!(refusal(plain.clone(), glowing, size).contains("unweighted"));
    assert!(refusal(plain.clone(), Optics::PLAIN, [0, 4]).contains("no pixels"));
    assert!(refusal(Widget::new(WidgetShape::Uniform, [1.0; 3], 1e300), Optics::PLAIN, size).contains("beyond f32"));
    assert_eq!(refusal(plain, Optics::PLAIN, size), "");
    let long = WidgetShape::Ramp { direction: [1.0, 0.0], knots: vec![[0.0, 0.0], [1.0, 1e300]] };
    let knots = refusal(Widget::new(long, [1.0; 3], 1.0), Optics::PLAIN, size);
    assert!(knots.contains("widget 1: its knots are beyond f32"), "{knots}");
    let wave = WidgetShape::Triangle { direction: [1.0, 0.0], offset: 1e300, period: 1e-300, duty: 1.0 };
    let period = refusal(Widget::new(wave, [1.0; 3], 1.0), Optics::PLAIN, size);
    assert!(period.contains("widget 1: its period or offset is beyond f32"), "{period}");
}
