"""Reads USD's text, by its grammar, for laws of what is written: anything else is an error."""

import re

TOKEN = re.compile(r"""\s*(?:
    (?P<string>"(?:[^"\\\n]|\\.)*")
  | @(?P<asset>[^@\n]*)@
  | <(?P<path>/[^>\n]*)>
  | (?P<number>-?(?:\d+(?:\.\d*)?|\.\d+)(?:e[+-]?\d+)?(?![\w.]))
  | (?P<word>[A-Za-z_][\w:.]*(?:\[\])?)
  | (?P<mark>[(){}\[\]=,:])
)""", re.VERBOSE)

# By type how many numbers a value has.
WIDTHS = {"point3f": 3, "normal3f": 3, "vector3f": 3, "color3f": 3, "color4f": 4, "float3": 3,
          "float4": 4, "float2": 2, "half3": 3, "double3": 3, "texCoord2f": 2, "quatf": 4,
          "matrix4d": 4, "float": 1, "int": 1, "token": 1, "string": 1, "bool": 1, "asset": 1}


class Asset(str):
    pass


class Path(str):
    pass


class Attribute:
    def __init__(self, kind, value=None):
        self.kind, self.value = kind, value
        self.samples, self.connection, self.metadata = None, None, {}


class Prim:
    def __init__(self, kind, path, metadata):
        self.kind, self.path, self.metadata = kind, path, metadata
        self.attributes, self.relations, self.children = {}, {}, []

    @property
    def name(self):
        return self.path.rsplit("/", 1)[1]

    def all(self, kind=None):
        """This prim and all below it."""
        found = [self] if kind in (None, self.kind) else []
        return found + [prim for child in self.children for prim in child.all(kind)]

    def __getitem__(self, name):
        return self.attributes[name].value

    def get(self, name, otherwise=None):
        return self.attributes[name].value if name in self.attributes else otherwise


class Reader:
    def __init__(self, text):
        assert text.startswith("#usda 1.0\n")
        self.tokens = []
        at = text.index("\n")
        text = text.rstrip()
        while at < len(text):
            match = TOKEN.match(text, at)
            assert match, f"no token: {text[at:at + 40]!r}"
            self.tokens.append((match.lastgroup, match[match.lastgroup]))
            at = match.end()
        self.at = 0

    def peek(self):
        return self.tokens[self.at] if self.at < len(self.tokens) else (None, None)

    def next(self, kind=None, text=None):
        token = self.peek()
        assert kind in (None, token[0]) and text in (None, token[1]), (token, kind, text)
        self.at += 1
        return token[1]

    def takes(self, text):
        if self.peek()[1] != text or self.peek()[0] not in ("mark", "word"):
            return False
        self.at += 1
        return True

    def value(self):
        kind, text = self.peek()
        self.at += 1
        if kind == "string":
            return re.sub(r"\\(.)", r"\1", text[1:-1])
        if kind == "asset":
            return Asset(text)
        if kind == "path":
            return Path(text)
        if kind == "number":
            return int(text) if text.lstrip("-").isdigit() else float(text)
        assert kind == "mark" and text in "([", (kind, text)
        closing = ")" if text == "(" else "]"
        items = []
        while not self.takes(closing):
            if items:
                self.next("mark", ",")
            items.append(self.value())
        return tuple(items) if text == "(" else items

    def metadata(self):
        found = {}
        if not self.takes("("):
            return found
        while not self.takes(")"):
            self.takes("prepend")
            name = self.next("word")
            self.next("mark", "=")
            assert name not in found
            found[name] = self.value()
        return found

    def property(self, prim):
        if self.takes("rel"):
            name = self.next("word")
            self.next("mark", "=")
            targets = self.value()
            assert name not in prim.relations
            prim.relations[name] = targets if isinstance(targets, list) else [targets]
            return
        self.takes("uniform")
        kind, name = self.next("word"), self.next("word")
        assert kind.removesuffix("[]") in WIDTHS, kind
        base, _, suffix = name.partition(".")
        known = prim.attributes.get(base)
        assert known is None or (suffix == "connect" and known.connection is None), base
        attribute = prim.attributes[base] = known or Attribute(kind)
        if not suffix and not self.takes("="):
            return
        if suffix:
            self.next("mark", "=")
        if suffix == "connect":
            attribute.connection = self.next("path")
        elif suffix == "timeSamples":
            self.next("mark", "{")
            attribute.samples = {}
            while not self.takes("}"):
                time = float(self.next("number"))
                self.next("mark", ":")
                attribute.samples[time] = self.checked(kind, self.value())
                self.next("mark", ",")
            assert list(attribute.samples) == sorted(attribute.samples)
        else:
            assert not suffix, name
            attribute.value = self.checked(kind, self.value())
            attribute.metadata = self.metadata()

    @staticmethod
    def checked(kind, value):
        width = WIDTHS[kind.removesuffix("[]")]
        assert isinstance(value, list) == kind.endswith("[]"), (kind, value)
        for one in value if kind.endswith("[]") else [value]:
            assert (len(one) == width) if width > 1 else not isinstance(one, tuple), (kind, one)
        return value

    def prim(self, above):
        self.next("word", "def")
        kind = self.next("word")
        name = self.value()
        assert re.fullmatch(r"[A-Za-z_]\w*", name, re.ASCII), name
        made = Prim(kind, f"{above}/{name}", self.metadata())
        self.next("mark", "{")
        while not self.takes("}"):
            if self.peek() == ("word", "def"):
                made.children.append(self.prim(made.path))
            else:
                self.property(made)
        names = [child.name for child in made.children]
        assert len(set(names)) == len(names), names
        return made


def read(text):
    """The layer's metadata and its one root prim."""
    reader = Reader(text)
    metadata = reader.metadata()
    root = reader.prim("")
    assert reader.peek() == (None, None)
    return metadata, root
