"""Reads the claims of tests/proofs/*.smt2 and asks a solver; contract.smt2 there describes the layout of the files.

Each section runs after the definitions and its file's introduction, in a process of its own, so that a time-out ends
no other section.
"""
import re
import subprocess
import time
from dataclasses import dataclass, replace

from program import BadInput

DEFINITIONS = "contract.smt2"
EXPECTED = {"claim": "unsat", "premises": "sat", "weakened": "sat"}
SECTION = re.compile(r"^;; (claim|weakened) (\w+): (.*(?:\n;;   .*)*)\n", re.MULTILINE)
CONSTANT = re.compile(r"^\(define-const (\w+) (?:Int|Real) ([\d.]+)\)\s*; = (\w+) of (\S+)$", re.MULTILINE)


@dataclass(frozen=True)
class Section:
    file: str
    kind: str  # claim, weakened, or premises (of a claim)
    name: str
    text: str
    script: str  # the solver's whole input


def read_sections(folder):
    """Sections of all files. Every claim has a deliberately false variant, in the files `weakened`, and vice versa."""
    definitions = (folder / DEFINITIONS).read_text()
    sections = []
    for path in sorted(folder.glob("*.smt2")):
        if path.name == DEFINITIONS:
            continue
        introduction, *rest = SECTION.split(path.read_text())
        for kind, name, text, body in zip(*[iter(rest)] * 4):
            sections.append(Section(path.name, kind, name, re.sub(r"\n;;\s+", " ", text),
                                    f"{definitions}{introduction}{body}(check-sat)\n"))
    found = [(s.kind, s.name) for s in sections]
    if not found:
        raise BadInput(f"{folder} has no claims")
    for kind, name in found:
        if found.count((kind, name)) > 1:
            raise BadInput(f"{name} occurs twice as {kind}")
        if kind == "claim" and ("weakened", name) not in found:
            raise BadInput(f"claim {name} has no deliberately false variant")
        if kind == "weakened" and ("claim", name) not in found:
            raise BadInput(f"{name} has a false variant, but no claim")
    return sections


def premises_of(claim):
    """The premises: all but the last assertion, which denies the claim. With contradictory premises a claim is vacuous."""
    given, found, _ = claim.script.rpartition("\n(assert ")
    if not found:
        raise BadInput(f"{claim.file}: claim {claim.name} asserts nothing")
    return replace(claim, kind="premises", text="satisfiable", script=f"{given}\n(check-sat)\n")


def constant_of(name, source, path):
    """The value of `constexpr TYPE name = EXPRESSION;` in C++ source, whose expression may name others."""
    found = re.findall(rf"\bconstexpr [\w:]+ {name} = ([^;]+);", source)
    if len(found) != 1:
        raise BadInput(f"{path} defines the constant {name} {len(found)} times, not once")
    expression = re.sub(r"std::u?int\d+_t\{(\w+)\}", r"\1", found[0])
    expression = re.sub(r"\b[a-z]\w*", lambda other: str(constant_of(other[0], source, path)), expression)
    if not re.fullmatch(r"(?:0x[0-9A-Fa-f]+|\d+|[-+*/() ]|<<)+", expression):
        raise BadInput(f"{path}: {name} = {found[0]} is more than this reads")
    return eval(expression.replace("/", "//"), {"__builtins__": {}})  # numbers and operators only, see above


def check_constants(folder, root):
    """Compares the constants of the proofs with the sources that they name; returns their number."""
    constants = [found for path in sorted(folder.glob("*.smt2")) for found in CONSTANT.findall(path.read_text())]
    for name, value, source_name, file in constants:
        path = root / file
        if not path.is_file():
            raise BadInput(f"{name} is said to be {source_name} of {file}, which is not there")
        actual = constant_of(source_name, path.read_text(), file)
        if float(value) != actual:
            raise BadInput(f"{name} is {value} in the proofs, but {source_name} of {file} is {actual}")
    return len(constants)


def solve(solver, section, limit_s):
    """The solver's answer, and the seconds it took."""
    start = time.monotonic()
    try:
        output = subprocess.run([solver, "-in", f"-T:{limit_s}"], input=section.script, capture_output=True, text=True,
                                timeout=limit_s + 10, check=False).stdout
    except subprocess.TimeoutExpired:
        output = "timeout"
    answer, _, _ = output.partition("\n")
    if answer not in ("sat", "unsat", "unknown", "timeout"):
        raise BadInput(f"{section.file}: {section.kind} {section.name}: the solver says {answer}")
    return answer, time.monotonic() - start
