"""Runs function blocks of Structured Text over the tree of blark: enough of IEC 61131-3 for the blocks of ``jred export``.

It is as strict as the strictest PLC: no conversion between types that is not written, no division by zero, no index beyond an array, no
name twice in different letter cases, AND and OR evaluate both sides.
"""

from __future__ import annotations

import operator
import re
from collections.abc import Callable
from functools import cache
from typing import Any

from blark.parse import parse_source_code

#: An array constant with its numbers. blark takes minutes for arrays of some hundred numbers: they are read here.
ARRAY = re.compile(r"(\w+) : ARRAY\[0\.\.(\d+)\] OF LREAL := \[([^\]]*)\]")

Scope = dict[str, Any]
Run = Callable[[Scope], Any]


class _Return(Exception):
    pass


def arrays(text: str) -> dict[str, list[float]]:
    """The arrays of a text by name, after a check of their lengths and lines."""
    found = {}
    for name, last, numbers in ARRAY.findall(text):
        for line in numbers.strip().splitlines():
            assert line.count(",") <= 32, "a line of more than 32 numbers"
        literals = numbers.replace("\n", " ").split(",")
        assert all(re.fullmatch(r"\s*-?\d+\.\d+(E-?\d+)?\s*", literal) for literal in literals)
        assert len(literals) == int(last) + 1
        found[name.lower()] = [float(literal) for literal in literals]
    return found


def _same(a: Any, b: Any) -> tuple[Any, Any]:
    assert type(a) is type(b), f"a PLC does not convert {a!r} to the type of {b!r}"
    return a, b


def _divided(a: float, b: float) -> float:
    assert type(a) is float and b != 0.0, "division by zero, or of integers"
    return a / b


def _truncated(x: float) -> int:
    assert type(x) is float and abs(x) < 2**31, f"TRUNC of {x}"
    return int(x)


def _real(x: int) -> float:
    assert type(x) is int
    return float(x)


BINARY = {
    "+": operator.add,
    "-": operator.sub,
    "*": operator.mul,
    "/": _divided,
    "<": operator.lt,
    ">": operator.gt,
    "<=": operator.le,
    ">=": operator.ge,
    "=": operator.eq,
    "<>": operator.ne,
    "AND": lambda a, b: a and b,
    "OR": lambda a, b: a or b,
}
FUNCTIONS: dict[str, Callable[..., Any]] = {
    "abs": abs,
    "trunc": _truncated,
    "dint_to_lreal": _real,
    "min": lambda a, b: min(*_same(a, b)),
    "max": lambda a, b: max(*_same(a, b)),
}
START = {"LREAL": 0.0, "DINT": 0, "UINT": 0, "BOOL": False}


def _integer(value: int) -> Run:
    return lambda _: value


class Block:
    """An instance of a function block: call it with its inputs, read its variables as attributes."""

    def __init__(self, of: _Type, types: dict[str, _Type]) -> None:
        self._type = of
        self._scope: Scope = {}
        for name, (kind, value) in of.variables.items():
            self._scope[name] = Block(types[kind.lower()], types) if kind.lower() in types else value

    def __call__(self, **inputs: Any) -> Block:
        for name, value in inputs.items():
            assert name.lower() in self._type.inputs, f"{name} is no input"
            _same(self._scope[name.lower()], value)
            self._scope[name.lower()] = value
        try:
            for statement in self._type.body:
                statement(self._scope)
        except _Return:
            pass
        return self

    def __getattr__(self, name: str) -> Any:
        if name.startswith("_"):
            raise AttributeError(name)
        return self._scope[name.lower()]


