# SPDX-License-Identifier: MIT
"""`from webots.controller import Robot`: the package `controller` by another name."""
