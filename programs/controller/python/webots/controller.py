# SPDX-License-Identifier: MIT
"""The package `controller` by another name."""
from controller import *  # noqa: F401,F403
from controller import __all__  # noqa: F401
