"""Draws a mesh file and writes the picture."""
import edgewise

scene = edgewise.Scene.read_obj("mesh.obj")
camera = scene.camera(640 / 360)  # sees the whole mesh; or edgewise.Camera(view, projection)
edgewise.write_image("mesh.png", scene.draw(camera, (640, 360), threads=2).payload)
