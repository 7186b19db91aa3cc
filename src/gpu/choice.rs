//! The cheapest way to draw a scene on a device that holds a tolerance: by what records say (`docs/bench.md`).

use std::sync::Arc;

use crate::error::{Error, Result};
use crate::gpu::device::Gpu;
use crate::gpu::lists::FragmentLists;
use crate::gpu::ordering::Ordering;
use crate::gpu::raycast::RayCaster;
use crate::gpu::renderer::GpuRenderer;
use crate::renderer::{BlendFormat, Frame, Method, OrderMethod, Renderer, Settings};
use crate::scene::TransferFunction;
use crate::tet::TetMesh;

/// On software adapters, projected cells cost less than rays up to such a share of cells that can be seen. Where fragments
/// are listed: in the records projection took 0.5 to 1.2 of the time of rays at 0.14, and 1.7 at 0.24.
const PAYS_LISTED: f64 = 0.2;
/// Where they are blended: 0.2 to 0.5 at 0.14, 0.9 at 0.57, and 0.7 to 2.6 where all cells are shown.
const PAYS_BLENDED: f64 = 0.5;

/// A renderer and why it was taken.
pub struct ChosenMethod {
    /// Draws the scene it was chosen for, and others.
    pub renderer: Box<dyn Renderer>,
    /// One sentence.
    pub why: String,
}

/// Rays or projected cells: whichever costs less, of those whose order is known to be right to a half of
/// [`Settings::tolerance`]. The choice depends on the mesh, the frame, the tolerance and the kind of device alone:
/// it is the same each time.
///
/// # Errors
/// A mesh beyond the device's limits, with the numbers; a lost device.
pub fn choose_method(gpu: Gpu, mesh: Arc<TetMesh>, settings: Settings, frame: &Frame<'_>) -> Result<ChosenMethod> {
    let projected = |gpu: Gpu, mesh, why: String| {
        let settings = Settings { method: Method::Project, ..settings };
        let renderer: Box<dyn Renderer> = Box::new(GpuRenderer::new(gpu, mesh, settings)?);
        Ok(ChosenMethod { renderer, why: format!("cells are projected: {why}") })
    };
    if settings.order != OrderMethod::Auto || settings.blend != BlendFormat::Auto {
        return projected(gpu, mesh, "an order or a format of blending is asked for".into());
    }
    let mut caster = match RayCaster::new(gpu.clone(), Arc::clone(&mesh), settings) {
        // Links take more room than cells.
        Err(Error::Device(why)) => return projected(gpu, mesh, why),
        caster => caster?,
    };
    let cast = |caster, why: String| {
        let renderer: Box<dyn Renderer> = Box::new(caster);
        Ok(ChosenMethod { renderer, why: format!("rays are cast: {why}") })
    };
    if !gpu.is_software() {
        return cast(caster, "they took the least time in all records of hardware adapters".into());
    }
    if !matches!(frame.transfer, TransferFunction::Curve(_)) || !gpu.blends_f32() {
        return cast(caster, "of sums of widgets they took the least time in all records of software adapters".into());
    }
    let shown = caster.shown(frame)?;
    let percent = 100.0 * shown;
    let pays = || match Ordering::default().choose(&mesh, &settings, frame).method {
        // Else cells would be sorted by their centroids, right or wrong.
        OrderMethod::PerPixel => shown <= PAYS_LISTED && FragmentLists::can_count(&gpu, frame.size),
        _ => true,
    };
    if shown <= PAYS_BLENDED && pays() {
        return projected(gpu, mesh, format!("the function shows {percent:.0} % of them"));
    }
    cast(caster, format!("the function shows {percent:.0} % of the cells, too many to project"))
}
