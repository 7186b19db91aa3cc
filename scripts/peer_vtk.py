#!/usr/bin/env python3
"""Measures VTK's volume mappers on what `tetralux bench ... --for-peers FOLDER` wrote (pip install vtk==9.7.2 numpy).

usage: scripts/peer_vtk.py FOLDER [--output FILE.jsonl] [--mappers pt,bunyk,bunyk-linear,resample] [--repeat 5]

Appends one record (src/report/record.rs) a subject and mapper. What is there already is not measured again.

Times are of VTK's usual window: 8 bits a channel, nothing read back. The picture that is compared is then drawn once
more into a window of 32-bit floats: linear premultiplied RGBA over transparent black, all four channels, as
src/image/compare.rs has it. Where such a window cannot be had, the 8-bit RGBA is compared and the device says so.
What is VTK's own stays in its error: Bunyk and ZSweep cut their pictures to 8 bits before they draw them, PT rounds the
vertices' colours and extinctions to 8 bits, and Bunyk's rays go through the pixels' lower left corners.
"""
from __future__ import annotations

import argparse
import json
import math
import multiprocessing
import os
import platform
import resource
import sys
import time
from multiprocessing.connection import Connection
from pathlib import Path
from typing import Any, Callable, NamedTuple

try:
    import numpy as np
    import vtk
    from vtk.util.numpy_support import vtk_to_numpy
except ImportError as error:
    sys.exit(f"peer_vtk.py: {error} (pip install vtk==9.7.2 numpy)")

VERSION = vtk.vtkVersion.GetVTKVersion()
# Pieces for a row of a function whose opacity on images is curved between rows: their error is below 3e-5.
PIECES = 64
# By how much the float picture may differ from the window's: what rounding and blending of 8 bits may do.
SAME_PICTURE = 2.0 / 255.0
# How many budgets a measurement may take in all before it is given up: VTK's software mappers may never end.
BUDGETS = 5

Json = dict[str, Any]
# A mesh, and how many samples along each axis where it is resampled.
Make = Callable[[vtk.vtkUnstructuredGrid, int], vtk.vtkVolumeMapper]


class VtkFailed(Exception):
    """VTK cannot draw this, and would fail again: a result, too."""


# ---- What the mappers are. ----


def on_grid(mapper_class: Any, integrator_class: Any = None) -> Make:
    """A mapper for grids with VTK's own settings, but that software mappers may not draw coarser to be quicker."""

    def make(grid: vtk.vtkUnstructuredGrid, _dims: int) -> vtk.vtkVolumeMapper:
        mapper = mapper_class()
        mapper.SetInputData(grid)
        if hasattr(mapper, "SetImageSampleDistance"):
            mapper.AutoAdjustSampleDistancesOff()
            mapper.SetImageSampleDistance(1.0)
        if integrator_class:
            mapper.SetRayIntegrator(integrator_class())
        return mapper

    return make


def resampled(grid: vtk.vtkUnstructuredGrid, dims: int) -> vtk.vtkVolumeMapper:
    """Samples on a lattice over the bounding box, and the mapper for images."""
    resample = vtk.vtkResampleToImage()
    resample.SetInputDataObject(grid)
    resample.SetSamplingDimensions(dims, dims, dims)
    resample.Update()
    image = resample.GetOutput()
    array = image.GetPointData().GetArray(grid.GetPointData().GetScalars().GetName())
    # Points outside are marked as ghosts, and the mapper leaves out every voxel that has one; but their zeros would
    # stretch the range over which it tabulates the function.
    values, inside = vtk_to_numpy(array), vtk_to_numpy(image.GetPointData().GetArray("vtkValidPointMask")) > 0
    if inside.any():
        values[~inside] = values[inside].min()
        array.Modified()
    image.GetPointData().SetActiveScalars(array.GetName())
    mapper = vtk.vtkOpenGLGPUVolumeRayCastMapper()
    mapper.SetInputData(image)
    mapper.AutoAdjustSampleDistancesOff()
    mapper.SetImageSampleDistance(1.0)
    mapper.SetSampleDistance(0.5 * min(image.GetSpacing()))
    mapper.UseJitteringOff()
    return mapper


