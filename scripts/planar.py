"""Poses and motions in the plane, (x, y, heading): m, m, rad. Headings are not wrapped."""
import math


def compose(a, b):
    """The pose that is b in the frame of pose a."""
    c, s = math.cos(a[2]), math.sin(a[2])
    return a[0] + c * b[0] - s * b[1], a[1] + s * b[0] + c * b[1], a[2] + b[2]


def inverse(a):
    c, s = math.cos(a[2]), math.sin(a[2])
    return -c * a[0] - s * a[1], s * a[0] - c * a[1], -a[2]


def between(a, b):
    """Pose b in the frame of pose a."""
    c, s, x, y = math.cos(a[2]), math.sin(a[2]), b[0] - a[0], b[1] - a[1]
    return c * x + s * y, c * y - s * x, b[2] - a[2]
