"""Numbers and lists that users give, as arrays of one dimension."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import ArrayLike, NDArray


def numbers(name: str, value: ArrayLike, reach: tuple[float, float] | None = None, accepted: str = "") -> NDArray[np.float64]:
    """The array of a number or a list; refused by name, with what is accepted."""
    import numpy as np

    try:
        array: Any = np.atleast_1d(np.asarray(value, dtype=float))
    except (TypeError, ValueError):
        raise ValueError(f"{name} = {value!r}: a number or a list of numbers is accepted") from None
    if array.ndim != 1:
        raise ValueError(f"{name} has {array.ndim} dimensions: a number or a list is accepted")
    if not array.size:
        raise ValueError(f"{name} is empty: a number or a list of at least one is accepted")
    if reach is not None and not np.all((array >= reach[0]) & (array <= reach[1])):
        raise ValueError(f"{name} = {value!r}: {accepted}")
    found: NDArray[np.float64] = array
    return found
