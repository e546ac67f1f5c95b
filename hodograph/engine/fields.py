"""The scene of a launch: its fields, checked and broadcast, and what they do as an array does."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import KW_ONLY, dataclass, replace
from typing import Any, Generic, Required, Self, TypedDict

import numpy as np
from numpy.typing import ArrayLike

from hodograph.engine import domain, one, power
from hodograph.engine.domain import FloatArray, Scalar, T
from hodograph.engine.record import Record

FIELDS = ("v0", "alpha0", "v_lim", "g", "height", "n", "slope", "wind", "crosswind")
LEVEL_AND_CALM = 0.0, 0.0, 0.0
# Defaults, of no type of their own: they become scalars or arrays, as the other fields are.
QUADRATIC: Any = 2.0
EARTH: Any = 9.81  # m/s^2
NONE: Any = 0.0


class Surroundings(TypedDict, total=False):
    """Where a launch takes place, of one."""

    g: Scalar
    height: Scalar
    slope: Scalar
    wind: Scalar
    crosswind: Scalar


class ManySurroundings(TypedDict, total=False):
    """The same, of many."""

    g: ArrayLike
    height: ArrayLike
    slope: ArrayLike
    wind: ArrayLike
    crosswind: ArrayLike


class Options(Surroundings, total=False):
    """What a launch takes by keyword."""

    n: Scalar


class ManyOptions(ManySurroundings, total=False):
    """The same, of many."""

    n: ArrayLike


class Body(Surroundings, total=False):
    """A body, and where it is launched."""

    mass: Required[Scalar]
    cd: Required[Scalar]
    diameter: Scalar
    area: Scalar
    rho: Scalar


class ManyBodies(ManySurroundings, total=False):
    """The same, of many."""

    mass: Required[ArrayLike]
    cd: Required[ArrayLike]
    diameter: ArrayLike
    area: ArrayLike
    rho: ArrayLike


class Place(TypedDict, total=False):
    """One of these, where a path is asked for."""

    t: Scalar
    x: Scalar
    y: Scalar
    s: Scalar
    alpha: Scalar


class Places(TypedDict, total=False):
    """The same, of many."""

    t: ArrayLike
    x: ArrayLike
    y: ArrayLike
    s: ArrayLike
    alpha: ArrayLike


@dataclass(frozen=True, eq=False, repr=False)
class Scene(Record, Generic[T]):
    """What `hodograph.Launch` holds."""

    v0: T
    alpha0: T
    v_lim: T
    _: KW_ONLY
    n: T = QUADRATIC
    g: T = EARTH
    height: T = NONE
    slope: T = NONE
    wind: T = NONE
    crosswind: T = NONE

    def __post_init__(self) -> None:
        """Check the fields and broadcast them."""
        plain: tuple[Any, ...] = self.v0, self.alpha0, self.v_lim, self.g, self.height, self.n
        ground: tuple[Any, ...] = self.slope, self.wind, self.crosswind
        if one.are_plain(ground) and ground == LEVEL_AND_CALM and one.is_legal(*plain):
            for name, value in zip(FIELDS, plain + ground, strict=True):
                self.__dict__[name] = np.float64(value)
            return
        shape, arrays = domain.broadcast(
            v0=(self.v0, domain.LAUNCH_SPEED),
            alpha0=(self.alpha0, domain.SLOPE_ANGLE),
            v_lim=(self.v_lim, domain.TERMINAL_SPEED),
            g=(self.g, domain.GRAVITY),
            height=(self.height, domain.HEIGHT),
            n=(self.n, power.EXPONENT),
            slope=(self.slope, domain.GROUND),
            wind=(self.wind, domain.WIND),
            crosswind=(self.crosswind, domain.WIND),
        )
        v0, _, v_lim, g, height, _, _, wind, crosswind = arrays
        domain.check_scene(v0, v_lim, g, height)
        domain.check_wind(v_lim, wind=wind, crosswind=crosswind)
        state = {
            name: domain.restore(array, shape) for name, array in zip(FIELDS, arrays, strict=True)
        }
        self.__setstate__(state)

    def __setstate__(self, state: dict[str, Any]) -> None:
        """Take the fields, read-only: also those that a copy or a pickle brings."""
        for value in state.values():
            if isinstance(value, np.ndarray):
                value.flags.writeable = False
        self.__dict__.update(state)

    def __bool__(self) -> bool:
        """True, as of any object, whatever its length."""
        return True

    def __len__(self) -> int:
        """Launches along the first axis."""
        return int(np.shape(self._elements())[0])

    def __iter__(self) -> Iterator[Self]:
        """The launches along the first axis, one by one."""
        return (self[index] for index in range(len(self)))

    def __getitem__(self, index: Any) -> Self:
        """Some of the launches, by any index that an array of their shape takes."""
        self._elements()
        return replace(self, **{name: getattr(self, name)[index] for name in FIELDS})

    def _elements(self) -> FloatArray:
        if np.ndim(self.v0) == 0:
            raise TypeError("this launch is a single one: it has no length, elements or index")
        return np.asarray(self.v0)

    @property
    def is_bare(self) -> bool:
        """Whether all the ground is level, and all the air still."""
        return not (np.any(self.slope) or np.any(self.wind) or np.any(self.crosswind))
