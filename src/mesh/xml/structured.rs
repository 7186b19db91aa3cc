//! Structured grids: images (VTI), rectilinear (VTR) and curvilinear (VTS), whole or cut into blocks by extents.

use glam::{DMat3, DVec3};
use roxmltree::Node;

use super::array::{Array, section};
use super::document::{Document, children};
use super::extent::Extent;
use super::join::{common, ghosts};
use super::vtu::GHOST_CELL;
use crate::error::{Error, Result};
use crate::mesh::notes::Notes;
use crate::mesh::{ArrayInfo, Association, CellKind, DataArray, Mesh, ReadOptions, Topology};

/// A point that is not to be seen: vtkDataSetAttributes.h.
const HIDDEN_POINT: u64 = 2;
/// A cell that is not to be seen.
const HIDDEN_CELL: u64 = 32;

/// Reads all blocks of all documents, which are of one kind, as one grid.
pub(super) fn read(documents: &[&Document<'_>], options: &ReadOptions) -> Result<Mesh> {
    let mut notes = Notes::default();
    let mut blocks = Vec::new();
    for &document in documents {
        for node in children(document.grid()?, "Piece") {
            blocks.extend(Block::new(document, node, &mut notes)?);
        }
    }
    let Some(whole) = blocks.iter().map(|b| b.extent).reduce(Extent::union) else {
        return Err(Error::Mesh("no volume cells: the file has no points".into()));
    };
    whole.check()?;
    blocks.retain(|block| !block.extent.is_flat());
    if blocks.is_empty() {
        return Err(Error::Mesh("no volume cells: all pieces of the grid are flat".into()));
    }
    let grid = Grid { blocks, whole };
    let offers: Vec<Vec<ArrayInfo>> = grid.blocks.iter().map(Block::offers).collect();
    let available = common(&offers, &mut notes);
    let chosen = options.arrays.select(&available)?;
    let arrays: Vec<DataArray> = chosen.into_iter().map(|i| grid.read_array(&available[i])).collect::<Result<_>>()?;
    if arrays.is_empty() && grid.kind() != "StructuredGrid" {
        // Also the guard against extents from thin air: points are made only where values were read for them.
        return Err(Error::Mesh("the grid has no numeric arrays: there is nothing to render".into()));
    }
    let mut points = grid.points()?;
    let blank = grid.marks(Association::Point, HIDDEN_POINT)?;
    check_finite(&mut points, &blank).map_err(|what| grid.error(what))?;
    notes.count("points are blanked: cells at them are left out", blank.iter().filter(|b| **b).count() as u64);
    // Joined blocks cover each other's copies.
    let mask = if grid.blocks.len() == 1 { GHOST_CELL } else { HIDDEN_CELL };
    let hidden = grid.marks(Association::Cell, mask)?;
    let mesh = Mesh {
        points,
        topology: Topology::Structured { points: whole.points(), blank },
        arrays,
        available,
        notes: Vec::new(),
    };
    if hidden.contains(&true) {
        without_hidden(mesh, &hidden, notes)
    } else {
        Ok(Mesh { notes: notes.into_vec(), ..mesh })
    }
}

/// The blocks of a grid; at least one.
struct Grid<'d> {
    blocks: Vec<Block<'d>>,
    whole: Extent,
}

