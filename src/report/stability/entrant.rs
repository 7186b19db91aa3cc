//! Who draws.

use std::fmt;
use std::sync::Arc;

use super::Shot;
use crate::cpu::CpuRenderer;
use crate::error::{Error, Result};
use crate::gpu::{Gpu, GpuRenderer, RayCaster};
use crate::image::Image;
use crate::renderer::{Method, OrderMethod, Renderer as _, SegmentIntegral, Settings};

/// A method and its choices.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Entrant {
    /// Rays on the host.
    Cpu(SegmentIntegral),
    /// Rays on the device.
    Rays(SegmentIntegral),
    /// Projected cells.
    Project(OrderMethod),
    /// Front faces of cells, in the order that `auto` takes.
    CellCast,
}

impl Entrant {
    /// Of a device.
    pub const ON_DEVICE: [Self; 4] = [
        Self::Rays(SegmentIntegral::Adaptive { tolerance: SegmentIntegral::TOLERANCE }),
        Self::Project(OrderMethod::Auto),
        Self::Project(OrderMethod::Centroid),
        Self::CellCast,
    ];

    /// Of the host: by the default integral and by the others named.
    ///
    /// # Errors
    /// A name that no integral has.
    pub fn on_host(integrals: &[&str]) -> Result<Vec<Self>> {
        let named = integrals.iter().map(|name| name.parse());
        let all = [Ok(SegmentIntegral::default())].into_iter().chain(named);
        all.map(|integral| integral.map(Self::Cpu)).collect()
    }

    /// The picture. `gpu`: where devices are needed.
    ///
    /// # Errors
    /// What the renderer refuses.
    pub fn draw(self, shot: &Shot, gpu: Option<&Gpu>) -> Result<Image> {
        let mesh = Arc::clone(&shot.mesh);
        let device = || gpu.cloned().ok_or_else(|| Error::Device(format!("'{self}' needs a device")));
        let frame = shot.frame();
        let rendered = match self {
            Self::Cpu(integral) => {
                CpuRenderer::new(mesh, Settings { integral, ..Settings::default() })?.render(&frame, false)
            }
            Self::Rays(integral) => {
                let settings = Settings { method: Method::RayCast, integral, ..Settings::default() };
                RayCaster::new(device()?, mesh, settings)?.render(&frame, false)
            }
            Self::Project(order) => {
                let settings = Settings { method: Method::Project, order, ..Settings::default() };
                GpuRenderer::new(device()?, mesh, settings)?.render(&frame, false)
            }
            Self::CellCast => {
                let settings = Settings { method: Method::CellCast, ..Settings::default() };
                GpuRenderer::new(device()?, mesh, settings)?.render(&frame, false)
            }
        };
        Ok(rendered?.image)
    }
}

impl fmt::Display for Entrant {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (place, integral) = match self {
            Self::Cpu(integral) => ("cpu", *integral),
            Self::Rays(integral) => ("rays", *integral),
            Self::Project(OrderMethod::Auto) => return f.write_str("project"),
            Self::Project(order) => return write!(f, "project {order}"),
            Self::CellCast => return f.write_str("cellcast"),
        };
        if integral == SegmentIntegral::default() { f.write_str(place) } else { write!(f, "{place} {integral}") }
    }
}
