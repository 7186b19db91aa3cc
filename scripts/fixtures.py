#!/usr/bin/env python3
"""Writes the readers' test files in tests/fixtures/xml with VTK itself (pip install vtk==9.7.2 numpy).

usage: scripts/fixtures.py [FOLDER]

Every point array is a function of the point's place, every cell array one of the cell's centre, which is what
tests/readers_xml.rs checks:
  linear = x + 2 y + 4 z (Float64), U = (x, 2 y, 3 z) (Float32), center_x = x of the cell's centre (Float32)
"""
import itertools
import pathlib
import sys

import numpy as np
import vtk
from vtk.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray, vtk_to_numpy

OUT = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else pathlib.Path(__file__).parent.parent / "tests/fixtures/xml")


def add(data, name, values, dtype):
    array = numpy_to_vtk(np.ascontiguousarray(values, dtype=dtype), deep=True)
    array.SetName(name)
    data.AddArray(array)


def points_of(grid):
    if isinstance(grid, vtk.vtkPointSet):
        return vtk_to_numpy(grid.GetPoints().GetData()).astype(float)
    return np.array([grid.GetPoint(i) for i in range(grid.GetNumberOfPoints())])


def centers_of(grid):
    centers = []
    for i in range(grid.GetNumberOfCells()):
        ids = grid.GetCell(i).GetPointIds()
        corners = [grid.GetPoint(ids.GetId(k)) for k in range(ids.GetNumberOfIds())]
        centers.append(np.mean(corners, axis=0))
    return np.array(centers).reshape(-1, 3)


def add_fields(grid):
    x, y, z = points_of(grid).T
    add(grid.GetPointData(), "linear", x + 2 * y + 4 * z, np.float64)
    add(grid.GetPointData(), "U", np.stack([x, 2 * y, 3 * z], 1), np.float32)
    add(grid.GetCellData(), "center_x", centers_of(grid)[:, 0], np.float32)


def lattice(dims, steps=(0.5, 1.0, 2.0)):
    """Points of a lattice, x fastest, and the nodes of its hexahedra."""
    nx, ny, nz = dims
    points = np.array([(i, j, k) for k in range(nz) for j in range(ny) for i in range(nx)]) * np.array(steps)
    base = np.array(
        [i + nx * (j + ny * k) for k in range(nz - 1) for j in range(ny - 1) for i in range(nx - 1)]
    )[:, None]
    corners = np.array([0, 1, nx + 1, nx])
    return points, base + np.concatenate([corners, corners + nx * ny])


def unstructured(points, cells, dtype=np.float64):
    """`cells`: (VTK type, nodes) each."""
    grid = vtk.vtkUnstructuredGrid()
    vtk_points = vtk.vtkPoints()
    vtk_points.SetData(numpy_to_vtk(np.ascontiguousarray(points, dtype=dtype), deep=True))
    grid.SetPoints(vtk_points)
    for kind, nodes in cells:
        if kind == vtk.VTK_POLYHEDRON:
            faces = vtk.vtkIdList()
            faces.InsertNextId(len(nodes))
            for face in nodes:
                faces.InsertNextId(len(face))
                for node in face:
                    faces.InsertNextId(int(node))
            grid.InsertNextCell(kind, faces)
        else:
            grid.InsertNextCell(kind, len(nodes), [int(n) for n in nodes])
    return grid


def boxes(dims, dtype=np.float64):
    points, nodes = lattice(dims)
    grid = unstructured(points, [(vtk.VTK_HEXAHEDRON, n) for n in nodes], dtype)
    add_fields(grid)
    return grid


def write(writer, name, grid, mode="appended", compressor="ZLib", header=64, big=False, block=64):
    writer.SetFileName(str(OUT / name))
    if grid is not None:
        writer.SetInputData(grid)
    configure(writer, mode, compressor, header, big, block)
    assert writer.Write() == 1, name