class Kind(NamedTuple):
    """A way to draw, in the words of a record."""

    make: Make
    method: str
    integral: str
    order: str
    on_adapter: bool
    on_image: bool = False


PT = on_grid(vtk.vtkOpenGLProjectedTetrahedraMapper)
BUNYK = on_grid(vtk.vtkUnstructuredGridVolumeRayCastMapper)
BUNYK_LINEAR = on_grid(vtk.vtkUnstructuredGridVolumeRayCastMapper, vtk.vtkUnstructuredGridLinearRayIntegrator)
# May take a minute a frame, and never ends for an eye within the mesh.
ZSWEEP = on_grid(vtk.vtkUnstructuredGridVolumeZSweepMapper)
KINDS = {
    "pt": Kind(PT, "PT", "mean of ends", "centroid", on_adapter=True),
    # Pre-integration is what VTK takes for point data: the pictures are equal to the bit where it is asked for.
    "bunyk": Kind(BUNYK, "Bunyk", "pre-integrated", "along rays", on_adapter=False),
    "bunyk-linear": Kind(BUNYK_LINEAR, "Bunyk", "linear", "along rays", on_adapter=False),
    "resample": Kind(resampled, "resampled {0}^3 + GPU mapper", "half-voxel samples", "along rays", True, True),
    "zsweep": Kind(ZSWEEP, "ZSweep", "pre-integrated", "along rays", on_adapter=False),
}


# ---- A subject in VTK's terms. ----


def read_mesh(path: Path, array: str, tetrahedra: int) -> vtk.vtkUnstructuredGrid:
    """The mesh, with the scalar active."""
    if not path.is_file():
        raise ValueError(f"{path}: no such mesh")
    reader = vtk.vtkXMLUnstructuredGridReader()
    reader.SetFileName(str(path))
    reader.Update()
    grid = reader.GetOutput()
    if grid.GetNumberOfCells() != tetrahedra:
        raise ValueError(f"{path}: {grid.GetNumberOfCells()} cells instead of {tetrahedra}")
    if grid.GetPointData().SetActiveScalars(array) < 0:
        raise ValueError(f"{path}: no point array {array}")
    return grid


def appearance(points: list[list[float]], on_image: bool) -> vtk.vtkVolumeProperty:
    """The transfer function, over a unit length in which the largest extinction becomes the opacity 1.

    On grids an opacity is the extinction of a unit length (which PT keeps in 8 bits, from 0 to 1); on images it is the
    share of the light that a unit length takes.
    """
    largest = max(row[4] for row in points)
    unit = 1.0 / largest if largest > 0.0 else 1.0
    color, opacity = vtk.vtkColorTransferFunction(), vtk.vtkPiecewiseFunction()
    for scalar, red, green, blue, _ in points:
        color.AddRGBPoint(scalar, red, green, blue)
    rows = [(row[0], row[4] * unit) for row in points]
    if on_image:
        rows = [(scalar, -math.expm1(-depth)) for scalar, depth in finely(rows)]
    for scalar, value in rows:
        opacity.AddPoint(scalar, value)
    look = vtk.vtkVolumeProperty()
    look.SetColor(color)
    look.SetScalarOpacity(opacity)
    look.SetScalarOpacityUnitDistance(unit)
    look.SetInterpolationTypeToLinear()
    look.ShadeOff()
    return look


def finely(rows: list[tuple[float, float]]) -> list[tuple[float, float]]:
    """The same function in smaller pieces."""
    shares = [i / PIECES for i in range(PIECES)]
    pieces = zip(rows, rows[1:])
    fine = [(x0 + (x1 - x0) * t, y0 + (y1 - y0) * t) for (x0, y0), (x1, y1) in pieces for t in shares]
    return fine + rows[-1:]


