"""Points and directions in space: three numbers x, y, z."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Annotated, cast

from pydantic import BeforeValidator
from pydantic_core import PydanticCustomError

from catenaria.units import Length


def _three(value: object) -> object:
    is_list = isinstance(value, Sequence) and not isinstance(value, str)
    if not is_list or len(cast("Sequence[object]", value)) != 3:
        raise PydanticCustomError("value", "{allowed}", {"allowed": "a list of three: x, y, z"})
    return cast("Sequence[object]", value)


Point = Annotated[tuple[Length, Length, Length], BeforeValidator(_three)]
Direction = Annotated[tuple[float, float, float], BeforeValidator(_three)]
