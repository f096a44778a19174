"""Blasts from their drill patterns: a table of holes and charges becomes a geometry for Gmsh and a case of method blocks.

    from sazare import blast_model
    pattern = blast_model.read_pattern("pattern.csv")
    layout = blast_model.layout_of(pattern, blast_model.Options(burden=2.0, height=4.0))
    case = blast_model.write_model(blast_model.BlastModel(layout, blast_model.GRANITE), "model")
    sazare.run(case)
"""

from sazare.blast_model.ground import Ground
from sazare.blast_model.joint_field import JointField, joint_field
from sazare.blast_model.joint_sets import JointSet, Scatter, read_joint_sets
from sazare.blast_model.joints import Disc, read_discs
from sazare.blast_model.layout import Layout, Options, layout_of
from sazare.blast_model.model import BlastModel, write_model
from sazare.blast_model.pattern import Deck, Hole, Pattern, read_pattern
from sazare.blast_model.rock import GRANITE
from sazare.blast_model.sizes import SizeLaw

__all__ = [
    "BlastModel", "Deck", "Disc", "GRANITE", "Ground", "Hole", "JointField", "JointSet", "Layout", "Options", "Pattern", "Scatter", "SizeLaw", "joint_field", "layout_of",
    "read_discs", "read_joint_sets", "read_pattern", "write_model",
]