def place_camera(camera: vtk.vtkCamera, at: Json, bounds: tuple[float, ...]) -> None:
    """The camera, its clipping planes close around the mesh: PT takes depths from the clipping space, in 32 bits.

    Where the near plane cuts the mesh, PT leaves out every cell that it cuts.
    """
    eye, target = np.array(at["eye"]), np.array(at["target"])
    forward = (target - eye) / np.linalg.norm(target - eye)
    corners = np.array([[bounds[i], bounds[2 + j], bounds[4 + k]] for i in (0, 1) for j in (0, 1) for k in (0, 1)])
    depths = (corners - eye) @ forward
    margin = 0.01 * np.ptp(depths)
    near, far = max(at["near"], depths.min() - margin), depths.max() + margin
    if at["fov_y"] is None:
        # VTK asks for positive depths, and parallel rays may start anywhere.
        back = max(0.0, margin - near)
        eye, near, far = eye - back * forward, near + back, far + back
        camera.ParallelProjectionOn()
        camera.SetParallelScale(0.5 * at["height"])
    else:
        near = max(near, 1e-6 * abs(far))
        camera.SetViewAngle(at["fov_y"])
    camera.SetPosition(*eye)
    camera.SetFocalPoint(*(eye + forward))
    camera.SetViewUp(*at["up"])
    camera.SetClippingRange(near, max(far, near + margin))


def window_of(size: list[int]) -> tuple[vtk.vtkRenderWindow, vtk.vtkRenderer]:
    """An empty picture: transparent black."""
    renderer, window = vtk.vtkRenderer(), vtk.vtkRenderWindow()
    renderer.SetBackground(0.0, 0.0, 0.0)
    window.SetMultiSamples(0)
    window.SetAlphaBitPlanes(1)
    window.OffScreenRenderingOn()
    window.SetSize(*size)
    window.AddRenderer(renderer)
    return window, renderer


def use_floats(window: vtk.vtkRenderWindow) -> None:
    """Replaces the 8-bit colours of a window that has drawn by 32-bit floats."""
    width, height = window.GetSize()
    for buffer in (window.GetRenderFramebuffer(), window.GetDisplayFramebuffer()):
        # One colour, and depths as VTK's own: the mapper for images copies them, and draws nothing where it cannot.
        buffer.PopulateFramebuffer(width, height, True, 1, vtk.VTK_FLOAT, True, 32, 0, False)


def render(window: vtk.vtkRenderWindow) -> None:
    """A frame, finished."""
    window.Render()
    window.WaitForCompletion()


def pixels_of(window: vtk.vtkRenderWindow) -> np.ndarray:
    """RGBA, row 0 the top."""
    width, height = window.GetSize()
    data = vtk.vtkFloatArray()
    window.GetRGBAPixelData(0, 0, width - 1, height - 1, 0, data)
    return vtk_to_numpy(data).reshape(height, width, 4)[::-1].copy()


# ---- What is measured, each in a process of its own: its peak memory is its own, and VTK may die. ----


class Here(NamedTuple):
    """What VTK draws with."""

    device: str
    adapter: str
    floats: bool


def collect_messages() -> vtk.vtkStringOutputWindow:
    """Keeps VTK's warnings and errors from stderr."""
    messages = vtk.vtkStringOutputWindow()
    vtk.vtkOutputWindow.SetInstance(messages)
    vtk.vtkLogger.SetStderrVerbosity(vtk.vtkLogger.VERBOSITY_OFF)
    return messages


def look_around() -> Here:
    """Opens a window, asks for its adapter and tries whether it holds floats."""
    messages = collect_messages()
    window, renderer = window_of([64, 64])
    grey = 0.3
    renderer.SetBackground(grey, grey, grey)
    render(window)
    told = dict(line.split(":", 1) for line in window.ReportCapabilities().splitlines() if ":" in line)
    name, version = (told.get(f"OpenGL {what} string", "").strip() for what in ("renderer", "version"))
    if not name:
        raise RuntimeError(f"VTK opens no window: {messages.GetOutput().strip()}")
    use_floats(window)
    render(window)
    floats = bool(np.abs(pixels_of(window)[..., :3] - grey).max() < 1e-4)
    # Charts have room for a name; the machine's adapter is told in full.
    device = name.split(" (")[0] + ("" if floats else ", 8-bit picture")
    return Here(device, f"{name}, OpenGL {version}", floats)