impl Grid<'_> {
    fn kind(&self) -> &str {
        self.blocks[0].document.kind()
    }

    fn error(&self, what: String) -> Error {
        self.blocks[0].document.malformed(what)
    }

    fn read_array(&self, info: &ArrayInfo) -> Result<DataArray> {
        let values = self.gather(info.association, info.components, |block| {
            block.arrays(info.association).iter().find(|a| a.name == info.name)
        })?;
        Ok(DataArray { name: info.name.clone(), association: info.association, components: info.components, values })
    }

    /// The values of an array of every block, in the order of the whole grid.
    fn gather<'s>(
        &'s self,
        association: Association,
        components: usize,
        find: impl Fn(&'s Block<'s>) -> Option<&'s Array<'s>>,
    ) -> Result<Vec<f64>> {
        let mut parts = Vec::new();
        for block in &self.blocks {
            let extent = block.extent.of(association);
            let array = find(block).ok_or_else(|| block.document.malformed("a piece lacks an array"))?;
            parts.push((extent, array.read(block.document, extent.checked_volume()?)?.to_f64()));
        }
        if parts.len() == 1 {
            return Ok(parts.remove(0).1);
        }
        self.whole.of(association).assemble(&parts, components).map_err(|what| self.error(what))
    }

    /// For each point or cell whether the file's ghost marks have one of the bits `mask`; empty where none has.
    fn marks(&self, association: Association, mask: u64) -> Result<Vec<bool>> {
        let marks = |block: &Block<'_>| {
            ghosts(block.arrays(association)).is_some_and(|a| a.name == "vtkGhostType" && a.components == 1)
        };
        if !self.blocks.iter().all(marks) {
            return Ok(Vec::new());
        }
        let values = self.gather(association, 1, |block| ghosts(block.arrays(association)))?;
        let marks: Vec<bool> = values.iter().map(|&v| v as u64 & mask != 0).collect();
        Ok(if marks.contains(&true) { marks } else { Vec::new() })
    }

    fn points(&self) -> Result<Vec<DVec3>> {
        match self.kind() {
            "ImageData" => {
                let image = Image::new(self.blocks[0].document)?;
                Ok(self.whole.indices().map(|at| image.place(at)).collect())
            }
            "RectilinearGrid" => {
                let axes = self.axes()?;
                let start = self.whole.start();
                let place =
                    |at: [i64; 3]| DVec3::from_array(std::array::from_fn(|a| axes[a][(at[a] - start[a]) as usize]));
                Ok(self.whole.indices().map(place).collect())
            }
            _ => {
                let values = self.gather(Association::Point, 3, |block| block.places.first())?;
                Ok(values.as_chunks::<3>().0.iter().map(|p| DVec3::from_array(*p)).collect())
            }
        }
    }

    /// The coordinates along each axis.
    fn axes(&self) -> Result<[Vec<f64>; 3]> {
        let mut axes = self.whole.points().map(|n| vec![f64::NAN; n]);
        for block in &self.blocks {
            let (start, points) = (block.extent.start(), block.extent.points());
            for (a, axis) in axes.iter_mut().enumerate() {
                let values = block.places[a].read(block.document, points[a])?.to_f64();
                let from = (start[a] - self.whole.start()[a]) as usize;
                axis[from..from + points[a]].copy_from_slice(&values);
            }
        }
        Ok(axes)
    }
}

/// A `Piece` element.
struct Block<'d> {
    document: &'d Document<'d>,
    extent: Extent,
    point_arrays: Vec<Array<'d>>,
    cell_arrays: Vec<Array<'d>>,
    /// Where the points are: one array of three components (VTS), three of one (VTR), none (VTI).
    places: Vec<Array<'d>>,
}

impl<'d> Block<'d> {
    /// `None` where the piece is empty.
    fn new(document: &'d Document<'d>, node: Node<'d, 'd>, notes: &mut Notes) -> Result<Option<Self>> {
        document.attribute(node, "Extent")?;
        let Some(extent) = document.numbers::<i32, 6>(node, "Extent")?.and_then(Extent::new) else { return Ok(None) };
        let places = match document.kind() {
            "RectilinearGrid" => section(document, node, "Coordinates", notes)?,
            "StructuredGrid" => section(document, node, "Points", notes)?,
            _ => Vec::new(),
        };
        let (arrays, components, name) = match document.kind() {
            "RectilinearGrid" => (3, 1, "Coordinates"),
            "StructuredGrid" => (1, 3, "Points"),
            _ => (0, 0, ""),
        };
        if places.len() != arrays || places.iter().any(|a| a.components != components) {
            let line = document.line(node.range().start);
            let what = format!("line {line}: <{name}> should hold {arrays} array(s) of {components} component(s)");
            return Err(document.malformed(what));
        }
        let point_arrays = section(document, node, "PointData", notes)?;
        let cell_arrays = section(document, node, "CellData", notes)?;
        Ok(Some(Self { document, extent, point_arrays, cell_arrays, places }))
    }

