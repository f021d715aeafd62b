"""Times how long VTK takes for a picture of a mesh of tetrahedra, by rays [Bunyk et al. 1997] and by projected tetrahedra.

    tetrahedra_vtk.py POINTS CELLS SIZE UNIT RUNS OUT

POINTS holds f32 x, y, z and value of each vertex, CELLS i64 corners of each cell, as bare bytes. Prints a line a way: its name and the median
CPU time of the process in milliseconds; writes OUT-WAY.npy, the picture.
"""

import sys
import time

import numpy as np
import vtk
from vtk.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray, vtk_to_numpy

points_file, cells_file, size, unit, runs, out = sys.argv[1:7]
size, unit, runs = int(size), float(unit), int(runs)

rows = np.fromfile(points_file, dtype="<f4").reshape(-1, 4)
corners = np.fromfile(cells_file, dtype="<i8").reshape(-1, 4)

points = vtk.vtkPoints()
points.SetData(numpy_to_vtk(np.ascontiguousarray(rows[:, :3]), deep=True))
values = numpy_to_vtk(np.ascontiguousarray(rows[:, 3]), deep=True)
values.SetName("value")
cells = vtk.vtkCellArray()
listed = np.hstack([np.full((len(corners), 1), 4, dtype=np.int64), corners]).ravel()
cells.SetCells(len(corners), numpy_to_vtkIdTypeArray(listed, deep=True))
grid = vtk.vtkUnstructuredGrid()
grid.SetPoints(points)
grid.SetCells(vtk.VTK_TETRA, cells)
grid.GetPointData().SetScalars(values)

opacity = vtk.vtkPiecewiseFunction()
opacity.AddPoint(0.0, 0.0)
opacity.AddPoint(1.0, 0.1)
color = vtk.vtkColorTransferFunction()
color.AddRGBPoint(0.0, 0.2, 0.4, 1.0)
color.AddRGBPoint(1.0, 1.0, 0.5, 0.1)
look = vtk.vtkVolumeProperty()
look.SetScalarOpacity(opacity)
look.SetColor(color)
look.SetScalarOpacityUnitDistance(unit)
look.SetInterpolationTypeToLinear()
look.ShadeOff()

camera = vtk.vtkCamera()
camera.SetPosition(0.8974, 0.6533, 1.5544)
camera.SetFocalPoint(0, 0, 0)
camera.SetViewUp(0, 1, 0)
camera.SetViewAngle(45)
camera.SetClippingRange(0.5, 4.0)


def timed(name, mapper):
    volume = vtk.vtkVolume()
    volume.SetMapper(mapper)
    volume.SetProperty(look)
    renderer = vtk.vtkRenderer()
    renderer.SetBackground(0, 0, 0)
    renderer.AddVolume(volume)
    renderer.SetActiveCamera(camera)
    window = vtk.vtkRenderWindow()
    window.SetOffScreenRendering(1)
    window.SetMultiSamples(0)
    window.SetSize(size, size)
    window.AddRenderer(renderer)
    times = []
    for run in range(runs + 1):
        # A mapper that has seen the view keeps its picture.
        camera.Modified()
        volume.Modified()
        begin = time.process_time()
        window.Render()
        window.WaitForCompletion()
        # The first one builds what stays.
        if run > 0:
            times.append(1e3 * (time.process_time() - begin))
    pixels = vtk.vtkUnsignedCharArray()
    window.GetPixelData(0, 0, size - 1, size - 1, 0, pixels, 0)
    np.save(f"{out}-{name}.npy", np.flipud(vtk_to_numpy(pixels).reshape(size, size, 3)))
    print(f"{name} {sorted(times)[len(times) // 2]:.1f}")


def rays():
    mapper = vtk.vtkUnstructuredGridVolumeRayCastMapper()
    mapper.SetInputData(grid)
    mapper.SetRayCastFunction(vtk.vtkUnstructuredGridBunykRayCastFunction())
    mapper.SetRayIntegrator(vtk.vtkUnstructuredGridLinearRayIntegrator())
    mapper.AutoAdjustSampleDistancesOff()
    mapper.SetImageSampleDistance(1.0)
    return mapper


def projected():
    mapper = vtk.vtkProjectedTetrahedraMapper()
    mapper.SetInputData(grid)
    return mapper


for name, make in [("bunyk", rays), ("projected", projected)]:
    timed(name, make())