def measure(folder: Path, exported: Json, key: str, options: argparse.Namespace, floats: bool) -> Json:
    """A record's result.

    Raises VtkFailed where VTK does not draw, OSError or ValueError where the folder does not hold what it says.
    """
    messages = collect_messages()
    kind, subject = KINDS[key], exported["subject"]
    truth = read_truth(folder / exported["truth"], subject["size"])
    grid = read_mesh(folder / exported["mesh"], exported["array"], subject["tetrahedra"])
    start = time.perf_counter()
    volume = vtk.vtkVolume()
    volume.SetMapper(kind.make(grid, options.dims))
    volume.SetProperty(appearance(exported["points"], kind.on_image))
    window, renderer = window_of(subject["size"])
    renderer.AddVolume(volume)
    camera = renderer.GetActiveCamera()
    place_camera(camera, exported["camera"], grid.GetBounds())
    render(window)
    prepare = time.perf_counter() - start
    times, cpu = time_frames(window, camera, options.repeat, options.budget - prepare)
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * 1024
    picture = picture_of(window, floats)
    if "ERROR:" in messages.GetOutput():
        raise VtkFailed(f"VTK: {messages.GetOutput().split('ERROR:', 1)[1].strip()}")
    background = np.array(exported["background"], dtype=np.float32)
    error = error_of(picture + (1 - picture[..., 3:]) * background, truth)
    spread = {"median": float(np.median(times)), "min": min(times), "max": max(times), "frames": len(times)}
    result = {"frame_seconds": spread, "cpu_seconds": cpu, "prepare_seconds": prepare, "peak_bytes": peak}
    return {**result, "error": error}


def time_frames(
    window: vtk.vtkRenderWindow, camera: vtk.vtkCamera, repeat: int, budget: float
) -> tuple[list[float], float]:
    """Wall seconds of each frame, one at least; seconds of all threads a frame."""
    times: list[float] = []
    cpu = time.process_time()
    while not times or (len(times) < repeat and sum(times) < budget):
        # As if it had been turned: nothing that depends on the view is kept.
        camera.Modified()
        start = time.perf_counter()
        render(window)
        times.append(time.perf_counter() - start)
    return times, (time.process_time() - cpu) / len(times)


def picture_of(window: vtk.vtkRenderWindow, floats: bool) -> np.ndarray:
    """What the window shows, as exactly as it can be had."""
    shown = pixels_of(window)
    if not floats:
        return shown
    use_floats(window)
    render(window)
    exact = pixels_of(window)
    # What floats show is no measure of VTK where its users see something else.
    if np.abs(exact.clip(0.0, 1.0) - shown).max() > SAME_PICTURE:
        raise VtkFailed("VTK's picture in floats is not the one in its window")
    return exact


def read_truth(path: Path, size: list[int]) -> np.ndarray:
    """The reference picture, RGBA."""
    values = np.fromfile(path, dtype="<f4")
    if values.size != 4 * size[0] * size[1] or not np.isfinite(values).all():
        raise ValueError(f"{path}: {values.size} floats are no finite RGBA picture of {size[0]} x {size[1]} pixels")
    return values.reshape(size[1], size[0], 4)


def error_of(picture: np.ndarray, truth: np.ndarray) -> Json:
    """As src/image/compare.rs: a pixel's error is that of its worst channel."""
    difference = np.abs(picture.astype(np.float64) - truth.astype(np.float64))
    if not np.isfinite(difference).all():
        raise VtkFailed("the picture holds what is not finite")
    errors = difference.max(axis=2).ravel()
    # The smallest value that at most a thousandth of the pixels exceed.
    rank = errors.size - 1 - errors.size // 1000
    rmse = math.sqrt((difference**2).mean())
    return {
        "max": float(errors.max()),
        "rmse": rmse,
        **({"psnr": -20.0 * math.log10(rmse)} if rmse > 0.0 else {}),
        "percentile_99_9": float(np.partition(errors, rank)[rank]),
        "above_8_bit": float((errors > 1.0 / 255.0).mean()),
    }