def configure(writer, mode="appended", compressor="ZLib", header=64, big=False, block=64):
    {"ascii": writer.SetDataModeToAscii, "binary": writer.SetDataModeToBinary}.get(
        mode, writer.SetDataModeToAppended
    )()
    writer.SetEncodeAppendedData(mode == "base64")
    getattr(writer, f"SetCompressorTypeTo{compressor}")()
    getattr(writer, f"SetHeaderTypeToUInt{header}")()
    getattr(writer, f"SetIdTypeToInt{header}")()
    (writer.SetByteOrderToBigEndian if big else writer.SetByteOrderToLittleEndian)()
    if compressor != "None":
        writer.SetBlockSize(block)


def encodings():
    """32 points: 256 bytes a Float64 array, four whole blocks of 64; its other arrays end with a part of a block."""
    for mode, compressor, header, big in itertools.product(
        ["binary", "appended", "base64"], ["None", "ZLib", "LZ4", "LZMA"], [32, 64], [False, True]
    ):
        order = "be" if big else "le"
        name = f"encoding_{mode}_{compressor.lower()}_u{header}_{order}.vtu"
        dtype = np.float32 if header == 32 else np.float64
        write(vtk.vtkXMLUnstructuredGridWriter(), name, boxes((4, 4, 2), dtype), mode, compressor, header, big)
    write(vtk.vtkXMLUnstructuredGridWriter(), "encoding_ascii.vtu", boxes((4, 4, 2)), "ascii", "None")


def types():
    """value = index - 10 (signed, floating) or index (unsigned)."""
    grid = boxes((4, 4, 2))
    index = np.arange(32)
    for bits in (8, 16, 32, 64):
        add(grid.GetPointData(), f"i{bits}", index - 10, f"int{bits}")
        add(grid.GetPointData(), f"u{bits}", index, f"uint{bits}")
    for bits in (32, 64):
        add(grid.GetPointData(), f"f{bits}", index - 10, f"float{bits}")
    add(grid.GetPointData(), "T", np.arange(32 * 9).reshape(32, 9), np.float32)
    words = vtk.vtkStringArray()
    words.SetName("words")
    for i in range(32):
        words.InsertNextValue(f"w{i}")
    grid.GetPointData().AddArray(words)
    add(grid.GetFieldData(), "TimeValue", [1.5], np.float64)
    for mode, big in itertools.product(["ascii", "appended"], [False, True]):
        write(vtk.vtkXMLUnstructuredGridWriter(), f"types_{mode}_{'be' if big else 'le'}.vtu", grid, mode, "None", big=big)


def mixed():
    """One of each linear shape around others that are not rendered; cell array `id` = position in the file."""
    points = np.array(
        [
            (0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1),  # a cube
            (2, 0, 0), (2, 1, 0), (2, 0, 1), (2, 1, 1),  # another beside it
            (0.5, 0.5, 2),  # above
            (3, 0.5, 0.5),  # beside
        ],
        dtype=float,
    )  # fmt: skip
    cube = [(0, 3, 2, 1), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7)]
    cells = [
        (vtk.VTK_TRIANGLE, (0, 1, 2)),
        (vtk.VTK_HEXAHEDRON, (0, 1, 2, 3, 4, 5, 6, 7)),
        (vtk.VTK_LINE, (0, 1)),
        (vtk.VTK_POLYHEDRON, cube),
        (vtk.VTK_VOXEL, (1, 8, 2, 9, 5, 10, 6, 11)),
        (vtk.VTK_PYRAMID, (4, 5, 6, 7, 12)),
        (vtk.VTK_QUAD, (4, 5, 6, 7)),
        (vtk.VTK_WEDGE, (8, 13, 9, 10, 13, 11)),
        (vtk.VTK_VERTEX, (3,)),
        (vtk.VTK_TETRA, (8, 9, 10, 13)),
        (vtk.VTK_POLYGON, (0, 1, 2, 3)),
        (vtk.VTK_HEXAGONAL_PRISM, (0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11)),
    ]
    grid = unstructured(points, cells)
    add_fields(grid)
    add(grid.GetCellData(), "id", np.arange(len(cells)), np.int32)
    write(vtk.vtkXMLUnstructuredGridWriter(), "mixed.vtu", grid)
    write(vtk.vtkXMLUnstructuredGridWriter(), "mixed_ascii.vtu", grid, "ascii", "None")
    flat = unstructured(points, [c for c in cells if c[0] in (vtk.VTK_TRIANGLE, vtk.VTK_LINE)])
    add_fields(flat)
    write(vtk.vtkXMLUnstructuredGridWriter(), "surface.vtu", flat)


