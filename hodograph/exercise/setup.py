"""The exercise's constants in one record, and its launches.

Names in French are the exercise's.
"""

import math
from dataclasses import dataclass, fields

import numpy as np
from numpy.typing import ArrayLike

from hodograph import steppers
from hodograph.engine.domain import FloatArray
from hodograph.launch import Launch
from hodograph.steppers import Flights


@dataclass(frozen=True)
class Setup:
    """What the exercise computes with; the defaults are its own.

    The first seven may be changed at will.  The others belong to single questions, and tests
    shorten them.

    >>> moon = Setup(g=1.62)
    >>> round(float(moon.launch(drag=moon.eta).range()), 1)
    2120.2
    """

    mass: float = 1.0  # kg, MASSE
    v0: float = 70.0  # m/s
    dt: float = 0.001  # s
    eta: float = 0.01  # kg/s
    lambda_: float = 0.1  # kg/m, 6.8
    angle: float = 45.0  # degrees, 6.3 and 6.8
    g: float = 9.81  # m/s²

    figure_lambda: float = 0.001  # kg/m, figure 1
    figure_degrees: tuple[float, ...] = (30.0, 45.0, 60.0)  # figure 1 names no angles
    delta_1: float = 1.0  # s, the DT of 6.6
    ratio: float = 1.1  # a of (18)
    limit: float = 0.1  # m, where the loop of 6.6 ends
    most: int = 80  # the greatest n that it tries
    reference_dt: float = 0.0001  # s, SciPy's in 6.6
    energy_dt: float = 0.075  # s, 6.7
    energy_degrees: float = 60.0  # 6.7

    def __post_init__(self) -> None:
        """Refuse, in one line, constants with which the questions make no sense."""
        for name in (field.name for field in fields(self)[:7]):
            if not 0 < getattr(self, name) < math.inf:
                raise ValueError(f"{name} must be finite and > 0; got {getattr(self, name)}")
        if not self.angle < 90:
            raise ValueError(f"angle must be below 90°; got {self.angle:g}°")
        if not 1 <= self.v0 / self.g <= 50:
            raise ValueError(
                f"v0 / g must be from 1 to 50 s, for flights that 6.6 and 6.7 can follow in their "
                f"steps; got {self.v0 / self.g:.3g} s"
            )
        most = min(2 / max(self.rates), self.vacuum_time / 20)
        least = self.v0 / self.g / 1e5
        if not least <= self.dt <= most:
            raise ValueError(
                f"dt must be from {least:.1g} s (a longer wait teaches nothing) to {most:.3g} s "
                f"(a twentieth of the flight, and stable for both drags); got {self.dt:g} s"
            )

    @property
    def theta(self) -> float:
        """The launch angle in radians."""
        return math.radians(self.angle)

    @property
    def rates(self) -> tuple[float, float]:
        """Rates at which linear and quadratic drag damp a change of the launch speed, 1/s."""
        return self.eta / self.mass, 2 * self.lambda_ * self.v0 / self.mass

    @property
    def angles(self) -> FloatArray:
        """The 91 angles of 6.5 and 6.6, in degrees."""
        return np.arange(91.0)

    @property
    def vacuum_time(self) -> float:
        """Time of flight at `theta` without drag, s."""
        return 2 * self.v0 * math.sin(self.theta) / self.g

    @property
    def vacuum_range(self) -> float:
        """Distance at `theta` without drag, m."""
        return self.v0**2 * math.sin(2 * self.theta) / self.g

    def launch(self, theta: ArrayLike | None = None, drag: ArrayLike = 0.0, n: int = 1) -> Launch:
        """The exercise's launch for a force ``drag * v**n`` against the motion; 0 is vacuum.

        `theta` is in radians; the drag is eta in kg/s for n = 1, lambda in kg/m for n = 2.
        """
        angle = self.theta if theta is None else theta
        return Launch.from_drag(self.v0, angle, np.divide(drag, self.mass), n=n, g=self.g)

    def fan(self, drag: float, n: int = 1) -> Launch:
        """The same at all 91 angles."""
        return self.launch(np.deg2rad(self.angles), drag, n)


def steps(scene: Launch, method: str, dt: float, *, history: bool = False) -> Flights:
    """A launch in steps of dt by one of `steppers.METHODS`.

    >>> setup = Setup()
    >>> round(float(steps(setup.launch(drag=0.01), "euler", setup.dt).impact_naive.x), 3)
    467.762
    """
    return steppers.integrate(
        scene.v0,
        scene.alpha0,
        scene.v_lim,
        dt=dt,
        method=method,
        n=float(np.max(scene.n)),  # one for all
        g=scene.g,
        height=scene.height,
        history=history,
    )
