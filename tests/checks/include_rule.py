"""The layers: base <- surface <- kernels, contraction <- skeleton <- rig <- app <- viewer, python.

usage: include_rule.py SOURCE_DIR LAYER=HEADER...

A layer includes its own files and those of layers below it; public headers, which lie together in
include/, belong to the layer that the build lists them under. Public headers need no private and
no foreign ones but Eigen's, curveskel.hpp has them all, and the programs live on public headers alone.
"""

import pathlib
import re
import sys

BELOW = {
    "base": set(),
    "surface": {"base"},
    "kernels": {"base", "surface"},
    "contraction": {"base", "surface", "kernels"},
    "skeleton": {"base", "surface", "kernels", "contraction"},
    "rig": {"base", "surface", "kernels", "contraction", "skeleton"},
    "app": {"base", "surface", "kernels", "contraction", "skeleton", "rig"},
    "viewer": {"base", "surface", "kernels", "contraction", "skeleton", "rig", "app"},
    "python": {"base", "surface", "kernels", "contraction", "skeleton", "rig", "app"},
}
INCLUDE = re.compile(r'^\s*#\s*include\s+(["<])([^">]+)[">]')
# Neither a folder nor a suffix: the C++ standard library.
STANDARD = re.compile(r"^[a-z_0-9]+$")
FOREIGN_IN_PUBLIC = re.compile(r"^Eigen/")


def includes(path):
    """Line, whether it is private, and name of each include."""
    for number, line in enumerate(path.read_text().splitlines(), 1):
        found = INCLUDE.match(line)
        if found:
            yield number, found.group(1) == '"', found.group(2)


def files_of(source, layer):
    return [path for path in sorted((source / layer).rglob("*")) if path.suffix in (".cpp", ".hpp")]


def climbing(source, layer, paths, layer_of_public):
    """Includes of a layer's files that lead to a layer above it."""
    allowed = BELOW[layer] | {layer}
    for path in paths:
        for number, private, name in includes(path):
            if private:
                wrong = name.split("/")[0] not in allowed or not (source / name).exists()
            else:
                wrong = layer_of_public.get(name, layer) not in allowed
            if wrong:
                yield f"{path}:{number}: {layer} must not include {name}"


def beyond_public(source, layer_of_public):
    """Public headers that need private or third-party ones."""
    for header in sorted(layer_of_public):
        path = source / "include" / header
        for number, private, name in includes(path):
            known = name in layer_of_public or STANDARD.match(name) or FOREIGN_IN_PUBLIC.match(name)
            if private or not known:
                yield f"{path}:{number}: a public header must not include {name}"


def beyond_library(source):
    """The programs live on the public headers, as every user of the library does."""
    for layer in ("app", "viewer", "python"):
        for path in files_of(source, layer):
            for number, private, name in includes(path):
                if private and not name.startswith(("app/", "viewer/", "python/")):
                    yield f"{path}:{number}: must use public headers only, not {name}"


def left_out(source, layer_of_public):
    """Public headers that the whole library in one include lacks."""
    whole = "curveskel.hpp"
    path = source / "include" / whole
    there = {name for _, _, name in includes(path)}
    for header in sorted(set(layer_of_public) - there - {whole}):
        yield f"{path}: lacks {header}"


def main():
    source = pathlib.Path(sys.argv[1])
    layer_of_public = {}
    for argument in sys.argv[2:]:
        layer, header = argument.split("=")
        layer_of_public[header.removeprefix("include/")] = layer
    found = []
    for layer in BELOW:
        public = [source / "include" / h for h, its in layer_of_public.items() if its == layer]
        found += climbing(source, layer, files_of(source, layer) + sorted(public), layer_of_public)
    found += beyond_public(source, layer_of_public)
    found += left_out(source, layer_of_public)
    found += beyond_library(source)
    print("\n".join(found))
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
