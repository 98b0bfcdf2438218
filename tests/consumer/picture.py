"""Draws a mesh file, writes the picture, and says how many triangles it shows."""
import edgewise

scene = edgewise.Scene.read_obj("mesh.obj")
camera = scene.camera(640 / 360)  # sees the whole mesh; or edgewise.Camera(view, projection)
picture = scene.draw(camera, (640, 360), threads=2)
edgewise.write_image("mesh.png", picture.payload)
ids = scene.draw(camera, (640, 360), ids=True, threads=2)
visible, _ = edgewise.visible_triangles(ids)
print(f"{len(visible)} of {scene.first_ids()[-1]} triangles are visible")
