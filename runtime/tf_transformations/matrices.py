"""Homogeneous 4x4 matrices: translations, rotations, reflections, and their composition."""

from __future__ import annotations

import math
from collections.abc import Sequence
from functools import reduce
from typing import Any

import numpy as np
from tf_transformations.quaternions import quaternion_about_axis, quaternion_matrix
from tf_transformations.vectors import unit_vector


def identity_matrix() -> np.ndarray:
    """Return the identity matrix."""
    return np.identity(4)


def translation_matrix(direction: Sequence[float] | np.ndarray) -> np.ndarray:
    """Return the translation by a vector."""
    matrix = np.identity(4)
    matrix[:3, 3] = direction[:3]
    return matrix


def translation_from_matrix(matrix: object) -> np.ndarray:
    """Return the vector by which a matrix translates."""
    return np.array(matrix)[:3, 3].copy()


def _about(matrix: np.ndarray, point: Sequence[float] | np.ndarray | None) -> np.ndarray:
    """Return the matrix changed so that it leaves a point fixed."""
    if point is not None:
        place = np.asarray(point[:3], dtype=np.float64)
        matrix[:3, 3] = place - matrix[:3, :3] @ place
    return matrix


def rotation_matrix(
    angle: float, direction: Sequence[float] | np.ndarray, point: Sequence[float] | np.ndarray | None = None
) -> np.ndarray:
    """Return the rotation by an angle (rad) about an axis, through a point if one is given."""
    return _about(quaternion_matrix(quaternion_about_axis(angle, direction)), point)


def rotation_from_matrix(matrix: object) -> tuple[float, np.ndarray, np.ndarray]:
    """Return angle (rad), axis, and a point on it (homogeneous); raises `ValueError` if it is not a rotation."""
    m = np.asarray(matrix, dtype=np.float64)
    direction = _fixed_vector(m[:3, :3].T, "unit eigenvector")
    point = _fixed_point(m, "unit eigenvector")
    cosine = (np.trace(m[:3, :3]) - 1.0) / 2.0
    turned = m[:3, :3] - m[:3, :3].T
    sine = 0.5 * float(np.dot(direction, [turned[2, 1], turned[0, 2], turned[1, 0]]))
    return math.atan2(sine, cosine), direction, point


def _fixed_vector(m: np.ndarray, name: str) -> np.ndarray:
    """Return a vector that a matrix maps to itself; raises `ValueError`, with upstream's name for it, without one."""
    values, vectors = np.linalg.eig(m)
    fixed = np.where(abs(np.real(values) - 1.0) < 1e-8)[0]
    if not len(fixed):
        raise ValueError(f"no {name} corresponding to eigenvalue 1")
    return np.real(vectors[:, fixed[-1]])


def _fixed_point(m: np.ndarray, name: str) -> np.ndarray:
    """Return such a vector as a point with the homogeneous coordinate 1, unless the point is at infinity."""
    point = _fixed_vector(m, name)
    return point / point[3] if point[3] else point


def reflection_matrix(point: Sequence[float] | np.ndarray, normal: Sequence[float] | np.ndarray) -> np.ndarray:
    """Return the reflection at a plane through a point."""
    direction = unit_vector(normal[:3])
    matrix = np.identity(4)
    matrix[:3, :3] -= 2.0 * np.outer(direction, direction)
    return _about(matrix, point)


def reflection_from_matrix(matrix: object) -> tuple[np.ndarray, np.ndarray]:
    """Return a point (homogeneous) and the normal of the mirror plane; raises `ValueError` if it is not a
    reflection.
    """
    m = np.asarray(matrix, dtype=np.float64)
    values, vectors = np.linalg.eig(m[:3, :3])
    turned = np.where(abs(np.real(values) + 1.0) < 1e-8)[0]
    if not len(turned):
        raise ValueError("no unit eigenvector corresponding to eigenvalue -1")
    normal = np.real(vectors[:, turned[0]])
    point = np.append(m[:3, 3] / 2.0, 1.0)
    return point, normal


def scale_matrix(
    factor: float,
    origin: Sequence[float] | np.ndarray | None = None,
    direction: Sequence[float] | np.ndarray | None = None,
) -> np.ndarray:
    """Return the scaling about a point, in all directions or in one."""
    matrix = np.identity(4)
    if direction is None:
        matrix[:3, :3] *= factor
    else:
        along = unit_vector(direction[:3])
        matrix[:3, :3] -= (1.0 - factor) * np.outer(along, along)
    return _about(matrix, origin)


