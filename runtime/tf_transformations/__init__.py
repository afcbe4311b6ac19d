"""Homogeneous matrices and quaternions, under the names of upstream's `tf_transformations`, using only NumPy.

Quaternions are `[x, y, z, w]`, matrices 4x4 arrays, angles in rad. Euler angles have an axis order such as `sxyz`:
`s` for static axes, `r` for rotating axes.
"""

from tf_transformations.euler import euler_from_matrix, euler_from_quaternion, euler_matrix, quaternion_from_euler
from tf_transformations.matrices import (
    concatenate_matrices,
    identity_matrix,
    inverse_matrix,
    is_same_transform,
    projection_matrix,
    reflection_from_matrix,
    reflection_matrix,
    rotation_from_matrix,
    rotation_matrix,
    scale_from_matrix,
    scale_matrix,
    shear_matrix,
    superimposition_matrix,
    translation_from_matrix,
    translation_matrix,
)
from tf_transformations.parts import compose_matrix, decompose_matrix
from tf_transformations.quaternions import (
    quaternion_about_axis,
    quaternion_conjugate,
    quaternion_from_matrix,
    quaternion_inverse,
    quaternion_matrix,
    quaternion_multiply,
    quaternion_slerp,
    random_quaternion,
    random_rotation_matrix,
)
from tf_transformations.vectors import random_vector, unit_vector, vector_norm

TRANSLATION_IDENTITY = [0.0, 0.0, 0.0]
ROTATION_IDENTITY = identity_matrix()[:3, :3]
ZOOM_IDENTITY = [1.0, 1.0, 1.0]
SHEAR_IDENTITY = TRANSLATION_IDENTITY

__all__ = [
    "ROTATION_IDENTITY",
    "SHEAR_IDENTITY",
    "TRANSLATION_IDENTITY",
    "ZOOM_IDENTITY",
    "compose_matrix",
    "concatenate_matrices",
    "decompose_matrix",
    "euler_from_matrix",
    "euler_from_quaternion",
    "euler_matrix",
    "identity_matrix",
    "inverse_matrix",
    "is_same_transform",
    "projection_matrix",
    "quaternion_about_axis",
    "quaternion_conjugate",
    "quaternion_from_euler",
    "quaternion_from_matrix",
    "quaternion_inverse",
    "quaternion_matrix",
    "quaternion_multiply",
    "quaternion_slerp",
    "random_quaternion",
    "random_rotation_matrix",
    "random_vector",
    "reflection_from_matrix",
    "reflection_matrix",
    "rotation_from_matrix",
    "rotation_matrix",
    "scale_from_matrix",
    "scale_matrix",
    "shear_matrix",
    "superimposition_matrix",
    "translation_from_matrix",
    "translation_matrix",
    "unit_vector",
    "vector_norm",
]