    fn arrays(&self, association: Association) -> &[Array<'d>] {
        match association {
            Association::Point => &self.point_arrays,
            Association::Cell => &self.cell_arrays,
        }
    }

    fn offers(&self) -> Vec<ArrayInfo> {
        let points = self.point_arrays.iter().map(|a| a.info(Association::Point));
        points.chain(self.cell_arrays.iter().map(|a| a.info(Association::Cell))).collect()
    }
}

/// Where an image's points are.
struct Image {
    origin: DVec3,
    /// Steps along the axes of the image.
    steps: DMat3,
}

impl Image {
    fn new(document: &Document<'_>) -> Result<Self> {
        let node = document.grid()?;
        let origin = document.numbers(node, "Origin")?.unwrap_or([0.0; 3]);
        let spacing = document.numbers(node, "Spacing")?.unwrap_or([1.0; 3]);
        let rows = document.numbers(node, "Direction")?.unwrap_or([1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0]);
        let steps = DMat3::from_cols_array(&rows).transpose() * DMat3::from_diagonal(DVec3::from_array(spacing));
        let origin = DVec3::from_array(origin);
        if !origin.is_finite() || !steps.is_finite() || steps.determinant() == 0.0 {
            return Err(document.malformed("the image's Origin, Spacing and Direction do not span a volume"));
        }
        Ok(Self { origin, steps })
    }

    fn place(&self, at: [i64; 3]) -> DVec3 {
        self.origin + self.steps * DVec3::from_array(at.map(|i| i as f64))
    }
}

/// Visible points must be finite; blanked ones are moved to the origin where they are not.
fn check_finite(points: &mut [DVec3], blank: &[bool]) -> Result<(), String> {
    for (i, p) in points.iter_mut().enumerate().filter(|(_, p)| !p.is_finite()) {
        if !blank.get(i).copied().unwrap_or(false) {
            return Err(format!("point {i} is at ({}, {}, {})", p.x, p.y, p.z));
        }
        *p = DVec3::ZERO;
    }
    Ok(())
}

/// The same grid as a list of cells, without those that are `hidden` or have a blanked point.
fn without_hidden(mesh: Mesh, hidden: &[bool], mut notes: Notes) -> Result<Mesh> {
    let Topology::Structured { points: [nx, ny, _], blank } = &mesh.topology else { return Ok(mesh) };
    let corner = |cell: usize| {
        let (i, j, k) = (cell % (nx - 1), cell / (nx - 1) % (ny - 1), cell / (nx - 1) / (ny - 1));
        (k * ny + j) * nx + i
    };
    let nodes_of = |cell: usize| {
        let at = corner(cell);
        [0, 1, *nx, nx + 1].into_iter().flat_map(move |d| [at + d]).chain([0, 1, *nx, nx + 1].map(|d| at + nx * ny + d))
    };
    let is_kept = |cell: &usize| !hidden[*cell] && nodes_of(*cell).all(|n| !blank.get(n).copied().unwrap_or(false));
    let kept: Vec<usize> = (0..hidden.len()).filter(is_kept).collect();
    notes.count("ghost or hidden cells left out", hidden.iter().filter(|h| **h).count() as u64);
    if kept.is_empty() {
        return Err(Error::Mesh(format!("no volume cells: all {} cells are marked as hidden", hidden.len())));
    }
    let nodes = kept.iter().flat_map(|&cell| nodes_of(cell).map(|n| n as u32)).collect();
    let topology = Topology::Cells { kinds: vec![CellKind::Voxel; kept.len()], nodes };
    let mut arrays = mesh.arrays;
    for array in arrays.iter_mut().filter(|a| a.association == Association::Cell) {
        let tuple =
            |&cell: &usize| array.values[cell * array.components..(cell + 1) * array.components].iter().copied();
        array.values = kept.iter().flat_map(tuple).collect();
    }
    Ok(Mesh { topology, arrays, notes: notes.into_vec(), ..mesh })
}
