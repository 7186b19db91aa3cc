//! From a choice of device to a renderer: the only place here that makes one.

use std::sync::Arc;

use super::args::Device;
use crate::cpu::{self, CpuRenderer};
use crate::error::{Error, Result};
use crate::gpu::{DeviceChoice, Gpu, GpuRenderer, GridCaster, GridRenderer, RayCaster, choose_method};
use crate::oracle::{Oracle, Progress};
use crate::renderer::{BlendFormat, Frame, Method, OrderMethod, Renderer, Settings};
use crate::scene::Optics;
use crate::space::Bounds;
use crate::tet::{Grid, TetMesh};

/// A renderer, and what is to be said of the choice.
pub(crate) struct Chosen {
    pub renderer: Box<dyn Renderer>,
    pub note: Option<String>,
    /// Why this method, where it was chosen.
    pub why: Option<String>,
    /// The reference integrates in its own way.
    pub is_reference: bool,
}

/// What decides.
pub(crate) struct Wish<'a> {
    pub device: Device,
    pub settings: Settings,
    pub frame: &'a Frame<'a>,
    /// A device that is open already, for pictures on hardware.
    pub shared: Option<&'a Gpu>,
}

impl Wish<'_> {
    fn open(&self, choice: DeviceChoice) -> Result<Gpu> {
        match self.shared {
            Some(gpu) if choice == DeviceChoice::Any => Ok(gpu.clone()),
            _ => Gpu::new(choice),
        }
    }
}

/// The renderer of one's wish; those that know how far a picture is tell `progress`.
pub(crate) fn renderer(mesh: &Arc<TetMesh>, wish: &Wish<'_>, progress: &Progress) -> Result<Chosen> {
    let settings = wish.settings;
    let (renderer, why) = match wish.device {
        Device::Oracle => (reference(mesh, progress), None),
        Device::Cpu => (cast(mesh, settings)?, None),
        Device::Gpu => on_gpu(wish.open(DeviceChoice::Any)?, mesh, wish)?,
        Device::Software => on_gpu(wish.open(DeviceChoice::Software)?, mesh, wish)?,
        Device::Auto => return automatic(mesh, wish, progress),
    };
    let casts = matches!(wish.device, Device::Cpu | Device::Oracle) || settings.method == Method::RayCast;
    let note = (casts && settings.order != OrderMethod::Auto)
        .then(|| "rays have no order of cells: --order is not used".into());
    Ok(Chosen { renderer, note, why, is_reference: wish.device == Device::Oracle })
}

/// Hardware first; then the CPU engine if it can render the scene; then a software adapter, and the reference at last.
fn automatic(mesh: &Arc<TetMesh>, wish: &Wish<'_>, progress: &Progress) -> Result<Chosen> {
    let settings = wish.settings;
    let chosen =
        |renderer, note: &str| Ok(Chosen { renderer, note: Some(note.into()), why: None, is_reference: false });
    let castable = matches!(settings.method, Method::Auto | Method::RayCast)
        && cpu::supports(wish.frame.transfer, wish.frame.optics, settings.integral).is_ok();
    match wish.open(DeviceChoice::Any) {
        Ok(gpu) if gpu.is_software() && castable => chosen(
            cast(mesh, settings)?,
            &format!(
                "'{}' is a software adapter: the CPU engine, whose visibility is exact, is taken instead",
                gpu.info.name
            ),
        ),
        Ok(gpu) => {
            let (renderer, why) = on_gpu(gpu, mesh, wish)?;
            Ok(Chosen { renderer, note: None, why, is_reference: false })
        }
        Err(Error::Device(why)) if castable => {
            chosen(cast(mesh, settings)?, &format!("{why}; rays are cast on the CPU instead"))
        }
        Err(Error::Device(why)) => {
            let note = format!("{why}; rendered on the CPU with the f64 reference instead, which is slow");
            Ok(Chosen { is_reference: true, ..chosen(reference(mesh, progress), &note)? })
        }
        Err(other) => Err(other),
    }
}

