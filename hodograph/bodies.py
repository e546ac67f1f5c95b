"""Drag from what a body is, and from the air it flies through."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import Any, overload

import numpy as np
from numpy.typing import ArrayLike

from hodograph.engine import domain
from hodograph.engine.domain import LEAST, MOST, FloatArray, Rule, Scalar

MASS = Rule("in [1e-30, 1e30] kg", lambda a: (a >= LEAST) & (a <= MOST))
AMOUNT = Rule("0 or in [1e-30, 1e30]", lambda a: (a == 0) | ((a >= LEAST) & (a <= MOST)))
TEMPERATURE = Rule(
    "in [228, 334] K (degrees Celsius and 273.15)", lambda a: (a >= 228) & (a <= 334)
)
PRESSURE = Rule("in [3e4, 1.2e5] Pa (100 to the hPa)", lambda a: (a >= 3e4) & (a <= 1.2e5))
HUMIDITY = Rule("in [0, 1] (percent over 100)", lambda a: (a >= 0) & (a <= 1))

R_DRY = 287.05287  # gas constant of dry air, J/(kg K): ISO 2533
LIGHTER = 1 - 18.01528 / 28.9644  # by how much vapour is lighter than dry air, of one volume


@overload
def terminal_speed(k: Scalar, *, g: Scalar = 9.81) -> np.float64: ...
@overload
def terminal_speed(k: ArrayLike, *, g: ArrayLike = 9.81) -> FloatArray: ...
def terminal_speed(k: ArrayLike, *, g: ArrayLike = 9.81) -> Any:
    """Terminal speed of fall under quadratic drag (eq. 12).

    Parameters
    ----------
    k : array_like
        Drag coefficient over mass, lambda/m, in 1/m; ``k >= 0``, and 0 is vacuum.
    g : array_like, optional
        Gravity in m/s^2, positive.

    Returns
    -------
    float or ndarray
        v_lim = sqrt(g / k) in m/s; ``inf`` in vacuum.

    Examples
    --------
    >>> round(float(terminal_speed(0.005376)), 1)  # a baseball, section 3.3 of the paper
    42.7
    """
    shape, (k_, g_) = domain.broadcast(k=(k, domain.NON_NEGATIVE), g=(g, domain.GRAVITY))
    with np.errstate(divide="ignore"):
        return domain.restore(np.sqrt(g_) / np.sqrt(np.abs(k_)), shape)  # abs: of -0.0


@overload
def drag_constant(
    mass: Scalar,
    cd: Scalar,
    *,
    diameter: Scalar | None = None,
    area: Scalar | None = None,
    rho: Scalar = 1.225,
) -> np.float64: ...
@overload
def drag_constant(
    mass: ArrayLike,
    cd: ArrayLike,
    *,
    diameter: ArrayLike | None = None,
    area: ArrayLike | None = None,
    rho: ArrayLike = 1.225,
) -> FloatArray: ...
def drag_constant(
    mass: ArrayLike,
    cd: ArrayLike,
    *,
    diameter: ArrayLike | None = None,
    area: ArrayLike | None = None,
    rho: ArrayLike = 1.225,
) -> Any:
    """Drag coefficient over mass, k = lambda/m = rho cd area / (2 mass), of quadratic drag.

    Parameters
    ----------
    mass : array_like
        In kg, in [1e-30, 1e30].
    cd : array_like
        The drag coefficient, without dimension; 0 is vacuum.
    diameter, area : array_like
        Exactly one of the two: the diameter in m of a round cross-section, or the area in m^2
        that `cd` refers to.
    rho : array_like, optional
        Density of the air in kg/m^3 (see `air_density`); 1.225 is that at sea level in the
        standard atmosphere.

    Returns
    -------
    float or ndarray
        k in 1/m, of the broadcast shape, as `hodograph.Launch.from_drag` and `terminal_speed`
        take it.

    Raises
    ------
    ValueError
        An element is neither 0 (`mass` must not be) nor in [1e-30, 1e30], or the shapes do not
        broadcast.
    TypeError
        An argument is not made of real numbers, or not exactly one of `diameter` and `area` is
        given.

    Examples
    --------
    >>> float(drag_constant(0.145, 0.35, diameter=0.074).round(6))  # kg, m: a baseball
    0.006359
    """
    if (diameter is None) == (area is None):
        given = "neither" if area is None else "both"
        raise TypeError(f"give exactly one of diameter (m) and area (m^2); got {given}")
    size = {"diameter": (diameter, AMOUNT)} if area is None else {"area": (area, AMOUNT)}
    shape, (mass_, cd_, size_, rho_) = domain.broadcast(
        mass=(mass, MASS), cd=(cd, AMOUNT), **size, rho=(rho, AMOUNT)
    )
    section = np.pi / 4 * size_**2 if area is None else size_
    return domain.restore(rho_ * cd_ * section / (2 * mass_), shape)


@overload
def air_density(
    temperature: Scalar = 288.15, pressure: Scalar = 101325.0, humidity: Scalar = 0.0
) -> np.float64: ...
@overload
def air_density(
    temperature: ArrayLike = 288.15, pressure: ArrayLike = 101325.0, humidity: ArrayLike = 0.0
) -> FloatArray: ...
def air_density(
    temperature: ArrayLike = 288.15, pressure: ArrayLike = 101325.0, humidity: ArrayLike = 0.0
) -> Any:
    """Density of moist air, rho = (p - 0.378 e) / (R T), with the pressure e of the vapour.

    Dry air and vapour are taken as ideal gases, and the vapour saturates at
    611.2 exp(17.62 t / (243.12 + t)) Pa, t in degrees Celsius: the formula over water of the
    World Meteorological Organization (WMO-No. 8).

    Parameters
    ----------
    temperature : array_like, optional
        In kelvin, in [228, 334].
    pressure : array_like, optional
        That of the air at the place, not reduced to sea level, in Pa, in [3e4, 1.2e5].
    humidity : array_like, optional
        Relative humidity, from 0 to 1.

    Returns
    -------
    float or ndarray
        The density in kg/m^3, of the broadcast shape: 1.225 by default, the standard atmosphere
        at sea level.  Within 0.25 % of the formula CIPM-2007, and within 0.08 % of it from 0 to
        30 degrees Celsius.

    Raises
    ------
    ValueError
        An element lies outside its range, or the shapes do not broadcast.
    TypeError
        An argument is not made of real numbers.

    Examples
    --------
    >>> float(air_density(273.15 + 30, 83_400.0, 0.2).round(4))  # a warm day, a mile high
    0.9548
    """
    shape, (kelvin, pascal, moist) = domain.broadcast(
        temperature=(temperature, TEMPERATURE),
        pressure=(pressure, PRESSURE),
        humidity=(humidity, HUMIDITY),
    )
    celsius = kelvin - 273.15
    vapour = moist * 611.2 * np.exp(17.62 * celsius / (243.12 + celsius))
    return domain.restore((pascal - LIGHTER * vapour) / (R_DRY * kelvin), shape)


@dataclass(frozen=True)
class Body:
    """A body of sport, and where its numbers come from.

    Attributes
    ----------
    name : str
        What it is.
    mass, diameter, cd : float
        Mass in kg, diameter in m of the cross-section that `cd` refers to, drag coefficient.
    rules : str
        Whose rules say what mass and diameter may be, and what they say.
    measured : str
        Where the drag coefficient comes from.
    """

    name: str
    mass: float
    diameter: float
    cd: float
    rules: str
    measured: str

    def k(self, rho: float = 1.225) -> np.float64:
        """Drag coefficient over mass in 1/m, in air of density `rho` in kg/m^3.

        Returns
        -------
        float
            `drag_constant` of this body.

        Examples
        --------
        >>> float(CATALOGUE["golf"].k().round(5))
        0.00477
        """
        return drag_constant(self.mass, self.cd, diameter=self.diameter, rho=rho)

    def v_lim(self, g: float = 9.81, rho: float = 1.225) -> np.float64:
        """Terminal speed of fall in m/s, under gravity `g` and in air of density `rho`.

        Returns
        -------
        float
            `terminal_speed` of this body.

        Examples
        --------
        >>> float(CATALOGUE["shuttlecock"].v_lim().round(2))
        6.87
        """
        return terminal_speed(self.k(rho), g=g)


_SMOOTH = "smooth sphere: about 0.5 for Re < 2e5 (Achenbach, J. Fluid Mech. 54, 565, 1972)"
CATALOGUE: Mapping[str, Body] = MappingProxyType(
    {
        "baseball": Body(
            "baseball", 0.145, 0.0737, 0.35,
            "Official Baseball Rules 3.01: 5 to 5.25 oz, circumference 9 to 9.25 in",
            "in play 0.33 to 0.35, of which 0.01 is 3 % (committee on home runs, MLB, 2018)",
        ),
        "basketball": Body(
            "basketball, size 7", 0.6, 0.242, 0.5,
            "FIBA, Official Basketball Rules, equipment: 580 to 620 g, circumference 75 to 77 cm",
            _SMOOTH,
        ),
        "golf": Body(
            "golf ball", 0.04593, 0.04267, 0.25,
            "R&A and USGA, Equipment Rules: at most 45.93 g, at least 42.67 mm",
            "dimpled, without spin, Re > 6e4 (Bearman and Harvey, Aeronaut. Q. 27, 112, 1976)",
        ),
        "javelin": Body(
            "men's javelin as a point", 0.8, 0.0275, 1.1,
            "World Athletics: at least 800 g, 2.6 to 2.7 m long, 25 to 30 mm thick",
            "an estimate, point first: turbulent friction (Prandtl and Schlichting) of 0.19 m^2",
        ),
        "shot": Body(
            "men's shot", 7.26, 0.12, 0.5,
            "World Athletics: at least 7.26 kg, 110 to 130 mm",
            _SMOOTH,
        ),
        "shuttlecock": Body(
            "feather shuttlecock", 0.005, 0.06, 0.6,
            "BWF, Laws of Badminton 2: 4.74 to 5.50 g, 58 to 68 mm across the tips",
            "Cohen et al., New J. Phys. 17, 063001 (2015): 0.6 on 28 cm^2",
        ),
        "soccer": Body(
            "soccer ball", 0.43, 0.22, 0.2,
            "IFAB, Laws of the Game 2: 410 to 450 g, circumference 68 to 70 cm",
            "fast, Re > 3e5: 0.15 to 0.2 (Asai et al., Sports Eng. 10, 101, 2007); slower 0.5",
        ),
        "table-tennis": Body(
            "table tennis ball", 0.0027, 0.04, 0.44,
            "ITTF, Laws 2.3: 2.7 g, 40 mm",
            "smooth sphere in Newton's regime, 750 < Re < 2e5 (Bird, Stewart and Lightfoot)",
        ),
        "tennis": Body(
            "tennis ball", 0.0577, 0.067, 0.51,
            "ITF, Rules of Tennis, appendix I: 56.0 to 59.4 g, 6.54 to 6.86 cm",
            "in flight 0.507 (Cross and Lindsey, Sports Eng. 17, 89, 2014); in tunnels 0.6",
        ),
    }
)  # fmt: skip
"""Bodies of sport by name, read-only.  Typical, without spin, at the speeds of play: a drag
coefficient is known to a tenth or so, and changes with speed, spin, seams and wear."""
