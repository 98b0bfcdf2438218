"""The pixels that conformant rasterizers may draw differently: portable.json, what `edgewise portable --json` prints."""
from bench_rows import BadInput, read_json
from tables import percent

OURS = 8
REASONS = ("edge", "tie", "clip", "depth")


def read_portable(folder):
    """{subpixel bits: {scene: entry}}; empty if not measured."""
    path = folder / "portable.json"
    found = {}
    if path.exists():
        try:
            for entry in read_json(path):
                if not (0 <= entry["unstable"] <= entry["pixels"] and {*REASONS} <= {*entry["reasons"]}):
                    raise ValueError(f"scene {entry['scene']}")
                found.setdefault(int(entry["subpixel_bits"]), {})[entry["scene"]] = entry
        except (KeyError, TypeError, ValueError) as error:
            raise BadInput(f"{path}: not what 'edgewise portable' prints: {type(error).__name__} {error}") from None
    if len({frozenset(scenes) for scenes in found.values()}) > 1:
        raise BadInput(f"{path}: not the same scenes for all subpixel bits")
    return found


def share(entry):
    return entry["unstable"] / entry["pixels"]


def portable_table(found):
    """Header and lines, a line per scene."""
    header = ["scene", f"may differ at {OURS} bits", *(f"{reason}, px" for reason in REASONS), f"at {min(found)} bits"]
    lines = [[scene, percent(share(entry)), *(f"{entry['reasons'][reason]:,}" for reason in REASONS),
              percent(share(found[min(found)][scene]))] for scene, entry in found[OURS].items()]
    return header, lines
