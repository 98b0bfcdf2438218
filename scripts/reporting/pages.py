"""The project's READMEs."""


def readmes(first):
    """`first`, the README of the root, then those of its folders, except builds and packages."""
    root = first.parent
    return [first, *(page for page in sorted(root.glob("*/**/README.md"))
                     if not any(part.startswith(("build", ".")) for part in page.relative_to(root).parts))]
