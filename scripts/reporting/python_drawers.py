"""Python packages that draw the ids and depths of the triangles that a camera sees, each in a process of its own. A drawer's load()
takes a mesh, draw() returns two arrays: those of its last call, self.arrays, or new ones if that is None. Ids count from 1 in the
lowest 24 bits, where background is 0; row 0 is the top.

Every drawer gets as many cores as it has threads, and the fastest settings that we found.
"""
import multiprocessing
import os
import re
import subprocess
import time
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass
from statistics import median

import numpy as np


@dataclass
class Mesh:
    positions: np.ndarray  # (n, 3), float32
    triangles: np.ndarray  # (m, 3), uint32


@dataclass
class View:
    """A pinhole camera as in computer vision: x right, y down, z forward; the centre of the first pixel is at (0.5, 0.5)."""
    size: tuple  # width, height
    k: np.ndarray  # intrinsics, (3, 3)
    world_to_camera: np.ndarray  # (4, 4)
    near: float
    far: float

    def distance(self, z):
        """Along the view direction, from depths in [0, 1]."""
        return self.near * self.far / (self.far - z * (self.far - self.near))


class Edgewise:
    def __init__(self, threads):
        import edgewise
        self.edgewise, self.threads, self.version, self.depth01 = edgewise, threads, "Edgewise", edgewise.depth01

    def load(self, mesh):
        self.scene = self.edgewise.Scene(mesh.positions, mesh.triangles)

    def draw(self, view):
        projection = self.edgewise.intrinsics(view.k, *view.size, view.near, view.far, first_centre=0.5)
        self.arrays = self.scene.draw(self.edgewise.Camera(view.world_to_camera, projection), view.size, ids=True, first_id=1,
                                      background=0, threads=self.threads, onto=self.arrays, clear=True)
        return self.arrays


def use_llvmpipe(threads):
    os.environ.update(LIBGL_ALWAYS_SOFTWARE="1", GALLIUM_DRIVER="llvmpipe",
                      LP_NUM_THREADS="0" if threads == 1 else str(threads))  # 0: the calling thread draws


def llvmpipe_of(renderer, version):
    """Its version, from two of OpenGL's strings."""
    if not renderer.startswith("llvmpipe"):
        raise RuntimeError(f"OpenGL is {renderer}, not llvmpipe")
    return f"{renderer}, {version.partition(') ')[2]}"


class Vtk:
    """Each triangle's colour is its id, without light, smoothing or multisampling; depth is the z-buffer. Debian's VTK draws through
    an X server only, here Xvfb, and Mesa's llvmpipe draws in this process."""
    depth01 = np.float64

    def __init__(self, threads):
        use_llvmpipe(threads)
        os.environ["DISPLAY"] = start_xvfb()
        import vtkmodules.vtkRenderingOpenGL2  # noqa: F401: the implementation of the next
        from vtkmodules import vtkCommonCore, vtkCommonDataModel, vtkRenderingCore
        from vtkmodules.util import numpy_support
        self.core, self.data, self.numpy = vtkCommonCore, vtkCommonDataModel, numpy_support
        self.mapper, actor = vtkRenderingCore.vtkPolyDataMapper(), vtkRenderingCore.vtkActor()
        actor.SetMapper(self.mapper)
        actor.GetProperty().LightingOff()
        self.camera, renderer = vtkRenderingCore.vtkCamera(), vtkRenderingCore.vtkRenderer()
        renderer.SetActiveCamera(self.camera)
        renderer.AddActor(actor)
        self.window = vtkRenderingCore.vtkRenderWindow()
        self.window.SetOffScreenRendering(True)
        self.window.SetMultiSamples(0)
        self.window.SwapBuffersOff()
        self.window.AddRenderer(renderer)
        self.window.Render()
        opengl = self.window.ReportCapabilities()
        self.version = (f"VTK {vtkCommonCore.vtkVersion.GetVTKVersion()}, "
                        + llvmpipe_of(*(re.search(f"OpenGL {what} string: *(.*)", opengl)[1] for what in ("renderer", "version"))))

    def load(self, mesh):
        count = len(mesh.triangles)
        colours = np.arange(1, count + 1, dtype="<u4").view(np.uint8).reshape(count, 4)[:, :3]
        # VTK keeps no reference to arrays that it does not copy.
        self.kept = mesh.positions, mesh.triangles.astype(np.int64), np.ascontiguousarray(colours)
        points, cells, mesh_of_vtk = self.core.vtkPoints(), self.data.vtkCellArray(), self.data.vtkPolyData()
        points.SetData(self.numpy.numpy_to_vtk(self.kept[0]))
        cells.SetData(3, self.numpy.numpy_to_vtkIdTypeArray(self.kept[1].reshape(-1)))
        mesh_of_vtk.SetPoints(points)
        mesh_of_vtk.SetPolys(cells)
        mesh_of_vtk.GetCellData().SetScalars(self.numpy.numpy_to_vtk(self.kept[2]))
        self.mapper.SetInputData(mesh_of_vtk)

    def draw(self, view):
        width, height = view.size
        rotation, moved = view.world_to_camera[:3, :3], view.world_to_camera[:3, 3]
        eye = -rotation.T @ moved
        self.camera.SetPosition(eye)
        self.camera.SetFocalPoint(eye + rotation[2])
        self.camera.SetViewUp(-rotation[1])
        self.camera.SetViewAngle(np.degrees(2 * np.arctan(height / 2 / view.k[1, 1])))
        self.camera.SetClippingRange(view.near, view.far)
        self.window.SetSize(width, height)
        self.window.Render()
        colours, depth = self.arrays = self.arrays or (self.core.vtkUnsignedCharArray(), self.core.vtkFloatArray())
        self.window.GetRGBACharPixelData(0, 0, width - 1, height - 1, 0, colours)
        self.window.GetZbufferData(0, 0, width - 1, height - 1, depth)
        ids = self.numpy.vtk_to_numpy(colours).view("<u4")
        return ids.reshape(height, width)[::-1], self.numpy.vtk_to_numpy(depth).reshape(height, width)[::-1]


