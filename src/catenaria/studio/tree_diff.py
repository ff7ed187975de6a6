"""What two trees of a line file have in common."""

from __future__ import annotations

from collections.abc import Hashable, Sequence
from typing import Final, cast

Pair = tuple[int | None, int | None]

_MOST_PAIRED: Final = 250_000  # 500 items with 500 others


def same(one: object, other: object) -> bool:
    """Return whether two values say the same in a file: 65 and 65.0 do, 1 and true do not.

    Examples
    --------
    >>> same({"a": [65]}, {"a": [65.0]}), same(1, True), same(1, "1")
    (True, False, False)
    """
    return one is other or _token(one) == _token(other)


def aligned(old: Sequence[object], new: Sequence[object]) -> list[Pair]:
    """Pair the items of two lists, so that as few as possible are changed, taken away or added.

    Returns
    -------
    list of pairs
        Index in the old list, or None for one that is added; index in the new one, or None for one that is
        taken away.

    Examples
    --------
    >>> aligned("abcd", "aXcd"), aligned("abc", "ac"), aligned("ab", "aab")
    ([(0, 0), (1, 1), (2, 2), (3, 3)], [(0, 0), (1, None), (2, 1)], [(0, 0), (None, 1), (1, 2)])
    """
    shorter = min(len(old), len(new))
    head = next((i for i in range(shorter) if not same(old[i], new[i])), shorter)
    rest = shorter - head
    tail = next((i for i in range(rest) if not same(old[-1 - i], new[-1 - i])), rest)
    one = [_token(item) for item in old[head : len(old) - tail]]
    middle = _middle(one, [_token(item) for item in new[head : len(new) - tail]])
    return [
        *((i, i) for i in range(head)),
        *((None if i is None else i + head, None if j is None else j + head) for i, j in middle),
        *((len(old) - i, len(new) - i) for i in range(tail, 0, -1)),
    ]


def _middle(old: list[Hashable], new: list[Hashable]) -> list[Pair]:
    """Pair items by the least number of changes (Wagner and Fischer 1974); of equal ones the first counts.

    Items of long lists are paired in their order instead, because the table would be large.
    """
    if len(old) * len(new) > _MOST_PAIRED:
        many = range(max(len(old), len(new)))
        return [(i if i < len(old) else None, i if i < len(new) else None) for i in many]
    cost = [[len(old) - i + len(new) - j for j in range(len(new) + 1)] for i in range(len(old) + 1)]
    for i in reversed(range(len(old))):
        for j in reversed(range(len(new))):
            changed = cost[i + 1][j + 1] + (old[i] != new[j])
            cost[i][j] = min(changed, 1 + cost[i + 1][j], 1 + cost[i][j + 1])
    pairs: list[Pair] = []
    i = j = 0
    while i < len(old) or j < len(new):
        if i < len(old) and j < len(new) and cost[i][j] == cost[i + 1][j + 1] + (old[i] != new[j]):
            pairs.append((i, j))
            i, j = i + 1, j + 1
        elif i < len(old) and cost[i][j] == 1 + cost[i + 1][j]:
            pairs.append((i, None))
            i += 1
        else:
            pairs.append((None, j))
            j += 1
    return pairs


def _token(value: object) -> Hashable:
    if isinstance(value, dict):
        fields = cast("dict[str, object]", value)
        return frozenset((key, _token(item)) for key, item in fields.items())
    if isinstance(value, list):
        return tuple(_token(item) for item in cast("list[object]", value))
    if isinstance(value, bool):
        return (bool, value)
    if isinstance(value, int | float):  # not a number is equal to nothing, not even to itself
        return (float, value if value == value else "nan")
    return cast("Hashable", value)
