"""Composes a matrix from scale, shear, angles, translation and perspective, and decomposes it."""

from __future__ import annotations

from typing import Any

import numpy as np
from tf_transformations.euler import euler_from_matrix, euler_matrix


def compose_matrix(
    scale: Any = None, shear: Any = None, angles: Any = None, translate: Any = None, perspective: Any = None
) -> np.ndarray:
    """Return the matrix that scales, shears (xy, xz, yz), rotates by fixed-axis angles (rad), moves, projects, in that
    order.
    """
    matrix = np.identity(4)
    if perspective is not None:
        matrix[3, :] = perspective[:4]
    if translate is not None:
        move = np.identity(4)
        move[:3, 3] = translate[:3]
        matrix = matrix @ move
    if angles is not None:
        matrix = matrix @ euler_matrix(angles[0], angles[1], angles[2])
    if shear is not None:
        slant = np.identity(4)
        slant[0, 1], slant[0, 2], slant[1, 2] = shear[:3]
        matrix = matrix @ slant
    if scale is not None:
        matrix = matrix @ np.diag([*scale[:3], 1.0])
    return matrix / matrix[3, 3]


def decompose_matrix(matrix: object) -> tuple[np.ndarray, list[float], list[float], np.ndarray, np.ndarray]:
    """Return scale, shear, angles (rad), translation and perspective; raises `ValueError` for a singular matrix."""
    m = np.array(matrix, dtype=np.float64)
    if abs(m[3, 3]) < 1e-12:
        raise ValueError("M[3, 3] is zero")
    m /= m[3, 3]
    affine = m.copy()
    affine[3, :] = 0.0, 0.0, 0.0, 1.0
    if abs(np.linalg.det(affine)) < 1e-12:
        raise ValueError("matrix is singular")
    perspective = m[3, :] @ np.linalg.inv(affine) if np.any(abs(m[3, :3]) > 1e-12) else np.array([0.0, 0.0, 0.0, 1.0])
    turn, upper = np.linalg.qr(affine[:3, :3])
    signs = np.where(np.diag(upper) < 0.0, -1.0, 1.0)
    turn, upper = turn * signs, upper * signs[:, None]
    if np.linalg.det(turn) < 0.0:
        turn, upper = -turn, -upper
    scale = np.diag(upper).copy()
    slant = upper / scale
    shear = [float(slant[0, 1]), float(slant[0, 2]), float(slant[1, 2])]
    return scale, shear, list(euler_from_matrix(turn)), affine[:3, 3].copy(), perspective