def scale_from_matrix(matrix: object) -> tuple[float, np.ndarray, np.ndarray | None]:
    """Return factor, fixed point (homogeneous) and direction; the direction is None if all are scaled."""
    m = np.asarray(matrix, dtype=np.float64)
    factor = float(np.trace(m[:3, :3])) - 2.0
    values, vectors = np.linalg.eig(m[:3, :3])
    stretched = np.where(abs(np.real(values) - factor) < 1e-8)[0]
    direction = np.real(vectors[:, stretched[0]]) if len(stretched) else None
    if direction is None:
        factor = (factor + 2.0) / 3.0
    return factor, _fixed_point(m, "eigenvector"), direction


def projection_matrix(
    point: Sequence[float] | np.ndarray,
    normal: Sequence[float] | np.ndarray,
    direction: Sequence[float] | np.ndarray | None = None,
    perspective: Any = None,
    pseudo: bool = False,
) -> np.ndarray:
    """Return the projection onto a plane: orthogonal, along a direction, or towards a point of view."""
    place, across = np.asarray(point[:3], dtype=np.float64), unit_vector(normal[:3])
    matrix = np.identity(4)
    if perspective is not None:
        eye = np.asarray(perspective[:3], dtype=np.float64)
        depth = float(np.dot(eye - place, across))
        matrix[:3, :3] = depth * np.identity(3) - np.outer(eye, across)
        if pseudo:
            matrix[:3, :3] -= np.outer(across, across)
            matrix[:3, 3] = np.dot(place, across) * (eye + across)
        else:
            matrix[:3, 3] = np.dot(place, across) * eye
        matrix[3, :3], matrix[3, 3] = -across, np.dot(eye, across)
        return matrix
    along = across if direction is None else np.asarray(direction[:3], dtype=np.float64)
    matrix[:3, :3] -= np.outer(along, across) / np.dot(along, across)
    return _about(matrix, place)


def shear_matrix(
    angle: float,
    direction: Sequence[float] | np.ndarray,
    point: Sequence[float] | np.ndarray,
    normal: Sequence[float] | np.ndarray,
) -> np.ndarray:
    """Return the shear by an angle (rad) along a direction in a plane; raises `ValueError` if it is not in the
    plane.
    """
    across, along = unit_vector(normal[:3]), unit_vector(direction[:3])
    if abs(np.dot(across, along)) > 1e-6:
        raise ValueError("direction and normal vectors are not orthogonal")
    matrix = np.identity(4)
    matrix[:3, :3] += math.tan(angle) * np.outer(along, across)
    return _about(matrix, point)


def superimposition_matrix(v0: object, v1: object, scaling: bool = False, usesvd: bool = True) -> np.ndarray:
    """Return the transform that maps points (one per column) to other points with the least squared error."""
    first, second = (np.asarray(each, dtype=np.float64)[:3] for each in (v0, v1))
    if first.shape != second.shape or first.shape[1] < 3:
        raise ValueError("vector sets are of wrong shape or type")
    centre0, centre1 = first.mean(axis=1), second.mean(axis=1)
    near0, near1 = first - centre0[:, None], second - centre1[:, None]
    left, _, right = np.linalg.svd(near1 @ near0.T)
    mirror = np.diag([1.0, 1.0, np.sign(np.linalg.det(left @ right))])
    turn = left @ mirror @ right
    if scaling:
        turn = turn * math.sqrt(np.sum(near1**2) / np.sum(near0**2))
    matrix = np.identity(4)
    matrix[:3, :3] = turn
    matrix[:3, 3] = centre1 - turn @ centre0
    return matrix


def inverse_matrix(matrix: Any) -> np.ndarray:
    """Return the inverse."""
    return np.linalg.inv(matrix)


def concatenate_matrices(*matrices: Any) -> np.ndarray:
    """Return the product of matrices: the last one acts first."""
    return reduce(np.dot, matrices, np.identity(4))


def is_same_transform(matrix0: object, matrix1: object) -> bool:
    """Return whether two matrices are equal up to a common factor."""
    first, second = (np.array(each, dtype=np.float64) for each in (matrix0, matrix1))
    return bool(np.allclose(first / first[3, 3], second / second[3, 3]))
