"""Runs that are written once for all tests."""

import pytest

from synthetic_run import slab_run, solid_run


@pytest.fixture(scope="session")
def slab(tmp_path_factory):
    """The folder of a run of a thin slab; tests only read it."""
    return slab_run(tmp_path_factory.mktemp("runs") / "slab")


@pytest.fixture(scope="session")
def solid(tmp_path_factory):
    """The folder of a run of a body that is no slab; tests only read it."""
    return solid_run(tmp_path_factory.mktemp("runs") / "solid", snapshots=3)
