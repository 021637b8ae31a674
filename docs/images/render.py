#!/usr/bin/python3
"""Renders polygon meshes (OBJ) side by side to a PNG, faces coloured by degree. Needs python3-vtk9, and xvfb where there is no
display:

    xvfb-run -a docs/images/render.py OUT.png MESH.obj [MESH.obj ...] [--view X,Y,Z ...] [--up X,Y,Z ...] [--zoom Z] [--size WxH]

One view and one up direction for each mesh, or one for all. docs/images/make-result makes the picture of the README.
"""
import argparse

import vtk

COLOURS = {3: (250, 205, 150), 4: (205, 222, 245)}  # triangles, quads
OTHER = (190, 225, 180)


def read_obj(path):
    points, faces = vtk.vtkPoints(), []
    with open(path) as file:
        for line in file:
            words = line.split()
            if words[:1] == ["v"]:
                points.InsertNextPoint(*map(float, words[1:4]))
            elif words[:1] == ["f"]:
                faces.append([int(word.split("/")[0]) - 1 for word in words[1:]])
    return points, faces


def actor_of(path):
    points, faces = read_obj(path)
    cells, colours = vtk.vtkCellArray(), vtk.vtkUnsignedCharArray()
    colours.SetNumberOfComponents(3)
    for face in faces:
        cells.InsertNextCell(len(face))
        for corner in face:
            cells.InsertCellPoint(corner)
        colours.InsertNextTuple3(*COLOURS.get(len(face), OTHER))
    data = vtk.vtkPolyData()
    data.SetPoints(points)
    data.SetPolys(cells)
    data.GetCellData().SetScalars(colours)
    mapper = vtk.vtkPolyDataMapper()
    mapper.SetInputData(data)
    actor = vtk.vtkActor()
    actor.SetMapper(mapper)
    look = actor.GetProperty()
    look.SetInterpolationToFlat()
    look.EdgeVisibilityOn()
    look.SetEdgeColor(0.12, 0.14, 0.2)
    look.SetLineWidth(1.1)
    return actor, points.GetBounds()


def render(options):
    window = vtk.vtkRenderWindow()
    window.SetOffScreenRendering(1)
    window.SetMultiSamples(8)
    window.SetSize(*map(int, options.size.split("x")))
    count = len(options.meshes)
    for i, path in enumerate(options.meshes):
        view = list(map(float, options.view[min(i, len(options.view) - 1)].split(",")))
        up = list(map(float, options.up[min(i, len(options.up) - 1)].split(",")))
        actor, bounds = actor_of(path)
        renderer = vtk.vtkRenderer()
        renderer.SetBackground(1, 1, 1)
        renderer.SetViewport(i / count, 0, (i + 1) / count, 1)
        renderer.AddActor(actor)
        window.AddRenderer(renderer)
        centre = [(bounds[2 * k] + bounds[2 * k + 1]) / 2 for k in range(3)]
        camera = renderer.GetActiveCamera()
        camera.SetFocalPoint(*centre)
        camera.SetPosition(*[centre[k] + view[k] for k in range(3)])
        camera.SetViewUp(*up)
        renderer.ResetCamera()
        camera.Zoom(options.zoom)
    window.Render()
    grab = vtk.vtkWindowToImageFilter()
    grab.SetInput(window)
    grab.ReadFrontBufferOff()
    writer = vtk.vtkPNGWriter()
    writer.SetFileName(options.out)
    writer.SetInputConnection(grab.GetOutputPort())
    writer.Write()


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("out")
    parser.add_argument("meshes", nargs="+")
    parser.add_argument("--view", nargs="+", default=["0.4,-1,0.4"])
    parser.add_argument("--up", nargs="+", default=["0,0,1"])
    parser.add_argument("--zoom", type=float, default=1.5)
    parser.add_argument("--size", default="1500x800")
    render(parser.parse_args())
