"""Exceptions that keep what a message of jred says."""

from __future__ import annotations


class JredError(ValueError):
    """Input that jred refuses.

    Attributes: ``file``, ``line`` and ``column`` of the place (from 1), its line as ``excerpt``, the ``quantity``
    that is wrong and the ``cure``; each None if the message has none.
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
    ) -> None:
        super().__init__(message)
        self.message = message
        self.cure = cure
        self.quantity = quantity
        self.file = file
        self.line = line
        self.column = column
        self.excerpt = excerpt

    def __str__(self) -> str:
        place = f" ({self.file}, line {self.line}: {self.excerpt})" if self.line else ""
        cure = f"\nhelp: {self.cure}" if self.cure else ""
        return f"{self.message}{place}{cure}"

    def __reduce__(self) -> tuple[object, ...]:
        parts = (self.cure, self.quantity, self.file, self.line, self.column, self.excerpt)
        return (_restored, (self.message, *parts))


def _restored(message: str, *parts: object) -> JredError:
    names = ("cure", "quantity", "file", "line", "column", "excerpt")
    return JredError(message, **dict(zip(names, parts)))  # type: ignore[arg-type]
