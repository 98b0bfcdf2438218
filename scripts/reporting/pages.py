"""The project's READMEs."""


def readmes(first):
    """`first`, which is the root's, then those of the folders below it, without those of builds and of packages."""
    root = first.parent
    return [first, *(page for page in sorted(root.glob("*/**/README.md"))
                     if not any(part.startswith(("build", ".")) or part == "node_modules"
                                for part in page.relative_to(root).parts))]
