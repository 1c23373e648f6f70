# SPDX-License-Identifier: MIT
"""Which runs the words of --seeds, --hal and --selector mean."""
import pytest

from twinpuck import _matrix

AXES = {axis.name: axis for axis in _matrix.AXES}
SEEDS = "expected numbers from 0 to 999999999999999999, such as 0..9 or 0,1"


@pytest.mark.parametrize("axis, text, values", [
    ("seed", None, []), ("seed", "7", [7]), ("seed", "1..3", [1, 2, 3]), ("seed", "3..3", [3]), ("seed", "1, 5,2..3", [1, 5, 2, 3]),
    ("seed", "2,1,2,1..2", [2, 1]), ("seed", "0", [0]), ("seed", "999999999999999999", [10**18 - 1]),
    ("hal", "sim", ["sim"]), ("hal", "dspic,sim,dspic", ["dspic", "sim"]), ("selector", "0..15", list(range(16)))])
def test_words_mean_values_each_once(axis, text, values):
    assert AXES[axis].values(text) == values


@pytest.mark.parametrize("axis, text, said", [
    ("seed", "5..4", f"--seeds: got '5..4', {SEEDS}"), ("seed", "-1", f"--seeds: got '-1', {SEEDS}"), ("seed", "", f"--seeds: got '', {SEEDS}"),
    ("seed", "1000000000000000000", f"--seeds: got '1000000000000000000', {SEEDS}"), ("seed", "1..", f"--seeds: got '1..', {SEEDS}"),
    ("seed", "1..100001", f"--seeds: got '1..100001', {SEEDS}"),
    ("seed", "1..60000,100001..160000", "--seeds: got 120000 runs, expected at most 100000"),
    ("hal", "chip", "--hal: got 'chip', expected sim or dspic"),
    ("selector", "16", "--selector: got '16', expected numbers from 0 to 15, such as 0..9 or 0,1")])
def test_what_means_nothing_is_refused(axis, text, said):
    with pytest.raises(ValueError) as wrong:
        AXES[axis].values(text)
    assert str(wrong.value) == said


def test_a_marker_may_have_numbers_texts_and_lists():
    assert AXES["seed"].marked([1, "3..4", [7, (8, 1)]]) == [1, 3, 4, 7, 8]
    assert AXES["seed"].marked(None) == []
