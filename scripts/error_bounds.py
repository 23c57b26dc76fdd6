"""Which runs are good and which are lost, for accuracy-table.py and verdict-table.py.

By the mean translation error of the relations (simulated: of the trajectory); DP-SLAM's loop has no reference: by its
revisit error.
"""
BOUNDS = {"killian": (0.3, 0.5), "dpslam": (0.07, 0.07)}  # m


def bounds(log):
    """Below the first error (m) a run is good, above the second it is lost."""
    return next((both for name, both in BOUNDS.items() if name in log), (0.1, 0.3))
