"""The layers: surface <- kernels, contraction <- skeleton <- rig <- app, and what may be public.

usage: include_rule.py SOURCE_DIR PUBLIC_HEADER...
"""

import pathlib
import re
import sys

BELOW = {
    "surface": set(),
    "kernels": {"surface"},
    "contraction": {"surface", "kernels"},
    "skeleton": {"surface", "kernels", "contraction"},
    "rig": {"surface", "kernels", "contraction", "skeleton"},
    "app": {"surface", "kernels", "contraction", "skeleton", "rig"},
    "viewer": {"surface", "kernels", "contraction", "skeleton", "rig", "app"},
}
OWN = re.compile(r'^\s*#\s*include\s+"([^"]+)"')
FOREIGN = re.compile(r"^\s*#\s*include\s+<([^>]+)>")
# Neither a folder nor a suffix: the C++ standard library.
STANDARD = re.compile(r"^[a-z_0-9]+$")
FOREIGN_IN_PUBLIC = re.compile(r"^Eigen/")


def includes(path, pattern):
    for number, line in enumerate(path.read_text().splitlines(), 1):
        found = pattern.match(line)
        if found:
            yield number, found.group(1)


def climbing(source, layer):
    """Includes of a layer's files that lead to its own level or up."""
    for path in sorted((source / layer).rglob("*")):
        if path.suffix not in (".cpp", ".hpp"):
            continue
        for number, name in includes(path, OWN):
            target = name.split("/")[0]
            if target not in BELOW[layer] | {layer} or not (source / name).exists():
                yield f"{path}:{number}: {layer} must not include \"{name}\""


def beyond_public(source, public):
    """Public headers that need private or third-party ones."""
    for header in public:
        path = source / header
        for number, name in includes(path, OWN):
            if name not in public:
                yield f"{path}:{number}: \"{name}\" is not public; see cmake/CurveskelInstall.cmake"
        for number, name in includes(path, FOREIGN):
            if not STANDARD.match(name) and not FOREIGN_IN_PUBLIC.match(name):
                yield f"{path}:{number}: a public header must not include <{name}>"


def beyond_library(source, public):
    """The programs live on what every user of the library has."""
    for path in sorted([*(source / "app").glob("*.[ch]pp"), *(source / "viewer").glob("*.[ch]pp")]):
        for number, name in includes(path, OWN):
            if not name.startswith(("app/", "viewer/")) and name not in public:
                yield f"{path}:{number}: must use public headers only, not \"{name}\""


def main():
    source, public = pathlib.Path(sys.argv[1]), set(sys.argv[2:])
    found = [line for layer in BELOW if (source / layer).is_dir() for line in climbing(source, layer)]
    found += beyond_public(source, sorted(public))
    found += beyond_library(source, public)
    print("\n".join(found))
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
