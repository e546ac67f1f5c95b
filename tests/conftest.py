"""What every test shares: no display, and a fixed search in CI."""

import os

from hypothesis import settings

# An environment variable, so that it reaches the commands that tests start as well.
os.environ["MPLBACKEND"] = "Agg"

# No deadline: the first call in a process pays for imports. In CI the same examples
# come every time, so that a red run is about the change and not about luck.
settings.register_profile("local", deadline=None)
settings.register_profile("ci", deadline=None, derandomize=True, print_blob=True)
settings.load_profile("ci" if os.environ.get("CI") else "local")