def quadratic():
    """Higher-order cells; a cell's nodes are points of its own, at VTK's parametric coordinates, moved by 2 cells in x."""
    points, cells = [], []
    classes = [
        vtk.vtkQuadraticTetra, vtk.vtkQuadraticHexahedron, vtk.vtkQuadraticWedge, vtk.vtkQuadraticPyramid,
        vtk.vtkTriQuadraticHexahedron, vtk.vtkQuadraticLinearWedge, vtk.vtkBiQuadraticQuadraticWedge,
        vtk.vtkBiQuadraticQuadraticHexahedron, vtk.vtkTriQuadraticPyramid,
    ]  # fmt: skip
    made = [(c(), None) for c in classes]
    made += [(vtk.vtkLagrangeTetra(), 10), (vtk.vtkLagrangeHexahedron(), 27), (vtk.vtkLagrangeWedge(), 18)]
    made += [(vtk.vtkBezierTetra(), 10)]
    for i, (cell, nodes) in enumerate(made):
        if nodes is not None:
            cell.GetPointIds().SetNumberOfIds(nodes)
            cell.GetPoints().SetNumberOfPoints(nodes)
            for k in range(nodes):
                cell.GetPointIds().SetId(k, k)
            if hasattr(cell, "SetUniformOrderFromNumPoints"):
                cell.SetUniformOrderFromNumPoints(nodes)
            cell.Initialize()
        count = cell.GetNumberOfPoints()
        own = np.array(cell.GetParametricCoords())[: 3 * count].reshape(-1, 3) + [2 * i, 0, 0]
        cells.append((cell.GetCellType(), range(len(points), len(points) + count)))
        points.extend(own)
    grid = unstructured(np.array(points), cells)
    add_fields(grid)
    add(grid.GetCellData(), "type", [c[0] for c in cells], np.uint8)
    write(vtk.vtkXMLUnstructuredGridWriter(), "quadratic.vtu", grid)


def pieces():
    """4 x 3 x 2 boxes in three pieces: with ghost cells in a PVTU, without in one VTU."""
    source = vtk.vtkTrivialProducer()
    source.SetOutput(boxes((5, 4, 3)))
    cut = vtk.vtkExtractUnstructuredGridPiece()
    cut.SetInputConnection(source.GetOutputPort())
    cut.CreateGhostCellsOn()
    writer = vtk.vtkXMLPUnstructuredGridWriter()
    writer.SetInputConnection(cut.GetOutputPort())
    writer.SetNumberOfPieces(3)
    writer.SetStartPiece(0)
    writer.SetEndPiece(2)
    writer.SetGhostLevel(1)
    write(writer, "ghosts.pvtu", None)
    single = vtk.vtkXMLUnstructuredGridWriter()
    single.SetInputConnection(cut.GetOutputPort())
    single.SetNumberOfPieces(3)
    write(single, "pieces.vtu", None)


