"""ICP of two scans of a CARMEN log, independent of all other scans. Needs Debian's python3-scipy."""
import math

import numpy as np
from scipy.spatial import cKDTree

MAX_RANGE = 20.0  # m
SIGMA = 0.03  # m, width of the kernels
KERNELS = {"Cauchy": lambda e: 1 / (1 + (e / SIGMA) ** 2), "Huber": lambda e: SIGMA / np.maximum(e, SIGMA)}


class Scan:
    def __init__(self, words):
        count = int(words[1])
        ranges, angles = np.array(words[2:2 + count], float), math.pi * (np.arange(count) / (count // 2 * 2) - 0.5)
        points = np.c_[ranges * np.cos(angles), ranges * np.sin(angles)][ranges < MAX_RANGE]
        self.odometry = [float(word) for word in words[count + 5:count + 8]]
        self.points, self.tree = points, cKDTree(points)
        distances, index = self.tree.query(points, k=6)
        near = points[index] - points[index].mean(axis=1, keepdims=True)
        values, vectors = np.linalg.eigh(near.transpose(0, 2, 1) @ near)
        self.normals = vectors[:, :, 0]
        self.is_line = (distances.max(axis=1) < 0.3) & (values[:, 0] < 0.05 * values[:, 1])


def icp(a, b, start, kernel="Cauchy", to_lines=True):
    """Pose of scan b in the frame of scan a; None if the scans do not give it."""
    pose = np.array(start)
    for step in range(40):
        c, s = math.cos(pose[2]), math.sin(pose[2])
        turned = b.points @ np.array([[c, s], [-s, c]])
        gaps, index = a.tree.query(turned + pose[:2])
        used = (gaps < (0.3 if step < 10 else 0.1)) & (a.is_line[index] | (not to_lines))
        if used.sum() < 30:
            return None
        index, turned, gaps = index[used], turned[used], gaps[used]
        errors = turned + pose[:2] - a.points[index]
        jacobian = np.stack([np.tile(np.eye(2)[0], (len(gaps), 1)), np.tile(np.eye(2)[1], (len(gaps), 1)),
                             np.c_[-turned[:, 1], turned[:, 0]]], axis=2)  # point, x and y, pose
        if to_lines:
            normals = a.normals[index]
            errors, jacobian = (errors * normals).sum(axis=1), np.einsum("ij,ijk->ik", normals, jacobian)
            weights = KERNELS[kernel](np.abs(errors))
        else:
            errors, jacobian, weights = errors.ravel(), jacobian.reshape(-1, 3), KERNELS[kernel](gaps).repeat(2)
        information = jacobian.T @ (jacobian * weights[:, None])
        change = np.linalg.solve(information + 1e-9 * np.eye(3), -jacobian.T @ (weights * errors))
        pose = pose + change
        if step > 12 and np.abs(change).max() < 1e-6:
            break
    values = np.linalg.eigvalsh(information[:2, :2])
    return tuple(pose) if values[0] > 0.1 * values.sum() else None  # else a corridor
