//! Writing a mesh as VTU: appended raw data, UInt64 headers, little endian, all reals as Float64.

use std::io::{BufWriter, Write};
use std::path::Path;

use super::{Association, CellKind, DataArray, Mesh, Topology};
use crate::error::{Error, Result};

/// Writes `mesh` to `path` as a VTK XML unstructured grid with the arrays it holds.
///
/// The file appears whole or not at all. Structured grids are written as hexahedra, blanked cells left out.
///
/// # Errors
/// [`Error::Write`] where the file cannot be made.
pub fn write_vtu(mesh: &Mesh, path: &Path) -> Result<()> {
    let folder = path.parent().filter(|f| !f.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let mut builder = tempfile::Builder::new();
    builder.prefix(".tetralux-");
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        // As any other file would get; the process's umask still applies.
        builder.permissions(std::fs::Permissions::from_mode(0o666));
    }
    // Only the kind: the full text would name the temporary file.
    let mut file = builder.tempfile_in(folder).map_err(|e| Error::write(path, e.kind()))?;
    let mut out = BufWriter::new(&mut file);
    write_to(mesh, &mut out).and_then(|()| out.flush()).map_err(|e| Error::write(path, e))?;
    drop(out);
    file.persist(path).map_err(|e| Error::write(path, e.error))?;
    Ok(())
}

/// Explicit cells: nodes and VTK codes, and the numbers of the cells that are kept.
struct Cells {
    nodes: Vec<u32>,
    kinds: Vec<CellKind>,
    kept: Option<Vec<usize>>,
}

impl Cells {
    fn of(topology: &Topology) -> Self {
        match topology {
            Topology::Cells { kinds, nodes } => Self { nodes: nodes.clone(), kinds: kinds.clone(), kept: None },
            Topology::Structured { points, blank } => Self::of_grid(*points, blank),
        }
    }

    fn of_grid(n: [usize; 3], blank: &[bool]) -> Self {
        let (row, layer) = (n[0], n[0] * n[1]);
        let (mut nodes, mut kept) = (Vec::new(), Vec::new());
        let starts = (0..n[2] - 1)
            .flat_map(|k| (0..n[1] - 1).flat_map(move |j| (0..n[0] - 1).map(move |i| i + row * j + layer * k)));
        for (cell, start) in starts.enumerate() {
            let hexahedron = [0, 1, 1 + row, row, layer, 1 + layer, 1 + row + layer, row + layer].map(|o| start + o);
            if blank.is_empty() || hexahedron.iter().all(|&p| !blank[p]) {
                nodes.extend(hexahedron.map(|p| p as u32));
                kept.push(cell);
            }
        }
        Self { nodes, kinds: vec![CellKind::Hexahedron; kept.len()], kept: Some(kept) }
    }
}

fn write_to(mesh: &Mesh, out: &mut impl Write) -> std::io::Result<()> {
    let cells = Cells::of(&mesh.topology);
    let reals = |values: &[f64]| values.iter().flat_map(|v| v.to_le_bytes()).collect::<Vec<u8>>();
    let mut appended = Appended::default();
    let mut xml = format!(
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" \
         header_type=\"UInt64\">\n<UnstructuredGrid>\n<Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n",
        mesh.points.len(),
        cells.kinds.len()
    );
    for (tag, association) in [("PointData", Association::Point), ("CellData", Association::Cell)] {
        xml += &format!("<{tag}>\n");
        for array in mesh.arrays.iter().filter(|a| a.association == association) {
            let bytes = match &cells.kept {
                Some(kept) if association == Association::Cell => reals(&of_cells(array, kept)),
                _ => reals(&array.values),
            };
            xml += &appended.add("Float64", &escaped(&array.name), array.components, bytes);
        }
        xml += &format!("</{tag}>\n");
    }
    let points: Vec<u8> = mesh.points.iter().flat_map(|p| p.to_array()).flat_map(f64::to_le_bytes).collect();
    xml += &format!("<Points>\n{}</Points>\n<Cells>\n", appended.add("Float64", "Points", 3, points));
    let mut end = 0_i64;
    let offsets = cells.kinds.iter().flat_map(|k| {
        end += k.node_count() as i64;
        end.to_le_bytes()
    });
    xml += &appended.add("Int64", "offsets", 1, offsets.collect());
    let wide = cells.nodes.iter().flat_map(|&n| i64::from(n).to_le_bytes());
    xml += &appended.add("Int64", "connectivity", 1, wide.collect());
    xml += &appended.add("UInt8", "types", 1, cells.kinds.iter().map(|k| code(*k)).collect());
    xml += "</Cells>\n</Piece>\n</UnstructuredGrid>\n<AppendedData encoding=\"raw\">\n_";
    out.write_all(xml.as_bytes())?;
    appended.write(out)?;
    out.write_all(b"\n</AppendedData>\n</VTKFile>\n")
}

/// The blocks that follow the XML.
#[derive(Default)]
struct Appended {
    blocks: Vec<Vec<u8>>,
    end: usize,
}

impl Appended {
    /// Takes a block and returns the element that refers to it.
    fn add(&mut self, kind: &str, name: &str, components: usize, block: Vec<u8>) -> String {
        let offset = self.end;
        self.end += 8 + block.len();
        self.blocks.push(block);
        format!(
            "<DataArray type=\"{kind}\" Name=\"{name}\" NumberOfComponents=\"{components}\" format=\"appended\" \
             offset=\"{offset}\"/>\n"
        )
    }

    fn write(&self, out: &mut impl Write) -> std::io::Result<()> {
        self.blocks.iter().try_for_each(|block| {
            out.write_all(&(block.len() as u64).to_le_bytes())?;
            out.write_all(block)
        })
    }
}

/// The kept cells' tuples. The array has a tuple for each cell, blanked ones included.
fn of_cells(array: &DataArray, kept: &[usize]) -> Vec<f64> {
    let n = array.components;
    kept.iter().flat_map(|c| array.values[c * n..(c + 1) * n].iter().copied()).collect()
}

/// VTK's number of a cell shape (vtkCellType.h).
const fn code(kind: CellKind) -> u8 {
    match kind {
        CellKind::Tetrahedron => 10,
        CellKind::Voxel => 11,
        CellKind::Hexahedron => 12,
        CellKind::Wedge => 13,
        CellKind::Pyramid => 14,
    }
}

fn escaped(name: &str) -> String {
    name.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}
