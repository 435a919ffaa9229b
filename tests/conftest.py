"""Settings of all property tests: machines are shared, so no example fails for being slow."""

from __future__ import annotations

import os
import tempfile

from hypothesis import settings

settings.register_profile("fabricate", deadline=None)
settings.load_profile("fabricate")

os.environ["FABRICATE_CACHE"] = tempfile.mkdtemp(prefix="fabricate-cache-")
