"""Exceptions that keep what a message of jred says."""

from __future__ import annotations


class JredError(ValueError):
    """Input that jred refuses.

    Attributes: ``file``, ``line`` and ``column`` of the place (from 1), its line as ``excerpt`` with a remark as ``label``,
    the ``quantity`` or key that the message names, and the ``cure``; None where the message has no such part.
    """

    def __init__(
        self,
        message: str,
        *,
        cure: str | None = None,
        quantity: str | None = None,
        file: str | None = None,
        line: int | None = None,
        column: int | None = None,
        excerpt: str | None = None,
        label: str | None = None,
    ) -> None:
        super().__init__(message)
        self.message = message
        self.cure = cure
        self.quantity = quantity
        self.file = file
        self.line = line
        self.column = column
        self.excerpt = excerpt
        self.label = label

    def __str__(self) -> str:
        place = f" ({self.file}, line {self.line}: {self.excerpt})" if self.line else ""
        label = f": {self.label}" if self.label else ""
        cure = f"\nhelp: {self.cure}" if self.cure else ""
        return f"{self.message}{place}{label}{cure}"

    def __reduce__(self) -> tuple[object, ...]:
        parts = (self.cure, self.quantity, self.file, self.line, self.column, self.excerpt, self.label)
        return (_restored, (self.message, *parts))


def _restored(message: str, *parts: object) -> JredError:
    names = ("cure", "quantity", "file", "line", "column", "excerpt", "label")
    return JredError(message, **dict(zip(names, parts)))  # type: ignore[arg-type]
