"""Writes the stubs.

jred/_answers.py has the types of the commands' answers, from the JSON schemas in docs/schemas; jred/_options.py their
options, from the help of the commands; jred/_jred.pyi is the native part, from what ``maturin generate-stubs --out
FOLDER`` wrote.
``python tests/stubs.py FOLDER`` writes the files, ``python tests/stubs.py FOLDER --check`` compares them.
"""

from __future__ import annotations

import json
import re
import sys
from keyword import iskeyword
from pathlib import Path
from typing import Any

from jred import _jred
from jred._result import _attribute

HERE = Path(__file__).parents[1]
#: Answers of the methods of a machine.
ANSWERS = ("balance", "bus", "check", "drive", "fastest", "gentlest", "project", "ratio", "reduce", "require",
           "sensitivity", "simulate", "size", "split", "steady", "tolerance")  # fmt: skip
PLAIN = {"number": "float", "integer": "int", "string": "str", "boolean": "bool", "null": "None"}


def camel(name: str) -> str:
    return "".join(part[:1].upper() + part[1:] for part in name.replace("_", "-").split("-"))


class Writer:
    """Classes of one answer."""

    def __init__(self, answer: str, schema: dict[str, Any]) -> None:
        self.prefix = camel(answer)
        self.schema = schema
        self.classes: list[str] = []

    def type(self, node: Any, name: str) -> str:
        """The Python type of a schema; an object without a name of its own becomes a class ``name``."""
        if not isinstance(node, dict):
            return "Any"
        if "$ref" in node:
            return self.prefix + node["$ref"].rpartition("/")[2]
        if "const" in node:
            return f"Literal[{node['const']!r}]"
        if "enum" in node:
            return f"Literal[{', '.join(map(repr, node['enum']))}]"
        for key in ("anyOf", "oneOf"):
            if key in node:
                found = [self.type(each, f"{name}{k}") for k, each in enumerate(node[key])]
                return " | ".join(sorted(set(found), key=lambda word: (word == "None", word)))
        kinds = node.get("type", [])
        kinds = kinds if isinstance(kinds, list) else [kinds]
        found = [self.kind(node, kind, name) for kind in kinds]
        return " | ".join(found) or "Any"

    def kind(self, node: dict[str, Any], kind: str, name: str) -> str:
        if kind == "array":
            each = self.type(node.get("items"), name)
            size = node.get("minItems")
            fixed = size is not None and size == node.get("maxItems")
            return f"tuple[{', '.join([each] * size)}]" if fixed else f"tuple[{each}, ...]"
        if kind == "object":
            if "properties" not in node:
                return f"Mapping[str, {self.type(node.get('additionalProperties'), name)}]"
            self.write(node, name, "Item")
            return name
        return PLAIN[kind]

    def write(self, node: dict[str, Any], name: str, base: str) -> None:
        lines = [f"class {name}({base}):"]
        about = node.get("description")
        lines += [f'    """{about}"""'] if about else []
        for key, value in node.get("properties", {}).items():
            attribute = _attribute(key)
            if attribute == "holds":
                continue  # That of every result.
            about = " ".join(filter(None, [unit(key), value.get("description", "")]))
            lines.append(f"    {attribute}: {self.type(value, name + camel(attribute))}")
            lines += [f'    """{about}"""'] if about else []
        self.classes.append("\n".join(lines if len(lines) > 1 else [*lines, "    ..."]))

    def whole(self) -> str:
        for name, node in self.schema.get("$defs", {}).items():
            if "properties" in node:
                self.write(node, self.prefix + name, "Item")
            else:
                self.classes.append(f'{self.prefix}{name}: TypeAlias = "{self.type(node, self.prefix + name + "_")}"')
        self.write(self.schema, self.prefix, "Result")
        return "\n\n".join(self.classes)


def unit(key: str) -> str:
    return f"{key[key.index('[') :]}." if key.endswith("]") else ""


def text() -> str:
    head = (
        '"""Answers of the commands, with every figure as an attribute. Written by stubs.py from docs/schemas."""\n\n'
        "from __future__ import annotations\n\nfrom collections.abc import Mapping\nfrom typing import Any, Literal, TypeAlias\n\n"
        "from ._result import Item, Result\n"
    )
    folder = HERE.parent / "docs" / "schemas"
    parts = [Writer(name, json.loads((folder / f"{name}.json").read_text(encoding="utf-8"))).whole() for name in ANSWERS]
    return head + "\n" + "\n\n".join(parts) + "\n"


#: Commands with options as keywords.
COMMANDS = ("balance", "catalogue list", "check", "drive", "export", "fastest", "gentlest", "require", "sensitivity", "simulate",
            "size", "steady")  # fmt: skip


def options() -> str:
    """The keywords of each command; its input and its output are no keywords."""
    head = (
        '"""Options of the commands as keywords. Written by stubs.py from their help."""\n\n'
        "from __future__ import annotations\n\nfrom collections.abc import Sequence\nfrom pathlib import Path\n"
        "from typing import Literal, TypedDict\n\nOption = str | float | Path | Sequence[str | float | Path] | None\n"
    )
    classes = []
    for command in COMMANDS:
        lines = [f"class {camel(command.replace(' ', '-'))}Options(TypedDict, total=False):"]
        shown = _jred.run([*command.split(), "--help"], [])[1]
        _, *blocks = re.split(r"^ +(?:-\w, )?--(?=[a-z])", shown, flags=re.MULTILINE)
        for block in blocks:
            first, about, *_ = (line.strip() for line in block.splitlines())
            name, _, value = first.partition(" ")
            words = re.findall(r"^ +- ([\w-]+)", block, re.MULTILINE)
            kind = f"Literal[{', '.join(map(repr, words))}] | None" if words else "Option" if value else "bool"
            if name not in ("help", "out") and (name != "format" or command == "export"):
                name = name.replace("-", "_")
                lines += [
                    f"    {name}{'_' * iskeyword(name)}: {kind}",
                    f'    """{about.rstrip(".")}."""',
                ]
        classes.append("\n".join(lines))
    return head + "\n" + "\n\n".join(classes) + "\n"


def native(folder: Path) -> str:
    """The generated stub, with the modules that its quoted types name."""
    generated = (folder / "jred" / "_jred.pyi").read_text(encoding="utf-8")
    head, imports, body = generated.partition("from os import")
    return f"{head}import typing\n{imports}{body}".replace("import typing\n", "import numpy.typing\nimport typing\n", 1)


def main() -> None:
    folder = Path(sys.argv[1])
    written = {"_answers.py": text(), "_options.py": options(), "_jred.pyi": native(folder)}
    for name, content in written.items():
        path = HERE / "jred" / name
        if "--check" not in sys.argv:
            path.write_text(content, encoding="utf-8")
        elif path.read_text(encoding="utf-8") != content:
            sys.exit(f"{path} is not what is generated: run `python tests/stubs.py FOLDER`")


main()
