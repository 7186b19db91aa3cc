#!/usr/bin/env python3
"""Regenerates tests/fixtures/files: small files written by VTK itself (pip install vtk), and what VTK reads back.

usage: fixtures_legacy.py [FOLDER]

expected.json holds, by the file's name without encoding and version, what VTK's own reader says: numbers of points and
cells, bounds, and the arrays' values.
"""
import gzip
import json
import os
import sys

import numpy as np
import vtk
from vtk.util.numpy_support import numpy_to_vtk, vtk_to_numpy

OUT = sys.argv[1] if len(sys.argv) > 1 else os.path.join(os.path.dirname(__file__), "../tests/fixtures/files")


def array(name, values, kind=None):
    a = numpy_to_vtk(np.ascontiguousarray(values), deep=1, array_type=kind)
    a.SetName(name)
    return a


def add_arrays(grid):
    """Arrays of many types: attributes (scalars, vectors, tensors, normals) and fields, for points and cells."""
    n, c = grid.GetNumberOfPoints(), grid.GetNumberOfCells()
    i, j = np.arange(n, dtype=float), np.arange(c, dtype=float)
    points, cells = grid.GetPointData(), grid.GetCellData()
    scalars = array("temperature", (0.5 * i - 3).astype(np.float32))
    points.SetScalars(scalars)
    points.SetVectors(array("velocity", np.stack([i, -i, i * i], 1)))
    points.SetTensors(array("stress", np.stack([i * k for k in range(9)], 1)))
    points.SetNormals(array("normal", np.tile(np.float32([0, 0, 1]), (n, 1))))
    points.AddArray(array("with space", (i % 7).astype(np.uint8)))
    points.AddArray(array("long", np.arange(n, dtype=np.int64) * 1000003 - 5))
    points.AddArray(array("short pair", np.stack([i, -i], 1).astype(np.int16)))
    components = array("named", np.stack([i, i + 1], 1))
    components.SetComponentName(0, "left")
    components.SetComponentName(1, "right")
    points.AddArray(components)
    bits = vtk.vtkBitArray()
    bits.SetName("bits")
    for k in range(n):
        bits.InsertNextValue(k % 3 == 0)
    points.AddArray(bits)
    cells.SetScalars(array("cell number", j.astype(np.int32)))
    cells.AddArray(array("cell real", np.sqrt(j)))
    time = array("TimeValue", np.array([0.25]))
    grid.GetFieldData().AddArray(time)
    words = vtk.vtkStringArray()
    words.SetName("words")
    for word in ("one", "two words", ""):
        words.InsertNextValue(word)
    grid.GetFieldData().AddArray(words)


def mixed():
    """A cell of each shape, quadratic ones, and cells that are not rendered."""
    rng = np.random.default_rng(1)
    points = vtk.vtkPoints()
    points.SetDataTypeToDouble()
    grid = vtk.vtkUnstructuredGrid()
    shapes = [(vtk.VTK_TETRA, 4), (vtk.VTK_TRIANGLE, 3), (vtk.VTK_PYRAMID, 5), (vtk.VTK_WEDGE, 6), (vtk.VTK_LINE, 2),
              (vtk.VTK_HEXAHEDRON, 8), (vtk.VTK_VOXEL, 8), (vtk.VTK_QUADRATIC_TETRA, 10),
              (vtk.VTK_QUADRATIC_HEXAHEDRON, 20), (vtk.VTK_HEXAGONAL_PRISM, 12)]
    for _ in range(30):
        points.InsertNextPoint(*rng.uniform(-1, 1, 3))
    grid.SetPoints(points)
    for code, size in shapes:
        ids = vtk.vtkIdList()
        for k in rng.permutation(30)[:size]:
            ids.InsertNextId(int(k))
        grid.InsertNextCell(code, ids)
    add_arrays(grid)
    return grid


def polyhedron():
    points = vtk.vtkPoints()
    for p in [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)]:
        points.InsertNextPoint(p)
    grid = vtk.vtkUnstructuredGrid()
    grid.SetPoints(points)
    faces = vtk.vtkIdList()
    for k in [4, 3, 0, 2, 1, 3, 0, 1, 3, 3, 1, 2, 3, 3, 0, 3, 2]:
        faces.InsertNextId(k)
    grid.InsertNextCell(vtk.VTK_POLYHEDRON, faces)
    grid.InsertNextCell(vtk.VTK_TETRA, 4, (0, 1, 2, 3))
    return grid


def image():
    grid = vtk.vtkImageData()
    grid.SetDimensions(3, 4, 2)
    grid.SetOrigin(1, 2, 3)
    grid.SetSpacing(0.5, 0.25, 2)
    add_arrays(grid)
    return grid


def curvilinear(hide=False):
    k, j, i = np.meshgrid(np.arange(2), np.arange(4), np.arange(3), indexing="ij")
    p = np.stack([i + 0.1 * j, j * (1 + 0.2 * k), k + 0.05 * i * i], -1).reshape(-1, 3)
    points = vtk.vtkPoints()
    points.SetData(numpy_to_vtk(p.astype(np.float32), 1))
    grid = vtk.vtkStructuredGrid()
    grid.SetDimensions(3, 4, 2)
    grid.SetPoints(points)
    add_arrays(grid)
    if hide:
        grid.BlankPoint(0)
        grid.BlankPoint(23)
    return grid


