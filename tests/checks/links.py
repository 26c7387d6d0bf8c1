"""Every relative link of the documents leads to a file, and to a heading of it where it names one.

usage: links.py FOLDER    the source tree, or the folder of documents of an installation
"""

import pathlib
import re
import sys

LINK = re.compile(r"!?\[[^\]]*\]\(([^)\s]+)\)")
IGNORED = {"build", ".git", "shared"}


def anchors(document):
    """The names that a browser of Markdown gives its headings."""
    for line in document.read_text().splitlines():
        if line.startswith("#"):
            words = re.sub(r"[^\w\- ]", "", line.lstrip("#").strip().lower())
            yield words.replace(" ", "-")


def main():
    root = pathlib.Path(sys.argv[1])
    documents = [path for path in sorted(root.rglob("*.md"))
                 if not IGNORED & set(path.relative_to(root).parts)]
    dead = []
    for document in documents:
        for target in LINK.findall(document.read_text()):
            if re.match(r"[a-z]+:", target):
                continue
            name, _, anchor = target.partition("#")
            file = document.parent / name if name else document
            if not file.exists():
                dead.append(f"{document}: {target} is not there")
            elif anchor and file.suffix == ".md" and anchor not in set(anchors(file)):
                dead.append(f"{document}: {target} is no heading there")
    print("\n".join(dead))
    return 1 if dead or not documents else 0


if __name__ == "__main__":
    sys.exit(main())
