//! `tetralux sample`: procedural meshes.

use super::args::SampleArgs;
use super::{output, progress};
use crate::mesh::write::write_vtu;

pub(super) fn run(args: &SampleArgs) -> anyhow::Result<()> {
    output::check_file(&args.output, &["vtu"])?;
    let mesh = progress::step("making", || args.name.mesh(args.tets as usize));
    progress::step("writing", || output::whole(|| write_vtu(&mesh, &args.output)))?;
    let (points, cells) = (mesh.points.len(), mesh.topology.cell_count());
    output::note(&format!("{points} points, {cells} cells: {}", args.output.display()));
    Ok(())
}
