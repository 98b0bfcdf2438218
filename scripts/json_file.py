"""Writes results."""
import json

from bench_rows import BadInput


def write_json(path, data):
    """Under its name only when it is whole."""
    part = path.with_name(path.name + ".part")
    try:
        part.write_text(json.dumps(data, indent=1) + "\n")
        part.replace(path)
    except OSError as error:
        part.unlink(missing_ok=True)
        raise BadInput(f"cannot write {path}: {error.strerror}") from error
