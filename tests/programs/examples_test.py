# SPDX-License-Identifier: MIT
"""examples_test.py BUILD: the examples of examples/webots run, and do what their pages say."""
import os
import re
import subprocess
import sys
import unittest

from fake_simulator import ROOT

BUILD = os.path.abspath(sys.argv.pop(1))
EXAMPLES = os.path.join(ROOT, "examples", "webots")


def has_numpy(interpreter):
    return subprocess.run([interpreter, "-c", "import numpy"], capture_output=True).returncode == 0


class Examples(unittest.TestCase):
    def run_world(self, name, seconds):
        run = subprocess.run([BUILD + "/twinpuck", "run", "%s/%s/%s.toml" % (EXAMPLES, name, name), "--for", str(seconds)],
                             capture_output=True, text=True, timeout=900)
        self.assertEqual(run.returncode, 0, run.stdout + run.stderr)
        return run.stdout + run.stderr

    def test_both_avoid_obstacles(self):
        said = self.run_world("obstacle", 30)
        self.assertIn("c: drove for 30 s", said)
        self.assertIn("python: drove for 30 s", said)
        for robot in ("c", "python"):
            path, collisions = re.search(r"^%s .* deg +([\d.]+) +(\d+)" % robot, said, re.M).groups()
            self.assertGreater(float(path), 2.0)  # it drove on, at 80 mm/s
            self.assertLess(int(collisions), 5)

    @unittest.skipUnless(has_numpy("python3"), "no NumPy here; apt install python3-numpy")
    def test_the_follower_sees_its_leader(self):
        said = self.run_world("follow", 30)
        self.assertGreater(int(re.search(r"saw it in (\d+) % of 46\d pictures", said)[1]), 80)

    @unittest.skipUnless(has_numpy("python3"), "no NumPy here; apt install python3-numpy")
    def test_weights_evolve_on_all_cores(self):
        best = EXAMPLES + "/evolve/best.npy"
        had = os.path.exists(best)
        run = subprocess.run(["python3", EXAMPLES + "/evolve/evolve.py", "--twinpuck", BUILD + "/twinpuck", "--generations", "3",
                              "--population", "8", "--cores", "2"], capture_output=True, text=True, timeout=900)
        if not had and os.path.exists(best):
            os.remove(best)
        self.assertEqual(run.returncode, 0, run.stdout + run.stderr)
        means = [float(m) for m in re.findall(r"mean ([\d.]+)", run.stdout)]
        self.assertEqual(len(means), 3)
        self.assertGreater(means[2], means[0])
        self.assertIn("24 trials", run.stdout)


if __name__ == "__main__":
    unittest.main()
