"""Times how long VTK and vispy take for a picture of a volume.

    peers.py SCENE.json PEER

PEER is vtk-fixed, VTK's fixed-point ray caster, vtk-gpu, its ray caster by OpenGL, or vispy; packages vtk and vispy of PyPI. SCENE has `file`
(bytes of u8 voxels, x fastest), `dims`, `voxel` (sides of a voxel in volume space, whose middle is the volume's), `points` (x from 0 to 255,
red, green, blue, opacity for `unit`), `size`, `eye`, `target`, `up`, `fov`, `unit` and `step` (volume space), `runs` and `out`. Prints the median
CPU time of the process in milliseconds, the least and the greatest, and writes OUT, an NPY of the picture, 8 bits of red, green and blue.
"""

import json
import os
import sys
import time

import numpy as np

with open(sys.argv[1]) as file:
    scene = json.load(file)
dims, voxel, size = scene["dims"], np.array(scene["voxel"]), scene["size"]
voxels = np.fromfile(scene["file"], dtype=np.uint8).reshape(dims[::-1])


def timed(draw):
    """The CPU times of frames behind the first two, which build what stays."""
    times = []
    for run in range(scene["runs"] + 2):
        begin = time.process_time()
        draw()
        if run > 1:
            times.append(1e3 * (time.process_time() - begin))
    return sorted(times)


def vtk_peer(make):
    import vtk
    from vtk.util.numpy_support import numpy_to_vtk, vtk_to_numpy

    image = vtk.vtkImageData()
    image.SetDimensions(dims)
    image.SetSpacing(voxel)
    image.SetOrigin([-0.5 * (n - 1) * side for n, side in zip(dims, voxel)])
    image.GetPointData().SetScalars(numpy_to_vtk(voxels.ravel(), deep=True))
    opacity, color = vtk.vtkPiecewiseFunction(), vtk.vtkColorTransferFunction()
    before = None
    for x, red, green, blue, alpha in scene["points"]:
        # Of two points in one place VTK keeps the last.
        place = x if before is None or x > before else x + 1e-3
        opacity.AddPoint(place, alpha)
        color.AddRGBPoint(place, red, green, blue)
        before = x
    look = vtk.vtkVolumeProperty()
    look.SetScalarOpacity(opacity)
    look.SetColor(color)
    look.SetScalarOpacityUnitDistance(scene["unit"])
    look.SetInterpolationTypeToLinear()
    look.ShadeOff()
    mapper = make(vtk)
    mapper.SetInputData(image)
    mapper.SetBlendModeToComposite()
    mapper.SetAutoAdjustSampleDistances(0)
    mapper.SetSampleDistance(scene["step"])
    volume = vtk.vtkVolume()
    volume.SetMapper(mapper)
    volume.SetProperty(look)
    camera = vtk.vtkCamera()
    camera.SetPosition(scene["eye"])
    camera.SetFocalPoint(scene["target"])
    camera.SetViewUp(scene["up"])
    camera.SetViewAngle(scene["fov"])
    renderer = vtk.vtkRenderer()
    renderer.SetBackground(0, 0, 0)
    renderer.AddVolume(volume)
    renderer.SetActiveCamera(camera)
    renderer.ResetCameraClippingRange()
    window = vtk.vtkRenderWindow()
    window.SetOffScreenRendering(1)
    window.SetMultiSamples(0)
    window.SetSize(size, size)
    window.AddRenderer(renderer)

    def draw():
        # A mapper that has seen the view keeps its picture.
        camera.Modified()
        volume.Modified()
        window.Render()
        window.WaitForCompletion()

    times = timed(draw)
    pixels = vtk.vtkUnsignedCharArray()
    window.GetPixelData(0, 0, size - 1, size - 1, 0, pixels, 0)
    return times, np.flipud(vtk_to_numpy(pixels).reshape(size, size, 3))


def fixed_point(vtk):
    mapper = vtk.vtkFixedPointVolumeRayCastMapper()
    mapper.SetImageSampleDistance(1.0)
    mapper.SetNumberOfThreads(os.cpu_count())
    return mapper


def by_gpu(vtk):
    mapper = vtk.vtkGPUVolumeRayCastMapper()
    mapper.SetUseJittering(0)
    mapper.SetImageSampleDistance(1.0)
    return mapper


def matrix_of_view(near, far):
    """From volume space to pixels, of rows."""
    eye, target, up = (np.array(scene[name], float) for name in ("eye", "target", "up"))
    forward = (target - eye) / np.linalg.norm(target - eye)
    right = np.cross(forward, up)
    right /= np.linalg.norm(right)
    above = np.cross(right, forward)
    view = np.identity(4)
    view[:3, :3] = np.stack([right, above, -forward], axis=1)
    view[3, :3] = -eye @ view[:3, :3]
    slope = 1.0 / np.tan(np.radians(scene["fov"]) / 2.0)
    project = np.zeros((4, 4))
    project[0, 0] = project[1, 1] = slope
    project[2, 2], project[3, 2] = -(far + near) / (far - near), -2.0 * far * near / (far - near)
    project[2, 3] = -1.0
    to_pixels = np.diag([size / 2.0, -size / 2.0, 1.0, 1.0])
    to_pixels[3, :2] = size / 2.0
    return view @ project @ to_pixels


def vispy_peer():
    os.environ.setdefault("EGL_PLATFORM", "surfaceless")
    import vispy

    vispy.use(app="egl")
    from vispy import scene as scenes
    from vispy.color import Colormap
    from vispy.visuals.transforms import MatrixTransform

    canvas = scenes.SceneCanvas(size=(size, size), bgcolor="black", show=True)
    view = canvas.central_widget.add_view()
    xs = np.array([point[0] for point in scene["points"]]) / 255.0
    # Controls rise from 0 to 1.
    xs = np.maximum.accumulate(xs + 1e-6 * np.arange(len(xs)))
    rows = np.array([point[1:] for point in scene["points"]])
    grid = np.unique(np.concatenate([[0.0], xs, [1.0]]).clip(0.0, 1.0))
    colors = np.stack([np.interp(grid, xs, rows[:, i]) for i in range(4)], axis=1)
    volume = scenes.visuals.Volume(
        voxels,
        clim=(0, 255),
        cmap=Colormap(colors, controls=grid),
        method="translucent",
        interpolation="linear",
        relative_step_size=scene["step"] / min(voxel),
        parent=view.scene,
    )
    place = np.diag([*voxel, 1.0])
    place[3, :3] = [(0.5 - 0.5 * n) * side for n, side in zip(dims, voxel)]
    view.camera.interactive = False
    view.scene.transform = MatrixTransform(place @ matrix_of_view(0.1, 10.0))

    picture = None

    def draw():
        nonlocal picture
        picture = canvas.render(alpha=False)

    times = timed(draw)
    return times, picture[:, :, :3]


peer = {"vtk-fixed": lambda: vtk_peer(fixed_point), "vtk-gpu": lambda: vtk_peer(by_gpu), "vispy": vispy_peer}
times, picture = peer[sys.argv[2]]()
np.save(scene["out"], np.ascontiguousarray(picture))
print(f"{times[len(times) // 2]:.1f} {times[0]:.1f} {times[-1]:.1f}")