# ---- Records. ----


def alone(limit: float, work: Callable[..., Any], *arguments: Any) -> Any:
    """The same in a new process; VtkFailed where that dies, or is not done after `limit` seconds."""
    context = multiprocessing.get_context("spawn")
    ours, theirs = context.Pipe(duplex=False)
    process = context.Process(target=answer, args=(theirs, work, arguments))
    process.start()
    # The pipe ends with the process.
    theirs.close()
    try:
        if not ours.poll(limit):
            raise VtkFailed(f"VTK is not done after {limit:.0f} s")
        done, value = ours.recv()
    except EOFError:
        process.join()
        raise VtkFailed(f"VTK died, exit code {process.exitcode}") from None
    finally:
        process.kill()
        process.join()
    if not done:
        raise value
    return value


def answer(pipe: Connection, work: Callable[..., Any], arguments: tuple[Any, ...]) -> None:
    """What the new process does."""
    try:
        pipe.send((True, work(*arguments)))
    except Exception as error:  # Whatever it is, it is told where it was asked.
        pipe.send((False, error))


def contender(kind: Kind, here: Here, dims: int) -> Json:
    """A record's `by`."""
    device = here.device if kind.on_adapter else "CPU" + ("" if here.floats else ", 8-bit picture")
    method = kind.method.format(dims)
    words = {"device": device, "method": method, "integral": kind.integral, "order": kind.order}
    return {"program": f"VTK {VERSION}", **words}


def this_machine(adapter: str) -> Json:
    """In the words of `tetralux bench`, which has them from sysinfo."""
    processor = [line for line in Path("/proc/cpuinfo").read_text().splitlines() if line.startswith("model name")]
    release = platform.freedesktop_os_release()
    memory = Path("/proc/meminfo").read_text().split("MemTotal:", 1)[1].split()[0]
    return {
        "processor": processor[0].split(":", 1)[1].strip() if processor else platform.machine(),
        "threads": len(os.sched_getaffinity(0)),
        "memory_bytes": int(memory) * 1024,
        "system": f"{platform.system()} ({release['NAME']} {release.get('VERSION_ID', '')})".replace(" )", ")"),
        "adapter": adapter,
        "commit": VERSION,
    }


def key_of(subject: Json, by: Json) -> tuple[str, ...]:
    """Equal where the same was drawn by the same."""
    return (subject["hash"], *(by[name] for name in ("program", "device", "method", "integral", "order")))


def read_keys(path: Path) -> set[tuple[str, ...]]:
    """Of the records in a file, which need not exist."""
    keys = set()
    for number, line in enumerate(path.read_text().splitlines() if path.exists() else [], 1):
        try:
            if line.strip():
                record = json.loads(line)
                keys.add(key_of(record["subject"], record["by"]))
        except (ValueError, KeyError, TypeError) as error:
            raise ValueError(f"{path}: line {number}: no record of a run: {error!r}") from None
    return keys


def record_of(folder: Path, exported: Json, key: str, options: argparse.Namespace, by: Json, here: Here) -> Json:
    """Measured, or refused."""
    record = {"subject": exported["subject"], "by": by, "machine": this_machine(here.adapter), "result": None}
    if exported["points"] is None:
        return {**record, "refused": "VTK's unstructured mappers ignore 2D functions"}
    try:
        limit = BUDGETS * options.budget
        return {**record, "result": alone(limit, measure, folder, exported, key, options, here.floats)}
    except VtkFailed as error:
        return {**record, "refused": str(error)}


def summary(record: Json) -> str:
    """For the progress."""
    if record["result"] is None:
        return f"refused: {record['refused']}"
    seconds, error = record["result"]["frame_seconds"], record["result"]["error"]
    return f"{seconds['median']:.3f} s x {seconds['frames']}, {error.get('psnr', math.inf):.2f} dB"