def rectilinear():
    grid = vtk.vtkRectilinearGrid()
    grid.SetDimensions(3, 4, 2)
    grid.SetXCoordinates(array("x", np.array([0.0, 1, 4])))
    grid.SetYCoordinates(array("y", np.array([0.0, 1, 2, 8], dtype=np.float32)))
    grid.SetZCoordinates(array("z", np.array([-1.0, 1])))
    add_arrays(grid)
    return grid


def surface():
    sphere = vtk.vtkSphereSource()
    sphere.SetThetaResolution(3)
    sphere.SetPhiResolution(3)
    sphere.Update()
    return sphere.GetOutput()


def summary(grid):
    out = {"points": grid.GetNumberOfPoints(), "cells": grid.GetNumberOfCells(), "bounds": grid.GetBounds(), "arrays": []}
    for where, data in (("point", grid.GetPointData()), ("cell", grid.GetCellData())):
        for k in range(data.GetNumberOfArrays()):
            a = data.GetArray(k)
            if a.GetName() == "vtkGhostType":
                continue
            values = np.array([a.GetTuple(t) for t in range(a.GetNumberOfTuples())])
            out["arrays"].append({"name": a.GetName(), "of": where, "components": a.GetNumberOfComponents(),
                                  "values": values.ravel().tolist()})
    return out


def legacy(expected):
    makers = {"mixed": mixed, "polyhedron": polyhedron, "image": image, "curvilinear": curvilinear,
              "hidden": lambda: curvilinear(True), "rectilinear": rectilinear, "surface": surface}
    for name, make in makers.items():
        for binary in (False, True):
            for version in (42, 51):
                if name == "hidden" and not binary:
                    continue
                file = f"{name}_{'binary' if binary else 'ascii'}_{version}.vtk"
                writer = vtk.vtkDataSetWriter()
                writer.SetInputData(make())
                writer.SetFileName(os.path.join(OUT, file))
                writer.SetFileVersion(version)
                writer.SetFileTypeToBinary() if binary else writer.SetFileTypeToASCII()
                writer.Write()
                reader = vtk.vtkDataSetReader()
                reader.SetFileName(os.path.join(OUT, file))
                reader.ReadAllScalarsOn()
                reader.ReadAllVectorsOn()
                reader.ReadAllTensorsOn()
                reader.ReadAllNormalsOn()
                reader.ReadAllFieldsOn()
                reader.Update()
                got = summary(reader.GetOutput())
                if name in expected and not binary:
                    assert expected[name]["points"] == got["points"], file
                # Text has fewer digits: the binary file of 5.1 is what the tests expect of all.
                expected[name] = got


def nrrd(expected):
    """VTK has a NRRD reader only: the files are written here, and read by it."""
    values = np.arange(24).reshape(2, 4, 3) * 3 - 7
    vectors = np.stack([values, values + 0.5, -values], -1)
    place = "space: left-posterior-superior\nspace origin: (1,2,3)\n"
    spatial = place + "space directions: (0.5,0,0) (0,0.25,0) (0,0,2)\n"
    spacings = "spacings: 0.5 0.25 2\n"
    files = {
        "short_big": ("short", "endian: big\n" + spatial, values.astype(">i2"), "raw"),
        "double_little": ("double", "endian: little\n" + spatial, values.astype("<f8"), "gzip"),
        "float_text": ("float", spacings, values, "ascii"),
        "int_gzip": ("int32_t", "endian: little\n" + spacings, values.astype("<i4"), "gzip"),
        "vector": ("float", "endian: little\nkinds: vector domain domain domain\n" + place
                   + "space directions: none (0.5,0,0) (0,0.25,0) (0,0,2)\n", vectors.astype("<f4"), "raw"),
        "detached": ("int", "endian: big\n" + spacings + "data file: detached.raw\nbyte skip: 5\n",
                     values.astype(">i4"), "raw"),
    }
    for name, (kind, fields, samples, encoding) in files.items():
        sizes = "3 3 4 2" if name == "vector" else "3 4 2"
        header = (f"NRRD0004\n# a comment\ntype: {kind}\ndimension: {len(sizes.split())}\nsizes: {sizes}\n"
                  f"encoding: {encoding}\nkey:=value\n{fields}\n")
        text = " ".join(str(v) for v in samples.ravel()).encode()
        data = {"raw": samples.tobytes(), "gzip": gzip.compress(samples.tobytes(), mtime=0), "ascii": text}[encoding]
        path = os.path.join(OUT, name + (".nhdr" if name == "detached" else ".nrrd"))
        if name == "detached":
            with open(os.path.join(OUT, "detached.raw"), "wb") as f:
                f.write(b"12345" + data)
            data = b""
        with open(path, "wb") as f:
            f.write(header.encode() + data)
        # VTK 9.7 reads no byte skip and garbles text after an attached header.
        if encoding != "ascii" and name != "detached":
            reader = vtk.vtkNrrdReader()
            reader.SetFileName(path)
            reader.Update()
            got = vtk_to_numpy(reader.GetOutput().GetPointData().GetScalars())
            assert np.array_equal(got.ravel(), samples.ravel()), name
        expected[name] = {"components": 3 if name == "vector" else 1, "values": samples.astype(float).ravel().tolist()}


if __name__ == "__main__":
    os.makedirs(OUT, exist_ok=True)
    for old in os.listdir(OUT):
        os.remove(os.path.join(OUT, old))
    expected = {}
    legacy(expected)
    nrrd(expected)
    with open(os.path.join(OUT, "expected.json"), "w") as f:
        json.dump(expected, f, separators=(",", ":"))
        f.write("\n")
