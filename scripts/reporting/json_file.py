"""Writes results."""
import json

from bench_rows import BadInput


def write_text(path, text):
    """Replaces the file in one step."""
    part = path.with_name(path.name + ".part")
    try:
        part.write_text(text, encoding="utf-8")
        part.replace(path)
    except OSError as error:
        part.unlink(missing_ok=True)
        raise BadInput(f"cannot write {path}: {error.strerror}") from error


def write_json(path, data):
    write_text(path, json.dumps(data, indent=1) + "\n")
