"""The result of a soak test (`edgewise soak --json`) in a sentence."""
from speedups import VECTORS, kernels
from tables import enumerated


def targets_of(soak):
    """"scalar code, SSE4 and AVX2": what the soak's machine could run."""
    ran = {backend_and_target.rpartition(", ")[2] for backend_and_target in soak["by"]["backend_simd_target"]}
    return enumerated([kernels(target) for target in ("scalar", *VECTORS) if target in ran])


def soak_sentence(soak):
    minutes = soak["seconds"] / 60
    shards = len(soak["shards"])
    drawn = (f"In {minutes:,.0f} minutes{f' of {shards} shards' if shards > 1 else ''}, {soak['cases']:,} random and "
             f"adversarial pictures were drawn by {enumerated([f'`{name}`' for name in soak['backends']])}, each in {targets_of(soak)}, on one and on several threads, with "
             f"random tile sizes, row strides and alignments: {soak['frames']:,} frames of {soak['triangles']:,} triangles "
             f"and {soak['pixels']:,} pixels in all were compared bit for bit, {soak['oracle_frames']:,} of them with the "
             f"oracle, and {soak['frontend_lists']:,} triangle lists of the front end. ")
    bounds = soak["bounds_95"]
    if not bounds:
        return drawn + f"**{soak['differences']:,} differ**."
    return drawn + (f"**No bit differs.** With 95 % confidence fewer than one picture in {1 / bounds['per_case']:,.0f} of such "
                    f"kinds would differ; if frames fail independently of one another, fewer than one frame in "
                    f"{1 / bounds['per_frame']:,.0f}, and one pixel in {1 / bounds['per_pixel']:.1e} (rule of three).")
