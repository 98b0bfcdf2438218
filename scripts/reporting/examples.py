"""The examples in READMEs: whole files that the tests build and run."""
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]

EXAMPLES = {
    "example_short": "tests/consumer/picture.cpp",
    "example_consumer": "tests/consumer/main.cpp",
    "example_backend": "tests/extending/quadtree.cpp",
    "example_method": "tests/extending/double_snapped.cpp",
    "example_scene": "tests/extending/staircase.cpp",
}


def example(name):
    """The README block that shows an example."""
    path = EXAMPLES[name]
    return f"`{path}`:\n\n```cpp\n{(ROOT / path).read_text(encoding='utf-8')}```\n"
