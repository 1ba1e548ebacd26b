"""Bars of long calls, by tqdm where it is installed."""

from __future__ import annotations

import sys
from contextlib import contextmanager
from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator


@contextmanager
def bar(total: int, unit: str, wanted: bool | None) -> Iterator[Callable[[int], None] | None]:
    """What is told how many are done; nothing where no bar is wanted."""
    quiet = wanted is False or (wanted is None and (total < 2 or not sys.stderr.isatty()))
    tqdm: Any = None
    if not quiet:
        try:
            tqdm = import_module("tqdm.auto").tqdm
        except ImportError:
            if wanted:
                raise ImportError("progress = True needs tqdm: pip install tqdm") from None
    if tqdm is None:
        yield None
        return
    with tqdm(total=total, unit=unit) as shown:
        yield lambda done: shown.update(done - shown.n)
