"""Angles, quaternions and matrices checked against their definitions."""

from __future__ import annotations

import math

import numpy as np
import pytest
import tf_transformations as tf

AXES = ("xyz", "xyx", "xzy", "xzx", "yzx", "yzy", "yxz", "yxy", "zxy", "zxz", "zyx", "zyz")
UNIT = dict(zip("xyz", np.identity(3), strict=True))


@pytest.mark.parametrize("axes", [frame + order for frame in "sr" for order in AXES])
def test_euler_matrix_is_the_product_of_axis_rotations(axes: str) -> None:
    random = np.random.default_rng(7)
    for angles in random.uniform(-3, 3, (20, 3)):
        expected = np.identity(4)
        for angle, character in zip(angles, axes[1:], strict=True):
            turn = tf.rotation_matrix(angle, UNIT[character])
            expected = expected @ turn if axes[0] == "r" else turn @ expected
        np.testing.assert_allclose(tf.euler_matrix(*angles, axes), expected, atol=1e-9)
        back = tf.euler_from_matrix(expected, axes)
        np.testing.assert_allclose(tf.euler_matrix(*back, axes), expected, atol=1e-9)


def test_conversions_give_known_values() -> None:
    np.testing.assert_allclose(tf.quaternion_from_euler(0, 0, math.pi / 2), [0, 0, math.sqrt(0.5), math.sqrt(0.5)])
    np.testing.assert_allclose(tf.euler_from_quaternion([0, 0, math.sqrt(0.5), math.sqrt(0.5)]), [0, 0, math.pi / 2])
    np.testing.assert_allclose(
        tf.quaternion_from_euler(1, 2, 3, "ryxz"), [0.310622, -0.718287, 0.444435, 0.435953], atol=1e-6
    )
    np.testing.assert_allclose(tf.quaternion_multiply([1, -2, 3, 4], [-5, 6, 7, 8]), [-44, -14, 48, 28])
    np.testing.assert_allclose(tf.rotation_matrix(math.pi / 2, [0, 0, 1]) @ [1, 0, 0, 1], [0, 1, 0, 1], atol=1e-12)


def test_quaternions_and_matrices_are_equivalent() -> None:
    random = np.random.default_rng(3)
    for numbers in random.random((30, 3)):
        quaternion = tf.random_quaternion(numbers)
        matrix = tf.quaternion_matrix(quaternion)
        np.testing.assert_allclose(matrix[:3, :3] @ matrix[:3, :3].T, np.identity(3), atol=1e-12)
        found = tf.quaternion_from_matrix(matrix)
        np.testing.assert_allclose(found, quaternion if quaternion[3] >= 0 else -quaternion, atol=1e-9)
        back = tf.quaternion_multiply(quaternion, tf.quaternion_inverse(quaternion))
        np.testing.assert_allclose(back, [0, 0, 0, 1], atol=1e-12)


def test_slerp_interpolates_between_rotations() -> None:
    first, second = tf.quaternion_from_euler(0, 0, 0), tf.quaternion_from_euler(0, 0, 1.0)
    np.testing.assert_allclose(tf.quaternion_slerp(first, second, 0.5), tf.quaternion_from_euler(0, 0, 0.5))
    np.testing.assert_allclose(tf.quaternion_slerp(first, -second, 0.25), tf.quaternion_from_euler(0, 0, 0.25))


def test_composed_matrix_decomposes_into_its_parts() -> None:
    random = np.random.default_rng(5)
    for _ in range(20):
        scale, shear, angles, move = (
            random.uniform(low, high, 3) for low, high in ((0.5, 2), (-1, 1), (-1, 1), (-5, 5))
        )
        parts = tf.decompose_matrix(tf.compose_matrix(scale, shear, angles, move))
        for found, given in zip(parts, (scale, shear, angles, move), strict=False):
            np.testing.assert_allclose(found, given, atol=1e-9)


def test_matrices_are_decomposed_into_their_parameters() -> None:
    angle, axis, point = tf.rotation_from_matrix(tf.rotation_matrix(0.7, [1, 2, 3], [4, 5, 6]))
    assert tf.is_same_transform(tf.rotation_matrix(angle, axis, point), tf.rotation_matrix(0.7, [1, 2, 3], [4, 5, 6]))
    points = np.random.default_rng(2).random((3, 10))
    matrix = tf.concatenate_matrices(tf.translation_matrix([1, 2, 3]), tf.random_rotation_matrix())
    moved = matrix[:3, :3] @ points + matrix[:3, 3:]
    assert tf.is_same_transform(tf.superimposition_matrix(points, moved), matrix)
    mirror = tf.reflection_matrix([1, 0, 0], [1, 1, 0])
    assert tf.is_same_transform(mirror @ mirror, tf.identity_matrix())
    assert tf.is_same_transform(tf.reflection_matrix(*tf.reflection_from_matrix(mirror)), mirror)
    flat = tf.projection_matrix([0, 0, 1], [0, 0, 1])
    np.testing.assert_allclose(flat @ [3, 4, 5, 1], [3, 4, 1, 1])
    np.testing.assert_allclose(
        tf.translation_from_matrix(tf.inverse_matrix(tf.translation_matrix([1, 2, 3]))), [-1, -2, -3]
    )


def test_invalid_axis_order_is_rejected() -> None:
    with pytest.raises(ValueError, match="'xyz' is not an order of axes"):
        tf.quaternion_from_euler(0, 0, 0, "xyz")