def subjects_in(folder: Path) -> list[tuple[Path, Json]]:
    """Folders and what they hold, the smallest first."""
    found = [(path.parent, json.loads(path.read_text())) for path in folder.glob("*/subject.json")]
    for own, exported in found:
        if missing := {"subject", "mesh", "array", "camera", "points", "background", "truth"} - exported.keys():
            raise ValueError(f"{own / 'subject.json'}: lacks {', '.join(sorted(missing))}")
    order = ("tetrahedra", "mesh", "scene", "view", "size", "hash")
    return sorted(found, key=lambda entry: [entry[1]["subject"][name] for name in order])


def run(options: argparse.Namespace, subjects: list[tuple[Path, Json]]) -> int:
    """Measures everything that is not there; how much failed."""
    done, here, failed = read_keys(options.output), alone(60.0, look_around), 0
    todo = [(folder, exported, key) for folder, exported in subjects for key in options.mappers]
    with options.output.open("a") as file:
        for number, (folder, exported, key) in enumerate(todo, 1):
            subject, by = exported["subject"], contender(KINDS[key], here, options.dims)
            if key_of(subject, by) in done:
                continue
            name = "{mesh} {scene} {view} {size[0]}x{size[1]}".format(**subject)
            try:
                record = record_of(folder, exported, key, options, by, here)
                file.write(json.dumps(record) + "\n")
                file.flush()
                outcome = summary(record)
            except (OSError, ValueError, RuntimeError) as error:
                failed, outcome = failed + 1, f"failed: {error}"
            print(f"[{number}/{len(todo)}] {name}, {by['method']} {by['integral']}: {outcome}", file=sys.stderr)
    return failed


def parse(arguments: list[str]) -> tuple[argparse.Namespace, list[tuple[Path, Json]]]:
    """What is asked, and the subjects; ends with 2 where that cannot be."""
    parser = argparse.ArgumentParser(description="Measures VTK's volume mappers on the subjects of `tetralux bench`.")
    parser.add_argument("folder", type=Path, help="what `tetralux bench ... --for-peers FOLDER` wrote")
    parser.add_argument("--output", type=Path, help="lines of JSON, appended to (FOLDER/vtk.jsonl)")
    usual = "pt,bunyk,bunyk-linear,resample"
    parser.add_argument("--mappers", default=usual, help=f"some of {', '.join(KINDS)} (%(default)s)")
    parser.add_argument("--repeat", type=int, default=5, help="frames to time after the first (%(default)s)")
    budget = f"seconds after which no frame starts (%(default)s); what takes {BUDGETS} times as long is refused"
    parser.add_argument("--budget", type=float, default=120.0, help=budget)
    parser.add_argument("--dims", type=int, default=256, help="samples along each axis for `resample` (%(default)s)")
    options = parser.parse_args(arguments)
    options.mappers = list(dict.fromkeys(options.mappers.split(",")))
    options.output = options.output or options.folder / "vtk.jsonl"
    if unknown := [name for name in options.mappers if name not in KINDS]:
        parser.error(f"no such mapper: {', '.join(unknown)} (of {', '.join(KINDS)})")
    if options.repeat < 1 or options.budget <= 0.0 or options.dims < 2:
        parser.error("--repeat starts at 1, --dims at 2, and --budget is positive")
    try:
        subjects = subjects_in(options.folder)
    except (ValueError, KeyError, TypeError) as error:
        parser.error(f"{options.folder}: not what `tetralux bench` wrote: {error!r}")
    if not subjects:
        parser.error(f"{options.folder}: holds no subjects (*/subject.json)")
    return options, subjects


def main(arguments: list[str]) -> int:
    """The exit code."""
    options, subjects = parse(arguments)
    # Without a display VTK draws off screen by itself (EGL, or OSMesa).
    os.environ.pop("DISPLAY", None)
    try:
        failed = run(options, subjects)
    except (OSError, ValueError, RuntimeError, VtkFailed) as error:
        print(f"peer_vtk.py: {error}", file=sys.stderr)
        return 1
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
