"""The tables of OpenSees' results that the validation of saturated ground compares with are what OpenSees finds."""

import sys
from pathlib import Path

import numpy as np
import pytest

FOLDER = Path(__file__).resolve().parents[2] / "validation/analytic/caisson-beside-opensees"
END = 1.0  # s


@pytest.fixture(scope="module")
def box():
    """The script that makes the tables."""
    try:
        import openseespy.opensees  # noqa: F401
    except (ImportError, RuntimeError) as error:
        pytest.skip(f"OpenSeesPy is not installed, or not with libblas3 and liblapack3: {error}")
    sys.path.insert(0, str(FOLDER))
    import opensees

    yield opensees
    sys.path.remove(str(FOLDER))


@pytest.mark.parametrize("name", ["9_4_QuadUP", "quadUP", "SSPquadUP", "9_4_QuadUP-tight", "SSPquadUP-tight"])
def test_tables_are_what_opensees_finds(box, name):
    """Versions and machines may round otherwise."""
    table = np.loadtxt(FOLDER / f"opensees-{name}.csv", delimiter=",", skiprows=1)
    found = box.run(name, END)
    table = table[: len(found)]
    assert table[-1, 0] == pytest.approx(END)
    size = np.abs(table).max(axis=0)
    assert size[1] > 1e-5 and size[3] > 100.0  # m, Pa
    assert (np.abs(found - table).max(axis=0) < 1e-6 * size).all()