class _Type:
    """A function block as closures."""

    def __init__(self, tree: Any, constants: dict[str, list[float]]) -> None:
        self.variables: dict[str, tuple[str, Any]] = {}
        self.inputs: set[str] = set()
        self.constants: set[str] = set()
        for group in tree.declarations:
            constant = "CONSTANT" in str(getattr(group, "attrs", "") or "").upper()
            for item in group.items:
                kind = str(item.init.full_type_name)
                for declared in item.variables:
                    name = str(getattr(declared, "variable", declared).name).lower()
                    assert name not in self.variables, f"{name} twice: letter case does not count"
                    value = START.get(kind)
                    if item.init.value is not None:
                        value = constants[name] if name in constants else self._expression(item.init.value)({})
                        assert name in constants or type(value) is type(START[kind]), f"{name}: {value!r} is no {kind}"
                    self.variables[name] = (kind, value)
                    if type(group).__name__ == "InputDeclarations":
                        self.inputs.add(name)
                    if constant:
                        self.constants.add(name)
        self.body = self._statements(tree.body)

    def _statements(self, tree: Any) -> list[Run]:
        return [getattr(self, "_" + type(item).__name__)(item) for item in (tree.statements if tree else [])]

    def _block(self, tree: Any) -> Run:
        statements = self._statements(tree)

        def run(scope: Scope) -> None:
            for statement in statements:
                statement(scope)

        return run

    def _AssignmentStatement(self, item: Any) -> Run:
        (target,) = item.variables
        name, value = str(target.name).lower(), self._expression(item.expression)
        assert name in self.variables and name not in self.constants, f"{name} is no variable"

        def run(scope: Scope) -> None:
            found = value(scope)
            _same(scope[name], found)
            scope[name] = found

        return run

    def _IfStatement(self, item: Any) -> Run:
        parts = [(item.if_expression, item.statements), *[(other.if_expression, other.statements) for other in item.else_ifs]]
        cases = [(self._expression(test), self._block(body)) for test, body in parts]
        last = self._block(item.else_clause.statements if item.else_clause else None)

        def run(scope: Scope) -> None:
            for test, body in cases:
                found = test(scope)
                assert type(found) is bool
                if found:
                    return body(scope)
            return last(scope)

        return run

    def _ForStatement(self, item: Any) -> Run:
        name, body = str(item.control.name).lower(), self._block(item.statements)
        ends = [self._expression(end) for end in (item.from_, item.to)]
        step = self._expression(item.step) if item.step else _integer(1)

        def run(scope: Scope) -> None:
            first, last = (end(scope) for end in ends)
            for value in range(first, last + 1, step(scope)):
                scope[name] = value
                body(scope)

        return run

    def _ReturnStatement(self, _: Any) -> Run:
        def run(_: Scope) -> None:
            raise _Return

        return run

    def _FunctionCallStatement(self, item: Any) -> Run:
        name = str(item.name.name).lower()
        inputs = {str(given.name.name): self._expression(given.value) for given in item.parameters}
        return lambda scope: scope[name](**{key: value(scope) for key, value in inputs.items()})

    def _expression(self, item: Any) -> Run:
        return getattr(self, "_" + type(item).__name__)(item)

    def _TypeInitialization(self, item: Any) -> Run:
        return self._expression(item.value)

    def _Real(self, item: Any) -> Run:
        value = float(item.value)
        return lambda _: value

    def _Integer(self, item: Any) -> Run:
        return _integer(int(item.value))

    def _Boolean(self, item: Any) -> Run:
        value = str(item.value).upper() == "TRUE"
        return lambda _: value

    def _SimpleVariable(self, item: Any) -> Run:
        name = str(item.name).lower()
        if name in ("true", "false"):
            return lambda _: name == "true"
        assert name in self.variables, f"{name} is not declared"
        return lambda scope: scope[name]

    def _MultiElementVariable(self, item: Any) -> Run:
        (element,) = item.elements
        name = str(getattr(item.name, "name", item.name)).lower()
        assert name in self.variables, f"{name} is not declared"
        if hasattr(element, "field"):
            field = str(element.field.name)
            return lambda scope: getattr(scope[name], field)
        (subscript,) = element.subscripts
        index = self._expression(subscript)

        def run(scope: Scope) -> Any:
            place = index(scope)
            assert type(place) is int and 0 <= place < len(scope[name]), f"{name}[{place}]"
            return scope[name][place]

        return run

    def _ParenthesizedExpression(self, item: Any) -> Run:
        return self._expression(item.expr)

    def _UnaryOperation(self, item: Any) -> Run:
        value, op = self._expression(item.expr), str(item.op).upper()
        return {"-": lambda scope: -value(scope), "NOT": lambda scope: not value(scope)}[op]

    def _BinaryOperation(self, item: Any) -> Run:
        left, right = self._expression(item.left), self._expression(item.right)
        apply = BINARY[str(item.op).upper()]
        return lambda scope: apply(*_same(left(scope), right(scope)))

    def _FunctionCall(self, item: Any) -> Run:
        function = FUNCTIONS[str(item.name.name).lower()]
        values = [self._expression(given.value) for given in item.parameters]
        return lambda scope: function(*[value(scope) for value in values])


@cache
def blocks(text: str) -> dict[str, Callable[[], Block]]:
    """The function blocks of a text by name; each call makes an instance."""
    parsed = parse_source_code(ARRAY.sub(r"\1 : ARRAY[0..\2] OF LREAL := [0.0]", text))
    assert parsed.exception is None, parsed.exception
    trees = parsed.transform().items
    ends = [end.start() for end in re.finditer(r"^END_FUNCTION_BLOCK", text, re.M)]
    assert len(ends) == len(trees)
    types: dict[str, _Type] = {}
    for tree, start, end in zip(trees, [0, *ends], ends):
        types[str(tree.name).lower()] = _Type(tree, arrays(text[start:end]))
    return {name: (lambda of=of: Block(of, types)) for name, of in types.items()}
