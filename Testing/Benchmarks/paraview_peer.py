#!/usr/bin/env pvpython
"""paraview_peer.py SCENE.json RESULT.json: draws a scene as ParaView's VTK does, and times it.

SCENE.json, as petrous-bench writes it, names the volume (MetaImage), its pose, the camera, the
transfer function (opacity of 1 mm) and the runs: without shadows, or with volume shadows
(VolumetricScatteringBlending, GlobalIlluminationReach). RESULT.json has for each run the first and
the median frame in s, until the pixels are read back; its picture lies beside it as NAME.ppm.
Needs VTK 9.2 or later, which pvpython of ParaView 5.11 has, and a display.
"""
import json
import pathlib
import statistics
import sys
import time

import vtkmodules.vtkInteractionStyle  # noqa: F401 (object factories)
import vtkmodules.vtkRenderingOpenGL2  # noqa: F401
import vtkmodules.vtkRenderingVolumeOpenGL2  # noqa: F401
from vtkmodules.vtkCommonCore import vtkUnsignedCharArray, vtkVersion
from vtkmodules.vtkCommonDataModel import vtkPiecewiseFunction
from vtkmodules.vtkCommonMath import vtkMatrix4x4
from vtkmodules.vtkIOImage import vtkMetaImageReader
from vtkmodules.vtkRenderingCore import (vtkColorTransferFunction, vtkLight, vtkRenderer,
                                         vtkRenderWindow, vtkVolume, vtkVolumeProperty)
from vtkmodules.vtkRenderingVolume import vtkGPUVolumeRayCastMapper


def volume_of(scene):
    reader = vtkMetaImageReader()
    reader.SetFileName(scene["volume"])
    reader.Update()
    image = reader.GetOutput()
    # The mapper ignores the image's directions: the pose has them.
    image.SetOrigin(0.0, 0.0, 0.0)
    image.SetDirectionMatrix(1, 0, 0, 0, 1, 0, 0, 0, 1)
    mapper = vtkGPUVolumeRayCastMapper()
    mapper.SetInputData(image)
    mapper.SetBlendModeToComposite()
    mapper.SetAutoAdjustSampleDistances(0)
    mapper.SetLockSampleDistanceToInputSpacing(0)
    mapper.SetUseJittering(0)
    mapper.SetSampleDistance(scene["step"])
    mapper.SetImageSampleDistance(1.0)
    color = vtkColorTransferFunction()
    opacity = vtkPiecewiseFunction()
    for value, red, green, blue, alpha in scene["transfer"]:
        color.AddRGBPoint(value, red, green, blue)
        opacity.AddPoint(value, alpha)
    look = vtkVolumeProperty()
    look.SetColor(color)
    look.SetScalarOpacity(opacity)
    look.SetScalarOpacityUnitDistance(1.0)
    look.SetInterpolationTypeToLinear()
    look.ShadeOn()
    look.SetAmbient(scene["light"]["ambient"])
    look.SetDiffuse(1.0 - scene["light"]["ambient"])
    look.SetSpecular(scene["light"]["specular"])
    look.SetSpecularPower(scene["light"]["shininess"])
    volume = vtkVolume()
    volume.SetMapper(mapper)
    volume.SetProperty(look)
    pose = vtkMatrix4x4()
    pose.DeepCopy(scene["pose"])
    volume.SetUserMatrix(pose)
    return volume, mapper


def window_of(scene, volume):
    renderer = vtkRenderer()
    renderer.SetBackground(scene["background"])
    renderer.AutomaticLightCreationOff()
    lamp = vtkLight()
    lamp.SetLightTypeToCameraLight()
    lamp.SetPosition(scene["light"]["lamp"])  # the camera is at (0, 0, 1)
    lamp.SetFocalPoint(0.0, 0.0, 0.0)
    renderer.AddLight(lamp)
    renderer.AddViewProp(volume)
    window = vtkRenderWindow()
    window.SetOffScreenRendering(1)
    window.SetMultiSamples(0)
    window.SetSize(scene["picture"])
    window.AddRenderer(renderer)
    camera = renderer.GetActiveCamera()
    camera.SetFocalPoint(scene["camera"]["focal_point"])
    camera.SetPosition(scene["camera"]["position"])
    camera.SetViewUp(scene["camera"]["view_up"])
    camera.SetViewAngle(scene["camera"]["view_angle"])
    renderer.ResetCameraClippingRange()
    return window


def frame(window, size, pixels):
    start = time.perf_counter()
    window.Render()
    window.GetPixelData(0, 0, size[0] - 1, size[1] - 1, 0, pixels, 0)
    return time.perf_counter() - start


def write_ppm(file, size, pixels):
    rows = bytes(memoryview(pixels))
    width = 3 * size[0]
    with open(file, "wb") as out:
        out.write(b"P6\n%d %d\n255\n" % tuple(size))
        for row in reversed(range(size[1])):  # the window's first row is the lowest
            out.write(rows[row * width:(row + 1) * width])


def main():
    scene = json.loads(pathlib.Path(sys.argv[1]).read_text())
    result = pathlib.Path(sys.argv[2])
    volume, mapper = volume_of(scene)
    window = window_of(scene, volume)
    size = scene["picture"]
    pixels = vtkUnsignedCharArray()
    runs = []
    for run in scene["runs"]:
        mapper.SetVolumetricScatteringBlending(run["blending"])
        mapper.SetGlobalIlluminationReach(run["reach"])
        first = frame(window, size, pixels)
        times = []
        while len(times) < scene["frames"] and sum(times) < scene["seconds"]:
            times.append(frame(window, size, pixels))
        picture = result.with_name(run["name"] + ".ppm")
        write_ppm(picture, size, pixels)
        runs.append({"name": run["name"], "first": first,
                     "median": statistics.median(times or [first]), "frames": len(times),
                     "picture": str(picture)})
    gl = [line.split(":", 1)[1].strip() for line in window.ReportCapabilities().splitlines()
          if line.startswith("OpenGL renderer string:")]
    result.write_text(json.dumps({"vtk": vtkVersion().GetVTKVersion(),
                                  "gl_renderer": gl[0] if gl else "unknown", "runs": runs}))


if __name__ == "__main__":
    main()
