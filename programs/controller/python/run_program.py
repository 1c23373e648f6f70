# SPDX-License-Identifier: MIT
"""Runs a program beside which a copy of Webots' own controller.py lies, with our package in that copy's place.

    run_program.py PROGRAM [ARGUMENT ...]
"""
import os
import runpy
import sys

import controller  # ours: it lies beside this file; from now on the name is taken

sys.argv = sys.argv[1:]
sys.path[0] = os.path.dirname(os.path.abspath(sys.argv[0]))
runpy.run_path(sys.argv[0], run_name="__main__")
