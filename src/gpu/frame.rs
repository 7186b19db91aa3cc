//! The camera as shaders see it.

use glam::{DVec3, Vec3};

use crate::gpu::layout;
use crate::plan::lens::basis_in_mesh;
use crate::renderer::Frame;
use crate::scene::{Camera, Projection};
use crate::tet::Domain;

/// The camera, picture and background, in mesh space; counts are left 0.
pub fn camera_uniform(frame: &Frame<'_>, mesh: &(impl Domain + ?Sized)) -> layout::Frame {
    let camera: &Camera = frame.camera;
    let basis = basis_in_mesh(camera, mesh);
    let eye = mesh.mesh_from_data(camera.eye);
    // The mesh lies within 1 of the origin.
    let reference = if eye.length() <= 4.0 { eye.as_vec3() } else { Vec3::ZERO };
    let eye_from_reference = eye - reference.as_dvec3();
    let [width, height] = frame.size.map(f64::from);
    let aspect = width / height;
    let half = half_height(camera, mesh);
    let (x_row, y_row) = (basis.right / (half * aspect), basis.up / half);
    let offset = |row: DVec3| (-row.dot(eye_from_reference)) as f32;
    let f32s = |v: DVec3| v.as_vec3().to_array();
    layout::Frame {
        reference: reference.to_array(),
        eye_from_reference: f32s(eye_from_reference),
        x_row: f32s(x_row),
        image_width: width as f32,
        y_row: f32s(y_row),
        image_height: height as f32,
        forward: f32s(basis.forward),
        ray_per_clip_x: (half * aspect) as f32,
        ray_per_clip_y: half as f32,
        background: frame.background,
        x_offset: offset(x_row),
        y_offset: offset(y_row),
        z_offset: offset(basis.forward),
        ..Default::default()
    }
}

/// Half the picture's height at depth 1 (perspective) or everywhere (orthographic, mesh units).
fn half_height(camera: &Camera, mesh: &(impl Domain + ?Sized)) -> f64 {
    match camera.projection {
        Projection::Perspective { fov_y } => (0.5 * fov_y).tan(),
        Projection::Orthographic { height } => 0.5 * height / mesh.data_per_mesh(),
    }
}
