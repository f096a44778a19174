"""The crater of a single charge: what of a block is thrown out of its surface."""

import numpy as np
import pytest
from synthetic_run import block_mesh

from sazare.muck_pile.crater import crater
from sazare.muck_pile.elements import Elements


def block(thrown, speed=5.0, turn=np.eye(3)):
    """The Elements of a block of 2 x 2 x 1 m of which those within `thrown`, a function of their centres (n, 3), are one loose fragment that moves along z."""
    points, tetrahedra = block_mesh((2.0, 2.0, 1.0), (4, 4, 2))
    corners = points[tetrahedra]
    loose = thrown(corners.mean(axis=1))
    count = len(tetrahedra)
    velocity = np.where(loose[:, None], [0.0, 0.0, speed], 0.0) @ turn.T
    return Elements(
        corners @ turn.T, corners @ turn.T, tetrahedra, np.full(count, 2500.0), velocity, np.zeros((count, 3)), np.where(loose, 7, 3), ~loose,
    )


def upper_corner(centres):
    return (centres[:, 0] < 1.0) & (centres[:, 1] < 0.5) & (centres[:, 2] > 0.5)


@pytest.mark.parametrize("axis", [0, 1, 2])
def test_the_crater_is_what_flies_out_wherever_the_surface_looks(axis):
    turn = np.roll(np.eye(3), axis, axis=0)
    found = crater(block(upper_corner, turn=turn), turn @ [0.0, 0.0, 1.0])
    assert found.volume == pytest.approx(0.25) and found.mass == pytest.approx(625.0) and found.broken == pytest.approx(0.25)
    assert found.radius == pytest.approx(np.sqrt(0.5 / np.pi)) and found.depth == pytest.approx(0.5)
    assert found.fragments == 1 and found.speed == pytest.approx(5.0)


def test_what_does_not_rise_above_its_size_is_broken_and_not_thrown():
    # The sphere of 0.25 m3 is 0.782 m across, which 3.92 m/s reach.
    assert crater(block(upper_corner, speed=3.95), np.array([0.0, 0.0, 1.0])).volume == pytest.approx(0.25)
    slow = crater(block(upper_corner, speed=3.89), np.array([0.0, 0.0, 1.0]))
    assert (slow.volume, slow.radius, slow.depth, slow.speed) == (0.0, 0.0, 0.0, 0.0) and slow.broken == pytest.approx(0.25)


def test_what_moves_into_the_rock_is_not_thrown():
    assert crater(block(upper_corner, speed=-9.0), np.array([0.0, 0.0, 1.0])).volume == 0.0
