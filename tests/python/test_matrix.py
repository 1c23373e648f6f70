# SPDX-License-Identifier: MIT
"""Which runs the words of --seeds, --hal and --selector mean."""
import pytest

from twinpuck import _matrix

AXES = {axis.name: axis for axis in _matrix.AXES}


@pytest.mark.parametrize("axis, text, values", [
    ("seed", None, []), ("seed", "7", [7]), ("seed", "1..3", [1, 2, 3]), ("seed", "3..3", [3]), ("seed", "1, 5,2..3", [1, 5, 2, 3]),
    ("seed", "2,1,2,1..2", [2, 1]), ("seed", "0", [0]), ("seed", "999999999999999999", [10**18 - 1]),
    ("hal", "sim", ["sim"]), ("hal", "dspic,sim,dspic", ["dspic", "sim"]), ("selector", "0..15", list(range(16)))])
def test_words_mean_values_each_once(axis, text, values):
    assert AXES[axis].values(text) == values


def test_a_marker_may_have_numbers_texts_and_lists():
    assert AXES["seed"].marked([1, "3..4", [7, (8, 1)]]) == [1, 3, 4, 7, 8]
    assert AXES["seed"].marked(None) == []