class ModernGl:
    """The least that OpenGL does: one draw call, whose shader writes the triangle's number, and a read of both planes.
    Each triangle's last corner is a vertex of its own, which is faster than gl_PrimitiveID."""
    depth01 = np.float64
    VERTEX = """#version 330
        uniform mat4 to_clip;
        in vec3 position;
        flat out uint number;
        void main() { number = uint(gl_VertexID + 1); gl_Position = to_clip * vec4(position, 1.0); }"""
    FRAGMENT = """#version 330
        flat in uint number;
        out uint id;
        void main() { id = number; }"""

    def __init__(self, threads):
        use_llvmpipe(threads)
        import moderngl
        self.context = moderngl.create_context(standalone=True, backend="egl")
        self.context.gc_mode = "auto"  # frees a mesh's buffers with the mesh
        self.context.enable_only(moderngl.DEPTH_TEST)
        self.program = self.context.program(vertex_shader=self.VERTEX, fragment_shader=self.FRAGMENT)
        self.frame = None
        self.version = (f"ModernGL {moderngl.__version__}, "
                        + llvmpipe_of(self.context.info["GL_RENDERER"], self.context.info["GL_VERSION"]))

    def load(self, mesh):
        count = len(mesh.triangles)
        positions = np.concatenate([mesh.positions[mesh.triangles[:, 2]], mesh.positions])
        triangles = np.column_stack([mesh.triangles[:, :2] + count, np.arange(count, dtype=np.uint32)])
        self.mesh = self.context.vertex_array(self.program, [(self.context.buffer(positions), "3f", "position")],
                                              self.context.buffer(triangles))

    def draw(self, view):
        width, height = view.size
        if self.frame is None or self.frame.size != view.size:
            self.frame = self.context.framebuffer(self.context.texture(view.size, 1, dtype="u4"), self.context.depth_texture(view.size))
            self.frame.use()
        span = view.far - view.near
        to_clip = np.array([[2 * view.k[0, 0] / width, 0, 0, 0], [0, -2 * view.k[1, 1] / height, 0, 0],
                            [0, 0, (view.far + view.near) / span, -2 * view.far * view.near / span], [0, 0, 1, 0]]) @ view.world_to_camera
        self.program["to_clip"].write(to_clip.T.astype(np.float32).tobytes())
        self.frame.clear()
        self.mesh.render()
        ids, depth = self.arrays = self.arrays or (np.empty((height, width), "<u4"), np.empty((height, width), np.float32))
        self.frame.read_into(ids, components=1, dtype="u4")
        self.frame.read_into(depth, components=1, attachment=-1, dtype="f4")
        return ids[::-1], depth[::-1]


DRAWERS = {"edgewise": Edgewise, "vtk": Vtk, "moderngl": ModernGl}


def start_xvfb():
    """The name of the display. The server ends with this process."""
    read, write = os.pipe()
    subprocess.Popen(["setpriv", "--pdeathsig", "TERM", "Xvfb", "-displayfd", str(write), "-nolisten", "tcp"], pass_fds=[write],
                     stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    os.close(write)
    with os.fdopen(read) as display:
        return ":" + display.readline().strip()


def drawn(drawer, mesh, view, calls=0, reuse=False):
    """The picture's ids and distances, or, of so many calls, the median of their milliseconds. With a mesh, it is loaded anew.
    reuse: draws into the arrays of the last call."""
    times, kept = [], []  # all arrays are kept, since the allocator would hand out those that were freed as new ones
    for _ in range(calls or 1):
        start = time.perf_counter()
        if mesh is not None:
            drawer.load(mesh)
        if not reuse:
            drawer.arrays = None
        kept.append(drawer.draw(view))
        times.append(1e3 * (time.perf_counter() - start))
    ids, depth = kept[-1]
    return median(times) if calls else (ids & 0xFFFFFF, view.distance(drawer.depth01(depth)))


here = None  # the drawer of a process that Drawer started


def start(name, threads):
    """Makes it, and returns its version."""
    global here
    os.sched_setaffinity(0, sorted(os.sched_getaffinity(0))[:threads])
    here = DRAWERS[name](threads)
    return here.version


def drawn_here(*request):
    return drawn(here, *request)


class Drawer:
    """A drawer in another process."""

    def __init__(self, name, threads):
        self.name, self.threads = name, threads
        self.process = ProcessPoolExecutor(1, multiprocessing.get_context("spawn"))  # threads of this process are not copied
        self.version = self.answer(start, name, threads)

    def answer(self, function, *arguments):
        try:
            return self.process.submit(function, *arguments).result()
        except Exception as error:  # whatever a package throws
            raise RuntimeError(f"{self.name}: {error}") from None

    def drawn(self, *request):
        return self.answer(drawn_here, *request)
