"""VTK's marching cubes and flying edges on a file of f32 voxels: median CPU time and triangles.

python3 shells_vtk.py FILE NX NY NZ LEVEL RUNS; needs the package vtk (pip install vtk).
"""

import statistics
import sys
import time

import numpy
import vtk
from vtk.util.numpy_support import numpy_to_vtk


def main():
    path, dims, level, runs = sys.argv[1], list(map(int, sys.argv[2:5])), float(sys.argv[5]), int(sys.argv[6])
    image = vtk.vtkImageData()
    image.SetDimensions(dims)
    image.GetPointData().SetScalars(numpy_to_vtk(numpy.fromfile(path, numpy.float32)))
    for way in (vtk.vtkMarchingCubes, vtk.vtkFlyingEdges3D):
        times = []
        for _ in range(runs):
            surface = way()
            surface.SetInputData(image)
            surface.SetValue(0, level)
            surface.ComputeNormalsOff()
            surface.ComputeGradientsOff()
            surface.ComputeScalarsOff()
            begin = time.process_time()
            surface.Update()
            times.append(1e3 * (time.process_time() - begin))
        triangles = surface.GetOutput().GetNumberOfPolys()
        print(f"{way.__name__}: {triangles} triangles, {statistics.median(times):.1f} ms CPU, median of {runs}")


main()