def structured():
    extent = (2, 5, -1, 2, 0, 2)
    image = vtk.vtkImageData()
    image.SetExtent(*extent)
    image.SetOrigin(1, 2, 3)
    image.SetSpacing(0.5, 1, 2)
    image.SetDirectionMatrix(0, -1, 0, 1, 0, 0, 0, 0, 1)
    add_fields(image)
    write(vtk.vtkXMLImageDataWriter(), "image.vti", image)
    write(vtk.vtkXMLImageDataWriter(), "image_ascii.vti", image, "ascii", "None")

    axes = [np.array([0, 1, 3, 7.0]), np.array([-1, 0, 0.5, 4]), np.array([2, 3, 5.0])]
    rectilinear = vtk.vtkRectilinearGrid()
    rectilinear.SetExtent(*extent)
    for axis, values in zip("XYZ", axes):
        array = numpy_to_vtk(values, deep=True)
        array.SetName(axis)  # else VTK writes an address as its name
        getattr(rectilinear, f"Set{axis}Coordinates")(array)
    add_fields(rectilinear)
    write(vtk.vtkXMLRectilinearGridWriter(), "rectilinear.vtr", rectilinear, "binary", "LZ4")

    points, _ = lattice((4, 4, 3))
    points[:, 0] += 0.1 * points[:, 1] ** 2  # curved
    curved = vtk.vtkStructuredGrid()
    curved.SetExtent(*extent)
    vtk_points = vtk.vtkPoints()
    vtk_points.SetData(numpy_to_vtk(points, deep=True))
    curved.SetPoints(vtk_points)
    add_fields(curved)
    write(vtk.vtkXMLStructuredGridWriter(), "curved.vts", curved, "base64", "LZMA", 32, True)

    for grid, kind, name in [
        (image, "PImageData", "image.pvti"),
        (rectilinear, "PRectilinearGrid", "rectilinear.pvtr"),
        (curved, "PStructuredGrid", "curved.pvts"),
    ]:
        writer = getattr(vtk, f"vtkXML{kind}Writer")()
        writer.SetNumberOfPieces(2)
        writer.SetStartPiece(0)
        writer.SetEndPiece(1)
        write(writer, name, grid)

    hidden = vtk.vtkStructuredGrid()
    hidden.DeepCopy(curved)
    hidden.BlankPoint(5)
    write(vtk.vtkXMLStructuredGridWriter(), "blanked_point.vts", hidden)
    hidden.DeepCopy(curved)
    hidden.BlankCell(4)
    write(vtk.vtkXMLStructuredGridWriter(), "blanked_cell.vts", hidden)

    plane = vtk.vtkImageData()
    plane.SetDimensions(4, 4, 1)
    add_fields(plane)
    write(vtk.vtkXMLImageDataWriter(), "plane.vti", plane)


def series():
    """Three steps; `step` = 10 times the step everywhere. The last has two parts."""
    lines = []
    for step in range(3):
        grid = boxes((2, 2, 2))
        add(grid.GetPointData(), "step", np.full(8, 10.0 * step), np.float64)
        write(vtk.vtkXMLUnstructuredGridWriter(), f"series_{step}.vtu", grid)
        lines.append(f'    <DataSet timestep="{0.25 * step}" group="" part="0" file="series_{step}.vtu"/>')
    beside = boxes((2, 2, 2))
    moved = points_of(beside) + [0.5, 0, 0]
    beside.GetPoints().SetData(numpy_to_vtk(moved, deep=True))
    beside.GetPointData().Initialize()
    beside.GetCellData().Initialize()
    add_fields(beside)
    add(beside.GetPointData(), "step", np.full(8, 20.0), np.float64)
    write(vtk.vtkXMLUnstructuredGridWriter(), "series_2b.vtu", beside)
    lines.append('    <DataSet timestep="0.5" group="" part="1" file="series_2b.vtu"/>')
    text = '<?xml version="1.0"?>\n<VTKFile type="Collection" version="0.1" byte_order="LittleEndian">\n  <Collection>\n'
    # Not in the order of time, as after a restart.
    text += "\n".join(reversed(lines)) + "\n  </Collection>\n</VTKFile>\n"
    (OUT / "series.pvd").write_text(text)


if __name__ == "__main__":
    OUT.mkdir(parents=True, exist_ok=True)
    for old in OUT.iterdir():
        old.unlink()
    encodings()
    types()
    mixed()
    quadratic()
    pieces()
    structured()
    series()
    total = sum(f.stat().st_size for f in OUT.iterdir())
    print(f"{len(list(OUT.iterdir()))} files, {total} bytes in {OUT}")