/// What a device is called here; none where there is none.
pub(crate) fn adapter(device: Device) -> Result<String> {
    let choice = match device {
        Device::Cpu => return Ok(cpu::describe()),
        Device::Oracle => return Ok("the f64 reference".into()),
        Device::Auto | Device::Gpu => DeviceChoice::Any,
        Device::Software => DeviceChoice::Software,
    };
    Ok(Gpu::new(choice)?.describe())
}

/// Whether a grid needs no mesh: a graphics device that draws the scene without one.
pub(crate) fn takes_grids(device: Device, settings: Settings, optics: &Optics) -> bool {
    let choice = match device {
        Device::Cpu | Device::Oracle => return false,
        Device::Auto | Device::Gpu => DeviceChoice::Any,
        Device::Software => DeviceChoice::Software,
    };
    if settings.method == Method::CellCast || optics.uses_gradients() {
        return false;
    }
    let blends = settings.method == Method::Project;
    !(blends && settings.blend == BlendFormat::F16) && Gpu::new(choice).is_ok_and(|gpu| !blends || gpu.blends_f32())
}

/// A renderer of a grid's implied tetrahedra, or of those in a box. Rays are the default: what they take does not grow with
/// what can be seen.
pub(crate) fn grid_renderer(grid: &Arc<Grid>, wish: &Wish<'_>, bounds: Option<&Bounds>) -> Result<Chosen> {
    let choice = match wish.device {
        Device::Auto | Device::Gpu => DeviceChoice::Any,
        Device::Software => DeviceChoice::Software,
        Device::Cpu | Device::Oracle => {
            let text = "a structured order is drawn by graphics devices: render with --device gpu or software, or with \
                        another --order";
            return Err(Error::Asked(text.into()));
        }
    };
    let (gpu, grid) = (wish.open(choice)?, Arc::clone(grid));
    let is_auto = wish.settings.order == OrderMethod::Auto;
    let casts = wish.settings.method == Method::RayCast || (is_auto && wish.settings.method == Method::Auto);
    let renderer: Box<dyn Renderer> = if casts {
        let caster = GridCaster::new(gpu, grid, wish.settings)?;
        Box::new(if let Some(bounds) = bounds { caster.clipped_to(bounds)? } else { caster })
    } else {
        let renderer = GridRenderer::new(gpu, grid, wish.settings)?;
        Box::new(if let Some(bounds) = bounds { renderer.clipped_to(bounds)? } else { renderer })
    };
    let note = "a voxel of the grid stands for five tetrahedra, none of which is held; --split 6 makes a mesh";
    Ok(Chosen { renderer, note: is_auto.then(|| note.into()), why: None, is_reference: false })
}

fn cast(mesh: &Arc<TetMesh>, settings: Settings) -> Result<Box<dyn Renderer>> {
    Ok(Box::new(CpuRenderer::new(Arc::clone(mesh), settings)?))
}

/// What was asked for, or what is chosen, and why.
fn on_gpu(gpu: Gpu, mesh: &Arc<TetMesh>, wish: &Wish<'_>) -> Result<(Box<dyn Renderer>, Option<String>)> {
    let (mesh, settings) = (Arc::clone(mesh), wish.settings);
    Ok(match settings.method {
        Method::RayCast => (Box::new(RayCaster::new(gpu, mesh, settings)?), None),
        Method::Project | Method::CellCast => (Box::new(GpuRenderer::new(gpu, mesh, settings)?), None),
        Method::Auto => {
            let chosen = choose_method(gpu, mesh, settings, wish.frame)?;
            (chosen.renderer, Some(chosen.why))
        }
    })
}

fn reference(mesh: &Arc<TetMesh>, progress: &Progress) -> Box<dyn Renderer> {
    Box::new(Oracle::new(Arc::clone(mesh)).with_progress(Arc::clone(progress)))
}
