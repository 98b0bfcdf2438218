"""README's table of speed: times of ours and of peers from scene to picture."""
from bench_rows import order
from tables import THREADS, milliseconds, scene_facts


def row_of(bench, who, scene, with_frontend):
    return bench.find(f"{who}{'+frontend' if with_frontend else ''}/{scene}/threads:{max(THREADS)}")


def is_mesh(bench, scene):
    """Whether peers drew it as a whole frame; they draw only meshes so."""
    return any(row_of(bench, peer, scene, with_frontend=True) for peer in bench.peers)


def speed_table(bench):
    """Header and lines, one per scene; bold: the settled fastest of ours."""
    lines = []
    for scene in bench.scenes:
        mesh = is_mesh(bench, scene)
        ours = {backend: row for backend in bench.backends if (row := row_of(bench, backend, scene, mesh))}
        theirs = [row_of(bench, peer, scene, mesh) for peer in bench.peers]

        def cell(row):
            best = all(order(row, other) < 0 for other in ours.values() if other is not row)
            return f"**{milliseconds(row)}**" if best and len(ours) > 1 else milliseconds(row)

        lines.append([f"{scene}{' (mesh)' if mesh else ''}", scene_facts(bench, scene)[0],
                      *(cell(ours[backend]) if backend in ours else "–" for backend in bench.backends),
                      *(milliseconds(row) for row in theirs)])
    return ["scene", "triangles", *bench.backends, *bench.peers], lines
