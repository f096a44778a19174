"""Snapshots of a folder that may come from anyone: VTKHDF files of the folder itself are read, and nothing else."""

import json
import pickle
import shutil

import h5py
import numpy as np
import pytest

import sazare
from sazare.snapshots import read_mesh


class Trap:
    """Writes a file when it is unpickled."""

    def __init__(self, path):
        self.path = path

    def __reduce__(self):
        return (open, (str(self.path), "w"))


def listed(slab, folder, name):
    """A copy of the slab's run whose list of snapshots has one file, of some name."""
    copy = shutil.copytree(slab, folder / "run")
    files = {"files": [{"name": name, "time": 0.0}]}
    (copy / "snapshots" / "elements.vtkhdf.series").write_text(json.dumps(files))
    return copy


@pytest.mark.parametrize("name", ["../../outside.vtkhdf", "/etc/outside.vtkhdf", "sub/elements.vtkhdf", "..", "elements_00000.pkl", "elements.vtu", "", 7])
def test_only_vtkhdf_files_beside_the_list_are_read(slab, tmp_path, name):
    shutil.copy(slab / "snapshots" / "elements_00000.vtkhdf", tmp_path / "outside.vtkhdf")
    copy = listed(slab, tmp_path, name)
    with pytest.raises(sazare.NotARun, match="is not a snapshot: only .vtkhdf files beside the list are read"):
        _ = sazare.open(copy).snapshots


def test_a_link_out_of_the_folder_is_refused(slab, tmp_path):
    copy = listed(slab, tmp_path, "elements_00009.vtkhdf")
    (copy / "snapshots" / "elements_00009.vtkhdf").symlink_to(slab / "snapshots" / "elements_00000.vtkhdf")
    with pytest.raises(sazare.NotARun, match="a link out of the run's folder"):
        _ = sazare.open(copy).snapshots
    (copy / "snapshots" / "elements.vtkhdf.series").unlink()
    with pytest.raises(sazare.NotARun, match="a link out of the run's folder"):
        _ = sazare.open(copy).snapshots


def test_a_folder_that_is_reached_by_a_link_is_read(slab, tmp_path):
    (tmp_path / "link").symlink_to(slab, target_is_directory=True)
    assert len(sazare.open(tmp_path / "link").snapshots) == 6


def test_a_pickle_under_the_name_of_a_snapshot_is_not_unpickled(slab, tmp_path):
    copy = listed(slab, tmp_path, "elements_00000.vtkhdf")
    (copy / "snapshots" / "elements_00000.vtkhdf").write_bytes(pickle.dumps(Trap(tmp_path / "sprung")))
    with pytest.raises(sazare.NotARun, match="not a readable VTKHDF file: it does not begin as HDF5 files do"):
        _ = sazare.open(copy).snapshots[0].elements
    assert not (tmp_path / "sprung").exists()


def test_hdf5_that_is_no_grid_is_refused(tmp_path):
    path = tmp_path / "elements_00000.vtkhdf"
    with h5py.File(path, "w") as file:
        file["numbers"] = np.arange(3)
    with pytest.raises(sazare.NotARun, match="elements_00000.vtkhdf: not a"):
        read_mesh(path)


def test_a_kind_is_not_taken_for_another_with_the_same_beginning(slab, tmp_path):
    copy = shutil.copytree(slab, tmp_path / "run")
    (copy / "snapshots" / "elements.vtkhdf.series").unlink()
    shutil.copy(copy / "snapshots" / "elements_00000.vtkhdf", copy / "snapshots" / "elements_of_water_00000.vtkhdf")
    assert len(sazare.open(copy).snapshots) == 6


@pytest.mark.parametrize("trap", ["chunks", "link", "external"])
def test_a_file_that_announces_more_than_it_holds_or_leads_to_others_is_refused(slab, tmp_path, trap):
    path = tmp_path / "elements_00000.vtkhdf"
    shutil.copy(slab / "snapshots" / "elements_00000.vtkhdf", path)
    with h5py.File(path, "r+") as file:
        group = file["VTKHDF"]
        if trap == "chunks":
            del group["Points"]
            group.create_dataset("Points", shape=(400_000_000, 3), chunks=(1024, 3), dtype="f8")
        elif trap == "link":
            del group["Points"]
            group["Points"] = h5py.ExternalLink(str(slab / "snapshots" / "elements_00001.vtkhdf"), "/VTKHDF/Points")
        else:
            group.create_dataset("CellData/extra", shape=(720,), dtype="f8", external=[(str(tmp_path / "other"), 0, 720 * 8)])
    words = {"chunks": "announces 9.6 GB", "link": "holds links", "external": "numbers in another file"}
    with pytest.raises(sazare.NotARun, match=words[trap]):
        read_mesh(path)
