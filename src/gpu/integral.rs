//! Integrals on the device: the constants that choose them, the tables that they look up, and what they refuse.

use crate::error::{Error, Result};
use crate::gpu::device::Gpu;
use crate::gpu::kernel::Resources;
use crate::gpu::record::{Recorder, Work};
use crate::renderer::SegmentIntegral;
use crate::scene::{EmissionModel, TransferFunction};
use crate::tables::{Kind, MOST_STRENGTH, NODES};

/// Lengths of the table of `preintegrated` (`shared/curves.wgsl`).
const LENGTHS: u32 = 32;

/// The constants that choose an integral (`shared/integrals.wgsl`).
pub fn constants(integral: SegmentIntegral, emission: EmissionModel) -> Vec<(&'static str, f64)> {
    let number = |n: u32| ("INTEGRAL", f64::from(n));
    let mut constants = match integral {
        SegmentIntegral::Analytic => vec![number(0)],
        SegmentIntegral::Adaptive { tolerance } => vec![number(1), ("TOLERANCE", tolerance)],
        SegmentIntegral::Segmented { pieces } => vec![number(2), ("EQUAL_PIECES", f64::from(pieces))],
        SegmentIntegral::MeanScalar => vec![number(3)],
        SegmentIntegral::VertexLinear => vec![number(4)],
        SegmentIntegral::PartialDirect => vec![number(5)],
        SegmentIntegral::Partial { size } => vec![number(5), ("TABLE_SIZE", f64::from(size))],
        SegmentIntegral::PreIntegrated { size } => vec![number(6), ("TABLE_SIZE", f64::from(size))],
    };
    constants.push(("TABLE_NODES", NODES as f64));
    constants.push(("MOST_STRENGTH", MOST_STRENGTH));
    constants.push(("UNWEIGHTED", f64::from(u8::from(emission == EmissionModel::Unweighted))));
    constants
}

/// What an integral cannot do.
///
/// # Errors
/// A table of 1D functions and widgets.
pub fn check(integral: SegmentIntegral, transfer: &TransferFunction) -> Result<()> {
    match (integral, transfer) {
        (SegmentIntegral::PreIntegrated { .. }, TransferFunction::Widgets(_)) => Err(Error::Asked(
            "'preintegrated' holds functions of the scalar alone, and the transfer function has widgets: use \
             adaptive, or give the function as a curve"
                .into(),
        )),
        _ => Ok(()),
    }
}

fn empty(gpu: &Gpu, entries: u32) -> wgpu::Buffer {
    gpu.buffer("table", u64::from(entries) * 16, wgpu::BufferUsages::STORAGE)
}

/// The tables of visible lengths (`shared/visible.wgsl`); an empty one where nothing is looked up.
pub fn visible_lengths(gpu: &Gpu, integral: SegmentIntegral, emission: EmissionModel) -> wgpu::Buffer {
    if (integral, emission) != (SegmentIntegral::Analytic, EmissionModel::Unweighted) {
        return gpu.buffer("visible_lengths", 16, wgpu::BufferUsages::STORAGE);
    }
    let values = [Kind::GaussianJ, Kind::ArchK, Kind::CosineK].map(|kind| kind.table().values.as_slice()).concat();
    gpu.storage("visible_lengths", &values)
}

/// The table of psi, filled on the device; an empty one where the integral looks nothing up.
///
/// # Errors
/// A lost device.
pub fn psi_table(gpu: &Gpu, integral: SegmentIntegral) -> Result<wgpu::Buffer> {
    let SegmentIntegral::Partial { size } = integral else { return Ok(empty(gpu, 1)) };
    let table = empty(gpu, size * size);
    let kernel = gpu.kernel("psi_table", &[("TABLE_SIZE", f64::from(size))])?;
    let groups = kernel.bind(gpu, &Resources::default().with("filled", &table))?;
    let mut recorder = Recorder::new(gpu, false);
    recorder.compute(&kernel, &groups, Work::Groups((size * size).div_ceil(64)))?;
    recorder.submit();
    Ok(table)
}

/// The table of a 1D function's segments, filled on the device.
///
/// # Errors
/// A table beyond what the device binds; a lost device.
pub fn preintegrated_table(
    gpu: &Gpu,
    size: u32,
    constants: &[(&'static str, f64)],
    resources: &Resources<'_>,
) -> Result<wgpu::Buffer> {
    let entries = size * size * LENGTHS;
    let bytes = u64::from(entries) * 16;
    if bytes > gpu.max_binding {
        return Err(Error::Asked(format!(
            "'preintegrated:{size}' is a table of {} MiB, and '{}' binds {} MiB at most: use a smaller size",
            bytes >> 20,
            gpu.info.name,
            gpu.max_binding >> 20
        )));
    }
    let table = empty(gpu, entries);
    let kernel = gpu.kernel("preintegrate", constants)?;
    let groups = kernel.bind(gpu, &resources.clone().with("filled", &table))?;
    let mut recorder = Recorder::new(gpu, false);
    recorder.compute(&kernel, &groups, Work::Groups(entries.div_ceil(64)))?;
    recorder.submit();
    Ok(table)
}
